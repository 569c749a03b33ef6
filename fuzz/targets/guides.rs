//! Text files that belong to a mesh: guides, feature lines and fields.
#![no_main]

use std::sync::LazyLock;

use libfuzzer_sys::fuzz_target;
use roundel::Options;
use roundel::mesh::{TriangleMesh, features::FeatureGraph, shape};
use roundel::field::{FieldProblem, Guidance, OrientationField};

static MESH: LazyLock<TriangleMesh> =
    LazyLock::new(|| shape::by_name("disk", 16).expect("there is a disk"));

fuzz_target!(|input: (u8, &str)| {
    let (kind, text) = input;
    match kind % 3 {
        0 => guided(text),
        1 => drop(FeatureGraph::parse(&MESH, text)),
        _ => field(text),
    }
});

/// A guidance file is either refused or followed by the field.
fn guided(text: &str) {
    let mut guidance = Guidance::default();
    if guidance.parse(&MESH, text).is_err() {
        assert!(guidance == Guidance::default(), "a file that fails adds nothing");
        return;
    }
    let stated = guidance
        .features(&MESH)
        .and_then(|features| guidance.field_options(&MESH, &features));
    let Ok(stated) = stated else { return };
    let Ok(problem) = FieldProblem::with_options(&MESH, &stated) else {
        return;
    };
    let options = Options {
        nodes: 100,
        ..Options::default()
    };
    if let Ok(solution) = roundel::solve(problem.problem(), &options) {
        let field = problem.field(&MESH, &solution).expect("its own solution");
        assert!(field.angles().iter().all(|angle| angle.is_finite()));
    }
}

/// The indices of a field that was read sum to the Euler characteristic.
fn field(text: &str) {
    if let Ok(field) = OrientationField::parse(&MESH, text) {
        assert!(field.angles().iter().all(|angle| angle.is_finite()));
    }
}
