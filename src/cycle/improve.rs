//! Block improvement: exact optimisation of the charges around the greatest residuals.
//!
//! The last step of the cycle method on charges. If the charges of a block B change by integers t, the
//! energy changes by `step^2 t'Gt + 2 step t'x_B`. Here G is the block of `A^-1`, and x are the potentials.
//! This is a closest-vector problem of few dimensions. Blocks around the edges with the greatest residuals
//! come first, since a better place for a charge is most likely there. A block without an improvement is
//! tried again only after the potentials near it have changed. In spaces of many cycles, potentials cost
//! much more than a block. There, the changes of several distant blocks are applied together. If that does
//! not lower the energy, they are applied one by one.

use super::block::{Blocks, Growth};
use super::closest::decide;
use super::laplacian::LONG;
use super::space::CycleSpace;
use crate::error::Result;
use crate::linalg::PathSolve;
use crate::monitor::{Monitor, Phase};

/// A potential counts as changed from this difference on, in units of the step times the mean weight.
const CHANGED: f64 = 0.02;

/// A gain below this, relative to the energy, does not count.
const TOLERANCE: f64 = 1e-9;

/// The largest number of nodes of one enumeration.
const NODES: u64 = 20_000;

/// Moves wait until there is one for each this many cycles of the space. Then the potentials are
/// recomputed.
const CYCLES_A_MOVE: usize = 16_384;

/// A block within this many edges of a waiting move is near it.
const FAR: usize = 8;

/// The effort of block improvement.
#[derive(Debug, Clone, Copy)]
pub(super) struct Effort {
    pub growth: Growth,
    /// The number of charges of a block, at most [`WIDEST`](crate::linalg::WIDEST).
    pub size: usize,
    /// The least residual of an edge that is tried, in units of the step.
    pub residual: f64,
}

/// Charges that are being improved.
pub(super) struct Improvement<'a> {
    space: &'a CycleSpace,
    paths: PathSolve,
    blocks: Blocks,
    pub charges: Vec<f64>,
    x: Vec<f64>,
    pub energy: f64,
    /// By cycle: the last failed block that contains it. It is 0 if the potential has changed since.
    failed: Vec<u32>,
    failures: u32,
    /// The least change of a potential after which a block is tried again.
    changed: f64,
    /// The waiting moves of charges, one list for each block.
    waiting: Vec<Vec<(u32, f64)>>,
    /// By cycle: whether it is near a waiting move.
    near: Vec<bool>,
    work: usize,
}

impl<'a> Improvement<'a> {
    /// Starts from `charges`.
    pub fn new(space: &'a CycleSpace, charges: Vec<f64>) -> Result<Self> {
        let (x, energy) = space.potentials(&charges);
        let edges = &space.system.graph.edges;
        let weights: f64 = edges.iter().map(|e| e.weight).sum();
        let mean_weight = weights / edges.len().max(1) as f64;
        Ok(Improvement {
            paths: PathSolve::new(charges.len()),
            blocks: Blocks::new(space)?,
            failed: vec![0; charges.len()],
            failures: 0,
            changed: CHANGED * space.system.step * mean_weight,
            waiting: Vec::new(),
            near: vec![false; charges.len()],
            work: 0,
            space,
            charges,
            x,
            energy,
        })
    }

    /// The multiplications so far.
    pub fn work(&self) -> usize {
        self.work + self.paths.work()
    }

    /// Tries blocks until no block improves, until `work` multiplications are spent since the start, or
    /// until the monitor stops the search.
    ///
    /// # Errors
    /// For charges too large to be exact.
    pub fn run(&mut self, effort: Effort, work: usize, monitor: &mut Monitor) -> Result<()> {
        self.failed.fill(0);
        self.decide_long_cycles(effort.size)?;
        loop {
            let before = self.energy;
            for e in self.seeds(effort.residual) {
                let done = self.work() as f64 / work.max(1) as f64;
                if done >= 1.0 || monitor.ends_at(Phase::Round, done) {
                    self.make_waiting();
                    return Ok(());
                }
                if self.promises(e, effort.residual) && self.is_near(e) {
                    self.make_waiting();
                }
                if self.promises(e, effort.residual) {
                    let cycles = self.space.through.row(e).map(|(k, _)| k as u32);
                    let (size, growth) = (effort.size, effort.growth);
                    let block = self.blocks.grow(cycles, size, growth, &self.x);
                    self.decide_block(&block)?;
                }
            }
            self.make_waiting();
            // Every comparison with NaN is false, so an energy that overflows is not improved.
            let improved = self.energy < before;
            if !improved {
                return Ok(());
            }
        }
    }

    /// The edges with at least this residual, the greatest residual first.
    fn seeds(&mut self, residual: f64) -> Vec<usize> {
        let edges = 0..self.space.system.graph.edges.len();
        let least = residual * self.space.system.step;
        self.work += edges.len();
        let mut seeds: Vec<(f64, usize)> = edges
            .map(|e| (self.space.residual(&self.x, e).abs(), e))
            .filter(|&(r, _)| r >= least)
            .collect();
        seeds.sort_by(|a, b| b.0.total_cmp(&a.0).then(a.1.cmp(&b.1)));
        seeds.into_iter().map(|(_, e)| e).collect()
    }

    /// Whether an edge still has its residual, and its cycles were not all in the same failed block.
    fn promises(&self, e: usize, residual: f64) -> bool {
        let mut failed = self.space.through.row(e).map(|(k, _)| self.failed[k]);
        let Some(first) = failed.next() else {
            return false;
        };
        let tried = first != 0 && failed.all(|f| f == first);
        !tried && self.space.residual(&self.x, e).abs() >= residual * self.space.system.step
    }

    /// Optimises all cycles around handles and boundaries together, as many as fit into one block.
    fn decide_long_cycles(&mut self, size: usize) -> Result<()> {
        let basis = &self.space.basis;
        let long = (0..basis.len() as u32).rev();
        let block: Vec<u32> = long
            .take_while(|&k| basis.get(k as usize).len() > LONG)
            .take(size)
            .collect();
        self.decide_block(&block)
    }

    /// Finds the best charges of a block by enumeration.
    fn decide_block(&mut self, block: &[u32]) -> Result<()> {
        if block.iter().any(|&k| self.near[k as usize]) {
            self.make_waiting();
        }
        let step = self.space.system.step;
        let inverse = self.paths.inverse_block(&self.space.factor, block);
        let pull: Vec<f64> = block.iter().map(|&k| self.x[k as usize] / step).collect();
        let Some(moves) = decide(inverse, &pull, NODES)? else {
            self.failures += 1;
            for &k in block {
                self.failed[k as usize] = self.failures;
            }
            return Ok(());
        };
        let moves = block.iter().zip(moves).map(|(&k, t)| (k, t as f64));
        self.waiting.push(moves.collect());
        match self.waiting.len() > self.charges.len() / CYCLES_A_MOVE {
            true => self.make_waiting(),
            false => self.blocks.mark_near(block, FAR, &mut self.near),
        }
        Ok(())
    }

    /// Whether an edge is near a waiting move.
    fn is_near(&self, e: usize) -> bool {
        let mut cycles = self.space.through.row(e);
        cycles.any(|(k, _)| self.near[k])
    }

    /// Applies the waiting moves together, or one by one if that does not lower the energy.
    fn make_waiting(&mut self) {
        let waiting = std::mem::take(&mut self.waiting);
        if !waiting.is_empty() {
            self.near.fill(false);
        }
        if waiting.len() < 2 || !self.make(&waiting.concat()) {
            for moves in &waiting {
                self.make(moves);
            }
        }
    }

    /// Moves charges if that lowers the energy. Returns whether it does.
    fn make(&mut self, moves: &[(u32, f64)]) -> bool {
        let mut charges = self.charges.clone();
        for &(k, t) in moves {
            charges[k as usize] += t;
        }
        let (x, energy) = self.space.potentials(&charges);
        self.work += 2 * self.space.factor.len();
        let is_lower = energy < self.energy * (1.0 - TOLERANCE);
        if is_lower {
            self.note_changes(&x);
            (self.charges, self.x, self.energy) = (charges, x, energy);
        }
        is_lower
    }

    /// Allows another try for the blocks whose potentials have changed.
    fn note_changes(&mut self, x: &[f64]) {
        let changed = self.changed;
        for (k, (new, old)) in x.iter().zip(&self.x).enumerate() {
            if (new - old).abs() > changed {
                self.failed[k] = 0;
            }
        }
    }
}
