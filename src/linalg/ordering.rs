//! The order of elimination and its elimination tree.
//!
//! The order is that of minimum degree (`minimum_degree.rs`). The elimination tree follows `liu1990`, section 4, and
//! is post-ordered, so that every subtree is a contiguous range of positions. faer does not post-order an
//! order that it is given, and does not expose its trees.

use super::Sparse;
use super::scaling::equilibrate;
use super::sparse::reserve;
use crate::error::{Error, Result};
use crate::monitor::may_continue_at;

/// The parent of a root.
pub const NONE: u32 = u32::MAX;

/// A matrix of at most so many unknowns is eliminated in the order of its pivots, since its fill does not matter.
const TINY: usize = 40;

/// The order in which unknowns are eliminated.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub enum Ordering {
    /// A fill-reducing order.
    #[default]
    FillReducing,
    /// The order given, for comparison.
    Natural,
    /// A fill-reducing order in factorizations. In the elimination of constraints, each row is solved for its
    /// largest coefficient, whatever the fill in other rows.
    LargestPivot,
}

impl Ordering {
    /// All orderings.
    pub const ALL: [Ordering; 3] = [
        Ordering::FillReducing,
        Ordering::Natural,
        Ordering::LargestPivot,
    ];

    /// The name of the ordering in options.
    pub fn name(self) -> &'static str {
        match self {
            Ordering::FillReducing => "fill_reducing",
            Ordering::Natural => "natural",
            Ordering::LargestPivot => "largest_pivot",
        }
    }

    /// The order for the matrix with lower triangle `lower`: entry k is the unknown that is
    /// eliminated k-th. Matrices of the same pattern may have different ones.
    ///
    /// # Errors
    /// [`OutOfMemory`](crate::Error::OutOfMemory), and the reason to end the current step.
    pub fn order(self, lower: &Sparse) -> Result<Vec<u32>> {
        match self {
            Ordering::FillReducing | Ordering::LargestPivot if lower.rows() <= TINY => {
                Ok(largest_pivots(lower))
            }
            Ordering::FillReducing | Ordering::LargestPivot => minimum_degree(lower),
            Ordering::Natural => Ok((0..lower.rows() as u32).collect()),
        }
    }
}

/// The order in which the largest pivot, relative to its diagonal entry, is always eliminated next (`higham2002`,
/// section 10.3). No entry of the factor then exceeds one by much, so that pivots which vanish are small, whatever the
/// weights.
fn largest_pivots(lower: &Sparse) -> Vec<u32> {
    let n = lower.rows();
    let scale = equilibrate(lower);
    let mut a = vec![0.0; n * n];
    for (i, j, v) in lower.entries() {
        let (i, j) = (i as usize, j as usize);
        a[i * n + j] = v * scale[i] * scale[j];
        a[j * n + i] = a[i * n + j];
    }
    let diagonal: Vec<f64> = (0..n).map(|k| a[k * (n + 1)]).collect();
    let mut left: Vec<usize> = (0..n).collect();
    let mut order = Vec::with_capacity(n);
    while !left.is_empty() {
        let share = |&k: &usize| a[k * (n + 1)] / diagonal[k];
        // Of equal pivots the first one.
        let at = (0..left.len()).rev();
        let at = at.max_by(|&x, &y| share(&left[x]).total_cmp(&share(&left[y])));
        let k = left.remove(at.unwrap_or_default());
        order.push(k as u32);
        let pivot = a[k * (n + 1)];
        if pivot > 0.0 {
            for &i in &left {
                let factor = a[i * n + k] / pivot;
                left.iter()
                    .for_each(|&j| a[i * n + j] -= factor * a[k * n + j]);
            }
        }
    }
    order
}

/// A fill-reducing order: entry k is the unknown that is eliminated k-th.
///
/// # Errors
/// [`OutOfMemory`](crate::Error::OutOfMemory), and the reason to end the current step.
pub fn minimum_degree(lower: &Sparse) -> Result<Vec<u32>> {
    super::minimum_degree::minimum_degree(lower.offsets(), lower.indices())
}

/// The elimination tree of a permuted matrix, post-ordered.
#[derive(Debug, Clone)]
pub struct EliminationTree {
    /// The unknown at each position.
    pub order: Vec<u32>,
    /// The position of each unknown.
    pub position: Vec<u32>,
    /// The parent of each position, or `u32::MAX` for a root.
    pub parent: Vec<u32>,
    /// The lowest position in the subtree of each position. The subtree of `j` is `first[j]..=j`.
    pub first: Vec<u32>,
}

impl EliminationTree {
    /// The tree of a dense matrix of `n` unknowns, which are eliminated in the order of their numbers.
    pub fn chain(n: usize) -> Self {
        let n = n as u32;
        EliminationTree {
            order: (0..n).collect(),
            position: (0..n).collect(),
            parent: (1..=n).map(|p| if p < n { p } else { NONE }).collect(),
            first: vec![0; n as usize],
        }
    }

    /// The tree of the matrix with lower triangle `lower`, eliminated in `order`. The positions are
    /// post-ordered afterwards, which changes neither fill nor work.
    ///
    /// # Errors
    /// [`Error::OutOfMemory`], [`Error::Overflow`], and the reason to end the current step.
    pub fn new(lower: &Sparse, order: &[u32]) -> Result<Self> {
        let position = inverse(order);
        let (offsets, columns) = permute_pattern(lower, &position)?;
        let parent = parents(&offsets, &columns)?;
        let post = post_order(&parent);
        let place = inverse(&post);
        let parent: Vec<u32> = post
            .iter()
            .map(|&j| match parent[j as usize] {
                NONE => NONE,
                p => place[p as usize],
            })
            .collect();
        let order: Vec<u32> = post.iter().map(|&j| order[j as usize]).collect();
        let mut first: Vec<u32> = (0..order.len() as u32).collect();
        for j in 0..order.len() {
            if parent[j] != NONE {
                let p = parent[j] as usize;
                first[p] = first[p].min(first[j]);
            }
        }
        Ok(EliminationTree {
            position: inverse(&order),
            order,
            parent,
            first,
        })
    }
}

pub(super) fn inverse(order: &[u32]) -> Vec<u32> {
    let mut position = vec![0; order.len()];
    for (k, &i) in order.iter().enumerate() {
        position[i as usize] = k as u32;
    }
    position
}

/// For each position, the lower positions with which it shares an entry. Those of position `k` are
/// `columns[offsets[k]..offsets[k + 1]]`.
pub(super) fn permute_pattern(lower: &Sparse, position: &[u32]) -> Result<(Vec<u32>, Vec<u32>)> {
    let n = lower.rows();
    // The higher and the lower position of each entry of a row off the diagonal.
    let pairs = |i: usize| {
        let others = lower.row(i).map(|(j, _)| j).filter(move |&j| j != i);
        others.map(move |j| {
            let [a, b] = [i, j].map(|i| position[i]);
            (a.max(b) as usize, a.min(b))
        })
    };
    let mut offsets = vec![0u32; n + 1];
    for i in 0..n {
        may_continue_at(i)?;
        pairs(i).for_each(|(k, _)| offsets[k + 1] += 1);
    }
    for k in 0..n {
        let end = offsets[k].checked_add(offsets[k + 1]);
        offsets[k + 1] = end.ok_or_else(too_many_entries)?;
    }
    let mut next = offsets.clone();
    let mut columns = reserve(offsets[n] as usize)?;
    columns.resize(offsets[n] as usize, 0);
    for i in 0..n {
        may_continue_at(i)?;
        for (k, column) in pairs(i) {
            columns[next[k] as usize] = column;
            next[k] += 1;
        }
    }
    Ok((offsets, columns))
}

/// The error of a matrix that 32 bits cannot count.
pub(super) fn too_many_entries() -> Error {
    Error::Overflow {
        what: "a matrix has more than 2^32 entries".into(),
        index: None,
    }
}

/// The parents of all positions by path compression through virtual ancestors (`liu1990`, algorithm 4.2).
///
/// # Errors
/// The reason to end the current step.
pub(super) fn parents(offsets: &[u32], columns: &[u32]) -> Result<Vec<u32>> {
    let n = offsets.len() - 1;
    let mut parent = vec![NONE; n];
    let mut ancestor = vec![NONE; n];
    for i in 0..n {
        may_continue_at(i)?;
        for &j in &columns[offsets[i] as usize..offsets[i + 1] as usize] {
            let mut j = j as usize;
            while ancestor[j] != NONE && ancestor[j] != i as u32 {
                let next = ancestor[j] as usize;
                ancestor[j] = i as u32;
                j = next;
            }
            if ancestor[j] == NONE {
                ancestor[j] = i as u32;
                parent[j] = i as u32;
            }
        }
    }
    Ok(parent)
}

pub(super) fn post_order(parent: &[u32]) -> Vec<u32> {
    let n = parent.len();
    let (mut child, mut sibling) = (vec![NONE; n], vec![NONE; n]);
    for j in (0..n).rev() {
        if parent[j] != NONE {
            let p = parent[j] as usize;
            sibling[j] = child[p];
            child[p] = j as u32;
        }
    }
    let mut post = Vec::with_capacity(n);
    let mut stack = Vec::new();
    for root in (0..n).filter(|&j| parent[j] == NONE) {
        stack.push(root as u32);
        while let Some(&j) = stack.last() {
            let c = child[j as usize];
            if c == NONE {
                post.push(j);
                stack.pop();
            } else {
                child[j as usize] = sibling[c as usize];
                stack.push(c);
            }
        }
    }
    post
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn subtrees_are_ranges_that_end_at_their_root() {
        let n = 40u32;
        let edges = (1..n).map(|i| (i, (i * 7 + 3) % i, 1.0));
        let diagonal = (0..n).map(|i| (i, i, 4.0));
        let a = Sparse::from_triplets(40, 40, edges.chain(diagonal)).unwrap();
        let tree = EliminationTree::new(&a, &minimum_degree(&a).unwrap()).unwrap();
        for j in 0..40 {
            assert_eq!(tree.order[tree.position[j] as usize] as usize, j);
            if tree.parent[j] != NONE {
                let p = tree.parent[j] as usize;
                assert!(p > j && tree.first[p] <= tree.first[j]);
            }
        }
    }
}
