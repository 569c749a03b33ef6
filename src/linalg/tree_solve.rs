//! Forward and back substitution with a supernodal factor by the subtrees of its assembly tree, on the allowed
//! threads.
//!
//! Subtrees are solved apart. What a large one subtracts from the unknowns above all of them is summed, and the sums are
//! joined in the order of the subtrees. What small ones subtract is listed, and takes its turn in the order of
//! elimination. So the result has the same bits for every number of threads.

use std::ops::Range;
use std::sync::{Mutex, PoisonError};

use super::assembly_tree::AssemblyTree;
use super::supernodes::Supernodes;
use crate::monitor::{Stop, collect_in_turn, joined, may_continue};

/// A subtree with at least one in so many entries of the factor is large.
const PARTS: usize = 100;

/// The subtrees that are solved apart, and the supernodes above them.
#[derive(Debug)]
pub(super) struct SolveParts {
    /// In the order of elimination.
    subtrees: Vec<Subtree>,
    /// What a thread does at a time: a large subtree, or small ones that follow each other.
    parts: Vec<Range<usize>>,
    /// The order of elimination.
    above: Vec<Step>,
    /// The place of each position among those above; that of positions in subtrees has no meaning.
    place: Vec<u32>,
    above_positions: usize,
}

/// A subtree, or several that follow each other.
#[derive(Debug)]
struct Subtree {
    supernodes: Range<usize>,
    positions: Range<usize>,
    is_large: bool,
}

/// A step of the elimination above the subtrees.
#[derive(Debug, Clone, Copy)]
enum Step {
    /// The elimination of a supernode.
    Supernode(u32),
    /// What a small subtree subtracts.
    Subtree(u32),
}

/// What a subtree subtracts from the unknowns above.
enum Pull {
    /// A sum for each of them.
    Sums(Vec<f64>),
    /// Their places and the terms, in the order of elimination.
    Terms(Vec<(u32, f64)>),
}

/// `L` with the pivots on its diagonal.
#[derive(Clone, Copy)]
pub(super) struct Factor<'a> {
    pub supernodes: &'a Supernodes,
    pub values: &'a [f64],
}

impl SolveParts {
    /// The parts of a factor. One that threads do not share has no small subtrees: they are steps above the large ones,
    /// with the same result.
    pub fn new(tree: &AssemblyTree, supernodes: &Supernodes, is_shared: bool) -> Self {
        let least = supernodes.value_count() / PARTS;
        let mut parts = SolveParts {
            subtrees: Vec::new(),
            parts: Vec::new(),
            above: Vec::new(),
            place: vec![0; supernodes.dim()],
            above_positions: 0,
        };
        let mut values_of_last = 0;
        for (task, waits) in tree.tasks().iter().zip(tree.waits()) {
            let [first, last] = [task.start, task.end - 1].map(|s| supernodes.columns(s));
            let positions = first.start..last.end;
            let values = supernodes.values_of(task.clone()).len();
            let (number, is_large) = (parts.subtrees.len(), values >= least);
            if *waits > 0 || !is_large && !is_shared {
                parts
                    .above
                    .extend(task.clone().map(|s| Step::Supernode(s as u32)));
                for position in positions {
                    parts.place[position] = parts.above_positions as u32;
                    parts.above_positions += 1;
                }
                continue;
            }
            match parts.parts.last_mut() {
                Some(last) if values_of_last + values <= least => {
                    last.end += 1;
                    values_of_last += values;
                }
                _ => {
                    parts.parts.push(number..number + 1);
                    values_of_last = values;
                }
            }
            if !is_large {
                parts.above.push(Step::Subtree(number as u32));
            }
            parts.subtrees.push(Subtree {
                supernodes: task.clone(),
                positions,
                is_large,
            });
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
        for Subtree { positions, .. } in &self.subtrees {
            let (before, after) = rest.split_at_mut(positions.start - at);
            let (own, after) = after.split_at_mut(positions.len());
            above.extend_from_slice(before);
            inside.push(Mutex::new(own));
            (rest, at) = (after, positions.end);
        }
        above.extend_from_slice(rest);

        let pull = |subtree: usize, own: &mut [f64]| self.pull(factor, subtree, own);
        let pulls = self.each_subtree(&inside, pull);
        for pull in &pulls {
            if let Pull::Sums(sums) = pull {
                above.iter_mut().zip(sums).for_each(|(x, sum)| *x -= sum);
            }
        }
        may_continue()?;
        let mut rows = Vec::new();
        for &step in &self.above {
            let s = match step {
                Step::Supernode(s) => s,
                Step::Subtree(k) => {
                    if let Pull::Terms(terms) = &pulls[k as usize] {
                        let terms = terms.iter();
                        terms.for_each(|&(place, v)| above[place as usize] -= v);
                    }
                    continue;
                }
            };
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
        let free_inside = self.subtrees.iter().map(|subtree| free(&subtree.positions));
        above[held - free_inside.sum::<usize>()..].fill(0.0);
        for &step in self.above.iter().rev() {
            let Step::Supernode(s) = step else { continue };
            let (start, block, pattern) = of_supernode(factor, s as usize);
            let start = self.place[start] as usize;
            rows.clear();
            let places = pattern.iter().map(|&row| self.place[row as usize]);
            rows.extend(places.map(|place| above[place as usize]));
            block.substitute(&mut above[start..start + block.width], &rows);
        }
        may_continue()?;
        self.each_subtree(&inside, |subtree, own| {
            let positions = &self.subtrees[subtree].positions;
            own[held.clamp(positions.start, positions.end) - positions.start..].fill(0.0);
            self.substitute(factor, subtree, own, &above)
        });

        let mut above = above.into_iter();
        let mut at = 0;
        for Subtree { positions, .. } in &self.subtrees {
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
        joined(collect_in_turn(self.parts.len(), |part| {
            let subtrees = self.parts[part].clone();
            subtrees.map(|k| task(k, &mut own(k))).collect()
        }))
    }

    /// Forward substitution in a subtree, and what it subtracts from the unknowns above.
    fn pull(&self, factor: Factor, subtree: usize, own: &mut [f64]) -> Pull {
        if self.subtrees[subtree].is_large {
            let mut sums = vec![0.0; self.above_positions];
            let add = |place: u32, v: f64| sums[place as usize] += v;
            self.eliminate(factor, subtree, own, add);
            Pull::Sums(sums)
        } else {
            let mut terms = Vec::new();
            let list = |place: u32, v: f64| terms.push((place, v));
            self.eliminate(factor, subtree, own, list);
            Pull::Terms(terms)
        }
    }

    /// Forward substitution in a subtree. `subtract` is called with the places of unknowns above and what is subtracted
    /// from them.
    fn eliminate(
        &self,
        factor: Factor,
        subtree: usize,
        own: &mut [f64],
        mut subtract: impl FnMut(u32, f64),
    ) {
        let Subtree {
            supernodes,
            positions,
            ..
        } = &self.subtrees[subtree];
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
                    None => subtract(self.place[row as usize], v),
                }
            }
        }
    }

    /// Back substitution in a subtree.
    fn substitute(&self, factor: Factor, subtree: usize, own: &mut [f64], above: &[f64]) {
        let Subtree {
            supernodes,
            positions,
            ..
        } = &self.subtrees[subtree];
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
    use super::Subtree;
    use crate::monitor::{spawned, with_threads};

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

    /// A band of unknowns, each with a chain of others, tied to the ground, and an order in which every chain comes
    /// before its unknown of the band.
    fn band_of_chains() -> (Sparse, Vec<u32>) {
        let (count, width, links) = (800u32, 20, 6);
        let link = |i: u32, k: u32| count + links * i + k;
        let springs = (0..count).flat_map(|i| {
            let band = (1..=width).map(move |d| [i, (i + d).min(count - 1)]);
            let before = move |k: u32| if k == 0 { i } else { link(i, k - 1) };
            let chain = (0..links).map(move |k| [link(i, k), before(k)]);
            band.chain(chain).filter(|[i, j]| i != j)
        });
        let each = |[i, j]: [u32; 2]| [(i, i, 1.0), (j, j, 1.0), (i.max(j), i.min(j), -1.0)];
        let n = count * (1 + links);
        let ground = (0..n).map(|i| (i, i, 0.1));
        let entries = springs.flat_map(each).chain(ground);
        let a = Sparse::from_triplets(n as usize, n as usize, entries).unwrap();
        let from_the_end = |i: u32| (0..links).rev().map(move |k| link(i, k)).chain([i]);
        (a, (0..count).flat_map(from_the_end).collect())
    }

    #[test]
    fn a_large_factor_is_solved_by_subtrees() {
        let of_grid = || {
            let order = minimum_degree(&grid()).unwrap();
            (grid(), order)
        };
        for ((a, order), many_large, many_small) in [(of_grid(), 8, 0), (band_of_chains(), 0, 100)]
        {
            let n = a.rows();
            let analysis = Analysis::shared_from(0, &a, order.clone()).unwrap();
            let parts = &analysis.pattern.solve;
            let (large, small): (Vec<&Subtree>, Vec<&Subtree>) =
                parts.subtrees.iter().partition(|subtree| subtree.is_large);
            assert!(
                large.len() >= many_large && small.len() >= many_small,
                "{} {} {}",
                large.len(),
                small.len(),
                parts.parts.len()
            );
            // Small ones that follow each other are one part.
            let of_small = parts.parts.len() - large.len();
            assert!(of_small <= small.len() && (many_small == 0 || 4 * of_small < small.len()));
            let all = large.iter().chain(&small);
            let inside: usize = all.map(|subtree| subtree.positions.len()).sum();
            assert!(inside > n / 2);
            assert_eq!(inside + parts.above_positions, n);
            let x: Vec<f64> = (0..n).map(|i| (i as f64).sin()).collect();
            let product = a.mul_symmetric(&x);
            let factor = Cholesky::with(&analysis, &a).unwrap();
            let solved = |threads| {
                let mut b = product.clone();
                with_threads(threads, || factor.solve(&mut b)).unwrap();
                b
            };
            let one = solved(1);
            for (b, x) in one.iter().zip(&x) {
                assert!((b - x).abs() < 1e-11, "{b} {x}");
            }
            assert!(spawned(|| assert!(solved(3) == one)) >= 4);
            // Without small subtrees.
            let alone = Analysis::shared_from(usize::MAX, &a, order).unwrap();
            let subtrees = &alone.pattern.solve.subtrees;
            assert!(subtrees.len() == large.len());
            let mut b = product.clone();
            let factor = Cholesky::with(&alone, &a).unwrap();
            factor.solve(&mut b).unwrap();
            assert!(b == one);
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
