//! The events for the callback, and its answers.

/// The callback's answer to an event.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Flow {
    /// Go on.
    Continue,
    /// End the solve; the best solution so far is kept. Calls of several solves, as
    /// [`quadrangulate`](crate::quad::quadrangulate()), end without a result.
    Cancel,
    /// Finish the run with the best integers so far. The search of this solve ends, later solves round
    /// their relaxation, and what is not needed for a result is left out. Before a first solution this is
    /// `Cancel`.
    Finish,
}

/// A stage of a run.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[non_exhaustive]
pub enum Stage {
    /// A problem is solved.
    Solve,
    /// The orientation field is solved for.
    Field,
    /// The map is solved for, and untangled.
    Map,
    /// Quads are extracted from the map.
    Quads,
    /// Quads are smoothed.
    Smooth,
}

impl Stage {
    /// The word for this stage.
    pub fn name(self) -> &'static str {
        match self {
            Stage::Solve => "solve",
            Stage::Field => "field",
            Stage::Map => "map",
            Stage::Quads => "quads",
            Stage::Smooth => "smooth",
        }
    }
}

/// A phase of the computation from a problem or a mesh to its result.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[non_exhaustive]
pub enum Phase {
    /// Elimination of the constraints.
    Eliminate,
    /// Ordering and factorization.
    Factor,
    /// The search for integers.
    Round,
    /// Movement of the continuous unknowns of a map with its integers fixed.
    Untangle,
    /// Extraction of quads from a map, and smoothing of the quads.
    Quads,
}

/// The kind of an event.
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
pub enum EventKind<'a> {
    /// The progress of a phase, from 0 to 1.
    Progress {
        /// The phase.
        phase: Phase,
        /// The part of it that is done.
        fraction: f64,
    },
    /// A line for a log.
    Log(&'a str),
    /// A better solution than any before.
    Improved,
    /// A better lower bound than any before.
    Raised,
}

/// An event for the callback, with the state of the solve.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Event<'a> {
    /// What happened.
    pub kind: EventKind<'a>,
    /// The stage of the run.
    pub stage: Stage,
    /// The share of the whole run that is done, from 0 to 1, by the times that runs take. It never falls.
    pub share: f64,
    /// Seconds since the solve began.
    pub seconds: f64,
    /// Energy of the best solution so far; infinite before the first.
    pub energy: f64,
    /// The best lower bound so far; minus infinity before the first.
    pub lower_bound: f64,
    /// `(energy - lower_bound) / |energy|`: 0 where they are equal, and infinite while either is infinite or
    /// an energy of 0 is above the bound.
    pub gap: f64,
}
