//! Indices that no map can have, spread over nearby vertices.
//!
//! The smoothest field may turn as much around a vertex as the surface does. The tip of a horn then gets
//! index 1. A map has the angle `2 pi (1 - I)` around a vertex of index I, so that none is left for the
//! triangles there. If the angle is too small or too large for its triangles, quarters of the index move
//! to the nearest vertices that can take them.

use std::collections::{BTreeSet, VecDeque};

use crate::mesh::TriangleMesh;

/// The largest index that a vertex keeps, in quarters: half a turn remains, as at the end of a pillow.
pub(super) const MOST: i32 = 2;

/// The least index that a vertex keeps, in quarters: six quads meet there.
const LEAST: i32 = -2;

/// The indices in quarters, changed so that a map can have each of them, as long as other vertices can
/// take the rest. Those that are to be regular take none.
pub(super) fn feasible_indices(
    mesh: &TriangleMesh,
    mut steps: Vec<i32>,
    regular: &[usize],
) -> Vec<i32> {
    let regular: BTreeSet<usize> = regular.iter().copied().collect();
    for v in 0..steps.len() {
        while steps[v] > MOST {
            let Some(to) = nearest(mesh, v, |w| steps[w] < 1 && !regular.contains(&w)) else {
                return steps;
            };
            steps[v] -= 1;
            steps[to] += 1;
        }
        while steps[v] < least(mesh, v) {
            let Some(to) = nearest(mesh, v, |w| {
                steps[w] > least(mesh, w).max(-1) && !regular.contains(&w)
            }) else {
                return steps;
            };
            steps[v] += 1;
            steps[to] -= 1;
        }
    }
    steps
}

/// The least index of a vertex in quarters: each of its triangles takes less than half a turn.
fn least(mesh: &TriangleMesh, vertex: usize) -> i32 {
    LEAST.max(5 - 2 * mesh.face_degree(vertex) as i32)
}

/// The first interior vertex that satisfies `will_do`, breadth-first from another one.
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
