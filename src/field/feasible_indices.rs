//! Indices that no map can have, spread over vertices nearby.
//!
//! The smoothest field may turn at one vertex as often as the surface does: the tip of a horn gets
//! index 1, around which no angle is left for a map, as `2 pi (1 - I)` is what its triangles have to
//! share. Where that is too little or more than they can hold, quarters move to the nearest vertices
//! that can take them.

use std::collections::{BTreeSet, VecDeque};

use crate::mesh::TriangleMesh;

/// Quarters of the largest index that a vertex keeps: half a turn is left, as at the end of a
/// pillow.
pub(super) const MOST: i32 = 2;

/// Quarters of the least index that a vertex keeps: six quads meet.
const LEAST: i32 = -2;

/// The same indices, in quarters, none beyond what a map can have, as long as there is where to put the
/// rest.
pub(super) fn feasible_indices(mesh: &TriangleMesh, mut steps: Vec<i32>) -> Vec<i32> {
    for v in 0..steps.len() {
        while steps[v] > MOST {
            let Some(to) = nearest(mesh, v, |w| steps[w] < 1) else {
                return steps;
            };
            steps[v] -= 1;
            steps[to] += 1;
        }
        while steps[v] < least(mesh, v) {
            let Some(to) = nearest(mesh, v, |w| steps[w] > least(mesh, w).max(-1)) else {
                return steps;
            };
            steps[v] += 1;
            steps[to] -= 1;
        }
    }
    steps
}

/// The least quarters for a vertex: its triangles share less than half a turn each.
fn least(mesh: &TriangleMesh, vertex: usize) -> i32 {
    LEAST.max(5 - 2 * mesh.face_degree(vertex) as i32)
}

/// The first interior vertex breadth-first from one, itself excepted, that will do.
fn nearest(mesh: &TriangleMesh, from: usize, will_do: impl Fn(usize) -> bool) -> Option<usize> {
    let mut is_seen = BTreeSet::from([from]);
    let mut queue = VecDeque::from([from]);
    while let Some(v) = queue.pop_front() {
        for (face, corner) in mesh.ring(v) {
            let w = mesh.corners(face)[(corner + 1) % 3];
            if is_seen.insert(w) {
                if !mesh.is_boundary_vertex(w) && will_do(w) {
                    return Some(w);
                }
                queue.push_back(w);
            }
        }
    }
    None
}
