//! A field that sees details of one size, and the map at hand of those that follow it.

use std::borrow::Cow;

use super::QuadOptions;
use super::attempt::is_hopeless;
use super::fields::choose_field;
use super::map_solver::{MapSolver, Solved};
use super::quadrangulation::timed;
use crate::error::Result;
use crate::field::{FieldOptions, Guidance, OrientationField};
use crate::mesh::TriangleMesh;
use crate::mesh::features::FeatureGraph;
use crate::monitor::Monitor;
use crate::search::Strategy;
use crate::solve::Solution;
use crate::untangle::{UntangleOptions, Untangled};

/// How many passes over the mesh untangling may make where quads conform and lack features alone.
const PASSES_FOR_FEATURES: usize = 10;

/// Maps of more integers are not decided anew for their cones: that takes minutes and helps none of them.
const INTEGERS_TO_DECIDE_ANEW: usize = 600;

/// A field and its map.
pub(super) struct FieldMap<'a, M> {
    /// What the field follows.
    pub(super) options: FieldOptions,
    pub(super) field: OrientationField,
    pub(super) solution: Solution,
    pub(super) maps: MapSolver<'a, M>,
    /// The map at hand, as its integers have it.
    at_hand: Solved,
    /// The map whose feature curves were not held apart, until it is tried.
    features_as_rounded: Option<Solved>,
    /// What untangling may spend.
    effort: UntangleOptions,
    is_relaxed: bool,
}

impl<'a, 'm, M: Fn() -> Monitor<'m>> FieldMap<'a, M> {
    /// The field that sees no details smaller than this, unless the guidance says otherwise, and its map
    /// with feature curves held apart. `seconds` are those of fields and of maps.
    pub(super) fn new(
        mesh: &'a TriangleMesh,
        given: &'a QuadOptions,
        features: &FeatureGraph,
        detail: f64,
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
        let chosen = choose_field(mesh, &options, features, monitor, [of_field, of_map])?;
        let problem = Cow::Owned(chosen.problem);
        let mut maps = MapSolver::new(mesh, problem, chosen.solver, &given.map, monitor);
        let (at_hand, features_as_rounded) = timed(of_map, || {
            let first = maps.solve()?;
            if is_hopeless(mesh, &first.map) {
                return Ok((first, None));
            }
            Ok(match maps.separate_features(&first)?.better {
                Some(apart) => (apart, Some(first)),
                None => {
                    maps.forget_separation();
                    (first, None)
                }
            })
        })?;
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
            is_relaxed: given.map.strategy == Strategy::Relax,
        })
    }

    /// Whether so much of the map at hand is folded that it is not worked on.
    pub(super) fn is_hopeless(&self, mesh: &TriangleMesh) -> bool {
        is_hopeless(mesh, &self.at_hand.map)
    }

    /// Whether there are integers that may be decided anew.
    pub(super) fn may_decide_anew(&self) -> bool {
        let integers = self.at_hand.solution.counts().reduced_integers;
        !self.is_relaxed && integers <= INTEGERS_TO_DECIDE_ANEW
    }

    /// Whether feature curves are held apart.
    pub(super) fn holds_features_apart(&self) -> bool {
        self.features_as_rounded.is_some()
    }

    /// Goes back to the map whose feature curves were not held apart.
    pub(super) fn forget_separation(&mut self) {
        self.maps.forget_separation();
        if let Some(solved) = self.features_as_rounded.take() {
            self.at_hand = solved;
        }
    }

    /// Untangling is to spend less where the quads of the map at hand conform.
    pub(super) fn limit_effort(&mut self, conforms: bool) {
        let most = UntangleOptions::default();
        self.effort.passes = match conforms {
            true => PASSES_FOR_FEATURES,
            false => most.passes,
        };
    }

    /// The map at hand, nothing done to it.
    pub(super) fn as_solved(&self) -> Result<(Solution, Untangled)> {
        let Solved { solution, map } = &self.at_hand;
        let map = self.maps.untouched(map.clone())?;
        Ok((solution.clone(), map))
    }

    /// The map at hand, its folds undone with the integers held.
    pub(super) fn untangled(&mut self) -> Result<(Solution, Untangled)> {
        let Solved { solution, map } = &self.at_hand;
        let map = self.maps.untangle(map, &self.effort)?;
        Ok((solution.clone(), map))
    }

    /// The map at hand, its cones held apart and then untangled; none where nothing holds them apart.
    pub(super) fn cones_apart(&mut self) -> Result<Option<(Solution, Untangled)>> {
        let rounds = self.effort.rounds;
        let separated = self.maps.separate_cones(&self.at_hand, rounds)?;
        let Some(Solved { solution, map }) = separated.better else {
            return Ok(None);
        };
        let map = self.maps.untangle(&map, &self.effort)?;
        Ok(Some((solution, map)))
    }
}
