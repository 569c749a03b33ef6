//! `roundel quad`: from a mesh to quads in one command.

mod arguments;
mod density;
mod faults;
mod keep;
mod mirrored;
mod page;
mod report;
mod steps;
mod summary;

use crate::exit::Exit;
use crate::output;
pub use arguments::Arguments;
pub use faults::tell_faults;
use report::QuadReport;
pub use report::{QuadCounts, words};
use steps::Solved;
use summary::QuadSummary;

/// Runs the command and tells its outcome, once.
pub fn run(arguments: &Arguments) -> Exit {
    let run = || steps::solve(arguments);
    let solved = arguments.tracing.around(&arguments.solver, run);
    let told = solved.and_then(|solved| tell(arguments, &solved));
    output::conclude(&arguments.mesh, arguments.json, told)
}

fn tell(arguments: &Arguments, solved: &Solved) -> roundel::Result<()> {
    if let Some(path) = &arguments.report {
        page::write(path, arguments, solved)?;
    }
    if arguments.json {
        output::print_json(&QuadReport::new(arguments, solved))
    } else {
        output::print(&QuadSummary { arguments, solved }.to_string())?;
        tell_faults(&arguments.mesh, &solved.made.quads);
        Ok(())
    }
}
