//! A field that sees details of one size, and the current map of it.

use std::borrow::Cow;

use super::QuadOptions;
use super::attempt::is_hopeless;
use super::fields::choose_field;
use super::map_solver::{MapSolver, Solved};
use super::quadrangulation::timed;
use crate::error::Result;
use crate::field::{FieldOptions, Guidance, OrientationField};
use crate::map::SeamlessProblem;
use crate::mesh::TriangleMesh;
use crate::mesh::features::FeatureGraph;
use crate::monitor::{Monitor, Stage};
use crate::search::{Options, Strategy};
use crate::solve::Solution;
use crate::untangle::{NEAR, UntangleOptions, Untangled, faulty, grow_around};

/// The most passes of untangling over the mesh if the quads conform and only miss features.
const PASSES_FOR_FEATURES: usize = 10;

/// The most times that integers are decided anew because they collapse strips between features.
const ROUNDS_FOR_FEATURES: usize = 3;

/// A field and its map.
pub(super) struct FieldMap<'a, M> {
    /// The guidance of the field.
    pub(super) options: FieldOptions,
    pub(super) field: OrientationField,
    pub(super) solution: Solution,
    pub(super) maps: MapSolver<'a, M>,
    /// The current map, as its integers give it.
    at_hand: Solved,
    /// The map whose feature curves were not separated, until it is tried.
    features_as_rounded: Option<Solved>,
    /// The limits of untangling.
    effort: UntangleOptions,
    is_relaxed: bool,
}

impl<'a, 'm, M: Fn() -> Monitor<'m>> FieldMap<'a, M> {
    /// The field that sees no details smaller than `detail`, unless the guidance says otherwise, and its map with
    /// feature curves separated. With `off_features`, no irregular vertices of the field move onto features. The
    /// integers of the map are decided by `of_map_solve`. The times of fields and maps are added to `of_field` and
    /// `of_map`.
    pub(super) fn new(
        mesh: &'a TriangleMesh,
        given: &QuadOptions,
        of_map_solve: &'a Options,
        features: &FeatureGraph,
        (detail, off_features): (f64, bool),
        monitor: &'a M,
        [of_field, of_map]: [&mut f64; 2],
    ) -> Result<Self> {
        let options = QuadOptions {
            guidance: Guidance {
                detail: given.guidance.detail.or(Some(detail)),
                ..given.guidance.clone()
            },
            ..given.clone()
        };
        let chosen = choose_field(
            mesh,
            &options,
            features,
            monitor,
            off_features,
            [of_field, of_map],
        )?;
        let problem = Cow::Owned(chosen.problem);
        let mut maps = MapSolver::new(mesh, problem, chosen.solver, of_map_solve, monitor);
        monitor().run().enter(Stage::Map, 0, 1);
        let (at_hand, features_as_rounded) = timed(of_map, || solved(mesh, &mut maps))?;
        Ok(FieldMap {
            options: chosen.options,
            field: chosen.field,
            solution: chosen.solution,
            maps,
            at_hand,
            features_as_rounded,
            effort: UntangleOptions {
                stiffenings: given.stiffenings,
                ..UntangleOptions::default()
            },
            is_relaxed: of_map_solve.strategy == Strategy::Relax,
        })
    }

    /// Whether irregular vertices of the field keep away from features where those of another would not.
    pub(super) fn moves_away(&self) -> bool {
        !self.options.regular.is_empty() && self.solution.counts().constraints > 0
    }

    /// Goes on to a map with smaller quads around the faults of one, and around the boundary loops that are
    /// not longer than this; `false` if there are neither.
    pub(super) fn grade(
        &mut self,
        mesh: &TriangleMesh,
        faulty_map: &Untangled,
        longest: f64,
    ) -> Result<bool> {
        let faults = faulty(mesh, faulty_map).chain(small_holes(mesh, longest));
        let mut factors = vec![1.0; mesh.face_count()];
        grow_around(mesh, self.maps.problem(), faults, &mut factors);
        if factors.iter().all(|&factor| factor == 1.0) {
            return Ok(false);
        }
        self.maps.grade(&factors)?;
        (self.at_hand, self.features_as_rounded) = solved(mesh, &mut self.maps)?;
        Ok(true)
    }

    /// Changes to the map's problem of `first` with lengths larger by two factors for every face, those of u and v.
    pub(super) fn size(
        &mut self,
        mesh: &TriangleMesh,
        first: &SeamlessProblem,
        factors: &[[f64; 2]],
    ) -> Result<()> {
        self.maps
            .resize(|solver| first.stretched(mesh, factors, solver))
    }

    /// A map of the problem as it is now, with the separation rows of the last, and with more if it still puts feature
    /// curves on one line.
    pub(super) fn solve(&mut self, mesh: &TriangleMesh) -> Result<Solved> {
        let first = self.maps.solve_again()?;
        if is_hopeless(mesh, &first.map) {
            return Ok(first);
        }
        let apart = self.maps.separate_features(&first, 1)?;
        Ok(apart.better.unwrap_or(first))
    }

    /// A map of the problem as it is now, with the integers of the last.
    pub(super) fn keep_integers(&mut self) -> Result<Solved> {
        self.maps.keep_integers()
    }

    /// Makes a map of the problem the current one.
    pub(super) fn put(&mut self, map: Solved) {
        (self.at_hand, self.features_as_rounded) = (map, None);
    }

    /// The current map.
    pub(super) fn at_hand(&self) -> Solved {
        self.at_hand.clone()
    }

    /// Whether so much of the current map is folded that it is given up.
    pub(super) fn is_hopeless(&self, mesh: &TriangleMesh) -> bool {
        is_hopeless(mesh, &self.at_hand.map)
    }

    /// Whether the map has integers, and no more than so many, that may be decided anew.
    pub(super) fn may_decide_anew(&self, most: usize) -> bool {
        !self.is_relaxed && self.at_hand.solution.counts().reduced_integers <= most
    }

    /// Whether feature curves are separated.
    pub(super) fn holds_features_apart(&self) -> bool {
        self.features_as_rounded.is_some()
    }

    /// Returns to the map whose feature curves were not separated.
    pub(super) fn forget_separation(&mut self) {
        self.maps.forget_separation();
        if let Some(solved) = self.features_as_rounded.take() {
            self.at_hand = solved;
        }
    }

    /// Lowers the limits of untangling if the quads of the current map conform.
    pub(super) fn limit_effort(&mut self, conforms: bool) {
        let most = UntangleOptions::default();
        self.effort.passes = match conforms {
            true => PASSES_FOR_FEATURES,
            false => most.passes,
        };
    }

    /// The current map as it is.
    pub(super) fn as_solved(&self) -> Result<(Solution, Untangled)> {
        let Solved { solution, map } = &self.at_hand;
        let map = self.maps.untouched(map.clone())?;
        Ok((solution.clone(), map))
    }

    /// The current map untangled, with the integers fixed, in at most this many passes over the mesh.
    pub(super) fn untangled(&mut self, passes: usize) -> Result<(Solution, Untangled)> {
        let Solved { solution, map } = &self.at_hand;
        let map = self.maps.untangle(map, &self.within(passes))?;
        Ok((solution.clone(), map))
    }

    fn within(&self, passes: usize) -> UntangleOptions {
        UntangleOptions {
            passes: self.effort.passes.min(passes),
            ..self.effort
        }
    }

    /// The current map with its cones separated, then untangled in at most this many passes over the
    /// mesh; `None` if no constraints separate them.
    pub(super) fn cones_apart(&mut self, passes: usize) -> Result<Option<(Solution, Untangled)>> {
        let rounds = self.effort.rounds;
        let separated = (self.maps).separate_cones(&self.at_hand, NEAR, false, rounds)?;
        let Some(Solved { solution, map }) = separated.better else {
            return Ok(None);
        };
        let map = self.maps.untangle(&map, &self.within(passes))?;
        Ok(Some((solution, map)))
    }
}

/// A map with feature curves separated, and the one without where they differ.
fn solved<'m, M: Fn() -> Monitor<'m>>(
    mesh: &TriangleMesh,
    maps: &mut MapSolver<'_, M>,
) -> Result<(Solved, Option<Solved>)> {
    let first = maps.solve()?;
    if is_hopeless(mesh, &first.map) {
        return Ok((first, None));
    }
    Ok(
        match maps.separate_features(&first, ROUNDS_FOR_FEATURES)?.better {
            Some(apart) => (apart, Some(first)),
            None => {
                maps.forget_separation();
                (first, None)
            }
        },
    )
}

/// The vertices of boundary loops that are not longer than this.
fn small_holes(mesh: &TriangleMesh, longest: f64) -> impl Iterator<Item = usize> {
    let is_small = |sides: &Vec<(usize, usize)>| {
        let length: f64 = sides.iter().map(|&(f, k)| mesh.edge_length(f, k)).sum();
        length <= longest
    };
    let loops = mesh.boundary_loops().into_iter().filter(is_small);
    let small: Vec<(usize, usize)> = loops.flatten().collect();
    small.into_iter().map(|(f, k)| mesh.corners(f)[k])
}
