//! Selection of the charges of a block, around a given edge, for block improvement.

use super::space::CycleSpace;
use crate::error::Result;
use crate::linalg::Sparse;

/// How a block grows from the cycles through its edge.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Growth {
    /// By the nearest neighbours. Such blocks are round.
    Near,
    /// By the neighbours across the greatest residuals. Such blocks follow the residuals.
    Steep,
}

/// Grows blocks.
#[derive(Debug)]
pub(super) struct Blocks {
    /// Both triangles of A, without its diagonal.
    neighbours: Sparse,
    taken: Vec<u32>,
    round: u32,
    frontier: Vec<(f64, u32)>,
}

impl Blocks {
    pub fn new(space: &CycleSpace) -> Result<Self> {
        let n = space.laplacian.rows();
        let off = space.laplacian.entries().filter(|(i, j, _)| i != j);
        let both = off.flat_map(|(i, j, v)| [(i, j, v), (j, i, v)]);
        Ok(Blocks {
            neighbours: Sparse::from_triplets(n, n, both)?,
            taken: vec![0; n],
            round: 0,
            frontier: Vec::new(),
        })
    }

    /// At most `size` cycles around `seeds`, at the potentials `x`.
    pub fn grow(
        &mut self,
        seeds: impl Iterator<Item = u32>,
        size: usize,
        growth: Growth,
        x: &[f64],
    ) -> Vec<u32> {
        self.round += 1;
        self.frontier.clear();
        let mut block: Vec<u32> = seeds.take(size).collect();
        for &k in &block {
            self.taken[k as usize] = self.round;
        }
        let mut seen = 0;
        while block.len() < size {
            while let Some(&k) = block.get(seen) {
                for (j, v) in self.neighbours.row(k as usize) {
                    if self.taken[j] != self.round {
                        let rank = match growth {
                            Growth::Near => -(seen as f64),
                            Growth::Steep => (x[k as usize] - x[j]).abs() * v.abs(),
                        };
                        self.frontier.push((rank, j as u32));
                    }
                }
                seen += 1;
            }
            let (taken, round) = (&self.taken, self.round);
            self.frontier.retain(|&(_, j)| taken[j as usize] != round);
            let ranked = self.frontier.iter().enumerate();
            let best = ranked.max_by(|(_, a), (_, b)| a.0.total_cmp(&b.0).then(b.1.cmp(&a.1)));
            let Some((at, &(_, j))) = best else { break };
            self.frontier.swap_remove(at);
            self.taken[j as usize] = self.round;
            block.push(j);
        }
        block
    }

    /// Marks the cycles of a block and the cycles within the given number of edges of it.
    pub fn mark_near(&self, block: &[u32], edges: usize, near: &mut [bool]) {
        let mut ring = block.to_vec();
        for &k in block {
            near[k as usize] = true;
        }
        for _ in 0..edges {
            let mut next = Vec::new();
            for &k in &ring {
                for (j, _) in self.neighbours.row(k as usize) {
                    if !std::mem::replace(&mut near[j], true) {
                        next.push(j as u32);
                    }
                }
            }
            ring = next;
        }
    }
}
