//! The problem of a statement in exact numbers, and the bounds that hold at a node.

use std::collections::BTreeMap;

use super::exact::Exact;
use super::fault::{Checked, FaultKind, wrong};
use super::format::Statement;

/// The largest number of unknowns, lest a short line makes the checker run out of memory.
const MOST: usize = 10_000_000;

/// A side of a row or of an unknown.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Side {
    Lower,
    Upper,
}

/// A sparse row, sorted, without zeros.
pub(super) type ExactTerms = Vec<(usize, Exact)>;

/// `lower <= terms . x <= upper`.
#[derive(Debug, Clone)]
pub(super) struct ExactRow {
    pub terms: ExactTerms,
    pub lower: Option<Exact>,
    pub upper: Option<Exact>,
}

impl ExactRow {
    pub fn side(&self, side: Side) -> &Option<Exact> {
        match side {
            Side::Lower => &self.lower,
            Side::Upper => &self.upper,
        }
    }

    pub fn coefficient(&self, unknown: usize) -> Option<&Exact> {
        let at = self.terms.binary_search_by_key(&unknown, |&(j, _)| j);
        at.ok().map(|at| &self.terms[at].1)
    }
}

/// `weight (terms . x - rhs)^2`.
#[derive(Debug, Clone)]
pub(super) struct ExactSquare {
    pub weight: Exact,
    pub rhs: Exact,
    pub terms: ExactTerms,
}

/// A problem in exact numbers.
#[derive(Debug)]
pub(super) struct ExactProblem {
    /// Entries of the lower triangle of Q, summed, without zeros.
    pub quadratic: Vec<(usize, usize, Exact)>,
    pub linear: Vec<Exact>,
    pub constant: Exact,
    pub squares: Vec<ExactSquare>,
    /// Equality constraints, then two-sided rows.
    pub rows: Vec<ExactRow>,
    pub integer: Vec<bool>,
}

/// Bounds of all unknowns, which a tree tightens and releases again.
#[derive(Debug)]
pub(super) struct Limits {
    lower: Vec<Option<Exact>>,
    upper: Vec<Option<Exact>>,
    /// What was replaced, in order.
    trail: Vec<(usize, Side, Option<Exact>)>,
    /// The unknowns without a value, for each of the replacements since.
    empty: usize,
}

/// The exact number of a float of the statement.
fn finite(x: f64) -> Checked<Exact> {
    Exact::of(x).map_or_else(
        || wrong(FaultKind::Statement, format!("{x} is no finite number")),
        Ok,
    )
}

/// The number of an unknown.
fn in_range(j: u32, n: usize) -> Checked<usize> {
    match (j as usize) < n {
        true => Ok(j as usize),
        false => wrong(
            FaultKind::Reference,
            format!("there is no unknown {j} of {n}"),
        ),
    }
}

/// The terms of a row of n unknowns, summed.
fn terms(given: &[(u32, f64)], n: usize) -> Checked<ExactTerms> {
    let mut sums: BTreeMap<usize, Exact> = BTreeMap::new();
    for &(j, a) in given {
        let sum = sums.entry(in_range(j, n)?).or_insert_with(Exact::zero);
        *sum = &*sum + &finite(a)?;
    }
    sums.retain(|_, sum| !sum.is_zero());
    Ok(sums.into_iter().collect())
}

impl ExactProblem {
    /// The problem and its bounds, those of integers rounded.
    ///
    /// # Errors
    /// For numbers of unknowns that do not exist, and weights below zero.
    pub fn of(statement: &Statement) -> Checked<(Self, Limits)> {
        let n = statement.variables;
        if n > MOST {
            let text = format!("{n} unknowns are more than {MOST}");
            return wrong(FaultKind::Statement, text);
        }
        let in_range = |j: u32| in_range(j, n);
        let terms = |given: &[(u32, f64)]| terms(given, n);
        let mut quadratic: BTreeMap<(usize, usize), Exact> = BTreeMap::new();
        for &(i, j, v) in &statement.quadratic {
            if i < j {
                let text = format!("the entry ({i}, {j}) of Q is above the diagonal");
                return wrong(FaultKind::Statement, text);
            }
            let at = (in_range(i)?, in_range(j)?);
            let sum = quadratic.entry(at).or_insert_with(Exact::zero);
            *sum = &*sum + &finite(v)?;
        }
        quadratic.retain(|_, sum| !sum.is_zero());
        let mut linear = vec![Exact::zero(); n];
        for (j, q) in terms(&statement.linear)? {
            linear[j] = q;
        }
        let mut squares = Vec::with_capacity(statement.least_squares.len());
        for (k, square) in statement.least_squares.iter().enumerate() {
            if square.weight < 0.0 {
                let text = format!("the weight {} of square {k} is negative", square.weight);
                return wrong(FaultKind::Statement, text);
            }
            squares.push(ExactSquare {
                weight: finite(square.weight)?,
                rhs: finite(square.rhs)?,
                terms: terms(&square.terms)?,
            });
        }
        let mut rows = Vec::new();
        for row in &statement.constraints {
            let rhs = finite(row.rhs)?;
            rows.push(ExactRow {
                terms: terms(&row.terms)?,
                lower: Some(rhs.clone()),
                upper: Some(rhs),
            });
        }
        for row in &statement.inequalities {
            rows.push(ExactRow {
                terms: terms(&row.terms)?,
                lower: row.lower.map(finite).transpose()?,
                upper: row.upper.map(finite).transpose()?,
            });
        }
        let mut integer = vec![false; n];
        for &j in &statement.integers {
            integer[in_range(j)?] = true;
        }
        let mut limits = Limits {
            lower: vec![None; n],
            upper: vec![None; n],
            trail: Vec::new(),
            empty: 0,
        };
        let problem = ExactProblem {
            quadratic: quadratic.into_iter().map(|((i, j), v)| (i, j, v)).collect(),
            linear,
            constant: finite(statement.constant)?,
            squares,
            rows,
            integer,
        };
        let pins = statement.pins.iter().map(|&(j, v)| (j, Some(v), Some(v)));
        for (j, lower, upper) in statement.bounds.iter().copied().chain(pins) {
            let j = in_range(j)?;
            for (side, bound) in [(Side::Lower, lower), (Side::Upper, upper)] {
                if let Some(bound) = bound {
                    limits.tighten(&problem, j, side, finite(bound)?);
                }
            }
        }
        Ok((problem, limits))
    }

    /// Adds an unknown that is the sum of terms of others, and the equation that says so. It is an integer if that is sure.
    ///
    /// # Errors
    /// [`FaultKind::Reference`], [`FaultKind::Statement`].
    pub fn define(&mut self, limits: &mut Limits, sum: &[(u32, f64)]) -> Checked<()> {
        let own = self.integer.len();
        let mut terms = terms(sum, own)?;
        let is_whole = |(j, a): &(usize, Exact)| self.integer[*j] && a.is_integer();
        self.integer.push(terms.iter().all(is_whole));
        self.linear.push(Exact::zero());
        limits.lower.push(None);
        limits.upper.push(None);
        terms.push((own, finite(-1.0)?));
        self.rows.push(ExactRow {
            terms,
            lower: Some(Exact::zero()),
            upper: Some(Exact::zero()),
        });
        Ok(())
    }

    /// The objective at a point.
    pub fn energy(&self, x: &[Exact]) -> Exact {
        let mut energy = self.constant.clone();
        for (i, j, v) in &self.quadratic {
            let product = &(v * &x[*i]) * &x[*j];
            energy = &energy + &product.shifted(if i == j { -1 } else { 0 });
        }
        for (q, x) in self.linear.iter().zip(x) {
            energy = &energy + &(q * x);
        }
        for square in &self.squares {
            let residual = &product(&square.terms, x) - &square.rhs;
            energy = &energy + &(&square.weight * &(&residual * &residual));
        }
        energy
    }
}

/// `terms . x`.
pub(super) fn product(terms: &ExactTerms, x: &[Exact]) -> Exact {
    let products = terms.iter().map(|(j, a)| a * &x[*j]);
    products.fold(Exact::zero(), |sum, product| &sum + &product)
}

impl Limits {
    pub fn side(&self, unknown: usize, side: Side) -> &Option<Exact> {
        match side {
            Side::Lower => &self.lower[unknown],
            Side::Upper => &self.upper[unknown],
        }
    }

    fn side_mut(&mut self, unknown: usize, side: Side) -> &mut Option<Exact> {
        match side {
            Side::Lower => &mut self.lower[unknown],
            Side::Upper => &mut self.upper[unknown],
        }
    }

    /// The value of an unknown whose bounds are equal.
    pub fn fixed(&self, unknown: usize) -> Option<&Exact> {
        let (lower, upper) = (self.lower[unknown].as_ref()?, self.upper[unknown].as_ref()?);
        (lower == upper).then_some(lower)
    }

    /// Replaces a bound if the new one is tighter. Bounds of integers are rounded.
    pub fn tighten(&mut self, problem: &ExactProblem, unknown: usize, side: Side, to: Exact) {
        let to = match (problem.integer[unknown], side) {
            (false, _) => to,
            (true, Side::Lower) => to.ceil(),
            (true, Side::Upper) => to.floor(),
        };
        let is_tighter = match (self.side(unknown, side), side) {
            (None, _) => true,
            (Some(old), Side::Lower) => to > *old,
            (Some(old), Side::Upper) => to < *old,
        };
        if !is_tighter {
            return;
        }
        let was_empty = self.has_no_value(unknown);
        let old = self.side_mut(unknown, side).replace(to);
        self.trail.push((unknown, side, old));
        self.empty += usize::from(!was_empty && self.has_no_value(unknown));
    }

    /// Takes both bounds of an unknown away.
    pub fn release(&mut self, unknown: usize) {
        self.empty -= usize::from(self.has_no_value(unknown));
        for side in [Side::Lower, Side::Upper] {
            let old = self.side_mut(unknown, side).take();
            self.trail.push((unknown, side, old));
        }
    }

    fn has_no_value(&self, unknown: usize) -> bool {
        match (&self.lower[unknown], &self.upper[unknown]) {
            (Some(lower), Some(upper)) => lower > upper,
            _ => false,
        }
    }

    /// Whether some unknown has no value.
    pub fn are_empty(&self) -> bool {
        self.empty > 0
    }

    /// The number of replacements so far, to go back to.
    pub fn mark(&self) -> usize {
        self.trail.len()
    }

    /// Undoes all replacements since a mark.
    pub fn go_back(&mut self, mark: usize) {
        while self.trail.len() > mark {
            let Some((unknown, side, old)) = self.trail.pop() else {
                return;
            };
            let was_empty = self.has_no_value(unknown);
            *self.side_mut(unknown, side) = old;
            self.empty -= usize::from(was_empty && !self.has_no_value(unknown));
        }
    }
}
