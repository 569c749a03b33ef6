//! `roundel check-proof`: whether a proof of a solve is one.

use std::fmt;
use std::fs::File;
use std::io::BufReader;
use std::path::PathBuf;
use std::time::Instant;

use roundel::problem::files;
use roundel::proof::{self, Fault, Verdict};
use roundel::{Error, Result};
use serde::Serialize;

use crate::exit::{self, Exit};
use crate::output::{self, io_error};
use crate::summary::{counted, energy, line};

/// Check a proof that `roundel solve --proof` has written.
///
/// Confirms in exact arithmetic that the point is within all rows, bounds and integers, that its energy is the
/// one told, and that no point has less energy than the bound. It shares no code with the search.
#[derive(clap::Args)]
#[command(after_help = exit::HELP)]
pub struct Arguments {
    /// The proof
    #[arg(value_name = "PROOF")]
    file: PathBuf,

    /// Require the proof to be of the problem in this file
    #[arg(long, value_name = "FILE")]
    problem: Option<PathBuf>,

    /// Print one JSON object instead of the summary
    #[arg(long)]
    json: bool,
}

/// A proof that was checked.
struct Checked {
    result: std::result::Result<Verdict, Fault>,
    seconds: f64,
}

/// What `--json` prints of it.
#[derive(Serialize)]
struct ProofReport {
    file: String,
    valid: bool,
    energy: Option<f64>,
    lower_bound: Option<f64>,
    violation: Option<f64>,
    parts: Option<usize>,
    nodes: Option<usize>,
    line: Option<usize>,
    fault: Option<&'static str>,
    message: Option<String>,
    seconds: f64,
}

/// Runs the command and tells its outcome, once.
pub fn run(arguments: &Arguments) -> Exit {
    let mut is_valid = false;
    let told = check(arguments).and_then(|checked| {
        is_valid = checked.result.is_ok();
        match arguments.json {
            true => output::print_json(&report(arguments, &checked)),
            false => output::print(&checked.to_string()),
        }
    });
    match output::conclude(&arguments.file, arguments.json, told) {
        Exit::Solved if !is_valid => Exit::Invalid,
        exit => exit,
    }
}

fn check(arguments: &Arguments) -> Result<Checked> {
    let read = |path: &PathBuf| files::read(path);
    let named = arguments.problem.as_ref().map(read).transpose()?;
    let file = File::open(&arguments.file)
        .map_err(|reason| -> Error { io_error(&arguments.file.to_string_lossy(), &reason) })?;
    let started = Instant::now();
    let reader = BufReader::new(file);
    let result = match &named {
        Some(named) => proof::check_of(named.problem(), reader),
        None => proof::check(reader),
    };
    Ok(Checked {
        result,
        seconds: started.elapsed().as_secs_f64(),
    })
}

fn report(arguments: &Arguments, checked: &Checked) -> ProofReport {
    let (verdict, fault) = match &checked.result {
        Ok(verdict) => (Some(verdict), None),
        Err(fault) => (None, Some(fault)),
    };
    ProofReport {
        file: arguments.file.to_string_lossy().into_owned(),
        valid: verdict.is_some(),
        energy: verdict.and_then(|verdict| verdict.energy),
        lower_bound: verdict.and_then(|verdict| verdict.lower_bound),
        violation: verdict.map(|verdict| verdict.violation),
        parts: verdict.map(|verdict| verdict.parts),
        nodes: verdict.map(|verdict| verdict.nodes),
        line: fault.map(|fault| fault.line),
        fault: fault.map(|fault| fault.kind.code()),
        message: fault.map(|fault| fault.message.clone()),
        seconds: checked.seconds,
    }
}

impl fmt::Display for Checked {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        let verdict = match &self.result {
            Ok(verdict) => verdict,
            Err(fault) => return line(f, "refused", &fault.to_string(), self.seconds),
        };
        let found = match (verdict.energy, verdict.lower_bound) {
            (Some(value), Some(bound)) => format!(
                "{} at a point that misses no row by more than {:.1e}; no point has less than {bound:?}",
                energy(value),
                verdict.violation
            ),
            _ => "no point is within all rows, bounds and integers".to_owned(),
        };
        let size = format!(
            "{}, {}",
            counted(verdict.parts, "part"),
            counted(verdict.nodes, "node")
        );
        line(f, "accepted", &size, self.seconds)?;
        writeln!(f, "{:<10} {found}", "proved")
    }
}
