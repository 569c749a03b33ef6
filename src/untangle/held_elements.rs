//! Elements of a map whose shape the integers alone decide. Their vertices are cones, or those corners of
//! features and of the boundary both of whose coordinates are integers.
//!
//! Two cones that are joined by a short path or by an isoline must not lie at one point, and the three
//! corners of a face must not be collinear. Otherwise the faces between them have no area, wherever the
//! other vertices move.

use std::collections::{BTreeSet, VecDeque};

use super::isoline_triangles::IsolineTriangle;
use crate::map::SeamlessProblem;
use crate::mesh::TriangleMesh;
use crate::mesh::vector::{dot, sub};

/// The most edges of a path between two cones, unless [`LONGEST_REACH`] allows more.
const LONGEST_PATH: usize = 4;

/// The length in quads up to which a path between two cones may have any number of edges.
const LONGEST_REACH: f64 = 2.0;

/// The elements that integers may collapse, the same for all maps of one problem.
pub(crate) struct HeldElements {
    pub(super) pairs: Vec<NearCones>,
    /// Faces of three cones or corners.
    pub(super) faces: Vec<usize>,
    pub(super) isoline_triangles: Vec<IsolineTriangle>,
}

/// Two copies of cones in one chart, and the difference that their coordinates should have, second minus
/// first, along a shortest path between them.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct NearCones {
    pub copies: [u32; 2],
    pub vertices: [u32; 2],
    pub aim: [f64; 2],
}

impl HeldElements {
    /// The elements of a problem in which integers hold these coordinates of every copy.
    pub(super) fn new(problem: &SeamlessProblem, mesh: &TriangleMesh, held: &[[bool; 2]]) -> Self {
        let is_point: Vec<bool> = held.iter().map(|axes| *axes == [true; 2]).collect();
        let copies = &problem.sectors.copy;
        let is_held = |&face: &usize| copies[face].iter().all(|&c| is_point[c as usize]);
        HeldElements {
            pairs: problem.near_cones(mesh, &is_point),
            faces: (0..mesh.face_count()).filter(is_held).collect(),
            isoline_triangles: problem.isoline_triangles(mesh, held),
        }
    }
}

impl SeamlessProblem {
    /// Pairs of cones and corners that are joined by an isoline or by a path of a few edges. The path
    /// passes through no other cone and crosses no cut.
    fn near_cones(&self, mesh: &TriangleMesh, held: &[bool]) -> Vec<NearCones> {
        let longest = LONGEST_PATH.max((LONGEST_REACH / self.mean_aim(mesh)) as usize);
        let mut found = Vec::new();
        for v in 0..mesh.vertex_count() {
            for copy in self.sectors.first[v]..self.sectors.first[v + 1] {
                if held[copy as usize] {
                    self.paths_from(mesh, [v as u32, copy], longest, held, &mut found);
                }
            }
        }
        self.runs(mesh, held, &mut found);
        found
    }

    /// The mean length of an edge in the map if the map had the gradients that are asked for.
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
        // The copy where a run began, the difference that its ends should have, and the copy that it has
        // reached.
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

    /// The difference that the coordinates should have along an edge, in the chart of its first face.
    fn aim_along(&self, mesh: &TriangleMesh, edge: usize, [from, to]: [u32; 2]) -> [f64; 2] {
        let (face, _) = mesh.edge(edge).first;
        let copies = self.sectors.copy[face];
        let corner = |copy: u32| copies.iter().position(|&c| c == copy).unwrap_or(0);
        self.aim(mesh, face, corner(from), corner(to))
    }

    /// Searches breadth-first from a copy of a cone. Each pair is found from its lower cone.
    fn paths_from(
        &self,
        mesh: &TriangleMesh,
        [from, copy]: [u32; 2],
        longest: usize,
        held: &[bool],
        found: &mut Vec<NearCones>,
    ) {
        let mut reached = BTreeSet::from([copy]);
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

    /// The difference that the coordinates of two corners of a face should have.
    pub(super) fn aim(&self, mesh: &TriangleMesh, face: usize, from: usize, to: usize) -> [f64; 2] {
        let corners = mesh.corner_positions(face);
        let step = sub(corners[to], corners[from]);
        self.targets(mesh, face).map(|target| dot(target, step))
    }
}
