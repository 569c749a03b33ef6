//! The error of the offsets of a cycle space, which are zero residuals only at the exact relaxation.
//!
//! At the computed relaxation an edge with an integer has the residual `rho = g_p / (2 w step)`, where `g_p` is
//! the derivative by its integer. The edges without an integer are a forest. From its leaves upward, the
//! derivatives by the angles determine their residuals: at each angle the terms `2 w rho` add up to the
//! derivative.

use super::graph::NONE;
use super::space::CycleSpace;
use crate::cycle::forest::Forest;
use crate::eliminate::ReducedModel;
use crate::search::Search;

impl CycleSpace {
    /// A bound on `sqrt(sum of w rho^2)` at the point that the offsets belong to.
    pub(super) fn offset_error(&self, model: &ReducedModel, search: &Search) -> f64 {
        let point = search.relaxed();
        let slope = slope_bounds(model, point);
        let graph = &self.system.graph;
        let mut flow = vec![0.0; graph.nodes()];
        for (k, &i) in model.continuous().iter().enumerate() {
            flow[k] = slope[i as usize];
        }
        let mut square = 0.0;
        for edge in graph.edges.iter().filter(|e| e.integer != NONE) {
            let p = model.integers()[edge.integer as usize] as usize;
            // Besides, the offset itself is rounded twice.
            let rounding = 4.0 * f64::EPSILON * point[p].abs() * self.system.step * edge.weight;
            let through = slope[p] / self.system.step + 2.0 * rounding;
            square += through * through / (4.0 * edge.weight);
            flow[edge.tail as usize] += through;
            flow[edge.head as usize] += through;
        }
        let forest = Forest::through_fixed(graph);
        for &node in forest.order.iter().rev() {
            let e = forest.parent[node as usize];
            if e != NONE && graph.edges[e as usize].integer == NONE {
                let edge = &graph.edges[e as usize];
                let through = flow[node as usize];
                square += through * through / (4.0 * edge.weight);
                flow[edge.other(node) as usize] += through;
            }
        }
        1.01 * square.sqrt()
    }
}

/// By unknown: a bound on the exact derivative of the objective.
fn slope_bounds(model: &ReducedModel, point: &[f64]) -> Vec<f64> {
    let mut slope = model.hessian().mul_symmetric(point);
    let mut size: Vec<f64> = model.gradient().iter().map(|g| g.abs()).collect();
    let mut terms = vec![2.0; slope.len()];
    for (i, j, v) in model.hessian().entries() {
        for (at, other) in [(i as usize, j as usize), (j as usize, i as usize)] {
            size[at] += (v * point[other]).abs();
            terms[at] += 1.0;
        }
    }
    for (i, slope) in slope.iter_mut().enumerate() {
        let own = model.rounding().slope.get(i).copied().unwrap_or(0.0);
        *slope = (*slope + model.gradient()[i]).abs() + terms[i] * f64::EPSILON * size[i] + own;
    }
    slope
}
