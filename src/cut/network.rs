//! The network of the flow, in exact integers.
//!
//! Let e be the gradient of the energy at the current integers n. The move from n to `n + h` changes the
//! energy by `e'h + sum w_ij (h_i - h_j)^2 / 2`. A flow x that carries e_i out of every node i, with
//! `|x_ij| <= w_ij / 2`, proves that no move of integers is downhill: each edge contributes
//! `x d + w d^2 / 2 >= 0` for every integer d. The *excess* is the part of e that no edge carries yet.
//! Excess goes from nodes where it is positive to nodes where it is negative. The ground has the gradient
//! that makes the sum zero.
//!
//! All of this is in multiples of a power of two, the unit, in 128 bits. Weights and gradients of usual
//! ranges are multiples of the unit, and no flow is ever rounded.

use super::graph::CutGraph;
use crate::eliminate::ReducedModel;
use crate::linalg::CompensatedSum;

/// The excess and the capacities add up to less than two to the power of this.
const BITS: i32 = 116;

/// More than any flow.
pub(super) const UNLIMITED: i128 = 1 << (BITS + 4);

/// The flow, the excess and the moves of the integers from their start.
#[derive(Debug)]
pub(super) struct Network {
    /// The tail and the head of each edge.
    pub ends: Vec<[u32; 2]>,
    /// Half of each weight, which is the capacity of the edge in both directions.
    pub half: Vec<i128>,
    /// The flow from tail to head.
    pub flow: Vec<i128>,
    pub excess: Vec<i128>,
    /// How far each node has moved, the ground included.
    pub moved: Vec<i64>,
    /// The integers move in steps of two to the power of this.
    pub scale: u32,
    /// The unit is two to the power of minus this.
    shift: i32,
    first: Vec<u32>,
    /// Twice the edge, plus one at the edge's head.
    arcs: Vec<u32>,
}

/// `x * 2^power`.
pub(super) fn scaled(x: f64, power: i32) -> f64 {
    // Two factors, since one of them may overflow alone.
    let half = power / 2;
    x * 2f64.powi(half) * 2f64.powi(power - half)
}

/// The gradient `H n + g` in two parts each, and the sizes of their terms.
pub(super) fn gradient(model: &ReducedModel, n: &[f64]) -> (Vec<CompensatedSum>, Vec<f64>) {
    let linear = model.gradient();
    let mut sums: Vec<_> = linear.iter().map(|&g| CompensatedSum::new(g)).collect();
    let mut sizes: Vec<_> = linear.iter().map(|g| g.abs()).collect();
    for (i, j, v) in model.hessian().entries() {
        let (i, j) = (i as usize, j as usize);
        sums[i].add_product(v, n[j]);
        sizes[i] += (v * n[j]).abs();
        if i != j {
            sums[j].add_product(v, n[i]);
            sizes[j] += (v * n[i]).abs();
        }
    }
    (sums, sizes)
}

impl Network {
    /// The network at the integers `start`. None if the weights differ by too many orders of magnitude.
    pub fn new(model: &ReducedModel, graph: &CutGraph, start: &[f64]) -> Option<Self> {
        let (gradient, _) = gradient(model, start);
        let finite = graph.edges.iter().filter(|e| e.weight.is_finite());
        let forces: f64 = gradient.iter().map(|g| g.value().abs()).sum();
        let most = forces + finite.map(|e| e.weight).sum::<f64>();
        if !most.is_finite() {
            return None;
        }
        let shift = BITS - most.log2().max(-1000.0).ceil() as i32;
        let units = |x: f64| scaled(x, shift).round_ties_even() as i128;
        let mut excess: Vec<i128> = Vec::with_capacity(graph.ground + 1);
        for sum in &gradient {
            let sum = sum.two_fold();
            excess.push(units(sum.high) + units(sum.low));
        }
        excess.push(-excess.iter().sum::<i128>());
        let mut half = Vec::with_capacity(graph.edges.len());
        for edge in &graph.edges {
            let capacity = if edge.weight.is_finite() {
                units(0.5 * edge.weight)
            } else {
                UNLIMITED
            };
            if capacity == 0 {
                return None;
            }
            half.push(capacity);
        }
        let ends: Vec<_> = graph.edges.iter().map(|e| [e.tail, e.head]).collect();
        let (first, arcs) = incidence(graph.ground + 1, &ends);
        Some(Network {
            flow: vec![0; half.len()],
            moved: vec![0; graph.ground + 1],
            scale: 0,
            ends,
            half,
            excess,
            shift,
            first,
            arcs,
        })
    }

    /// The number of nodes, the ground included.
    pub fn nodes(&self) -> usize {
        self.excess.len()
    }

    /// The arcs of `node` in `arcs`.
    pub fn range(&self, node: usize) -> std::ops::Range<usize> {
        self.first[node] as usize..self.first[node + 1] as usize
    }

    /// The edge, the other end, and whether `node` is the edge's head, for the arc at place `at`.
    pub fn arc(&self, at: usize) -> (usize, usize, bool) {
        let (edge, is_head) = (self.arcs[at] as usize / 2, self.arcs[at] & 1 == 1);
        (
            edge,
            self.ends[edge][usize::from(!is_head)] as usize,
            is_head,
        )
    }

    /// The capacity of `edge` in each direction.
    pub fn capacity(&self, edge: usize) -> i128 {
        if self.half[edge] >= UNLIMITED >> self.scale {
            UNLIMITED
        } else {
            self.half[edge] << self.scale
        }
    }

    /// How much more flow can leave by `edge`, from its head or from its tail.
    pub fn room(&self, edge: usize, from_head: bool) -> i128 {
        let flow = self.flow[edge];
        self.capacity(edge) + if from_head { flow } else { -flow }
    }

    /// Makes the step half as long. Flow beyond the new capacities returns to the excess. Returns false if
    /// the excess becomes too large.
    pub fn refine(&mut self) -> bool {
        self.scale -= 1;
        let mut total: i128 = 0;
        for edge in 0..self.ends.len() {
            let capacity = self.capacity(edge);
            let kept = self.flow[edge].clamp(-capacity, capacity);
            let back = self.flow[edge] - kept;
            let [tail, head] = self.ends[edge];
            self.flow[edge] = kept;
            self.excess[tail as usize] += back;
            self.excess[head as usize] -= back;
            total += back.abs();
            if total >= 1 << BITS {
                return false;
            }
        }
        true
    }

    /// The flow of `edge` as a number, rounded.
    pub fn flow_of(&self, edge: usize) -> f64 {
        scaled(self.flow[edge] as f64, -self.shift)
    }

    /// What flows out of each node, exact in two parts.
    pub fn outflow(&self) -> Vec<[f64; 2]> {
        let mut sums = vec![0i128; self.nodes()];
        for (&[tail, head], &flow) in self.ends.iter().zip(&self.flow) {
            sums[tail as usize] += flow;
            sums[head as usize] -= flow;
        }
        let parts = sums.into_iter().map(|sum| {
            let high = sum as f64;
            let low = (sum - high as i128) as f64;
            [scaled(high, -self.shift), scaled(low, -self.shift)]
        });
        parts.collect()
    }
}

/// The arcs of each node and where they begin.
fn incidence(nodes: usize, ends: &[[u32; 2]]) -> (Vec<u32>, Vec<u32>) {
    let mut first = vec![0u32; nodes + 1];
    for end in ends.iter().flatten() {
        first[*end as usize + 1] += 1;
    }
    for i in 0..nodes {
        first[i + 1] += first[i];
    }
    let mut next = first.clone();
    let mut arcs = vec![0; 2 * ends.len()];
    for (edge, pair) in ends.iter().enumerate() {
        for (side, &end) in pair.iter().enumerate() {
            arcs[next[end as usize] as usize] = (2 * edge + side) as u32;
            next[end as usize] += 1;
        }
    }
    (first, arcs)
}
