//! The threads of a run, and where its time goes.

use std::fs::File;
use std::io::{BufWriter, Write};
use std::path::{Path, PathBuf};

use roundel::monitor::{Trace, traced, with_threads};
use roundel::{Options, Result};
use serde_json::json;

use crate::options::SolverOptions;
use crate::output::io_error;

/// Flags of a trace.
#[derive(Debug, Clone, clap::Args)]
pub struct TraceFlags {
    /// Write which thread did what, and when, to this file, which the trace viewers of browsers show
    #[arg(long, value_name = "TRACE.json", help_heading = "Output")]
    pub trace: Option<PathBuf>,

    /// Do all tasks one after another, and write when this many threads, each with a core of its own,
    /// would have done them
    #[arg(
        long,
        value_name = "THREADS",
        help_heading = "Output",
        requires = "trace"
    )]
    #[arg(value_parser = clap::value_parser!(u16).range(1..=1024))]
    pub simulate: Option<u16>,
}

impl TraceFlags {
    /// Makes a run with the threads that it may use, and writes its trace if one is asked for.
    pub fn around<T>(&self, solver: &SolverOptions, run: impl FnOnce() -> Result<T>) -> Result<T> {
        let threads = match self.simulate {
            Some(threads) => threads.into(),
            None => solver.over(Options::default())?.threads,
        };
        with_threads(threads, || {
            let Some(path) = &self.trace else {
                return run();
            };
            let (result, trace) = traced(self.simulate.is_some(), run);
            let result = result?;
            let told = |error| io_error(&path.display().to_string(), &error);
            write(path, &trace).map_err(told)?;
            Ok(result)
        })
    }
}

/// Writes the trace in the format of Chrome's trace viewer.
fn write(path: &Path, trace: &Trace) -> std::io::Result<()> {
    let microseconds = |seconds: f64| (seconds * 1e9).round() / 1e3;
    let events = trace.spans.iter().map(|span| {
        json!({
            "name": span.name,
            "ph": "X",
            "pid": 0,
            "tid": span.thread,
            "ts": microseconds(span.start),
            "dur": microseconds(span.end - span.start),
        })
    });
    let all = json!({
        "traceEvents": events.collect::<Vec<_>>(),
        "displayTimeUnit": "ms",
        "otherData": { "seconds": trace.seconds },
    });
    let mut file = BufWriter::new(File::create(path)?);
    serde_json::to_writer(&mut file, &all)?;
    file.flush()
}
