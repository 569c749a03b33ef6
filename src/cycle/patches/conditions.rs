//! Conditions of optimality, and what charges that violate them cost.
//!
//! Let r be the residuals of an optimum. A change of the integers by a vector f on the edges, up or down,
//! does not lower the energy, so
//!
//! ```text
//! |f'W r| <= step rho_f / 2,    rho_f = f'M'K^-1 M f.
//! ```
//!
//! Here f is an edge, or a signed pair of near edges. On a patch, r is the sum of the residuals r_P of
//! its charges and of a harmonic part g: a gradient without divergence at the inner nodes of the patch.
//! The optimum has the energy `|r_P|^2 + |g|^2` there, in the norm of the weights. If r_P violates the
//! condition of f by x, then `|f'W g| >= x`, so `|g|^2 >= x^2 / H_f`, where `H_f` is the squared norm of
//! f on the harmonic parts: `f'W f` less the squares of its projections on the cycles of the patch and on
//! its inner nodes. So charges are worth at least `|r_P|^2 + x^2 / H_f`, for any f.
//!
//! Flows `W r_P` are kept in single precision. All thresholds are raised by bounds on the errors.

use super::account::Account;
use super::local::inverse;
use super::tree::{PatchTree, System};
use crate::cycle::graph::Graph;

/// Patches of more cycles have no conditions.
const WIDEST: usize = 220;

/// Patches of more inner nodes have no conditions.
const INNER: usize = 700;

/// A pair counts if its rho is below this part of the sum.
const CORRELATED: f64 = 0.93;

/// Systems with more entries in the vectors of all edges have no conditions.
const ENTRIES: usize = 40_000_000;

/// A condition as its threshold and the inverse of `H_f`.
#[derive(Debug, Clone, Copy)]
struct Condition {
    most: f32,
    inverse: f32,
}

/// The conditions on the edges of one patch.
#[derive(Debug, Clone, Default)]
pub(super) struct Conditions {
    /// The edges of the first child, of the second, and the own ones.
    edges: Vec<u32>,
    /// By own cycle: the flow of each edge for a unit of w.
    gain: Vec<f32>,
    single: Prices,
    /// Two places among the edges, and the sign.
    pairs: Vec<(u32, u32, f32)>,
    of_pairs: Prices,
}

/// Flows that are priced at a time.
const LANES: usize = 8;

/// Sums of pairs that are formed at a time.
const SUMS: usize = 8 * LANES;

/// Conditions by member, so that several are evaluated at once.
#[derive(Debug, Clone, Default)]
struct Prices {
    most: Vec<f32>,
    inverse: Vec<f32>,
}

impl Prices {
    fn push(&mut self, condition: Condition) {
        self.most.push(condition.most);
        self.inverse.push(condition.inverse);
    }

    /// Raises each lane to the greatest price of its flows, which belong to the conditions from `first` on.
    fn raise(&self, lanes: &mut [f32; LANES], flows: &[f32], first: usize) {
        // Unlike `f32::max`, this is one instruction for several lanes.
        let larger = |a: f32, b: f32| if a > b { a } else { b };
        let price = |flow: f32, most: f32, inverse: f32| {
            let excess = larger(flow.abs() - most, 0.0);
            excess * excess * inverse
        };
        let of = first..first + flows.len();
        let (most, inverse) = (&self.most[of.clone()], &self.inverse[of]);
        let blocks = flows.chunks_exact(LANES);
        let rest = flows.len() - blocks.remainder().len();
        let conditions = most.chunks_exact(LANES).zip(inverse.chunks_exact(LANES));
        for (flows, (most, inverse)) in blocks.zip(conditions) {
            for k in 0..LANES {
                lanes[k] = larger(price(flows[k], most[k], inverse[k]), lanes[k]);
            }
        }
        for k in rest..flows.len() {
            lanes[0] = larger(price(flows[k], most[k], inverse[k]), lanes[0]);
        }
    }
}

impl Conditions {
    /// The number of edges.
    pub fn len(&self) -> usize {
        self.edges.len()
    }

    /// Adds the flows of the patch's own values `w` to those of its children.
    pub fn add_flows(&self, w: &[f64], flows: &mut [f32]) {
        let n = flows.len();
        for (k, &w) in w.iter().enumerate() {
            let w = w as f32;
            for (flow, gain) in flows.iter_mut().zip(&self.gain[k * n..(k + 1) * n]) {
                *flow += w * gain;
            }
        }
    }

    /// What the harmonic part must be worth at least.
    pub fn price(&self, flows: &[f32]) -> f64 {
        let mut lanes = [0.0; LANES];
        self.single.raise(&mut lanes, flows, 0);
        let mut sums = [0.0; SUMS];
        for (block, pairs) in self.pairs.chunks(SUMS).enumerate() {
            for (sum, &(i, j, sign)) in sums.iter_mut().zip(pairs) {
                *sum = flows[i as usize] + sign * flows[j as usize];
            }
            let sums = &sums[..pairs.len()];
            self.of_pairs.raise(&mut lanes, sums, block * SUMS);
        }
        let most = lanes.into_iter().fold(0.0, f32::max);
        // A few roundings to single precision.
        f64::from(most) * (1.0 - 1e-6)
    }
}

/// Two near edges, a sign, and rho.
struct Pair {
    edges: [u32; 2],
    sign: f64,
    rho: f64,
}

/// The vectors `G^-1 M f` of all edges f, along the path of patches from the edge's own to the root.
struct Vectors<'a> {
    tree: &'a PatchTree,
    /// By edge: its patch.
    home: Vec<usize>,
    values: Vec<Vec<f64>>,
}

impl Vectors<'_> {
    /// The part of the vector of `e` in patch `at`, which is its own patch or an ancestor.
    fn part(&self, e: u32, at: usize) -> &[f64] {
        let values = &self.values[e as usize];
        let to = values.len() - self.tree.above_rows(at);
        &values[to - self.tree.locals[at].own..to]
    }

    /// The scalar product of two vectors, from the first common ancestor on.
    fn product(&self, e: u32, f: u32) -> f64 {
        let (mut a, mut b) = (self.home[e as usize], self.home[f as usize]);
        while a != b {
            if a < b {
                a = self.tree.patches[a].parent;
            } else {
                b = self.tree.patches[b].parent;
            }
        }
        let common = self.tree.above_rows(a) + self.tree.locals[a].own;
        let tail = |e: u32| {
            let values = self.values[e as usize].iter();
            values.rev().take(common)
        };
        tail(e).zip(tail(f)).map(|(a, b)| a * b).sum()
    }
}

/// The conditions of all patches that have some. `stop` gets the multiplications; if it says so, there are
/// none.
pub(super) fn conditions(
    system: System,
    tree: &PatchTree,
    account: &Account,
    cap: f64,
    stop: &mut dyn FnMut(u64) -> bool,
) -> Vec<Option<Conditions>> {
    let mut all: Vec<Option<Conditions>> = vec![None; tree.patches.len()];
    let Some(vectors) = vectors(tree, system.graph, stop) else {
        return all;
    };
    let graph = system.graph;
    let rho: Vec<f64> = vectors
        .values
        .iter()
        .map(|v| v.iter().map(|v| v * v).sum())
        .collect();
    let pairs = pairs(graph, &vectors, &rho);
    let mut make = Make {
        system,
        tree,
        account,
        cap,
        vectors: &vectors,
        rho: &rho,
        pairs: &pairs,
        place: vec![u32::MAX; graph.edges.len()],
    };
    for at in 0..tree.patches.len() {
        let children = tree.patches[at].children.iter().flatten();
        if tree.cycles[at] > WIDEST || children.clone().any(|&c| all[c].is_none()) {
            continue;
        }
        let mut edges: Vec<u32> = Vec::new();
        for &c in children {
            edges.extend(all[c].iter().flat_map(|conditions| &conditions.edges));
        }
        edges.extend(&tree.patches[at].edges);
        if stop((edges.len() as u64).pow(3) / 8) {
            return vec![None; tree.patches.len()];
        }
        all[at] = make.conditions(at, edges);
    }
    all
}

fn vectors<'a>(
    tree: &'a PatchTree,
    graph: &Graph,
    stop: &mut dyn FnMut(u64) -> bool,
) -> Option<Vectors<'a>> {
    let mut home = vec![0; graph.edges.len()];
    let mut entries = 0;
    for (at, patch) in tree.patches.iter().enumerate() {
        patch.edges.iter().for_each(|&e| home[e as usize] = at);
        entries += patch.edges.len() * (tree.above_rows(at) + tree.locals[at].own);
    }
    if entries > ENTRIES {
        return None;
    }
    let mut values = Vec::with_capacity(graph.edges.len());
    for (e, &start) in home.iter().enumerate() {
        let mut vector = Vec::new();
        let mut carried: Vec<f64> = Vec::new();
        let mut below: Option<usize> = None;
        let mut at = start;
        let mut work = 0;
        loop {
            let front = &tree.fronts[at];
            let own = tree.basis.own[at].clone();
            let n = front.own;
            let mut all = vec![0.0; n + front.above.len()];
            if let Some(child) = below {
                let place = usize::from(tree.patches[at].children.is_some_and(|c| c[1] == child));
                for (&p, v) in front.places[place].iter().zip(&carried) {
                    all[p as usize] += v;
                }
            }
            for &(row, sign) in &tree.basis.through[e] {
                if own.contains(&(row as usize)) {
                    all[row as usize - own.start] += f64::from(sign);
                }
            }
            for i in 0..n {
                let row = &front.diagonal[i * n..=i * n + i];
                let before: f64 = row[..i].iter().zip(&all).map(|(g, v)| g * v).sum();
                all[i] = (all[i] - before) / row[i];
            }
            let (w, above) = all.split_at_mut(n);
            for (i, above) in above.iter_mut().enumerate() {
                let row = &front.below[i * n..(i + 1) * n];
                *above -= row.iter().zip(&*w).map(|(g, v)| g * v).sum::<f64>();
            }
            work += (n * (n + above.len())) as u64;
            vector.extend_from_slice(w);
            carried = above.to_vec();
            if at == tree.root() {
                break;
            }
            below = Some(at);
            at = tree.patches[at].parent;
        }
        if stop(work) {
            return None;
        }
        values.push(vector);
    }
    Some(Vectors { tree, home, values })
}

/// The pairs of edges that share no angle but are joined by an edge, where they are correlated.
fn pairs(graph: &Graph, vectors: &Vectors, rho: &[f64]) -> Vec<Pair> {
    let mut pairs = Vec::new();
    let ground = graph.ground();
    let mut near: Vec<u32> = Vec::new();
    for e in 0..graph.edges.len() as u32 {
        let edge = &graph.edges[e as usize];
        near.clear();
        let ends = [edge.tail, edge.head];
        for end in ends.into_iter().filter(|&i| i != ground) {
            for &joint in graph.incident(end) {
                let far = graph.edges[joint as usize].other(end);
                if joint != e && far != ground {
                    near.extend(graph.incident(far).iter().filter(|&&f| f > e));
                }
            }
        }
        near.sort_unstable();
        near.dedup();
        near.retain(|&f| {
            let other = &graph.edges[f as usize];
            let shared = |i: u32| i != ground && (i == edge.tail || i == edge.head);
            !shared(other.tail) && !shared(other.head)
        });
        for &f in &near {
            let (sum, product) = (rho[e as usize] + rho[f as usize], vectors.product(e, f));
            for sign in [1.0, -1.0] {
                let rho = sum + 2.0 * sign * product;
                if rho < CORRELATED * sum {
                    pairs.push(Pair {
                        edges: [e, f],
                        sign,
                        rho,
                    });
                }
            }
        }
    }
    pairs
}

struct Make<'a> {
    system: System<'a>,
    tree: &'a PatchTree,
    account: &'a Account,
    cap: f64,
    vectors: &'a Vectors<'a>,
    rho: &'a [f64],
    pairs: &'a [Pair],
    place: Vec<u32>,
}

impl Make<'_> {
    fn conditions(&mut self, at: usize, edges: Vec<u32>) -> Option<Conditions> {
        for (k, &e) in edges.iter().enumerate() {
            self.place[e as usize] = k as u32;
        }
        let made = self.within(at, &edges);
        for &e in &edges {
            self.place[e as usize] = u32::MAX;
        }
        Some(Conditions { edges, ..made? })
    }

    /// The conditions on these edges, which are still to be named.
    fn within(&self, at: usize, edges: &[u32]) -> Option<Conditions> {
        let graph = self.system.graph;
        let inner = Inner::new(graph, edges, &self.place)?;
        let n = self.tree.locals[at].own;
        let mut made = Conditions {
            gain: vec![0.0; n * edges.len()],
            ..Conditions::default()
        };
        for (k, &e) in edges.iter().enumerate() {
            for (i, v) in self.vectors.part(e, at).iter().enumerate() {
                made.gain[i * edges.len() + k] = *v as f32;
            }
        }
        // The squares of the projections on the cycles of the patch: all but what lies above it.
        let above = self.tree.above_rows(at);
        let on_cycles = |e: u32, f: u32| {
            let tail = |e: u32| self.vectors.values[e as usize].iter().rev().take(above);
            let beyond: f64 = tail(e).zip(tail(f)).map(|(a, b)| a * b).sum();
            self.vectors.product(e, f) - beyond
        };
        let weight = |e: u32| graph.edges[e as usize].weight;
        let mut squares = Vec::with_capacity(edges.len());
        for &e in edges {
            let square = weight(e) - on_cycles(e, e) - inner.product(graph, e, e);
            squares.push(square);
            let condition = self.condition(self.rho[e as usize], square, weight(e), &inner);
            made.single.push(condition);
        }
        for pair in self.pairs {
            let [e, f] = pair.edges;
            let (i, j) = (self.place[e as usize], self.place[f as usize]);
            if i != u32::MAX && j != u32::MAX {
                let mixed = -on_cycles(e, f) - inner.product(graph, e, f);
                let square = squares[i as usize] + squares[j as usize] + 2.0 * pair.sign * mixed;
                let condition = self.condition(pair.rho, square, weight(e) + weight(f), &inner);
                made.pairs.push((i, j, pair.sign as f32));
                made.of_pairs.push(condition);
            }
        }
        Some(made)
    }

    /// The condition for given rho and `H_f`, of edges with this sum of weights.
    fn condition(&self, rho: f64, square: f64, weight: f64, inner: &Inner) -> Condition {
        let rho = rho + 4.0 * self.account.relative() * weight;
        let square = square.max(0.0) + (8.0 * self.account.relative() + inner.relative) * weight;
        // The flow is at most `sqrt(weight cap)`. It is rounded to single precision once in each patch.
        let size = (2.0 * weight * self.cap).sqrt();
        let single = 64.0 * f64::from(f32::EPSILON);
        let slack = size * (4.0 * self.account.relative() + single)
            + 2.0 * self.account.shift() * weight.sqrt();
        let most = 0.5 * self.system.step * rho + slack;
        Condition {
            most: (most * (1.0 + 1e-6)) as f32,
            inverse: ((1.0 - 1e-6) / square.max(1e-12 * weight)) as f32,
        }
    }
}

/// The inner nodes of a patch, with all their edges in the patch, and the factor of their Laplacian.
struct Inner {
    /// By node: its place among the inner nodes.
    node: Vec<u32>,
    count: usize,
    /// The inverse of the factor, by columns.
    inverse: Vec<f64>,
    /// A bound on the relative error of squares.
    relative: f64,
}

impl Inner {
    fn new(graph: &Graph, edges: &[u32], place: &[u32]) -> Option<Self> {
        let mut node = vec![u32::MAX; graph.nodes()];
        let mut inner: Vec<u32> = Vec::new();
        for &e in edges {
            let edge = &graph.edges[e as usize];
            inner.extend(
                [edge.tail, edge.head]
                    .iter()
                    .filter(|&&i| i != graph.ground()),
            );
        }
        inner.sort_unstable();
        inner.dedup();
        inner.retain(|&i| {
            graph
                .incident(i)
                .iter()
                .all(|&e| place[e as usize] != u32::MAX)
        });
        // A component that meets neither the ground nor an outer node has no harmonic part, and a singular
        // Laplacian. Its last pivot vanishes.
        let n = inner.len();
        if n > INNER {
            return None;
        }
        for (k, &i) in inner.iter().enumerate() {
            node[i as usize] = k as u32;
        }
        let mut lower = vec![0.0; n * n];
        let mut trace = 0.0;
        for &e in edges {
            let edge = &graph.edges[e as usize];
            let (i, j) = (node[edge.tail as usize], node[edge.head as usize]);
            for k in [i, j].into_iter().filter(|&k| k != u32::MAX) {
                lower[k as usize * n + k as usize] += edge.weight;
                trace += edge.weight;
            }
            if i != u32::MAX && j != u32::MAX {
                lower[i.max(j) as usize * n + i.min(j) as usize] -= edge.weight;
            }
        }
        super::factor::eliminate(&mut lower, n, n)?;
        let by_rows = inverse(&lower, n).ok()?;
        let square: f64 = by_rows.iter().map(|v| v * v).sum();
        let mut columns = vec![0.0; n * n];
        for i in 0..n {
            for j in 0..=i {
                columns[j * n + i] = by_rows[i * n + j];
            }
        }
        let relative = 4.0 * (n as f64 + 8.0) * f64::EPSILON * trace * square;
        (relative < 1e-3).then_some(Inner {
            node,
            count: n,
            inverse: columns,
            relative,
        })
    }

    /// The scalar product of the projections of two edges on the gradients of inner nodes.
    fn product(&self, graph: &Graph, e: u32, f: u32) -> f64 {
        let n = self.count;
        let column = |i: u32| match self.node[i as usize] {
            u32::MAX => None,
            k => Some(&self.inverse[k as usize * n..(k as usize + 1) * n]),
        };
        let dot = |i: u32, j: u32| match (column(i), column(j)) {
            (Some(a), Some(b)) => {
                let from = self.node[i as usize].max(self.node[j as usize]) as usize;
                a[from..].iter().zip(&b[from..]).map(|(a, b)| a * b).sum()
            }
            _ => 0.0,
        };
        let (a, b) = (&graph.edges[e as usize], &graph.edges[f as usize]);
        let sum: f64 =
            dot(a.tail, b.tail) - dot(a.tail, b.head) - dot(a.head, b.tail) + dot(a.head, b.head);
        a.weight * b.weight * sum
    }
}
