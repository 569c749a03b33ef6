//! From a mesh that is as fine as it has to be to quads by one set of options, step by step.
//!
//! ```text
//! size        that of all quads, or one for each face
//! field       the one of several whose map has the least distorted relaxation
//! map         integers are decided; feature curves that they put on one line are separated
//! quads       are extracted from the map
//! next try    while quads have holes or miss features: smaller quads on small parts that have lost
//!             theirs; untangle the map; separate collapsed cones; do not separate feature curves;
//!             use a field that moves no cones onto features, or sees fewer details; smaller quads around folds
//! smoothing
//! ```
//!
//! Each try starts from what the last one kept: [`MapSolver`](super::map_solver::MapSolver) holds the
//! solver of the map's problem, the separation rows and the structure of its maps.
//! [`Driver::next`] alone decides what is tried next. Among all quads with the best
//! [`Outcome`](super::outcome::Outcome) the first are kept.

use std::cell::Cell;
use std::time::Instant;

use super::attempt::{Attempt, is_hopeless};
use super::clearance::near_features;
use super::compare::compare;
use super::count::meet;
use super::field_map::FieldMap;
use super::final_error::is_final;
use super::missed::missed;
use super::options::QuadOptions;
use super::quadrangulation::timed;
use super::size_metric::SizeMetric;
use super::smaller::{SIZES, smaller_quads};
use super::stage_ends::stage_ends;
use super::{QuadSeconds, Quadrangulation};
use crate::error::{Error, Result};
use crate::field::FieldProblem;
use crate::map::Sizing;
use crate::mesh::features::FeatureGraph;
use crate::mesh::{ClosestPoint, TriangleMesh};
use crate::monitor::{Monitor, Stage, both, may_continue, optional};
use crate::smooth::{Shapes, SmoothOptions, smooth_to};
use crate::solve::Solution;
use crate::untangle::{FINER, Untangled};

/// The most integers of a map that are decided anew for its cones: for more it takes minutes and does not help.
const INTEGERS_TO_DECIDE_ANEW: usize = 600;

/// The same where quads conform and miss features alone, or were repaired next to them. Maps with more
/// have more features than quads of their size can follow.
const INTEGERS_FOR_FEATURES: usize = 200;

/// The default size of details, as a part of a quad's edge, try after try: smaller details attract no
/// irregular vertices. Extraction copes with folds, and quads are more even where details have irregular
/// vertices of their own; fewer irregular vertices cause fewer folds.
const DETAILS: [f64; 3] = [0.25, 1.0, 2.0];

/// The most passes over the mesh of all untangling together: a mesh where folds cannot be removed, as
/// around holes smaller than a quad, takes no longer than a few that untangle.
const PASSES: usize = 240;

/// The most times that quads around folds are made smaller.
const GRADINGS: usize = 4;

/// The length of the longest boundary loop around which quads are made smaller as well, in edges of quads
/// around it: the quads at a hole may close it where it is shorter.
const SMALL_HOLE: f64 = 8.0;

/// The most passes over the mesh that untangling makes after that, each time.
const PASSES_GRADED: usize = 12;

/// Quads around folds are not made smaller if there are more than so many for each that was asked for.
const MOST_QUADS: f64 = 4.0;

/// Of more folds than one in so many faces, untangling seldom leaves none: quads around them are made smaller
/// first.
const TANGLED_PART: usize = 20;

/// Meshes of more faces have as many visits of faces in all, and so fewer passes.
const FACES: usize = 10_000;

/// The same for a mesh that was tried before.
const FACES_AGAIN: usize = 4_000;

/// The tree of so many faces is worth a thread while quads are extracted.
const LARGE: usize = 1 << 13;

/// What a map takes besides what follows, in faces.
const FACES_OF_ANY: u64 = 100;

/// A dense lattice takes as long as one face for each of so many in the cube of its number of integers.
const CUBES_PER_FACE: u64 = 10_000;

/// Integers that are too many for a dense lattice take as long as so many times the faces.
const FACES_OF_MANY: u64 = 6;

/// How much is tried.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Effort {
    /// All of it.
    Full,
    /// The mesh has several components. Those whose quads do not conform are tried alone, so that only
    /// smaller quads are tried here.
    OfSeveral,
    /// The mesh, or all of which it is a component, was tried before: untangling makes fewer passes, and
    /// integers are not decided anew for features alone.
    Again,
}

/// The quads of a mesh in the order that it has.
pub(super) fn in_order<'a>(
    mesh: &TriangleMesh,
    features: FeatureGraph,
    options: &QuadOptions,
    effort: Effort,
    work: &Cell<u64>,
    monitor: &impl Fn() -> Monitor<'a>,
) -> Result<Quadrangulation> {
    monitor().run().plan(stage_ends(mesh, options));
    let faces = match effort {
        Effort::Again => FACES_AGAIN,
        Effort::Full | Effort::OfSeveral => FACES,
    };
    let most = PASSES * mesh.face_count().min(faces);
    let sizing = match SizeMetric::new(mesh, options, &features, &monitor())? {
        Some(metric) => metric.sizing,
        None => options.sizing.clone(),
    };
    let mut driver = Driver {
        mesh,
        options,
        effort,
        work,
        lengths: match &sizing {
            Sizing::Graded { lengths, .. } => Some(lengths.clone()),
            _ => None,
        },
        sizing,
        sizes: 0,
        details: 0,
        gradings: 0,
        was_off_features: false,
        current: 0,
        visits: most,
        most_visits: usize::MAX,
        features,
        monitor,
        started: Instant::now(),
        fields: Vec::new(),
        faces: None,
        seconds: QuadSeconds::default(),
    };
    let mut best = driver.follow(false)?;
    let mut last = Try::SmallerQuads;
    while let Some(next) = driver.next(last, &best) {
        let found = match optional(monitor, || driver.attempt(next, &best)) {
            Ok(None) => break,
            Ok(Some(found)) => found,
            Err(error) if is_final(&error) => return Err(error),
            // The quads that there are remain.
            Err(_) => None,
        };
        if let Some(found) = found
            && found.outcome < best.outcome
        {
            best = found;
        }
        last = next;
    }
    let (best, maps) = meet(&mut driver, best)?;
    driver.finish(best, maps)
}

/// The number of quads that was asked for, by the size of their edges where no number is given.
fn asked(mesh: &TriangleMesh, options: &QuadOptions) -> f64 {
    let edge = options.sizing.edge_length(mesh);
    mesh.surface_area() / (edge * edge)
}

/// The tries, in this order; untangling and the separation of cones follow again after each of the last
/// four.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Try {
    /// Use smaller quads on parts of the mesh that have lost theirs.
    SmallerQuads,
    /// Untangle the current map, with the integers fixed.
    Untangled,
    /// Separate the cones of the current map and untangle it.
    ConesApart,
    /// Use the map whose feature curves are not separated.
    FeaturesAsRounded,
    /// Use a field whose irregular vertices keep away from features, but do not move onto them, and its map.
    OffFeatures,
    /// Use another field, which sees fewer details, and its map.
    LessDetail,
    /// Use smaller quads around the folds of the best map.
    Graded,
}

/// The data that all tries share.
pub(super) struct Driver<'a, M> {
    pub(super) mesh: &'a TriangleMesh,
    pub(super) options: &'a QuadOptions,
    effort: Effort,
    /// What may still be spent, in faces whose field, map and quads are computed.
    pub(super) work: &'a Cell<u64>,
    /// The lengths of edges of quads that are aimed at in every face, where they vary.
    lengths: Option<Vec<f64>>,
    /// The current size of the quads.
    sizing: Sizing,
    /// How often it was changed.
    sizes: usize,
    /// The place in [`DETAILS`] of the next field.
    details: usize,
    /// How often quads around folds were made smaller.
    gradings: usize,
    /// Whether a field was tried whose irregular vertices do not move onto features.
    was_off_features: bool,
    /// The field whose map is at hand.
    pub(super) current: usize,
    /// The faces that untangling may still visit.
    visits: usize,
    /// The faces that one untangling may visit.
    pub(super) most_visits: usize,
    features: FeatureGraph,
    pub(super) monitor: &'a M,
    started: Instant,
    /// One for each size of quads or details that was tried.
    fields: Vec<FieldMap<'a, M>>,
    /// The tree of the faces that smoothing looks for closest points in, once there are quads.
    faces: Option<ClosestPoint>,
    seconds: QuadSeconds,
}

impl<'a, 'm, M: Fn() -> Monitor<'m>> Driver<'a, M> {
    /// The next try, if there is one.
    fn next(&self, last: Try, best: &Attempt) -> Option<Try> {
        let at_hand = self.fields.get(self.current)?;
        match last {
            _ if self.work.get() == 0 => None,
            _ if best.outcome.is_whole() && !self.may_mend(best) => None,
            Try::SmallerQuads if self.smaller(best).is_some() => Some(Try::SmallerQuads),
            _ if self.effort == Effort::OfSeveral && !best.outcome.conforms() => None,
            _ if self.has_too_many_features(best) => None,
            Try::SmallerQuads | Try::Graded if self.is_tangled(best) && self.may_grade(best) => {
                Some(Try::Graded)
            }
            Try::SmallerQuads
            | Try::LessDetail
            | Try::OffFeatures
            | Try::FeaturesAsRounded
            | Try::Graded
                if self.may_untangle() =>
            {
                Some(Try::Untangled)
            }
            Try::Untangled if self.passes() > 0 && self.may_decide_anew(best) => {
                Some(Try::ConesApart)
            }
            _ if at_hand.holds_features_apart() && !best.outcome.conforms() => {
                Some(Try::FeaturesAsRounded)
            }
            _ if best.outcome.conforms()
                && self.may_mend(best)
                && !self.was_off_features
                && at_hand.moves_away()
                && at_hand.may_decide_anew(INTEGERS_FOR_FEATURES) =>
            {
                Some(Try::OffFeatures)
            }
            _ if best.outcome.is_whole() => None,
            _ => {
                let may_see_less = self.options.guidance.detail.is_none()
                    && self.details + 1 < DETAILS.len()
                    && !best.outcome.conforms()
                    && !is_hopeless(self.mesh, &best.map.map);
                match may_see_less && self.gradings == 0 {
                    true => Some(Try::LessDetail),
                    false => self.may_grade(best).then_some(Try::Graded),
                }
            }
        }
    }

    /// Whether quads that are whole were repaired where irregular vertices keep away from features: repairs put others
    /// next to them.
    fn may_mend(&self, best: &Attempt) -> bool {
        best.quads.repaired > 0 && !self.fields[best.field].options.regular.is_empty()
    }

    /// Whether the integers of the map at hand may be decided anew for its cones.
    fn may_decide_anew(&self, best: &Attempt) -> bool {
        let most = match best.outcome.conforms() {
            true if self.effort == Effort::Again => return false,
            true => INTEGERS_FOR_FEATURES,
            false => INTEGERS_TO_DECIDE_ANEW,
        };
        self.fields[self.current].may_decide_anew(most)
    }

    /// Whether the map at hand may be untangled.
    pub(super) fn may_untangle(&self) -> bool {
        let at_hand = &self.fields[self.current];
        self.options.untangle && self.passes() > 0 && !at_hand.is_hopeless(self.mesh)
    }

    /// Whether the best map has so many folds that untangling has to wait.
    fn is_tangled(&self, best: &Attempt) -> bool {
        TANGLED_PART * best.map.flipped_after > self.mesh.face_count()
    }

    /// Whether integers that keep features apart tangle the map, and are so many that deciding them takes long.
    fn has_too_many_features(&self, best: &Attempt) -> bool {
        let of_best = &self.fields[best.field];
        !best.outcome.conforms()
            && self.is_tangled(best)
            && of_best.holds_features_apart()
            && !of_best.may_decide_anew(INTEGERS_TO_DECIDE_ANEW)
    }

    /// Whether smaller quads around folds may help.
    fn may_grade(&self, best: &Attempt) -> bool {
        self.gradings < GRADINGS
            && !best.outcome.conforms()
            && self.times_asked(best) <= MOST_QUADS
            && self.options.compare.is_empty()
    }

    /// How many quads there are for each that was asked for.
    fn times_asked(&self, best: &Attempt) -> f64 {
        best.quads.quads.len() as f64 / asked(self.mesh, self.options)
    }

    /// The quads of a try, if it can be made.
    pub(super) fn attempt(&mut self, next: Try, best: &Attempt) -> Result<Option<Attempt>> {
        Ok(match next {
            Try::SmallerQuads => match self.smaller(best) {
                Some(sizing) => {
                    self.sizing = sizing;
                    self.sizes += 1;
                    Some(self.follow(false)?)
                }
                None => None,
            },
            Try::Untangled => {
                self.enter(Stage::Map);
                let passes = self.passes();
                let map = self.at_hand().untangled(passes)?;
                Some(self.quads(map)?)
            }
            Try::ConesApart => {
                self.enter(Stage::Map);
                let passes = self.passes();
                match self.at_hand().cones_apart(passes)? {
                    Some(map) => Some(self.quads(map)?),
                    None => None,
                }
            }
            Try::OffFeatures => {
                self.was_off_features = true;
                Some(self.follow(true)?)
            }
            Try::FeaturesAsRounded => {
                self.at_hand().forget_separation();
                Some(self.as_solved()?)
            }
            Try::LessDetail => {
                self.details += 1;
                Some(self.follow(false)?)
            }
            Try::Graded => {
                self.gradings += 1;
                self.current = best.field;
                self.visits = self.visits.max(PASSES_GRADED * self.mesh.face_count());
                self.enter(Stage::Map);
                let edge =
                    self.sizing.edge_length(self.mesh) / FINER.powi(self.gradings as i32 - 1);
                let at_hand = &mut self.fields[best.field];
                match at_hand.grade(self.mesh, &best.map, SMALL_HOLE * edge)? {
                    true => Some(self.as_solved()?),
                    false => None,
                }
            }
        })
    }

    /// The quads of the next field and its map.
    fn follow(&mut self, off_features: bool) -> Result<Attempt> {
        let (mesh, of_map) = (self.mesh, &self.options.map);
        let given = QuadOptions {
            sizing: self.sizing.clone(),
            ..self.options.clone()
        };
        let detail = DETAILS[self.details] * given.sizing.edge_length(mesh);
        let seen = (detail, off_features);
        let of_both = [&mut self.seconds.field, &mut self.seconds.map];
        let (features, monitor) = (&self.features, self.monitor);
        let next = FieldMap::new(mesh, &given, of_map, features, seen, monitor, of_both)?;
        self.current = self.fields.len();
        self.fields.push(next);
        self.as_solved()
    }

    /// Smaller quads for the parts that have lost theirs, if that may help.
    fn smaller(&self, best: &Attempt) -> Option<Sizing> {
        let may_change = self.sizes < SIZES && !best.outcome.conforms();
        may_change.then(|| smaller_quads(self.mesh, &self.sizing, &best.quads))?
    }

    /// The passes over the mesh that the next untangling may make.
    fn passes(&self) -> usize {
        self.visits.min(self.most_visits) / self.mesh.face_count()
    }

    /// The quads of the current map as it is.
    pub(super) fn as_solved(&mut self) -> Result<Attempt> {
        let map = self.at_hand().as_solved()?;
        let found = self.quads(map)?;
        self.at_hand().limit_effort(found.outcome.conforms());
        Ok(found)
    }

    fn quads(&mut self, (solution, map): (Solution, Untangled)) -> Result<Attempt> {
        self.visits = self.visits.saturating_sub(map.visited);
        self.spend(&solution);
        self.enter(Stage::Quads);
        let field = self.current;
        let features: Vec<usize> = self.features.edges().collect();
        let asked = asked(self.mesh, self.options);
        let (mesh, mut monitor) = (self.mesh, (self.monitor)());
        let is_wanted = self.faces.is_none() && self.options.smooth.is_some();
        let is_large = is_wanted && mesh.face_count() >= LARGE;
        let extract = || {
            let to_follow = (&features[..], asked);
            Attempt::new(mesh, to_follow, field, solution, map, &mut monitor)
        };
        let tree = || is_wanted.then(|| ClosestPoint::new(mesh));
        let (found, tree) = both(is_large, extract, tree);
        // A call that ends leaves boxes undivided.
        let tree = tree.filter(|_| may_continue().is_ok());
        self.faces = self.faces.take().or(tree);
        found
    }

    /// Counts the work of a map.
    pub(super) fn spend(&self, solution: &Solution) {
        let spent = self.effort_of(solution.counts().reduced_integers);
        self.work.set(self.work.get().saturating_sub(spent));
    }

    /// What a map with this number of integers takes, in faces.
    fn effort_of(&self, integers: usize) -> u64 {
        let faces = self.mesh.face_count() as u64;
        let of_integers = match integers <= self.options.map.dense_integers {
            true => (integers as u64).pow(3) / CUBES_PER_FACE,
            false => FACES_OF_MANY * faces,
        };
        FACES_OF_ANY + faces + of_integers
    }

    fn enter(&self, stage: Stage) {
        (self.monitor)().run().enter(stage, 0, 1);
    }

    /// The field whose map is at hand.
    pub(super) fn at_hand(&mut self) -> &mut FieldMap<'a, M> {
        &mut self.fields[self.current]
    }

    /// Smooths the quads, and compares strategies if the options ask for it.
    fn finish(mut self, best: Attempt, maps_for_count: usize) -> Result<Quadrangulation> {
        let (mesh, options, monitor) = (self.mesh, self.options, self.monitor);
        let (mut seconds, faces) = (self.seconds, self.faces.take());
        seconds.extract = self.started.elapsed().as_secs_f64() - seconds.field - seconds.map;
        let followed = self.fields.swap_remove(best.field);
        // No smoothing mends a map that is folded nearly everywhere, and smoothing a million quads takes minutes.
        let is_worth_it = best.outcome.conforms() || self.times_asked(&best) <= MOST_QUADS;
        let features: Vec<usize> = self.features.edges().collect();
        let (mut quads, mut missed_features) = (best.quads, best.missed);
        if quads.faces().next().is_none() {
            // What was left out might have made some.
            if monitor().finishes() {
                return Err(Error::Cancelled);
            }
            return Err(Error::InvalidArgument {
                what: "no quads fit on this surface, nor did smaller ones: ask for more of them, or remesh it".into(),
                index: None,
            });
        }
        monitor().run().enter(Stage::Smooth, 0, 1);
        if let Some(given) = options.smooth.as_ref().filter(|_| is_worth_it) {
            timed(&mut seconds.smooth, || {
                let given = SmoothOptions {
                    features: [&given.features[..], &features].concat(),
                    ..given.clone()
                };
                let problem = followed.maps.problem();
                let proportions = |face| problem.proportions(mesh, face);
                let shapes = Shapes {
                    lengths: self.lengths.as_deref(),
                    proportions: (options.stretch > 0.0).then_some(&proportions),
                };
                smooth_to(&mut quads, mesh, faces, &given, shapes, &mut monitor())?;
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
            let compared = optional(monitor, || compare(both, &options.compare, monitor));
            Ok(compared?.unwrap_or_default())
        })?;
        let near_features = near_features(mesh, &followed.field, &followed.options);
        Ok(Quadrangulation {
            quads,
            field: followed.field,
            field_solution: followed.solution,
            untangled: best.map,
            solution: best.solution,
            features,
            feature_length: options.guidance.feature_length,
            missed_features,
            near_features,
            compared,
            seconds,
            refined: None,
            mirrored: None,
            apart: Vec::new(),
            paired: Vec::new(),
            maps_for_count,
        })
    }
}
