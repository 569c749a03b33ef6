//! A map's problem and the data that repeated solves share: its solver, the separation rows that integers
//! have missed so far, and the structure that untangling uses.

use std::borrow::Cow;
use std::rc::Rc;

use super::outcome::Outcome;
use crate::error::Result;
use crate::map::{SeamlessMap, SeamlessProblem};
use crate::mesh::TriangleMesh;
use crate::monitor::{Monitor, optional};
use crate::search::{Options, Strategy, WarmStart};
use crate::solve::{SoftRow, Solution, Solver, has_many_integers};
use crate::untangle::{FAR, Structure, UntangleOptions, Untangled, faulty};

/// The most unknowns for which a proof is tried with [`Strategy::Auto`].
const PROVED: usize = 50_000;

/// The most nodes that this proof may visit, so that a map does not wait for it.
const NODES: usize = 30_000_000;

/// So many maps that leave no fewer faults, one after another, end the mending of faults.
const REFUSED: usize = 8;

/// Where more rows are missed, the quads are too large for them, and other integers help little.
const MISSED: usize = 100;

/// A round ends these unless it leaves at most so large a part of them.
const LEFT: f64 = 0.9;

/// These options, changed so that a map does not wait for a proof with [`Strategy::Auto`].
pub(super) fn without_long_proof(options: &Options, variables: usize) -> Options {
    let mut options = options.clone();
    if options.strategy == Strategy::Auto {
        options.nodes = options.nodes.min(NODES);
        if variables > PROVED {
            options.strategy = Strategy::Lattice;
        }
    }
    options
}

/// The multiplications that take as long as untangling needs for a face.
const VISIT: u64 = 3_000;

/// No integers are changed around the faults of a map once that has taken so many multiplications: some ten seconds.
const WORK_OF_MENDING: u64 = 25_000_000_000;

/// A solution by options [`without_long_proof`]: where their limit of nodes is the library's, a budget has ended
/// the proof, and no limit of the caller's.
fn named_limit(solution: Solution, options: &Options) -> Solution {
    let is_ours = options.strategy == Strategy::Auto && options.nodes == NODES;
    match is_ours {
        true => solution.within_budget(),
        false => solution,
    }
}

/// A solution, and its map.
#[derive(Clone)]
pub(super) struct Solved {
    pub(super) solution: Solution,
    pub(super) map: SeamlessMap,
}

/// The result of a separation.
pub(super) struct Separated {
    /// The rows that the best solution misses.
    missed: Vec<SoftRow>,
    /// The best solution, if it is better than the one without separation.
    pub(super) better: Option<Solved>,
    /// How often the integers were decided anew.
    pub(super) rounds: usize,
}

/// The problem of a map, and what earlier solves found out about it.
pub(super) struct MapSolver<'a, M> {
    mesh: &'a TriangleMesh,
    /// The problem at the current size.
    problem: Cow<'a, SeamlessProblem>,
    solver: Solver,
    options: &'a Options,
    monitor: &'a M,
    /// The separation rows of later solves.
    separation: Vec<SoftRow>,
    /// Known once there is a map; the same for every size.
    structure: Option<Rc<Structure>>,
    /// What all solves and untangling have taken so far, in multiplications.
    work: u64,
}

impl<'a, 'm, M: Fn() -> Monitor<'m>> MapSolver<'a, M> {
    /// The state for a problem and its solver.
    pub(super) fn new(
        mesh: &'a TriangleMesh,
        problem: Cow<'a, SeamlessProblem>,
        solver: Solver,
        options: &'a Options,
        monitor: &'a M,
    ) -> Self {
        MapSolver {
            mesh,
            problem,
            solver,
            options,
            monitor,
            separation: Vec::new(),
            structure: None,
            work: 0,
        }
    }

    /// What all solves and untangling have taken so far, in multiplications.
    pub(super) fn work(&self) -> u64 {
        self.work
    }

    pub(super) fn problem(&self) -> &SeamlessProblem {
        &self.problem
    }

    /// Changes to the same problem at another size, which was made from the solver.
    pub(super) fn resize(
        &mut self,
        of: impl FnOnce(&mut Solver) -> Result<SeamlessProblem>,
    ) -> Result<()> {
        self.problem = Cow::Owned(of(&mut self.solver)?);
        Ok(())
    }

    /// Makes the lengths of the map larger by a factor for every face.
    pub(super) fn grade(&mut self, factors: &[f64]) -> Result<()> {
        let graded = self.problem.graded(self.mesh, factors, &mut self.solver)?;
        self.problem = Cow::Owned(graded);
        Ok(())
    }

    /// Drops all separation rows.
    pub(super) fn forget_separation(&mut self) {
        self.separation.clear();
    }

    /// Solves without separation rows.
    pub(super) fn solve(&mut self) -> Result<Solved> {
        self.forget_separation();
        let solution = self.solver.solve_with(self.options, (self.monitor)())?;
        let solution = named_limit(solution, self.options);
        self.solved(solution)
    }

    /// Solves with the separation rows that there are.
    pub(super) fn solve_again(&mut self) -> Result<Solved> {
        if self.separation.is_empty() {
            return self.solve();
        }
        let options = without_long_proof(self.options, self.problem.problem().variables());
        let monitor = (self.monitor)();
        let solution = (self.solver).solve_softly(&self.separation, &options, monitor)?;
        self.solved(named_limit(solution, &options))
    }

    /// Solves with the integers of this map, which may be that of other gradients.
    pub(super) fn with_integers_of(&mut self, map: &SeamlessMap) -> Result<Solved> {
        self.solver.continue_from(map.values());
        self.keep_integers()
    }

    /// Solves with the integers of the last solution.
    pub(super) fn keep_integers(&mut self) -> Result<Solved> {
        let options = Options {
            warm_start: WarmStart::Keep,
            ..self.options.clone()
        };
        let solution = self.solver.solve_with(&options, (self.monitor)())?;
        self.solved(solution)
    }

    fn solved(&mut self, solution: Solution) -> Result<Solved> {
        self.work += solution.work();
        let map = self.problem.map(self.mesh, &solution)?;
        Ok(Solved { solution, map })
    }

    /// Separates feature curves that the integers put on one line, in at most this many rounds.
    pub(super) fn separate_features(&mut self, first: &Solved, rounds: usize) -> Result<Separated> {
        let strips = self.problem.feature_strips(self.mesh)?;
        self.separate(first, rounds, &[], |_, map| {
            let missed = strips.iter().filter(|strip| strip.is_missed(map.values()));
            missed.cloned().collect()
        })
    }

    /// Separates cones and corners within `reach` quads of each other that the integers collapse, in at most this
    /// many rounds. If that does not suffice and `with_all` is set, rows between all of them are added. Many integers
    /// have these rows from the start.
    pub(super) fn separate_cones(
        &mut self,
        first: &Solved,
        reach: f64,
        with_all: bool,
        rounds: usize,
    ) -> Result<Separated> {
        let structure = self.structure(&first.map)?;
        let monitor = (self.monitor)();
        let elements = structure.held_elements(self.mesh, &self.problem, reach, &monitor)?;
        let known = match with_all || has_many_integers(&first.solution) {
            true => elements.rows(),
            false => &[],
        };
        self.separate(first, rounds, known, |this, map| {
            elements.missed(this.mesh, &this.problem, map)
        })
    }

    /// Adds the rows that `missed` finds for a map, and decides the integers anew, at most this many times. If some are
    /// missed all the same, all `known` rows are added at once, and it begins again; with many integers, that comes first.
    /// Where a great many are missed, it ends earlier.
    fn separate(
        &mut self,
        first: &Solved,
        most_rounds: usize,
        known: &[SoftRow],
        missed: impl Fn(&Self, &SeamlessMap) -> Vec<SoftRow>,
    ) -> Result<Separated> {
        let mut so_far = Separated {
            missed: missed(self, &first.map),
            better: None,
            rounds: 0,
        };
        if known.is_empty() || !has_many_integers(&first.solution) {
            self.keep(&[], most_rounds, &missed, &mut so_far)?;
        }
        let is_hopeless = so_far.rounds > 0 && so_far.missed.len() > MISSED;
        if !known.is_empty() && !so_far.missed.is_empty() && !is_hopeless {
            self.keep(known, most_rounds, &missed, &mut so_far)?;
        }
        Ok(so_far)
    }

    /// Adds these rows and those that are missed, and decides the integers anew, at most this many times.
    fn keep(
        &mut self,
        rows: &[SoftRow],
        most_rounds: usize,
        missed: &impl Fn(&Self, &SeamlessMap) -> Vec<SoftRow>,
        so_far: &mut Separated,
    ) -> Result<()> {
        let options = without_long_proof(self.options, self.problem.problem().variables());
        let mut new: Vec<SoftRow> = so_far.missed.iter().chain(rows).cloned().collect();
        for _ in 0..most_rounds {
            let before = self.separation.len();
            for row in new {
                if !self.separation.contains(&row) {
                    self.separation.push(row);
                }
            }
            if self.separation.len() == before {
                break;
            }
            let (solver, separation, monitor) = (&mut self.solver, &self.separation, self.monitor);
            let solved = optional(monitor, || {
                solver.solve_softly(separation, &options, monitor())
            });
            let Some(solution) = solved? else {
                break;
            };
            so_far.rounds += 1;
            let found = self.solved(named_limit(solution, &options))?;
            new = missed(self, &found.map);
            let enough = LEFT * so_far.missed.len() as f64;
            let is_hopeless = new.len() > MISSED && new.len() as f64 > enough;
            if new.len() < so_far.missed.len() {
                so_far.missed = new.clone();
                so_far.better = Some(found);
            }
            if is_hopeless {
                break;
            }
        }
        Ok(())
    }

    /// Changes the integers around the faults of a map. Each of at most `most` tries adds one row to those that there
    /// are, and keeps it if fewer faults remain, until they have taken [`WORK_OF_MENDING`]. Gives the number of tries
    /// and the best map, if it is better than `before`; a caller who finishes the run gets the best so far.
    pub(super) fn mend(
        &mut self,
        before: &Untangled,
        effort: &UntangleOptions,
        most: usize,
    ) -> Result<(usize, Option<(Solved, Untangled)>)> {
        let structure = self.structure(&before.map)?;
        let monitor = (self.monitor)();
        let elements = structure.held_elements(self.mesh, &self.problem, FAR, &monitor)?;
        drop(monitor);
        let quad = self.problem.edge_length(self.mesh);
        let (mut tries, mut better) = (0, None::<(Solved, Untangled)>);
        let mut refused: Vec<SoftRow> = Vec::new();
        let end = self.work + WORK_OF_MENDING;
        while tries < most && refused.len() < REFUSED && self.work < end {
            let last = better.as_ref().map_or(before, |(_, untangled)| untangled);
            let faults: Vec<usize> = faulty(self.mesh, last).collect();
            let steps = elements.steps_around(self.mesh, &last.map, &faults, quad);
            let is_new = |row: &SoftRow| !refused.contains(row) && !self.separation.contains(row);
            let Some(step) = steps.into_iter().find(is_new) else {
                break;
            };
            let outcome = Outcome::of_map(last);
            self.separation.push(step);
            tries += 1;
            let watched = self.monitor;
            let tried = optional(watched, || {
                let solved = self.solve_again()?;
                let untangled = self.untangle(&solved.map, effort)?;
                Ok((solved, untangled))
            });
            let Some((solved, untangled)) = tried? else {
                break;
            };
            if Outcome::of_map(&untangled) < outcome {
                let is_mended = untangled.faults() == 0;
                better = Some((solved, untangled));
                refused.clear();
                if is_mended {
                    break;
                }
            } else {
                refused.extend(self.separation.pop());
            }
        }
        Ok((tries, better))
    }

    /// A map that is left as it is.
    pub(super) fn untouched(&self, map: SeamlessMap) -> Result<Untangled> {
        Untangled::untouched(self.mesh, &self.problem, map)
    }

    /// Removes folds and winding defects, with the integers fixed.
    pub(super) fn untangle(
        &mut self,
        map: &SeamlessMap,
        effort: &UntangleOptions,
    ) -> Result<Untangled> {
        let structure = self.structure(map)?;
        let mut monitor = (self.monitor)();
        let untangled = structure.untangle(self.mesh, &self.problem, map, effort, &mut monitor)?;
        self.work += VISIT * untangled.visited as u64;
        Ok(untangled)
    }

    /// The structure that all maps of the problem share; `map` is one of them.
    fn structure(&mut self, map: &SeamlessMap) -> Result<Rc<Structure>> {
        let known = match self.structure.take() {
            Some(known) => known,
            None => {
                let mut monitor = (self.monitor)();
                Rc::new(Structure::new(self.mesh, &self.problem, map, &mut monitor)?)
            }
        };
        Ok(self.structure.insert(known).clone())
    }
}
