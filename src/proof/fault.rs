//! Why a proof is refused.

/// What a proof is refused for.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[non_exhaustive]
pub enum FaultKind {
    /// The text is no proof: another format, a line that cannot be read, an end that is missing.
    Format,
    /// A row or an unknown that does not exist.
    Reference,
    /// A problem that cannot be: a negative weight, a side that no number is within.
    Statement,
    /// The point is not within a row, a bound or the integers.
    Point,
    /// The energy is not that of the point.
    Energy,
    /// A bound that the row does not imply, or a direction along which points may not move for ever.
    Step,
    /// Parts that do not hold all free unknowns once, or that the objective or a row couples.
    Parts,
    /// A row that does not follow from others in both cases of a split.
    Cut,
    /// A switch that is no binary, or that leaves more than zero of its unknown where it is zero.
    Switch,
    /// An equation that does not give its unknown, a combination that is no integer, or a form that is not triangular.
    Lattice,
    /// The objective may curve downwards.
    NotConvex,
    /// A branch that is on no integer.
    Branch,
    /// A certificate of another size, or a multiplier that holds a side which does not exist.
    Certificate,
    /// A leaf whose certificate proves less than the proof claims.
    Bound,
    /// A leaf that may have a point, although it is called empty.
    NotEmpty,
    /// The parts together prove less than the proof claims.
    Claim,
    /// The proof is that of another problem.
    OtherProblem,
}

impl FaultKind {
    /// A word for the kind of fault. It is the same in every version.
    pub fn code(self) -> &'static str {
        match self {
            FaultKind::Format => "format",
            FaultKind::Reference => "reference",
            FaultKind::Statement => "statement",
            FaultKind::Point => "point",
            FaultKind::Energy => "energy",
            FaultKind::Step => "step",
            FaultKind::Parts => "parts",
            FaultKind::Cut => "cut",
            FaultKind::Switch => "switch",
            FaultKind::Lattice => "lattice",
            FaultKind::NotConvex => "not_convex",
            FaultKind::Branch => "branch",
            FaultKind::Certificate => "certificate",
            FaultKind::Bound => "bound",
            FaultKind::NotEmpty => "not_empty",
            FaultKind::Claim => "claim",
            FaultKind::OtherProblem => "other_problem",
        }
    }
}

/// The reason why a proof is refused, with the line of the file.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[error("line {line}: {message}")]
pub struct Fault {
    /// The line, counted from 1.
    pub line: usize,
    /// The kind of fault.
    pub kind: FaultKind,
    /// What is wrong, in words.
    pub message: String,
}

/// A fault of which the line is not known yet.
pub(super) type Wrong = (FaultKind, String);

/// The result of a step of the checker.
pub(super) type Checked<T> = std::result::Result<T, Wrong>;

/// A fault of this kind.
pub(super) fn wrong<T>(kind: FaultKind, message: impl Into<String>) -> Checked<T> {
    Err((kind, message.into()))
}
