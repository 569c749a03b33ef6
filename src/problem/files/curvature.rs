//! What a reader sees of an objective that is not convex, without a factor: entries of Q that alone prove it.
//!
//! A matrix without a direction of negative curvature has no negative diagonal entry, and no entry whose square is
//! above the product of the two diagonal entries beside it. Where unknowns can move by themselves, each of these
//! is a direction along which the objective curves downwards. Constraints may take that direction away. What they
//! limit is left to the solver, which knows them, and [`NamedProblem::located`] finds the line for it.
//!
//! [`NamedProblem::located`]: super::NamedProblem::located

use super::draft::{Draft, Entries};
use super::lines::quoted;
use crate::error::{Error, Result};

/// Diagonal entries may be wrong by this part of the largest entry of Q, as rounding errors leave them.
const ROUNDING: f64 = 1e-9;

/// Refuses an objective, which minimises, if entries of Q show that it is not convex.
///
/// # Errors
/// [`Error::NotConvexAt`] with the first line that shows it.
pub(super) fn check(draft: &Draft) -> Result<()> {
    let entries = &draft.quadratic;
    let Some(largest) = entries.largest() else {
        return Ok(());
    };
    let scan = Scan {
        draft,
        rounding: ROUNDING * largest,
        diagonal: Diagonal::of(entries, draft.variables.len()),
        free: free(draft),
    };
    match scan.first() {
        Some(shown) => Err(scan.error(&shown)),
        None => Ok(()),
    }
}

/// Unknowns that no equality holds, and that have more than one value between their bounds.
fn free(draft: &Draft) -> Vec<bool> {
    let bounds = draft.lower.iter().zip(&draft.upper).zip(&draft.integer);
    let several = |((&lower, &upper), &integer): ((&f64, &f64), &bool)| match integer {
        true => lower.ceil() < upper.floor(),
        false => lower < upper,
    };
    let mut free: Vec<bool> = bounds.map(several).collect();
    let (rows, cols, values) = &draft.entries;
    for ((&i, &j), &value) in rows.iter().zip(cols).zip(values) {
        if value != 0.0 && draft.rows[i].lower == draft.rows[i].upper {
            free[j] = false;
        }
    }
    free
}

/// The sums of the diagonal entries, and the last line of each.
struct Diagonal {
    sums: Vec<f64>,
    lines: Vec<usize>,
}

impl Diagonal {
    fn of(entries: &Entries, variables: usize) -> Self {
        let mut diagonal = Diagonal {
            sums: vec![0.0; variables],
            lines: vec![0; variables],
        };
        for (_, j, value, line) in entries.iter().filter(|(i, j, ..)| i == j) {
            diagonal.sums[j] += value;
            diagonal.lines[j] = line;
        }
        diagonal
    }
}

/// Unknowns with an entry that shows a negative curvature: the entry and its last line.
struct Shown {
    unknowns: [usize; 2],
    entry: f64,
    line: usize,
}

struct Scan<'a> {
    draft: &'a Draft,
    rounding: f64,
    diagonal: Diagonal,
    free: Vec<bool>,
}

impl Scan<'_> {
    /// What the first line shows that shows anything.
    fn first(&self) -> Option<Shown> {
        let mut first: Option<Shown> = None;
        let mut tell = |shown: Shown| {
            if first.as_ref().is_none_or(|first| shown.line < first.line) {
                first = Some(shown);
            }
        };
        for (j, &entry) in self.diagonal.sums.iter().enumerate() {
            if self.free[j] && entry < -self.rounding {
                tell(Shown {
                    unknowns: [j, j],
                    entry,
                    line: self.diagonal.lines[j],
                });
            }
        }
        let variables = self.free.len();
        let entries = &self.draft.quadratic;
        let (offsets, order) = entries.by_column(variables);
        // The sum and the last line of each entry of the current column.
        let mut sums = vec![(0.0, 0); variables];
        for j in (0..variables).filter(|&j| self.free[j]) {
            let column = &order[offsets[j]..offsets[j + 1]];
            for &k in column {
                let sum = &mut sums[entries.rows[k]];
                *sum = (sum.0 + entries.values[k], entries.lines[k]);
            }
            for &k in column {
                let i = entries.rows[k];
                let (entry, line) = std::mem::take(&mut sums[i]);
                if i != j && self.free[i] && self.is_too_large(entry, [i, j]) {
                    tell(Shown {
                        unknowns: [i, j],
                        entry,
                        line,
                    });
                }
            }
        }
        first
    }

    /// Whether the square of an entry is above the product of the diagonal entries beside it.
    fn is_too_large(&self, entry: f64, [i, j]: [usize; 2]) -> bool {
        let [a, b] = [i, j].map(|k| self.diagonal.sums[k].max(0.0) + self.rounding);
        entry.abs() > a.sqrt() * b.sqrt()
    }

    fn error(&self, shown: &Shown) -> Error {
        let [i, j] = shown.unknowns;
        // In the sense of the file.
        let sign = if self.draft.maximise { -1.0 } else { 1.0 };
        let [entry, a, b] =
            [shown.entry, self.diagonal.sums[i], self.diagonal.sums[j]].map(|v| sign * v + 0.0);
        let [x, y] = [i, j].map(|k| quoted(&self.draft.variables[k]));
        let (what, way) = match self.draft.maximise {
            false => ("not convex", "convex objectives are minimised"),
            true => ("not concave", "concave objectives are maximised"),
        };
        let because = if i == j {
            format!("Q has {entry} on the diagonal at {x}")
        } else {
            format!(
                "the entry {entry} of Q at {x} and {y} is too large for {a} and {b} on the diagonal"
            )
        };
        let is_binary = |&k: &usize| {
            let within = self.draft.lower[k] >= 0.0 && self.draft.upper[k] <= 1.0;
            self.draft.integer[k] && within
        };
        let help = if [i, j].iter().all(is_binary) {
            "for a binary, x^2 = x: move weight from its linear term to the diagonal, twice as much"
        } else {
            "check the signs of Q and the sense of the objective"
        };
        let (variable, direction) = self.direction(shown);
        Error::NotConvexAt {
            line: shown.line,
            what: format!("the objective is {what}: {because}; only {way}; {help}"),
            variable,
            direction,
        }
    }

    /// The direction with a largest entry of one, and the place of that entry.
    fn direction(&self, shown: &Shown) -> (usize, Vec<f64>) {
        let [mut i, mut j] = shown.unknowns;
        let diagonal = &self.diagonal.sums;
        // With the smaller diagonal entry a and the larger one b, `a + 2 c s + b s^2` is least at `s = -c / b`. If
        // that is beyond one, c is larger than both, and the curvature is negative at one as well.
        if diagonal[i] > diagonal[j] {
            std::mem::swap(&mut i, &mut j);
        }
        let mut direction = vec![0.0; self.free.len()];
        if i != j {
            let step = shown.entry / diagonal[j].max(0.0);
            direction[j] = -step.clamp(-1.0, 1.0);
        }
        direction[i] = 1.0;
        (i, direction)
    }
}
