//! Reduced unknowns held at a value: their columns leave the reduced model.

use crate::Result;
use crate::linalg::Sparse;

const NONE: u32 = u32::MAX;

/// The reduced unknowns that are not held, increasing.
pub(super) fn kept(dim: usize, held: &[(u32, f64)]) -> Vec<u32> {
    let mut free = vec![true; dim];
    held.iter().for_each(|&(y, _)| free[y as usize] = false);
    (0..dim as u32).filter(|&y| free[y as usize]).collect()
}

/// The lower triangle's rows and columns of the unknowns kept.
pub(super) fn hessian(lower: &Sparse, kept: &[u32]) -> Result<Sparse> {
    let place = places(lower.rows(), kept);
    let both =
        |&(i, j, _): &(u32, u32, f64)| place[i as usize] != NONE && place[j as usize] != NONE;
    let inner = lower.entries().filter(both);
    let moved = inner.map(|(i, j, v)| (place[i as usize], place[j as usize], v));
    Sparse::from_triplets(kept.len(), kept.len(), moved)
}

/// The expansion without the columns of held unknowns, which go into the offset.
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
        if place[y as usize] == NONE {
            offset[i as usize] += t * value[y as usize];
        }
    }
    let inner = matrix.entries().filter(|e| place[e.1 as usize] != NONE);
    let moved = inner.map(|(i, y, t)| (i, place[y as usize], t));
    Ok((
        Sparse::from_triplets(matrix.rows(), kept.len(), moved)?,
        offset,
    ))
}

fn places(dim: usize, kept: &[u32]) -> Vec<u32> {
    let mut place = vec![NONE; dim];
    for (k, &y) in kept.iter().enumerate() {
        place[y as usize] = k as u32;
    }
    place
}
