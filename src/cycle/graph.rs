//! The graph of an angle-difference system.
//!
//! The nodes are the unknown angles and the *ground*, one node for all known angles. An edge is a squared
//! difference,
//!
//! ```text
//! weight * (x_tail - x_head + step * p + offset)^2,        x_ground = 0,
//! ```
//!
//! where p is an integer of this edge alone. Some edges have no integer.

/// The index for no integer or no edge.
pub(super) const NONE: u32 = u32::MAX;

/// One squared difference.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Edge {
    pub tail: u32,
    pub head: u32,
    pub weight: f64,
    /// Place of the integer among the model's integers, or [`NONE`].
    pub integer: u32,
}

impl Edge {
    /// The other end than `node`.
    pub fn other(&self, node: u32) -> u32 {
        self.tail ^ self.head ^ node
    }

    /// 1 if the edge leaves `node`, -1 if it arrives there.
    pub fn sign_from(&self, node: u32) -> i8 {
        if self.tail == node { 1 } else { -1 }
    }
}

/// Nodes and edges; the last node is the ground.
#[derive(Debug, Clone)]
pub(super) struct Graph {
    pub edges: Vec<Edge>,
    offsets: Vec<u32>,
    incident: Vec<u32>,
}

impl Graph {
    /// The graph of `edges` over `nodes` nodes, the ground included. No edge is a loop.
    pub fn new(nodes: usize, edges: Vec<Edge>) -> Self {
        let mut offsets = vec![0u32; nodes + 1];
        for e in &edges {
            offsets[e.tail as usize + 1] += 1;
            offsets[e.head as usize + 1] += 1;
        }
        for i in 0..nodes {
            offsets[i + 1] += offsets[i];
        }
        let mut next = offsets.clone();
        let mut incident = vec![0; 2 * edges.len()];
        for (k, e) in edges.iter().enumerate() {
            for node in [e.tail, e.head] {
                incident[next[node as usize] as usize] = k as u32;
                next[node as usize] += 1;
            }
        }
        Graph {
            edges,
            offsets,
            incident,
        }
    }

    /// Number of nodes, the ground included.
    pub fn nodes(&self) -> usize {
        self.offsets.len() - 1
    }

    /// The node into which everything known is merged.
    pub fn ground(&self) -> u32 {
        self.nodes() as u32 - 1
    }

    /// The edges at a node.
    pub fn incident(&self, node: u32) -> &[u32] {
        let node = node as usize;
        &self.incident[self.offsets[node] as usize..self.offsets[node + 1] as usize]
    }
}
