//! The mesh on which lines are traced: the mesh of the map with edges between irregular vertices split.
//!
//! Irregular vertices are the only ones on integer lines, so an edge between two of them may lie
//! along a line. A vertex in its middle, off the line, prevents that.

use std::collections::BTreeMap;

use super::IntegerGridMap;
use crate::mesh::{TriangleMesh, turned};

/// No half-edge, port or vertex.
pub(super) const NONE: u32 = u32::MAX;

/// Triangles with exact coordinates. Half-edges are named by 3 f + k.
pub(super) struct Refined {
    pub(super) corners: Vec<[[i64; 2]; 3]>,
    pub(super) vertices: Vec<[u32; 3]>,
    pub(super) twin: Vec<u32>,
    /// Quarter turns over every half-edge, out of its face.
    pub(super) turn: Vec<u8>,
    pub(super) is_irregular: Vec<bool>,
    /// For a part of a split face: the face of the mesh, and the places of the part's corners in it.
    parts: BTreeMap<u32, (u32, [[f64; 3]; 3])>,
}

impl Refined {
    pub(super) fn new(mesh: &TriangleMesh, map: &IntegerGridMap) -> Self {
        let sides = (0..mesh.face_count()).flat_map(|f| [(f, 0), (f, 1), (f, 2)]);
        let twin = sides.map(|(f, k)| {
            mesh.neighbor(f, k)
                .map_or(NONE, |(g, l)| (3 * g + l) as u32)
        });
        let mut refined = Refined {
            corners: map.corners.clone(),
            vertices: mesh.triangles().to_vec(),
            twin: twin.collect(),
            turn: map.turns.as_flattened().to_vec(),
            is_irregular: map.is_irregular.clone(),
            parts: BTreeMap::new(),
        };
        let mut h = 0;
        while h < refined.twin.len() {
            let ends = [h, next(h)].map(|h| refined.vertices[h / 3][h % 3] as usize);
            if ends.iter().all(|&v| refined.is_irregular[v]) {
                refined.split(h);
            }
            h += 1;
        }
        refined
    }

    pub(super) fn face_count(&self) -> usize {
        self.corners.len()
    }

    /// Whether each vertex is one of the boundary and off the integer lines.
    pub(super) fn regular_boundary_vertices(&self) -> Vec<bool> {
        let mut found = vec![false; self.is_irregular.len()];
        for h in (0..self.twin.len()).filter(|&h| self.twin[h] == NONE) {
            for h in [h, next(h)] {
                let vertex = self.vertices[h / 3][h % 3] as usize;
                found[vertex] = !self.is_irregular[vertex];
            }
        }
        found
    }

    /// Coordinates of the corner at which a half-edge starts.
    pub(super) fn start(&self, h: usize) -> [i64; 2] {
        self.corners[h / 3][h % 3]
    }

    /// The translation of the transition over `h`, which is applied after the turn.
    pub(super) fn shift(&self, h: usize) -> [i64; 2] {
        let turned = turned(self.turn[h], self.start(h));
        let there = self.start(next(self.twin[h] as usize));
        [0, 1].map(|axis| there[axis] - turned[axis])
    }

    /// A point of a face as a point of the mesh: the face there, and barycentric coordinates.
    pub(super) fn origin(&self, face: usize, at: [f64; 3]) -> (usize, [f64; 3]) {
        let Some((parent, corners)) = self.parts.get(&(face as u32)) else {
            return (face, at);
        };
        let sum = |i: usize| (0..3).map(|k| at[k] * corners[k][i]).sum();
        (*parent as usize, [sum(0), sum(1), sum(2)])
    }

    /// Puts a vertex into the middle of an interior edge.
    fn split(&mut self, h: usize) {
        let g = self.twin[h] as usize;
        let (a, b) = (self.start(h), self.start(next(h)));
        // Odd, so that the vertex lies on no line.
        let middle = [0, 1].map(|axis| (a[axis] + (b[axis] - a[axis]) / 2) | 1);
        let shift = self.shift(h);
        let turned = turned(self.turn[h], middle);
        let across = [0, 1].map(|axis| turned[axis] + shift[axis]);
        let vertex = self.is_irregular.len() as u32;
        self.is_irregular.push(false);
        let here = self.halve(h, vertex, middle);
        let there = self.halve(g, vertex, across);
        // The first half of one side runs along the second half of the other.
        let quarters = self.turn[h];
        self.glue(h, there, quarters);
        self.glue(here, g, quarters);
    }

    /// Cuts the face of `h` in two: (A, B, C) becomes (A, M, C) and (M, B, C). Returns the new half
    /// of the edge, M to B.
    fn halve(&mut self, h: usize, vertex: u32, middle: [i64; 2]) -> usize {
        let (face, k) = (h / 3, h % 3);
        let new = self.corners.len();
        let (parent, places) = match self.parts.get(&(face as u32)) {
            Some(&part) => part,
            None => (
                face as u32,
                [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]],
            ),
        };
        let [a, b] = [places[k], places[(k + 1) % 3]];
        let place = [0, 1, 2].map(|i| 0.5 * (a[i] + b[i]));
        let mut new_places = places;
        let mut old_places = places;
        new_places[k] = place;
        old_places[(k + 1) % 3] = place;
        self.parts.insert(face as u32, (parent, old_places));
        self.parts.insert(new as u32, (parent, new_places));

        let mut corners = self.corners[face];
        corners[k] = middle;
        self.corners.push(corners);
        self.corners[face][(k + 1) % 3] = middle;
        let mut vertices = self.vertices[face];
        vertices[k] = vertex;
        self.vertices.push(vertices);
        self.vertices[face][(k + 1) % 3] = vertex;

        let base = 3 * new;
        self.twin.extend([NONE; 3]);
        self.turn.extend([0; 3]);
        let (rest, inner) = (next(h), 3 * face + (k + 1) % 3);
        let (outer, quarters) = (self.twin[rest], self.turn[rest]);
        let moved = base + (k + 1) % 3;
        if outer != NONE {
            self.glue(moved, outer as usize, quarters);
        }
        self.glue(inner, base + (k + 2) % 3, 0);
        base + k
    }

    fn glue(&mut self, h: usize, g: usize, quarters: u8) {
        self.twin[h] = g as u32;
        self.twin[g] = h as u32;
        self.turn[h] = quarters;
        self.turn[g] = (4 - quarters) % 4;
    }
}

/// The half-edge after `h` in its face.
pub(super) fn next(h: usize) -> usize {
    if h % 3 == 2 { h - 2 } else { h + 1 }
}
