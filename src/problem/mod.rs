//! The statement of a problem: the builder, its validation, and the model that the solver reads.

mod check;
mod cycles;
pub mod files;
mod limits;
pub mod lp;
mod matrix;
mod model;
pub mod mps;
mod objective;
mod pins;
pub mod qplib;
mod rows;
mod shared;
mod text;

pub use cycles::CycleHint;
pub(crate) use limits::Bounds;
pub use limits::Inequalities;
pub use matrix::{Layout, MatrixRef, Triangle};
pub use model::Model;
pub(crate) use objective::Objective;
pub use pins::Pins;
pub use rows::RowList;
pub(crate) use text::{limits_text, row_text};

use std::sync::Arc;

use crate::error::{Error, Result};
use check::{all_finite, finite, in_range, same_length};
use limits::check_both;
use matrix::lower_triangle;
use shared::own;

/// What memory is asked for.
const WHAT: &str = "the variables";

/// A mixed-integer quadratic problem under construction.
///
/// Parts may be added in any order and any number of times; quadratic and linear terms are summed. A call
/// that fails changes nothing. Copies share quadratic entries, rows and what is given for each unknown until one of
/// them changes it. The [crate] page states the problem and its signs.
#[derive(Debug, Clone)]
pub struct Problem {
    variables: usize,
    /// Entries of the lower triangle of Q. Duplicates are not summed yet.
    quadratic: Arc<Vec<(u32, u32, f64)>>,
    linear: Arc<Vec<f64>>,
    constant: f64,
    least_squares: RowList,
    weights: Arc<Vec<f64>>,
    constraints: RowList,
    inequalities: Inequalities,
    bounds: Bounds,
    integer: Arc<Vec<bool>>,
    pinned: Pins,
    guess: Arc<Vec<f64>>,
    cycles: Arc<CycleHint>,
}

impl Problem {
    /// A problem with `variables` unknowns, objective zero, no constraints and no integers.
    ///
    /// # Errors
    /// [`Error::Empty`] if there are no unknowns, [`Error::Overflow`] if there are more than 2^31 - 1,
    /// [`Error::OutOfMemory`].
    pub fn new(variables: usize) -> Result<Self> {
        if variables == 0 {
            return Err(Error::Empty);
        }
        if variables > i32::MAX as usize {
            return Err(Error::Overflow {
                what: format!("{variables} variables are more than 2^31 - 1"),
                index: None,
            });
        }
        Ok(Problem {
            variables,
            quadratic: Arc::default(),
            linear: Arc::new(filled(variables, 0.0)?),
            constant: 0.0,
            least_squares: RowList::default(),
            weights: Arc::default(),
            constraints: RowList::default(),
            inequalities: Inequalities::default(),
            bounds: Bounds::default(),
            integer: Arc::new(filled(variables, false)?),
            pinned: Pins::free(variables),
            guess: Arc::new(filled(variables, 0.0)?),
            cycles: Arc::default(),
        })
    }

    /// Number of unknowns.
    pub fn variables(&self) -> usize {
        self.variables
    }

    /// The number of unknowns and coefficients, by which memory is estimated.
    pub(crate) fn size(&self) -> usize {
        let rows = [
            &self.least_squares,
            &self.constraints,
            &self.inequalities.rows,
        ];
        let entries = rows.map(RowList::entries).iter().sum::<usize>();
        self.variables + self.quadratic.len() + entries
    }

    /// Entries of the lower triangle of Q as given. Duplicates are not summed.
    pub(crate) fn quadratic(&self) -> &[(u32, u32, f64)] {
        &self.quadratic
    }

    pub(crate) fn linear(&self) -> &[f64] {
        &self.linear
    }

    pub(crate) fn constant(&self) -> f64 {
        self.constant
    }

    /// Whether the objective is a sum of squares and a constant.
    pub(crate) fn is_sum_of_squares(&self) -> bool {
        self.quadratic.is_empty() && self.linear.iter().all(|&q| q == 0.0)
    }

    /// The least-squares rows as given, and their weights.
    pub(crate) fn least_squares(&self) -> (&RowList, &[f64]) {
        (&self.least_squares, &self.weights)
    }

    pub(crate) fn constraint_rows(&self) -> &RowList {
        &self.constraints
    }

    /// The two-sided rows as given.
    pub fn inequality_rows(&self) -> &Inequalities {
        &self.inequalities
    }

    /// The bounds of an unknown of the problem.
    pub(crate) fn limits_of(&self, variable: usize) -> (f64, f64) {
        self.bounds.of(variable)
    }

    /// Whether the problem has inequalities or bounds.
    pub(crate) fn is_limited(&self) -> bool {
        !self.inequalities.is_empty() || self.bounds.limit()
    }

    /// The same problem without its inequalities and bounds.
    pub(crate) fn without_limits(&self) -> Problem {
        Problem {
            inequalities: Inequalities::default(),
            bounds: Bounds::default(),
            ..self.clone()
        }
    }

    pub(crate) fn integers(&self) -> &[bool] {
        &self.integer
    }

    pub(crate) fn pins(&self) -> &Pins {
        &self.pinned
    }

    /// Number of equality constraints given so far.
    pub fn constraints(&self) -> usize {
        self.constraints.len()
    }

    /// Number of least-squares rows given so far.
    pub fn least_squares_rows(&self) -> usize {
        self.least_squares.len()
    }

    /// Adds entries to Q, in any order. Duplicates are summed. The objective contains 1/2 x'Qx.
    ///
    /// With [`Triangle::Full`] both triangles must be given and agree. Otherwise each entry of the given
    /// triangle also stands for its mirror image.
    ///
    /// # Errors
    /// [`Error::LengthMismatch`], [`Error::IndexOutOfRange`], [`Error::NotFinite`], and
    /// [`Error::InvalidArgument`] for an entry of the wrong triangle or without its mirror image.
    pub fn add_quadratic_triplets(
        &mut self,
        triangle: Triangle,
        rows: &[usize],
        cols: &[usize],
        values: &[f64],
    ) -> Result<()> {
        same_length("quadratic columns", rows.len(), cols.len())?;
        same_length("quadratic values", rows.len(), values.len())?;
        in_range("quadratic rows", rows, self.variables)?;
        in_range("quadratic columns", cols, self.variables)?;
        all_finite("quadratic values", values)?;
        let entries = rows.iter().zip(cols).zip(values);
        let entries = entries.map(|((&i, &j), &v)| (i as u32, j as u32, v));
        self.append_quadratic(triangle, entries)
    }

    /// Adds a matrix in compressed columns or rows to Q. See
    /// [`add_quadratic_triplets`](Self::add_quadratic_triplets); positions in errors are positions
    /// in `indices` and `values`.
    ///
    /// # Errors
    /// As for triplets, and [`Error::InvalidArgument`] for offsets that decrease.
    pub fn add_quadratic_matrix(&mut self, triangle: Triangle, matrix: &MatrixRef) -> Result<()> {
        matrix.validate("quadratic", self.variables, self.variables)?;
        self.append_quadratic(triangle, matrix.entries())
    }

    fn append_quadratic(
        &mut self,
        triangle: Triangle,
        entries: impl Iterator<Item = (u32, u32, f64)> + Clone,
    ) -> Result<()> {
        let mut lower = lower_triangle(triangle, self.variables, entries)?;
        if self.quadratic.is_empty() {
            self.quadratic = Arc::new(lower);
        } else {
            own(&mut self.quadratic, lower.len(), "quadratic entries")?.append(&mut lower);
        }
        Ok(())
    }

    /// Adds `values`, one for each unknown, to the linear term q.
    ///
    /// # Errors
    /// [`Error::LengthMismatch`], [`Error::NotFinite`].
    pub fn add_linear(&mut self, values: &[f64]) -> Result<()> {
        same_length("linear terms", self.variables, values.len())?;
        all_finite("linear terms", values)?;
        let linear = own(&mut self.linear, 0, WHAT)?;
        for (q, v) in linear.iter_mut().zip(values) {
            *q += v;
        }
        Ok(())
    }

    /// Adds `value` to the linear coefficient of one unknown.
    ///
    /// # Errors
    /// [`Error::IndexOutOfRange`], [`Error::NotFinite`].
    pub fn add_linear_term(&mut self, variable: usize, value: f64) -> Result<()> {
        in_range("variable", &[variable], self.variables)?;
        finite("linear term", value)?;
        own(&mut self.linear, 0, WHAT)?[variable] += value;
        Ok(())
    }

    /// Replaces the linear term q by `values`, one for each unknown. The contributions of least-squares rows
    /// to q stay.
    ///
    /// # Errors
    /// [`Error::LengthMismatch`], [`Error::NotFinite`].
    pub fn set_linear(&mut self, values: &[f64]) -> Result<()> {
        same_length("linear terms", self.variables, values.len())?;
        all_finite("linear terms", values)?;
        own(&mut self.linear, 0, WHAT)?.copy_from_slice(values);
        Ok(())
    }

    /// Replaces the right sides d of the constraints, one for each constraint, in their order.
    ///
    /// # Errors
    /// [`Error::LengthMismatch`], [`Error::NotFinite`].
    pub fn set_constraint_right_sides(&mut self, rhs: &[f64]) -> Result<()> {
        self.constraints.set_rhs("constraint right sides", rhs)
    }

    /// Replaces the right sides r of the least-squares rows, one for each row, in their order.
    ///
    /// # Errors
    /// [`Error::LengthMismatch`], [`Error::NotFinite`].
    pub fn set_least_squares_right_sides(&mut self, rhs: &[f64]) -> Result<()> {
        self.least_squares.set_rhs("least-squares right sides", rhs)
    }

    /// Replaces the constant of the objective. The contributions of least-squares rows to it stay.
    ///
    /// # Errors
    /// [`Error::NotFinite`].
    pub fn set_constant(&mut self, value: f64) -> Result<()> {
        finite("constant", value)?;
        self.constant = value;
        Ok(())
    }

    /// Adds `value` to the constant of the objective.
    ///
    /// # Errors
    /// [`Error::NotFinite`].
    pub fn add_constant(&mut self, value: f64) -> Result<()> {
        finite("constant", value)?;
        self.constant += value;
        Ok(())
    }

    /// Adds `weight * (sum_k coefficients[k] x[indices[k]] - rhs)^2` to the objective, without a factor of
    /// 1/2, and returns the number of the row. The row itself is kept as well.
    ///
    /// # Errors
    /// [`Error::LengthMismatch`], [`Error::IndexOutOfRange`], [`Error::NotFinite`], and
    /// [`Error::InvalidArgument`] for a negative weight.
    pub fn add_least_squares(
        &mut self,
        indices: &[usize],
        coefficients: &[f64],
        rhs: f64,
        weight: f64,
    ) -> Result<usize> {
        finite("least-squares weight", weight)?;
        if weight < 0.0 {
            return Err(Error::InvalidArgument {
                what: format!("least-squares weight {weight} is negative"),
                index: None,
            });
        }
        let weights = own(&mut self.weights, 1, "the weights")?;
        let row = self.least_squares.push(
            "least-squares row",
            self.variables,
            indices,
            coefficients,
            rhs,
        )?;
        weights.push(weight);
        Ok(row)
    }

    /// Adds `weights[i] * (A x - rhs)_i^2` for every row of the matrix and returns the number of the first
    /// row. Without weights, all weights are 1. After an error, nothing has been added.
    ///
    /// # Errors
    /// As for one row. Positions in errors are positions in the arrays given.
    pub fn add_least_squares_matrix(
        &mut self,
        matrix: &MatrixRef,
        rhs: &[f64],
        weights: Option<&[f64]>,
    ) -> Result<usize> {
        matrix.validate("least-squares", rhs.len(), self.variables)?;
        all_finite("least-squares right sides", rhs)?;
        if let Some(weights) = weights {
            same_length("least-squares weights", rhs.len(), weights.len())?;
            all_finite("least-squares weights", weights)?;
            if let Some(row) = weights.iter().position(|&weight| weight < 0.0) {
                return Err(Error::InvalidArgument {
                    what: format!(
                        "least-squares weights: entry {row} is {}, below zero",
                        weights[row]
                    ),
                    index: Some(row),
                });
            }
        }
        let kept = own(&mut self.weights, rhs.len(), "the weights")?;
        let first = self.least_squares.append(matrix, rhs)?;
        match weights {
            Some(weights) => kept.extend_from_slice(weights),
            None => kept.resize(kept.len() + rhs.len(), 1.0),
        }
        Ok(first)
    }

    /// Adds the constraint `sum_k coefficients[k] x[indices[k]] = rhs` and returns its number, which errors
    /// report. Duplicate indices are summed.
    ///
    /// # Errors
    /// [`Error::LengthMismatch`], [`Error::IndexOutOfRange`], [`Error::NotFinite`].
    pub fn add_constraint(
        &mut self,
        indices: &[usize],
        coefficients: &[f64],
        rhs: f64,
    ) -> Result<usize> {
        self.constraints
            .push("constraint", self.variables, indices, coefficients, rhs)
    }

    /// Adds the constraints `C x = rhs`, one for each row of the matrix, and returns the number of the first.
    ///
    /// # Errors
    /// As for one constraint. Positions in errors are positions in the arrays of the matrix.
    pub fn add_constraint_matrix(&mut self, matrix: &MatrixRef, rhs: &[f64]) -> Result<usize> {
        matrix.validate("constraint", rhs.len(), self.variables)?;
        all_finite("constraint right sides", rhs)?;
        self.constraints.append(matrix, rhs)
    }

    /// Adds the two-sided row `lower <= sum_k coefficients[k] x[indices[k]] <= upper` and returns its number
    /// among the inequalities, which errors report. A side that does not limit is infinite. Duplicate indices
    /// are summed.
    ///
    /// # Errors
    /// [`Error::LengthMismatch`], [`Error::IndexOutOfRange`], [`Error::NotFinite`], and
    /// [`Error::InvalidArgument`] for a lower side above the upper side, or a side that is NaN.
    pub fn add_inequality(
        &mut self,
        indices: &[usize],
        coefficients: &[f64],
        lower: f64,
        upper: f64,
    ) -> Result<usize> {
        let (what, sides) = ("inequality", [&[lower][..], &[upper]]);
        check_both(what, 1, sides)?;
        self.inequalities.reserve(1)?;
        let rows = &mut self.inequalities.rows;
        let row = rows.push(what, self.variables, indices, coefficients, 0.0)?;
        self.inequalities.append_sides(sides[0], sides[1]);
        Ok(row)
    }

    /// Adds the two-sided rows `lower <= A x <= upper`, one for each row of the matrix, and returns the number
    /// of the first.
    ///
    /// # Errors
    /// As for one row. Positions in errors are positions in the arrays given.
    pub fn add_inequality_matrix(
        &mut self,
        matrix: &MatrixRef,
        lower: &[f64],
        upper: &[f64],
    ) -> Result<usize> {
        matrix.validate("inequality", lower.len(), self.variables)?;
        check_both("inequality sides", lower.len(), [lower, upper])?;
        self.inequalities.reserve(lower.len())?;
        let zeros = filled(lower.len(), 0.0)?;
        let first = self.inequalities.rows.append(matrix, &zeros)?;
        self.inequalities.append_sides(lower, upper);
        Ok(first)
    }

    /// Replaces the sides of the inequalities, one lower and one upper side for each, in their order.
    ///
    /// # Errors
    /// [`Error::LengthMismatch`], and [`Error::InvalidArgument`] for a lower side above the upper side, or a
    /// side that is NaN.
    pub fn set_inequality_sides(&mut self, lower: &[f64], upper: &[f64]) -> Result<()> {
        self.inequalities.set_sides(lower, upper)
    }

    /// Number of inequalities (two-sided rows) given so far.
    pub fn inequalities(&self) -> usize {
        self.inequalities.len()
    }

    /// Sets the bounds `lower[k] <= x[variables[k]] <= upper[k]`. They replace earlier bounds of these
    /// unknowns. A bound that does not limit is infinite; unknowns have no bounds until they are set.
    ///
    /// # Errors
    /// [`Error::LengthMismatch`], [`Error::IndexOutOfRange`], and [`Error::InvalidArgument`] for a lower
    /// bound above the upper bound, or a bound that is NaN.
    pub fn set_bounds(&mut self, variables: &[usize], lower: &[f64], upper: &[f64]) -> Result<()> {
        in_range("bounded variables", variables, self.variables)?;
        check_both("bounds", variables.len(), [lower, upper])?;
        if self.bounds.lower.is_empty() {
            let [below, above] = [f64::NEG_INFINITY, f64::INFINITY];
            self.bounds = Bounds {
                lower: filled(self.variables, below)?,
                upper: filled(self.variables, above)?,
            };
        }
        for ((&i, &l), &u) in variables.iter().zip(lower).zip(upper) {
            self.bounds.lower[i] = l;
            self.bounds.upper[i] = u;
        }
        Ok(())
    }

    /// The bounds of an unknown, infinite where there is none.
    ///
    /// # Errors
    /// [`Error::IndexOutOfRange`].
    pub fn bounds(&self, variable: usize) -> Result<(f64, f64)> {
        in_range("variable", &[variable], self.variables)?;
        Ok(self.bounds.of(variable))
    }

    /// Makes unknowns binary: integer, with the bounds 0 and 1.
    ///
    /// # Errors
    /// [`Error::IndexOutOfRange`].
    pub fn set_binaries(&mut self, variables: &[usize]) -> Result<()> {
        let count = variables.len();
        self.set_bounds(variables, &filled(count, 0.0)?, &filled(count, 1.0)?)?;
        self.set_integers(variables)
    }

    /// Makes unknowns integer. An unknown may be named more than once.
    ///
    /// # Errors
    /// [`Error::IndexOutOfRange`].
    pub fn set_integers(&mut self, variables: &[usize]) -> Result<()> {
        in_range("integer variables", variables, self.variables)?;
        let integer = own(&mut self.integer, 0, WHAT)?;
        for &i in variables {
            integer[i] = true;
        }
        Ok(())
    }

    /// A copy without integers.
    pub(crate) fn relaxed(&self) -> Problem {
        let mut relaxed = self.clone();
        relaxed.integer = Arc::new(vec![false; self.variables]);
        relaxed
    }

    /// Fixes an unknown to a value. If the unknown is integer at the time of the solve, its value must be an
    /// integer.
    ///
    /// # Errors
    /// [`Error::IndexOutOfRange`], [`Error::NotFinite`].
    pub fn pin(&mut self, variable: usize, value: f64) -> Result<()> {
        in_range("variable", &[variable], self.variables)?;
        finite("pinned value", value)?;
        self.pinned.set(variable, Some(value), WHAT)
    }

    /// Frees a pinned unknown. An unknown that is free stays free.
    ///
    /// # Errors
    /// [`Error::IndexOutOfRange`].
    pub fn unpin(&mut self, variable: usize) -> Result<()> {
        in_range("variable", &[variable], self.variables)?;
        self.pinned.set(variable, None, WHAT)
    }

    /// Sets the initial guess, one value for each unknown (zero if not set). Unknowns that the objective does
    /// not determine keep these values.
    ///
    /// # Errors
    /// [`Error::LengthMismatch`], [`Error::NotFinite`].
    pub fn set_guess(&mut self, values: &[f64]) -> Result<()> {
        same_length("initial guess", self.variables, values.len())?;
        all_finite("initial guess", values)?;
        own(&mut self.guess, 0, WHAT)?.copy_from_slice(values);
        Ok(())
    }

    /// Sets short cycles that the caller knows: sums of least-squares rows, each with sign 1 or -1, in which
    /// all continuous unknowns cancel. Rings around the vertices of a mesh are such cycles. The entries of
    /// cycle `k` are `offsets[k]..offsets[k + 1]` of `rows` and `signs`.
    ///
    /// A hint never changes the problem. If the continuous unknowns of a hint do not cancel, a solve ignores
    /// the hint and reports that in its log. A later hint replaces an earlier one.
    ///
    /// # Errors
    /// [`Error::LengthMismatch`], [`Error::IndexOutOfRange`] for a row that does not exist yet,
    /// [`Error::InvalidArgument`] for other signs or offsets that do not grow.
    pub fn hint_cycles(&mut self, offsets: &[usize], rows: &[usize], signs: &[i8]) -> Result<()> {
        let hint = CycleHint::new(self.least_squares.len(), offsets, rows, signs)?;
        self.cycles = Arc::new(hint);
        Ok(())
    }
}

fn filled<T: Clone>(len: usize, value: T) -> Result<Vec<T>> {
    let mut v = Vec::new();
    v.try_reserve_exact(len)
        .map_err(|_| Error::OutOfMemory { what: WHAT })?;
    v.resize(len, value);
    Ok(v)
}
