//! The constraint of each vertex: to the surface, to a curve on it, or to a point.

use super::curve::Curve;
use crate::extract::{Origin, QuadMesh};
use crate::mesh::features::FeatureGraph;
use crate::mesh::vector::Vec3;
use crate::mesh::{ClosestPoint, TriangleMesh};

/// The constraint of a vertex.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Bond {
    Surface,
    /// The curve of this number.
    Curve(u32),
    Fixed,
}

/// The surface with its curves: boundary and features.
pub(super) struct Surface {
    faces: ClosestPoint,
    /// The curves, each with its own search tree: curves may be closer to each other than vertices are.
    pub(super) curves: Vec<Curve>,
    pub(super) bonds: Vec<Bond>,
    /// The vertex of the mesh at which each fixed vertex lies, where curves end, meet or turn.
    pub(super) node: Vec<Option<usize>>,
    /// The triangle or segment in which each vertex was last found.
    hints: Vec<Option<usize>>,
    pub(super) fixed: Vec<Vec3>,
}

impl Surface {
    pub(super) fn new(quads: &QuadMesh, mesh: &TriangleMesh, features: &FeatureGraph) -> Self {
        let mut on = vec![Bond::Surface; mesh.edge_count()];
        for (number, curve) in features.curves().iter().enumerate() {
            for &edge in &curve.edges {
                on[edge] = Bond::Curve(number as u32);
            }
        }
        let mut is_node = vec![false; mesh.vertex_count()];
        for &v in features.corners().iter().chain(features.open_ends()) {
            is_node[v] = true;
        }
        let place = |origin: &Origin| place(mesh, &on, &is_node, origin);
        let (bonds, node) = quads.origins.iter().map(place).unzip();
        let curve = |curve| Curve::new(mesh, curve);
        Surface {
            faces: ClosestPoint::new(mesh),
            curves: features.curves().iter().map(curve).collect(),
            bonds,
            node,
            hints: quads.origins.iter().map(|_| None).collect(),
            fixed: quads.vertices.clone(),
        }
    }

    /// The point nearest to `p` that satisfies the constraint of the vertex.
    pub(super) fn project(&mut self, vertex: usize, p: Vec3) -> Vec3 {
        let hint = self.hints[vertex];
        let found = match self.bonds[vertex] {
            Bond::Surface => self.faces.find(p, hint),
            Bond::Curve(number) => self.curves[number as usize].closest(p, hint),
            Bond::Fixed => None,
        };
        let Some((hint, point)) = found else {
            return self.fixed[vertex];
        };
        self.hints[vertex] = Some(hint);
        point
    }
}

/// The constraint of a vertex with this origin, and the node at which it is fixed.
fn place(
    mesh: &TriangleMesh,
    on: &[Bond],
    is_node: &[bool],
    origin: &Origin,
) -> (Bond, Option<usize>) {
    let of_vertex = |v: usize| {
        if is_node[v] {
            return (Bond::Fixed, Some(v));
        }
        let mut sides = mesh.ring(v).flat_map(|(f, k)| [(f, k), (f, (k + 2) % 3)]);
        let bond = sides.find_map(|(f, k)| curve(on[mesh.edge_of(f, k)]));
        (bond.unwrap_or(Bond::Surface), None)
    };
    match *origin {
        Origin::Vertex(v) => of_vertex(v),
        Origin::Middle => (Bond::Surface, None),
        Origin::Face(face, at) => {
            let corners = mesh.corners(face);
            if let Some(k) = (0..3).find(|&k| at[k] == 1.0) {
                return of_vertex(corners[k]);
            }
            // A vertex whose weight of a corner is zero lies on the edge opposite to that corner.
            let opposite = |k: usize| curve(on[mesh.edge_of(face, (k + 1) % 3)]);
            let bond = (0..3).filter(|&k| at[k] == 0.0).find_map(opposite);
            (bond.unwrap_or(Bond::Surface), None)
        }
    }
}

fn curve(bond: Bond) -> Option<Bond> {
    (bond != Bond::Surface).then_some(bond)
}
