//! What the callback is told, and what it answers.

/// What the callback answers.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Flow {
    /// Go on.
    Continue,
    /// End the solve; the best solution so far is kept.
    Cancel,
}

/// A part of the way from a problem, or a mesh, to its result.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[non_exhaustive]
pub enum Phase {
    /// Elimination of the constraints.
    Eliminate,
    /// Ordering and factorization.
    Factor,
    /// The search for integers.
    Round,
    /// Motion of the continuous unknowns of a map while its integers are held.
    Untangle,
    /// Extraction of quads from a map, and their smoothing.
    Quads,
}

/// What an event tells.
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
pub enum EventKind<'a> {
    /// The progress of a part of the solve, from 0 to 1.
    Progress {
        /// The part.
        phase: Phase,
        /// How much of it is done.
        fraction: f64,
    },
    /// Something worth a line in a log.
    Log(&'a str),
    /// A better solution than any before.
    Improved,
    /// A better lower bound than any before.
    Raised,
}

/// One message to the callback, with where the solve stands.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Event<'a> {
    /// What happened.
    pub kind: EventKind<'a>,
    /// Seconds since the solve began.
    pub seconds: f64,
    /// Energy of the best solution so far; infinite before the first.
    pub energy: f64,
    /// The best lower bound so far; minus infinity before the first.
    pub lower_bound: f64,
    /// `(energy - lower_bound) / max(1, |energy|)`, infinite while either is.
    pub gap: f64,
}
