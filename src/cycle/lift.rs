//! Charges from integers, and integers from charges.
//!
//! The basis is integral, so all integer charges are those of some integers, and these are unique
//! up to the gauge: along a spanning forest they may be anything. Given charges, the angles follow
//! the residuals along the forest, and every other edge closes to an integer up to rounding.

use super::forest::Forest;
use super::graph::NONE;
use super::space::CycleSpace;
use crate::round::nearest;

impl CycleSpace {
    /// The charges of `integers`.
    pub fn charges(&self, integers: &[f64]) -> Vec<f64> {
        let edges = self.system.graph.edges.iter();
        let jumps: Vec<f64> = edges
            .map(|e| match e.integer {
                NONE => 0.0,
                p => {
                    let p = p as usize;
                    f64::from(self.system.sign[p]) * (integers[p] - self.origin[p])
                }
            })
            .collect();
        self.basis.collect(&jumps)
    }

    /// Integers whose charges are `charges`; those that no cycle reaches are at the origin. None
    /// where rounding errors are too large to tell them, which is checked without any.
    pub fn integers(&self, charges: &[f64]) -> Option<Vec<f64>> {
        let graph = &self.system.graph;
        let (x, _) = self.potentials(charges);
        let forest = Forest::through_fixed(graph);
        // What the angles' difference over an edge is where it does not jump.
        let smooth = |e: usize| self.residual(&x, e) - self.kappa[e];
        let mut angle = vec![0.0; graph.nodes()];
        for &node in &forest.order {
            let e = forest.parent[node as usize];
            if e != NONE {
                let edge = &graph.edges[e as usize];
                let parent = angle[edge.other(node) as usize];
                angle[node as usize] =
                    parent + f64::from(edge.sign_from(node)) * smooth(e as usize);
            }
        }
        let mut integers = self.origin.clone();
        for (e, edge) in graph.edges.iter().enumerate() {
            if edge.integer != NONE {
                let difference = angle[edge.tail as usize] - angle[edge.head as usize];
                let jump = nearest((smooth(e) - difference) / self.system.step);
                let p = edge.integer as usize;
                integers[p] += f64::from(self.system.sign[p]) * jump;
            }
        }
        (self.charges(&integers) == charges).then_some(integers)
    }
}
