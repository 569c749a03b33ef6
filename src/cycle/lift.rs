//! Conversion between charges and integers: the final step of the cycle method.
//!
//! The basis is integral, so any integer charges are the charges of some integers. These integers are
//! unique up to the gauge: the integers along a spanning forest are arbitrary. Given the charges, the
//! residuals determine the angles along the forest. Then each other edge determines its integer, up to
//! rounding.

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

    /// Integers whose charges are `charges`. Integers that no cycle contains keep the origin's values. None
    /// if the rounding errors are too large to determine the integers. The check for that is exact.
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

    /// Integers with these charges in the basis of a forest, by its chords. They differ from the origin
    /// on the chords and, where a chord has no integer, along a forest of the edges without one.
    pub fn integers_on(&self, chords: &[u32], charges: &[f64]) -> Vec<f64> {
        let graph = &self.system.graph;
        let mut jump = vec![0.0; graph.edges.len()];
        for (&e, charge) in chords.iter().zip(charges) {
            jump[e as usize] = *charge;
        }
        // Turning a node by whole steps changes no charge.
        let forest = Forest::through_fixed(graph);
        let mut turn = vec![0.0; graph.nodes()];
        for &node in &forest.order {
            let e = forest.parent[node as usize];
            if e != NONE {
                let edge = &graph.edges[e as usize];
                let sign = f64::from(edge.sign_from(node));
                turn[node as usize] = turn[edge.other(node) as usize] - sign * jump[e as usize];
            }
        }
        let mut integers = self.origin.clone();
        for (edge, jump) in graph.edges.iter().zip(jump) {
            if edge.integer != NONE {
                let p = edge.integer as usize;
                let total = jump + turn[edge.tail as usize] - turn[edge.head as usize];
                integers[p] += f64::from(self.system.sign[p]) * total;
            }
        }
        integers
    }
}
