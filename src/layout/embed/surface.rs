//! A triangle mesh into which nodes and arcs are cut: its edges and faces are split where they run.
//!
//! Half-edge 3 f + k runs from corner k of face f to the next. Faces keep their numbers, with one part of what they
//! were, and new ones follow. Splits always succeed: only the topology of arcs matters here, and the shape of
//! triangles is up to whoever chooses where to split.

use crate::layout::base_layout::{Dart, reversed};
use crate::mesh::TriangleMesh;
use crate::mesh::vector::{Vec3, add, norm, scale, sub};

/// No half-edge, no dart.
pub(in crate::layout) const NONE: u32 = u32::MAX;

#[derive(Debug, Clone)]
pub(in crate::layout) struct Surface {
    pub positions: Vec<Vec3>,
    pub triangles: Vec<[u32; 3]>,
    pub twin: Vec<u32>,
    /// The face of the mesh that each face is part of.
    pub origin: Vec<u32>,
    /// A half-edge that leaves each vertex.
    pub(super) out: Vec<u32>,
    /// The dart that runs along each half-edge, or [`NONE`].
    pub dart: Vec<u32>,
    /// Whether a vertex is a node or lies on an arc.
    pub is_taken: Vec<bool>,
    /// Edges that are not longer are split only where both ends are taken: else arcs that are laid again and again
    /// would refine the mesh without end.
    resolution: f64,
    /// The first so many vertices are those of the mesh, and what it needs in between.
    pub(super) kept: u32,
}

/// The resolution, as a part of the mean length of the edges of the mesh.
const RESOLUTION: f64 = 0.25;

pub(in crate::layout) fn next(half: u32) -> u32 {
    if half % 3 == 2 { half - 2 } else { half + 1 }
}

pub(in crate::layout) fn previous(half: u32) -> u32 {
    if half.is_multiple_of(3) {
        half + 2
    } else {
        half - 1
    }
}

impl Surface {
    pub fn new(mesh: &TriangleMesh) -> Self {
        let mut surface = Surface {
            positions: mesh.vertices().to_vec(),
            triangles: mesh.triangles().to_vec(),
            twin: (0..3 * mesh.face_count())
                .map(|half| {
                    let across = mesh.neighbor(half / 3, half % 3);
                    across.map_or(NONE, |(face, k)| (3 * face + k) as u32)
                })
                .collect(),
            origin: (0..mesh.face_count() as u32).collect(),
            out: vec![NONE; mesh.vertex_count()],
            dart: vec![NONE; 3 * mesh.face_count()],
            is_taken: vec![false; mesh.vertex_count()],
            resolution: 0.0,
            kept: 0,
        };
        let halves = 0..surface.twin.len() as u32;
        let lengths: f64 = halves.map(|half| surface.length(half)).sum();
        surface.resolution = RESOLUTION * lengths / surface.twin.len().max(1) as f64;
        for face in 0..mesh.face_count() as u32 {
            surface.note_corners(face);
        }
        surface.open_pockets();
        surface.kept = surface.positions.len() as u32;
        surface
    }

    /// Puts a vertex into one of two faces that have the same corners: a vertex on their edge would have two edges
    /// to the third corner.
    fn open_pockets(&mut self) {
        for half in 0..self.twin.len() as u32 {
            let other = self.twin[half as usize];
            if other != NONE && self.tail(previous(half)) == self.tail(previous(other)) {
                let corners = self.corners(half / 3).map(|p| scale(p, 1.0 / 3.0));
                self.split_face(half / 3, add(add(corners[0], corners[1]), corners[2]));
            }
        }
    }

    pub(super) fn note_corners(&mut self, face: u32) {
        for k in 0..3 {
            let v = self.triangles[face as usize][k as usize];
            self.out[v as usize] = 3 * face + k;
        }
    }

    pub fn tail(&self, half: u32) -> u32 {
        self.triangles[half as usize / 3][half as usize % 3]
    }

    pub fn tip(&self, half: u32) -> u32 {
        self.tail(next(half))
    }

    pub fn position(&self, vertex: u32) -> Vec3 {
        self.positions[vertex as usize]
    }

    pub fn corners(&self, face: u32) -> [Vec3; 3] {
        self.triangles[face as usize].map(|v| self.position(v))
    }

    fn length(&self, half: u32) -> f64 {
        norm(sub(
            self.position(self.tip(half)),
            self.position(self.tail(half)),
        ))
    }

    /// Whether a path may cross an edge in its middle: no arc runs along it, and it is long enough, or no other path
    /// leads across.
    pub fn may_be_split(&self, half: u32) -> bool {
        let is_taken = |v: u32| self.is_taken[v as usize];
        self.dart[half as usize] == NONE
            && (self.length(half) > self.resolution
                || (is_taken(self.tail(half)) && is_taken(self.tip(half))))
    }

    /// The length of a chain of edges.
    pub fn chain_length(&self, chain: &[u32]) -> f64 {
        let steps = chain.windows(2).map(|pair| {
            let [a, b] = [pair[0], pair[1]].map(|v| self.position(v));
            norm(sub(b, a))
        });
        steps.sum()
    }

    /// Splits edges that are no arcs and join two vertices that are taken: no edge is a chord of a patch.
    pub fn split_chords(&mut self) {
        // Halves of a chord and edges to the new vertex are no chords.
        for half in 0..self.twin.len() as u32 {
            let ends = [self.tail(half), self.tip(half)];
            let is_chord = self.dart[half as usize] == NONE
                && self.twin[half as usize] != NONE
                && ends.iter().all(|&v| self.is_taken[v as usize]);
            if is_chord {
                self.split_in_the_middle(half);
            }
        }
    }

    /// The half-edges that leave a vertex, one for each face around it, counter-clockwise. At the boundary the first
    /// one has no face on its right.
    pub fn around(&self, vertex: u32) -> impl Iterator<Item = u32> + '_ {
        let mut first = self.out[vertex as usize];
        loop {
            let right = self.twin[first as usize];
            if right == NONE {
                break;
            }
            first = next(right);
            if first == self.out[vertex as usize] {
                break;
            }
        }
        let mut current = Some(first);
        std::iter::from_fn(move || {
            let half = current?;
            let left = self.twin[previous(half) as usize];
            current = (left != NONE && left != first).then_some(left);
            Some(half)
        })
    }

    /// The half-edge from one vertex to another, or from the other to the one where only that has a face.
    pub fn half_between(&self, a: u32, b: u32) -> Option<u32> {
        let forth = self.around(a).find(|&half| self.tip(half) == b);
        forth.or_else(|| self.around(b).find(|&half| self.tip(half) == a))
    }

    /// Lets a dart run from one vertex to its neighbour.
    pub fn take_edge(&mut self, a: u32, b: u32, dart: Dart) {
        let Some(half) = self.half_between(a, b) else {
            debug_assert!(false, "no edge from {a} to {b}");
            return;
        };
        let forth = if self.tail(half) == a {
            dart
        } else {
            reversed(dart)
        };
        self.dart[half as usize] = forth;
        let other = self.twin[half as usize];
        if other != NONE {
            self.dart[other as usize] = reversed(forth);
        }
        self.is_taken[a as usize] = true;
        self.is_taken[b as usize] = true;
    }

    /// Takes an arc away again: its inner vertices are free.
    pub fn free_chain(&mut self, chain: &[u32]) {
        for pair in chain.windows(2) {
            if let Some(half) = self.half_between(pair[0], pair[1]) {
                self.dart[half as usize] = NONE;
                let other = self.twin[half as usize];
                if other != NONE {
                    self.dart[other as usize] = NONE;
                }
            }
        }
        for &v in &chain[1..chain.len() - 1] {
            self.is_taken[v as usize] = false;
        }
    }

    /// Splits an edge at a point of it; the new vertex.
    pub fn split_edge(&mut self, half: u32, p: Vec3) -> u32 {
        let other = self.twin[half as usize];
        let m = self.add_vertex(p);
        let [first, second] = self.halve(half, m);
        if other != NONE {
            let [third, fourth] = self.halve(other, m);
            self.join(first, fourth);
            self.join(second, third);
        }
        m
    }

    /// Splits an edge in its middle.
    pub fn split_in_the_middle(&mut self, half: u32) -> u32 {
        let sum = add(
            self.position(self.tail(half)),
            self.position(self.tip(half)),
        );
        self.split_edge(half, scale(sum, 0.5))
    }

    /// Splits the face of a half-edge between a vertex on it and the opposite corner; the two parts of the
    /// half-edge, whose opposites are not set.
    fn halve(&mut self, half: u32, m: u32) -> [u32; 2] {
        let [across, back] = [next(half), previous(half)];
        let [a, b, c] = [half, across, back].map(|h| self.tail(h));
        let outer = [across, back].map(|h| (self.twin[h as usize], self.dart[h as usize]));
        let (dart, face) = (self.dart[half as usize], half / 3);
        let added = self.add_face(face);
        self.set_face(face, [a, m, c]);
        self.set_face(added, [m, b, c]);
        let (first, second) = (3 * face, 3 * added);
        self.dart[first as usize] = dart;
        self.dart[second as usize] = dart;
        self.attach(second + 1, outer[0]);
        self.attach(first + 2, outer[1]);
        self.join(first + 1, second + 2);
        [first, second]
    }

    /// Puts a vertex into a face.
    pub fn split_face(&mut self, face: u32, p: Vec3) -> u32 {
        let [a, b, c] = self.triangles[face as usize];
        let outer = [0, 1, 2].map(|k| {
            let half = 3 * face as usize + k;
            (self.twin[half], self.dart[half])
        });
        let m = self.add_vertex(p);
        let faces = [face, self.add_face(face), self.add_face(face)];
        for (k, (ends, outer)) in [[a, b], [b, c], [c, a]].into_iter().zip(outer).enumerate() {
            self.set_face(faces[k], [ends[0], ends[1], m]);
            self.attach(3 * faces[k], outer);
        }
        for k in 0..3 {
            self.join(3 * faces[k] + 1, 3 * faces[(k + 1) % 3] + 2);
        }
        m
    }

    fn add_vertex(&mut self, p: Vec3) -> u32 {
        self.positions.push(p);
        self.out.push(NONE);
        self.is_taken.push(false);
        self.positions.len() as u32 - 1
    }

    fn add_face(&mut self, like: u32) -> u32 {
        self.triangles.push([0; 3]);
        self.twin.extend([NONE; 3]);
        self.dart.extend([NONE; 3]);
        self.origin.push(self.origin[like as usize]);
        self.triangles.len() as u32 - 1
    }

    fn set_face(&mut self, face: u32, corners: [u32; 3]) {
        let first = 3 * face as usize;
        self.triangles[face as usize] = corners;
        self.twin[first..first + 3].fill(NONE);
        self.dart[first..first + 3].fill(NONE);
        self.note_corners(face);
    }

    fn join(&mut self, a: u32, b: u32) {
        self.twin[a as usize] = b;
        self.twin[b as usize] = a;
    }

    fn attach(&mut self, half: u32, (twin, dart): (u32, u32)) {
        self.dart[half as usize] = dart;
        if twin != NONE {
            self.join(half, twin);
        }
    }
}
