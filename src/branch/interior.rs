//! Relaxations of large sparse forms by an interior-point method, the crate `clarabel` (`goulart2024`).
//!
//! The dual active-set method keeps a dense factor of the active rows. Where thousands of rows are active, a
//! factorization of the sparse optimality conditions takes less time for a whole solve than that factor for a step.
//! The bound of a node is computed from the multipliers, as always, and true whatever their errors are.

use super::dual_active_set::{Active, DualActiveSet};
use super::form::{Form, Interval};
#[cfg(feature = "interior-point")]
use super::safe_bound::is_contradiction;
#[cfg(feature = "interior-point")]
use crate::monitor::may_continue;
#[cfg(feature = "interior-point")]
use clarabel::algebra::CscMatrix;

/// The least number of rows. With fewer, the dual active-set method gains from the active rows of the node above:
/// `slay09m`, of 324 rows, would take longer inside; `netmod_kar1`, of 666, takes a fifth of the time.
const ROWS: usize = 500;

/// The largest number of entries for each unknown and row.
const ENTRIES: usize = 20;

/// Real bounds this close to each other fix their unknown.
pub(super) const CLOSE: f64 = 1e-9;

/// The relative precision.
#[cfg(feature = "interior-point")]
const PRECISION: f64 = 1e-9;

/// How a solve ended.
// Without the feature, all fail.
#[cfg_attr(not(feature = "interior-point"), allow(dead_code))]
pub(super) enum Ended {
    /// Near the minimiser.
    Solved {
        point: Vec<f64>,
        /// Rows with their multipliers.
        rows: Vec<Active>,
        work: u64,
    },
    /// No point is within all limits: these rows contradict each other within the boxes.
    Empty(Vec<(u32, f64)>),
    /// Because the call is to end.
    Stopped,
    /// Without a result.
    Failed,
}

impl DualActiveSet<'_> {
    /// Takes a minimiser and multipliers of another method. The next solve begins without active rows.
    pub fn take(&mut self, point: Vec<f64>, rows: Vec<Active>) {
        self.start_from(&[]);
        self.point = point;
        for (k, active) in rows.iter().enumerate() {
            self.place[active.row as usize] = k as u32;
        }
        self.active = rows;
    }
}

/// Whether relaxations of a form are for the interior-point method.
pub(super) fn is_for(form: &Form) -> bool {
    let rows = form.rows.rows();
    let entries = form.rows.len() + form.hessian.len();
    cfg!(feature = "interior-point") && rows >= ROWS && entries <= ENTRIES * (rows + form.dim())
}

#[cfg(not(feature = "interior-point"))]
pub(super) fn solve(_form: &Form, _limits: &[Interval], _boxes: &[Interval]) -> Ended {
    Ended::Failed
}

/// Minimises the form over the unknowns within `limits` and the rows. `boxes` are what limits and rows imply: they
/// fix unknowns and make rows redundant.
#[cfg(feature = "interior-point")]
pub(super) fn solve(form: &Form, limits: &[Interval], boxes: &[Interval]) -> Ended {
    use clarabel::solver::{
        DefaultSettings, DefaultSolver, IPSolver, SolverStatus, SupportedConeT,
    };

    let reduced = Reduced::new(form, limits, boxes);
    let mut point = reduced.values.clone();
    if reduced.members.is_empty() {
        let (rows, work) = (Vec::new(), form.rows.len() as u64);
        return Ended::Solved { point, rows, work };
    }
    let settings = DefaultSettings {
        verbose: false,
        max_threads: 1,
        presolve_enable: false,
        tol_gap_abs: PRECISION,
        tol_gap_rel: PRECISION,
        tol_feas: PRECISION,
        ..DefaultSettings::default()
    };
    let cones = [
        SupportedConeT::ZeroConeT(reduced.equations),
        SupportedConeT::NonnegativeConeT(reduced.sides.len() - reduced.equations),
    ];
    let Ok(mut solver) = DefaultSolver::new(
        &reduced.hessian,
        &reduced.gradient,
        &reduced.matrix,
        &reduced.bounds,
        &cones,
        settings,
    ) else {
        return Ended::Failed;
    };
    // On the thread of the call, which knows its end.
    solver.set_termination_callback(|_| may_continue().is_err());
    solver.solve();
    let found = &solver.solution;
    // A factorization for each iteration, of about the entries of the factor squared over its columns.
    let factor = u64::try_from(solver.info.linsolver.nnzL).unwrap_or(u64::MAX);
    let columns = (reduced.members.len() + reduced.sides.len()) as u64;
    let each = factor.saturating_mul(2 + factor / columns);
    let work = each.saturating_mul(u64::from(found.iterations) + 1);
    match found.status {
        SolverStatus::Solved | SolverStatus::AlmostSolved => {}
        SolverStatus::CallbackTerminated => return Ended::Stopped,
        SolverStatus::PrimalInfeasible => {
            let rows = (0..).zip(reduced.multipliers(form, &found.z));
            let rows: Vec<(u32, f64)> = rows.filter(|(_, m)| *m != 0.0).collect();
            return match is_contradiction(form, boxes, &rows) {
                true => Ended::Empty(rows),
                false => Ended::Failed,
            };
        }
        _ => return Ended::Failed,
    }
    for (&j, x) in reduced.members.iter().zip(&found.x) {
        point[j as usize] = boxes[j as usize].nearest(*x);
    }
    let mut multipliers = reduced.multipliers(form, &found.z);
    hold_fixed(form, boxes, &point, &mut multipliers);
    let rows = (0..).zip(multipliers).filter(|(_, m)| *m != 0.0);
    let rows = rows.map(|(row, multiplier)| Active {
        row,
        upper: multiplier > 0.0,
        multiplier,
    });
    let rows = rows.collect();
    Ended::Solved { point, rows, work }
}

/// What is left of a form without the unknowns that are fixed and the sides that always hold: `A x + s = b` with
/// `s = 0` for the equations, which come first, and `s >= 0` for the rest.
#[cfg(feature = "interior-point")]
struct Reduced {
    /// The values of fixed unknowns.
    values: Vec<f64>,
    /// The others.
    members: Vec<u32>,
    hessian: CscMatrix<f64>,
    gradient: Vec<f64>,
    matrix: CscMatrix<f64>,
    bounds: Vec<f64>,
    /// The row of each side, where the number of an unknown stands for its bounds, and whether it is an upper side.
    sides: Vec<(u32, bool)>,
    equations: usize,
}

#[cfg(feature = "interior-point")]
impl Reduced {
    fn new(form: &Form, limits: &[Interval], boxes: &[Interval]) -> Self {
        let n = form.dim();
        let is_fixed = |j: usize| boxes[j].width() <= CLOSE;
        let values = (0..n).map(|j| match is_fixed(j) {
            true => limits[j].nearest(boxes[j].lower),
            false => 0.0,
        });
        let values: Vec<f64> = values.collect();
        let members: Vec<u32> = (0..n as u32).filter(|&j| !is_fixed(j as usize)).collect();
        let mut place = vec![usize::MAX; n];
        for (at, &j) in members.iter().enumerate() {
            place[j as usize] = at;
        }
        let slopes = form.hessian.mul_symmetric(&values);
        let slope = |&j: &u32| form.gradient[j as usize] + slopes[j as usize];
        let entries = form.hessian.entries();
        let entries = entries.map(|(i, j, v)| (place[i as usize], place[j as usize], v));
        let upper = entries.filter(|(i, j, _)| *i != usize::MAX && *j != usize::MAX);
        let upper = upper.map(|(i, j, v)| (i.min(j), i.max(j), v));
        let mut system = System::default();
        for equations in [true, false] {
            for (i, sides) in form.row_limits.iter().enumerate() {
                if sides.is_point() != equations {
                    continue;
                }
                let (mut fixed, mut least, mut most) = (0.0, 0.0, 0.0);
                let mut row = Vec::new();
                for (j, a) in form.rows.row(i) {
                    if place[j] == usize::MAX {
                        fixed += a * values[j];
                        continue;
                    }
                    row.push((place[j], a));
                    let ends = [a * boxes[j].lower, a * boxes[j].upper];
                    least += ends[0].min(ends[1]);
                    most += ends[0].max(ends[1]);
                }
                let (lower, upper) = (sides.lower - fixed, sides.upper - fixed);
                if row.is_empty() {
                    continue;
                }
                if equations {
                    system.push(&row, 1.0, upper, ((n + i) as u32, true));
                    continue;
                }
                if upper.is_finite() && most > upper {
                    system.push(&row, 1.0, upper, ((n + i) as u32, true));
                }
                if lower.is_finite() && least < lower {
                    system.push(&row, -1.0, -lower, ((n + i) as u32, false));
                }
            }
            if equations {
                system.equations = system.sides.len();
            }
        }
        for (at, &j) in members.iter().enumerate() {
            let limits = limits[j as usize];
            if limits.upper.is_finite() {
                system.push(&[(at, 1.0)], 1.0, limits.upper, (j, true));
            }
            if limits.lower.is_finite() {
                system.push(&[(at, 1.0)], -1.0, -limits.lower, (j, false));
            }
        }
        let (rows, columns) = (system.sides.len(), members.len());
        Reduced {
            gradient: members.iter().map(slope).collect(),
            hessian: matrix(columns, columns, upper),
            matrix: matrix(rows, columns, system.entries.into_iter()),
            bounds: system.bounds,
            sides: system.sides,
            equations: system.equations,
            values,
            members,
        }
    }

    /// The multipliers of all bounds and rows of the form.
    fn multipliers(&self, form: &Form, found: &[f64]) -> Vec<f64> {
        let mut multipliers = vec![0.0; form.dim() + form.rows.rows()];
        for (k, (&(row, is_upper), &z)) in self.sides.iter().zip(found).enumerate() {
            let z = if k < self.equations { z } else { z.max(0.0) };
            multipliers[row as usize] += if is_upper { z } else { -z };
        }
        multipliers
    }
}

/// Gives the bounds of fixed unknowns the multipliers that cancel the slopes there.
#[cfg(feature = "interior-point")]
fn hold_fixed(form: &Form, boxes: &[Interval], point: &[f64], multipliers: &mut [f64]) {
    let n = form.dim();
    let mut slopes = form.hessian.mul_symmetric(point);
    for (slope, q) in slopes.iter_mut().zip(&form.gradient) {
        *slope += q;
    }
    for (i, j, a) in form.rows.entries() {
        slopes[j as usize] += multipliers[n + i as usize] * a;
    }
    for j in (0..n).filter(|&j| boxes[j].width() <= CLOSE) {
        multipliers[j] = -slopes[j];
    }
}

/// Rows as they come.
#[cfg(feature = "interior-point")]
#[derive(Default)]
struct System {
    entries: Vec<(usize, usize, f64)>,
    bounds: Vec<f64>,
    sides: Vec<(u32, bool)>,
    equations: usize,
}

#[cfg(feature = "interior-point")]
impl System {
    fn push(&mut self, row: &[(usize, f64)], sign: f64, bound: f64, side: (u32, bool)) {
        let at = self.sides.len();
        let entries = row.iter().map(|&(j, a)| (at, j, sign * a));
        self.entries.extend(entries);
        self.bounds.push(bound);
        self.sides.push(side);
    }
}

#[cfg(feature = "interior-point")]
fn matrix(
    rows: usize,
    columns: usize,
    entries: impl Iterator<Item = (usize, usize, f64)>,
) -> CscMatrix<f64> {
    let (mut i, mut j, mut v) = (Vec::new(), Vec::new(), Vec::new());
    for (row, column, value) in entries {
        i.push(row);
        j.push(column);
        v.push(value);
    }
    CscMatrix::new_from_triplets(rows, columns, i, j, v)
}

#[cfg(all(test, feature = "interior-point"))]
#[path = "interior_tests.rs"]
mod tests;
