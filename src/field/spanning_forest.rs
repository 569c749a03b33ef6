//! The spanning forest of the dual graph along which period jumps are zero.
//!
//! All jumps on a tree of dual edges can be moved to zero by turning the frames of its faces by quarter
//! turns, as long as no two constrained faces lie in one tree (`bommes2009`, section 4.1, "reducing the
//! search space").

use std::collections::VecDeque;

use crate::mesh::TriangleMesh;
use crate::monitor::{Stop, may_continue_at};

/// Whether each edge of the mesh belongs to the forest.
///
/// The search is breadth-first from the `rooted` faces, those with a given direction, and visits faces
/// and neighbours in increasing order. A component without such a face grows from its lowest face.
///
/// # Errors
/// The end of the call.
pub(super) fn spanning_forest(mesh: &TriangleMesh, rooted: &[bool]) -> Result<Vec<bool>, Stop> {
    let mut in_forest = vec![false; mesh.edge_count()];
    let mut reached = rooted.to_vec();
    let roots = (0..mesh.face_count()).filter(|&f| rooted[f]);
    let mut queue: VecDeque<usize> = roots.collect();
    let mut lowest = 0;
    loop {
        while let Some(face) = queue.pop_front() {
            may_continue_at(face)?;
            let across = |k| Some((mesh.neighbor(face, k)?.0, mesh.edge_of(face, k)));
            let mut next = [0, 1, 2].map(across);
            next.sort_unstable();
            for (neighbor, edge) in next.into_iter().flatten() {
                if !reached[neighbor] {
                    reached[neighbor] = true;
                    in_forest[edge] = true;
                    queue.push_back(neighbor);
                }
            }
        }
        match (lowest..mesh.face_count()).find(|&f| !reached[f]) {
            Some(face) => {
                reached[face] = true;
                lowest = face + 1;
                queue.push_back(face);
            }
            None => return Ok(in_forest),
        }
    }
}
