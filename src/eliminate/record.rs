//! The record of an elimination, which is all that new right sides and pinned values need.

use super::stack::Stack;
use super::steps::Step;
use super::unknowns::Unknowns;

/// The steps of an elimination and the substitutions that they made.
#[derive(Debug)]
pub(super) struct Record {
    /// The power of two by which each constraint was multiplied.
    pub scales: Vec<f64>,
    /// Whether each of the caller's unknowns was pinned.
    pub pinned: Vec<bool>,
    pub unknowns: Unknowns,
    pub stack: Stack,
    pub steps: Vec<Step>,
}
