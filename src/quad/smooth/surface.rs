//! Where each vertex may go: over the surface, along a curve on it, or nowhere.

use crate::mesh::vector::{Vec3, dot, normalize, sub};
use crate::mesh::{ClosestPoint, TriangleMesh};
use crate::quad::{Origin, QuadMesh};

/// What a vertex is bound to.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Bond {
    Surface,
    /// The curve of this number.
    Curve(u32),
    Fixed,
}

/// The surface with its curves: boundary and features.
pub(super) struct Surface {
    faces: ClosestPoint,
    /// Each by itself: curves may be closer to each other than vertices are.
    curves: Vec<ClosestPoint>,
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
        let is_corner = corners(mesh, &is_curve);
        let curve = curves(mesh, &is_curve, &is_corner);
        let count = curve.iter().flatten().max().map_or(0, |&last| last + 1);
        let mut segments = vec![Vec::new(); count as usize];
        for (edge, number) in mesh.edges().zip(&curve) {
            if let Some(number) = number {
                let [a, b] = edge.vertices.map(|v| mesh.position(v));
                segments[*number as usize].push([a, b, b]);
            }
        }
        let bond = |origin: &Origin| bond(mesh, &curve, &is_corner, origin);
        Surface {
            faces: ClosestPoint::new(mesh),
            curves: segments
                .into_iter()
                .map(ClosestPoint::of_triangles)
                .collect(),
            bonds: quads.origins.iter().map(bond).collect(),
            hints: quads.origins.iter().map(|_| None).collect(),
            fixed: quads.vertices.clone(),
        }
    }

    /// Where a vertex goes that is wanted at `p`.
    pub(super) fn project(&mut self, vertex: usize, p: Vec3) -> Vec3 {
        let tree = match self.bonds[vertex] {
            Bond::Surface => &self.faces,
            Bond::Curve(number) => &self.curves[number as usize],
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

/// The number of the curve that each edge is part of: curves end at corners.
fn curves(mesh: &TriangleMesh, is_curve: &[bool], is_corner: &[bool]) -> Vec<Option<u32>> {
    let mut at: Vec<Vec<usize>> = vec![Vec::new(); mesh.vertex_count()];
    for (e, edge) in mesh.edges().enumerate().filter(|&(e, _)| is_curve[e]) {
        edge.vertices.iter().for_each(|&v| at[v].push(e));
    }
    let mut number = vec![None; is_curve.len()];
    let mut count = 0;
    for first in (0..is_curve.len()).filter(|&e| is_curve[e]) {
        if number[first].is_some() {
            continue;
        }
        number[first] = Some(count);
        let mut open = vec![first];
        while let Some(e) = open.pop() {
            let ends = mesh.edge(e).vertices.into_iter();
            for &next in ends.filter(|&v| !is_corner[v]).flat_map(|v| &at[v]) {
                if number[next].is_none() {
                    number[next] = Some(count);
                    open.push(next);
                }
            }
        }
        count += 1;
    }
    number
}

fn bond(mesh: &TriangleMesh, curve: &[Option<u32>], is_corner: &[bool], origin: &Origin) -> Bond {
    let on = |number: Option<u32>| number.map_or(Bond::Surface, Bond::Curve);
    let of_vertex = |v: usize| {
        if is_corner[v] {
            return Bond::Fixed;
        }
        let mut sides = mesh.ring(v).flat_map(|(f, k)| [(f, k), (f, (k + 2) % 3)]);
        on(sides.find_map(|(f, k)| curve[mesh.edge_of(f, k)]))
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
            let opposite = |k: usize| curve[mesh.edge_of(face, (k + 1) % 3)];
            on((0..3).filter(|&k| at[k] == 0.0).find_map(opposite))
        }
    }
}
