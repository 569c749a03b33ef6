//! A lower bound on the energy from a flow, rounding errors included.
//!
//! For the point n and any move h of integers, with e the exact gradient at n, H the stored Hessian, and a
//! flow x that carries e_i out of every node i,
//!
//! ```text
//! E(n + h) - E(n) = e'h + h'Hh / 2 >= sum over edges of (x d + w d^2 / 2) - sum debt_i h_i^2 / 2
//! ```
//!
//! where d is the difference of h over the edge. The term of an edge is at least `-(|x| - w/2)_+ (|x|/w +
//! 1/2)`, the least value over all integers d. Three things are not exact, and each is moved to the edges of
//! a spanning tree, whose root is the ground, where h is zero:
//!
//! 1. The computed flow carries e_i up to a residual. The residuals run down the tree: the exact flow
//!    differs on a tree edge by at most the sum of residuals beyond it.
//! 2. A debt: h_i is the sum of the differences along the path to the root, so `h_i^2` is at most the length
//!    of the path times the sum of their squares. Each edge pays from its weight.
//! 3. A flow beyond half the weight, for either reason, costs the amount above.
//!
//! So the bound holds for every integer point and any flow. It trusts no step of the search.

use super::graph::CutGraph;
use super::network::{Network, gradient};
use crate::eliminate::ReducedModel;

/// Covers the rounding of a few operations on numbers that are not negative.
const UP: f64 = 1.0 + 16.0 * f64::EPSILON;

/// A lower bound on the energy of all integer points, from the point `n` and the flow of `network`. None if
/// an edge cannot pay the debts.
///
/// Parts of the graph that can be shifted are compared at the same value of their first integer.
pub(super) fn bound(
    model: &ReducedModel,
    graph: &CutGraph,
    network: &Network,
    n: &[f64],
) -> Option<f64> {
    let residual = residuals(model, graph, network, n);
    let tree = Tree::new(graph, network);
    let (extra, paid) = tree.carry(graph, &residual);
    let mut total = 0.0;
    for (k, edge) in graph.edges.iter().enumerate() {
        if edge.weight.is_infinite() {
            continue;
        }
        let half = 0.5 * edge.weight;
        let flow = network.flow_of(k).abs();
        let over = flow - half;
        let beyond = over + f64::EPSILON * over.abs() + (extra[k] + 0.5 * paid[k]) * UP;
        if beyond <= 0.0 {
            continue;
        }
        let weight = (edge.weight - paid[k]) * (1.0 - f64::EPSILON);
        if weight <= 0.0 {
            return None;
        }
        let farthest = (flow + extra[k]) / weight + 0.5;
        total += beyond * farthest * UP * UP;
    }
    let slack = total * (1.0 + graph.edges.len() as f64 * f64::EPSILON);
    let (energy, error) = model.energy(n);
    // The model's own rounding counts at these integers and at those of the optimum.
    let error = error + model.rounding().of_energy(n);
    let bound = energy - (error + slack) * UP;
    Some(bound - f64::EPSILON * bound.abs())
}

/// By integer: how much the flow out of it differs from the gradient, at most.
fn residuals(model: &ReducedModel, graph: &CutGraph, network: &Network, n: &[f64]) -> Vec<f64> {
    let (mut sums, sizes) = gradient(model, n);
    let outflow = network.outflow();
    let residual = |i: usize| {
        let sum = &mut sums[i];
        outflow[i].iter().for_each(|part| sum.add(-part));
        let size = sizes[i] + outflow[i][0].abs();
        let terms = f64::from(2 * graph.degree[i] + 8) * f64::EPSILON;
        (sum.value().abs() * (1.0 + f64::EPSILON) + terms * terms * size) * UP
    };
    (0..graph.ground).map(residual).collect()
}

/// A spanning tree in breadth-first order from the ground.
struct Tree {
    order: Vec<u32>,
    /// By node: the node before it and the edge that leads there.
    parent: Vec<(u32, u32)>,
    depth: Vec<u32>,
}

impl Tree {
    fn new(graph: &CutGraph, network: &Network) -> Self {
        let nodes = network.nodes();
        let mut tree = Tree {
            order: vec![graph.ground as u32],
            parent: vec![(0, 0); nodes],
            depth: vec![u32::MAX; nodes],
        };
        tree.depth[graph.ground] = 0;
        let mut from = 0;
        while from < tree.order.len() {
            let j = tree.order[from] as usize;
            for at in network.range(j) {
                let (edge, i, _) = network.arc(at);
                // An edge whose weight may be rounding can carry nothing.
                let held = graph.edges[edge].weight.is_infinite();
                let passable = j != graph.ground || held || graph.grounded[i];
                if passable && tree.depth[i] == u32::MAX {
                    tree.depth[i] = tree.depth[j] + 1;
                    tree.parent[i] = (j as u32, edge as u32);
                    tree.order.push(i as u32);
                }
            }
            from += 1;
        }
        tree
    }

    /// By edge: the residuals that it carries, and what it pays of the debts.
    fn carry(&self, graph: &CutGraph, residual: &[f64]) -> (Vec<f64>, Vec<f64>) {
        let mut extra = vec![0.0; graph.edges.len()];
        let mut paid = vec![0.0; graph.edges.len()];
        let up = 1.0 + 2.0 * self.order.len() as f64 * f64::EPSILON;
        let mut carried = residual.to_vec();
        let mut owed: Vec<f64> = (0..graph.ground)
            .map(|i| graph.debt[i] * f64::from(self.depth[i]))
            .collect();
        for &i in self.order[1..].iter().rev() {
            let (parent, edge) = self.parent[i as usize];
            extra[edge as usize] = carried[i as usize] * up;
            paid[edge as usize] = owed[i as usize] * up;
            if (parent as usize) < graph.ground {
                carried[parent as usize] += carried[i as usize];
                owed[parent as usize] += owed[i as usize];
            }
        }
        (extra, paid)
    }
}
