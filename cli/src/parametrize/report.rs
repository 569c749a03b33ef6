//! The JSON object of a map: that of a solve, and what is known of the mesh and its field.

use roundel::map::Sizing;
use serde::Serialize;

use super::{Arguments, Solved};
use crate::field::CurveCounts;
use crate::mesh::RepairCounts;
use crate::refinement::Refinement;
use crate::report::Report;

/// What `--json` prints of a map. Times and counts are those of the parametrization, but for
/// `field`.
#[derive(Serialize)]
pub struct MapReport<'a> {
    #[serde(flatten)]
    solve: Report<'a>,
    repair: &'a RepairCounts,
    /// Of the mesh of the map, which is the refined one where there is one.
    faces: usize,
    vertices: usize,
    #[serde(skip_serializing_if = "Option::is_none")]
    refined: Option<Refinement>,
    /// The target number of quads; null if a length was given.
    quads: Option<usize>,
    edge_length: Option<f64>,
    feature_edges: usize,
    /// How many sharp edges are no features, as they are too short for quads.
    short_features: usize,
    /// Where curves are followed.
    #[serde(skip_serializing_if = "Option::is_none")]
    curves: Option<CurveCounts>,
    irregular_vertices: usize,
    cut_edges: usize,
    gradient_energy: f64,
    flipped_before: usize,
    flipped_stiffened: usize,
    flipped: usize,
    flipped_faces: &'a [usize],
    winding_defects: &'a [usize],
    untangle: Untangling,
    field: Field,
}

/// What untangling took, and what it could not unfold.
#[derive(Serialize)]
struct Untangling {
    rounds: usize,
    refinements: usize,
    gradings: usize,
    steps: usize,
    seconds: f64,
    stuck_faces: Vec<usize>,
    collapsed_edges: Vec<usize>,
}

/// The field that the map follows; one from a file has no strategy.
#[derive(Serialize)]
struct Field {
    strategy: Option<&'static str>,
    file: Option<String>,
    energy: f64,
    seconds: f64,
}

impl<'a> MapReport<'a> {
    /// The report of what was found.
    pub(super) fn new(arguments: &Arguments, solved: &'a Solved) -> Self {
        let (mesh, untangled) = (&solved.mesh, &solved.untangled);
        let map = &untangled.map;
        let file = arguments.field.as_ref();
        MapReport {
            solve: Report::new(
                &arguments.mesh,
                solved.options.strategy.name(),
                solved.before,
                &solved.solution,
                roundel::peak_memory(),
            ),
            repair: &solved.repair,
            faces: mesh.face_count(),
            vertices: mesh.vertex_count(),
            refined: solved.refined,
            quads: match solved.sizing {
                Sizing::Quads(quads) => Some(quads),
                _ => None,
            },
            edge_length: arguments.sizing.edge_length,
            feature_edges: solved.features.len(),
            short_features: solved.too_short,
            curves: solved.curves,
            irregular_vertices: map.cones().len(),
            cut_edges: map.transitions().len(),
            gradient_energy: map.energy(),
            flipped_before: untangled.flipped_before,
            flipped_stiffened: untangled.flipped_stiffened,
            flipped: map.flipped().len(),
            flipped_faces: map.flipped(),
            winding_defects: &untangled.winding_defects,
            untangle: Untangling {
                rounds: solved.rounds,
                refinements: solved.refinements,
                gradings: solved.gradings,
                steps: untangled.steps,
                seconds: solved.untangle_seconds,
                stuck_faces: untangled.stuck_faces.clone(),
                collapsed_edges: untangled.collapsed_edges.clone(),
            },
            field: Field {
                strategy: solved.field.strategy,
                file: file.map(|path| path.to_string_lossy().into_owned()),
                energy: solved.field.energy,
                seconds: solved.field.seconds,
            },
        }
    }
}
