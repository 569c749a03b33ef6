//! `--report`: the page of a map.

use std::path::Path;

use roundel::Result;

use super::{Arguments, Solved};
use crate::page::{Page, Scene, Tables, mesh_rows, seconds_rows, solve_rows};
use crate::summary::{counted, counted_vertices, outcome, thousands};

/// Writes the page.
pub(super) fn write(path: &Path, arguments: &Arguments, solved: &Solved) -> Result<()> {
    let Solved { mesh, .. } = solved;
    let map = &solved.untangled.map;
    let summary = format!(
        "{}, {} flipped, {}",
        counted_vertices(map.cones().len(), "irregular "),
        counted(map.flipped().len(), "face"),
        outcome(&solved.solution)
    );
    let guides = arguments.directions.curves.guide_lines(mesh)?;
    let page = Page {
        mesh: &arguments.mesh,
        summary,
        tables: tables(solved),
        scene: Scene::new(mesh, None, &solved.changes)
            .features(mesh, &solved.features, &[])
            .guides(&guides)
            .field(mesh, &solved.field.field)
            .map(mesh, map),
    };
    page.write(path)
}

fn tables(solved: &Solved) -> Tables {
    let (field, untangled) = (&solved.field, &solved.untangled);
    let mut rows = mesh_rows(&solved.mesh, &solved.changes);
    rows.push(("feature edges", thousands(solved.features.len())));
    if solved.too_short > 0 {
        let short = thousands(solved.too_short);
        rows.push(("sharp edges too short for quads", short));
    }
    if let Some(refined) = &solved.refined {
        rows.push(("refined", refined.to_string()));
    }
    let mut tables = Tables::default();
    tables.add("Mesh of the map", &rows);
    let source = field.strategy.unwrap_or("from a file");
    let rows = [
        ("strategy", source.to_owned()),
        ("energy", format!("{:.6}", field.energy)),
    ];
    tables.add("Field", &rows);
    let mut rows = solve_rows(solved.options.strategy, &solved.solution);
    rows.push(("cut edges", thousands(untangled.map.transitions().len())));
    rows.push(("folds, at first", thousands(untangled.flipped_before)));
    rows.push(("folds, at last", thousands(untangled.map.flipped().len())));
    rows.push(("steps of untangling", thousands(untangled.steps)));
    tables.add("Map", &rows);
    let steps = [
        ("read", solved.before.read),
        ("field", field.seconds),
        ("assemble", solved.before.assemble.unwrap_or(0.0)),
        ("map", solved.solution.seconds().total),
        ("untangle", solved.untangle_seconds),
    ];
    tables.add_bars("Seconds", &seconds_rows(&steps));
    tables
}
