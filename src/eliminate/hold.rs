//! Reduced unknowns held at a value: their columns are removed from the reduced model.

use crate::error::Result;
use crate::linalg::{NO_PLACE, Sparse, places};

/// The reduced unknowns that are not held, increasing.
pub(super) fn kept(dim: usize, held: &[(u32, f64)]) -> Vec<u32> {
    let mut free = vec![true; dim];
    held.iter().for_each(|&(y, _)| free[y as usize] = false);
    (0..dim as u32).filter(|&y| free[y as usize]).collect()
}

/// The expansion without the columns of held unknowns, whose values move into the offset.
pub(super) fn expansion(
    matrix: &Sparse,
    mut offset: Vec<f64>,
    kept: &[u32],
    held: &[(u32, f64)],
) -> Result<(Sparse, Vec<f64>)> {
    let place = places(matrix.cols(), kept);
    let mut value = vec![0.0; matrix.cols()];
    held.iter().for_each(|&(y, z)| value[y as usize] = z);
    for (i, y, t) in matrix.entries() {
        if place[y as usize] == NO_PLACE {
            offset[i as usize] += t * value[y as usize];
        }
    }
    let inner = matrix.entries().filter(|e| place[e.1 as usize] != NO_PLACE);
    let moved = inner.map(|(i, y, t)| (i, place[y as usize], t));
    Ok((
        Sparse::from_triplets(matrix.rows(), kept.len(), moved)?,
        offset,
    ))
}
