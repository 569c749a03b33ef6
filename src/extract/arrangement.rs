//! All integer lines of all triangles: chords are joined over edges and have integer points where they cross.

use super::chords::{Chord, Triangle};
use super::cones::Ray;
use super::crossings::Crossings;
use super::graph::{Graph, Place};
use super::refined::{NONE, Refined};
use crate::error::Result;
use crate::monitor::may_continue_at;

/// Flag of a chord's end that is the start of a ray and not a crossing of an edge.
pub(super) const RAY: u32 = 1 << 31;

/// A chord, which is one piece of a line.
pub(super) struct Piece {
    /// The crossing at each end, as 2 c + side, or [`RAY`] and the number of the ray.
    pub(super) ends: [u32; 2],
    /// The first port from each end; `NONE` if no line crosses the chord.
    pub(super) ports: [u32; 2],
}

/// The pieces of lines, and the integer points within triangles with the ports between them.
pub(super) struct Arrangement {
    pub(super) pieces: Vec<Piece>,
    /// The end of the piece on each side of each crossing, as 2 piece + end.
    pub(super) at_crossing: Vec<u32>,
    /// For each side of each crossing, the half-edge out of the face on that side.
    pub(super) half_edge: Vec<u32>,
    pub(super) rays: Vec<Ray>,
    pub(super) points: Graph,
    /// For each edge from a boundary vertex, the side of its first crossing, as 2 c + side.
    pub(super) near_boundary: Vec<u32>,
}

impl Arrangement {
    pub(super) fn new(mesh: &Refined) -> Result<Self> {
        let crossings = Crossings::new(mesh)?;
        let sides = 2 * crossings.len();
        let mut this = Arrangement {
            pieces: Vec::with_capacity(2 * sides),
            at_crossing: vec![NONE; sides],
            half_edge: vec![NONE; sides],
            rays: Vec::new(),
            points: Graph::default(),
            near_boundary: Vec::new(),
        };
        let is_bounding = mesh.regular_boundary_vertices();
        for h in 0..mesh.twin.len() {
            may_continue_at(h)?;
            let side = u32::from(mesh.twin[h] < h as u32);
            let mut sides = crossings.of(mesh, h).map(|(c, _)| 2 * c + side);
            let first = sides.next();
            for side in first.into_iter().chain(sides) {
                this.half_edge[side as usize] = h as u32;
            }
            if is_bounding[mesh.vertices[h / 3][h % 3] as usize] {
                this.near_boundary.extend(first);
            }
        }
        let mut triangle = Triangle::default();
        for face in 0..mesh.face_count() {
            may_continue_at(face)?;
            triangle.load(mesh, &crossings, face);
            this.add_triangle(face, &triangle);
        }
        Ok(this)
    }

    fn add_triangle(&mut self, face: usize, triangle: &Triangle) {
        let rays = self.rays.len();
        let mut first = [0; 2];
        for axis in 0..2 {
            first[axis] = self.pieces.len();
            for chord in &triangle.chords[axis] {
                self.add_piece(face, triangle, chord);
            }
        }
        // The rays of one corner, counter-clockwise around it.
        self.rays[rays..].sort_by_key(|ray| ray.towards);
        for ray in rays..self.rays.len() {
            let Ray { piece, end, .. } = self.rays[ray];
            self.pieces[piece as usize].ends[usize::from(end)] = RAY | ray as u32;
        }
        self.cross(face, triangle, first);
    }

    fn add_piece(&mut self, face: usize, triangle: &Triangle, chord: &Chord) {
        let piece = self.pieces.len() as u32;
        let ends = chord.at.map(|at| triangle.border[at]);
        for (end, &crossing) in ends.iter().enumerate() {
            if crossing != NONE {
                self.at_crossing[crossing as usize] = 2 * piece + end as u32;
            } else if let Some(k) = triangle.corner(chord.at[end]) {
                let towards = chord.at[1 - end];
                let across = 1 - usize::from(chord.line.axis);
                let is_above = triangle.is_above_corner(k, across, towards);
                self.rays.push(Ray {
                    corner: (3 * face + k) as u32,
                    towards,
                    piece,
                    end: end as u8,
                    direction: direction(across, is_above),
                });
            }
        }
        self.pieces.push(Piece {
            ends,
            ports: [NONE; 2],
        });
    }

    /// Adds the integer points of a triangle, and joins neighbours along its chords.
    fn cross(&mut self, face: usize, triangle: &Triangle, first: [usize; 2]) {
        let [us, vs] = &triangle.chords;
        if us.is_empty() || vs.is_empty() {
            return;
        }
        // A chord, a place along it, and the ports towards its ends.
        let mut along: [Vec<(usize, usize, [u32; 2])>; 2] = Default::default();
        for (i, u) in us.iter().enumerate() {
            for (j, v) in vs.iter().enumerate().filter(|(_, v)| u.crosses(v)) {
                let port = self.points.port_count() as u32;
                let to_u = u.at.map(|at| direction(1, triangle.is_above(v, at)));
                let to_v = v.at.map(|at| direction(0, triangle.is_above(u, at)));
                let u_first = u.at[0] < v.at[0];
                let directions = match u_first {
                    true => [to_u[0], to_v[0], to_u[1], to_v[1]],
                    false => [to_v[0], to_u[0], to_v[1], to_u[1]],
                };
                let place = Place::Face(face as u32, [u.line.level, v.line.level]);
                self.points.add(place, &directions);
                let [pu, pv] = if u_first {
                    [port, port + 1]
                } else {
                    [port + 1, port]
                };
                along[0].push((i, u.between(v), [pu, pu + 2]));
                along[1].push((j, v.between(u), [pv, pv + 2]));
            }
        }
        for (axis, mut along) in along.into_iter().enumerate() {
            along.sort_unstable();
            for chord in along.chunk_by(|a, b| a.0 == b.0) {
                let piece = &mut self.pieces[first[axis] + chord[0].0];
                piece.ports = [chord[0].2[0], chord[chord.len() - 1].2[1]];
                for pair in chord.windows(2) {
                    self.points.join(pair[0].2[1], pair[1].2[0], 0);
                }
            }
        }
    }
}

/// The direction in which a coordinate grows or decreases.
fn direction(axis: usize, is_growing: bool) -> u8 {
    axis as u8 + if is_growing { 0 } else { 2 }
}
