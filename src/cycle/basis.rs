//! A unimodular basis of short cycles.
//!
//! The fourth step of the cycle method. An independent set of cycles may generate only a sublattice of all
//! cycles, so independence is not enough. The candidates are taken in order of length (`horton1987`). Each
//! candidate is written in the fundamental cycles of a spanning forest, with one coordinate for each chord,
//! and reduced by the cycles accepted before it. The pivots are 1 or -1 only, so the reduction consists of
//! integer row operations of determinant one. A candidate that reduces to zero depends on the accepted
//! cycles. A candidate without an entry of 1 or -1 after its reduction is refused. The short fundamental
//! cycles are candidates as well. The fundamental cycles of the chords that are no pivot complete the
//! basis; they are unit rows. So the determinant of the basis is 1 or -1: the basis is *integral*
//! (`liebchen2007`).

use super::cycles::Cycles;
use super::forest::Forest;
use super::fundamental::fundamental_cycle;
use super::graph::{Graph, NONE};
use super::short::{LONGEST, short_cycles};
use crate::error::Result;
use crate::linalg::Accumulator;
use crate::monitor::{may_continue, may_continue_at};

/// A candidate whose reduction takes more additions is refused. There are enough other candidates.
const PATIENCE: usize = 20_000;

/// A candidate whose coefficients grow beyond this is refused. Products of two smaller coefficients do not
/// overflow.
const LARGEST: i64 = 1 << 20;

/// An integral basis of the cycles of `graph`, with the shortest cycles first. The `hinted` cycles are
/// among its candidates.
pub(super) fn cycle_basis(graph: &Graph, hinted: Cycles) -> Result<Cycles> {
    let forest = Forest::shortest(graph);
    let mut candidates = short_cycles(graph, hinted)?;
    let chords = (0..graph.edges.len() as u32).filter(|&e| !forest.holds(graph, e));
    for (k, e) in chords.enumerate() {
        may_continue_at(k)?;
        if let Some(cycle) = fundamental_cycle(graph, &forest, e, LONGEST) {
            candidates.push(cycle.into_iter());
        }
    }
    let mut order: Vec<u32> = (0..candidates.len() as u32).collect();
    order.sort_by_key(|&k| candidates.get(k as usize).len());
    let mut reduction = Reduction::new(graph, &forest);
    let mut basis = Cycles::new();
    for (done, k) in order.into_iter().enumerate() {
        may_continue_at(done)?;
        let cycle = candidates.get(k as usize);
        if reduction.accepts(cycle) {
            basis.push(cycle.iter().copied());
        }
    }
    let missing = (0..graph.edges.len() as u32).filter(|&e| reduction.is_missing(e));
    let mut rest = Vec::new();
    for e in missing {
        may_continue()?;
        rest.extend(fundamental_cycle(graph, &forest, e, usize::MAX));
    }
    rest.sort_by_key(Vec::len);
    for cycle in rest {
        basis.push(cycle.into_iter());
    }
    Ok(basis)
}

/// The accepted cycles, each with a pivot chord of its own.
struct Reduction {
    is_chord: Vec<bool>,
    /// By edge: the row whose pivot it is, or [`NONE`].
    solved: Vec<u32>,
    /// By row: its pivot chord as a combination of other chords.
    rows: Vec<Vec<(u32, i64)>>,
    /// The cycle being reduced.
    coefficients: Accumulator<i64>,
    open: Vec<(u32, i64)>,
}

impl Reduction {
    fn new(graph: &Graph, forest: &Forest) -> Self {
        let edges = graph.edges.len();
        Reduction {
            is_chord: (0..edges as u32).map(|e| !forest.holds(graph, e)).collect(),
            solved: vec![NONE; edges],
            rows: Vec::new(),
            coefficients: Accumulator::new(edges),
            open: Vec::new(),
        }
    }

    /// Whether `e` is a chord that is not a pivot.
    fn is_missing(&self, e: u32) -> bool {
        self.is_chord[e as usize] && self.solved[e as usize] == NONE
    }

    /// Accepts a cycle if it has a pivot of 1 or -1 after its reduction by the accepted cycles.
    fn accepts(&mut self, cycle: &[(u32, i8)]) -> bool {
        let chords = cycle.iter().filter(|&&(e, _)| self.is_chord[e as usize]);
        self.open
            .extend(chords.map(|&(e, sign)| (e, i64::from(sign))));
        let patient = self.reduce();
        let mut row = Vec::with_capacity(self.coefficients.len());
        self.coefficients.drain(|e, v| {
            if v != 0 {
                row.push((e, v));
            }
        });
        let unit = row.iter().position(|&(_, v): &(u32, i64)| v.abs() == 1);
        let Some(at) = unit.filter(|_| patient) else {
            return false;
        };
        let (chord, v) = row.swap_remove(at);
        row.iter_mut().for_each(|(_, u)| *u *= -v);
        self.solved[chord as usize] = self.rows.len() as u32;
        self.rows.push(row);
        true
    }

    /// Eliminates all pivot chords from the current cycle. Returns false if this takes too many additions.
    fn reduce(&mut self) -> bool {
        for _ in 0..PATIENCE {
            let Some((e, v)) = self.open.pop() else {
                return true;
            };
            if v.abs() > LARGEST {
                break;
            }
            match self.solved[e as usize] {
                NONE => *self.coefficients.slot(e) += v,
                row => {
                    let row = self.rows[row as usize].iter();
                    self.open.extend(row.map(|&(f, u)| (f, u * v)));
                }
            }
        }
        self.open.clear();
        false
    }
}
