//! Where each vertex may go: over the surface, along a curve on it, or nowhere.

use crate::mesh::vector::{Vec3, dot, normalize, sub};
use crate::mesh::{ClosestPoint, TriangleMesh};
use crate::quad::{Origin, QuadMesh};

/// What a vertex is bound to.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Bond {
    Surface,
    Curve,
    Fixed,
}

/// The surface with its curves: boundary and features.
pub(super) struct Surface {
    faces: ClosestPoint,
    curves: ClosestPoint,
    bonds: Vec<Bond>,
    /// The triangle or segment where each vertex was found last.
    hints: Vec<Option<usize>>,
    fixed: Vec<Vec3>,
}

impl Surface {
    pub(super) fn new(quads: &QuadMesh, mesh: &TriangleMesh, features: &[usize]) -> Self {
        let mut is_curve: Vec<bool> = mesh.edges().map(|edge| edge.second.is_none()).collect();
        for &edge in features {
            is_curve[edge] = true;
        }
        let segments = mesh
            .edges()
            .zip(&is_curve)
            .filter(|(_, is_curve)| **is_curve);
        let segments = segments.map(|(edge, _)| {
            let [a, b] = edge.vertices.map(|v| mesh.position(v));
            [a, b, b]
        });
        let is_corner = corners(mesh, &is_curve);
        let bond = |origin: &Origin| bond(mesh, &is_curve, &is_corner, origin);
        Surface {
            faces: ClosestPoint::new(mesh),
            curves: ClosestPoint::of_triangles(segments.collect()),
            bonds: quads.origins.iter().map(bond).collect(),
            hints: quads.origins.iter().map(|_| None).collect(),
            fixed: quads.vertices.clone(),
        }
    }

    /// Where a vertex goes that is wanted at `p`.
    pub(super) fn project(&mut self, vertex: usize, p: Vec3) -> Vec3 {
        let tree = match self.bonds[vertex] {
            Bond::Surface => &self.faces,
            Bond::Curve => &self.curves,
            Bond::Fixed => return self.fixed[vertex],
        };
        let Some((hint, point)) = tree.find(p, self.hints[vertex]) else {
            return self.fixed[vertex];
        };
        self.hints[vertex] = Some(hint);
        point
    }
}

/// Vertices where curves end, meet or turn by more than 45 degrees.
fn corners(mesh: &TriangleMesh, is_curve: &[bool]) -> Vec<bool> {
    const STRAIGHT: f64 = std::f64::consts::FRAC_1_SQRT_2;
    let mut along: Vec<Vec<Vec3>> = vec![Vec::new(); mesh.vertex_count()];
    for (edge, _) in mesh
        .edges()
        .zip(is_curve)
        .filter(|(_, is_curve)| **is_curve)
    {
        let [a, b] = edge.vertices;
        let [p, q] = edge.vertices.map(|v| mesh.position(v));
        along[a].push(normalize(sub(q, p)));
        along[b].push(normalize(sub(p, q)));
    }
    let is_corner = |arms: &Vec<Vec3>| match arms.as_slice() {
        [] => false,
        [a, b] => -dot(*a, *b) < STRAIGHT,
        _ => true,
    };
    along.iter().map(is_corner).collect()
}

fn bond(mesh: &TriangleMesh, is_curve: &[bool], is_corner: &[bool], origin: &Origin) -> Bond {
    let of_vertex = |v: usize| {
        let on_curve = mesh.ring(v).any(|(f, k)| {
            [k, (k + 2) % 3]
                .into_iter()
                .any(|edge| is_curve[mesh.edge_of(f, edge)])
        });
        match (is_corner[v], on_curve) {
            (true, _) => Bond::Fixed,
            (_, true) => Bond::Curve,
            _ => Bond::Surface,
        }
    };
    match *origin {
        Origin::Vertex(v) => of_vertex(v),
        Origin::Middle => Bond::Surface,
        Origin::Face(face, at) => {
            let corners = mesh.corners(face);
            if let Some(k) = (0..3).find(|&k| at[k] == 1.0) {
                return of_vertex(corners[k]);
            }
            // On the edge opposite to a corner that it has no part of.
            let on_curve = |k: usize| at[k] == 0.0 && is_curve[mesh.edge_of(face, (k + 1) % 3)];
            match (0..3).any(on_curve) {
                true => Bond::Curve,
                false => Bond::Surface,
            }
        }
    }
}
