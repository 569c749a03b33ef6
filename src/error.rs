//! The error type of the library. Each variant names the element at fault.

/// The result of every fallible function of the library.
pub type Result<T> = std::result::Result<T, Error>;

/// The reason why a call failed. A call that fails changes nothing.
///
/// The text names the element at fault in words; [`Error::index`] and [`Error::line`] return it as a
/// number. Elements are counted from 0, lines of a file from 1.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum Error {
    /// A value that is not allowed in itself, such as a negative weight.
    #[error("{what}")]
    InvalidArgument {
        /// What is wrong, in words.
        what: String,
        /// Position of the value in its array, where it has one.
        index: Option<usize>,
    },
    /// Two arrays that belong together differ in length.
    #[error("{what}: expected {expected} entries, got {actual}")]
    LengthMismatch {
        /// The array.
        what: &'static str,
        /// The expected length.
        expected: usize,
        /// The actual length.
        actual: usize,
    },
    /// An index that is negative or too large.
    #[error("{what}: entry {position} is {value}, outside 0..{len}")]
    IndexOutOfRange {
        /// The array.
        what: &'static str,
        /// Position of the index in its array.
        position: usize,
        /// The index given.
        value: i64,
        /// One more than the largest index allowed.
        len: usize,
    },
    /// NaN or infinity where a number is needed.
    #[error("{what}: entry {position} is not a finite number")]
    NotFinite {
        /// The array.
        what: &'static str,
        /// Position of the number in its array.
        position: usize,
    },
    /// A problem without unknowns.
    #[error("the problem has no variables")]
    Empty,
    /// A count, or an integer of the solution, is too large to be represented.
    #[error("{what}")]
    Overflow {
        /// The quantity that overflows, in words.
        what: String,
        /// The element at fault, where there is one.
        index: Option<usize>,
    },
    /// A large array could not be allocated.
    #[error("not enough memory for {what}")]
    OutOfMemory {
        /// The array.
        what: &'static str,
    },
    /// No option has this name.
    #[error("there is no option '{name}'")]
    UnknownOption {
        /// The name given.
        name: String,
    },
    /// The option exists, but takes another type of value.
    #[error("option '{name}' takes {expected}")]
    OptionType {
        /// The option.
        name: &'static str,
        /// The type that it takes.
        expected: &'static str,
    },
    /// The option exists and has this type, but does not allow this value.
    #[error("option '{name}': {value} is outside {range}")]
    OptionRange {
        /// The option.
        name: &'static str,
        /// The value given.
        value: String,
        /// The values allowed.
        range: &'static str,
    },
    /// The constraints contradict each other.
    #[error("constraint {constraint}: {row} contradicts the other constraints")]
    Infeasible {
        /// The row that contradicts the others.
        constraint: usize,
        /// The row as the caller gave it.
        row: String,
    },
    /// Constraints, inequalities and bounds that no point satisfies together, or none with integers.
    #[error("no solution: {what}")]
    Contradiction {
        /// The rows and bounds that contradict each other, in words.
        what: String,
        /// The number of the first of them: of a constraint, an inequality or an unknown, as the text says.
        index: Option<usize>,
        /// All of them.
        elements: Vec<Conflicting>,
    },
    /// A constraint that no integer values of its unknowns satisfy.
    #[error("constraint {constraint}: {row} has no integer solution")]
    NoIntegerSolution {
        /// The row at fault.
        constraint: usize,
        /// The row as the caller gave it.
        row: String,
    },
    /// The objective decreases without limit.
    #[error(
        "the objective is unbounded below: it falls forever along a direction that moves variable {variable}"
    )]
    Unbounded {
        /// A variable that the direction moves (the one it moves most).
        variable: usize,
        /// The direction, one number for each variable, with largest absolute value 1.
        direction: Vec<f64>,
    },
    /// The objective curves downwards: Q is not positive semi-definite on the solutions of the constraints.
    #[error(
        "the objective is not convex: it curves downwards along a direction that moves variable {variable}"
    )]
    NotConvex {
        /// A variable that the direction moves (the one it moves most).
        variable: usize,
        /// The direction, one number for each variable, with largest absolute value 1.
        direction: Vec<f64>,
    },
    /// The same, seen in a file.
    #[error("line {line}: {what}")]
    NotConvexAt {
        /// The line, counted from 1.
        line: usize,
        /// What shows it, with the names of the file, and what can be done.
        what: String,
        /// A variable that the direction moves (the one it moves most).
        variable: usize,
        /// The direction, one number for each variable, with largest absolute value 1.
        direction: Vec<f64>,
    },
    /// The library does not solve problems of this kind.
    #[error("not supported: {what}")]
    NotSupported {
        /// What is not supported.
        what: String,
        /// The element at fault, where there is one.
        index: Option<usize>,
        /// The line of the file, where there is one.
        line: Option<usize>,
    },
    /// A file that does not follow its format.
    #[error("line {line}: {message}")]
    Parse {
        /// The line, counted from 1.
        line: usize,
        /// What is wrong with it.
        message: String,
    },
    /// A file that cannot be read or written.
    #[error("{message}")]
    Io {
        /// The system's reason, with the file's name.
        message: String,
    },
    /// A client of the solver refuses its input, such as a mesh.
    #[error(transparent)]
    Input(#[from] InputError),
    /// Cancelled by the caller before a first solution was found.
    #[error("cancelled before a first solution was found")]
    Cancelled,
    /// Out of time before a first solution was found.
    #[error("the time limit passed before a first solution was found")]
    TimeLimit,
    /// A limit other than that of time ended the search before a first solution was found.
    #[error("the limit of {what} ended the search before a first solution was found")]
    SearchLimit {
        /// What the limit is of: nodes, which the caller limits, the work of `auto`, or the precision of numbers:
        /// rounding errors alone decide whether there is a solution.
        what: &'static str,
    },
}

/// A row or the bounds of an unknown, of several that contradict each other.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Conflicting {
    /// The equality constraint of this number.
    Constraint(usize),
    /// The two-sided row of this number.
    Inequality(usize),
    /// The bounds of the unknown of this number, or its pin.
    Bounds(usize),
}

/// The reason why a client of the solver refuses its input, in a form that every layer can pass on.
///
/// The client has its own error type, which converts into this one.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[error("{message}")]
pub struct InputError {
    /// A word for the kind of error. It is the same in every version.
    pub code: &'static str,
    /// What is wrong, in words.
    pub message: String,
    /// The element at fault, counted from 0, where there is one.
    pub index: Option<usize>,
}

impl Error {
    /// A word for the kind of error. It is the same in every version.
    pub fn code(&self) -> &'static str {
        match self {
            Error::InvalidArgument { .. } => "invalid_argument",
            Error::LengthMismatch { .. } => "length_mismatch",
            Error::IndexOutOfRange { .. } => "index_out_of_range",
            Error::NotFinite { .. } => "not_finite",
            Error::Empty => "empty",
            Error::Overflow { .. } => "overflow",
            Error::OutOfMemory { .. } => "out_of_memory",
            Error::UnknownOption { .. } => "unknown_option",
            Error::OptionType { .. } => "option_type",
            Error::OptionRange { .. } => "option_range",
            Error::Infeasible { .. } | Error::Contradiction { .. } => "infeasible",
            Error::NoIntegerSolution { .. } => "no_integer_solution",
            Error::Unbounded { .. } => "unbounded",
            Error::NotConvex { .. } | Error::NotConvexAt { .. } => "not_convex",
            Error::NotSupported { .. } => "not_supported",
            Error::Parse { .. } => "parse",
            Error::Io { .. } => "io",
            Error::Input(error) => error.code,
            Error::Cancelled => "cancelled",
            Error::TimeLimit => "time_limit",
            Error::SearchLimit { .. } => "search_limit",
        }
    }

    /// Whether this tells how the run ended, and so names no element.
    pub(crate) fn is_end_of_run(&self) -> bool {
        matches!(
            self,
            Error::Cancelled
                | Error::TimeLimit
                | Error::SearchLimit { .. }
                | Error::OutOfMemory { .. }
        )
    }

    /// The element at fault: position in the array, constraint, or variable.
    pub fn index(&self) -> Option<usize> {
        match self {
            Error::InvalidArgument { index, .. }
            | Error::Overflow { index, .. }
            | Error::Contradiction { index, .. }
            | Error::NotSupported { index, .. } => *index,
            Error::IndexOutOfRange { position, .. } | Error::NotFinite { position, .. } => {
                Some(*position)
            }
            Error::Infeasible { constraint, .. } | Error::NoIntegerSolution { constraint, .. } => {
                Some(*constraint)
            }
            Error::Unbounded { variable, .. }
            | Error::NotConvex { variable, .. }
            | Error::NotConvexAt { variable, .. } => Some(*variable),
            Error::Input(error) => error.index,
            _ => None,
        }
    }

    /// The line of the file at fault, counted from 1.
    pub fn line(&self) -> Option<usize> {
        match self {
            Error::Parse { line, .. } | Error::NotConvexAt { line, .. } => Some(*line),
            Error::NotSupported { line, .. } => *line,
            _ => None,
        }
    }

    /// The direction that proves [`Error::Unbounded`], [`Error::NotConvex`] or [`Error::NotConvexAt`].
    pub fn direction(&self) -> Option<&[f64]> {
        match self {
            Error::Unbounded { direction, .. }
            | Error::NotConvex { direction, .. }
            | Error::NotConvexAt { direction, .. } => Some(direction),
            _ => None,
        }
    }
}

/// Refuses an array of another length than expected.
pub(crate) fn check_length(what: &'static str, actual: usize, expected: usize) -> Result<()> {
    match actual == expected {
        true => Ok(()),
        false => Err(Error::LengthMismatch {
            what,
            expected,
            actual,
        }),
    }
}
