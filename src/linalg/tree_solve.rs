//! Forward and back substitution with a supernodal factor by the subtrees of its assembly tree, on the allowed
//! threads.
//!
//! Subtrees of a fixed part of the factor are solved apart. What they subtract from the unknowns above them is
//! summed for each subtree, and the sums are joined in the order of the subtrees. So the result has the same bits
//! for every number of threads.

use std::ops::Range;
use std::sync::{Mutex, PoisonError};

use super::assembly_tree::AssemblyTree;
use super::supernodes::Supernodes;
use crate::monitor::{Stop, collect_in_turn, may_continue};

/// A subtree with less than one in so many entries of the factor is not solved apart.
const PARTS: usize = 100;

/// The subtrees that are solved apart, and the supernodes above them.
#[derive(Debug)]
pub(super) struct SolveParts {
    /// The supernodes and the positions of each subtree.
    subtrees: Vec<(Range<usize>, Range<usize>)>,
    /// The supernodes above the subtrees.
    above: Vec<u32>,
    /// The place of each position among those above; that of positions in subtrees has no meaning.
    place: Vec<u32>,
    above_positions: usize,
}

/// `L` with the pivots on its diagonal.
#[derive(Clone, Copy)]
pub(super) struct Factor<'a> {
    pub supernodes: &'a Supernodes,
    pub values: &'a [f64],
}

impl SolveParts {
    pub fn new(tree: &AssemblyTree, supernodes: &Supernodes) -> Self {
        let least = supernodes.value_count() / PARTS;
        let mut parts = SolveParts {
            subtrees: Vec::new(),
            above: Vec::new(),
            place: vec![0; supernodes.dim()],
            above_positions: 0,
        };
        for (task, waits) in tree.tasks().iter().zip(tree.waits()) {
            let [first, last] = [task.start, task.end - 1].map(|s| supernodes.columns(s));
            let positions = first.start..last.end;
            if *waits == 0 && supernodes.values_of(task.clone()).len() >= least {
                parts.subtrees.push((task.clone(), positions));
            } else {
                parts.above.extend(task.clone().map(|s| s as u32));
                for position in positions {
                    parts.place[position] = parts.above_positions as u32;
                    parts.above_positions += 1;
                }
            }
        }
        parts
    }

    /// Solves `L D L' x = b` in place. `x` is in the order of elimination. The unknowns from position `held` on are
    /// held at zero.
    ///
    /// # Errors
    /// The end of the call.
    pub fn solve(&self, factor: Factor, x: &mut [f64], held: usize) -> Result<(), Stop> {
        let mut above = Vec::with_capacity(self.above_positions);
        let mut inside = Vec::with_capacity(self.subtrees.len());
        let (mut rest, mut at) = (&mut *x, 0);
        for (_, positions) in &self.subtrees {
            let (before, after) = rest.split_at_mut(positions.start - at);
            let (own, after) = after.split_at_mut(positions.len());
            above.extend_from_slice(before);
            inside.push(Mutex::new(own));
            (rest, at) = (after, positions.end);
        }
        above.extend_from_slice(rest);

        let eliminate = |subtree: usize, own: &mut [f64]| self.eliminate(factor, subtree, own);
        for pull in self.each_subtree(&inside, eliminate) {
            for (x, pull) in above.iter_mut().zip(pull) {
                *x -= pull;
            }
        }
        may_continue()?;
        let mut rows = Vec::new();
        for &s in &self.above {
            let (start, block, pattern) = of_supernode(factor, s as usize);
            let width = block.width;
            let start = self.place[start] as usize;
            rows.resize(pattern.len(), 0.0);
            block.eliminate(&mut above[start..start + width], &mut rows);
            for (&row, v) in pattern.iter().zip(&mut rows) {
                above[self.place[row as usize] as usize] -= std::mem::take(v);
            }
        }
        let free = |positions: &Range<usize>| positions.end.min(held) - positions.start.min(held);
        let free_inside = self.subtrees.iter().map(|(_, positions)| free(positions));
        above[held - free_inside.sum::<usize>()..].fill(0.0);
        for &s in self.above.iter().rev() {
            let (start, block, pattern) = of_supernode(factor, s as usize);
            let start = self.place[start] as usize;
            rows.clear();
            let places = pattern.iter().map(|&row| self.place[row as usize]);
            rows.extend(places.map(|place| above[place as usize]));
            block.substitute(&mut above[start..start + block.width], &rows);
        }
        may_continue()?;
        self.each_subtree(&inside, |subtree, own| {
            let positions = &self.subtrees[subtree].1;
            own[held.clamp(positions.start, positions.end) - positions.start..].fill(0.0);
            self.substitute(factor, subtree, own, &above)
        });

        let mut above = above.into_iter();
        let mut at = 0;
        for (_, positions) in &self.subtrees {
            x[at..positions.start].fill_with(|| above.next().unwrap_or_default());
            at = positions.end;
        }
        x[at..].fill_with(|| above.next().unwrap_or_default());
        Ok(())
    }

    /// Does the subtrees on the allowed threads. The results are in their order.
    fn each_subtree<T: Send>(
        &self,
        inside: &[Mutex<&mut [f64]>],
        task: impl Fn(usize, &mut [f64]) -> T + Sync,
    ) -> Vec<T> {
        let own = |k: usize| inside[k].lock().unwrap_or_else(PoisonError::into_inner);
        collect_in_turn(inside.len(), |k| task(k, &mut own(k)))
    }

    /// Forward substitution in a subtree. The result is what it subtracts from the unknowns above.
    fn eliminate(&self, factor: Factor, subtree: usize, own: &mut [f64]) -> Vec<f64> {
        let (supernodes, positions) = &self.subtrees[subtree];
        let mut pull = vec![0.0; self.above_positions];
        let mut rows = Vec::new();
        for s in supernodes.clone() {
            let (start, block, pattern) = of_supernode(factor, s);
            let start = start - positions.start;
            rows.resize(pattern.len(), 0.0);
            block.eliminate(&mut own[start..start + block.width], &mut rows);
            for (&row, v) in pattern.iter().zip(&mut rows) {
                let v = std::mem::take(v);
                match own.get_mut(row as usize - positions.start) {
                    Some(x) => *x -= v,
                    None => pull[self.place[row as usize] as usize] += v,
                }
            }
        }
        pull
    }

    /// Back substitution in a subtree.
    fn substitute(&self, factor: Factor, subtree: usize, own: &mut [f64], above: &[f64]) {
        let (supernodes, positions) = &self.subtrees[subtree];
        let mut rows = Vec::new();
        for s in supernodes.clone().rev() {
            let (start, block, pattern) = of_supernode(factor, s);
            let start = start - positions.start;
            rows.clear();
            rows.extend(pattern.iter().map(|&row| {
                let inside = own.get(row as usize - positions.start);
                inside
                    .copied()
                    .unwrap_or_else(|| above[self.place[row as usize] as usize])
            }));
            block.substitute(&mut own[start..start + block.width], &rows);
        }
    }
}

/// The first position of a supernode, its block, and its rows below.
fn of_supernode<'a>(factor: Factor<'a>, s: usize) -> (usize, Block<'a>, &'a [u32]) {
    let columns = factor.supernodes.columns(s);
    let block = Block {
        width: columns.len(),
        values: &factor.values[factor.supernodes.values(s)],
    };
    (columns.start, block, factor.supernodes.rows(s))
}

/// The block of a supernode: by columns, pivots on the diagonal of its top.
#[derive(Clone, Copy)]
struct Block<'a> {
    width: usize,
    values: &'a [f64],
}

impl<'a> Block<'a> {
    fn columns(&self) -> impl DoubleEndedIterator<Item = &'a [f64]> + ExactSizeIterator + use<'a> {
        self.values.chunks_exact(self.values.len() / self.width)
    }

    /// Forward substitution: `x` are the unknowns of the columns, and `rows` becomes what they pull at the rows
    /// below.
    fn eliminate(self, x: &mut [f64], rows: &mut [f64]) {
        for (k, column) in self.columns().enumerate() {
            let pull = x[k];
            for (x, l) in x[k + 1..].iter_mut().zip(&column[k + 1..]) {
                *x -= l * pull;
            }
        }
        let height = self.values.len() / self.width;
        let quads = self.values.chunks_exact(4 * height);
        let last = quads.remainder();
        for (four, x) in quads.zip(x.chunks_exact(4)) {
            let column = |k: usize| &four[k * height + self.width..(k + 1) * height];
            let columns = column(0)
                .iter()
                .zip(column(1))
                .zip(column(2))
                .zip(column(3));
            for (sum, (((a, b), c), d)) in rows.iter_mut().zip(columns) {
                *sum += (a * x[0] + b * x[1]) + (c * x[2] + d * x[3]);
            }
        }
        let x = x.chunks_exact(4).remainder();
        for (column, x) in last.chunks_exact(height).zip(x) {
            for (sum, l) in rows.iter_mut().zip(&column[self.width..]) {
                *sum += l * x;
            }
        }
    }

    /// Division by the pivots and back substitution: `rows` are the unknowns of the rows below.
    fn substitute(self, x: &mut [f64], rows: &[f64]) {
        for (k, column) in self.columns().enumerate().rev() {
            let (own, below) = column.split_at(self.width);
            x[k] = x[k] / own[k] - dot(&own[k + 1..], &x[k + 1..]) - dot(below, rows);
        }
    }
}

/// The sum of products, in eight interleaved parts.
fn dot(a: &[f64], b: &[f64]) -> f64 {
    let mut sums = [0.0; 8];
    let (eights, others) = (a.chunks_exact(8), b.chunks_exact(8));
    let last = eights.remainder().iter().zip(others.remainder());
    let last: f64 = last.map(|(a, b)| a * b).sum();
    for (a, b) in eights.zip(others) {
        for k in 0..8 {
            sums[k] += a[k] * b[k];
        }
    }
    let [a, b, c, d, e, f, g, h] = sums;
    ((a + b) + (c + d)) + ((e + f) + (g + h)) + last
}

#[cfg(test)]
mod tests {
    use super::super::analysis::Analysis;
    use super::super::{Cholesky, EliminationTree, Sparse, minimum_degree};

    /// A grid of springs, tied to the ground.
    fn grid() -> Sparse {
        let (width, n) = (200, 40_000u32);
        let springs = (0..n).flat_map(|i| {
            let right = (i % width + 1 < width).then_some(i + 1);
            let up = (i + width < n).then_some(i + width);
            let each = move |j: u32| [(i, i, 1.0), (j, j, 1.0), (j, i, -1.0)];
            right.into_iter().chain(up).flat_map(each)
        });
        let ground = (0..n).map(|i| (i, i, 0.1));
        let n = n as usize;
        Sparse::from_triplets(n, n, springs.chain(ground)).unwrap()
    }

    #[test]
    fn a_large_factor_is_solved_by_subtrees() {
        let a = grid();
        let n = a.rows();
        let analysis = Analysis::new(&a).unwrap();
        let parts = &analysis.pattern.solve;
        assert!(parts.subtrees.len() >= 8, "{}", parts.subtrees.len());
        let inside: usize = parts
            .subtrees
            .iter()
            .map(|(_, positions)| positions.len())
            .sum();
        assert!(inside > n / 2);
        assert_eq!(inside + parts.above_positions, n);
        let x: Vec<f64> = (0..n).map(|i| (i as f64).sin()).collect();
        let mut b = a.mul_symmetric(&x);
        Cholesky::with(&analysis, &a)
            .unwrap()
            .solve(&mut b)
            .unwrap();
        for (b, x) in b.iter().zip(&x) {
            assert!((b - x).abs() < 1e-11, "{b} {x}");
        }
    }

    #[test]
    fn the_last_unknowns_can_be_held() {
        let (a, n) = (grid(), 40_000);
        let tree = EliminationTree::new(&a, &minimum_degree(&a).unwrap()).unwrap();
        let factor = Cholesky::in_order(&a, &tree.order).unwrap();
        // From the separator above all subtrees, from within a subtree on, and everything.
        for held in [n - 100, n / 4, 0] {
            let last: Vec<usize> = tree.order[held..].iter().map(|&i| i as usize).collect();
            let mut x: Vec<f64> = (0..n).map(|i| (i as f64).sin()).collect();
            last.iter().for_each(|&i| x[i] = 0.0);
            let mut b = a.mul_symmetric(&x);
            last.iter().for_each(|&i| b[i] = 77.0);
            factor.solve_leading(&mut b, n - held).unwrap();
            last.iter()
                .for_each(|&i| assert_eq!(std::mem::take(&mut b[i]), 77.0));
            for (b, x) in b.iter().zip(&x) {
                assert!((b - x).abs() < 1e-11, "{b} {x}");
            }
        }
    }
}
