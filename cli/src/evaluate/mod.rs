//! `roundel evaluate`: the tables of Bommes' thesis (`bommes2012`, section 5.3), run anew beside its
//! figures.
//!
//! | file | step |
//! | --- | --- |
//! | `experiments` | which meshes, how large, which solvers: tables 5.1 to 5.4 and the ordering |
//! | `meshes` | where they come from, and what stands in for those that are not there |
//! | `cells` | one solve, in a process of its own so that its peak memory is its own |
//! | `run` | all solves of a table, row by row |
//! | `reference` | the figures of the thesis and of the original |
//! | `others` | other solvers on the same MPS files, where their figures are given |
//! | `table`, `plots`, `plot`, `scale`, `escape`, `page` | CSV, SVG and HTML |

mod arguments;
mod cells;
mod escape;
mod experiments;
mod meshes;
mod others;
mod page;
mod plot;
mod plots;
mod reference;
mod row;
mod run;
mod scale;
mod table;

use std::fs;
use std::path::Path;

use roundel::Result;

use crate::exit::Exit;
use crate::output;
pub use arguments::Arguments;

/// Runs the command.
pub fn run(arguments: &Arguments) -> Exit {
    output::conclude(&arguments.tables, false, evaluate(arguments))
}

fn evaluate(arguments: &Arguments) -> Result<()> {
    let out = &arguments.tables;
    let others = match &arguments.other_solvers {
        Some(file) => Some(others::read(file)?),
        None => None,
    };
    fs::create_dir_all(out).map_err(|reason| output::io_error(&out.to_string_lossy(), &reason))?;
    let scratch = meshes::Scratch::new(out)?;
    let mut tables = Vec::new();
    for experiment in experiments::all(arguments.max_triangles) {
        output::print(&format!("{}\n", experiment.title))?;
        let rows = run::run(&experiment, arguments, &scratch)?;
        let file = out.join(format!("{}.csv", experiment.name));
        write(&file, &table::csv(&rows))?;
        tables.push((experiment, rows));
    }
    let page = out.join("index.html");
    write(
        &page,
        &page::html(&tables, others.as_ref(), arguments.max_triangles),
    )?;
    output::print(&format!("{}\n", page.display()))
}

fn write(path: &Path, content: &str) -> Result<()> {
    fs::write(path, content).map_err(|reason| output::io_error(&path.to_string_lossy(), &reason))
}
