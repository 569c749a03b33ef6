//! `--report`: the page of a field.

use std::path::Path;

use roundel::Result;

use super::Arguments;
use super::solved::Solved;
use crate::page::{Page, Scene, Tables, mesh_rows, seconds_rows, solve_rows};
use crate::summary::{counted_vertices, outcome, thousands};

/// Writes the page.
pub(super) fn write(path: &Path, arguments: &Arguments, solved: &Solved) -> Result<()> {
    let Solved { mesh, field, .. } = solved;
    let irregular = counted_vertices(field.irregular_vertices(mesh).len(), "irregular ");
    let guides = arguments.directions.curves.guide_lines(mesh)?;
    let page = Page {
        mesh: &arguments.mesh,
        summary: format!("{irregular}, {}", outcome(&solved.solution)),
        tables: tables(solved),
        scene: Scene::new(mesh, None, &solved.changes)
            .features(mesh, &solved.features, &[])
            .guides(&guides)
            .field(mesh, field),
    };
    page.write(path)
}

fn tables(solved: &Solved) -> Tables {
    let Solved { mesh, field, .. } = solved;
    let given = field.constrained().iter().filter(|&&given| given).count();
    let mut rows = mesh_rows(mesh, &solved.changes);
    rows.push(("feature edges", thousands(solved.features.len())));
    rows.push(("faces of given direction", thousands(given)));
    let mut tables = Tables::default();
    tables.add("Input", &rows);
    let mut rows = solve_rows(solved.strategy, &solved.solution);
    rows.push(("sum of indices", field.index_sum(mesh).to_string()));
    tables.add("Field", &rows);
    let seconds = solved.solution.seconds();
    let steps = [
        ("read", solved.before.read),
        ("assemble", solved.before.assemble.unwrap_or(0.0)),
        ("eliminate", seconds.eliminate),
        ("factor", seconds.factor),
        ("round", seconds.round),
    ];
    tables.add_bars("Seconds", &seconds_rows(&steps));
    tables
}
