//! The numbers of a supernodal factor `L D L'`, computed front by front (`duff1983`) on the allowed threads.
//!
//! faer's own factorization uses one thread on such matrices, and cannot be interrupted. Here each supernode is a
//! dense front: its columns of the matrix and the update matrices of its children are added up, its columns are
//! eliminated, and what that leaves for the rows below is its own update matrix, for its parent. A pivot at or below
//! the tolerance is replaced by [`NULL_PIVOT`], as faer does it.

use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Mutex, PoisonError};

use faer::dyn_stack::{MemBuffer, MemStack};
use faer::linalg::cholesky::ldlt::factor::{
    LdltRegularization, cholesky_in_place, cholesky_in_place_scratch,
};
use faer::linalg::matmul::matmul;
use faer::linalg::triangular_solve::solve_unit_lower_triangular_in_place;
use faer::reborrow::{Reborrow, ReborrowMut};
use faer::{Accum, MatMut, MatRef, Par};

use super::assembly_tree::AssemblyTree;
use super::cholesky::{NULL_PIVOT, out_of_memory, overflow, zeros};
use super::ordering::NONE;
use super::scaled_columns::Columns;
use super::sparse::reserve;
use super::supernodes::Supernodes;
use super::wide_registers::with_wide_registers;
use crate::error::Result;
use crate::monitor::{for_each_part, is_wanted, of_each_part};

/// The columns of a front with less work, in multiplications, are eliminated without faer's kernels, whose calls
/// would take longer.
const SMALL: usize = 1000;

/// The rows or columns of a large front that are computed at a time. Between them a call can end.
const BLOCK: usize = 128;

/// A front of at least so many entries is worth several threads.
const LARGE: usize = 1 << 16;

/// The entries of the largest update matrix that is kept for another one.
const SPARE: usize = 1 << 16;

/// Computes the factor into `values`, which are zero. The result says whether a pivot vanished.
///
/// # Errors
/// [`Error::OutOfMemory`](crate::Error::OutOfMemory), [`Error::Overflow`](crate::Error::Overflow), and the reason
/// to end the current step.
pub(super) fn factorize(
    factor: &Supernodes,
    tree: &AssemblyTree,
    columns: &Columns,
    tolerance: f64,
    values: &mut [f64],
) -> Result<bool> {
    let mut blocks = Vec::with_capacity(tree.tasks().len());
    let mut rest = values;
    for task in tree.tasks() {
        let (block, after) = rest.split_at_mut(factor.values_of(task.clone()).len());
        blocks.push(Mutex::new(block));
        rest = after;
    }
    let none = || Mutex::new(Vec::new());
    let fronts = Fronts {
        factor,
        tree,
        columns,
        tolerance,
        has_null: AtomicBool::new(false),
        updates: (0..factor.count()).map(|_| none()).collect(),
    };
    let widest = (0..factor.count()).map(|s| factor.width(s)).max();
    tree.work(
        || Scratch::new(factor.dim(), widest.unwrap_or(0)),
        |scratch, k| {
            let mut block = blocks[k].lock().unwrap_or_else(PoisonError::into_inner);
            let mut rest = &mut **block;
            for s in tree.tasks()[k].clone() {
                is_wanted()?;
                let (front, after) = rest.split_at_mut(factor.values(s).len());
                fronts.eliminate(s, front, scratch)?;
                rest = after;
            }
            Ok(())
        },
    )?;
    Ok(fronts.has_null.into_inner())
}

/// What all fronts have in common.
struct Fronts<'a> {
    factor: &'a Supernodes,
    tree: &'a AssemblyTree,
    columns: &'a Columns,
    tolerance: f64,
    has_null: AtomicBool,
    /// The update matrix of each supernode while its parent waits for it: square, by columns, its lower triangle.
    updates: Vec<Mutex<Vec<f64>>>,
}

/// What a thread needs for its fronts.
struct Scratch {
    /// The place in the front of each row of the matrix that is in the front.
    place: Vec<u32>,
    /// The places of the rows of a child.
    rows: Vec<u32>,
    /// The columns below the pivots, times their pivots.
    scaled: Vec<f64>,
    signs: Vec<i8>,
    memory: MemBuffer,
    /// Small update matrices that are no longer needed. The system takes its time to make pages for new ones.
    spare: Vec<Vec<f64>>,
}

impl Scratch {
    fn new(rows: usize, widest: usize) -> Result<Self> {
        let need = cholesky_in_place_scratch::<f64>(widest, Par::Seq, Default::default());
        let mut place = reserve(rows)?;
        place.resize(rows, 0);
        Ok(Scratch {
            place,
            rows: Vec::new(),
            scaled: Vec::new(),
            signs: vec![1; widest],
            memory: MemBuffer::try_new(need).map_err(|_| out_of_memory())?,
            spare: Vec::new(),
        })
    }
}

impl Fronts<'_> {
    /// Makes the columns of supernode `s`, and its update matrix. `front` is its block of the factor.
    fn eliminate(&self, s: usize, front: &mut [f64], scratch: &mut Scratch) -> Result<()> {
        let (width, rows) = (self.factor.width(s), self.factor.rows(s));
        let below = rows.len();
        let mut update = Self::zero_update(below, scratch)?;
        self.assemble(s, front, &mut update, scratch);
        let is_finite = if width * width * (width + below) < SMALL {
            self.eliminate_small(width, front, &mut update)
        } else {
            self.eliminate_large(width, front, &mut update, scratch)?
        };
        if !is_finite {
            return Err(overflow());
        }
        if self.tree.parent(s) != NONE {
            let mut kept = self.updates[s]
                .lock()
                .unwrap_or_else(PoisonError::into_inner);
            *kept = update;
        }
        Ok(())
    }

    /// An update matrix of zeros.
    fn zero_update(below: usize, scratch: &mut Scratch) -> Result<Vec<f64>> {
        let len = below * below;
        if len >= LARGE {
            let mut update = zeros(len)?;
            let columns = update.chunks_exact_mut(below).collect();
            // See `assemble` for the reason to write zeros.
            for_each_part(columns, |column: &mut [f64]| column.fill(0.0));
            return Ok(update);
        }
        let mut update = scratch.spare.pop().unwrap_or_default();
        update.clear();
        update.try_reserve_exact(len).map_err(|_| out_of_memory())?;
        update.resize(len, 0.0);
        Ok(update)
    }

    /// Adds up the columns of the matrix and the update matrices of the children, in their order.
    fn assemble(&self, s: usize, front: &mut [f64], update: &mut [f64], scratch: &mut Scratch) {
        let (width, rows) = (self.factor.width(s), self.factor.rows(s));
        let (start, below) = (self.factor.columns(s).start, rows.len());
        let height = width + below;
        for k in 0..width {
            scratch.place[start + k] = k as u32;
        }
        for (k, &row) in (width as u32..).zip(rows) {
            scratch.place[row as usize] = k;
        }
        let place = &scratch.place;
        let own = |(k, column): (usize, &mut [f64])| {
            // These are zeros already, but a page that is read before it is written costs the system twice the time.
            column.fill(0.0);
            for &(row, value) in self.columns.column(start + k) {
                column[place[row as usize] as usize] += value;
            }
        };
        let is_large = height * height >= LARGE;
        let columns = front.chunks_exact_mut(height).enumerate();
        match is_large {
            true => for_each_part(columns.collect(), own),
            false => columns.for_each(own),
        }
        for &child in self.tree.children(s) {
            let child = child as usize;
            let kept = self.updates[child].lock();
            let of_child = std::mem::take(&mut *kept.unwrap_or_else(PoisonError::into_inner));
            let rows = self.factor.rows(child).iter();
            scratch.rows.clear();
            scratch
                .rows
                .extend(rows.map(|&row| scratch.place[row as usize]));
            let rows = &scratch.rows;
            let add_column = |k: usize, column: &mut [f64], first: usize| {
                let source = &of_child[k * rows.len() + k..(k + 1) * rows.len()];
                add(column, first, &rows[k..], source);
            };
            if is_large && of_child.len() >= LARGE {
                let of_front = front.chunks_exact_mut(height).map(|column| (column, 0));
                let of_update = update.chunks_exact_mut(below.max(1));
                let of_update = of_update.map(|column| (column, width));
                let mut columns: Vec<_> = of_front.chain(of_update).map(Some).collect();
                let pairs = rows.iter().enumerate();
                let pairs = pairs.filter_map(|(k, &at)| Some((k, columns[at as usize].take()?)));
                for_each_part(pairs.collect(), |(k, (column, first))| {
                    add_column(k, column, first);
                });
            } else {
                for (k, &at) in rows.iter().enumerate() {
                    match (at as usize).checked_sub(width) {
                        None => {
                            let at = at as usize;
                            add_column(k, &mut front[at * height..(at + 1) * height], 0);
                        }
                        Some(at) => {
                            add_column(k, &mut update[at * below..(at + 1) * below], width);
                        }
                    }
                }
            }
            if of_child.capacity() <= SPARE {
                scratch.spare.push(of_child);
            }
        }
    }

    /// Replaces a pivot that vanishes.
    fn pivot(&self, pivot: f64) -> f64 {
        if pivot <= self.tolerance {
            self.has_null.store(true, Ordering::Relaxed);
            NULL_PIVOT
        } else {
            pivot
        }
    }

    /// Eliminates the columns of a small front one by one. Returns whether all pivots are finite.
    fn eliminate_small(&self, width: usize, front: &mut [f64], update: &mut [f64]) -> bool {
        let height = front.len() / width;
        let below = height - width;
        for k in 0..width {
            let (done, later) = front.split_at_mut((k + 1) * height);
            let column = &mut done[k * height..];
            let pivot = self.pivot(column[k]);
            if !pivot.is_finite() {
                return false;
            }
            column[k] = pivot;
            let inverse = 1.0 / pivot;
            for (other, j) in later.chunks_exact_mut(height).zip(k + 1..) {
                subtract(&mut other[j..], column[j] * inverse, &column[j..]);
            }
            column[k + 1..].iter_mut().for_each(|v| *v *= inverse);
        }
        for (k, column) in front.chunks_exact(height).enumerate() {
            let (pivot, lower) = (column[k], &column[width..]);
            for j in 0..below {
                subtract(
                    &mut update[j * below + j..(j + 1) * below],
                    lower[j] * pivot,
                    &lower[j..],
                );
            }
        }
        true
    }

    /// Eliminates the columns of a large front with faer's kernels. Returns whether all pivots are finite.
    ///
    /// # Errors
    /// The reason to end the current step.
    fn eliminate_large(
        &self,
        width: usize,
        front: &mut [f64],
        update: &mut [f64],
        scratch: &mut Scratch,
    ) -> Result<bool> {
        let height = front.len() / width;
        let below = height - width;
        let block = MatMut::from_column_major_slice_mut(front, height, width);
        let (mut top, bottom) = block.split_at_row_mut(width);
        let regularization = LdltRegularization {
            dynamic_regularization_signs: Some(&scratch.signs[..width]),
            dynamic_regularization_delta: NULL_PIVOT,
            dynamic_regularization_epsilon: self.tolerance,
        };
        let stack = MemStack::new(&mut scratch.memory);
        let params = Default::default();
        let done = with_wide_registers(|| {
            cholesky_in_place(top.rb_mut(), regularization, Par::Seq, stack, params)
        });
        match done {
            Ok(info) if info.dynamic_regularization_count == 0 => {}
            Ok(_) => self.has_null.store(true, Ordering::Relaxed),
            Err(_) => return Ok(false),
        }
        in_blocks(
            bottom,
            MatMut::nrows,
            MatMut::split_at_row_mut,
            |_, rows| {
                let (top, rows) = (top.rb(), rows.transpose_mut());
                with_wide_registers(|| solve_unit_lower_triangular_in_place(top, rows, Par::Seq));
            },
        )?;
        scratch.scaled.clear();
        scratch.scaled.resize(width * below, 0.0);
        let scale = |k: usize, column: &mut [f64], scaled: &mut [f64]| {
            column[..k].fill(0.0);
            let inverse = 1.0 / column[k];
            scaled.copy_from_slice(&column[width..]);
            column[width..].iter_mut().for_each(|v| *v *= inverse);
        };
        let scaled = scratch.scaled.chunks_exact_mut(below.max(1));
        let columns = front.chunks_exact_mut(height).zip(scaled).enumerate();
        if width * below >= LARGE {
            for_each_part(columns.collect(), |(k, (column, scaled))| {
                scale(k, column, scaled)
            });
        } else {
            columns.for_each(|(k, (column, scaled))| scale(k, column, scaled));
        }
        let lower = MatRef::from_column_major_slice(front, height, width).subrows(width, below);
        let scaled = MatRef::from_column_major_slice(&scratch.scaled, below, width);
        let update = MatMut::from_column_major_slice_mut(update, below, below);
        in_blocks(
            update,
            MatMut::ncols,
            MatMut::split_at_col_mut,
            |first, block| {
                let columns = block.ncols();
                let part = block.subrows_mut(first, below - first);
                let lower = lower.subrows(first, below - first);
                let scaled = scaled.subrows(first, columns).transpose();
                with_wide_registers(|| matmul(part, Accum::Add, lower, scaled, -1.0, Par::Seq));
            },
        )?;
        Ok(true)
    }
}

/// Calls `task` with blocks of the rows or columns of a matrix, each with the number of its first one, on the threads
/// that are allowed.
///
/// # Errors
/// The reason to end the current step.
fn in_blocks<'a>(
    matrix: MatMut<'a, f64>,
    count: impl Fn(&MatMut<'a, f64>) -> usize,
    split_at: impl Fn(MatMut<'a, f64>, usize) -> (MatMut<'a, f64>, MatMut<'a, f64>),
    task: impl Fn(usize, MatMut<'a, f64>) + Sync,
) -> Result<()> {
    let (mut blocks, mut rest, mut first) = (Vec::new(), matrix, 0);
    while count(&rest) > BLOCK {
        let (block, others) = split_at(rest, BLOCK);
        blocks.push((first, block));
        (rest, first) = (others, first + BLOCK);
    }
    if blocks.is_empty() {
        task(0, rest);
        return Ok(());
    }
    blocks.push((first, rest));
    let done = of_each_part(blocks, |(first, block)| {
        is_wanted()?;
        task(first, block);
        Ok(())
    });
    done.into_iter().collect()
}

/// `x -= factor y`.
fn subtract(x: &mut [f64], factor: f64, y: &[f64]) {
    for (x, y) in x.iter_mut().zip(y) {
        *x -= factor * y;
    }
}

/// Adds `source` to the entries of `column` at `rows`, of which the row `first` is the entry 0.
fn add(column: &mut [f64], first: usize, rows: &[u32], source: &[f64]) {
    let (from, to) = (rows[0] as usize, rows[rows.len() - 1] as usize);
    if to - from == rows.len() - 1 {
        for (sum, v) in column[from - first..=to - first].iter_mut().zip(source) {
            *sum += v;
        }
    } else {
        for (&row, v) in rows.iter().zip(source) {
            column[row as usize - first] += v;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::super::analysis::Analysis;
    use super::super::{Cholesky, Random, Sparse, minimum_degree};
    use super::*;
    use crate::error::Error;
    use crate::monitor::{CancelToken, Monitor, spawned, with_threads};

    /// Springs between neighbours of a grid, of which some are missing or very soft. A grid that is not tied to the
    /// ground has null unknowns.
    fn grid(width: u32, height: u32, is_grounded: bool, random: &mut Random) -> Sparse {
        let mut entries = Vec::new();
        for i in 0..width * height {
            let ground = if is_grounded { 0.01 } else { 0.0 };
            entries.push((i, i, ground));
            let right = (i % width + 1 < width).then_some(i + 1);
            let up = (i / width + 1 < height).then_some(i + width);
            for j in right.into_iter().chain(up) {
                let stiffness = match random.next() % 10 {
                    0 => continue,
                    1 => 1e-4,
                    k => k as f64,
                };
                let ends = [(i, i, stiffness), (j, j, stiffness), (j, i, -stiffness)];
                entries.extend(ends);
            }
        }
        let n = (width * height) as usize;
        Sparse::from_triplets(n, n, entries.into_iter()).unwrap()
    }

    /// The factor with all work shared, whatever its size.
    fn shared(a: &Sparse) -> Cholesky {
        let analysis = Analysis::shared_from(0, a, minimum_degree(a).unwrap()).unwrap();
        Cholesky::with(&analysis, a).unwrap()
    }

    /// The textbook's `L D L'` of the scaled matrix in the order of the factor, with vanished pivots replaced.
    fn dense(a: &Sparse, factor: &Cholesky) -> Vec<Vec<f64>> {
        let n = a.rows();
        let mut place = vec![0; n];
        (0..n).for_each(|k| place[factor.unknown(k)] = k);
        let mut l = vec![vec![0.0; n]; n];
        for (i, j, v) in a.entries() {
            let (i, j) = (i as usize, j as usize);
            let v = v * factor.scale()[i] * factor.scale()[j];
            let (i, j) = (place[i].max(place[j]), place[i].min(place[j]));
            l[i][j] = v;
        }
        for k in 0..n {
            if l[k][k] <= super::super::cholesky::pivot_tolerance(n) {
                l[k][k] = NULL_PIVOT;
            }
            let pivot = l[k][k];
            for i in k + 1..n {
                let factor = l[i][k] / pivot;
                for j in k + 1..=i {
                    l[i][j] -= factor * l[j][k];
                }
            }
            (k + 1..n).for_each(|i| l[i][k] /= pivot);
        }
        l
    }

    #[test]
    fn the_factor_is_that_of_the_textbook_with_and_without_null_unknowns() {
        for (seed, (width, height)) in (0..).zip([(1, 1), (7, 1), (5, 6), (12, 11), (20, 24)]) {
            for is_grounded in [true, false] {
                let a = grid(width, height, is_grounded, &mut Random::new(seed));
                let factor = shared(&a);
                let expected = dense(&a, &factor);
                let null = |&k: &usize| expected[k][k] == NULL_PIVOT;
                let null: Vec<u32> = (0..a.rows())
                    .filter(null)
                    .map(|k| factor.unknown(k) as u32)
                    .collect();
                assert_eq!(factor.null_unknowns(), null);
                assert_eq!(null.is_empty(), is_grounded);
                assert!(factor.coupled_unknowns().is_empty());
                factor.for_each_column(|k, pivot, entries| {
                    assert!((pivot - expected[k][k]).abs() <= 1e-10);
                    let mut column = vec![0.0; a.rows()];
                    entries.for_each(|(i, v)| column[i] = v);
                    for i in k + 1..a.rows() {
                        assert!((column[i] - expected[i][k]).abs() <= 1e-10, "{i} {k}");
                    }
                });
            }
        }
    }

    /// Three sets of unknowns. Those of a set are coupled to each other, and those of the last to all.
    fn cliques(size: u32) -> Sparse {
        let pairs = (0..3 * size).flat_map(|i| (0..i).map(move |j| (i, j)));
        let coupled = pairs.filter(|&(i, j)| i >= 2 * size || i / size == j / size);
        let springs = coupled.flat_map(|(i, j)| {
            let stiffness = 1.0 + f64::from(i * j % 7);
            [(i, i, stiffness), (j, j, stiffness), (i, j, -stiffness)]
        });
        let n = 3 * size as usize;
        let ground = (0..3 * size).map(|i| (i, i, 1.0));
        Sparse::from_triplets(n, n, springs.chain(ground)).unwrap()
    }

    #[test]
    fn all_threads_share_large_fronts() {
        let a = cliques(260);
        let order = minimum_degree(&a).unwrap();
        let analysis = Analysis::shared_from(0, &a, order).unwrap();
        let factor = || drop(Cholesky::with(&analysis, &a).unwrap());
        assert!(spawned(|| with_threads(3, factor)) > 10);
    }

    #[test]
    fn solutions_have_no_residual_and_the_same_bits_for_every_number_of_threads() {
        let grids = [(1, true), (2, false)];
        let grids =
            grids.map(|(seed, is_grounded)| grid(80, 90, is_grounded, &mut Random::new(seed)));
        for a in grids.into_iter().chain([cliques(260)]) {
            let x: Vec<f64> = (0..a.rows()).map(|i| (i as f64).sin()).collect();
            let b = a.mul_symmetric(&x);
            let of = |threads: usize| {
                with_threads(threads, || {
                    let factor = shared(&a);
                    let mut x = b.clone();
                    factor.solve(&mut x).unwrap();
                    (factor.values, x)
                })
            };
            let (values, x) = of(1);
            for (b, ax) in b.iter().zip(a.mul_symmetric(&x)) {
                assert!((b - ax).abs() < 1e-9, "{b} {ax}");
            }
            let bits = |v: &[f64]| v.iter().map(|v| v.to_bits()).collect::<Vec<_>>();
            for threads in [2, 3, 8] {
                let (other, of_other) = of(threads);
                assert_eq!(bits(&values), bits(&other));
                assert_eq!(bits(&x), bits(&of_other));
            }
        }
    }

    #[test]
    fn a_factorization_ends_when_it_is_told_to() {
        let a = grid(200, 200, true, &mut Random::new(3));
        let analysis = Analysis::new(&a).unwrap();
        for threads in [1, 2] {
            with_threads(threads, || {
                let mut late = Monitor::default();
                // More than nothing, and less than a factorization takes.
                late.start(1e-4);
                let ends = late.watching(|| Cholesky::with(&analysis, &a).err());
                assert_eq!(ends, Some(Error::TimeLimit));
                let token = CancelToken::new();
                token.cancel();
                let cancelled = Monitor::default().cancel_token(token);
                let ends = cancelled.watching(|| Cholesky::with(&analysis, &a).err());
                assert_eq!(ends, Some(Error::Cancelled));
                assert!(Cholesky::with(&analysis, &a).is_ok());
            });
        }
    }

    #[test]
    fn numbers_that_overflow_are_an_error() {
        let (mut a, huge) = (grid(30, 30, true, &mut Random::new(4)), f64::MAX);
        a.values_mut().iter_mut().for_each(|v| *v *= huge);
        let analysis = Analysis::shared_from(0, &a, minimum_degree(&a).unwrap()).unwrap();
        let error = Cholesky::with(&analysis, &a).err();
        assert!(matches!(error, Some(Error::Overflow { .. })), "{error:?}");
    }
}
