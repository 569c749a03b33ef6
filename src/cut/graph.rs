//! Detection of a graph Laplacian plus a diagonal in a reduced Hessian.
//!
//! With `s_i = h_ii - sum_j |h_ij|`, the quadratic form is
//! `h'Hh = sum_ij |h_ij| (h_i - h_j)^2 + sum_i s_i h_i^2` where all off-diagonal entries are negative. So an
//! entry h_ij is an edge of weight `|h_ij|`, and s_i is the weight of an edge to the *ground*, a node whose
//! value is fixed.
//!
//! The sums s_i are computed to twice the working precision. One that is negative, but not by more than the
//! rounding of its terms, makes no edge. What it lacks is kept as a *debt*, and so is what a positive
//! off-diagonal entry of that size takes away: `2 h_ij h_i h_j >= -h_ij (h_i^2 + h_j^2)`. The certificate
//! pays the debts.

use crate::eliminate::ReducedModel;
use crate::linalg::{CompensatedSum, DisjointSets, TwoFold};

/// An edge. Its weight is infinite if it holds two nodes together.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Edge {
    pub tail: u32,
    pub head: u32,
    pub weight: f64,
}

/// The graph of the integers, numbered as the reduced unknowns, and of the ground, which is last.
#[derive(Debug, Clone)]
pub(super) struct CutGraph {
    /// The number of integers, and the number of the ground.
    pub ground: usize,
    pub edges: Vec<Edge>,
    /// By integer i: `sum of edges + debt_i h_i^2 >= h'Hh`, each debt not negative.
    pub debt: Vec<f64>,
    /// By integer: the number of off-diagonal entries in its row.
    pub degree: Vec<u32>,
    /// By integer: whether the weight of its edge to the ground is more than rounding.
    pub grounded: Vec<bool>,
}

/// The rounding error of a diagonal entry with this number of off-diagonal entries in its row. The entry is
/// a sum of about as many products, each rounded three times, read from decimal numbers or computed.
fn rounding(diagonal: f64, degree: u32) -> f64 {
    2.0 * f64::from(degree + 2) * f64::EPSILON * diagonal
}

impl CutGraph {
    /// The graph of `model`, if all its unknowns are integer and its Hessian is as the head says.
    ///
    /// A connected part without an edge to the ground can be shifted without a change. Its first integer is
    /// held to the ground.
    pub fn detect(model: &ReducedModel) -> Option<Self> {
        let n = model.dim();
        if n == 0 || !model.continuous().is_empty() {
            return None;
        }
        let mut diagonal = vec![0.0; n];
        let mut degree = vec![0; n];
        let mut count = 0;
        for (i, j, v) in model.hessian().entries() {
            if i == j {
                diagonal[i as usize] = v;
            } else if v != 0.0 {
                degree[i as usize] += 1;
                degree[j as usize] += 1;
                count += 1;
            }
        }
        let mut rest: Vec<_> = diagonal.iter().map(|&d| CompensatedSum::new(d)).collect();
        let mut edges = Vec::with_capacity(count + n);
        let mut parts = DisjointSets::new(n + 1);
        for (i, j, v) in model.hessian().entries() {
            if i == j || v == 0.0 {
                continue;
            }
            let (a, b) = (i as usize, j as usize);
            if v > 0.0 && v > rounding(diagonal[a].min(diagonal[b]), 0) {
                return None;
            }
            rest[a].add(-v.abs());
            rest[b].add(-v.abs());
            if v < 0.0 {
                parts.join(a, b);
                edges.push(Edge {
                    tail: i,
                    head: j,
                    weight: -v,
                });
            }
        }
        let mut debt = vec![0.0; n];
        let mut grounded = vec![false; n];
        for i in 0..n {
            let TwoFold {
                high: sum,
                low: lost,
            } = rest[i].two_fold();
            let noise = rounding(diagonal[i], degree[i]);
            if sum < -noise {
                return None;
            }
            // The sum itself is accurate to twice the working precision.
            let terms = f64::from(degree[i] + 2) * f64::EPSILON;
            debt[i] = (-sum).max(0.0) + lost.abs() + terms * terms * diagonal[i];
            grounded[i] = sum > noise;
            if grounded[i] {
                parts.join(i, n);
            }
        }
        let ground = parts.root(n);
        let mut edge = |i: usize, weight: f64| {
            edges.push(Edge {
                tail: i as u32,
                head: n as u32,
                weight,
            });
        };
        for i in 0..n {
            let own = parts.root(i);
            let sum = rest[i].value();
            if own == ground && sum > 0.0 {
                edge(i, sum);
            } else if own == i && own != ground {
                edge(i, f64::INFINITY);
            }
        }
        Some(CutGraph {
            ground: n,
            edges,
            debt,
            degree,
            grounded,
        })
    }
}
