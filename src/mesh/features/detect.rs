//! Feature edges found on the surface: sharp edges and the boundary.

use std::f64::consts::PI;

use super::FeatureGraph;
use crate::error::{Error, Result};
use crate::mesh::TriangleMesh;
use crate::mesh::vector::{cross, dot, norm};

impl FeatureGraph {
    /// The edges at which the normals of the two faces differ by `angle` radians or more; the
    /// boundary is not among them.
    ///
    /// # Errors
    /// [`Error::InvalidArgument`] for an angle that is not above 0 and at most pi.
    pub fn by_angle(mesh: &TriangleMesh, angle: f64) -> Result<Self> {
        check(angle)?;
        let is_sharp = (0..mesh.edge_count()).map(|e| turn(mesh, e).is_some_and(|t| t >= angle));
        Ok(Self::of(mesh, is_sharp.collect()))
    }

    /// Adds the sharp edges ([`by_angle`](Self::by_angle)) to the graph, but at most two edges of each
    /// face, as quads cannot follow three edges of one triangle: the sharp edge at which the surface
    /// turns least is left out.
    ///
    /// # Errors
    /// [`Error::LengthMismatch`] for another mesh, and those of [`by_angle`](Self::by_angle).
    pub fn with_sharp(self, mesh: &TriangleMesh, angle: f64) -> Result<Self> {
        self.check_mesh(mesh)?;
        check(angle)?;
        let mut is_feature = self.is_feature;
        let mut found: Vec<(f64, usize)> = Vec::new();
        for e in (0..mesh.edge_count()).filter(|&e| !is_feature[e]) {
            found.extend(turn(mesh, e).filter(|&t| t >= angle).map(|t| (t, e)));
        }
        found.iter().for_each(|&(_, e)| is_feature[e] = true);
        found.sort_unstable_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
        // Edges that open two faces first: fewer are left out.
        for wanted in [2, 1] {
            for &(_, e) in &found {
                let edge = mesh.edge(e);
                let faces = edge.second.into_iter().chain([edge.first]);
                let is_enclosed =
                    |&(face, _): &_| (0..3).all(|k| is_feature[mesh.edge_of(face, k)]);
                if faces.filter(is_enclosed).count() >= wanted {
                    is_feature[e] = false;
                }
            }
        }
        Ok(Self::of(mesh, is_feature))
    }

    /// The graph without the longest edge of each face between three features: quads follow the other
    /// two, which enclose the largest angle.
    pub(crate) fn with_two_of_each_face(&self, mesh: &TriangleMesh) -> Self {
        if self.curves.is_empty() {
            return self.clone();
        }
        let mut is_feature = self.is_feature.clone();
        for face in 0..mesh.face_count() {
            if (0..3).all(|k| is_feature[mesh.edge_of(face, k)]) {
                let longer = |&a: &usize, &b: &usize| {
                    let [a, b] = [a, b].map(|k| mesh.edge_length(face, k));
                    // The first of equal edges.
                    a.total_cmp(&b).then(std::cmp::Ordering::Greater)
                };
                let longest = (0..3).max_by(longer).unwrap_or(0);
                is_feature[mesh.edge_of(face, longest)] = false;
            }
        }
        Self::of(mesh, is_feature)
    }

    /// The edges with a single face.
    pub fn boundary(mesh: &TriangleMesh) -> Self {
        Self::of(mesh, mesh.edges().map(|e| e.second.is_none()).collect())
    }
}

fn check(angle: f64) -> Result<()> {
    match angle > 0.0 && angle <= PI {
        true => Ok(()),
        false => Err(Error::InvalidArgument {
            what: format!("the feature angle is {angle}; it must be above 0 and at most pi"),
            index: None,
        }),
    }
}

/// By how much the normals of the two faces of an edge differ.
pub(super) fn turn(mesh: &TriangleMesh, edge: usize) -> Option<f64> {
    let edge = mesh.edge(edge);
    let [m, n] = [edge.first.0, edge.second?.0].map(|face| mesh.normal(face));
    Some(norm(cross(m, n)).atan2(dot(m, n)))
}
