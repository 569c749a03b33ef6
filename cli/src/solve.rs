//! `roundel solve`: reads a problem from a file, solves the problem and reports the solution.

use std::path::PathBuf;
use std::time::Instant;

use roundel::problem::files::{self, NamedProblem};
use roundel::solve::replay;
use roundel::{Options, Proof, Result, Solution, StoppedBy, Strategy};

use crate::exit::{self, Exit};
use crate::options::SolverOptions;
use crate::output;
use crate::outputs::{Content, OutputFlags, Outputs, TRACE};
use crate::progress::Progress;
use crate::report::{Preparation, Report};
use crate::summary::Summary;
use crate::threads::TraceFlags;

/// Solve a problem from an MPS, LP or QPLIB file.
#[derive(clap::Args)]
#[command(after_help = exit::HELP)]
pub struct Arguments {
    /// The problem: LP for .lp, QPLIB for .qplib, MPS for any other ending, each also compressed (.gz)
    #[arg(value_name = "FILE")]
    file: PathBuf,

    /// Take options, pinned variables and initial guess from the replay file beside FILE; flags on the
    /// command line take precedence
    #[arg(long)]
    replay: bool,

    /// Print one JSON object instead of the summary
    #[arg(long)]
    json: bool,

    /// Write a line `NAME VALUE` for each variable to this file, with 17 digits
    #[arg(long, value_name = "OUT")]
    solution: Option<PathBuf>,

    /// Write a proof of the bound, which `roundel check-proof` confirms (strategies exact and auto)
    #[arg(long, value_name = "OUT")]
    proof: Option<PathBuf>,

    #[command(flatten)]
    output: OutputFlags,

    #[command(flatten)]
    tracing: TraceFlags,

    #[command(flatten)]
    solver: SolverOptions,
}

/// Runs the command and tells its outcome, once.
pub fn run(arguments: &Arguments) -> Exit {
    let run = || solve(arguments);
    let solved = arguments.tracing.around(&arguments.solver, run);
    let mut has_no_proof = false;
    let told = solved.and_then(|solved| {
        has_no_proof = matches!(solved.proof, Some(Err(_)));
        tell(arguments, &solved)
    });
    match output::conclude(&arguments.file, arguments.json, told) {
        Exit::Solved | Exit::Finished if has_no_proof => Exit::Stopped,
        exit => exit,
    }
}

/// What was read.
struct Input {
    named: NamedProblem,
    options: Options,
    seconds: f64,
}

fn read(arguments: &Arguments) -> Result<Input> {
    let started = Instant::now();
    let file = &arguments.file;
    let (named, options) = if arguments.replay {
        let (problem, options) = replay::load(file)?;
        (NamedProblem::new(problem), options)
    } else {
        (files::read(file)?, Options::default())
    };
    Ok(Input {
        named,
        options: arguments.solver.over(options)?,
        seconds: started.elapsed().as_secs_f64(),
    })
}

/// A solution, and how it was found.
struct Solved {
    strategy: Strategy,
    read: f64,
    maximise: bool,
    solution: Solution,
    proof: Option<std::result::Result<Proof, StoppedBy>>,
}

fn solve(arguments: &Arguments) -> Result<Solved> {
    let started = Instant::now();
    let read_only = [Some(arguments.file.as_path())];
    Outputs::of(&read_only, arguments.output.force)
        .write(arguments.solution.as_ref(), Content::Text)?
        .write(arguments.proof.as_ref(), Content::Text)?
        .write(arguments.tracing.trace.as_ref(), TRACE)?;
    let mut progress = Progress::start(arguments.output.quiet)?;
    let mut input = read(arguments)?;
    match arguments.proof {
        // The limit of a solve ends its proof as well, that of a run does not.
        Some(_) => input.options.time_limit -= started.elapsed().as_secs_f64(),
        None => progress.limit(&mut input.options, started),
    }
    input.options.time_limit = input.options.time_limit.max(0.0);
    let (problem, options) = (input.named.problem(), &input.options);
    let located = |error| input.named.located(error);
    let (solution, proof) = match &arguments.proof {
        None => {
            let solved = roundel::solve_with(problem, options, progress.monitor());
            (solved.map_err(located)?, None)
        }
        Some(path) => {
            let proved = roundel::solve_with_proof(problem, options, progress.monitor());
            let proved = proved.map_err(located)?;
            if let Ok(proof) = &proved.proof {
                output::write_proof(path, proof)?;
            }
            (proved.outcome?, Some(proved.proof))
        }
    };
    if let Some(path) = &arguments.solution {
        output::write_values(path, input.named.variables(), solution.values())?;
    }
    Ok(Solved {
        strategy: input.options.strategy,
        read: input.seconds,
        maximise: input.named.maximises(),
        solution,
        proof,
    })
}

fn tell(arguments: &Arguments, solved: &Solved) -> Result<()> {
    let strategy = solved.strategy.name();
    if arguments.json {
        let before = Preparation {
            read: solved.read,
            assemble: None,
        };
        let memory = roundel::peak_memory();
        let report = Report::new(&arguments.file, strategy, before, &solved.solution, memory);
        output::print_json(&report.in_sense_of_file(solved.maximise))
    } else {
        let summary = Summary {
            strategy,
            read: solved.read,
            maximise: solved.maximise,
            solution: &solved.solution,
            proof: solved.proof.as_ref(),
        };
        output::print(&summary.to_string())
    }
}
