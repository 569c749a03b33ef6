//! Boundary loops, components, Euler characteristic and genus.

use super::TriangleMesh;
use super::connectivity::NONE;

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
        let mut of_face = vec![NONE; self.face_count()];
        let mut count = 0;
        let mut open = Vec::new();
        for seed in 0..self.face_count() {
            if of_face[seed] != NONE {
                continue;
            }
            of_face[seed] = count;
            open.push(seed);
            while let Some(face) = open.pop() {
                for half in [3 * face, 3 * face + 1, 3 * face + 2] {
                    let across = self.twin[half];
                    if across != NONE && of_face[across as usize / 3] == NONE {
                        of_face[across as usize / 3] = count;
                        open.push(across as usize / 3);
                    }
                }
            }
            count += 1;
        }
        Components {
            count: count as usize,
            of_face,
        }
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
