//! A mesh that changes: half-edges with their opposites, split and flipped.
//!
//! Half-edge 3 f + k runs from corner k of face f to the next. A held half-edge names the original edge that
//! it is part of: a feature, the boundary, or an edge between two regions.

use super::flat::Regions;
use crate::mesh::connectivity::NONE;
use crate::mesh::features::FeatureGraph;
use crate::mesh::vector::{Vec3, add, scale};
use crate::mesh::{TriangleMesh, orientation};
use crate::soup::has_no_area;

/// What has been done.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub(super) struct Counts {
    pub(super) splits: usize,
    pub(super) flips: usize,
}

pub(super) struct WorkingMesh<'a> {
    pub(super) mesh: &'a TriangleMesh,
    pub(super) regions: &'a Regions,
    pub(super) vertices: Vec<Vec3>,
    /// An original face on which each vertex lies.
    pub(super) vertex_face: Vec<u32>,
    pub(super) triangles: Vec<[u32; 3]>,
    pub(super) twin: Vec<u32>,
    /// The original edge of a held half-edge, or [`NONE`].
    pub(super) held: Vec<u32>,
    /// An original face of the same region, near each face.
    pub(super) origin: Vec<u32>,
    /// Faces that are new or have changed since this list was last emptied.
    pub(super) changed: Vec<u32>,
    pub(super) counts: Counts,
}

pub(super) fn next(half: u32) -> u32 {
    if half % 3 == 2 { half - 2 } else { half + 1 }
}

pub(super) fn previous(half: u32) -> u32 {
    if half.is_multiple_of(3) {
        half + 2
    } else {
        half - 1
    }
}

impl<'a> WorkingMesh<'a> {
    pub(super) fn new(
        mesh: &'a TriangleMesh,
        features: &FeatureGraph,
        regions: &'a Regions,
    ) -> Self {
        let mut held = vec![NONE; 3 * mesh.face_count()];
        for (e, edge) in mesh.edges().enumerate() {
            let sides = edge.second.into_iter().chain([edge.first]);
            let of = |(face, _): (usize, usize)| regions.of_face[face];
            let is_inner = edge.second.is_some_and(|side| of(side) == of(edge.first));
            if features.contains(e) || !is_inner {
                sides.for_each(|(face, k)| held[3 * face + k] = e as u32);
            }
        }
        let face_of = |v| mesh.ring(v).next().map_or(0, |(face, _)| face as u32);
        WorkingMesh {
            mesh,
            regions,
            vertices: mesh.vertices().to_vec(),
            vertex_face: (0..mesh.vertex_count()).map(face_of).collect(),
            triangles: mesh.triangles().to_vec(),
            twin: mesh.twin.clone(),
            held,
            origin: (0..mesh.face_count() as u32).collect(),
            changed: Vec::new(),
            counts: Counts::default(),
        }
    }

    pub(super) fn tail(&self, half: u32) -> u32 {
        self.triangles[half as usize / 3][half as usize % 3]
    }

    pub(super) fn ends(&self, half: u32) -> [u32; 2] {
        [self.tail(half), self.tail(next(half))]
    }

    /// The half-edges that leave the tail of `first`, one for each face around it: counter-clockwise, and
    /// after a boundary clockwise from the first.
    pub(super) fn around(&self, first: u32) -> impl Iterator<Item = u32> + '_ {
        let mut last = first;
        let mut is_left = true;
        let rest = std::iter::from_fn(move || {
            if is_left {
                match self.twin[previous(last) as usize] {
                    NONE => (last, is_left) = (first, false),
                    half => {
                        last = half;
                        return (half != first).then_some(half);
                    }
                }
            }
            match self.twin[last as usize] {
                NONE => None,
                half => {
                    last = next(half);
                    Some(last)
                }
            }
        });
        std::iter::once(first).chain(rest)
    }

    /// Whether an edge joins the tail of a half-edge to a vertex.
    fn is_joined(&self, half: u32, to: u32) -> bool {
        let reaches = |h: u32| {
            [next(h), previous(h)]
                .into_iter()
                .any(|e| self.tail(e) == to)
        };
        self.around(half).any(reaches)
    }

    pub(super) fn is_held(&self, half: u32) -> bool {
        self.held[half as usize] != NONE
    }

    pub(super) fn region(&self, face: u32) -> u32 {
        self.regions.of_face[self.origin[face as usize] as usize]
    }

    pub(super) fn position(&self, vertex: u32) -> Vec3 {
        self.vertices[vertex as usize]
    }

    pub(super) fn corners(&self, face: u32) -> [Vec3; 3] {
        self.triangles[face as usize].map(|v| self.position(v))
    }

    /// The coordinates of vertices in the plane of a region.
    pub(super) fn in_plane<const N: usize>(&self, region: u32, of: [u32; N]) -> [[f64; 2]; N] {
        let plane = &self.regions.planes[region as usize];
        of.map(|v| plane.coordinates(self.position(v)))
    }

    /// Whether a triangle of the region would be seen from the right side and have an area.
    fn is_sound(&self, region: u32, corners: [Vec3; 3]) -> bool {
        let plane = &self.regions.planes[region as usize];
        orientation(corners.map(|p| plane.coordinates(p))) > 0.0 && !has_no_area(corners)
    }

    /// Splits an edge in its middle and restores the Delaunay property around; false where the triangles
    /// have no room for it.
    pub(super) fn split_in_the_middle(&mut self, half: u32) -> bool {
        let [a, b] = self.ends(half).map(|v| self.position(v));
        let middle = scale(add(a, b), 0.5);
        let (p, on) = match self.held[half as usize] {
            NONE => self.on_the_surface(half / 3, middle),
            edge => (middle, self.mesh.edge(edge as usize).first.0 as u32),
        };
        self.split_edge(half, p, on)
    }

    /// Splits an edge at a point of an original face.
    pub(super) fn split_edge(&mut self, half: u32, p: Vec3, on: u32) -> bool {
        let other = self.twin[half as usize];
        if other != NONE && self.tail(previous(half)) == self.tail(previous(other)) {
            // Two faces with the same corners: a vertex on their edge would have two edges to the third.
            let face = half / 3;
            let sum = self.corners(face).into_iter().reduce(add);
            let middle = sum.map_or([0.0; 3], |sum| scale(sum, 1.0 / 3.0));
            let (p, on) = self.on_the_surface(face, middle);
            return self.split_face(face, p, on);
        }
        for side in [half, other].into_iter().filter(|&side| side != NONE) {
            let region = self.region(side / 3);
            let [a, b, c] = [side, next(side), previous(side)].map(|h| self.position(self.tail(h)));
            if !self.is_sound(region, [a, p, c]) || !self.is_sound(region, [p, b, c]) {
                return false;
            }
        }
        let m = self.add_vertex(p, on);
        let [first, second] = self.halve(half, m, on);
        if other != NONE {
            let [third, fourth] = self.halve(other, m, on);
            self.join(first, fourth);
            self.join(second, third);
        }
        self.restore_delaunay(m, first / 3);
        true
    }

    /// Splits the face of a half-edge between the vertex `m` on it and the opposite corner. Gives the two
    /// parts of the half-edge, whose opposites are not yet set.
    fn halve(&mut self, half: u32, m: u32, on: u32) -> [u32; 2] {
        let [across, back] = [next(half), previous(half)];
        let [a, b, c] = [half, across, back].map(|h| self.tail(h));
        let outer = [across, back].map(|h| (self.twin[h as usize], self.held[h as usize]));
        let (edge, face) = (self.held[half as usize], half / 3);
        let added = self.add_face(face);
        self.set_face(face, [a, m, c]);
        self.set_face(added, [m, b, c]);
        let (first, second) = (3 * face, 3 * added);
        self.held[first as usize] = edge;
        self.held[second as usize] = edge;
        self.attach(second + 1, outer[0]);
        self.attach(first + 2, outer[1]);
        self.join(first + 1, second + 2);
        self.place([face, added], on);
        [first, second]
    }

    /// Puts a vertex into a face; false where the face has no room for it.
    pub(super) fn split_face(&mut self, face: u32, p: Vec3, on: u32) -> bool {
        let [a, b, c] = self.triangles[face as usize];
        let region = self.region(face);
        let at = |v: u32| self.position(v);
        let parts = [[at(a), at(b), p], [at(b), at(c), p], [at(c), at(a), p]];
        if parts.iter().any(|&part| !self.is_sound(region, part)) {
            return false;
        }
        let outer = [0, 1, 2].map(|k| {
            let half = 3 * face as usize + k;
            (self.twin[half], self.held[half])
        });
        let m = self.add_vertex(p, on);
        let faces = [face, self.add_face(face), self.add_face(face)];
        for (k, (ends, outer)) in [[a, b], [b, c], [c, a]].into_iter().zip(outer).enumerate() {
            self.set_face(faces[k], [ends[0], ends[1], m]);
            self.attach(3 * faces[k], outer);
        }
        for k in 0..3 {
            self.join(3 * faces[k] + 1, 3 * faces[(k + 1) % 3] + 2);
        }
        self.place(faces, on);
        self.restore_delaunay(m, face);
        true
    }

    /// Flips an edge that is not held if both new triangles are sound and the new edge is new: the other
    /// side of a thin plate may have it.
    pub(super) fn flip(&mut self, half: u32) -> bool {
        let other = self.twin[half as usize];
        let (f, g) = (half / 3, other / 3);
        let [a, b] = self.ends(half);
        let [c, d] = [half, other].map(|h| self.tail(previous(h)));
        let region = self.region(f);
        let sound = [[a, d, c], [d, b, c]]
            .into_iter()
            .all(|corners| self.is_sound(region, corners.map(|v| self.position(v))));
        if !sound || self.is_joined(previous(half), d) {
            return false;
        }
        let outer = |h: u32| (self.twin[h as usize], self.held[h as usize]);
        let [bc, ca] = [next(half), previous(half)].map(outer);
        let [ad, db] = [next(other), previous(other)].map(outer);
        self.set_face(f, [a, d, c]);
        self.set_face(g, [d, b, c]);
        self.attach(3 * f, ad);
        self.attach(3 * f + 2, ca);
        self.attach(3 * g, db);
        self.attach(3 * g + 1, bc);
        self.join(3 * f + 1, 3 * g + 2);
        self.changed.extend([f, g]);
        self.counts.flips += 1;
        true
    }

    fn add_vertex(&mut self, p: Vec3, on: u32) -> u32 {
        self.counts.splits += 1;
        self.vertices.push(p);
        self.vertex_face.push(on);
        self.vertices.len() as u32 - 1
    }

    fn add_face(&mut self, like: u32) -> u32 {
        self.triangles.push([0; 3]);
        self.twin.extend([NONE; 3]);
        self.held.extend([NONE; 3]);
        self.origin.push(self.origin[like as usize]);
        self.triangles.len() as u32 - 1
    }

    fn set_face(&mut self, face: u32, corners: [u32; 3]) {
        let first = 3 * face as usize;
        self.triangles[face as usize] = corners;
        self.twin[first..first + 3].fill(NONE);
        self.held[first..first + 3].fill(NONE);
    }

    fn join(&mut self, a: u32, b: u32) {
        self.twin[a as usize] = b;
        self.twin[b as usize] = a;
    }

    fn attach(&mut self, half: u32, (twin, held): (u32, u32)) {
        self.held[half as usize] = held;
        if twin != NONE {
            self.join(half, twin);
        }
    }

    /// Notes that faces have changed, and that they are near an original face if it is of their region.
    fn place<const N: usize>(&mut self, faces: [u32; N], on: u32) {
        for face in faces {
            if self.regions.of_face[on as usize] == self.region(face) {
                self.origin[face as usize] = on;
            }
            self.changed.push(face);
        }
    }

    /// Puts a vertex into each face whose three edges are features: quads can follow only two edges of a
    /// triangle.
    pub(super) fn open_enclosed_faces(&mut self, features: &FeatureGraph) {
        for face in 0..self.mesh.face_count() {
            if (0..3).all(|k| features.contains(self.mesh.edge_of(face, k))) {
                self.split_face(face as u32, self.mesh.face_centroid(face), face as u32);
            }
        }
    }
}
