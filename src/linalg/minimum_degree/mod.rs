//! Approximate minimum degree (`amestoy1996`): an order of elimination that keeps the factor sparse.

mod domains;
mod order;
mod quotient_graph;
#[cfg(test)]
mod tests;

use std::ops::Range;

use self::domains::eliminated_in_domains;
use self::quotient_graph::QuotientGraph;
use crate::error::Result;
use crate::monitor::may_continue;

/// The order of elimination of the symmetric matrix with this pattern: entry k is the unknown that is eliminated
/// k-th. The off-diagonal entries of row `i` of the lower triangle are among
/// `columns[offsets[i]..offsets[i + 1]]`. The order is a post-order of the assembly tree.
///
/// # Errors
/// [`OutOfMemory`](crate::Error::OutOfMemory), and the reason to end the current step.
pub(super) fn minimum_degree(offsets: &[usize], columns: &[u32]) -> Result<Vec<u32>> {
    let pattern = Pattern { offsets, columns };
    let mut graph = match eliminated_in_domains(pattern)? {
        Some(graph) => graph,
        None => QuotientGraph::new(pattern, 0..pattern.unknowns(), &[])?,
    };
    graph.eliminate_up_to(usize::MAX)?;
    may_continue()?;
    Ok(graph.order())
}

/// The pattern of the lower triangle of a symmetric matrix.
#[derive(Debug, Clone, Copy)]
struct Pattern<'a> {
    offsets: &'a [usize],
    columns: &'a [u32],
}

impl<'a> Pattern<'a> {
    fn unknowns(self) -> usize {
        self.offsets.len() - 1
    }

    /// The pairs of an unknown among these and a neighbour that is in its row.
    fn pairs(self, rows: Range<usize>) -> impl Iterator<Item = [usize; 2]> + 'a {
        rows.flat_map(move |i| {
            let row = &self.columns[self.offsets[i]..self.offsets[i + 1]];
            let pairs = row.iter().map(move |&j| [i, j as usize]);
            pairs.filter(|[i, j]| i != j)
        })
    }

    /// The pairs of neighbours that both belong to this part, numbered within it.
    fn pairs_within(self, part: Range<usize>) -> impl Iterator<Item = [usize; 2]> + 'a {
        let first = part.start;
        let pairs = self.pairs(part.clone());
        let pairs = pairs.filter(move |[_, j]| part.contains(j));
        pairs.map(move |pair| pair.map(|v| v - first))
    }

    /// The pairs of neighbours in rows of this part that do not both belong to it.
    fn pairs_leaving(self, part: Range<usize>) -> impl Iterator<Item = [usize; 2]> + 'a {
        let pairs = self.pairs(part.clone());
        pairs.filter(move |[_, j]| !part.contains(j))
    }
}
