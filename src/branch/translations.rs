//! Directions along which all points may move for ever at the same energy.
//!
//! Where only differences of integers count, or nothing holds integers from above, a solution is one of infinitely
//! many, and branch and bound never comes to an end: whatever it excludes of one, it leaves of another. Such a
//! direction `d` has whole numbers in integers and
//!
//! ```text
//! Q d = 0,    q'd = 0,    no d_j and no row of A d towards a bound or a side that is finite
//! ```
//!
//! With a point `x`, all `x + t d`, t = 0, 1, 2, ..., are points, and their energies are the same. Limits from which `d`
//! leads away hold none of them for ever: they are left out (a [`Departure`]), and the solution goes on along `d` until
//! it is within them. Along a direction that neither leads to a limit nor away from one, points may go forth and back:
//! an integer is held within as many values as the direction moves it by (a [`Hold`]).

use super::form::{Form, Interval};
use super::level::{self, Direction};
use crate::error::Result;
use crate::proof;

/// What is missing to a limit by less than this part of a step is rounding.
const CLOSE: f64 = 1e-8;

/// A form in which integers have lost their freedom, and the way back.
#[derive(Debug)]
pub(super) struct Held {
    pub form: Form,
    departures: Vec<Departure>,
    holds: Vec<Hold>,
}

/// A direction, and the limits from which it leads away: terms and their sides.
#[derive(Debug)]
struct Departure {
    direction: Direction,
    left_out: Vec<(Direction, Interval)>,
}

/// A direction, and the integer that is held for it between zero and the values that it moves by.
#[derive(Debug, PartialEq)]
struct Hold {
    direction: Direction,
    held: u32,
}

/// The form with integers held, if some can be.
///
/// # Errors
/// [`Error::OutOfMemory`](crate::Error::OutOfMemory), and the end of the call.
pub(super) fn held(form: &Form) -> Result<Option<Held>> {
    if !(0..form.dim()).any(|j| form.integer[j] && level::is_open(form, j)) {
        return Ok(None);
    }
    let mut form = form.clone();
    let mut departures = Vec::new();
    while let Some(departure) = departure(&mut form)? {
        departures.push(departure);
    }
    let mut holds = Vec::new();
    loop {
        let before = holds.len();
        for direction in level::forth_and_back(&form)? {
            holds.extend(hold(&mut form, direction));
        }
        if holds.len() == before {
            break;
        }
    }
    Ok((!holds.is_empty()).then_some(Held {
        form,
        departures,
        holds,
    }))
}

impl Held {
    /// The same point within the bounds of the integers that are held.
    pub fn moved(&self, mut point: Vec<f64>) -> Vec<f64> {
        for Hold { direction, held } in &self.holds {
            let step = step(direction, *held);
            let steps = -(point[*held as usize].round() / step.abs()).floor();
            go(&mut point, direction, steps * step.signum());
        }
        point
    }

    /// The same point within the limits that were left out.
    pub fn moved_back(&self, mut point: Vec<f64>) -> Vec<f64> {
        for departure in self.departures.iter().rev() {
            let steps = departure.missing(&point, |side| side);
            go(&mut point, &departure.direction, (steps - CLOSE).ceil());
        }
        point
    }

    /// A direction that leaves no limit, from one that may leave those that were left out.
    pub fn ray_moved_back(&self, mut ray: Vec<f64>) -> Vec<f64> {
        for departure in self.departures.iter().rev() {
            let steps = departure.missing(&ray, |_| 0.0);
            go(&mut ray, &departure.direction, steps);
        }
        ray
    }

    /// As a proof tells it, in the unknowns of the whole.
    pub fn of_whole(&self, members: &[u32]) -> Vec<proof::Translation> {
        let of_whole = |direction: &Direction, held: Option<u32>| proof::Translation {
            direction: direction
                .iter()
                .map(|&(j, d)| (members[j as usize], d))
                .collect(),
            held: held.map(|j| members[j as usize]),
        };
        let departures = self.departures.iter();
        let departures = departures.map(|departure| of_whole(&departure.direction, None));
        let holds = self.holds.iter();
        departures
            .chain(holds.map(|hold| of_whole(&hold.direction, Some(hold.held))))
            .collect()
    }
}

impl Departure {
    /// The steps from a point to what was left out, with sides changed by `to`; none if it is within.
    fn missing(&self, point: &[f64], to: impl Fn(f64) -> f64) -> f64 {
        let mut moves = vec![0.0; point.len()];
        go(&mut moves, &self.direction, 1.0);
        let steps = self.left_out.iter().map(|(terms, sides)| {
            let (value, rate) = (level::change(terms, point), level::change(terms, &moves));
            let side = if rate > 0.0 { sides.lower } else { sides.upper };
            (to(side) - value) / rate
        });
        steps.fold(0.0, f64::max)
    }
}

fn step(direction: &Direction, unknown: u32) -> f64 {
    let of_unknown = |&(j, d): &(u32, f64)| (j == unknown).then_some(d);
    direction.iter().find_map(of_unknown).unwrap_or(0.0)
}

fn go(point: &mut [f64], direction: &Direction, steps: f64) {
    for &(j, d) in direction {
        point[j as usize] += steps * d;
    }
}

/// Whether a move in this sense leads to a finite side.
fn leads_out(change: f64, sides: Interval) -> bool {
    (change > 0.0 && sides.upper.is_finite()) || (change < 0.0 && sides.lower.is_finite())
}

/// Leaves out limits, if some direction leads away from them.
fn departure(form: &mut Form) -> Result<Option<Departure>> {
    for direction in level::away(form)? {
        let left_out = left_by(form, &direction).filter(|left_out| !left_out.is_empty());
        let Some(left_out) = left_out else {
            continue;
        };
        for (i, change) in changes(form, &direction).into_iter().enumerate() {
            if change != 0.0 {
                form.row_limits[i] = Interval::ALL;
            }
        }
        for &(j, _) in &direction {
            form.limits[j as usize] = Interval::ALL;
            form.boxes[j as usize] = Interval::ALL;
        }
        return Ok(Some(Departure {
            direction,
            left_out,
        }));
    }
    Ok(None)
}

/// Holds an integer for a direction that changes nothing.
fn hold(form: &mut Form, direction: Direction) -> Option<Hold> {
    if !left_by(form, &direction)?.is_empty() {
        return None;
    }
    let integers = direction.iter().filter(|(j, _)| form.integer[*j as usize]);
    let &(held, step) = integers.min_by(|a, b| a.1.abs().total_cmp(&b.1.abs()))?;
    let values = Interval {
        lower: 0.0,
        upper: step.abs() - 1.0,
    };
    form.limits[held as usize] = values;
    form.boxes[held as usize] = values;
    Some(Hold { direction, held })
}

/// The changes of all rows along a direction.
fn changes(form: &Form, direction: &Direction) -> Vec<f64> {
    let mut moves = vec![0.0; form.dim()];
    go(&mut moves, direction, 1.0);
    let of_row = |i| level::sum(form.rows.row(i).map(|(j, a)| a * moves[j]));
    (0..form.rows.rows()).map(of_row).collect()
}

/// The limits from which a direction leads away, if all points may move along it for ever.
fn left_by(form: &Form, direction: &Direction) -> Option<Vec<(Direction, Interval)>> {
    let leaves = |&(j, d): &(u32, f64)| {
        leads_out(d, form.limits[j as usize]) || leads_out(d, form.boxes[j as usize])
    };
    if direction.iter().any(leaves) || !level::is_level(form, direction) {
        return None;
    }
    let own = |&(j, _): &(u32, f64)| (vec![(j, 1.0)], form.limits[j as usize]);
    let mut left_out: Vec<_> = direction.iter().map(own).collect();
    for (i, change) in changes(form, direction).into_iter().enumerate() {
        if leads_out(change, form.row_limits[i]) {
            return None;
        }
        if change != 0.0 {
            let terms = form.rows.row(i).map(|(j, a)| (j as u32, a));
            left_out.push((terms.collect(), form.row_limits[i]));
        }
    }
    left_out.retain(|(_, sides)| *sides != Interval::ALL);
    Some(left_out)
}

#[cfg(test)]
#[path = "translations_tests.rs"]
mod tests;
