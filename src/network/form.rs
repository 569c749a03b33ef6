//! Recognises bidirected graphs: each unknown is an integer with its own cost and in at most two rows.
//!
//! A row may be a multiple of one with coefficients +-1, and +-2 where the unknown is in no other row.

use super::graph::{Edge, End, LARGEST, Network, common_exponent, in_units};
use crate::error::Result;
use crate::linalg::Sparse;
use crate::problem::{Model, Problem};
use crate::proof::Step;

/// A problem as a network.
#[derive(Debug)]
pub(super) struct Form {
    pub network: Network,
    /// The unknown that each edge is. None for slacks.
    pub columns: Vec<Option<u32>>,
    /// Unknowns in no row, each with its value and its cost.
    pub alone: Vec<(u32, i64, i128)>,
    /// By what each row was divided.
    pub units: Vec<f64>,
    /// The sides of rows that integers cannot reach, rounded.
    pub rounded: Vec<Step>,
}

/// Integers from the first to the second. None does not limit.
type Limits = (Option<i64>, Option<i64>);

impl Form {
    /// None if the problem has another form.
    ///
    /// # Errors
    /// [`Error::OutOfMemory`](crate::Error::OutOfMemory).
    pub fn of(problem: &Problem, model: &Model) -> Result<Option<Self>> {
        let separable = model.integer().iter().all(|integer| *integer)
            && model
                .hessian()
                .entries()
                .all(|(i, j, v)| i == j || v == 0.0);
        if !separable {
            return Ok(None);
        }
        let two_sided = problem.inequality_rows().to_sparse(model.variables())?;
        Ok(Self::with(problem, model, &two_sided))
    }

    fn with(problem: &Problem, model: &Model, two_sided: &Sparse) -> Option<Self> {
        let n = model.variables();
        let mut ends: Vec<Vec<(End, f64)>> = vec![Vec::new(); n];
        let mut demand = Vec::new();
        let mut slacks = Vec::new();
        let (mut units, mut rounded) = (Vec::new(), Vec::new());
        let limits = problem.inequality_rows();
        let equalities = model.constraints();
        for (matrix, is_equality) in [(equalities, true), (two_sided, false)] {
            for row in 0..matrix.rows() {
                let vertex = demand.len() as u32;
                let unit = add_row(matrix, row, vertex, &mut ends)?;
                units.push(unit);
                if is_equality {
                    let rhs = model.constraint_rhs()[row];
                    let wanted = (rhs / unit).round();
                    if wanted * unit != rhs || wanted.abs() > LARGEST as f64 {
                        return None;
                    }
                    demand.push(wanted as i64);
                } else {
                    let [lower, upper] = [limits.lower()[row], limits.upper()[row]];
                    // A quotient by another number than a power of two is rounded.
                    if unit.to_bits() << 12 != 0 {
                        return None;
                    }
                    let [least, most] =
                        [(lower / unit).ceil() * unit, (upper / unit).floor() * unit];
                    if least != lower {
                        rounded.push(Step::RowLower(vertex, least));
                    }
                    if most != upper {
                        rounded.push(Step::RowUpper(vertex, most));
                    }
                    slacks.push((vertex, within(lower / unit, upper / unit)?));
                    demand.push(0);
                }
            }
        }
        let root = demand.len() as u32;
        demand.push(0);
        let mut curvature = vec![0.0; n];
        for (i, _, v) in model.hessian().entries() {
            curvature[i as usize] += v;
        }
        let slope = model.gradient();
        let numbers = curvature.iter().chain(slope).copied();
        if curvature.iter().any(|q| *q < 0.0) || numbers.clone().any(|x| !x.is_finite()) {
            return None;
        }
        let exponent = common_exponent(numbers)?;
        let mut form = Form {
            network: Network {
                edges: Vec::new(),
                demand,
                exponent,
            },
            columns: Vec::new(),
            alone: Vec::new(),
            units,
            rounded,
        };
        for (j, ends) in ends.iter().enumerate() {
            let (lower, upper) = problem.limits_of(j);
            let pin = model.pinned()[j];
            let lower = pin.map_or(lower, |pin| lower.max(pin));
            let upper = pin.map_or(upper, |pin| upper.min(pin));
            let (lower, upper) = within(lower, upper)?;
            let both = ends_of(ends, root)?;
            let edge = Edge {
                ends: both,
                lower,
                upper,
                curvature: in_units(curvature[j], exponent),
                slope: in_units(slope[j], exponent),
            };
            if ends.is_empty() {
                let x = edge.minimiser(0)?;
                form.alone.push((j as u32, x, edge.cost(x)));
            } else {
                form.network.edges.push(edge);
                form.columns.push(Some(j as u32));
            }
        }
        for (vertex, (lower, upper)) in slacks {
            form.network.edges.push(Edge {
                ends: [(vertex, -1), (root, 1)].map(|(vertex, sign)| End { vertex, sign }),
                lower,
                upper,
                curvature: 0,
                slope: 0,
            });
            form.columns.push(None);
        }
        Some(form)
    }
}

/// Adds the ends that a row has, in multiples of its least coefficient, which is returned.
fn add_row(matrix: &Sparse, row: usize, vertex: u32, ends: &mut [Vec<(End, f64)>]) -> Option<f64> {
    let entries = matrix.row(row).filter(|(_, v)| *v != 0.0);
    let least = entries.clone().map(|(_, v)| v.abs());
    let unit = least.fold(f64::INFINITY, f64::min);
    let unit = if unit.is_finite() { unit } else { 1.0 };
    for (j, v) in entries {
        let multiple = v.abs() / unit;
        if multiple * unit != v.abs() || (multiple != 1.0 && multiple != 2.0) {
            return None;
        }
        let sign = if v > 0.0 { 1 } else { -1 };
        ends[j].push((End { vertex, sign }, multiple));
    }
    Some(unit)
}

/// The two ends of an unknown: in two rows, twice in one, or in one and at the root.
fn ends_of(ends: &[(End, f64)], root: u32) -> Option<[End; 2]> {
    let at_root = End {
        vertex: root,
        sign: 1,
    };
    match ends {
        [] => Some([at_root; 2]),
        [(end, 1.0)] => Some([*end, at_root]),
        [(end, _)] => Some([*end; 2]),
        [(a, 1.0), (b, 1.0)] => Some([*a, *b]),
        _ => None,
    }
}

/// The integers between two numbers. None if there is none, or a side is huge.
fn within(lower: f64, upper: f64) -> Option<Limits> {
    let [lower, upper] = [lower.ceil(), upper.floor()];
    let is_huge = |x: f64| x.is_finite() && x.abs() > LARGEST as f64;
    if lower.is_nan() || upper.is_nan() || lower > upper || is_huge(lower) || is_huge(upper) {
        return None;
    }
    let side = |x: f64| x.is_finite().then_some(x as i64);
    (lower < f64::INFINITY && upper > f64::NEG_INFINITY).then_some((side(lower), side(upper)))
}
