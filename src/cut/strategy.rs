//! The method: from the rounded relaxation by minimum cuts to the proved optimum.

use super::certificate;
use super::flow::descend;
use super::graph::CutGraph;
use super::network::Network;
use crate::eliminate::ReducedModel;
use crate::error::Result;
use crate::round;
use crate::search::{Factors, Search};

/// Finds the optimum and proves it. Returns false if `model` is of another kind. In that case, it may have
/// offered a solution.
///
/// # Errors
/// Those of the evaluation of its offers.
pub(crate) fn exact(
    model: &ReducedModel,
    factors: &mut Factors,
    search: &mut Search,
) -> Result<bool> {
    let Some(graph) = CutGraph::detect(model) else {
        return Ok(false);
    };
    let start: Vec<f64> = search
        .relaxed()
        .iter()
        .map(|&x| round::nearest(x))
        .collect();
    search.offer(factors, &start)?;
    let Some(mut network) = Network::new(model, &graph, &start) else {
        return Ok(false);
    };
    let optimal = descend(&mut network, &mut |arcs| search.ends(arcs));
    let ground = network.moved[graph.ground];
    let integers: Vec<f64> = start
        .iter()
        .zip(&network.moved)
        .map(|(n, moved)| n + (moved - ground) as f64)
        .collect();
    search.offer(factors, &integers)?;
    if !optimal {
        return Ok(search.ends(0));
    }
    let bound = certificate::bound(model, &graph, &network, &integers);
    if let Some(bound) = bound {
        search.raise_bound(bound);
    }
    Ok(bound.is_some())
}
