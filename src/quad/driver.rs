//! From a mesh to quads: [`quadrangulate`], step by step.
//!
//! ```text
//! size, features
//! field       of several uses of curvature that whose map's relaxation is least distorted
//! map         its integers decided, feature curves that they put on one line held apart
//! quads       extracted from the map
//! next try    while quads have holes or lack features: the map untangled; cones held apart that its
//!             integers collapse; feature curves left where they were; a field that sees fewer details
//! smoothing
//! ```
//!
//! Each try starts from what the last one kept: [`MapSolver`](super::map_solver::MapSolver) holds the solver of the map's problem, the
//! separation constraints and the structure of its maps. [`Driver::next`] alone decides what is tried
//! next, and of all quads the first with the best [`Outcome`](super::outcome::Outcome) are kept.

use std::time::Instant;

use super::attempt::{Attempt, is_hopeless};
use super::compare::compare;
use super::field_map::FieldMap;
use super::missed::missed;
use super::options::QuadOptions;
use super::quadrangulation::timed;
use super::{QuadSeconds, Quadrangulation};
use crate::error::Result;
use crate::field::FieldProblem;
use crate::mesh::TriangleMesh;
use crate::mesh::features::FeatureGraph;
use crate::monitor::Monitor;
use crate::smooth::{SmoothOptions, smooth};
use crate::solve::Solution;
use crate::untangle::Untangled;

/// Which part of a quad's edge details attract no irregular vertices below, try after try, where nobody
/// says. Extraction copes with folds, and where details have irregular vertices of their own quads are
/// more even; fewer irregular vertices leave less to fold.
const DETAILS: [f64; 3] = [0.25, 1.0, 2.0];

/// Turns a mesh into quads. `monitor` makes one watcher for each step.
///
/// Whether the result is made of nothing but quads it tells itself
/// ([`is_conforming`](crate::extract::QuadMesh::is_conforming)).
/// Features so close that rounding puts them on one line are held apart where the quads conform then.
/// Extraction copes with nearly all folds; untangling is tried only if its quads do not conform, and
/// kept if they do then, or there is less to repair. Where they still do not, and nobody says how
/// large details are, the field is decided anew for larger ones.
///
/// # Errors
/// Those of [`solve_field`](crate::field::solve_field), [`solve`](crate::solve()),
/// [`SeamlessProblem::with_features`](crate::map::SeamlessProblem::with_features),
/// [`untangle`](crate::untangle::untangle), [`extract`](crate::extract) and [`smooth`].
pub fn quadrangulate<'a>(
    mesh: &TriangleMesh,
    options: &QuadOptions,
    monitor: impl Fn() -> Monitor<'a>,
) -> Result<Quadrangulation> {
    options.sizing.check(mesh)?;
    let mut driver = Driver {
        mesh,
        options,
        features: options.guidance.features(mesh)?,
        monitor: &monitor,
        started: Instant::now(),
        fields: Vec::new(),
        seconds: QuadSeconds::default(),
    };
    let mut best = driver.follow()?;
    let mut last = Try::LessDetail;
    while let Some(next) = driver.next(last, &best) {
        let found = match next {
            Try::Untangled => {
                let map = driver.at_hand().untangled()?;
                Some(driver.quads(map)?)
            }
            Try::ConesApart => match driver.at_hand().cones_apart()? {
                Some(map) => Some(driver.quads(map)?),
                None => None,
            },
            Try::FeaturesAsRounded => {
                driver.at_hand().forget_separation();
                Some(driver.as_solved()?)
            }
            Try::LessDetail => Some(driver.follow()?),
        };
        if let Some(found) = found
            && found.outcome < best.outcome
        {
            best = found;
        }
        last = next;
    }
    driver.finish(best)
}

/// What may be tried, in this order; the last two are followed by the first two again.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Try {
    /// The map at hand, its folds undone with the integers held.
    Untangled,
    /// The map at hand, its cones held apart and then untangled.
    ConesApart,
    /// The map whose feature curves are not held apart.
    FeaturesAsRounded,
    /// Another field, which sees fewer details, and its map.
    LessDetail,
}

/// What all tries share.
struct Driver<'a, M> {
    mesh: &'a TriangleMesh,
    options: &'a QuadOptions,
    features: FeatureGraph,
    monitor: &'a M,
    started: Instant,
    /// One for each size of details that was tried.
    fields: Vec<FieldMap<'a, M>>,
    seconds: QuadSeconds,
}

impl<'a, 'm, M: Fn() -> Monitor<'m>> Driver<'a, M> {
    /// What is tried after this, if anything.
    fn next(&self, last: Try, best: &Attempt) -> Option<Try> {
        let at_hand = self.fields.last()?;
        match last {
            _ if best.outcome.is_whole() => None,
            Try::LessDetail | Try::FeaturesAsRounded
                if self.options.untangle && !at_hand.is_hopeless(self.mesh) =>
            {
                Some(Try::Untangled)
            }
            Try::Untangled if at_hand.may_decide_anew() => Some(Try::ConesApart),
            _ if at_hand.holds_features_apart() => Some(Try::FeaturesAsRounded),
            _ => {
                let may_see_less = self.options.guidance.detail.is_none()
                    && self.fields.len() < DETAILS.len()
                    && !best.outcome.conforms()
                    && !is_hopeless(self.mesh, &best.map.map);
                may_see_less.then_some(Try::LessDetail)
            }
        }
    }

    /// The quads of the next field and its map.
    fn follow(&mut self) -> Result<Attempt> {
        let (mesh, given) = (self.mesh, self.options);
        let detail = DETAILS[self.fields.len()] * given.sizing.edge_length(mesh);
        let of_both = [&mut self.seconds.field, &mut self.seconds.map];
        let next = FieldMap::new(mesh, given, &self.features, detail, self.monitor, of_both)?;
        self.fields.push(next);
        self.as_solved()
    }

    /// The quads of the map at hand, nothing done to it.
    fn as_solved(&mut self) -> Result<Attempt> {
        let map = self.at_hand().as_solved()?;
        let found = self.quads(map)?;
        self.at_hand().limit_effort(found.outcome.conforms());
        Ok(found)
    }

    fn quads(&self, (solution, map): (Solution, Untangled)) -> Result<Attempt> {
        let field = self.fields.len() - 1;
        let features: Vec<usize> = self.features.edges().collect();
        let monitor = (self.monitor)();
        Attempt::new(self.mesh, &features, field, solution, map, monitor)
    }

    /// The field that was followed last.
    fn at_hand(&mut self) -> &mut FieldMap<'a, M> {
        let last = self.fields.len() - 1;
        &mut self.fields[last]
    }

    /// Smooths the quads, and compares strategies where that is asked for.
    fn finish(mut self, best: Attempt) -> Result<Quadrangulation> {
        let (mesh, options, monitor) = (self.mesh, self.options, self.monitor);
        let mut seconds = self.seconds;
        seconds.extract = self.started.elapsed().as_secs_f64() - seconds.field - seconds.map;
        let followed = self.fields.swap_remove(best.field);
        let features: Vec<usize> = self.features.edges().collect();
        let (mut quads, mut missed_features) = (best.quads, best.missed);
        if let Some(given) = &options.smooth {
            timed(&mut seconds.smooth, || {
                let given = SmoothOptions {
                    features: [&given.features[..], &features].concat(),
                    ..given.clone()
                };
                smooth(&mut quads, mesh, &given, &mut monitor())?;
                missed_features = missed(mesh, &quads, &missed_features);
                Ok(())
            })?;
        }
        let compared = timed(&mut seconds.compare, || {
            if options.compare.is_empty() {
                return Ok(Vec::new());
            }
            let field = FieldProblem::with_options(mesh, &followed.options)?;
            let both = [
                (field.problem(), &options.field),
                (followed.maps.problem().problem(), &options.map),
            ];
            compare(both, &options.compare, monitor)
        })?;
        Ok(Quadrangulation {
            quads,
            field: followed.field,
            field_solution: followed.solution,
            untangled: best.map,
            solution: best.solution,
            features,
            missed_features,
            compared,
            seconds,
        })
    }
}
