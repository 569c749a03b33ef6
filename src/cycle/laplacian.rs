//! The Laplacian of the cycles, `A = M W^-1 M'`.

use super::cycles::Cycles;
use super::graph::Graph;
use crate::error::Result;
use crate::linalg::{Ldl, Sparse, minimum_degree};
use crate::monitor::{Stop, may_continue};

/// Cycles of more edges are eliminated last, so that nearest plane rounds them after all others. Rings of
/// meshes and arcs through the ground are shorter. Cycles around handles are longer, except on the smallest
/// meshes.
pub(super) const LONG: usize = 24;

/// By edge: the basis cycles through it, with their signs. This matrix is `M'`.
pub(super) fn incidence(graph: &Graph, basis: &Cycles) -> Result<Sparse> {
    let entries = (0..basis.len()).flat_map(|k| {
        let cycle = basis.get(k).iter();
        cycle.map(move |&(e, sign)| (e, k as u32, f64::from(sign)))
    });
    Sparse::from_triplets(graph.edges.len(), basis.len(), entries)
}

/// The lower triangle of A.
pub(super) fn laplacian(graph: &Graph, through: &Sparse) -> Result<Sparse> {
    let entries = graph.edges.iter().enumerate().flat_map(|(e, edge)| {
        let row = through.row(e);
        row.clone().flat_map(move |(i, u)| {
            let lower = row.clone().take_while(move |&(j, _)| j <= i);
            lower.map(move |(j, v)| (i as u32, j as u32, u * v / edge.weight))
        })
    });
    Sparse::from_triplets(through.cols(), through.cols(), entries)
}

/// The factor of A in a minimum-degree order with the long cycles last.
pub(super) fn factor(laplacian: &Sparse, basis: &Cycles) -> Result<Ldl> {
    let mut order = minimum_degree(laplacian)?;
    order.sort_by_key(|&k| basis.get(k as usize).len() > LONG);
    let mut ended = None;
    let factor = Ldl::new_while(laplacian, &order, || {
        ended = may_continue().err();
        ended.is_none()
    })?;
    factor.ok_or_else(|| ended.unwrap_or(Stop::Cancelled).into())
}
