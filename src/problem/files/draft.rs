//! What a reader has gathered, and the problem that it becomes.

use super::{NamedProblem, Names};
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
    /// Entries of the lower triangle of Q: rows, columns and values.
    pub quadratic: (Vec<usize>, Vec<usize>, Vec<f64>),
    pub rows: Vec<DraftRow>,
    /// Entries of the rows: rows, columns and values.
    pub entries: (Vec<usize>, Vec<usize>, Vec<f64>),
}

impl Draft {
    /// The problem, which minimises.
    pub fn into_problem(mut self) -> Result<NamedProblem> {
        if self.maximise {
            let constant = std::iter::once(&mut self.constant);
            let values = constant
                .chain(&mut self.linear)
                .chain(&mut self.quadratic.2);
            values.for_each(|value| *value = -*value);
        }
        let mut problem = Problem::new(self.variables.len())?;
        let (rows, cols, values) = &self.quadratic;
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
        Ok(NamedProblem {
            problem,
            names,
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
