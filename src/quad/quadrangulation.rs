//! What comes of a mesh: quads, the field and the map that they are from, and what each step took.

use std::time::Instant;

use super::Compared;
use crate::error::Result;
use crate::extract::QuadMesh;
use crate::field::OrientationField;
use crate::solve::Solution;
use crate::untangle::Untangled;

/// Quads, and how they were come by.
#[derive(Debug)]
pub struct Quadrangulation {
    /// The quads, smoothed if that was asked for.
    pub quads: QuadMesh,
    /// The field that they follow.
    pub field: OrientationField,
    /// The solution of the field's problem.
    pub field_solution: Solution,
    /// The map that they were extracted from.
    pub untangled: Untangled,
    /// The solution of the map's problem.
    pub solution: Solution,
    /// Edges of the mesh that edges of quads follow, in increasing order.
    pub features: Vec<usize>,
    /// Those of them that no edge of a quad runs along: collapsed or folded by the map.
    pub missed_features: Vec<usize>,
    /// What other strategies make of both problems, where that was asked for.
    pub compared: Vec<Compared>,
    /// What each step took.
    pub seconds: QuadSeconds,
}

/// Wall-clock seconds a step.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct QuadSeconds {
    /// The field's problem and its solution.
    pub field: f64,
    /// The map's problem and its solution.
    pub map: f64,
    /// Extraction, and untangling where it was needed.
    pub extract: f64,
    /// Smoothing.
    pub smooth: f64,
    /// The solves that are compared.
    pub compare: f64,
}

/// Adds the seconds that a step takes.
pub(super) fn timed<T>(seconds: &mut f64, step: impl FnOnce() -> Result<T>) -> Result<T> {
    let started = Instant::now();
    let result = step();
    *seconds += started.elapsed().as_secs_f64();
    result
}
