//! The JSON object of quads.

use std::fmt;

use roundel::Solution;
use roundel::extract::QuadMesh;
use roundel::map::Sizing;
use roundel::mesh::vector::{norm, sub};
use roundel::smooth::QuadQuality;
use serde::Serialize;

use super::Arguments;
use super::faults::Faults;
use super::keep::KeptReport;
use super::mirrored::{Plane, planes};
use super::steps::Solved;
use crate::field::CurveCounts;
use crate::mesh::RepairCounts;
use crate::refinement::Refinement;
use crate::report::{Preparation, Report};
use crate::summary::{counted, telling_bound, telling_gap, thousands};

/// What `--json` prints of `roundel quad`: the solve of the map, and what came of it.
#[derive(Serialize)]
pub(super) struct QuadReport<'a> {
    #[serde(flatten)]
    solve: Report<'a>,
    repair: &'a RepairCounts,
    faces: usize,
    /// Where curves are followed.
    #[serde(skip_serializing_if = "Option::is_none")]
    curves: Option<CurveCounts>,
    #[serde(skip_serializing_if = "Option::is_none")]
    refined: Option<Refinement>,
    /// Where quads are mirrored: the planes.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    mirror: Vec<Plane>,
    field_irregular_vertices: usize,
    near_features: usize,
    paired_faces: usize,
    /// The number of sharp edges that are too short to be features.
    short_features: usize,
    flipped_before: usize,
    flipped: usize,
    missed_features: Vec<[usize; 2]>,
    /// Where a number of quads was asked for.
    #[serde(skip_serializing_if = "Option::is_none")]
    count: Option<CountReport>,
    /// Where it was asked for: the largest distance of the quads from the mesh, in its units and over the diagonal of
    /// its bounding box.
    #[serde(skip_serializing_if = "Option::is_none")]
    distance: Option<Distance>,
    /// Where quads are written with attributes.
    #[serde(skip_serializing_if = "Option::is_none")]
    kept: Option<KeptReport<'a>>,
    /// Why they are written without.
    #[serde(skip_serializing_if = "Option::is_none")]
    not_kept: Option<&'a str>,
    #[serde(flatten)]
    quads: QuadCounts,
    /// Where strategies are compared.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    compared: Vec<Compared>,
    phases: Phases,
}

/// How far quads are from the mesh.
#[derive(Serialize)]
pub(super) struct Distance {
    largest: f64,
    of_diagonal: f64,
}

impl Distance {
    pub(super) fn new(solved: &Solved) -> Option<Self> {
        let largest = solved.distance?;
        let [low, high] = solved.mesh.bounding_box();
        Some(Distance {
            largest,
            of_diagonal: largest / norm(sub(high, low)),
        })
    }
}

impl fmt::Display for Distance {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        let percent = 100.0 * self.of_diagonal;
        write!(
            f,
            "{:.3e} at most, {percent:.3} % of the diagonal",
            self.largest
        )
    }
}

/// How a number of quads was met.
#[derive(Serialize)]
struct CountReport {
    asked: usize,
    found: usize,
    maps: usize,
}

impl CountReport {
    fn new(solved: &Solved) -> Option<Self> {
        let Sizing::Quads(asked) = solved.options.sizing else {
            return None;
        };
        Some(CountReport {
            asked,
            found: solved.made.quads.quads.len(),
            maps: solved.made.maps_for_count,
        })
    }
}

/// What one strategy finds.
#[derive(Serialize)]
struct Compared {
    strategy: &'static str,
    field: Found,
    map: Found,
}

#[derive(Serialize)]
struct Found {
    status: &'static str,
    complete: bool,
    stopped_by: &'static str,
    energy: f64,
    lower_bound: Option<f64>,
    gap: Option<f64>,
    seconds: f64,
}

impl Compared {
    fn new(compared: &roundel::quad::Compared) -> Self {
        Compared {
            strategy: compared.strategy.name(),
            field: Found::new(&compared.field),
            map: Found::new(&compared.map),
        }
    }
}

impl Found {
    fn new(solution: &Solution) -> Self {
        Found {
            status: solution.status().name(),
            complete: solution.is_complete(),
            stopped_by: solution.stopped_by().name(),
            energy: solution.energy(),
            lower_bound: telling_bound(solution),
            gap: telling_gap(solution.gap()),
            seconds: solution.seconds().total,
        }
    }
}

/// Wall-clock seconds a phase, solve and all else.
#[derive(Serialize)]
struct Phases {
    read: f64,
    field: f64,
    map: f64,
    quads: f64,
    smooth: f64,
    compare: f64,
}

/// Counts and figures of quads.
#[derive(Serialize)]
pub struct QuadCounts {
    quads: usize,
    other_faces: usize,
    vertices: usize,
    irregular_vertices: usize,
    euler_characteristic: i64,
    expected_euler_characteristic: i64,
    boundary_edges: usize,
    bad_edges: usize,
    degenerate_faces: usize,
    partial_cells: usize,
    unfolded_points: usize,
    repairs: usize,
    conforming: bool,
    /// None of quads that conform.
    faults: Option<Faults>,
    mean_angle_deviation: f64,
    scaled_jacobian_p1: f64,
    scaled_jacobian_min: f64,
    inverted: usize,
    edge_length_spread: f64,
}

impl QuadCounts {
    /// The counts of these quads.
    pub fn new(quads: &QuadMesh) -> Self {
        let (figures, quality) = (quads.figures(), QuadQuality::new(quads));
        QuadCounts {
            quads: quads.quads.len(),
            other_faces: quads.others.len(),
            vertices: quads.vertices.len(),
            irregular_vertices: figures.irregular,
            euler_characteristic: figures.euler,
            expected_euler_characteristic: quads.expected_euler,
            boundary_edges: figures.boundary_edges,
            bad_edges: figures.bad_edges,
            degenerate_faces: figures.degenerate,
            partial_cells: quads.partial_cells,
            unfolded_points: quads.folds_removed,
            repairs: quads.repaired,
            conforming: quads.is_conforming(),
            faults: Faults::of(quads),
            mean_angle_deviation: quality.angle_deviation,
            scaled_jacobian_p1: quality.scaled_jacobian_p1,
            scaled_jacobian_min: quality.scaled_jacobian_min,
            inverted: quality.inverted,
            edge_length_spread: quality.edge_spread,
        }
    }
}

impl<'a> QuadReport<'a> {
    /// The report of what was found.
    pub(super) fn new(arguments: &Arguments, solved: &'a Solved) -> Self {
        let (made, seconds) = (&solved.made, solved.made.seconds);
        let missed = made.missed_features.iter();
        QuadReport {
            solve: Report::new(
                &arguments.mesh,
                solved.options.map.strategy.name(),
                Preparation {
                    read: solved.read_seconds,
                    assemble: None,
                },
                &made.solution,
                roundel::peak_memory(),
            ),
            repair: &solved.repair,
            faces: solved.mesh.face_count(),
            curves: solved.curves,
            refined: made.refined.as_ref().map(Refinement::new),
            mirror: made.mirrored.as_ref().map(planes).unwrap_or_default(),
            field_irregular_vertices: made.untangled.map.cones().len(),
            near_features: made.near_features,
            paired_faces: made.paired.len(),
            short_features: solved.too_short,
            flipped_before: made.untangled.flipped_before,
            flipped: made.untangled.flipped_after,
            missed_features: missed.map(|&e| solved.mesh.edge(e).vertices).collect(),
            count: CountReport::new(solved),
            distance: Distance::new(solved),
            kept: KeptReport::new(&solved.kept),
            not_kept: solved.kept.refused.as_deref(),
            quads: QuadCounts::new(&made.quads),
            compared: made.compared.iter().map(Compared::new).collect(),
            phases: Phases {
                read: solved.read_seconds,
                field: seconds.field,
                map: seconds.map,
                quads: seconds.extract,
                smooth: seconds.smooth,
                compare: seconds.compare,
            },
        }
    }
}

/// One line on quads for people: how many, how regular, whether whole.
pub fn words(quads: &QuadMesh) -> String {
    let figures = quads.figures();
    let mut text = format!(
        "{}, {} irregular",
        counted(quads.quads.len(), "quad"),
        thousands(figures.irregular)
    );
    if !quads.others.is_empty() {
        text += &format!(", {}", counted(quads.others.len(), "other face"));
    }
    text += &match (quads.is_conforming(), figures.boundary_edges) {
        (true, 0) => String::from(", watertight"),
        (true, edges) => format!(", {}", counted(edges, "boundary edge")),
        (false, _) if figures.bad_edges + figures.degenerate > 0 => format!(
            ", {}, {}",
            counted(figures.bad_edges, "bad edge"),
            counted(figures.degenerate, "degenerate face")
        ),
        (false, _) => format!(
            ", Euler characteristic {}, not {}",
            figures.euler, quads.expected_euler
        ),
    };
    text
}
