//! Submatrices, most of them of a symmetric matrix that is given by its lower triangle.

use std::ops::Range;

use super::Sparse;
use super::sparse::reserve;
use crate::error::Result;
use crate::monitor::in_parts;

/// The least number of rows that are worth a thread.
const LEAST: usize = 1 << 14;

/// The place of an unknown that is no member.
pub const NO_PLACE: u32 = u32::MAX;

/// The place of each of `dim` unknowns in `members`; [`NO_PLACE`] for all other unknowns.
pub fn places(dim: usize, members: &[u32]) -> Vec<u32> {
    let mut place = vec![NO_PLACE; dim];
    for (k, &i) in members.iter().enumerate() {
        place[i as usize] = k as u32;
    }
    place
}

/// The lower triangle of the principal submatrix of `members`, which must increase.
///
/// # Errors
/// [`Error::OutOfMemory`](crate::Error::OutOfMemory).
pub fn principal_submatrix(lower: &Sparse, members: &[u32]) -> Result<Sparse> {
    let place = places(lower.rows(), members);
    rows_of(lower, members, &place, members.len())
}

/// The columns `members`, which must increase, of any matrix.
///
/// # Errors
/// [`Error::OutOfMemory`](crate::Error::OutOfMemory).
pub fn columns(matrix: &Sparse, members: &[u32]) -> Result<Sparse> {
    let all: Vec<u32> = (0..matrix.rows() as u32).collect();
    let place = places(matrix.cols(), members);
    rows_of(matrix, &all, &place, members.len())
}

/// The block with the rows `rows` and the columns `cols`, both of which must increase and have no member in common.
///
/// # Errors
/// [`Error::OutOfMemory`](crate::Error::OutOfMemory).
pub fn coupling(lower: &Sparse, rows: &[u32], cols: &[u32]) -> Result<Sparse> {
    let (row, col) = (places(lower.rows(), rows), places(lower.rows(), cols));
    let before = rows_of(lower, rows, &col, cols.len())?;
    let after = rows_of(lower, cols, &row, rows.len())?;
    match [before.len(), after.len()] {
        [_, 0] => Ok(before),
        [0, _] => Ok(after.transpose()),
        // The columns of the lower triangle precede those that its rows give by symmetry.
        _ => side_by_side(&before, &after.transpose()),
    }
}

/// The rows `members` of a matrix, which must increase, with those of its entries that have a place among so many
/// columns.
fn rows_of(matrix: &Sparse, members: &[u32], place: &[u32], columns: usize) -> Result<Sparse> {
    let of_rows = |part: Range<usize>| {
        let rows = &members[part];
        let most = match (rows.first(), rows.last()) {
            (Some(&a), Some(&b)) => matrix.offsets()[b as usize + 1] - matrix.offsets()[a as usize],
            _ => 0,
        };
        let mut offsets = reserve(rows.len() + 1)?;
        let (mut indices, mut values) = (reserve(most)?, reserve(most)?);
        offsets.push(0);
        for &i in rows {
            for (j, v) in matrix.row(i as usize) {
                if place[j] != NO_PLACE {
                    indices.push(place[j]);
                    values.push(v);
                }
            }
            offsets.push(indices.len());
        }
        Ok(Sparse::from_parts(columns, offsets, indices, values))
    };
    Sparse::stacked(in_parts(members.len(), LEAST, of_rows))
}

/// The entries of two matrices of one shape, where those of the first precede those of the second in each row.
fn side_by_side(first: &Sparse, second: &Sparse) -> Result<Sparse> {
    let count = first.len() + second.len();
    let mut offsets = reserve(first.rows() + 1)?;
    let (mut indices, mut values) = (reserve(count)?, reserve(count)?);
    offsets.push(0);
    for i in 0..first.rows() {
        for (j, v) in first.row(i).chain(second.row(i)) {
            indices.push(j as u32);
            values.push(v);
        }
        offsets.push(indices.len());
    }
    Ok(Sparse::from_parts(first.cols(), offsets, indices, values))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::monitor::{spawned, with_threads};

    #[test]
    fn parts_hold_the_entries_of_the_whole() {
        let n = 7;
        let value = |i: u32, j: u32| f64::from(10 * i.max(j) + i.min(j));
        let lower = (0..n).flat_map(|i| (0..=i).map(move |j| (i, j, value(i, j))));
        let a = Sparse::from_triplets(n as usize, n as usize, lower).unwrap();
        let (some, others) = ([1, 2, 5], [0, 3, 6]);
        let own = principal_submatrix(&a, &some).unwrap();
        assert_eq!(own.len(), 6);
        for (a, b, v) in own.entries() {
            assert!(b <= a);
            assert_eq!(v, value(some[a as usize], some[b as usize]));
        }
        let mixed = coupling(&a, &some, &others).unwrap();
        assert_eq!(mixed.len(), 9);
        for (a, b, v) in mixed.entries() {
            assert_eq!(v, value(some[a as usize], others[b as usize]));
        }
    }

    #[test]
    fn any_number_of_threads_takes_the_same_rows() {
        let n = 4 * LEAST as u32;
        let band =
            (0..n).flat_map(|i| (i.saturating_sub(2)..=i).map(move |j| (i, j, f64::from(i + j))));
        let a = Sparse::from_triplets(n as usize, n as usize, band).unwrap();
        let members: Vec<u32> = (0..n).filter(|i| i % 5 != 1).collect();
        let of_members = |threads| with_threads(threads, || principal_submatrix(&a, &members));
        let one = of_members(1).unwrap();
        assert_eq!((one.rows(), one.cols()), (members.len(), members.len()));
        assert_eq!(spawned(|| assert_eq!(of_members(3).unwrap(), one)), 2);
    }
}
