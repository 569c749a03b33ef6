//! The supernodes of a factor: columns next to each other that have the same rows below, stored as one dense block.
//!
//! The numbers of entries of all columns follow from the elimination tree without the pattern of the factor
//! (`davis2006`, sections 4.4 and 4.5). A column joins the one before it if this is its only child and has the same
//! rows. Supernodes then join the one before them, if that is a child and few zeros are stored for it
//! (`ashcraft1989`), as few as CHOLMOD allows (`chen2008`). At last each row is put into all supernodes of its subtree
//! (`liu1990`, section 4).
//!
//! The longer loops ask whether the call goes on: on large problems these steps take half a second. faer finds the same
//! supernodes, as the tests hold, but cannot be interrupted.

use std::ops::Range;

use super::ordering::{NONE, inverse, parents, permute_pattern, post_order};
use super::sparse::reserve;
use super::{DisjointSets, Sparse};
use crate::error::Result;
use crate::monitor::{may_continue, may_continue_at};

/// A supernode with at most so many columns may store zeros up to this part of its block, one after the other.
const RELAXED: [(usize, f64); 4] = [(4, 1.0), (16, 0.8), (48, 0.1), (usize::MAX, 0.05)];

/// The supernodes of a factor, in the order of their columns.
#[derive(Debug, PartialEq)]
pub(super) struct Supernodes {
    /// The first column of each, and the number of all columns.
    first_column: Vec<u32>,
    /// Where the rows of each begin, and how many there are in all.
    first_row: Vec<usize>,
    rows: Vec<u32>,
    /// Where the block of each begins, and how many values there are in all.
    first_value: Vec<usize>,
}

impl Supernodes {
    /// The supernodes of the factor of the matrix with lower triangle `lower`, with unknown i at position `place[i]`.
    ///
    /// # Errors
    /// [`Error::OutOfMemory`](crate::Error::OutOfMemory), [`Error::Overflow`](crate::Error::Overflow), and the reason
    /// to end the current step.
    pub fn new(lower: &Sparse, place: &[u32]) -> Result<Self> {
        // The lower positions of each position.
        let pattern = permute_pattern(lower, place)?;
        let parent = parents(&pattern.0, &pattern.1)?;
        let counts = column_counts(&pattern, &parent)?;
        may_continue()?;
        let supernodes = relaxed(&fundamental(&parent, &counts)?);
        may_continue()?;
        Self::with_rows(&supernodes, &pattern, &parent)
    }

    /// These supernodes with their rows.
    fn with_rows(
        supernodes: &[Supernode],
        (offsets, columns): &(Vec<u32>, Vec<u32>),
        parent: &[u32],
    ) -> Result<Self> {
        let n = parent.len();
        let count = supernodes.len();
        let (mut first_column, mut first_row, mut first_value) = (
            reserve(count + 1)?,
            reserve(count + 1)?,
            reserve(count + 1)?,
        );
        let (mut of_column, mut row, mut value) = (filled(n, 0u32)?, 0, 0);
        for (s, supernode) in supernodes.iter().enumerate() {
            first_column.push(supernode.first as u32);
            first_row.push(row);
            first_value.push(value);
            of_column[supernode.columns()].fill(s as u32);
            row += supernode.below;
            value += supernode.width * (supernode.width + supernode.below);
        }
        first_column.push(n as u32);
        first_row.push(row);
        first_value.push(value);
        let above = |supernode: &Supernode| match parent[supernode.columns().end - 1] {
            NONE => NONE,
            column => of_column[column as usize],
        };
        let above: Vec<u32> = supernodes.iter().map(above).collect();
        let mut rows = filled(row, 0u32)?;
        let mut next = first_row.clone();
        // The last row for which each supernode was passed.
        let mut passed = filled(count, NONE)?;
        for i in 0..n {
            may_continue_at(i)?;
            passed[of_column[i] as usize] = i as u32;
            for &column in &columns[offsets[i] as usize..offsets[i + 1] as usize] {
                let mut s = of_column[column as usize] as usize;
                while passed[s] != i as u32 {
                    passed[s] = i as u32;
                    rows[next[s]] = i as u32;
                    next[s] += 1;
                    s = above[s] as usize;
                }
            }
        }
        Ok(Supernodes {
            first_column,
            first_row,
            rows,
            first_value,
        })
    }

    /// The number of supernodes.
    pub fn count(&self) -> usize {
        self.first_column.len() - 1
    }

    /// The number of columns of the factor.
    pub fn dim(&self) -> usize {
        self.first_column[self.count()] as usize
    }

    /// The number of values of all blocks.
    pub fn value_count(&self) -> usize {
        self.first_value[self.count()]
    }

    /// The columns of a supernode.
    pub fn columns(&self, s: usize) -> Range<usize> {
        self.first_column[s] as usize..self.first_column[s + 1] as usize
    }

    /// The number of columns of a supernode.
    pub fn width(&self, s: usize) -> usize {
        self.columns(s).len()
    }

    /// The rows below the columns of a supernode, increasing.
    pub fn rows(&self, s: usize) -> &[u32] {
        &self.rows[self.first_row[s]..self.first_row[s + 1]]
    }

    /// The place of a block among all values. It is dense and by columns: first the rows of its columns, then those
    /// below.
    pub fn values(&self, s: usize) -> Range<usize> {
        self.values_of(s..s + 1)
    }

    /// The place of the blocks of supernodes that follow each other.
    pub fn values_of(&self, supernodes: Range<usize>) -> Range<usize> {
        self.first_value[supernodes.start]..self.first_value[supernodes.end]
    }
}

/// A supernode without its rows.
#[derive(Clone, Copy)]
struct Supernode {
    first: usize,
    width: usize,
    /// The number of rows below its columns.
    below: usize,
    /// Whether the next supernode is its parent.
    is_followed: bool,
}

impl Supernode {
    fn columns(&self) -> Range<usize> {
        self.first..self.first + self.width
    }
}

/// The number of entries of each column of the factor, the diagonal included.
///
/// The columns with an entry in one row are a subtree. Each of its leaves adds one to all columns above it, and where
/// two of them meet, one of both is taken away again.
fn column_counts((offsets, columns): &(Vec<u32>, Vec<u32>), parent: &[u32]) -> Result<Vec<u32>> {
    let n = parent.len();
    let (starts, rows) = transposed(offsets, columns)?;
    let post = post_order(parent);
    // The place in the post-order of the first descendant.
    let mut first = filled(n, NONE)?;
    // By how much the number of a column differs from the sum of those of its children.
    let mut more = filled(n, 0i32)?;
    for (k, &j) in post.iter().enumerate() {
        may_continue_at(k)?;
        more[j as usize] = i32::from(first[j as usize] == NONE);
        let mut j = j;
        while j != NONE && first[j as usize] == NONE {
            first[j as usize] = k as u32;
            j = parent[j as usize];
        }
    }
    let mut last_leaf = filled(n, NONE)?;
    // One more than the first descendant of the last leaf.
    let mut seen = filled(n, 0u32)?;
    // Columns that are done are in the set of their lowest ancestor that is not, by numbers that fall in the post-order.
    let place = inverse(&post);
    let number = |column: u32| n - 1 - place[column as usize] as usize;
    let mut ancestors = DisjointSets::new(n);
    for (k, &j) in post.iter().enumerate() {
        may_continue_at(k)?;
        let column = j as usize;
        let up = parent[column];
        if up != NONE {
            more[up as usize] -= 1;
        }
        for &i in &rows[starts[column] as usize..starts[column + 1] as usize] {
            let i = i as usize;
            if first[column] < seen[i] {
                continue;
            }
            seen[i] = first[column] + 1;
            more[column] += 1;
            let before = std::mem::replace(&mut last_leaf[i], j);
            if before != NONE {
                let meet = post[n - 1 - ancestors.root(number(before))];
                more[meet as usize] -= 1;
            }
        }
        if up != NONE {
            ancestors.join(number(j), number(up));
        }
    }
    for &j in &post {
        if parent[j as usize] != NONE {
            more[parent[j as usize] as usize] += more[j as usize];
        }
    }
    Ok(more.into_iter().map(|count| count as u32).collect())
}

/// The higher positions with which each position shares an entry, increasing.
fn transposed(offsets: &[u32], columns: &[u32]) -> Result<(Vec<u32>, Vec<u32>)> {
    let n = offsets.len() - 1;
    let mut starts = filled(n + 1, 0u32)?;
    columns.iter().for_each(|&j| starts[j as usize + 1] += 1);
    for k in 0..n {
        starts[k + 1] += starts[k];
    }
    let mut next = starts.clone();
    let mut rows = filled(columns.len(), 0u32)?;
    for i in 0..n {
        may_continue_at(i)?;
        for &j in &columns[offsets[i] as usize..offsets[i + 1] as usize] {
            rows[next[j as usize] as usize] = i as u32;
            next[j as usize] += 1;
        }
    }
    Ok((starts, rows))
}

/// The largest supernodes without zeros.
fn fundamental(parent: &[u32], counts: &[u32]) -> Result<Vec<Supernode>> {
    let n = parent.len();
    let mut children = filled(n, 0u32)?;
    let inner = parent.iter().filter(|&&up| up != NONE);
    inner.for_each(|&up| children[up as usize] += 1);
    let mut found: Vec<Supernode> = Vec::new();
    for j in 0..n {
        let below = counts[j] as usize - 1;
        let is_next = j > 0 && parent[j - 1] == j as u32;
        match found.last_mut() {
            Some(last) if is_next && children[j] == 1 && last.below == below + 1 => {
                last.width += 1;
                last.below = below;
            }
            last => {
                if let Some(last) = last {
                    last.is_followed = is_next;
                }
                found.push(Supernode {
                    first: j,
                    width: 1,
                    below,
                    is_followed: false,
                });
            }
        }
    }
    Ok(found)
}

/// Larger supernodes, which store few zeros.
fn relaxed(fundamental: &[Supernode]) -> Vec<Supernode> {
    let mut found: Vec<(Supernode, usize)> = Vec::new();
    for &next in fundamental {
        let last = found.last().copied();
        let joined = last
            .filter(|(last, _)| last.is_followed)
            .and_then(|(last, zeros)| {
                let more = (next.width + next.below - last.below) * last.width;
                let (zeros, width) = (zeros + more, last.width + next.width);
                let entries = width * (width + 1) / 2 + next.below * width;
                let allows = |&(most, part): &(usize, f64)| {
                    width <= most && zeros as f64 <= entries as f64 * part
                };
                let joined = Supernode {
                    first: last.first,
                    width,
                    ..next
                };
                (more == 0 || RELAXED.iter().any(allows)).then_some((joined, zeros))
            });
        match (found.last_mut(), joined) {
            (Some(last), Some(joined)) => *last = joined,
            _ => found.push((next, 0)),
        }
    }
    found.into_iter().map(|(supernode, _)| supernode).collect()
}

/// So many equal values.
fn filled<T: Clone>(len: usize, value: T) -> Result<Vec<T>> {
    let mut values = reserve(len)?;
    values.resize(len, value);
    Ok(values)
}

#[cfg(test)]
mod tests {
    use faer::dyn_stack::{MemBuffer, MemStack};
    use faer::sparse::SymbolicSparseColMatRef;
    use faer::sparse::linalg::cholesky::simplicial::{
        prefactorize_symbolic_cholesky, prefactorize_symbolic_cholesky_scratch,
    };
    use faer::sparse::linalg::cholesky::supernodal::{
        factorize_supernodal_symbolic_cholesky, factorize_supernodal_symbolic_cholesky_scratch,
    };

    use super::super::ordering::minimum_degree;
    use super::*;
    use crate::monitor::{CancelToken, Monitor};
    use crate::test_random::Random;

    /// The supernodes that faer finds.
    fn by_faer(lower: &Sparse, place: &[u32]) -> Supernodes {
        let n = lower.rows();
        let (offsets, rows) = permute_pattern(lower, place).unwrap();
        let columns = SymbolicSparseColMatRef::new_unsorted_checked(n, n, &offsets, None, &rows);
        let need = prefactorize_symbolic_cholesky_scratch::<u32>(n, rows.len())
            .or(factorize_supernodal_symbolic_cholesky_scratch::<u32>(n));
        let mut memory = MemBuffer::new(need);
        let stack = MemStack::new(&mut memory);
        let (mut tree, mut counts) = (vec![0i32; n], vec![0u32; n]);
        let tree = prefactorize_symbolic_cholesky(&mut tree, &mut counts, columns, stack);
        let params = Default::default();
        let found = factorize_supernodal_symbolic_cholesky(columns, tree, &counts, stack, params);
        let found = found.unwrap();
        let count = found.n_supernodes();
        let rows = |s: usize| found.supernode(s).pattern();
        let row_ends = (0..count).scan(0, |end, s| {
            *end += rows(s).len();
            Some(*end)
        });
        Supernodes {
            first_column: [&found.supernode_begin()[..count], &[n as u32]].concat(),
            first_row: std::iter::once(0).chain(row_ends).collect(),
            rows: (0..count).flat_map(|s| rows(s).to_vec()).collect(),
            first_value: found
                .col_ptr_for_val()
                .iter()
                .map(|&k| k as usize)
                .collect(),
        }
    }

    fn check(lower: &Sparse, order: &[u32]) -> usize {
        let place = inverse(order);
        let found = Supernodes::new(lower, &place).unwrap();
        assert_eq!(found, by_faer(lower, &place));
        found.count()
    }

    fn matrix(n: usize, pairs: impl Iterator<Item = (u32, u32)> + Clone) -> Sparse {
        let entries = pairs.map(|(i, j)| (i.max(j), i.min(j), 1.0));
        let diagonal = (0..n as u32).map(|i| (i, i, 4.0));
        Sparse::from_triplets(n, n, entries.chain(diagonal)).unwrap()
    }

    #[test]
    fn supernodes_are_those_of_faer() {
        let mut random = Random::new(3);
        for n in [1, 2, 5, 30, 200, 1000] {
            for density in [0, 1, 2, 6] {
                let pairs: Vec<(u32, u32)> = (0..n * density)
                    .map(|_| [0, 1].map(|_| random.below(n) as u32).into())
                    .collect();
                let a = matrix(n, pairs.into_iter().filter(|(i, j)| i != j));
                let natural: Vec<u32> = (0..n as u32).collect();
                check(&a, &natural);
                check(&a, &minimum_degree(&a).unwrap());
            }
        }
    }

    #[test]
    fn grids_have_wide_supernodes() {
        let width = 60;
        let n = width * width;
        let right = (0..n).filter(|i| (i + 1) % width > 0).map(|i| (i, i + 1));
        let down = (width..n).map(|i| (i - width, i));
        let a = matrix(n as usize, right.chain(down));
        let count = check(&a, &minimum_degree(&a).unwrap());
        assert!(count < n as usize / 2, "{count}");
        let dense = matrix(90, (0..90).flat_map(|i| (0..i).map(move |j| (i, j))));
        assert_eq!(check(&dense, &(0..90).collect::<Vec<u32>>()), 1);
    }

    #[test]
    fn a_matrix_without_unknowns_has_none() {
        let none = Supernodes::new(&matrix(0, std::iter::empty()), &[]).unwrap();
        assert_eq!((none.count(), none.dim(), none.value_count()), (0, 0, 0));
    }

    #[test]
    fn the_steps_end_when_the_call_does() {
        let two = matrix(2, std::iter::once((0, 1)));
        let token = CancelToken::new();
        token.cancel();
        let _watch = Monitor::default().cancel_token(token).watch();
        let (offsets, columns) = (vec![0, 0, 1], vec![0]);
        let parent = [1, NONE];
        assert!(permute_pattern(&two, &[0, 1]).is_err());
        assert!(parents(&offsets, &columns).is_err());
        assert!(transposed(&offsets, &columns).is_err());
        let pattern = (offsets, columns);
        assert!(column_counts(&pattern, &parent).is_err());
        let supernode = Supernode {
            first: 0,
            width: 2,
            below: 0,
            is_followed: false,
        };
        assert!(Supernodes::with_rows(&[supernode], &pattern, &parent).is_err());
    }
}
