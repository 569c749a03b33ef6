//! A cycle basis that is nested in the tree of patches.
//!
//! One spanning forest takes the edges of the leaves first, then those of their parents, up to the root.
//! Within each patch it spans what the patch connects. So the fundamental cycle of an edge that is left
//! over stays within the patch of that edge. The fundamental cycles of a forest are an integral basis, and
//! those of the edges in a patch and its descendants are a basis of the cycles of the patch.

use std::collections::VecDeque;
use std::ops::Range;

use super::dissect::Patch;
use crate::cycle::cycles::Cycles;
use crate::cycle::forest::Forest;
use crate::cycle::fundamental::fundamental_cycle;
use crate::cycle::graph::{Graph, NONE};
use crate::error::Result;
use crate::linalg::DisjointSets;
use crate::monitor::may_continue;

/// So many cycles are found between two questions whether there is memory for more, and whether they are still
/// wanted. The longest ones have some thousand edges.
const OFTEN: usize = 64;

/// The cycles of all patches, in the order of the patches.
#[derive(Debug, Clone)]
pub(super) struct NestedBasis {
    pub cycles: Cycles,
    /// By cycle: the edge that is in no other cycle of its patch or the patches before it.
    pub chords: Vec<u32>,
    /// By patch: its own cycles.
    pub own: Vec<Range<usize>>,
    /// By edge: the cycles through it with their signs.
    pub through: Vec<Vec<(u32, i8)>>,
}

impl NestedBasis {
    /// # Errors
    /// The end of the call.
    pub fn new(graph: &Graph, patches: &[Patch]) -> Result<Self> {
        let mut sets = DisjointSets::new(graph.nodes());
        let mut in_forest = vec![false; graph.edges.len()];
        let mut left = Vec::with_capacity(patches.len());
        for patch in patches {
            let order = match patch.children {
                None => breadth_first(graph, &patch.edges),
                Some(_) => patch.edges.clone(),
            };
            let mut chords = Vec::new();
            for e in order {
                let edge = &graph.edges[e as usize];
                if sets.join(edge.tail as usize, edge.head as usize) {
                    in_forest[e as usize] = true;
                } else {
                    chords.push(e);
                }
            }
            left.push(chords);
        }
        let forest = rooted(graph, &in_forest);
        let mut basis = NestedBasis {
            cycles: Cycles::new(),
            chords: Vec::new(),
            own: Vec::with_capacity(patches.len()),
            through: vec![Vec::new(); graph.edges.len()],
        };
        for chords in left {
            let first = basis.chords.len();
            for e in chords {
                if basis.chords.len().is_multiple_of(OFTEN) {
                    may_continue()?;
                }
                let cycle = fundamental_cycle(graph, &forest, e, usize::MAX);
                let cycle = cycle.unwrap_or_else(|| unreachable!("no cycle is too long"));
                basis.cycles.make_room(cycle.len())?;
                for &(f, sign) in &cycle {
                    basis.through[f as usize].push((basis.chords.len() as u32, sign));
                }
                basis.cycles.push(cycle.into_iter());
                basis.chords.push(e);
            }
            basis.own.push(first..basis.chords.len());
        }
        Ok(basis)
    }

    /// The number of cycles.
    pub fn len(&self) -> usize {
        self.chords.len()
    }
}

/// The edges of a leaf, first those of a breadth-first forest that starts at the ground, so that the cycles
/// are short.
fn breadth_first(graph: &Graph, edges: &[u32]) -> Vec<u32> {
    let mut nodes: Vec<u32> = edges
        .iter()
        .flat_map(|&e| [graph.edges[e as usize].tail, graph.edges[e as usize].head])
        .collect();
    nodes.sort_unstable_by(|a, b| b.cmp(a));
    nodes.dedup();
    let place = |i: u32| nodes.partition_point(|&j| j > i);
    let mut at: Vec<Vec<u32>> = vec![Vec::new(); nodes.len()];
    for &e in edges {
        at[place(graph.edges[e as usize].tail)].push(e);
        at[place(graph.edges[e as usize].head)].push(e);
    }
    let mut order = Vec::with_capacity(edges.len());
    let mut seen = vec![false; nodes.len()];
    let mut queue = VecDeque::new();
    for start in 0..nodes.len() {
        if std::mem::replace(&mut seen[start], true) {
            continue;
        }
        queue.push_back(start);
        while let Some(i) = queue.pop_front() {
            for &e in &at[i] {
                let j = place(graph.edges[e as usize].other(nodes[i]));
                if !std::mem::replace(&mut seen[j], true) {
                    order.push(e);
                    queue.push_back(j);
                }
            }
        }
    }
    order.extend_from_slice(edges);
    // An edge of the forest comes twice. The second time it would close a cycle of two equal edges.
    let mut taken = std::collections::HashSet::new();
    order.retain(|&e| taken.insert(e));
    order
}

/// The forest of the marked edges, its first tree rooted at the ground.
fn rooted(graph: &Graph, in_forest: &[bool]) -> Forest {
    let n = graph.nodes();
    let mut forest = Forest {
        order: Vec::with_capacity(n),
        parent: vec![NONE; n],
        depth: vec![NONE; n],
        trees: 0,
    };
    for root in (0..n as u32).rev() {
        if forest.depth[root as usize] != NONE {
            continue;
        }
        forest.trees += 1;
        forest.depth[root as usize] = 0;
        let mut next = forest.order.len();
        forest.order.push(root);
        while let Some(&node) = forest.order.get(next) {
            next += 1;
            for &e in graph.incident(node) {
                let to = graph.edges[e as usize].other(node);
                if in_forest[e as usize] && forest.depth[to as usize] == NONE {
                    forest.depth[to as usize] = forest.depth[node as usize] + 1;
                    forest.parent[to as usize] = e;
                    forest.order.push(to);
                }
            }
        }
    }
    forest
}
