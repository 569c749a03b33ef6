//! Flows with integers and separable convex costs, solved to optimality in polynomial time.
//!
//! Each unknown is an integer that occurs in at most two rows with coefficients +-1, as subdivisions of the arcs
//! of a quad layout and flows in networks do. Signs are arbitrary, so the rows and unknowns form a *bidirected*
//! graph (`edmonds1970`). Its integer programs are flows and matchings in one (`gabow1983`;
//! `heistermann2023` for quad layouts).
//!
//! ```text
//! Problem --form--> Network --flow--> half-integral optimum --units, matching--> optimum --certificate--> bound
//! ```
//!
//! | File | Step |
//! | --- | --- |
//! | `form` | recognises the problem |
//! | `graph` | the bidirected graph with exact costs |
//! | `flow` | the optimum of the relaxation: a flow on the double cover |
//! | `units` | the steps that lead to integers, as a perfect matching |
//! | `matching`, `blossoms` | the matching of least weight, from the multipliers of the flow |
//! | `certificate` | the lower bound that the multipliers prove |
//! | `derivation` | what a proof for strangers is made from |

mod blossoms;
mod certificate;
mod derivation;
mod flow;
mod form;
mod graph;
mod matching;
mod units;

use crate::error::Result;
use crate::linalg::sum_below;
use crate::monitor::Monitor;
use crate::problem::{Model, Problem};
use crate::proof::Derivation;
use form::Form;
use graph::UNITS;

/// Edges visited after which the method gives up.
const MOST_WORK: u64 = 20_000_000_000;

/// An optimal point.
#[derive(Debug, Clone)]
pub(crate) struct Optimum {
    pub values: Vec<f64>,
    /// No point has less energy.
    pub lower_bound: f64,
    /// Edges visited.
    pub work: u64,
}

/// Solves a problem of this form. None if it has another form, if it has no solution, which others can tell
/// why, and if the caller or a limit ends the search. `record` receives what a proof is made from.
///
/// # Errors
/// [`Error::OutOfMemory`](crate::Error::OutOfMemory).
pub(crate) fn solve(
    problem: &Problem,
    model: &Model,
    record: Option<&mut Derivation>,
    monitor: &mut Monitor,
) -> Result<Option<Optimum>> {
    let Some(form) = Form::of(problem, model)? else {
        return Ok(None);
    };
    let network = &form.network;
    let mut work = 0;
    let mut ends = |more: u64| {
        work += more;
        work > MOST_WORK || monitor.ends()
    };
    let Ok(halves) = flow::half_integral(network, &mut ends) else {
        return Ok(None);
    };
    let Ok(optimum) = units::integral(network, &halves, &mut ends) else {
        return Ok(None);
    };
    if let Some(record) = record {
        *record = derivation::derivation(&form, &halves, &optimum.x, &mut ends);
    }
    let mut bound = optimum.bound;
    let mut values = vec![0.0; model.variables()];
    for (&column, &x) in form.columns.iter().zip(&optimum.x) {
        if let Some(column) = column {
            values[column as usize] = x as f64;
        }
    }
    for &(column, x, cost) in &form.alone {
        values[column as usize] = x as f64;
        bound += cost;
    }
    let unit = 2f64.powi(network.exponent) / UNITS as f64;
    // The next float below is not above the integer, which was rounded to the nearest.
    let below = match bound {
        0 => 0.0,
        _ => (bound as f64).next_down() * unit,
    };
    Ok(Some(Optimum {
        values,
        lower_bound: sum_below(&[model.constant(), below]),
        work,
    }))
}

#[cfg(test)]
mod tests;
