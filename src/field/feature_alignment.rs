//! Crosses aligned to feature edges, as constraints on the faces beside them.
//!
//! A face beside one feature edge has an arm along it (`bommes2009`, section 4.2). The wedge of
//! faces between two feature edges at a vertex becomes a whole number of quads, the nearest to its
//! angle. That number must not be 0, which would collapse the faces in a map. The faces of a wedge
//! of less than half a right angle are therefore turned, evenly from its first edge to its last,
//! until one quad fits in. The same holds for a face between two feature edges whatever its angle,
//! since in a single triangle each coordinate can follow only one of them.

use std::f64::consts::{FRAC_PI_2, FRAC_PI_4};

use super::Constraint;
use crate::error::Result;
use crate::mesh::TriangleMesh;
use crate::mesh::features::FeatureGraph;

/// The directions of all faces at feature edges, in increasing order of faces.
///
/// A face with one feature edge follows that edge. In a wedge of less than 45 degrees between feature
/// edges, and in a face with two of them, directions turn evenly from one edge to the other. Where
/// narrow wedges overlap, that at the lowest vertex comes first. A face between three feature edges
/// follows the two shortest: no cross follows them all.
///
/// # Errors
/// [`Error::LengthMismatch`](crate::error::Error::LengthMismatch) for features of another mesh.
pub fn feature_constraints(
    mesh: &TriangleMesh,
    features: &FeatureGraph,
) -> Result<Vec<Constraint>> {
    features.check_mesh(mesh)?;
    let features = &features.with_two_of_each_face(mesh);
    let mut along = vec![None; mesh.face_count()];
    for (face, along) in along.iter_mut().enumerate() {
        let sides = (0..3).filter(|&k| features.contains(mesh.edge_of(face, k)));
        if let [k] = sides.collect::<Vec<_>>()[..] {
            *along = Some(mesh.edge_angle(face, k));
        }
    }
    let mut turned = vec![None; mesh.face_count()];
    let (mut single, mut narrow) = (Vec::new(), Vec::new());
    for v in (0..mesh.vertex_count()).filter(|&v| features.degree(v) > 1) {
        for wedge in wedges(mesh, features, v) {
            match wedge.corners.len() {
                1 => single.push(wedge),
                _ if wedge.angle < FRAC_PI_4 => narrow.push(wedge),
                _ => {}
            }
        }
    }
    for wedge in single.into_iter().chain(narrow) {
        wedge.turn(mesh, &mut turned);
    }
    let constraint = |face: usize| {
        let angle = turned[face].or(along[face])?;
        Some(Constraint { face, angle })
    };
    Ok((0..mesh.face_count()).filter_map(constraint).collect())
}

/// Directions for fields of other symmetries, which have no quads to keep from collapsing: along
/// the first local edge that is a feature.
pub(super) fn edge_constraints(
    mesh: &TriangleMesh,
    features: &FeatureGraph,
) -> Result<Vec<Constraint>> {
    features.check_mesh(mesh)?;
    let constraint = |face: usize| {
        let k = (0..3).find(|&k| features.contains(mesh.edge_of(face, k)))?;
        let angle = mesh.edge_angle(face, k);
        Some(Constraint { face, angle })
    };
    Ok((0..mesh.face_count()).filter_map(constraint).collect())
}

/// The faces between two feature edges that follow each other around a vertex.
struct Wedge {
    /// (face, corner), counter-clockwise.
    corners: Vec<(usize, usize)>,
    angle: f64,
}

impl Wedge {
    /// Gives the faces that have none the directions that make the wedge one quarter turn.
    fn turn(&self, mesh: &TriangleMesh, directions: &mut [Option<f64>]) {
        let missing = FRAC_PI_2 - self.angle;
        let steps = self.corners.len() as f64;
        let mut passed = 0.0;
        for (i, &(face, corner)) in self.corners.iter().enumerate() {
            let first_edge = mesh.edge_angle(face, corner) - passed;
            let turn = -missing * (i as f64 + 0.5) / steps;
            directions[face].get_or_insert(first_edge + turn);
            passed += mesh.angle(face, corner);
        }
    }
}

/// The wedges of a vertex, at the boundary only those between two feature edges.
fn wedges(mesh: &TriangleMesh, features: &FeatureGraph, vertex: usize) -> Vec<Wedge> {
    let is_feature = |face: usize, k: usize| features.contains(mesh.edge_of(face, k));
    let mut ring: Vec<(usize, usize)> = mesh.ring(vertex).collect();
    let first = ring
        .iter()
        .position(|&(face, corner)| is_feature(face, corner));
    let Some(first) = first else {
        return Vec::new();
    };
    if mesh.is_boundary_vertex(vertex) {
        ring.drain(..first);
    } else {
        ring.rotate_left(first);
    }
    let mut wedges = Vec::new();
    let mut open = Wedge {
        corners: Vec::new(),
        angle: 0.0,
    };
    for (face, corner) in ring {
        open.corners.push((face, corner));
        open.angle += mesh.angle(face, corner);
        if is_feature(face, (corner + 2) % 3) {
            let next = Wedge {
                corners: Vec::new(),
                angle: 0.0,
            };
            wedges.push(std::mem::replace(&mut open, next));
        }
    }
    wedges
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_face_between_three_features_follows_its_two_shortest() {
        let points = vec![[0.0; 3], [2.0, 0.0, 0.0], [0.0, 1.0, 0.0]];
        let mesh = TriangleMesh::new(points, vec![[0, 1, 2]]).unwrap();
        let constraints = feature_constraints(&mesh, &FeatureGraph::boundary(&mesh)).unwrap();
        let [Constraint { face: 0, angle }] = constraints[..] else {
            panic!("{constraints:?}");
        };
        let quarters = angle / FRAC_PI_2;
        assert!((quarters - quarters.round()).abs() < 1e-12, "{angle}");
    }
}
