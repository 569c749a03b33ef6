//! What rounding has put on top of each other, or on the wrong side, held apart: cones, and corners
//! of features and boundary, where both coordinates are integers as well.
//!
//! Two that a short path joins, or an isoline, cannot lie at one point, nor all three corners of a
//! face on one line: whatever else moves, the faces between them stay without area. Such integers are
//! decided anew with the cones held apart by constraints: along the coordinate in which the path should be
//! longest by its rounded length, one unit at least, or, for a face, by the nearest triangle of units that
//! is the right way round. Corners of a face between isolines are held one unit apart.

use std::collections::VecDeque;

use super::isoline_triangles::IsolineTriangle;
use crate::map::Wish;
use crate::map::{SeamlessMap, SeamlessProblem};
use crate::mesh::TriangleMesh;
use crate::mesh::orientation;
use crate::mesh::vector::{dot, sub};

/// How many edges a path between two cones has at most,
const LONGEST_PATH: usize = 4;

/// unless edges are so short that more of them span so many quads.
const LONGEST_REACH: f64 = 2.0;

/// Two copies of cones in one chart, and by how much the coordinates should differ from the first
/// to the second: along a shortest path between them.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct NearCones {
    pub copies: [u32; 2],
    pub vertices: [u32; 2],
    aim: [f64; 2],
}

/// What the integers of cones collapse.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Collapsed {
    /// Pairs of cones at one point or the wrong way round.
    pub(super) pairs: Vec<NearCones>,
    /// Faces of three cones or corners, no two at one point, that are collinear or clockwise.
    pub(super) faces: Vec<usize>,
    /// Faces between isolines that these leave no area, or turn over.
    pub(super) isoline_triangles: Vec<IsolineTriangle>,
}

impl Collapsed {
    /// What is collapsed in a map, of which integers hold these coordinates of every copy.
    pub(super) fn find(
        held: &[[bool; 2]],
        near: &[NearCones],
        isoline_triangles: &[IsolineTriangle],
        map: &SeamlessMap,
    ) -> Self {
        let uv = map.vertex_uvs();
        let is_collapsed = |pair: &&NearCones| {
            let [a, b] = pair.copies.map(|c| uv[c as usize]);
            let along = [0, 1].map(|i| (b[i] - a[i]).round());
            along[0] * pair.aim[0] + along[1] * pair.aim[1] <= 0.0
        };
        let pairs = near.iter().filter(is_collapsed).copied().collect();
        let faces = 0..map.copies().len();
        let is_lost = |&face: &usize| {
            let at = map.uv(face).map(|p| p.map(f64::round));
            let is_short = |k: usize| at[k] == at[(k + 1) % 3];
            map.copies()[face]
                .iter()
                .all(|&c| held[c as usize] == [true; 2])
                && !(0..3).any(is_short)
                && orientation(at) <= 0.0
        };
        let along = |face: &IsolineTriangle| map.uv(face.face).map(|p| p[face.axis]);
        let is_wrong = |face: &&IsolineTriangle| face.wrong(along(face)).is_some();
        Collapsed {
            pairs,
            faces: faces.filter(is_lost).collect(),
            isoline_triangles: isoline_triangles.iter().filter(is_wrong).copied().collect(),
        }
    }

    /// How many elements.
    pub fn count(&self) -> usize {
        self.pairs.len() + self.faces.len() + self.isoline_triangles.len()
    }

    /// Whether there is nothing.
    pub fn is_empty(&self) -> bool {
        self.count() == 0
    }

    /// The two cones of each pair.
    pub fn cones(&self) -> impl Iterator<Item = [usize; 2]> + '_ {
        self.pairs
            .iter()
            .map(|pair| pair.vertices.map(|v| v as usize))
    }
}

/// A constraint between two coordinates: the second is by so much larger than the first.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Apart {
    unknowns: [usize; 2],
    by: f64,
}

impl Apart {
    fn new(copies: [u32; 2], axis: usize, by: f64) -> Self {
        let unknowns = copies.map(|copy| 2 * copy as usize + axis);
        Apart { unknowns, by }
    }

    /// Whether both are about the same two coordinates.
    pub(super) fn is_between(&self, other: &Self) -> bool {
        self.unknowns == other.unknowns
    }
}

impl Wish for Apart {
    fn row(&self) -> ([usize; 2], [f64; 2], f64) {
        let [a, b] = self.unknowns;
        ([b, a], [1.0, -1.0], self.by)
    }
}

impl SeamlessProblem {
    /// Pairs of cones and corners that a path of a few edges or an isoline joins, no other on it and
    /// no cut across it.
    pub(super) fn near_cones(&self, mesh: &TriangleMesh, held: &[[bool; 2]]) -> Vec<NearCones> {
        let held: Vec<bool> = held.iter().map(|axes| *axes == [true; 2]).collect();
        let longest = LONGEST_PATH.max((LONGEST_REACH / self.mean_aim(mesh)) as usize);
        let mut found = Vec::new();
        for v in 0..mesh.vertex_count() {
            for copy in self.sectors.first[v]..self.sectors.first[v + 1] {
                if held[copy as usize] {
                    self.paths_from(mesh, [v as u32, copy], longest, &held, &mut found);
                }
            }
        }
        self.runs(mesh, &held, &mut found);
        found
    }

    /// The mean length of edges in the map as it should be.
    pub(super) fn mean_aim(&self, mesh: &TriangleMesh) -> f64 {
        let faces = 0..mesh.face_count();
        let length = |face: usize| {
            let [u, v] = self.aim(mesh, face, 0, 1);
            u.hypot(v)
        };
        faces.map(length).sum::<f64>() / mesh.face_count() as f64
    }

    /// Follows isolines from one cone or corner to the next, within a chart.
    fn runs(&self, mesh: &TriangleMesh, held: &[bool], found: &mut Vec<NearCones>) {
        let mut vertex_of = vec![0; self.sectors.count()];
        for v in 0..mesh.vertex_count() {
            for copy in self.sectors.first[v]..self.sectors.first[v + 1] {
                vertex_of[copy as usize] = v as u32;
            }
        }
        // Where a run began, how far it should have come, and where it is.
        let mut run: Option<(u32, [f64; 2], u32)> = None;
        for isoline in &self.isolines {
            let [from, to] = isoline.ends;
            let (begin, mut aim) = match run {
                Some((begin, aim, at)) if at == from && !isoline.is_first => (begin, aim),
                _ if held[from as usize] => (from, [0.0; 2]),
                _ => {
                    run = None;
                    continue;
                }
            };
            let step = self.aim_along(mesh, isoline.edge, [from, to]);
            aim = [aim[0] + step[0], aim[1] + step[1]];
            run = Some((begin, aim, to));
            if held[to as usize] {
                found.push(NearCones {
                    copies: [begin, to],
                    vertices: [begin, to].map(|copy| vertex_of[copy as usize]),
                    aim,
                });
                run = None;
            }
        }
    }

    /// By how much the coordinates should differ along an edge in the chart of its first face.
    fn aim_along(&self, mesh: &TriangleMesh, edge: usize, [from, to]: [u32; 2]) -> [f64; 2] {
        let (face, _) = mesh.edge(edge).first;
        let copies = self.sectors.copy[face];
        let corner = |copy: u32| copies.iter().position(|&c| c == copy).unwrap_or(0);
        self.aim(mesh, face, corner(from), corner(to))
    }

    /// Breadth-first from a copy of a cone; each pair is found from its lower cone.
    fn paths_from(
        &self,
        mesh: &TriangleMesh,
        [from, copy]: [u32; 2],
        longest: usize,
        held: &[bool],
        found: &mut Vec<NearCones>,
    ) {
        let mut reached = std::collections::BTreeSet::from([copy]);
        let mut queue = VecDeque::from([(from as usize, copy, [0.0; 2], 0)]);
        while let Some((v, at, aim, length)) = queue.pop_front() {
            for (face, corner) in mesh.ring(v) {
                if self.sectors.copy[face][corner] != at {
                    continue;
                }
                for end in [(corner + 1) % 3, (corner + 2) % 3] {
                    let next = self.sectors.copy[face][end];
                    if !reached.insert(next) {
                        continue;
                    }
                    let w = mesh.corners(face)[end];
                    let step = self.aim(mesh, face, corner, end);
                    let aim = [aim[0] + step[0], aim[1] + step[1]];
                    if !held[next as usize] {
                        if length + 1 < longest {
                            queue.push_back((w, next, aim, length + 1));
                        }
                    } else if from < w as u32 {
                        found.push(NearCones {
                            copies: [copy, next],
                            vertices: [from, w as u32],
                            aim,
                        });
                    }
                }
            }
        }
    }

    /// The constraints that hold collapsed cones apart.
    ///
    /// No two cones are joined twice, so that they seldom contradict each other; constraints of
    /// earlier rounds they may.
    pub(super) fn apart(
        &self,
        mesh: &TriangleMesh,
        map: &SeamlessMap,
        collapsed: &Collapsed,
    ) -> Vec<Apart> {
        let mut joined = Joined((0..mesh.vertex_count() as u32).collect());
        let mut found = Vec::new();
        for &face in &collapsed.faces {
            let [a, b, c] = mesh.corners(face);
            if joined.join(a, b) && joined.join(a, c) {
                let [ab, ac] = units(self.aim(mesh, face, 0, 1), self.aim(mesh, face, 0, 2));
                let copies = self.sectors.copy[face];
                for axis in 0..2 {
                    found.push(Apart::new([copies[0], copies[1]], axis, ab[axis]));
                    found.push(Apart::new([copies[0], copies[2]], axis, ac[axis]));
                }
            }
        }
        for isoline_triangles in &collapsed.isoline_triangles {
            let at = map
                .uv(isoline_triangles.face)
                .map(|p| p[isoline_triangles.axis]);
            let Some((ends, aim)) = isoline_triangles.wrong(at) else {
                continue;
            };
            let [a, b] = ends.map(|k| mesh.corners(isoline_triangles.face)[k]);
            if joined.join(a, b) {
                let copies = ends.map(|k| self.sectors.copy[isoline_triangles.face][k]);
                found.push(Apart::new(
                    copies,
                    isoline_triangles.axis,
                    1f64.copysign(aim),
                ));
            }
        }
        for pair in &collapsed.pairs {
            let [a, b] = pair.vertices.map(|v| v as usize);
            if joined.join(a, b) {
                let axis = usize::from(pair.aim[1].abs() > pair.aim[0].abs());
                let aim = pair.aim[axis];
                let by = aim.abs().round().max(1.0).copysign(aim);
                found.push(Apart::new(pair.copies, axis, by));
            }
        }
        found
    }

    /// By how much the coordinates of two corners of a face should differ.
    pub(super) fn aim(&self, mesh: &TriangleMesh, face: usize, from: usize, to: usize) -> [f64; 2] {
        let corners = mesh.corner_positions(face);
        let step = sub(corners[to], corners[from]);
        self.targets(mesh, face).map(|target| dot(target, step))
    }
}

/// The two vectors of entries -1, 0 and 1, the second to the left of the first, that are nearest to
/// these.
fn units(first: [f64; 2], second: [f64; 2]) -> [[f64; 2]; 2] {
    let entries =
        (0..81).map(|n: i32| [n / 27, n / 9 % 3, n / 3 % 3, n % 3].map(|e| f64::from(e - 1)));
    let left = entries.filter(|[a, b, c, d]| a * d - b * c > 0.0);
    let aim = [first[0], first[1], second[0], second[1]];
    let distance = |e: &[f64; 4]| (0..4).map(|i| (e[i] - aim[i]).powi(2)).sum::<f64>();
    let nearest = left.min_by(|a, b| distance(a).total_cmp(&distance(b)));
    let [a, b, c, d] = nearest.unwrap_or([1.0, 0.0, 0.0, 1.0]);
    [[a, b], [c, d]]
}

/// Which vertices are joined already: union-find with path halving.
struct Joined(Vec<u32>);

impl Joined {
    fn root(&mut self, v: usize) -> usize {
        let mut v = v;
        while self.0[v] as usize != v {
            self.0[v] = self.0[self.0[v] as usize];
            v = self.0[v] as usize;
        }
        v
    }

    /// Whether they were not joined before.
    fn join(&mut self, a: usize, b: usize) -> bool {
        let (a, b) = (self.root(a), self.root(b));
        self.0[a] = b as u32;
        a != b
    }
}

#[cfg(test)]
#[path = "collapsed_tests.rs"]
mod on_flat_meshes;

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn units_are_the_right_way_round_and_near() {
        assert_eq!(units([0.9, 0.2], [-0.1, 1.2]), [[1.0, 0.0], [0.0, 1.0]]);
        for n in 0..50 {
            let aim = [0, 1, 2, 3].map(|i| f64::from(n * 4 + i).sin());
            let [[a, b], [c, d]] = units([aim[0], aim[1]], [aim[2], aim[3]]);
            assert!(a * d - b * c > 0.0);
        }
    }

    #[test]
    fn vertices_are_joined_once() {
        let mut joined = Joined((0..4).collect());
        assert!(joined.join(0, 1) && joined.join(2, 3) && joined.join(1, 2));
        assert!(!joined.join(0, 3));
    }
}
