//! What an elimination did, written down: all that right sides and pinned values need to follow it.

use super::stack::Stack;
use super::steps::Step;
use super::unknowns::Unknowns;

/// The steps of an elimination and the substitutions that they made.
#[derive(Debug)]
pub(super) struct Record {
    /// The power of two that each constraint was multiplied by.
    pub scales: Vec<f64>,
    /// Which of the caller's unknowns were pinned.
    pub pinned: Vec<bool>,
    pub unknowns: Unknowns,
    pub stack: Stack,
    pub steps: Vec<Step>,
}
