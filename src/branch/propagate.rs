//! Bounds tightened through rows.
//!
//! The least value that a row takes within the bounds of its other unknowns bounds each unknown
//! (`savelsbergh1994`). Bounds are rounded outwards for unknowns that are real, and to integers for those that
//! are not.

use std::sync::Arc;

use super::form::{Form, Interval};
use crate::linalg::Sparse;
use crate::proof::Step;

/// An integer bound may be off by this before it is rounded.
const SLACK: f64 = 1e-7;

/// A real bound is only replaced by one that is better by this part of the width.
const WORTH: f64 = 1e-2;

/// Rows in both orders.
#[derive(Debug)]
pub(super) struct Propagator {
    columns: Arc<Sparse>,
    is_waiting: Vec<bool>,
    waiting: Vec<u32>,
    /// The changes of bounds, for a proof.
    pub steps: Option<Vec<Step>>,
}

/// The least and the largest value of a row: sums of the finite ends, and how many ends are infinite.
#[derive(Default, Clone, Copy)]
struct Activity {
    sum: f64,
    size: f64,
    infinite: usize,
}

impl Activity {
    fn add(&mut self, end: f64) {
        if end.is_finite() {
            self.sum += end;
            self.size += end.abs();
        } else {
            self.infinite += 1;
        }
    }

    fn replace(&mut self, old: f64, new: f64) {
        if old.is_finite() {
            self.sum -= old;
        } else {
            self.infinite -= 1;
        }
        self.add(new);
    }

    /// The activity without one of its ends, if that is finite.
    fn without(&self, end: f64) -> Option<f64> {
        match (self.infinite, end.is_finite()) {
            (0, true) => Some(self.sum - end),
            (1, false) => Some(self.sum),
            _ => None,
        }
    }
}

impl Propagator {
    pub fn new(form: &Form) -> Self {
        Propagator {
            columns: Arc::new(form.rows.transpose()),
            is_waiting: vec![false; form.rows.rows()],
            waiting: Vec::new(),
            steps: None,
        }
    }

    /// Another one for the same rows.
    pub fn another(&self) -> Self {
        Propagator {
            columns: Arc::clone(&self.columns),
            is_waiting: vec![false; self.is_waiting.len()],
            waiting: Vec::new(),
            steps: None,
        }
    }

    /// The rows that contain an unknown.
    fn wake(&mut self, variable: usize) {
        for (row, _) in self.columns.row(variable) {
            if !std::mem::replace(&mut self.is_waiting[row], true) {
                self.waiting.push(row as u32);
            }
        }
    }

    /// Tightens the limits through all rows.
    ///
    /// # Errors
    /// The row that no point within the limits satisfies.
    pub fn all(
        &mut self,
        form: &Form,
        limits: &mut [Interval],
        reals: bool,
        rounds: usize,
    ) -> Result<Vec<u32>, usize> {
        self.waiting = (0..form.rows.rows() as u32).collect();
        self.is_waiting.fill(true);
        self.run(form, limits, reals, rounds)
    }

    /// Tightens the limits through the rows of the unknowns `changed`, and through those of the unknowns
    /// whose limits change by that. Returns these unknowns.
    ///
    /// # Errors
    /// The row that no point within the limits satisfies.
    pub fn from(
        &mut self,
        form: &Form,
        limits: &mut [Interval],
        changed: &[u32],
        reals: bool,
    ) -> Result<Vec<u32>, usize> {
        for &j in changed {
            self.wake(j as usize);
        }
        self.run(form, limits, reals, 20)
    }

    fn run(
        &mut self,
        form: &Form,
        limits: &mut [Interval],
        reals: bool,
        rounds: usize,
    ) -> Result<Vec<u32>, usize> {
        let mut changed = Vec::new();
        for _ in 0..rounds {
            let rows = std::mem::take(&mut self.waiting);
            if rows.is_empty() {
                break;
            }
            for &row in &rows {
                self.is_waiting[row as usize] = false;
            }
            for (at, &row) in rows.iter().enumerate() {
                let before = changed.len();
                let steps = &mut self.steps;
                if tighten(form, row as usize, limits, reals, &mut changed, steps).is_err() {
                    self.clear();
                    return Err(rows[at] as usize);
                }
                for k in before..changed.len() {
                    self.wake(changed[k] as usize);
                }
            }
        }
        self.clear();
        changed.sort_unstable();
        changed.dedup();
        Ok(changed)
    }

    fn clear(&mut self) {
        for &row in &self.waiting {
            self.is_waiting[row as usize] = false;
        }
        self.waiting.clear();
    }
}

/// A row that cannot be satisfied.
struct Contradiction;

/// Tightens the limits of the unknowns of one row.
fn tighten(
    form: &Form,
    row: usize,
    limits: &mut [Interval],
    reals: bool,
    changed: &mut Vec<u32>,
    steps: &mut Option<Vec<Step>>,
) -> Result<(), Contradiction> {
    let sides = form.row_limits[row];
    let [mut least, mut most] = [Activity::default(); 2];
    for (j, a) in form.rows.row(row) {
        let (low, high) = ends(a, limits[j]);
        least.add(low);
        most.add(high);
    }
    let error = 1e-9 * least.size.max(most.size).max(1.0);
    if (least.infinite == 0 && least.sum > sides.upper + error.max(1e-9 * sides.upper.abs()))
        || (most.infinite == 0 && most.sum < sides.lower - error.max(1e-9 * sides.lower.abs()))
    {
        return Err(Contradiction);
    }
    if least.infinite > 1 && most.infinite > 1 {
        return Ok(());
    }
    for (j, a) in form.rows.row(row) {
        if !reals && !form.integer[j] || limits[j].is_point() {
            continue;
        }
        let (low, high) = ends(a, limits[j]);
        let room_above = least.without(low).map(|rest| sides.upper - rest);
        let room_below = most.without(high).map(|rest| sides.lower - rest);
        let error = 1e-12 * least.size.max(most.size).max(1.0);
        let (above, below) = (
            room_above.map_or(f64::INFINITY, |room| (room + error) / a),
            room_below.map_or(f64::NEG_INFINITY, |room| (room - error) / a),
        );
        let (lower, upper) = if a > 0.0 {
            (below, above)
        } else {
            (
                room_above.map_or(f64::NEG_INFINITY, |room| (room + error) / a),
                room_below.map_or(f64::INFINITY, |room| (room - error) / a),
            )
        };
        let new = if form.integer[j] {
            Interval {
                lower: limits[j].lower.max((lower - SLACK).ceil()),
                upper: limits[j].upper.min((upper + SLACK).floor()),
            }
        } else {
            better(limits[j], lower, upper)
        };
        if new.is_empty() {
            if form.integer[j] || new.lower - new.upper > 1e-7 * new.lower.abs().max(1.0) {
                record(steps, (row, j), limits[j], new);
                return Err(Contradiction);
            }
            continue;
        }
        if new != limits[j] {
            record(steps, (row, j), limits[j], new);
            let (new_low, new_high) = ends(a, new);
            least.replace(low, new_low);
            most.replace(high, new_high);
            limits[j] = new;
            changed.push(j as u32);
        }
    }
    Ok(())
}

/// Records what changes of the limits of an unknown.
fn record(
    steps: &mut Option<Vec<Step>>,
    (row, unknown): (usize, usize),
    old: Interval,
    new: Interval,
) {
    let Some(steps) = steps else {
        return;
    };
    let (row, unknown) = (row as u32, unknown as u32);
    if new.lower > old.lower {
        steps.push(Step::Lower(row, unknown, new.lower));
    }
    if new.upper < old.upper {
        steps.push(Step::Upper(row, unknown, new.upper));
    }
}

/// The limits of a real unknown with sides that are worth a change.
fn better(old: Interval, lower: f64, upper: f64) -> Interval {
    let width = old.width();
    let enough = |gain: f64| {
        if width.is_finite() {
            gain > WORTH * width
        } else {
            gain > 0.0
        }
    };
    Interval {
        lower: if lower.is_finite() && (!old.lower.is_finite() || enough(lower - old.lower)) {
            lower.max(old.lower)
        } else {
            old.lower
        },
        upper: if upper.is_finite() && (!old.upper.is_finite() || enough(old.upper - upper)) {
            upper.min(old.upper)
        } else {
            old.upper
        },
    }
}

/// The least and the largest value of a term.
fn ends(a: f64, limits: Interval) -> (f64, f64) {
    if a > 0.0 {
        (a * limits.lower, a * limits.upper)
    } else {
        (a * limits.upper, a * limits.lower)
    }
}
