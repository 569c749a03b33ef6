//! Weighted graphs for bisection, and their coarsening by heavy-edge matching (`karypis1998`, section 3.1).

use crate::linalg::Random;

/// A graph with weights at its nodes and edges, by rows. Parallel edges are merged.
#[derive(Debug, Clone)]
pub(super) struct Weighted {
    offsets: Vec<u32>,
    entries: Vec<(u32, f64)>,
    pub size: Vec<f64>,
}

impl Weighted {
    /// The graph over `size.len()` nodes with these edges.
    pub fn new(size: Vec<f64>, edges: impl Iterator<Item = (u32, u32, f64)> + Clone) -> Self {
        let n = size.len();
        let mut offsets = vec![0u32; n + 1];
        for (i, j, _) in edges.clone() {
            offsets[i as usize + 1] += 1;
            offsets[j as usize + 1] += 1;
        }
        for i in 0..n {
            offsets[i + 1] += offsets[i];
        }
        let mut next = offsets.clone();
        let mut entries = vec![(0, 0.0); offsets[n] as usize];
        for (i, j, w) in edges {
            for (at, to) in [(i, j), (j, i)] {
                entries[next[at as usize] as usize] = (to, w);
                next[at as usize] += 1;
            }
        }
        let mut graph = Weighted {
            offsets,
            entries,
            size,
        };
        graph.merge_parallel();
        graph
    }

    fn merge_parallel(&mut self) {
        let n = self.size.len();
        let (mut kept, mut start) = (0, 0);
        for i in 0..n {
            let end = self.offsets[i + 1] as usize;
            self.entries[start..end].sort_by_key(|e| e.0);
            let first = kept;
            for k in start..end {
                let (to, w) = self.entries[k];
                if kept > first && self.entries[kept - 1].0 == to {
                    self.entries[kept - 1].1 += w;
                } else {
                    self.entries[kept] = (to, w);
                    kept += 1;
                }
            }
            start = end;
            self.offsets[i + 1] = kept as u32;
        }
        self.entries.truncate(kept);
    }

    pub fn nodes(&self) -> usize {
        self.size.len()
    }

    /// The neighbours of node `i` with the weights of the edges to them.
    pub fn row(&self, i: usize) -> &[(u32, f64)] {
        &self.entries[self.offsets[i] as usize..self.offsets[i + 1] as usize]
    }

    /// Merges each node with the unmatched neighbour across its heaviest edge, unless both together exceed
    /// `largest`. Returns the coarse graph, and the coarse node of each node.
    pub fn coarsen(&self, largest: f64, random: &mut Random) -> (Weighted, Vec<u32>) {
        let n = self.nodes();
        let mut coarse = vec![u32::MAX; n];
        let mut size = Vec::with_capacity(n / 2 + 1);
        for i in shuffled(n, random) {
            let i = i as usize;
            if coarse[i] != u32::MAX {
                continue;
            }
            let fits = |&&(j, _): &&(u32, f64)| {
                let j = j as usize;
                coarse[j] == u32::MAX && j != i && self.size[i] + self.size[j] <= largest
            };
            let free = self.row(i).iter().filter(fits);
            let heaviest = free.max_by(|a, b| a.1.total_cmp(&b.1).then(b.0.cmp(&a.0)));
            let name = size.len() as u32;
            coarse[i] = name;
            size.push(self.size[i]);
            if let Some(&(j, _)) = heaviest {
                coarse[j as usize] = name;
                size[name as usize] += self.size[j as usize];
            }
        }
        let edges = (0..n).flat_map(|i| {
            let coarse = &coarse;
            self.row(i).iter().filter_map(move |&(j, w)| {
                let (a, b) = (coarse[i], coarse[j as usize]);
                ((j as usize) > i && a != b).then_some((a, b, w))
            })
        });
        (Weighted::new(size, edges), coarse)
    }
}

fn shuffled(n: usize, random: &mut Random) -> Vec<u32> {
    let mut order: Vec<u32> = (0..n as u32).collect();
    for i in (1..n).rev() {
        order.swap(i, (random.next() % (i as u64 + 1)) as usize);
    }
    order
}
