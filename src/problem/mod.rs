//! Stating a problem: the builder, its validation, and the model that the solver works on.

mod check;
mod cycles;
mod matrix;
mod model;
pub mod mps;
mod rows;
mod text;

pub use cycles::CycleHint;
pub use matrix::{Layout, MatrixRef, Triangle};
pub use model::Model;
pub use rows::RowList;
pub(crate) use text::row_text;

use std::sync::Arc;

use crate::error::{Error, Result};
use check::{all_finite, finite, in_range, same_length};
use matrix::lower_triangle;

/// A mixed-integer quadratic problem under construction.
///
/// Parts may be given in any order and any number of times: quadratic and linear terms add up.
/// A call that fails changes nothing. Rows of least squares are shared with copies until one of them
/// changes. See the [crate] for the problem and its signs.
#[derive(Debug, Clone)]
pub struct Problem {
    variables: usize,
    /// Entries of the lower triangle of Q, duplicates not yet summed.
    quadratic: Vec<(u32, u32, f64)>,
    linear: Vec<f64>,
    constant: f64,
    least_squares: Arc<RowList>,
    weights: Arc<Vec<f64>>,
    constraints: RowList,
    integer: Vec<bool>,
    pinned: Vec<Option<f64>>,
    guess: Vec<f64>,
    cycles: Arc<CycleHint>,
}

impl Problem {
    /// A problem of `variables` unknowns with objective zero, no constraint and no integers.
    ///
    /// # Errors
    /// [`Error::Empty`] for no unknowns, [`Error::Overflow`] beyond 2^31 - 1 of them,
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
            quadratic: Vec::new(),
            linear: filled(variables, 0.0)?,
            constant: 0.0,
            least_squares: Arc::default(),
            weights: Arc::default(),
            constraints: RowList::default(),
            integer: filled(variables, false)?,
            pinned: filled(variables, None)?,
            guess: filled(variables, 0.0)?,
            cycles: Arc::default(),
        })
    }

    /// Number of unknowns.
    pub fn variables(&self) -> usize {
        self.variables
    }

    /// Entries of the lower triangle of Q as given, duplicates not summed.
    pub(crate) fn quadratic(&self) -> &[(u32, u32, f64)] {
        &self.quadratic
    }

    pub(crate) fn linear(&self) -> &[f64] {
        &self.linear
    }

    pub(crate) fn constant(&self) -> f64 {
        self.constant
    }

    /// The least-squares rows as given, and their weights.
    pub(crate) fn least_squares(&self) -> (&RowList, &[f64]) {
        (&self.least_squares, &self.weights)
    }

    pub(crate) fn constraint_rows(&self) -> &RowList {
        &self.constraints
    }

    pub(crate) fn integers(&self) -> &[bool] {
        &self.integer
    }

    pub(crate) fn pins(&self) -> &[Option<f64>] {
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

    /// Adds entries to Q (which stands in the objective as 1/2 x'Qx), in any order, duplicates
    /// summed.
    ///
    /// With [`Triangle::Full`] both triangles must be given and agree; with the others the entry
    /// of the given triangle stands for both.
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
        self.quadratic
            .try_reserve(lower.len())
            .map_err(|_| Error::OutOfMemory {
                what: "quadratic entries",
            })?;
        self.quadratic.append(&mut lower);
        Ok(())
    }

    /// Adds `values` (one an unknown) to the linear term q.
    ///
    /// # Errors
    /// [`Error::LengthMismatch`], [`Error::NotFinite`].
    pub fn add_linear(&mut self, values: &[f64]) -> Result<()> {
        same_length("linear terms", self.variables, values.len())?;
        all_finite("linear terms", values)?;
        for (q, v) in self.linear.iter_mut().zip(values) {
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
        self.linear[variable] += value;
        Ok(())
    }

    /// Replaces the linear term q by `values`, one an unknown. What least-squares rows add to it is
    /// not touched.
    ///
    /// # Errors
    /// [`Error::LengthMismatch`], [`Error::NotFinite`].
    pub fn set_linear(&mut self, values: &[f64]) -> Result<()> {
        same_length("linear terms", self.variables, values.len())?;
        all_finite("linear terms", values)?;
        self.linear.copy_from_slice(values);
        Ok(())
    }

    /// Replaces the right sides d of the constraints, one a constraint, in their order.
    ///
    /// # Errors
    /// [`Error::LengthMismatch`], [`Error::NotFinite`].
    pub fn set_constraint_right_sides(&mut self, rhs: &[f64]) -> Result<()> {
        self.constraints.set_rhs("constraint right sides", rhs)
    }

    /// Replaces the right sides r of the least-squares rows, one a row, in their order.
    ///
    /// # Errors
    /// [`Error::LengthMismatch`], [`Error::NotFinite`].
    pub fn set_least_squares_right_sides(&mut self, rhs: &[f64]) -> Result<()> {
        Arc::make_mut(&mut self.least_squares).set_rhs("least-squares right sides", rhs)
    }

    /// Replaces the constant of the objective; those of least-squares rows stay.
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

    /// Adds `weight * (sum_k coefficients[k] x[indices[k]] - rhs)^2` to the objective (without a
    /// factor of 1/2) and returns the row's number. The row itself is kept.
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
        let weights = Arc::make_mut(&mut self.weights);
        weights.try_reserve(1).map_err(|_| Error::OutOfMemory {
            what: "the weights",
        })?;
        let row = Arc::make_mut(&mut self.least_squares).push(
            "least-squares row",
            self.variables,
            indices,
            coefficients,
            rhs,
        )?;
        weights.push(weight);
        Ok(row)
    }

    /// Adds `weights[i] * (A x - rhs)_i^2` for every row of the matrix and returns the first row's
    /// number; without weights all are 1. Nothing is added on an error.
    ///
    /// # Errors
    /// As for one row; positions are positions in the arrays given.
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
        let kept = Arc::make_mut(&mut self.weights);
        kept.try_reserve(rhs.len())
            .map_err(|_| Error::OutOfMemory {
                what: "the weights",
            })?;
        let first = Arc::make_mut(&mut self.least_squares).append(matrix, rhs)?;
        match weights {
            Some(weights) => kept.extend_from_slice(weights),
            None => kept.resize(kept.len() + rhs.len(), 1.0),
        }
        Ok(first)
    }

    /// Adds the constraint `sum_k coefficients[k] x[indices[k]] = rhs` and returns its number, by
    /// which errors will name it. Duplicate indices are summed.
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

    /// Adds the constraints `C x = rhs`, one a row of the matrix, and returns the first one's
    /// number.
    ///
    /// # Errors
    /// As for one constraint; positions are positions in the matrix' arrays.
    pub fn add_constraint_matrix(&mut self, matrix: &MatrixRef, rhs: &[f64]) -> Result<usize> {
        matrix.validate("constraint", rhs.len(), self.variables)?;
        all_finite("constraint right sides", rhs)?;
        self.constraints.append(matrix, rhs)
    }

    /// Makes unknowns integer. Naming one twice is no error.
    ///
    /// # Errors
    /// [`Error::IndexOutOfRange`].
    pub fn set_integers(&mut self, variables: &[usize]) -> Result<()> {
        in_range("integer variables", variables, self.variables)?;
        for &i in variables {
            self.integer[i] = true;
        }
        Ok(())
    }

    /// A copy without integers.
    pub(crate) fn relaxed(&self) -> Problem {
        let mut relaxed = self.clone();
        relaxed.integer.fill(false);
        relaxed
    }

    /// Fixes one unknown to a value; an integer unknown must be given an integer by the time of
    /// the solve.
    ///
    /// # Errors
    /// [`Error::IndexOutOfRange`], [`Error::NotFinite`].
    pub fn pin(&mut self, variable: usize, value: f64) -> Result<()> {
        in_range("variable", &[variable], self.variables)?;
        finite("pinned value", value)?;
        self.pinned[variable] = Some(value);
        Ok(())
    }

    /// Frees a pinned unknown again; one that is free stays so.
    ///
    /// # Errors
    /// [`Error::IndexOutOfRange`].
    pub fn unpin(&mut self, variable: usize) -> Result<()> {
        in_range("variable", &[variable], self.variables)?;
        self.pinned[variable] = None;
        Ok(())
    }

    /// Sets the point that unknowns keep to where the objective does not decide them (zero unless
    /// set), one value an unknown.
    ///
    /// # Errors
    /// [`Error::LengthMismatch`], [`Error::NotFinite`].
    pub fn set_guess(&mut self, values: &[f64]) -> Result<()> {
        same_length("initial guess", self.variables, values.len())?;
        all_finite("initial guess", values)?;
        self.guess.copy_from_slice(values);
        Ok(())
    }

    /// Sets short cycles that the caller knows: sums of least-squares rows, each with sign 1
    /// or -1, in which all continuous unknowns cancel, such as the rings around the vertices of a
    /// mesh. Cycle `k` has the entries `offsets[k]..offsets[k + 1]` of `rows` and `signs`.
    ///
    /// A hint never changes the problem. A solve ignores a hint whose unknowns do not cancel, and says so in
    /// its log. A later hint replaces an earlier one.
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
    v.try_reserve_exact(len).map_err(|_| Error::OutOfMemory {
        what: "the variables",
    })?;
    v.resize(len, value);
    Ok(v)
}
