//! All solves of one table.

use std::path::PathBuf;

use roundel::Result;

use super::Arguments;
use super::cells;
use super::experiments::{Experiment, Family, Solver, Subject};
use super::meshes::{self, Found, Scratch};
use super::reference;
use super::row::{Row, compare_sizes};
use crate::output;
use crate::summary::energy;

/// Runs every solver on every mesh, and puts the reference figures behind ours.
pub fn run(experiment: &Experiment, arguments: &Arguments, scratch: &Scratch) -> Result<Vec<Row>> {
    let mut rows: Vec<Row> = Vec::new();
    for subject in &experiment.subjects {
        let found = meshes::find(subject, arguments.meshes.as_deref(), scratch)?;
        tell_mesh(subject, &found)?;
        let field = match experiment.family {
            Family::Field => None,
            Family::Map => Some(field(subject, &found, arguments, scratch)?),
        };
        for solver in &experiment.solvers {
            let mut row = Row {
                mesh: subject.name.clone(),
                shape: subject.shape.into(),
                triangles: subject.triangles,
                stand_in: found.stand_in.clone(),
                source: "roundel".into(),
                solver: solver.name.clone(),
                ..Row::default()
            };
            match was_too_slow(&rows, &row) {
                true => row.status = "not run: too slow before".into(),
                false => {
                    let words = words(subject, &found, solver, field.as_ref(), arguments);
                    cells::fill(&mut row, &words)?;
                }
            }
            tell(&row)?;
            rows.push(row);
        }
        rows.extend(reference::rows(experiment.family, subject)?);
    }
    compare_sizes(&mut rows);
    Ok(rows)
}

/// Whether this solver ran out of time on a smaller mesh of the shape.
fn was_too_slow(rows: &[Row], row: &Row) -> bool {
    let same = |r: &&Row| r.shape == row.shape && r.label() == row.label();
    rows.iter()
        .rfind(same)
        .is_some_and(|r| r.status == "limit" || r.status.starts_with("not run"))
}

/// The command line of one solve.
fn words(
    subject: &Subject,
    found: &Found,
    solver: &Solver,
    field: Option<&PathBuf>,
    arguments: &Arguments,
) -> Vec<String> {
    let mut words = match field {
        None => field_words(subject, found),
        Some(field) => vec![
            "parametrize".into(),
            cells::word(&found.mesh),
            "--field".into(),
            cells::word(field),
            "--quads".into(),
            subject.quads.to_string(),
            "--no-untangle".into(),
        ],
    };
    words.extend(solver.flags.iter().cloned());
    words.extend(["--time-limit".into(), arguments.time_limit.to_string()]);
    words
}

fn field_words(subject: &Subject, found: &Found) -> Vec<String> {
    vec![
        "field".into(),
        cells::word(&found.mesh),
        "--constrain-curvature".into(),
        subject.constrained.to_string(),
    ]
}

/// The field that all maps of a mesh follow: that of the adaptive strategy.
fn field(
    subject: &Subject,
    found: &Found,
    arguments: &Arguments,
    scratch: &Scratch,
) -> Result<PathBuf> {
    let file = scratch.path(&format!("{}.txt", subject.name));
    let mut words = field_words(subject, found);
    words.extend(["--strategy", "adaptive", "-o"].map(String::from));
    words.push(cells::word(&file));
    words.extend(["--time-limit".into(), arguments.time_limit.to_string()]);
    cells::run(&words)?;
    Ok(file)
}

fn tell_mesh(subject: &Subject, found: &Found) -> Result<()> {
    let origin = match (&found.stand_in, &found.made) {
        (Some(stand_in), _) => format!("not there, {stand_in} stands in for it"),
        (None, Some(made)) => made.clone(),
        (None, None) => found.mesh.display().to_string(),
    };
    output::print(&format!("  {}: {origin}\n", subject.name))
}

fn tell(row: &Row) -> Result<()> {
    let energy = row.energy.map_or_else(|| row.status.clone(), energy);
    let seconds = row
        .seconds
        .map_or_else(String::new, |s| format!("{s:10.4} s"));
    let stands_in = match row.stand_in {
        Some(_) => "  (stand-in)",
        None => "",
    };
    output::print(&format!(
        "    {:<30} {energy:<28} {seconds}{stands_in}\n",
        row.solver
    ))
}
