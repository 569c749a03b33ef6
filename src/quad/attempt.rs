//! The quads of one map, and how well that went.

use super::missed::missed;
use crate::extract::{IntegerGridMap, QuadMesh, extract};
use crate::map::{SeamlessMap, SeamlessProblem};
use crate::mesh::TriangleMesh;
use crate::untangle::{UntangleOptions, Untangled, solve_fold_free, untangle};
use crate::{Monitor, Options, Result, Solution};

/// How many passes over the mesh untangling may make where quads conform and lack features alone.
const PASSES_FOR_FEATURES: usize = 10;

/// Maps of more integers are not decided anew: that takes minutes and helps none of them.
const INTEGERS_TO_DECIDE_ANEW: usize = 600;

/// A map with more than one face in so many folded is not worked on.
const FOLDED_PART: usize = 4;

/// A map and its quads.
pub(super) struct Attempt {
    pub(super) solution: Solution,
    pub(super) map: Untangled,
    pub(super) quads: QuadMesh,
    /// Features that no edge of a quad runs along.
    pub(super) missed: Vec<usize>,
    /// Whether they are closed where the mesh is, and nothing but quads.
    pub(super) conforms: bool,
}

/// What attempts have in common.
pub(super) struct Trial<'a, F> {
    pub(super) mesh: &'a TriangleMesh,
    pub(super) features: &'a [usize],
    pub(super) options: &'a Options,
    pub(super) may_untangle: bool,
    pub(super) monitor: &'a F,
}

impl<'a, 'm, F: Fn() -> Monitor<'m>> Trial<'a, F> {
    /// The best of a few attempts, the first that leaves nothing to be wished: the map as the
    /// solution has it, untangled, and with the cones held apart that its integers collapse.
    pub(super) fn best(&self, problem: &SeamlessProblem, solution: Solution) -> Result<Attempt> {
        let mesh = self.mesh;
        let as_it_is = Untangled::as_it_is(problem.map(mesh, &solution)?);
        let mut best = self.attempt(solution, as_it_is)?;
        if !self.may_untangle || best.is_whole() || is_hopeless(mesh, &best.map.map) {
            return Ok(best);
        }
        let effort = UntangleOptions {
            refinements: 0,
            passes: match best.conforms {
                true => PASSES_FOR_FEATURES,
                false => UntangleOptions::default().passes,
            },
            ..UntangleOptions::default()
        };
        let untangled = untangle(mesh, problem, &best.map.map, &effort, &mut (self.monitor)())?;
        let second = self.attempt(best.solution.clone(), untangled)?;
        best = best.or(second);
        let integers = best.solution.counts().reduced_integers;
        if best.is_whole() || integers > INTEGERS_TO_DECIDE_ANEW {
            return Ok(best);
        }
        let unfolded = solve_fold_free(mesh, problem, self.options, &effort, self.monitor)?;
        if unfolded.rounds == 0 {
            return Ok(best);
        }
        Ok(best.or(self.attempt(unfolded.solution, unfolded.untangled)?))
    }

    fn attempt(&self, solution: Solution, map: Untangled) -> Result<Attempt> {
        let exact = IntegerGridMap::from_seamless(self.mesh, &map.map)?;
        let quads = extract(self.mesh, &exact, &mut (self.monitor)())?;
        Ok(Attempt {
            conforms: quads.is_conforming(),
            missed: missed(self.mesh, &quads, self.features),
            solution,
            map,
            quads,
        })
    }
}

/// Whether so much of a map is folded that neither untangling nor other integers help: there is more
/// to be followed than quads of this size can.
pub(super) fn is_hopeless(mesh: &TriangleMesh, map: &SeamlessMap) -> bool {
    FOLDED_PART * map.flipped().len() > mesh.face_count()
}

impl Attempt {
    /// Whether the quads conform and have all features.
    pub(super) fn is_whole(&self) -> bool {
        self.conforms && self.missed.is_empty()
    }

    /// The better of two, the first if they are equal.
    pub(super) fn or(self, other: Attempt) -> Attempt {
        if other.is_better_than(&self) {
            other
        } else {
            self
        }
    }

    pub(super) fn is_better_than(&self, other: &Attempt) -> bool {
        self.cost() < other.cost()
    }

    /// What is to be as small as can be, the most important first.
    fn cost(&self) -> (bool, usize, usize, usize) {
        (
            !self.conforms,
            self.missed.len(),
            self.quads.repaired,
            self.quads.figures().irregular,
        )
    }
}
