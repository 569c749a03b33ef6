//! A branch: one unknown is below or above a value in the two children of a node.

use super::form::Interval;

/// A value this close to an integer counts as one.
pub(super) const INTEGRAL: f64 = 1e-6;

/// How a node came from its parent.
#[derive(Clone, Copy)]
pub(super) struct Branching {
    pub variable: u32,
    /// 0 for down, 1 for up.
    pub direction: usize,
    pub distance: f64,
}

/// The integer up to which the lower child goes. An integer value stays in the lower child.
pub(super) fn floor_between(limits: Interval, value: f64) -> f64 {
    if (value - value.round()).abs() <= INTEGRAL {
        let rounded = limits.nearest(value.round());
        if rounded == limits.upper {
            rounded - 1.0
        } else {
            rounded
        }
    } else {
        value.floor()
    }
}

/// The limits below (0) or above (1) a value.
pub(super) fn child_limits(limits: Interval, value: f64, direction: usize) -> Interval {
    let floor = floor_between(limits, value);
    if direction == 0 {
        Interval {
            upper: limits.upper.min(floor),
            ..limits
        }
    } else {
        Interval {
            lower: limits.lower.max(floor + 1.0),
            ..limits
        }
    }
}
