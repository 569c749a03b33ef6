//! Boundary loops, components, Euler characteristic and genus.

use std::convert::Infallible;

use super::TriangleMesh;
use super::connectivity::NONE;
use crate::linalg::joined_sets;

/// The connected components of a mesh.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Components {
    /// How many there are.
    pub count: usize,
    /// The component of every face; components are numbered by their lowest face.
    pub of_face: Vec<u32>,
}

impl TriangleMesh {
    /// The boundary, one list of half-edges (face, local edge) a loop.
    ///
    /// Half-edges follow each other tip to tail with the surface on their left. A loop starts at
    /// its lowest half-edge, and loops come in increasing order of it.
    pub fn boundary_loops(&self) -> Vec<Vec<(usize, usize)>> {
        let mut seen = vec![false; self.twin.len()];
        let mut loops = Vec::new();
        for first in 0..self.twin.len() {
            if self.twin[first] != NONE || seen[first] {
                continue;
            }
            let mut boundary = Vec::new();
            let mut h = first;
            while !seen[h] {
                seen[h] = true;
                boundary.push((h / 3, h % 3));
                let tip = self.corners(h / 3)[(h % 3 + 1) % 3];
                // The fan of a boundary vertex starts at its outgoing boundary half-edge.
                h = self.ring(tip).next().map_or(first, |(f, k)| 3 * f + k);
            }
            loops.push(boundary);
        }
        loops
    }

    /// Number of boundary loops.
    pub fn boundary_loop_count(&self) -> usize {
        self.boundary_loops().len()
    }

    /// Whether the mesh has no boundary.
    pub fn is_closed(&self) -> bool {
        !self.twin.contains(&NONE)
    }

    /// The connected components, two faces being connected across an edge.
    pub fn components(&self) -> Components {
        let before = |face: usize| {
            let across = self.twin[3 * face..3 * face + 3].iter();
            let across = across.filter(|&&half| half != NONE);
            across
                .map(|&half| half as usize / 3)
                .filter(move |&other| other < face)
        };
        let Ok((of_face, count)) =
            joined_sets(self.face_count(), before, |_| Ok::<_, Infallible>(()));
        Components { count, of_face }
    }

    /// Vertices minus edges plus faces.
    pub fn euler_characteristic(&self) -> i64 {
        self.vertex_count() as i64 - self.edge_count() as i64 + self.face_count() as i64
    }

    /// Number of handles, summed over the components: 2 - 2 g = chi + (boundary loops) for each.
    pub fn genus(&self) -> usize {
        let spheres = 2 * self.components().count as i64;
        let capped = self.euler_characteristic() + self.boundary_loop_count() as i64;
        ((spheres - capped) / 2) as usize
    }
}
