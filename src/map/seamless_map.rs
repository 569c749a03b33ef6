//! A seamless map, and its energy measured on the mesh.

use super::SeamlessProblem;
use crate::linalg::CompensatedSum;
use crate::mesh::vector::{Vec3, add, cross, dot, scale, sub};
use crate::mesh::{TriangleMesh, orientation, turned};
use crate::{Error, Result};

/// How coordinates change over one cut edge, from its first to its second face.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Transition {
    /// The edge of the mesh.
    pub edge: usize,
    /// Quarter turns counter-clockwise, 0 to 3.
    pub quarters: u8,
    /// What is added after the turn. Integers, except after a relaxation.
    pub translation: [f64; 2],
}

impl Transition {
    /// The coordinates of the second face for those of the first.
    pub fn apply(&self, uv: [f64; 2]) -> [f64; 2] {
        let turned = turned(self.quarters, uv);
        [0, 1].map(|axis| turned[axis] + self.translation[axis])
    }
}

/// Coordinates on a cut surface that turn by quarters and shift by integers over the cut.
#[derive(Debug, Clone, PartialEq)]
pub struct SeamlessMap {
    /// Of all unknowns of the problem, the coordinates first.
    values: Vec<f64>,
    coordinates: usize,
    copies: Vec<[u32; 3]>,
    transitions: Vec<Transition>,
    cones: Vec<usize>,
    flipped: Vec<usize>,
    energy: f64,
}

impl SeamlessMap {
    pub(crate) fn new(
        problem: &SeamlessProblem,
        mesh: &TriangleMesh,
        values: &[f64],
    ) -> Result<Self> {
        let expected = problem.translation(problem.seams.len());
        if values.len() != expected {
            return Err(Error::LengthMismatch {
                what: "the solution of the parametrization",
                expected,
                actual: values.len(),
            });
        }
        let mut map = SeamlessMap {
            values: values.to_vec(),
            coordinates: 2 * problem.sectors.count(),
            copies: problem.sectors.copy.clone(),
            transitions: transitions(problem, mesh, values),
            cones: problem.cones.clone(),
            flipped: Vec::new(),
            energy: 0.0,
        };
        map.flipped = (0..mesh.face_count())
            .filter(|&face| orientation(map.uv(face)) <= 0.0)
            .collect();
        map.energy = energy(problem, mesh, &map);
        Ok(map)
    }

    /// The coordinates of the corners of a face.
    pub fn uv(&self, face: usize) -> [[f64; 2]; 3] {
        let uv = self.vertex_uvs();
        self.copies[face].map(|copy| uv[copy as usize])
    }

    /// The coordinates of all corners, face by face.
    pub fn corner_uvs(&self) -> Vec<[[f64; 2]; 3]> {
        (0..self.copies.len()).map(|face| self.uv(face)).collect()
    }

    /// The coordinates of the vertices of the cut surface, to be used with
    /// [`copies`](Self::copies).
    pub fn vertex_uvs(&self) -> &[[f64; 2]] {
        self.values[..self.coordinates].as_chunks().0
    }

    /// The values of all unknowns of the problem that the map was made of.
    pub(crate) fn values(&self) -> &[f64] {
        &self.values
    }

    /// The vertices of the cut surface at the corners of every face.
    pub fn copies(&self) -> &[[u32; 3]] {
        &self.copies
    }

    /// How coordinates change over each cut edge, in increasing order of edges.
    pub fn transitions(&self) -> &[Transition] {
        &self.transitions
    }

    /// The vertices around which the map turns, in increasing order.
    pub fn cones(&self) -> &[usize] {
        &self.cones
    }

    /// Faces that the map turns over or collapses, decided exactly, in increasing order.
    pub fn flipped(&self) -> &[usize] {
        &self.flipped
    }

    /// Sum over triangles of `area (|grad u - h X|^2 + |grad v - h Y|^2)`, recomputed from the
    /// mesh.
    pub fn energy(&self) -> f64 {
        self.energy
    }
}

fn transitions(problem: &SeamlessProblem, mesh: &TriangleMesh, values: &[f64]) -> Vec<Transition> {
    let mut transitions = Vec::new();
    for (seam, sides) in problem.seams.iter().enumerate() {
        let s = problem.translation(seam);
        let translation = [values[s], values[s + 1]];
        let quarters = problem.seam_turns(mesh, seam);
        for &(face, k) in sides {
            let edge = mesh.edge_of(face, k);
            let forth = Transition {
                edge,
                quarters,
                translation,
            };
            transitions.push(match mesh.edge(edge).first == (face, k) {
                true => forth,
                false => inverse(forth),
            });
        }
    }
    transitions.sort_unstable_by_key(|t| t.edge);
    transitions
}

/// `q = R p + t` is `p = R^-1 q - R^-1 t`.
fn inverse(forth: Transition) -> Transition {
    let quarters = (4 - forth.quarters) % 4;
    let back = turned(quarters, forth.translation);
    Transition {
        edge: forth.edge,
        quarters,
        // No minus zero in anybody's output.
        translation: back.map(|x| 0.0 - x),
    }
}

/// By gradients in space, and so by other formulas than the problem was made of.
fn energy(problem: &SeamlessProblem, mesh: &TriangleMesh, map: &SeamlessMap) -> f64 {
    let mut sum = CompensatedSum::new(0.0);
    for face in 0..mesh.face_count() {
        let (uv, area) = (map.uv(face), mesh.area(face));
        let targets = problem.targets(mesh, face);
        for (axis, target) in targets.into_iter().enumerate() {
            let gradient = gradient(mesh, face, uv.map(|corner| corner[axis]));
            let error = sub(gradient, target);
            sum.add_product(area, dot(error, error));
        }
    }
    sum.value()
}

/// The gradient of the linear function with these values at the corners.
pub(crate) fn gradient(mesh: &TriangleMesh, face: usize, values: [f64; 3]) -> Vec3 {
    let corners = mesh.corner_positions(face);
    let normal = mesh.normal(face);
    let opposite = |k: usize| sub(corners[(k + 2) % 3], corners[(k + 1) % 3]);
    let rise = (1..3).fold([0.0; 3], |sum, k| {
        add(sum, scale(opposite(k), values[k] - values[0]))
    });
    scale(cross(normal, rise), 0.5 / mesh.area(face))
}
