//! `--report`: the page of a run from a mesh to quads.

use std::path::Path;

use roundel::quad::Compared;
use roundel::{Result, Solution};

use super::Arguments;
use super::mirrored::mirror_words;
use super::steps::Solved;
use super::words;
use crate::page::{
    Page, Scene, Tables, bound, gap, mesh_rows, quad_rows, seconds_rows, solve_rows, valences,
};
use crate::refinement::Refinement;
use crate::summary::{outcome, thousands};

/// Writes the page.
pub(super) fn write(path: &Path, arguments: &Arguments, solved: &Solved) -> Result<()> {
    let made = &solved.made;
    let given = &solved.mesh;
    let mesh = made.mesh(given);
    let is_other = made.refined.is_some() || made.mirrored.is_some();
    let refined = is_other.then_some(mesh);
    let guides = arguments.directions.curves.guide_lines(given)?;
    let scene = Scene::new(given, refined, &solved.changes)
        .features(given, &made.features, &made.missed_features)
        .guides(&guides)
        .field(mesh, &made.field)
        .map(mesh, &made.untangled.map)
        .quads(given, &made.quads);
    let page = Page {
        mesh: &arguments.mesh,
        summary: words(&made.quads),
        tables: tables(solved),
        scene,
    };
    page.write(path)
}

fn tables(solved: &Solved) -> Tables {
    let made = &solved.made;
    let mut tables = Tables::default();
    tables.add("Quads", &quad_rows(&made.quads));
    let mut rows = mesh_rows(&solved.mesh, &solved.changes);
    rows.push(("feature edges", thousands(made.features.len())));
    rows.push(("of these missed", thousands(made.missed_features.len())));
    if solved.too_short > 0 {
        rows.push((
            "sharp edges too short for them",
            thousands(solved.too_short),
        ));
    }
    if let Some(mirrored) = &made.mirrored {
        rows.push(("mirrored", mirror_words(mirrored)));
    }
    if let Some(refined) = &made.refined {
        rows.push(("refined", Refinement::new(refined).to_string()));
    }
    tables.add("Input", &rows);
    tables.add(
        "Field",
        &solve_rows(solved.options.field.strategy, &made.field_solution),
    );
    let mut rows = solve_rows(solved.options.map.strategy, &made.solution);
    rows.push(("folds, at first", thousands(made.untangled.flipped_before)));
    rows.push(("folds, at last", thousands(made.untangled.flipped_after)));
    tables.add("Map", &rows);
    tables.add_bars("Seconds", &times(solved));
    tables.add_bars("Edges at a vertex", &valences(&made.quads));
    if !made.compared.is_empty() {
        add_strategies(&mut tables, &made.compared);
    }
    tables
}

/// The seconds of every step.
fn times(solved: &Solved) -> Vec<(String, f64, String)> {
    let seconds = solved.made.seconds;
    let steps = [
        ("read", solved.read_seconds),
        ("refine", seconds.refine),
        ("field", seconds.field),
        ("map", seconds.map),
        ("quads", seconds.extract),
        ("smooth", seconds.smooth),
        ("other strategies", seconds.compare),
    ];
    seconds_rows(&steps)
}

/// A problem's name, and a strategy's solution of it.
type Problem = (&'static str, fn(&Compared) -> &Solution);

/// One row a strategy, of the field's problem and of the map's.
fn add_strategies(tables: &mut Tables, compared: &[Compared]) {
    let problems: [Problem; 2] = [
        ("Field by other strategies", |one| &one.field),
        ("Map by other strategies", |one| &one.map),
    ];
    for (title, of) in problems {
        let row = |one: &Compared| {
            let solution = of(one);
            vec![
                one.strategy.name().to_string(),
                outcome(solution),
                thousands(solution.counts().reduced_integers),
                format!("{:.6}", solution.energy()),
                bound(solution),
                gap(solution),
                format!("{:.3}", solution.seconds().total),
            ]
        };
        let rows: Vec<_> = compared.iter().map(row).collect();
        let head = [
            "strategy",
            "outcome",
            "integers",
            "energy",
            "lower bound",
            "gap",
            "seconds",
        ];
        tables.add_wide(title, &head, &rows);
    }
}
