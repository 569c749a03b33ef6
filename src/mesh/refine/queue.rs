//! Which edge is split and which triangle is improved next: the longest edge, then the smallest angle.
//!
//! Entries are not removed when the mesh changes: an entry that no longer fits it is dropped when its turn
//! comes. Lengths are compared as squares and angles as squared sines, so that a mesh scaled by a power
//! of two is refined in the same way.

use std::cmp::Reverse;
use std::collections::BinaryHeap;

use super::RefineOptions;
use super::working_mesh::WorkingMesh;
use crate::mesh::vector::{Vec3, cross, dot, sub};

/// The shortest held edge that is split for the sake of an angle, as a part of the longest edge. Where two
/// held edges meet at a small angle, splits would go on forever.
const SHORTEST: f64 = 1.0 / 256.0;

/// What is done next.
pub(super) enum Next {
    /// Split this half-edge.
    Long(u32),
    /// Improve this face.
    Thin(u32),
}

pub(super) struct Queue {
    /// Squared length, ends, half-edge.
    long: BinaryHeap<(u64, Reverse<[u32; 2]>, u32)>,
    /// Squared sine of the smallest angle, corners, face.
    thin: BinaryHeap<Reverse<(u64, [u32; 3], u32)>>,
    most: f64,
    least: f64,
    shortest: f64,
}

impl Queue {
    /// The edges that are too long and the triangles that are too thin, after these have been made
    /// Delaunay.
    pub(super) fn new(work: &mut WorkingMesh, options: &RefineOptions) -> Self {
        let sine = options.smallest_angle.sin();
        let shortest = SHORTEST * options.longest_edge;
        let queue = Queue {
            long: BinaryHeap::new(),
            thin: BinaryHeap::new(),
            most: options.longest_edge * options.longest_edge,
            least: sine * sine,
            shortest: shortest * shortest,
        };
        let faces = 0..work.triangles.len() as u32;
        let is_at_fault = |&face: &u32| {
            let is_long = |half| squared_length(work, half) > queue.most;
            smallest_angle(work.corners(face)).0 < queue.least
                || (3 * face..3 * face + 3).any(is_long)
        };
        let at_fault: Vec<u32> = faces.filter(is_at_fault).collect();
        work.changed.extend_from_slice(&at_fault);
        let edges = at_fault
            .iter()
            .rev()
            .flat_map(|face| 3 * face..3 * face + 3);
        work.flip_to_delaunay(edges.collect());
        queue
    }

    /// Takes in the faces that have changed.
    pub(super) fn update(&mut self, work: &mut WorkingMesh) {
        for face in std::mem::take(&mut work.changed) {
            for half in 3 * face..3 * face + 3 {
                let length = squared_length(work, half);
                if length > self.most {
                    let ends = Reverse(work.ends(half));
                    self.long.push((length.to_bits(), ends, half));
                }
            }
            self.again(work, face);
        }
    }

    /// Adds a face if it is too thin.
    pub(super) fn again(&mut self, work: &WorkingMesh, face: u32) {
        let (angle, _) = smallest_angle(work.corners(face));
        if angle < self.least {
            let corners = work.triangles[face as usize];
            self.thin.push(Reverse((angle.to_bits(), corners, face)));
        }
    }

    pub(super) fn next(&mut self, work: &WorkingMesh) -> Option<Next> {
        while let Some((_, Reverse(ends), half)) = self.long.pop() {
            if work.ends(half) == ends {
                return Some(Next::Long(half));
            }
        }
        while let Some(Reverse((_, corners, face))) = self.thin.pop() {
            if work.triangles[face as usize] == corners {
                return Some(Next::Thin(face));
            }
        }
        None
    }

    /// The squared length of the shortest edge that is split for the sake of an angle.
    pub(super) fn shortest_split(&self) -> f64 {
        self.shortest
    }
}

pub(super) fn squared_length(work: &WorkingMesh, half: u32) -> f64 {
    let [a, b] = work.ends(half).map(|v| work.position(v));
    let along = sub(b, a);
    dot(along, along)
}

/// The squared sine of the smallest angle of a triangle, which is acute, and its corner.
pub(super) fn smallest_angle(corners: [Vec3; 3]) -> (f64, usize) {
    let [a, b, c] = corners;
    // The edge opposite of each corner.
    let opposite = [sub(c, b), sub(a, c), sub(b, a)];
    let lengths = opposite.map(|edge| dot(edge, edge));
    let corner = (1..3).fold(0, |best, k| match lengths[k] < lengths[best] {
        true => k,
        false => best,
    });
    let area = cross(opposite[0], opposite[1]);
    let others = lengths[(corner + 1) % 3] * lengths[(corner + 2) % 3];
    (dot(area, area) / others, corner)
}
