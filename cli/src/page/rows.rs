//! Rows that pages of different commands share.

use std::collections::BTreeMap;

use roundel::extract::QuadMesh;
use roundel::mesh::TriangleMesh;
use roundel::smooth::QuadQuality;
use roundel::{Solution, Strategy};

use crate::changes::Changes;
use crate::summary::{outcome, telling_gap, thousands};

/// Names and values.
pub type Rows = Vec<(&'static str, String)>;

/// The counts of a mesh that was given, and what repair did.
pub fn mesh_rows(mesh: &TriangleMesh, changes: &Changes) -> Rows {
    let euler = mesh.euler_characteristic().to_string();
    let mut rows = vec![
        ("triangles", thousands(mesh.face_count())),
        ("vertices", thousands(mesh.vertex_count())),
        ("edges", thousands(mesh.edge_count())),
        ("boundary loops", thousands(mesh.boundary_loops().len())),
        ("components", thousands(mesh.components().count)),
        ("Euler characteristic", euler),
    ];
    let repaired: Vec<&str> = changes.iter().map(|change| &*change.words).collect();
    if !repaired.is_empty() {
        rows.push(("repaired", repaired.join(", ")));
    }
    rows
}

/// The counts and the quality of quads.
pub fn quad_rows(quads: &QuadMesh) -> Rows {
    let (figures, quality) = (quads.figures(), QuadQuality::new(quads));
    let conforming = if quads.is_conforming() { "yes" } else { "no" };
    vec![
        ("quads", thousands(quads.quads.len())),
        ("other faces", thousands(quads.others.len())),
        ("vertices", thousands(quads.vertices.len())),
        ("irregular vertices", thousands(figures.irregular)),
        ("conforming", conforming.into()),
        ("Euler characteristic", figures.euler.to_string()),
        (
            "mean deviation from right angles",
            format!("{:.2}°", quality.angle_deviation),
        ),
        (
            "scaled Jacobian, 1st percentile",
            format!("{:.3}", quality.scaled_jacobian_p1),
        ),
        (
            "scaled Jacobian, least",
            format!("{:.3}", quality.scaled_jacobian_min),
        ),
        ("quads turned over", thousands(quality.inverted)),
        (
            "spread of edge lengths",
            format!("{:.1} %", 100.0 * quality.edge_spread),
        ),
    ]
}

/// How a solve ended. A bound that says nothing is left out.
pub fn solve_rows(strategy: Strategy, solution: &Solution) -> Rows {
    let counts = solution.counts();
    let mut rows = vec![
        ("strategy", strategy.name().into()),
        ("outcome", outcome(solution)),
        ("energy", format!("{:.6}", solution.energy())),
    ];
    if telling_gap(solution.gap()).is_some() {
        rows.push(("lower bound", bound(solution)));
        rows.push(("gap", gap(solution)));
    }
    rows.extend([
        ("unknowns", thousands(counts.variables)),
        ("integers", thousands(counts.integers)),
        (
            "integers after elimination",
            thousands(counts.reduced_integers),
        ),
    ]);
    rows
}

/// The seconds of steps, without those that were not taken.
pub fn seconds_rows(steps: &[(&str, f64)]) -> Vec<(String, f64, String)> {
    let taken = steps.iter().filter(|&&(_, seconds)| seconds > 0.0);
    taken
        .map(|&(name, seconds)| (name.into(), seconds, format!("{seconds:.3}")))
        .collect()
}

/// How many vertices have how many edges.
pub fn valences(quads: &QuadMesh) -> Vec<(String, f64, String)> {
    let mut edges: Vec<[u32; 2]> = Vec::new();
    for face in quads.faces() {
        let ends = face.iter().zip(face.iter().cycle().skip(1));
        edges.extend(ends.map(|(&a, &b)| [a.min(b), a.max(b)]));
    }
    edges.sort_unstable();
    edges.dedup();
    let mut valence = vec![0; quads.vertices.len()];
    for &v in edges.as_flattened() {
        valence[v as usize] += 1;
    }
    histogram(&valence)
}

/// How often each number occurs, without 0.
pub fn histogram(numbers: &[usize]) -> Vec<(String, f64, String)> {
    let mut counts = BTreeMap::new();
    for &number in numbers.iter().filter(|&&number| number > 0) {
        *counts.entry(number).or_insert(0) += 1;
    }
    let row = |(number, count): (usize, usize)| (thousands(number), count as f64, thousands(count));
    counts.into_iter().map(row).collect()
}

/// The lower bound, if it says something.
pub fn bound(solution: &Solution) -> String {
    let telling = telling_gap(solution.gap()).and(solution.lower_bound());
    telling.map_or_else(|| "none".into(), |bound| format!("{bound:.4}"))
}

/// The gap, if it says something.
pub fn gap(solution: &Solution) -> String {
    let gap = telling_gap(solution.gap());
    gap.map_or_else(|| "none".into(), |gap| format!("{:.4} %", 100.0 * gap))
}
