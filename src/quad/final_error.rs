//! Errors that end a call, and errors of one try that others may avoid.

use crate::error::Error;

/// Whether other options cannot avoid an error: those of the caller, and stops.
pub(super) fn is_final(error: &Error) -> bool {
    !matches!(
        error,
        Error::Unbounded { .. }
            | Error::NotConvex { .. }
            | Error::Infeasible { .. }
            | Error::NoIntegerSolution { .. }
            | Error::NotFinite { .. }
            | Error::Overflow { .. }
    )
}
