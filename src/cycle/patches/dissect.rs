//! The tree of patches: recursive bisection of the unknown angles.
//!
//! A patch is a set of nodes with all edges between them and to the ground. Its halves share no edge. The
//! edges between the halves belong to the patch itself. What the tree loses is the energy of these edges.
//! So several bisections are tried, with edges weighted by the incumbent's residuals, and the one is kept
//! that loses the least energy of the incumbent.

use super::bisect::{Measure, bisect};
use super::coarsen::Weighted;
use crate::cycle::graph::Graph;
use crate::linalg::Random;
use crate::monitor::is_wanted;

/// No parent.
pub(super) const NO_PATCH: usize = usize::MAX;

/// Patches of fewer nodes are not divided.
const LEAST_NODES: usize = 4;

/// Conjugate-gradient steps that estimate the energy of a half.
const STEPS: usize = 25;

/// The time of a bisection and of its estimate, in multiplications for each edge.
const PER_EDGE: u64 = 200;

/// How a tree is made.
#[derive(Debug, Clone)]
pub(in crate::cycle) struct Recipe {
    /// A patch with more cycles is divided.
    pub leaf: usize,
    /// The weights of edges are their energies, relative to the mean, plus one of these.
    pub floors: Vec<f64>,
    /// The number of bisections tried with each floor.
    pub tries: usize,
    /// The price of an edge between halves, in units of the mean energy of edges.
    pub price: f64,
    /// The exponent of the imbalance.
    pub balance: f64,
    pub seed: u64,
}

/// A node of the tree.
#[derive(Debug, Clone)]
pub(super) struct Patch {
    pub parent: usize,
    pub children: Option<[usize; 2]>,
    /// The edges of the patch that are in no child.
    pub edges: Vec<u32>,
}

/// The patches of a tree, every child before its parent. `residuals` are those of the incumbent, by edge.
/// `stop` gets the multiplications; once it says so, patches are not divided.
pub(super) fn dissect(
    graph: &Graph,
    residuals: &[f64],
    recipe: &Recipe,
    stop: &mut dyn FnMut(u64) -> bool,
) -> Vec<Patch> {
    let energies = graph.edges.iter().zip(residuals);
    let energy: Vec<f64> = energies.map(|(e, r)| e.weight * r * r).collect();
    let mean = energy.iter().sum::<f64>() / energy.len().max(1) as f64;
    let mut dissection = Dissection {
        graph,
        residuals,
        mean: if mean > 0.0 { mean } else { 1.0 },
        energy,
        recipe,
        random: Random::new(recipe.seed),
        place: vec![u32::MAX; graph.nodes()],
        patches: Vec::new(),
        stop,
    };
    let nodes: Vec<u32> = (0..graph.ground()).collect();
    let edges: Vec<u32> = (0..graph.edges.len() as u32).collect();
    dissection.divide(nodes, edges);
    dissection.patches
}

struct Dissection<'a> {
    graph: &'a Graph,
    residuals: &'a [f64],
    energy: Vec<f64>,
    mean: f64,
    recipe: &'a Recipe,
    random: Random,
    /// By node: its place in the patch at hand.
    place: Vec<u32>,
    patches: Vec<Patch>,
    stop: &'a mut dyn FnMut(u64) -> bool,
}

/// A bisection and what it loses.
struct Halving {
    value: f64,
    nodes: [Vec<u32>; 2],
    /// The edges of the halves, and those between them.
    edges: [Vec<u32>; 3],
}

impl Dissection<'_> {
    /// Adds the patch of `nodes` and `edges` after its halves. Returns its place.
    fn divide(&mut self, nodes: Vec<u32>, edges: Vec<u32>) -> usize {
        let cycles = edges.len().saturating_sub(nodes.len());
        let divides = cycles > self.recipe.leaf && nodes.len() >= LEAST_NODES;
        let best = if divides {
            self.best(&nodes, &edges)
        } else {
            None
        };
        let (children, edges) = match best {
            None => (None, edges),
            Some(Halving {
                nodes: [a, b],
                edges: [of_a, of_b, between],
                ..
            }) => {
                drop((nodes, edges));
                let children = [self.divide(a, of_a), self.divide(b, of_b)];
                (Some(children), between)
            }
        };
        let at = self.patches.len();
        for child in children.into_iter().flatten() {
            self.patches[child].parent = at;
        }
        self.patches.push(Patch {
            parent: NO_PATCH,
            children,
            edges,
        });
        at
    }

    /// The bisection that loses the least.
    fn best(&mut self, nodes: &[u32], edges: &[u32]) -> Option<Halving> {
        if (self.stop)(0) {
            return None;
        }
        let whole = self.least_energy(nodes, edges);
        let mut best: Option<Halving> = None;
        let measure = Measure {
            balance: self.recipe.balance,
        };
        for at in 0..self.recipe.floors.len() {
            let graph = self.weighted(nodes, edges, self.recipe.floors[at]);
            for _ in 0..self.recipe.tries {
                if (self.stop)(PER_EDGE * edges.len() as u64) {
                    return None;
                }
                let side = bisect(&graph, measure, &mut self.random).ok()?;
                let Some(mut halving) = self.halve(nodes, edges, &side) else {
                    continue;
                };
                let [a, b] =
                    [0, 1].map(|k| self.least_energy(&halving.nodes[k], &halving.edges[k]));
                let cut = halving.edges[2].len() as f64;
                let loss = (whole - a - b).max(0.0) + self.recipe.price * self.mean * cut;
                let smaller = halving.nodes.iter().map(Vec::len).min().unwrap_or(0);
                halving.value = measure.of(loss, smaller as f64 / nodes.len() as f64);
                if best.as_ref().is_none_or(|b| halving.value < b.value) {
                    best = Some(halving);
                }
            }
        }
        best
    }

    fn number(&mut self, nodes: &[u32]) {
        for (k, &i) in nodes.iter().enumerate() {
            self.place[i as usize] = k as u32;
        }
    }

    fn weighted(&mut self, nodes: &[u32], edges: &[u32], floor: f64) -> Weighted {
        self.number(nodes);
        let ground = self.graph.ground();
        let inner = edges.iter().filter_map(|&e| {
            let edge = &self.graph.edges[e as usize];
            let weight = self.energy[e as usize] / self.mean + floor;
            let [i, j] = [edge.tail, edge.head].map(|i| self.place[i as usize]);
            (edge.tail != ground && edge.head != ground).then_some((i, j, weight))
        });
        Weighted::new(vec![1.0; nodes.len()], inner)
    }

    /// The halves with their edges. None if one of them is empty.
    fn halve(&mut self, nodes: &[u32], edges: &[u32], side: &[bool]) -> Option<Halving> {
        self.number(nodes);
        let mut halving = Halving {
            value: 0.0,
            nodes: [Vec::new(), Vec::new()],
            edges: [Vec::new(), Vec::new(), Vec::new()],
        };
        for (&i, &second) in nodes.iter().zip(side) {
            halving.nodes[usize::from(second)].push(i);
        }
        let ground = self.graph.ground();
        for &e in edges {
            let edge = &self.graph.edges[e as usize];
            let half =
                |i: u32| (i != ground).then(|| usize::from(side[self.place[i as usize] as usize]));
            let at = match (half(edge.tail), half(edge.head)) {
                (Some(a), Some(b)) if a != b => 2,
                (Some(a), _) | (None, Some(a)) => a,
                (None, None) => 2,
            };
            halving.edges[at].push(e);
        }
        (!halving.nodes.iter().any(Vec::is_empty)).then_some(halving)
    }

    /// About the least energy of the patch with the incumbent's integers: some steps of conjugate gradients
    /// from its residuals, preconditioned with the diagonal.
    fn least_energy(&mut self, nodes: &[u32], edges: &[u32]) -> f64 {
        self.number(nodes);
        let n = nodes.len();
        let ground = self.graph.ground();
        // The ground has the last place, and stays.
        let place = |i: u32| match i == ground {
            true => n,
            false => self.place[i as usize] as usize,
        };
        let own: Vec<(usize, usize, f64)> = edges
            .iter()
            .map(|&e| &self.graph.edges[e as usize])
            .map(|e| (place(e.tail), place(e.head), e.weight))
            .collect();
        let mut energy: f64 = edges.iter().map(|&e| self.energy[e as usize]).sum();
        let mut inverse = vec![0.0; n + 1];
        let mut force = vec![0.0; n + 1];
        for (&(i, j, w), &e) in own.iter().zip(edges) {
            let flow = w * self.residuals[e as usize];
            force[i] -= flow;
            force[j] += flow;
            inverse[i] += w;
            inverse[j] += w;
        }
        inverse.iter_mut().for_each(|d| *d = 1.0 / *d);
        (force[n], inverse[n]) = (0.0, 0.0);
        let mut direction: Vec<f64> = force.iter().zip(&inverse).map(|(f, d)| f * d).collect();
        let dot = |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(a, b)| a * b).sum::<f64>();
        let mut power = dot(&force, &direction);
        let mut image = vec![0.0; n + 1];
        for _ in 0..STEPS {
            // Whoever ends the call does not need the estimate.
            if power <= 1e-6 * energy.abs() || is_wanted().is_err() {
                break;
            }
            image.fill(0.0);
            for &(i, j, w) in &own {
                let flow = w * (direction[i] - direction[j]);
                image[i] += flow;
                image[j] -= flow;
            }
            image[n] = 0.0;
            let length = power / dot(&direction, &image);
            energy -= length * power;
            force
                .iter_mut()
                .zip(&image)
                .for_each(|(f, a)| *f -= length * a);
            let next: f64 = force.iter().zip(&inverse).map(|(f, d)| f * f * d).sum();
            let kept = next / power;
            for (p, (f, d)) in direction.iter_mut().zip(force.iter().zip(&inverse)) {
                *p = f * d + kept * *p;
            }
            power = next;
        }
        energy
    }
}
