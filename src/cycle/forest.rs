//! Spanning forests by breadth-first search.

use std::collections::VecDeque;

use super::graph::{Edge, Graph, NONE};

/// One tree for each component. The first tree is rooted at the ground.
#[derive(Debug, Clone)]
pub(super) struct Forest {
    /// Nodes, every parent before its children.
    pub order: Vec<u32>,
    /// The edge to the parent, or [`NONE`] at a root.
    pub parent: Vec<u32>,
    pub depth: Vec<u32>,
    pub trees: usize,
}

impl Forest {
    /// A forest of shortest paths to the roots.
    pub fn shortest(graph: &Graph) -> Self {
        Self::grow(graph, |_| false)
    }

    /// A forest that contains every edge without an integer, provided that these edges close no cycle.
    pub fn through_fixed(graph: &Graph) -> Self {
        Self::grow(graph, |e| e.integer == NONE)
    }

    /// Whether edge `e` is in the forest.
    pub fn holds(&self, graph: &Graph, e: u32) -> bool {
        let edge = &graph.edges[e as usize];
        self.parent[edge.tail as usize] == e || self.parent[edge.head as usize] == e
    }

    /// Takes `urgent` edges before all others.
    fn grow(graph: &Graph, urgent: impl Fn(&Edge) -> bool) -> Self {
        let n = graph.nodes();
        let mut forest = Forest {
            order: Vec::with_capacity(n),
            parent: vec![NONE; n],
            depth: vec![NONE; n],
            trees: 0,
        };
        let mut queue = VecDeque::new();
        for root in (0..n as u32).rev() {
            if forest.depth[root as usize] != NONE {
                continue;
            }
            forest.trees += 1;
            queue.push_back((root, NONE));
            while let Some((node, edge)) = queue.pop_front() {
                if forest.depth[node as usize] != NONE {
                    continue;
                }
                forest.parent[node as usize] = edge;
                forest.depth[node as usize] = match edge {
                    NONE => 0,
                    e => forest.depth[graph.edges[e as usize].other(node) as usize] + 1,
                };
                forest.order.push(node);
                for &e in graph.incident(node) {
                    let edge = &graph.edges[e as usize];
                    let next = edge.other(node);
                    match forest.depth[next as usize] {
                        NONE if urgent(edge) => queue.push_front((next, e)),
                        NONE => queue.push_back((next, e)),
                        _ => {}
                    }
                }
            }
        }
        forest
    }
}
