//! Quads that do not conform, made manifold and oriented.
//!
//! Where a map has folds that nothing removes, cells may contain a vertex twice or have other than four sides,
//! and edges may have more than two faces, or two that run the same way. Few programs can use such a mesh. So
//! faces that contain a vertex twice are dropped, cells split into quads, and all faces cut apart at such edges.
//! What is left has more boundary: it still does not conform, and says so, but every program can read it.

use super::QuadMesh;
use super::faults::has_twice;
use crate::linalg::DisjointSets;
use crate::mesh::vector::{cross, norm, sub};

/// A side of a face: its ends in increasing order, whether it runs from the first to the second, and the corners
/// at the first and the second.
type Side = ([u32; 2], bool, [usize; 2]);

impl QuadMesh {
    /// Makes the mesh one of quads, manifold and oriented. Conforming quads do not change.
    pub(crate) fn make_manifold(&mut self) {
        self.quads.retain(|quad| !has_twice(quad));
        self.others.retain(|face| !has_twice(face));
        self.split_others();
        self.cut();
    }

    /// Splits the other faces into quads. Of a face with an odd number of corners, the smallest triangle of a
    /// corner and its neighbours is left out.
    fn split_others(&mut self) {
        for mut face in std::mem::take(&mut self.others) {
            let n = face.len();
            if n % 2 == 1 {
                let area = |k: usize| {
                    let corners = [k + n - 1, k, k + 1].map(|k| face[k % n] as usize);
                    let [a, b, c] = corners.map(|v| self.vertices[v]);
                    norm(cross(sub(b, a), sub(c, a)))
                };
                let smallest = (0..n).min_by(|&i, &j| area(i).total_cmp(&area(j)));
                face.remove(smallest.unwrap_or(0));
            }
            for k in (1..face.len().saturating_sub(2)).step_by(2) {
                self.quads
                    .push([face[0], face[k], face[k + 1], face[k + 2]]);
            }
        }
    }

    /// Gives every fan of faces around a vertex a vertex of its own. Faces are connected over edges with two
    /// faces that run in opposite directions. A fan begins with at most one side that nothing is connected to,
    /// and ends with at most one, which runs the other way: so at most one pair of opposite sides has the same
    /// ends afterwards.
    fn cut(&mut self) {
        let corners: Vec<usize> = self.faces().flatten().map(|&v| v as usize).collect();
        let mut sides: Vec<Side> = Vec::with_capacity(corners.len());
        let mut first = 0;
        for face in self.faces() {
            let n = face.len();
            for (k, &a) in face.iter().enumerate() {
                let (b, next) = (face[(k + 1) % n], first + (k + 1) % n);
                sides.push(match a < b {
                    true => ([a, b], true, [first + k, next]),
                    false => ([b, a], false, [next, first + k]),
                });
            }
            first += n;
        }
        sides.sort_unstable();
        let mut fans = DisjointSets::new(corners.len());
        for edge in sides.chunk_by(|a, b| a.0 == b.0) {
            if let [(_, false, one), (_, true, other)] = edge {
                fans.join(one[0], other[0]);
                fans.join(one[1], other[1]);
            }
        }
        // The first fan of a vertex keeps its number.
        let mut is_taken = vec![false; self.vertices.len()];
        let mut vertex_of = vec![None; corners.len()];
        let mut cut = Vec::with_capacity(corners.len());
        for (corner, &v) in corners.iter().enumerate() {
            let fan = fans.root(corner);
            let vertex = vertex_of[fan].unwrap_or_else(|| {
                if !std::mem::replace(&mut is_taken[v], true) {
                    return v;
                }
                self.vertices.push(self.vertices[v]);
                self.origins.push(self.origins[v]);
                self.vertices.len() - 1
            });
            vertex_of[fan] = Some(vertex);
            cut.push(vertex);
        }
        self.renumber(&cut);
    }

    /// Sets the vertex of each corner, face after face, and drops those that are used no longer.
    fn renumber(&mut self, corners: &[usize]) {
        let mut number = vec![None; self.vertices.len()];
        corners.iter().for_each(|&v| number[v] = Some(0));
        let is_used: Vec<bool> = number.iter().map(Option::is_some).collect();
        let used = number.iter_mut().flatten().enumerate();
        used.for_each(|(new, old)| *old = new as u32);
        let mut of_corner = corners.iter().flat_map(|&v| number[v]);
        let quads = self.quads.iter_mut().map(|quad| quad.as_mut_slice());
        let others = self.others.iter_mut().map(Vec::as_mut_slice);
        for corner in quads.chain(others).flatten() {
            *corner = of_corner.next().unwrap_or(*corner);
        }
        let mut keep = is_used.iter();
        self.vertices.retain(|_| keep.next() == Some(&true));
        let mut keep = is_used.iter();
        self.origins.retain(|_| keep.next() == Some(&true));
    }
}

#[cfg(test)]
mod tests {
    use super::super::faults::tests::mesh;
    use super::*;
    use crate::linalg::Random;

    #[test]
    fn other_faces_become_quads_without_the_smallest_corner_of_odd_ones() {
        let mut made = mesh(&[[0, 1, 8, 9]], &[&[1, 0, 2, 3, 4, 5], &[1, 5, 6, 7, 8]]);
        made.vertices[6][1] = 1.0;
        made.vertices[7][1] = 0.1;
        made.make_manifold();
        assert!(made.others.is_empty() && made.faults().is_empty());
        let split = [[1.0, 0.0, 2.0, 3.0], [1.0, 3.0, 4.0, 5.0]];
        assert_eq!(names(&made)[1..3], split);
        assert_eq!(made.quads.len(), 4);
    }

    /// The vertices of all faces before they were cut apart.
    fn names(mesh: &QuadMesh) -> Vec<Vec<f64>> {
        let at = |&v: &u32| mesh.vertices[v as usize][0];
        mesh.faces()
            .map(|face| face.iter().map(at).collect())
            .collect()
    }

    #[test]
    fn conforming_quads_do_not_change() {
        let pair = mesh(&[[0, 1, 2, 3], [1, 4, 5, 2]], &[]);
        let mut same = pair.clone();
        same.make_manifold();
        assert_eq!(same, pair);
    }

    #[test]
    fn an_edge_of_three_faces_and_a_shared_vertex_are_cut_apart() {
        for quads in [
            vec![[0, 1, 2, 3], [1, 0, 4, 5], [0, 1, 6, 7]],
            vec![[0, 1, 2, 3], [2, 4, 5, 6]],
        ] {
            let given = mesh(&quads, &[]);
            let mut made = given.clone();
            made.make_manifold();
            assert!(made.faults().is_empty());
            assert_eq!(names(&made), names(&given));
        }
    }

    #[test]
    fn faces_with_a_vertex_twice_are_dropped_and_so_are_their_vertices() {
        let mut made = mesh(&[[0, 1, 0, 2], [3, 4, 5, 6]], &[&[5, 4, 5]]);
        made.make_manifold();
        assert_eq!(names(&made), [[3.0, 4.0, 5.0, 6.0]]);
        assert_eq!(made.vertices.len(), 4);
        assert_eq!(made.origins.len(), 4);
    }

    #[test]
    fn random_faces_become_manifold() {
        let random = &mut Random::new(7);
        for _ in 0..500 {
            let count = 2 + random.next() % 12;
            let quads: Vec<[u32; 4]> = (0..count)
                .map(|_| [0; 4].map(|_| (random.next() % 7) as u32))
                .collect();
            let mut made = mesh(&quads, &[]);
            made.make_manifold();
            assert!(made.faults().is_empty(), "{quads:?}");
            let kept = quads.iter().filter(|quad| !has_twice(*quad));
            assert_eq!(made.quads.len(), kept.count());
            let used = made
                .faces()
                .flatten()
                .collect::<std::collections::BTreeSet<_>>();
            assert_eq!(used.len(), made.vertices.len());
        }
    }
}
