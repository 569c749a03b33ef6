//! Budgets, meshes in no order, and the way back.

use super::*;
use crate::check::{CheckOptions, check_map};
use crate::field::{Constraint, FieldOptions, OrientationField, smoothest_field};
use crate::map::SeamlessOptions;
use crate::mesh::shape::by_name;
use crate::mesh::{Reordered, shuffled};
use crate::monitor::traced;
use crate::solve::verify;

fn guided(is_far: bool, refinements: usize) -> Try {
    Try {
        is_far,
        refinements,
        gradings: 0,
        is_guided: true,
    }
}

/// A mesh in no order with a field along its first axis.
fn scattered(name: &str, faces: usize) -> (TriangleMesh, OrientationField) {
    let mesh = shuffled(&by_name(name, faces).unwrap());
    let angle = |face: usize| {
        let [x, y] = mesh.frame(face).map(|axis| axis[0]);
        y.atan2(x)
    };
    let faces = 0..mesh.face_count();
    let constraints = faces.map(|face| Constraint {
        face,
        angle: angle(face),
    });
    let options = FieldOptions {
        constraints: constraints.collect(),
        ..FieldOptions::default()
    };
    let adaptive = adaptive();
    let (field, _) = smoothest_field(&mesh, &options, &adaptive, Monitor::default).unwrap();
    (mesh, field)
}

fn adaptive() -> Options {
    Options {
        strategy: Strategy::Adaptive,
        ..Options::default()
    }
}

#[test]
fn maps_of_meshes_in_no_order_are_those_of_the_mesh_as_it_is() {
    let mesh = shuffled(&by_name("rounded-cube", 1_200).unwrap());
    let none = FieldOptions::default();
    let (field, _) = smoothest_field(&mesh, &none, &adaptive(), Monitor::default).unwrap();
    let size = SeamlessOptions { quads: 150 };
    let problem = SeamlessProblem::new(&mesh, &field, &size).unwrap();
    let reordered = Reordered::new(&mesh).unwrap();
    let there = ReorderedProblem::new(&mesh, &problem, reordered).unwrap();
    let (run, effort) = (Run::new(), UntangleOptions::default());
    let work = (WORK, &run, &Monitor::default);
    let options = Options::default();
    let made = fold_free(
        &there.reordered.mesh,
        &there.problem,
        &options,
        &effort,
        work,
    );
    let made = made.unwrap().of_given(there, &mesh, &problem);
    assert_eq!(made.untangled.faults(), 0);
    let map = &made.untangled.map;
    problem.check_map(&mesh, map).unwrap();
    let check = check_map(&mesh, &map.corner_uvs(), &CheckOptions::default()).unwrap();
    assert!(check.is_valid());
    let verdict = verify(problem.problem(), made.solution.values()).unwrap();
    assert!((verdict.energy - made.solution.energy()).abs() < 1e-9 * verdict.energy);
}

#[test]
fn no_further_map_is_tried_once_the_work_is_spent() {
    let mesh = by_name("genus-2", 600).unwrap();
    let none = FieldOptions::default();
    let (field, _) = smoothest_field(&mesh, &none, &adaptive(), Monitor::default).unwrap();
    let size = SeamlessOptions { quads: 20 };
    let problem = SeamlessProblem::new(&mesh, &field, &size).unwrap();
    let effort = UntangleOptions {
        passes: 0,
        rounds: 0,
        ..UntangleOptions::default()
    };
    let made = |most_work: u64| {
        let run = Run::new();
        let work = (most_work, &run, &Monitor::default);
        fold_free(&mesh, &problem, &Options::default(), &effort, work).unwrap()
    };
    let [first, best] = [0, WORK].map(made);
    assert_eq!((first.refinements, first.gradings), (0, 0));
    let faults = |of: &FoldFreeMap| of.untangled.faults();
    assert!(faults(&best) < faults(&first), "{}", faults(&first));
    assert!(best.refinements + best.gradings > 0);
}

#[test]
fn large_meshes_in_no_order_are_put_into_one() {
    let (mesh, field) = scattered("plane", 33_000);
    let size = SeamlessOptions { quads: 150 };
    let problem = SeamlessProblem::new(&mesh, &field, &size).unwrap();
    let effort = UntangleOptions::default();
    let relax = Options {
        strategy: Strategy::Relax,
        ..Options::default()
    };
    let solve = || solve_fold_free(&mesh, &problem, &relax, &effort, Monitor::default);
    let (made, trace) = traced(false, solve);
    assert!(trace.spans.iter().any(|span| span.name == "order mesh"));
    let run = Run::new();
    let work = (WORK, &run, &Monitor::default);
    let as_it_is = fold_free(&mesh, &problem, &relax, &effort, work).unwrap();
    let (found, wanted) = (made.unwrap().solution, as_it_is.solution);
    for (x, y) in found.values().iter().zip(wanted.values()) {
        assert!((x - y).abs() < 1e-8, "{x} {y}");
    }
    // Its error is that of the mesh as it is.
    let other = by_name("torus", 1_000).unwrap();
    let error = solve_fold_free(&other, &problem, &relax, &effort, Monitor::default);
    assert_eq!(error.unwrap_err().code(), "length_mismatch");
}

#[test]
fn the_way_back_leads_to_finer_maps_and_begins_again_with_a_better_guide() {
    let finer = Tried {
        how: Try {
            is_far: true,
            refinements: 2,
            gradings: 1,
            is_guided: false,
        },
        is_best: true,
        faults: 0,
    };
    assert_eq!(back(finer), guided(false, 0));
    let tried = |how: Try, is_best: bool, faults: usize| Tried {
        how,
        is_best,
        faults,
    };
    let near = guided(false, 1);
    assert_eq!(back(tried(near, false, MENDED)), guided(true, 1));
    assert_eq!(back(tried(near, false, MENDED + 1)), guided(false, 2));
    assert_eq!(back(tried(guided(true, 1), false, 1)), guided(false, 2));
    assert_eq!(back(tried(near, true, 0)), guided(false, 0));
}
