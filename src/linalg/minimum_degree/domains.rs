//! Domains of a large matrix, in which unknowns are eliminated at the same time.
//!
//! Minimum degree eliminates unknowns of low degree first, all over the matrix, and spends most of its time on them. A
//! domain is a range of unknowns. Those without neighbours outside can be eliminated without regard to other domains,
//! up to a degree at which the order would soon have to pass the borders of domains. What is left then is ordered as a
//! whole.

use super::Pattern;
use super::quotient_graph::QuotientGraph;
use crate::error::Result;
use crate::monitor::{collect_in_turn, is_wanted};

/// The unknowns of a domain: about a millisecond's work.
const UNKNOWNS: usize = 4096;

/// The fewest domains that are worth it.
const LEAST: usize = 4;

/// The largest degree that is eliminated in a domain.
const DEGREE: usize = 16;

/// At most so many unknowns for each that has a neighbour in another domain.
const INSIDE: usize = 4;

/// The quotient graph of a matrix after the elimination in domains, if that is worth it.
///
/// # Errors
/// As [`minimum_degree`](super::minimum_degree).
pub(super) fn eliminated_in_domains(pattern: Pattern) -> Result<Option<QuotientGraph>> {
    let n = pattern.unknowns();
    let count = n / UNKNOWNS;
    if count < LEAST {
        return Ok(None);
    }
    let range = |k: usize| k * n / count..(k + 1) * n / count;
    let leaving = || (0..count).flat_map(|k| pattern.pairs_leaving(range(k)));
    let mut is_at_border = vec![false; n];
    leaving().flatten().for_each(|v| is_at_border[v] = true);
    let at_borders = is_at_border.iter().filter(|&&is| is).count();
    if at_borders * INSIDE > n {
        return Ok(None);
    }
    let both_ways = |[i, j]: [usize; 2]| [[i as u32, j as u32], [j as u32, i as u32]];
    let mut between: Vec<[u32; 2]> = leaving().flat_map(both_ways).collect();
    between.sort_unstable();
    between.dedup();
    let graphs = collect_in_turn(count, |k| {
        is_wanted()?;
        let range = range(k);
        let begin = between.partition_point(|pair| (pair[0] as usize) < range.start);
        let end = between.partition_point(|pair| (pair[0] as usize) < range.end);
        let mut graph = QuotientGraph::new(pattern, range, &between[begin..end])?;
        graph.eliminate_up_to(DEGREE)?;
        Ok(graph)
    });
    let graphs = graphs.into_iter().collect::<Result<Vec<_>>>()?;
    Ok(Some(QuotientGraph::joined(graphs, &between)?))
}
