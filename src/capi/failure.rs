//! Why a call failed, kept as its thread's last error.

use std::cell::RefCell;

use super::status::roundel_status::{self, *};
use crate::error::Error;
use crate::proof::Fault;

/// The reason of a failure: an error of the library, or one that only the C interface can have.
#[derive(Debug)]
pub(super) enum Failure {
    Library(Error),
    /// An error of the library at an entry of a matrix, and the row of the entry.
    InRow {
        row: usize,
        error: Error,
    },
    /// A proof that is refused.
    Refused(Fault),
    Null(&'static str),
    Panic(String),
    Unusable,
}

/// The result of the body of an entry.
pub(super) type Outcome<T = ()> = Result<T, Failure>;

impl From<Error> for Failure {
    fn from(error: Error) -> Self {
        Failure::Library(error)
    }
}

/// The record of a thread's last call that failed.
#[derive(Default)]
pub(super) struct LastError {
    pub(super) message: String,
    pub(super) index: Option<usize>,
    pub(super) line: Option<usize>,
    pub(super) direction: Vec<f64>,
}

thread_local! {
    static LAST: RefCell<LastError> = RefCell::default();
}

impl Failure {
    /// Keeps the failure as this thread's last error and gives its number.
    pub(super) fn record(self) -> roundel_status {
        let (status, message) = match &self {
            Failure::Library(error) => (error.into(), error.to_string()),
            Failure::InRow { row, error } => (error.into(), format!("row {row}: {error}")),
            Failure::Refused(fault) => (
                ROUNDEL_ERROR_PROOF_REFUSED,
                format!("the proof is refused ({}): {fault}", fault.kind.code()),
            ),
            Failure::Null(what) => (ROUNDEL_ERROR_NULL_POINTER, format!("{what} is NULL")),
            Failure::Panic(text) => (
                ROUNDEL_ERROR_PANIC,
                format!("a defect of the library, please report it: {text}"),
            ),
            Failure::Unusable => (
                ROUNDEL_ERROR_UNUSABLE,
                "the handle was given up in an earlier error and can only be freed".into(),
            ),
        };
        let refused = match &self {
            Failure::Refused(fault) => Some(fault.line),
            _ => None,
        };
        let error = match self {
            Failure::Library(error) | Failure::InRow { error, .. } => Some(error),
            _ => None,
        };
        let last = LastError {
            message,
            index: error.as_ref().and_then(Error::index),
            line: error.as_ref().and_then(Error::line).or(refused),
            direction: match error {
                Some(
                    Error::Unbounded { direction, .. }
                    | Error::NotConvex { direction, .. }
                    | Error::NotConvexAt { direction, .. },
                ) => direction,
                _ => Vec::new(),
            },
        };
        // This fails only while the thread ends, when nobody can read the error any more.
        let _ = LAST.try_with(|slot| slot.replace(last));
        status
    }
}

/// Reads this thread's last error; None while the thread ends.
pub(super) fn last<T>(read: impl FnOnce(&LastError) -> T) -> Option<T> {
    LAST.try_with(|slot| read(&slot.borrow())).ok()
}
