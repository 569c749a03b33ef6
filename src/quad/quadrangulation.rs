//! The result for a mesh: quads, the field and map that they are from, and the time of each step.

use std::time::Instant;

use super::{Compared, Mirrored};
use crate::error::Result;
use crate::extract::QuadMesh;
use crate::field::OrientationField;
use crate::mesh::TriangleMesh;
use crate::mesh::refine::Refined;
use crate::solve::Solution;
use crate::untangle::Untangled;

/// Quads, and the results of the steps before them.
///
/// If neighbouring faces of a large mesh are far apart in memory, the steps use the same mesh in another order. Elements
/// that are named here are still those of the mesh that was given. Only the unknowns of the solutions are numbered as in
/// that order.
#[derive(Debug)]
pub struct Quadrangulation {
    /// The quads, smoothed if the options ask for it.
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
    /// The [least length](crate::field::Guidance::feature_length) of a curve of sharp edges among them. It is longer
    /// than that of the guidance if quads along shorter curves did not conform.
    pub feature_length: Option<f64>,
    /// Those of these edges that no edge of a quad follows, because the map collapses or folds them.
    pub missed_features: Vec<usize>,
    /// The number of irregular vertices of the field that lie nearer to features than the
    /// [clearance](crate::field::Guidance::clearance), and not on them: those that features alone decide.
    pub near_features: usize,
    /// The solutions of other strategies for both problems, if the options ask for them.
    pub compared: Vec<Compared>,
    /// The time of each step.
    pub seconds: QuadSeconds,
    /// The refined mesh, if the mesh was refined first. Then field and map are its field and map; features,
    /// and the origins of the quads, are those of the mesh that was given.
    pub refined: Option<Refined>,
    /// The part of the mesh that the quads were made of, if they are mirrored. The field and the map are
    /// then those of the part; features, origins and other elements are those of the mesh that was given. Of a part
    /// that was refined, the origins of the refined mesh name elements of the part.
    pub mirrored: Option<Mirrored>,
    /// The faces of the mesh that was given whose components were tried alone, in increasing order. Their
    /// quads follow fields and maps of their own, and not those above.
    pub apart: Vec<usize>,
    /// Those of the faces of the mesh that was given whose quads are pairs of triangles, because no map had good ones,
    /// in increasing order.
    pub paired: Vec<usize>,
    /// The number of maps at other scales that were solved for to meet the number of quads.
    pub maps_for_count: usize,
}

impl Quadrangulation {
    /// The mesh that the field and the map belong to: the refined one, the part that is mirrored, or the one
    /// that was given.
    pub fn mesh<'a>(&'a self, given: &'a TriangleMesh) -> &'a TriangleMesh {
        match (&self.refined, &self.mirrored) {
            (Some(refined), _) => &refined.mesh,
            (None, Some(mirrored)) => &mirrored.half.mesh,
            (None, None) => given,
        }
    }

    /// The face of the given mesh of which a face of [`mesh`](Self::mesh) is a part.
    pub fn face_of_given(&self, face: usize) -> usize {
        let of_part = match &self.refined {
            Some(refined) => refined.face_origin[face] as usize,
            None => face,
        };
        match &self.mirrored {
            Some(mirrored) => mirrored.half.face_origin[of_part] as usize,
            None => of_part,
        }
    }
}

/// Wall-clock seconds of each step.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct QuadSeconds {
    /// Refinement, where the mesh needs it.
    pub refine: f64,
    /// The field's problem and its solution.
    pub field: f64,
    /// The map's problem and its solution.
    pub map: f64,
    /// Extraction, and untangling where it was needed.
    pub extract: f64,
    /// Smoothing.
    pub smooth: f64,
    /// The solves for comparison.
    pub compare: f64,
}

/// Adds the seconds that a step takes.
pub(super) fn timed<T>(seconds: &mut f64, step: impl FnOnce() -> Result<T>) -> Result<T> {
    let started = Instant::now();
    let result = step();
    *seconds += started.elapsed().as_secs_f64();
    result
}
