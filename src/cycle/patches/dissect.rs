//! The tree of patches: recursive bisection of the unknown angles.
//!
//! A patch is a set of nodes with all edges between them and to the ground. Its halves share no edge. The
//! edges between the halves belong to the patch itself. What the tree loses is the energy of these edges.
//! So several bisections are tried, with edges weighted by the incumbent's residuals, and the one is kept
//! that loses the least energy of the incumbent.

use std::sync::atomic::{AtomicU64, Ordering::Relaxed};

use super::bisect::{Measure, bisect};
use super::coarsen::Weighted;
use crate::cycle::graph::Graph;
use crate::linalg::Random;
use crate::monitor::{both, collect_in_turn, is_wanted, may_continue, with_threads};

/// No parent.
pub(super) const NO_PATCH: usize = usize::MAX;

/// Patches of fewer nodes are not divided.
const LEAST_NODES: usize = 4;

/// Conjugate-gradient steps that estimate the energy of a half.
const STEPS: usize = 25;

/// The time of a bisection and of its estimate, in multiplications for each edge.
const PER_EDGE: u64 = 200;

/// Both halves of a patch are divided at the same time if it has so many edges: a bisection takes a millisecond then.
const WORTH_A_THREAD: usize = 4_000;

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

/// The patches of a tree, every child before its parent. `residuals` are those of the incumbent, by edge. None if that
/// takes `most` multiplications or the call ends. Besides, the multiplications.
pub(super) fn dissect(
    graph: &Graph,
    residuals: &[f64],
    recipe: &Recipe,
    most: u64,
) -> (Option<Vec<Patch>>, u64) {
    let energies = graph.edges.iter().zip(residuals);
    let energy: Vec<f64> = energies.map(|(e, r)| e.weight * r * r).collect();
    let mean = energy.iter().sum::<f64>() / energy.len().max(1) as f64;
    let dissection = Dissection {
        graph,
        residuals,
        mean: if mean > 0.0 { mean } else { 1.0 },
        energy,
        recipe,
        most,
        work: AtomicU64::new(0),
    };
    let ground = graph.ground();
    let place = |i: u32| if i == ground { GROUND } else { i };
    let edges = graph.edges.iter().zip(0..);
    let whole = Part {
        nodes: ground as usize,
        edges: edges
            .map(|(e, number)| ([e.tail, e.head].map(place), number))
            .collect(),
    };
    let patches = dissection.divide(whole, recipe.seed).ok();
    let work = dissection.work.into_inner().min(most);
    (patches.filter(|_| work < most), work)
}

/// The dissection has taken all that it may, or nobody wants it any more.
struct Ended;

/// The place of the ground, which is no node of a part.
const GROUND: u32 = u32::MAX;

/// A part of the graph.
struct Part {
    /// How many nodes it has besides the ground.
    nodes: usize,
    /// The places of the ends of each edge among the nodes, and its number.
    edges: Vec<([u32; 2], u32)>,
}

struct Dissection<'a> {
    graph: &'a Graph,
    residuals: &'a [f64],
    energy: Vec<f64>,
    mean: f64,
    recipe: &'a Recipe,
    /// The multiplications that there may be, and those so far.
    most: u64,
    work: AtomicU64,
}

/// A bisection and what it loses.
struct Halving {
    value: f64,
    halves: [Part; 2],
    /// The edges between the halves.
    between: Vec<u32>,
}

impl Dissection<'_> {
    /// The patches of a part, the last of which is the part itself.
    fn divide(&self, part: Part, seed: u64) -> Result<Vec<Patch>, Ended> {
        let cycles = part.edges.len().saturating_sub(part.nodes);
        let divides = cycles > self.recipe.leaf && part.nodes >= LEAST_NODES;
        let mut random = Random::new(seed);
        let best = match divides {
            true => self.best(&part, &mut random)?,
            false => None,
        };
        let Some(Halving {
            halves: [a, b],
            between,
            ..
        }) = best
        else {
            let edges = part.edges.iter().map(|&(_, number)| number).collect();
            return Ok(vec![Patch {
                parent: NO_PATCH,
                children: None,
                edges,
            }]);
        };
        let is_worth_a_thread = part.edges.len() >= WORTH_A_THREAD;
        drop(part);
        let [seed_a, seed_b] = [random.next(), random.next()];
        let (a, b) = both(
            is_worth_a_thread,
            || self.divide(a, seed_a),
            || self.divide(b, seed_b),
        );
        Ok(joined(a?, b?, between))
    }

    /// The bisection that loses the least, if there is one.
    fn best(&self, part: &Part, random: &mut Random) -> Result<Option<Halving>, Ended> {
        let tries = self.recipe.floors.len() * self.recipe.tries;
        let work = PER_EDGE * (tries * part.edges.len()) as u64;
        let before = self.work.fetch_add(work, Relaxed);
        if before.saturating_add(work) >= self.most || may_continue().is_err() {
            return Err(Ended);
        }
        let seeds: Vec<u64> = (0..tries).map(|_| random.next()).collect();
        let measure = Measure {
            balance: self.recipe.balance,
        };
        // Each bisection with the energy of its halves, and then the energy of the part.
        let task = |k: usize| -> Result<(Option<Halving>, f64), Ended> {
            let Some(&seed) = seeds.get(k) else {
                return Ok((None, self.least_energy(part)));
            };
            let graph = self.weighted(part, self.recipe.floors[k / self.recipe.tries]);
            let side = bisect(&graph, measure, &mut Random::new(seed)).map_err(|_| Ended)?;
            let halving = halved(part, &side);
            let halves = halving.iter().flat_map(|halving| &halving.halves);
            let energy = halves.map(|half| self.least_energy(half)).sum();
            Ok((halving, energy))
        };
        let threads = match part.edges.len() >= WORTH_A_THREAD {
            true => 0,
            false => 1,
        };
        let mut done = with_threads(threads, || collect_in_turn(tries + 1, task));
        let (_, whole) = done.pop().ok_or(Ended)??;
        let mut best: Option<Halving> = None;
        for halving in done {
            let (Some(mut halving), energy) = halving? else {
                continue;
            };
            let cut = halving.between.len() as f64;
            let loss = (whole - energy).max(0.0) + self.recipe.price * self.mean * cut;
            let smaller = halving.halves.iter().map(|half| half.nodes).min();
            let share = smaller.unwrap_or(0) as f64 / part.nodes as f64;
            halving.value = measure.of(loss, share);
            if best.as_ref().is_none_or(|b| halving.value < b.value) {
                best = Some(halving);
            }
        }
        Ok(best)
    }

    fn weighted(&self, part: &Part, floor: f64) -> Weighted {
        let inner = part.edges.iter().filter_map(|&([i, j], number)| {
            let weight = self.energy[number as usize] / self.mean + floor;
            (i != GROUND && j != GROUND).then_some((i, j, weight))
        });
        Weighted::new(vec![1.0; part.nodes], inner)
    }

    /// About the least energy of the part with the incumbent's integers: some steps of conjugate gradients
    /// from its residuals, preconditioned with the diagonal.
    fn least_energy(&self, part: &Part) -> f64 {
        let n = part.nodes;
        // The ground has the last place, and stays.
        let place = |i: u32| if i == GROUND { n } else { i as usize };
        let own: Vec<(usize, usize, f64)> = part
            .edges
            .iter()
            .map(|&([i, j], number)| {
                let weight = self.graph.edges[number as usize].weight;
                (place(i), place(j), weight)
            })
            .collect();
        let numbers = || part.edges.iter().map(|&(_, number)| number as usize);
        let mut energy: f64 = numbers().map(|e| self.energy[e]).sum();
        let mut inverse = vec![0.0; n + 1];
        let mut force = vec![0.0; n + 1];
        for (&(i, j, w), e) in own.iter().zip(numbers()) {
            let flow = w * self.residuals[e];
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

/// The halves of a part and the edges between them. None if one of the halves is empty.
fn halved(part: &Part, side: &[bool]) -> Option<Halving> {
    let mut nodes = [0u32; 2];
    let place: Vec<u32> = side
        .iter()
        .map(|&second| {
            let count = &mut nodes[usize::from(second)];
            *count += 1;
            *count - 1
        })
        .collect();
    if nodes.contains(&0) {
        return None;
    }
    let mut edges = [Vec::new(), Vec::new()];
    let mut between = Vec::new();
    for &(ends, number) in &part.edges {
        let half = |i: u32| (i != GROUND).then(|| usize::from(side[i as usize]));
        let at = match ends.map(half) {
            [Some(a), Some(b)] if a == b => Some(a),
            [Some(a), None] | [None, Some(a)] => Some(a),
            _ => None,
        };
        match at {
            None => between.push(number),
            Some(at) => {
                let place = |i: u32| {
                    if i == GROUND {
                        GROUND
                    } else {
                        place[i as usize]
                    }
                };
                edges[at].push((ends.map(place), number));
            }
        }
    }
    let mut counts = nodes.into_iter();
    let halves = edges.map(|edges| Part {
        nodes: counts.next().unwrap_or(0) as usize,
        edges,
    });
    Some(Halving {
        value: 0.0,
        halves,
        between,
    })
}

/// The patches of both halves, and the one that has these.
fn joined(mut patches: Vec<Patch>, second: Vec<Patch>, between: Vec<u32>) -> Vec<Patch> {
    let first = patches.len();
    patches.extend(second.into_iter().map(|mut patch| {
        if patch.parent != NO_PATCH {
            patch.parent += first;
        }
        patch.children = patch.children.map(|both| both.map(|child| child + first));
        patch
    }));
    let at = patches.len();
    let children = [first - 1, at - 1];
    for child in children {
        patches[child].parent = at;
    }
    patches.push(Patch {
        parent: NO_PATCH,
        children: Some(children),
        edges: between,
    });
    patches
}
