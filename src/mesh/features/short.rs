//! Sharp edges that are too short to be features of quads of some size.
//!
//! On scans and on coarse organic shapes, sharp edges come in many short pieces: no quad can follow them, and those
//! that try are folded. What is left out are small patches between sharp edges, and then loose ends.

use std::cmp::Reverse;
use std::collections::BinaryHeap;

use super::FeatureGraph;
use super::detect::turn;
use crate::error::Result;
use crate::mesh::TriangleMesh;

/// A patch between features is too small if its area is below the square of this part of the length.
const PATCH_PART: f64 = 0.25;

impl FeatureGraph {
    /// The graph without what is too short to be a feature, but with all edges of `held`:
    ///
    /// - A patch of the surface between features with an area below (`length` / 4)^2 is joined to the one beside it
    ///   to which the surface turns least, smaller patches first.
    /// - A curve that ends somewhere, and is shorter than `length` to where features meet or to its other end, is
    ///   left out, shorter ones first.
    ///
    /// # Errors
    /// [`Error::LengthMismatch`](crate::error::Error::LengthMismatch) for graphs on another mesh.
    pub fn without_short(
        self,
        mesh: &TriangleMesh,
        held: &FeatureGraph,
        length: f64,
    ) -> Result<Self> {
        self.check_mesh(mesh)?;
        held.check_mesh(mesh)?;
        let mut pruned = Pruned {
            mesh,
            held,
            degree: self.degree,
            is_feature: self.is_feature,
        };
        pruned.join_patches((PATCH_PART * length).powi(2));
        pruned.cut_ends(length);
        Ok(Self::of(mesh, pruned.is_feature))
    }
}

/// A graph that loses edges.
struct Pruned<'a> {
    mesh: &'a TriangleMesh,
    held: &'a FeatureGraph,
    is_feature: Vec<bool>,
    degree: Vec<u32>,
}

impl Pruned<'_> {
    fn remove(&mut self, edge: usize) {
        self.is_feature[edge] = false;
        for v in self.mesh.edge(edge).vertices {
            self.degree[v] -= 1;
        }
    }

    fn may_go(&self, edge: usize) -> bool {
        self.is_feature[edge] && !self.held.contains(edge)
    }

    /// Joins all patches below this area to a neighbour.
    fn join_patches(&mut self, area: f64) {
        while self.join_some(area) {}
    }

    /// Joins some of the patches below this area, each at most once; whether there were any.
    fn join_some(&mut self, least: f64) -> bool {
        let (patch_of, areas) = self.patches();
        let mut between: Vec<(usize, usize, usize)> = Vec::new();
        for edge in (0..self.is_feature.len()).filter(|&e| self.may_go(e)) {
            let found = self.mesh.edge(edge);
            let Some((second, _)) = found.second else {
                continue;
            };
            let [a, b] = [found.first.0, second].map(|face| patch_of[face]);
            if a != b {
                let small = [(a, b), (b, a)].into_iter();
                between.extend(
                    small
                        .filter(|&(a, _)| areas[a] < least)
                        .map(|(a, b)| (a, b, edge)),
                );
            }
        }
        between.sort_unstable();
        let mut of_patch: Vec<&[(usize, usize, usize)]> =
            between.chunk_by(|x, y| x.0 == y.0).collect();
        of_patch.sort_by(|x, y| areas[x[0].0].total_cmp(&areas[y[0].0]));
        let mut is_joined = vec![false; areas.len()];
        let mut any = false;
        for beside in of_patch {
            let small = beside[0].0;
            if is_joined[small] {
                continue;
            }
            let others = beside.chunk_by(|x, y| x.1 == y.1);
            let turns = others.map(|shared| (self.mean_turn(shared), shared));
            let Some((_, least)) = turns.min_by(|x, y| x.0.total_cmp(&y.0)) else {
                continue;
            };
            let other = least[0].1;
            if is_joined[other] {
                continue;
            }
            (is_joined[small], is_joined[other]) = (true, true);
            least.iter().for_each(|&(_, _, edge)| self.remove(edge));
            any = true;
        }
        any
    }

    /// By how much the surface turns at these edges.
    fn mean_turn(&self, shared: &[(usize, usize, usize)]) -> f64 {
        let (mut sum, mut lengths) = (0.0, 0.0);
        for &(_, _, edge) in shared {
            let length = self.length(edge);
            sum += length * turn(self.mesh, edge).unwrap_or(0.0);
            lengths += length;
        }
        sum / lengths
    }

    /// The patch of every face, and the area of every patch.
    fn patches(&self) -> (Vec<usize>, Vec<f64>) {
        let mesh = self.mesh;
        let mut patch_of = vec![usize::MAX; mesh.face_count()];
        let (mut areas, mut queue) = (Vec::new(), Vec::new());
        for first in 0..mesh.face_count() {
            if patch_of[first] != usize::MAX {
                continue;
            }
            let patch = areas.len();
            areas.push(0.0);
            patch_of[first] = patch;
            queue.push(first);
            while let Some(face) = queue.pop() {
                areas[patch] += mesh.area(face);
                for edge in [0, 1, 2].map(|k| mesh.edge_of(face, k)) {
                    let found = mesh.edge(edge);
                    let (Some((second, _)), false) = (found.second, self.is_feature[edge]) else {
                        continue;
                    };
                    for other in [found.first.0, second] {
                        if patch_of[other] == usize::MAX {
                            patch_of[other] = patch;
                            queue.push(other);
                        }
                    }
                }
            }
        }
        (patch_of, areas)
    }

    /// Leaves out curves with a loose end, the shorter ones first.
    fn cut_ends(&mut self, length: f64) {
        let ends = (0..self.degree.len()).filter(|&v| self.degree[v] == 1);
        // Lengths are not negative: their bits are in their order.
        let mut queue: BinaryHeap<_> = ends.map(|v| Reverse((0.0f64.to_bits(), v))).collect();
        while let Some(Reverse((known, end))) = queue.pop() {
            if self.degree[end] != 1 {
                continue;
            }
            let (curve, long, other) = self.curve_from(end);
            if long >= length || curve.iter().any(|&e| !self.may_go(e)) {
                continue;
            }
            // What was cut before may have made it longer.
            if long.to_bits() > known {
                queue.push(Reverse((long.to_bits(), end)));
                continue;
            }
            curve.iter().for_each(|&edge| self.remove(edge));
            if self.degree[other] == 1 {
                queue.push(Reverse((0.0f64.to_bits(), other)));
            }
        }
    }

    /// The edges from a loose end to where features meet or end, their length, and that place.
    fn curve_from(&self, end: usize) -> (Vec<usize>, f64, usize) {
        let (mut edges, mut length, mut at) = (Vec::new(), 0.0, end);
        let mut last = usize::MAX;
        while let Some(next) = self.feature_at(at, last) {
            let [a, b] = self.mesh.edge(next).vertices;
            (last, at) = (next, a + b - at);
            edges.push(next);
            length += self.length(next);
            if self.degree[at] != 2 {
                break;
            }
        }
        (edges, length, at)
    }

    /// The feature at a vertex other than `last`.
    fn feature_at(&self, vertex: usize, last: usize) -> Option<usize> {
        let mesh = self.mesh;
        let mut around = mesh
            .ring(vertex)
            .flat_map(|(f, k)| [mesh.edge_of(f, k), mesh.edge_of(f, (k + 2) % 3)]);
        around.find(|&e| e != last && self.is_feature[e])
    }

    fn length(&self, edge: usize) -> f64 {
        let (face, side) = self.mesh.edge(edge).first;
        self.mesh.edge_length(face, side)
    }
}
