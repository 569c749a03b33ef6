//! What a reader has gathered, and the problem that it becomes.

use super::{NamedProblem, Names, curvature};
use crate::error::Result;
use crate::problem::{Layout, MatrixRef, Problem, Triangle};

/// A row of the file.
#[derive(Debug, Clone)]
pub(in crate::problem) struct DraftRow {
    pub name: String,
    pub lower: f64,
    pub upper: f64,
    /// Whether the row is an equality, and not an inequality whose sides may be equal.
    pub equality: bool,
}

/// The contents of a file, in the sense and the order of the file.
#[derive(Debug, Default)]
pub(in crate::problem) struct Draft {
    pub title: String,
    pub objective: String,
    pub maximise: bool,
    pub variables: Vec<String>,
    pub integer: Vec<bool>,
    pub lower: Vec<f64>,
    pub upper: Vec<f64>,
    pub linear: Vec<f64>,
    pub constant: f64,
    /// Entries of the lower triangle of Q.
    pub quadratic: Entries,
    pub rows: Vec<DraftRow>,
    /// Entries of the rows: rows, columns and values.
    pub entries: (Vec<usize>, Vec<usize>, Vec<f64>),
}

/// Entries of the lower triangle of Q, each with the line that gives it.
#[derive(Debug, Default)]
pub(in crate::problem) struct Entries {
    pub rows: Vec<usize>,
    pub cols: Vec<usize>,
    pub values: Vec<f64>,
    pub lines: Vec<usize>,
}

impl Entries {
    /// Adds an entry for two unknowns, in any order.
    pub fn push(&mut self, line: usize, i: usize, j: usize, value: f64) {
        self.rows.push(i.max(j));
        self.cols.push(i.min(j));
        self.values.push(value);
        self.lines.push(line);
    }

    /// Rows, columns, values and lines.
    pub fn iter(&self) -> impl Iterator<Item = (usize, usize, f64, usize)> + '_ {
        let at = |k| (self.rows[k], self.cols[k], self.values[k], self.lines[k]);
        (0..self.rows.len()).map(at)
    }

    /// The largest absolute value, if there is an entry.
    pub fn largest(&self) -> Option<f64> {
        let sizes = self.values.iter().map(|value| value.abs());
        sizes.reduce(f64::max)
    }

    /// The positions of the entries by columns: those of column `j` are from `offsets[j]` to `offsets[j + 1]`.
    pub fn by_column(&self, variables: usize) -> (Vec<usize>, Vec<usize>) {
        let mut offsets = vec![0; variables + 1];
        for &j in &self.cols {
            offsets[j + 1] += 1;
        }
        for j in 0..variables {
            offsets[j + 1] += offsets[j];
        }
        let mut next = offsets.clone();
        let mut order = vec![0; self.cols.len()];
        for (k, &j) in self.cols.iter().enumerate() {
            order[next[j]] = k;
            next[j] += 1;
        }
        (offsets, order)
    }

    /// For each unknown the last line of its diagonal entry or, without one, of any of its entries; 0 without any.
    fn lines_of_unknowns(&self, variables: usize) -> Vec<usize> {
        let mut lines = vec![0; if self.rows.is_empty() { 0 } else { variables }];
        for is_diagonal in [false, true] {
            for (i, j, _, line) in self.iter().filter(|(i, j, ..)| (i == j) == is_diagonal) {
                lines[i] = line;
                lines[j] = line;
            }
        }
        lines
    }
}

impl Draft {
    /// The problem, which minimises.
    pub fn into_problem(mut self) -> Result<NamedProblem> {
        if self.maximise {
            let constant = std::iter::once(&mut self.constant);
            let values = constant
                .chain(&mut self.linear)
                .chain(&mut self.quadratic.values);
            values.for_each(|value| *value = -*value);
        }
        curvature::check(&self)?;
        let mut problem = Problem::new(self.variables.len())?;
        let Entries {
            rows, cols, values, ..
        } = &self.quadratic;
        problem.add_quadratic_triplets(Triangle::Lower, rows, cols, values)?;
        problem.add_linear(&self.linear)?;
        problem.add_constant(self.constant)?;
        let [equalities, inequalities] = [true, false].map(|kind| self.matrix_of(kind));
        let sides = |kind: bool| self.rows.iter().filter(move |row| row.equality == kind);
        let right: Vec<f64> = sides(true).map(|row| row.upper).collect();
        problem.add_constraint_matrix(&equalities.as_ref(), &right)?;
        let lower: Vec<f64> = sides(false).map(|row| row.lower).collect();
        let upper: Vec<f64> = sides(false).map(|row| row.upper).collect();
        problem.add_inequality_matrix(&inequalities.as_ref(), &lower, &upper)?;
        self.set_bounds(&mut problem)?;
        let integers: Vec<usize> = (0..self.integer.len())
            .filter(|&j| self.integer[j])
            .collect();
        problem.set_integers(&integers)?;
        let (equalities, inequalities): (Vec<_>, Vec<_>) =
            self.rows.into_iter().partition(|row| row.equality);
        let names = |rows: Vec<DraftRow>| rows.into_iter().map(|row| row.name).collect();
        let names = Names {
            title: self.title,
            objective: self.objective,
            variables: self.variables,
            constraints: names(equalities),
            inequalities: names(inequalities),
        };
        let lines = self.quadratic.lines_of_unknowns(names.variables.len());
        Ok(NamedProblem {
            problem,
            names,
            lines,
            maximise: self.maximise,
        })
    }

    /// The rows of one kind, in the order of the file, each with its entries in the order of the file.
    fn matrix_of(&self, equality: bool) -> RowMatrix {
        let (rows, cols, values) = &self.entries;
        let mut number = Vec::with_capacity(self.rows.len());
        let mut count = 0;
        for row in &self.rows {
            number.push((row.equality == equality).then_some(count));
            count += usize::from(row.equality == equality);
        }
        let mut offsets = vec![0; count + 1];
        for i in rows.iter().filter_map(|&i| number[i]) {
            offsets[i + 1] += 1;
        }
        for i in 0..count {
            offsets[i + 1] += offsets[i];
        }
        let mut next = offsets.clone();
        let mut matrix = RowMatrix {
            indices: vec![0; offsets[count]],
            values: vec![0.0; offsets[count]],
            offsets,
        };
        for ((&i, &j), &value) in rows.iter().zip(cols).zip(values) {
            if let Some(i) = number[i] {
                matrix.indices[next[i]] = j;
                matrix.values[next[i]] = value;
                next[i] += 1;
            }
        }
        matrix
    }

    /// Sets the bounds of the variables that have some. A problem without bounds never hears of them.
    fn set_bounds(&self, problem: &mut Problem) -> Result<()> {
        let bounded = |&j: &usize| self.lower[j].is_finite() || self.upper[j].is_finite();
        let bounded: Vec<usize> = (0..self.variables.len()).filter(bounded).collect();
        if bounded.is_empty() {
            return Ok(());
        }
        let [lower, upper] = [&self.lower, &self.upper].map(|side| {
            let sides = bounded.iter().map(|&j| side[j]);
            sides.collect::<Vec<f64>>()
        });
        problem.set_bounds(&bounded, &lower, &upper)
    }
}

/// A matrix by rows.
struct RowMatrix {
    offsets: Vec<usize>,
    indices: Vec<usize>,
    values: Vec<f64>,
}

impl RowMatrix {
    fn as_ref(&self) -> MatrixRef<'_> {
        MatrixRef {
            layout: Layout::Rows,
            offsets: &self.offsets,
            indices: &self.indices,
            values: &self.values,
        }
    }
}
