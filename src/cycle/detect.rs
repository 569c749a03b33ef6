//! Detection of an angle-difference system in a reduced Hessian: the first step of the cycle method.
//!
//! A local integer p in the term `w (a (x_i - x_j) + b p + r)^2` determines the term by its row of the
//! Hessian: `H_pp = 2 w b^2`, `H_pi = -H_pj = 2 w a b`. So the edge has the weight `w a^2 = H_pi^2 / (2
//! H_pp)` and the step `b / a = H_pp / H_pi`. All these terms are subtracted from the continuous block. The
//! remainder must be the Laplacian of a weighted graph, edges to the ground included. The offsets r need
//! not be known. If the edges without an integer form a forest, every residual vanishes at the relaxation's
//! minimiser.

use super::graph::{Edge, Graph, NONE};
use crate::eliminate::ReducedModel;
use crate::linalg::Sparse;

/// Relative to the terms, two entries that differ by less than this are equal, and a smaller difference is
/// zero. This is a hundred times the rounding error of assembling rows of unit size.
pub(super) const TOLERANCE: f64 = 1e-10;

/// An angle-difference system whose edges without an integer form a forest.
#[derive(Debug, Clone)]
pub(crate) struct AngleSystem {
    pub(super) graph: Graph,
    /// The step: one integer turns its edge by this. It is the same for all integers.
    pub(super) step: f64,
    /// By place among the model's integers: 1 if the edge's integer has the same sign, -1 if it has the
    /// opposite sign, 0 if the integer couples to nothing.
    pub(super) sign: Vec<i8>,
}

/// The remainder of the continuous block, with one row for each continuous unknown.
struct Rest {
    diagonal: Vec<f64>,
    /// The original diagonal.
    size: Vec<f64>,
    /// Entries to be summed, `row > column`.
    off: Vec<(u32, u32, f64)>,
}

impl AngleSystem {
    /// The angle-difference system of `model`, if `model` is one.
    pub fn detect(model: &ReducedModel) -> Option<Self> {
        let ground = model.continuous().len() as u32;
        let (mut rest, rows) = split(model)?;
        let mut edges = Vec::with_capacity(model.hessian().len() / 3);
        let mut sign = vec![0; rows.len()];
        let mut steps = Vec::with_capacity(rows.len());
        for (p, row) in rows.iter().enumerate() {
            let (tail, head, pull) = match row.pulls[..row.count] {
                [] => continue,
                [(i, u)] => (i, ground, u),
                [(i, u), (j, v)] if (u + v).abs() <= TOLERANCE * u.abs() => (i, j, u),
                _ => return None,
            };
            if row.curvature <= 0.0 {
                return None;
            }
            steps.push((row.curvature / pull).abs());
            sign[p] = if pull > 0.0 { 1 } else { -1 };
            let weight = 0.5 * pull * pull / row.curvature;
            rest.take(tail, head, weight, ground);
            edges.push(Edge {
                tail,
                head,
                weight,
                integer: p as u32,
            });
        }
        let step = *steps.first()?;
        let agrees = |s: &f64| (s - step).abs() <= TOLERANCE * step;
        if !steps.iter().all(agrees) || !rest.into_edges(ground, &mut edges) {
            return None;
        }
        let graph = Graph::new(ground as usize + 1, edges);
        is_forest(&graph).then_some(AngleSystem { graph, step, sign })
    }
}

/// The row of an integer.
#[derive(Debug, Clone, Copy, Default)]
struct IntegerRow {
    curvature: f64,
    pulls: [(u32, f64); 2],
    count: usize,
}

/// The continuous block and the rows of the integers. None if an integer is not local.
fn split(model: &ReducedModel) -> Option<(Rest, Vec<IntegerRow>)> {
    // Most other problems are told apart by their first integers: a local one has three entries at most.
    let is_local = |&p: &u32| {
        let entries = model.hessian().row(p as usize);
        entries.filter(|&(_, v)| v != 0.0).count() <= 3
    };
    if !model.integers().iter().all(is_local) {
        return None;
    }
    let n = model.continuous().len();
    let place = places(model);
    let mut rows = vec![IntegerRow::default(); model.integers().len()];
    let mut rest = Rest {
        diagonal: vec![0.0; n],
        size: vec![0.0; n],
        off: Vec::with_capacity(model.hessian().len()),
    };
    let entries = model.hessian().entries();
    for (i, j, v) in entries.filter(|&(i, j, v)| i == j || v != 0.0) {
        match (place[i as usize], place[j as usize]) {
            (Ok(a), Ok(b)) if a == b => {
                rest.diagonal[a as usize] = v;
                rest.size[a as usize] = v.abs();
            }
            (Ok(a), Ok(b)) => rest.off.push((a.max(b), a.min(b), v)),
            (Ok(a), Err(p)) | (Err(p), Ok(a)) => {
                let row = &mut rows[p as usize];
                *row.pulls.get_mut(row.count)? = (a, v);
                row.count += 1;
            }
            (Err(p), Err(q)) if p == q => rows[p as usize].curvature = v,
            (Err(_), Err(_)) => return None,
        }
    }
    Some((rest, rows))
}

/// By reduced unknown: its place among the continuous unknowns, or (`Err`) among the integers.
fn places(model: &ReducedModel) -> Vec<Result<u32, u32>> {
    let mut place = vec![Ok(0); model.dim()];
    for (k, &i) in model.continuous().iter().enumerate() {
        place[i as usize] = Ok(k as u32);
    }
    for (k, &i) in model.integers().iter().enumerate() {
        place[i as usize] = Err(k as u32);
    }
    place
}

impl Rest {
    /// Subtracts an edge with an integer.
    fn take(&mut self, tail: u32, head: u32, weight: f64, ground: u32) {
        self.diagonal[tail as usize] -= 2.0 * weight;
        if head != ground {
            self.diagonal[head as usize] -= 2.0 * weight;
            let (i, j) = (tail.max(head), tail.min(head));
            self.off.push((i, j, 2.0 * weight));
        }
    }

    /// Adds the edges without an integer. Returns whether the remainder is a Laplacian.
    fn into_edges(mut self, ground: u32, edges: &mut Vec<Edge>) -> bool {
        let n = self.diagonal.len();
        let Ok(off) = Sparse::from_triplets(n, n, self.off.iter().copied()) else {
            return false;
        };
        let mut push = |tail, head, twice_weight: f64| {
            edges.push(Edge {
                tail,
                head,
                weight: 0.5 * twice_weight,
                integer: NONE,
            });
        };
        for (i, j, v) in off.entries() {
            let (a, b) = (i as usize, j as usize);
            let noise = TOLERANCE * f64::min(self.size[a], self.size[b]);
            if v > noise {
                return false;
            }
            if v < -noise {
                self.diagonal[a] += v;
                self.diagonal[b] += v;
                push(i, j, -v);
            }
        }
        for (i, (&v, size)) in self.diagonal.iter().zip(&self.size).enumerate() {
            let noise = TOLERANCE * size;
            if v < -noise {
                return false;
            }
            if v > noise {
                push(i as u32, ground, v);
            }
        }
        true
    }
}

/// Whether the edges without an integer form a forest.
fn is_forest(graph: &Graph) -> bool {
    let mut root: Vec<u32> = (0..graph.nodes() as u32).collect();
    let find = |root: &mut Vec<u32>, mut i: u32| {
        while root[i as usize] != i {
            root[i as usize] = root[root[i as usize] as usize];
            i = root[i as usize];
        }
        i
    };
    graph.edges.iter().filter(|e| e.integer == NONE).all(|e| {
        let (a, b) = (find(&mut root, e.tail), find(&mut root, e.head));
        root[a.max(b) as usize] = a.min(b);
        a != b
    })
}
