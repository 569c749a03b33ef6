//! `roundel census`: quads of all meshes of a folder, as a page and as JSON lines.
//!
//! | file | step |
//! | --- | --- |
//! | `meshes` | the meshes of the folder |
//! | `journal` | rows that are there already, and the file that new ones are added to |
//! | `run` | one mesh, in a process of its own |
//! | `row` | what is told of it |
//! | `page` | the page |

mod arguments;
mod journal;
mod meshes;
mod page;
mod row;
mod run;

use std::collections::BTreeMap;
use std::sync::Mutex;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::thread;

use roundel::Result;

use crate::exit::Exit;
use crate::interrupt;
use crate::output;
use crate::outputs::{Outputs, PAGE};
use crate::summary::counted;
pub use arguments::Arguments;
use journal::Journal;
use meshes::MeshFile;
use row::{Outcome, Row};
use run::Runner;

/// Runs the command and tells its outcome, once.
pub fn run(arguments: &Arguments) -> Exit {
    output::conclude(&arguments.folder, false, census(arguments))
}

fn census(arguments: &Arguments) -> Result<()> {
    Outputs::of(&[], false).write(Some(&arguments.page), PAGE)?;
    let all = meshes::find(&arguments.folder)?;
    let journal = Journal::of(&arguments.page, arguments.part);
    let runner = Runner::new(arguments)?;
    let is_current = |row: &Row| {
        let place = all.binary_search_by(|mesh| mesh.name.cmp(&row.name));
        place.is_ok_and(|at| runner.is_current(&all[at], row))
    };
    let mut rows = journal.read()?;
    rows.retain(|_, row| is_current(row));
    let is_own = |number: usize| match arguments.part {
        Some(part) => number % part.count == part.number - 1,
        None => true,
    };
    let missing = all.iter().enumerate();
    let missing =
        missing.filter(|(number, mesh)| is_own(*number) && !rows.contains_key(&mesh.name));
    let missing: Vec<&MeshFile> = missing.map(|(_, mesh)| mesh).collect();
    let made = run_all(arguments, &runner, &journal, &missing)?;
    if interrupt::was_asked() || arguments.part.is_some() {
        let kept = counted(rows.len() + made.len(), "row");
        return output::print(&format!(
            "{kept} of {} in {}\n",
            all.len(),
            journal.file().display()
        ));
    }
    rows.extend(made.into_iter().map(|row| (row.name.clone(), row)));
    let rows: Vec<Row> = rows.into_values().collect();
    journal.write_whole(&rows)?;
    page::write(&arguments.page, &arguments.folder, runner.flags(), &rows)?;
    output::print(&told(arguments, &rows))
}

/// Makes the rows of these meshes, and adds each to the journal.
fn run_all(
    arguments: &Arguments,
    runner: &Runner,
    journal: &Journal,
    missing: &[&MeshFile],
) -> Result<Vec<Row>> {
    let token = interrupt::cancel_token()?;
    let next = AtomicUsize::new(0);
    let made: Mutex<Result<Vec<Row>>> = Mutex::new(Ok(Vec::new()));
    let open = Mutex::new(journal.open()?);
    let work = || {
        while !token.is_finishing() {
            let Some(mesh) = missing.get(next.fetch_add(1, Ordering::Relaxed)) else {
                return;
            };
            let row = runner.row(mesh);
            // Ctrl-C has reached the process of the mesh, too.
            if token.is_finishing() {
                return;
            }
            let written = open.lock().map_or(Ok(()), |mut open| open.add(&row));
            let Ok(mut made) = made.lock() else { return };
            match (&mut *made, written) {
                (Ok(rows), Ok(())) => {
                    if !arguments.quiet {
                        let line =
                            format!("{:>6}/{} {}\n", rows.len() + 1, missing.len(), row.line());
                        // If stdout is closed, nobody reads the line, and the rows are still wanted.
                        let _ = output::print(&line);
                    }
                    rows.push(row);
                }
                (Err(_), _) => return,
                (failed, Err(error)) => {
                    *failed = Err(error);
                    return;
                }
            }
        }
    };
    thread::scope(|scope| {
        for _ in 0..runner.jobs().min(missing.len()) {
            scope.spawn(work);
        }
    });
    made.into_inner()
        .unwrap_or_else(|poisoned| poisoned.into_inner())
}

/// One line for people.
fn told(arguments: &Arguments, rows: &[Row]) -> String {
    let mut counts: BTreeMap<Outcome, usize> = BTreeMap::new();
    for row in rows {
        *counts.entry(row.outcome).or_default() += 1;
    }
    let counts = counts
        .into_iter()
        .map(|(outcome, n)| format!("{n} {}", outcome.words()));
    let counts: Vec<String> = counts.collect();
    let meshes = format!(
        "{} mesh{}",
        rows.len(),
        if rows.len() == 1 { "" } else { "es" }
    );
    format!(
        "{meshes}: {}\n{}\n",
        counts.join(", "),
        arguments.page.display()
    )
}
