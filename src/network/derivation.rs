//! What a proof of the optimum is made from: multipliers of the half-integral flow, and a tree where odd cycles leave
//! a gap.
//!
//! The multipliers of a half-integral flow are a bound for all integral flows, and the exact one where no edge of it
//! is odd. Else the tree branches on an odd edge. Independent components have trees of their own.

use std::cmp::{Ordering, Reverse};
use std::collections::BinaryHeap;

use super::flow::{Failure, Halves, half_integral_from};
use super::form::Form;
use super::graph::{Edge, End, Network, UNITS};
use crate::linalg::DisjointSets;
use crate::proof::{Derivation, Ending, Multiplied, Searched, Visited};

/// The most values and multipliers of all nodes together, which is what the file of the proof takes.
const MOST: usize = 5_000_000;

/// A connected component of a network.
struct Component {
    /// Its edges, and its vertices without the root, which is its last vertex.
    network: Network,
    /// The edges and vertices of the whole, and the unknowns that the edges are. None for slacks.
    edges: Vec<usize>,
    columns: Vec<Option<u32>>,
    vertices: Vec<usize>,
    /// The multipliers of the relaxation, and the least cost.
    potential: Vec<i128>,
    optimum: i128,
}

/// The trees that prove the optimum `x`, as far as `ends` lets them grow. It is told the work since it was last asked.
pub(super) fn derivation(
    form: &Form,
    halves: &Halves,
    x: &[i64],
    ends: &mut dyn FnMut(u64) -> bool,
) -> Derivation {
    let mut derivation = Derivation {
        is_begun: true,
        steps: form.rounded.clone(),
        ..Derivation::default()
    };
    for component in components(form, halves, x) {
        let of_edge = component.edges.iter().zip(&component.columns);
        let unknowns = of_edge.filter_map(|(&e, &column)| Some((column?, x[e] as f64)));
        let (unknowns, values): (Vec<u32>, Vec<f64>) = unknowns.unzip();
        let numbers = unknowns.len() + component.vertices.len();
        let nodes = Tree::grown(&component, MOST / numbers.max(1), ends).into_iter();
        let nodes = nodes.map(|node| component.visited(&form.units, &values, node));
        let nodes = nodes.collect();
        derivation.parts.push(Searched {
            unknowns,
            nodes,
            ..Searched::default()
        });
    }
    derivation
}

/// The components of a network with an optimal flow.
fn components(form: &Form, halves: &Halves, x: &[i64]) -> Vec<Component> {
    let network = &form.network;
    let root = network.root();
    let mut sets = DisjointSets::new(network.demand.len());
    let ends = |e: usize| network.edges[e].ends.map(|end| end.vertex);
    for e in 0..network.edges.len() {
        if let [a, b] = ends(e)
            && a != root
            && b != root
        {
            sets.join(a as usize, b as usize);
        }
    }
    let mut components: Vec<Component> = Vec::new();
    let mut number = vec![usize::MAX; network.demand.len()];
    let mut place = vec![0; network.demand.len()];
    for v in 0..root as usize {
        let first = sets.root(v);
        if number[first] == usize::MAX {
            number[first] = components.len();
            components.push(Component {
                network: Network {
                    edges: Vec::new(),
                    demand: Vec::new(),
                    exponent: network.exponent,
                },
                edges: Vec::new(),
                columns: Vec::new(),
                vertices: Vec::new(),
                potential: Vec::new(),
                optimum: 0,
            });
        }
        number[v] = number[first];
        let own = &mut components[number[v]];
        place[v] = own.vertices.len() as u32;
        own.vertices.push(v);
        own.network.demand.push(network.demand[v]);
        own.potential.push(halves.potential[v]);
    }
    for own in &mut components {
        own.network.demand.push(0);
        own.potential.push(0);
    }
    for (e, edge) in network.edges.iter().enumerate() {
        let inner = edge.ends.iter().find(|end| end.vertex != root);
        let Some(inner) = inner else {
            continue;
        };
        let own = &mut components[number[inner.vertex as usize]];
        let own_root = own.network.root();
        let ends = edge.ends.map(|end| End {
            vertex: match end.vertex == root {
                true => own_root,
                false => place[end.vertex as usize],
            },
            ..end
        });
        own.edges.push(e);
        own.columns.push(form.columns[e]);
        own.network.edges.push(Edge { ends, ..*edge });
        own.optimum += edge.cost(x[e]);
    }
    components
}

/// A node of a tree.
struct Grown {
    /// The multipliers of the vertices.
    multipliers: Vec<i128>,
    ending: Ended,
}

/// How a node has ended.
#[derive(Clone, Copy, PartialEq)]
enum Ended {
    Bounded,
    /// The multipliers show that there is no flow.
    Empty,
    /// The unknown is at most this in the first child, and more in the second.
    Branched(u32, i64, [usize; 2]),
}

/// A node that is still to come, the one with the lowest bound first.
struct Waiting {
    /// The bound of the node above.
    bound: i128,
    node: usize,
    /// What is different from the component: edges that are at most or at least a value.
    branches: Vec<Branch>,
    /// The multipliers of the node above.
    potential: Vec<i128>,
}

#[derive(Clone, Copy)]
enum Branch {
    AtMost(usize, i64),
    AtLeast(usize, i64),
}

impl Waiting {
    fn order(&self) -> (Reverse<i128>, Reverse<usize>) {
        (Reverse(self.bound), Reverse(self.node))
    }

    fn network(&self, of: &Component) -> Network {
        let mut network = of.network.clone();
        for branch in &self.branches {
            match *branch {
                Branch::AtMost(edge, to) => network.edges[edge].upper = Some(to),
                Branch::AtLeast(edge, to) => network.edges[edge].lower = Some(to),
            }
        }
        network
    }
}

impl PartialEq for Waiting {
    fn eq(&self, other: &Self) -> bool {
        self.order() == other.order()
    }
}

impl Eq for Waiting {}

impl PartialOrd for Waiting {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

impl Ord for Waiting {
    fn cmp(&self, other: &Self) -> Ordering {
        self.order().cmp(&other.order())
    }
}

/// The tree of a component.
struct Tree<'a> {
    of: &'a Component,
    nodes: Vec<Grown>,
    waiting: BinaryHeap<Waiting>,
}

impl<'a> Tree<'a> {
    /// The tree of a component, with at most so many nodes, or one more.
    fn grown(of: &'a Component, most: usize, ends: &mut dyn FnMut(u64) -> bool) -> Vec<Grown> {
        let mut tree = Tree {
            of,
            nodes: Vec::new(),
            waiting: BinaryHeap::new(),
        };
        tree.add(i128::MIN, Vec::new(), of.potential.clone());
        while let Some(next) = tree.waiting.pop() {
            let network = next.network(of);
            match half_integral_from(&network, &next.potential, ends) {
                Ok(halves) if network.fits(&halves.base(), &halves.potential) => {
                    tree.bounded(next, &network, halves, most);
                }
                Err(Failure::Infeasible(cut)) => {
                    tree.nodes[next.node] = Grown {
                        multipliers: cut,
                        ending: Ended::Empty,
                    }
                }
                Ok(_) | Err(Failure::Unsuited | Failure::Stopped) => break,
            }
        }
        tree.nodes
    }

    /// Adds a node.
    fn add(&mut self, bound: i128, branches: Vec<Branch>, potential: Vec<i128>) -> usize {
        let node = self.nodes.len();
        self.nodes.push(Grown {
            multipliers: potential.clone(),
            ending: Ended::Bounded,
        });
        self.waiting.push(Waiting {
            bound,
            node,
            branches,
            potential,
        });
        node
    }

    /// The node has this relaxation, and is branched on if that is below the optimum.
    fn bounded(&mut self, of_node: Waiting, network: &Network, halves: Halves, most: usize) {
        let Waiting { node, branches, .. } = of_node;
        let bound = bound(network, &halves.potential);
        let odd = self.of.columns.iter().enumerate();
        let odd =
            odd.filter_map(|(e, column)| (halves.twice[e] % 2 != 0).then_some((e, (*column)?)));
        let steepest = odd.max_by_key(|(e, _)| (network.edges[*e].curvature, Reverse(*e)));
        // Multipliers that are not multiples of a unit could not be halved for ever.
        let start = halves.potential.iter().map(|p| p / UNITS * UNITS);
        let start: Vec<i128> = start.collect();
        self.nodes[node].multipliers = halves.potential;
        if bound >= self.of.optimum || self.nodes.len() >= most {
            return;
        }
        let Some((edge, unknown)) = steepest else {
            return;
        };
        let at = halves.twice[edge].div_euclid(2);
        let [first, second] =
            [Branch::AtMost(edge, at), Branch::AtLeast(edge, at + 1)].map(|branch| {
                let branches = [&branches[..], &[branch]].concat();
                self.add(bound, branches, start.clone())
            });
        self.nodes[node].ending = Ended::Branched(unknown, at, [first, second]);
    }
}

/// The least value of the cost with these multipliers over all values between the bounds.
fn bound(network: &Network, potential: &[i128]) -> i128 {
    let demand = network.demand.iter().zip(potential);
    let held: i128 = demand.map(|(b, p)| i128::from(*b) * p).sum();
    let least = network.edges.iter().map(|edge| {
        let price = edge.price(potential);
        // A flow that is optimal for the multipliers has been found.
        let x = edge.minimiser(price).unwrap_or(0);
        edge.cost(x) - price * i128::from(x)
    });
    held + least.sum::<i128>()
}

impl Component {
    /// A node in the rows and unknowns of the problem, whose rows were divided by `units`.
    fn visited(&self, units: &[f64], values: &[f64], node: Grown) -> Visited {
        let unit = 2f64.powi(self.network.exponent) / UNITS as f64;
        let of_row = |(&v, &p): (&usize, &i128)| (v as u32, -(p as f64) * unit / units[v]);
        let multipliers = self.vertices.iter().zip(&node.multipliers).map(of_row);
        let multipliers: Vec<(u32, f64)> = multipliers.filter(|(_, by)| *by != 0.0).collect();
        let ending = match node.ending {
            Ended::Empty => {
                return Visited {
                    ending: Ending::Contradiction(multipliers),
                    ..Visited::default()
                };
            }
            Ended::Bounded => Ending::Bounded,
            Ended::Branched(unknown, at, children) => Ending::Branched {
                unknown,
                at: at as f64,
                children,
            },
        };
        let point = values.to_vec();
        Visited {
            certificate: Some(Multiplied { point, multipliers }),
            ending,
            ..Visited::default()
        }
    }
}
