//! A map's problem with all that is kept while it is solved again and again: its solver, the separation
//! constraints found so far, and what untangling knows of its structure.

use std::borrow::Cow;
use std::rc::Rc;

use super::outcome::Outcome;
use crate::error::Result;
use crate::map::{SeamlessMap, SeamlessProblem, SeparationConstraint, solve_separated};
use crate::mesh::TriangleMesh;
use crate::monitor::Monitor;
use crate::search::{Options, Strategy};
use crate::solve::{Solution, Solver};
use crate::untangle::{Collapsed, Structure, UntangleOptions, Untangled};

/// How often integers that collapse strips between features are decided anew.
const ROUNDS_FOR_FEATURES: usize = 3;

/// With [`Strategy::Auto`] a proof is tried for maps of at most so many unknowns,
const PROVED: usize = 50_000;

/// and may visit so many nodes: a map shall not wait for it.
const NODES: usize = 30_000_000;

/// These options, but that with [`Strategy::Auto`] a map does not wait for a proof.
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

/// A solution, and its map.
pub(super) struct Solved {
    pub(super) solution: Solution,
    pub(super) map: SeamlessMap,
}

/// What holding apart came to.
pub(super) struct Separated {
    /// The best solution, if it is better than that without separation.
    pub(super) better: Option<Solved>,
    /// What the integers of the best still collapse.
    pub(super) outcome: Outcome,
    /// How often integers were decided anew.
    pub(super) rounds: usize,
}

/// The problem of a map, and what was learned of it.
pub(super) struct MapSolver<'a, M> {
    mesh: &'a TriangleMesh,
    /// For the size at hand.
    problem: Cow<'a, SeamlessProblem>,
    solver: Solver,
    options: &'a Options,
    monitor: &'a M,
    /// What later solves hold apart.
    separation: Vec<SeparationConstraint>,
    /// Known once there is a map; the same for every size.
    structure: Option<Rc<Structure>>,
}

impl<'a, 'm, M: Fn() -> Monitor<'m>> MapSolver<'a, M> {
    /// For a problem and a solver of it.
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
        }
    }

    pub(super) fn problem(&self) -> &SeamlessProblem {
        &self.problem
    }

    /// Goes over to the same problem for another size, which is made of the solver.
    pub(super) fn resize(
        &mut self,
        of: impl FnOnce(&mut Solver) -> Result<SeamlessProblem>,
    ) -> Result<()> {
        self.problem = Cow::Owned(of(&mut self.solver)?);
        Ok(())
    }

    /// Holds nothing apart any more.
    pub(super) fn forget_separation(&mut self) {
        self.separation.clear();
    }

    /// Solves with nothing held apart.
    pub(super) fn solve(&mut self) -> Result<Solved> {
        self.forget_separation();
        let solution = self.solver.solve_with(self.options, (self.monitor)())?;
        self.solved(solution)
    }

    fn solved(&self, solution: Solution) -> Result<Solved> {
        let map = self.problem.map(self.mesh, &solution)?;
        Ok(Solved { solution, map })
    }

    /// Holds feature curves apart that integers put on one line.
    pub(super) fn separate_features(&mut self, first: &Solved) -> Result<Separated> {
        let strips = self.problem.feature_strips(self.mesh);
        self.separate(first, ROUNDS_FOR_FEATURES, |_, map| {
            let collapsed = strips.iter().filter(|strip| strip.is_collapsed(map));
            let collapsed: Vec<_> = collapsed.copied().collect();
            (Outcome::of_integers(collapsed.len()), collapsed)
        })
    }

    /// Holds cones and corners apart that integers collapse, in at most so many rounds.
    pub(super) fn separate_cones(&mut self, first: &Solved, rounds: usize) -> Result<Separated> {
        let structure = self.structure(&first.map)?;
        let elements = structure.held_elements(self.mesh, &self.problem);
        self.separate(first, rounds, |this, map| {
            let collapsed = Collapsed::find(&elements, map);
            let constraints = collapsed.separation(this.mesh, &this.problem, map);
            (Outcome::of_integers(collapsed.count()), constraints)
        })
    }

    /// Decides integers anew, at most so many times, until `find` names no further constraints: of a map
    /// it tells the outcome, and what should be held apart.
    fn separate(
        &mut self,
        first: &Solved,
        most_rounds: usize,
        find: impl Fn(&Self, &SeamlessMap) -> (Outcome, Vec<SeparationConstraint>),
    ) -> Result<Separated> {
        let options = without_long_proof(self.options, self.problem.problem().variables());
        let (mut outcome, mut wanted) = find(self, &first.map);
        let (mut better, mut rounds) = (None, 0);
        while rounds < most_rounds {
            let before = self.separation.len();
            for constraint in wanted {
                let is_same = |known: &SeparationConstraint| known.unknowns == constraint.unknowns;
                if !self.separation.iter().any(is_same) {
                    self.separation.push(constraint);
                }
            }
            if self.separation.len() == before {
                break;
            }
            let (solver, separation) = (&mut self.solver, &mut self.separation);
            let Some(solution) = solve_separated(solver, separation, &options, self.monitor)?
            else {
                break;
            };
            rounds += 1;
            let found = self.solved(solution)?;
            let of_found;
            (of_found, wanted) = find(self, &found.map);
            if of_found < outcome {
                (better, outcome) = (Some(found), of_found);
            }
        }
        Ok(Separated {
            better,
            outcome,
            rounds,
        })
    }

    /// A map that nothing is done to.
    pub(super) fn untouched(&self, map: SeamlessMap) -> Result<Untangled> {
        Untangled::untouched(self.mesh, &self.problem, map)
    }

    /// Undoes folds and winding defects, the integers held.
    pub(super) fn untangle(
        &mut self,
        map: &SeamlessMap,
        effort: &UntangleOptions,
    ) -> Result<Untangled> {
        let structure = self.structure(map)?;
        let mut monitor = (self.monitor)();
        structure.untangle(self.mesh, &self.problem, map, effort, &mut monitor)
    }

    /// What all maps of the problem share, of which this is one.
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
