//! The nested odd sets of the blossom algorithm: vertices, and cycles of vertices and earlier blossoms.
//!
//! Each blossom is a cycle of an odd number of children. The first child holds the base, the one vertex that
//! is not matched inside. The second child is matched with the third, the fourth with the fifth, and so on.

use super::matching::Graph;

/// No edge, no blossom.
pub(super) const NONE: u32 = u32::MAX;

/// Vertices and blossoms are numbered together, the vertices first.
#[derive(Debug)]
pub(super) struct Blossoms {
    count: usize,
    parent: Vec<u32>,
    base: Vec<u32>,
    z: Vec<i128>,
    children: Vec<Vec<u32>>,
    /// The edge from each child to the next.
    links: Vec<Vec<u32>>,
    unused: Vec<u32>,
    /// The outermost blossom of each vertex when it was last written down.
    written: Vec<u32>,
    /// Blossoms that have been joined since point to the joint one.
    joined: Vec<u32>,
}

impl Blossoms {
    pub fn new(vertices: usize) -> Self {
        let own: Vec<u32> = (0..vertices as u32).collect();
        Blossoms {
            count: vertices,
            parent: vec![NONE; vertices],
            base: own.clone(),
            z: vec![0; vertices],
            children: vec![Vec::new(); vertices],
            links: vec![Vec::new(); vertices],
            unused: Vec::new(),
            written: own.clone(),
            joined: own,
        }
    }

    pub fn capacity(&self) -> usize {
        self.parent.len()
    }

    pub fn is_blossom(&self, b: u32) -> bool {
        b as usize >= self.count
    }

    pub fn is_top(&self, b: u32) -> bool {
        self.parent[b as usize] == NONE && self.joined[b as usize] == b
    }

    /// The outermost blossom of a vertex.
    pub fn top(&mut self, v: u32) -> u32 {
        let start = self.written[v as usize];
        let mut top = start;
        while self.joined[top as usize] != top {
            top = self.joined[top as usize];
        }
        let mut b = start;
        while self.joined[b as usize] != top {
            b = std::mem::replace(&mut self.joined[b as usize], top);
        }
        top
    }

    /// The smallest blossom that contains this one.
    pub fn parent(&self, b: u32) -> u32 {
        self.parent[b as usize]
    }

    pub fn base(&self, b: u32) -> u32 {
        self.base[b as usize]
    }

    pub fn z(&self, b: u32) -> i128 {
        self.z[b as usize]
    }

    pub fn set_z(&mut self, b: u32, z: i128) {
        if self.is_blossom(b) {
            self.z[b as usize] = z;
        }
    }

    pub fn vertices(&self, b: u32) -> Vec<u32> {
        let (mut inside, mut open) = (Vec::new(), vec![b]);
        while let Some(c) = open.pop() {
            if self.is_blossom(c) {
                open.extend(&self.children[c as usize]);
            } else {
                inside.push(c);
            }
        }
        inside
    }

    /// All blossoms in use.
    pub fn all(&self) -> impl Iterator<Item = u32> + '_ {
        (self.count..self.parent.len())
            .filter(|&b| !self.children[b].is_empty())
            .map(|b| b as u32)
    }

    /// Joins outermost blossoms. The base of the first is that of all.
    pub fn join(&mut self, children: Vec<u32>, links: Vec<u32>) -> u32 {
        let new = self.unused.pop().unwrap_or_else(|| {
            self.parent.push(NONE);
            self.base.push(NONE);
            self.z.push(0);
            self.children.push(Vec::new());
            self.links.push(Vec::new());
            self.joined.push(NONE);
            self.parent.len() as u32 - 1
        });
        for &c in &children {
            self.parent[c as usize] = new;
            self.joined[c as usize] = new;
        }
        let own = new as usize;
        self.parent[own] = NONE;
        self.joined[own] = new;
        self.base[own] = self.base[children[0] as usize];
        self.z[own] = 0;
        self.children[own] = children;
        self.links[own] = links;
        new
    }

    /// Opens an outermost blossom: its children become outermost.
    pub fn open(&mut self, b: u32) -> (Vec<u32>, Vec<u32>) {
        let children = std::mem::take(&mut self.children[b as usize]);
        let links = std::mem::take(&mut self.links[b as usize]);
        for &c in &children {
            self.parent[c as usize] = NONE;
            self.joined[c as usize] = c;
            self.settle(c);
        }
        self.unused.push(b);
        (children, links)
    }

    /// Writes down that `b` is the outermost blossom of its vertices.
    pub fn settle(&mut self, b: u32) {
        for v in self.vertices(b) {
            self.written[v as usize] = b;
        }
    }

    /// The child of `b` in which vertex `v` lies.
    pub fn child_with(&self, b: u32, v: u32) -> u32 {
        let mut c = v;
        while self.parent[c as usize] != b {
            c = self.parent[c as usize];
        }
        c
    }

    /// Rotates the matched edges inside `b` such that `v` is its base.
    pub fn rebase(&mut self, graph: &Graph, mate: &mut [u32], b: u32, v: u32) {
        let mut open = vec![(b, v)];
        while let Some((b, v)) = open.pop() {
            if !self.is_blossom(b) {
                continue;
            }
            let child = self.child_with(b, v);
            open.push((child, v));
            let own = b as usize;
            let len = self.children[own].len();
            let at = self.children[own].iter().position(|&c| c == child);
            let at = at.unwrap_or(0);
            let matched: Vec<usize> = if at % 2 == 1 {
                (at + 1..len).step_by(2).collect()
            } else {
                (0..at).step_by(2).collect()
            };
            for k in matched {
                let edge = self.links[own][k];
                let sides = [self.children[own][k], self.children[own][(k + 1) % len]];
                let [i, j] = graph.ends[edge as usize];
                let (i, j) = if self.child_with(b, i) == sides[0] {
                    (i, j)
                } else {
                    (j, i)
                };
                open.push((sides[0], i));
                open.push((sides[1], j));
                mate[i as usize] = edge;
                mate[j as usize] = edge;
            }
            self.children[own].rotate_left(at);
            self.links[own].rotate_left(at);
            self.base[own] = v;
        }
    }
}
