//! A bound from a point and multipliers, in exact numbers.
//!
//! With `D` a diagonal for which the objective minus `1/2 z'Dz` is convex, every point `x` and all multipliers
//! `mu` of rows give for all points `z` within the rows
//!
//! ```text
//! E(z) >= E(x) + E'(x)(z - x) + 1/2 (z - x)'D(z - x) + sum_i mu_i (a_i z - side_i)
//! ```
//!
//! where a positive multiplier belongs to the upper side and a negative one to the lower side. The right side is
//! a sum of functions of one unknown each, so that its minimum over a box is known; that of an integer over the
//! integers in it. Without the objective, a minimum above zero shows that no point is within the rows and the box.

use std::cmp::Ordering;
use std::collections::BTreeMap;
use std::rc::Rc;

use super::exact::Exact;
use super::fault::{Checked, FaultKind, wrong};
use super::format::{Certificate, Multipliers};
use super::problem::{ExactProblem, ExactSquare, ExactTerms, Limits, Side};
use super::steps::row_of;

/// No part.
const NONE: usize = usize::MAX;

/// The part of each unknown of the whole, and its place there.
type Places = Vec<(usize, usize)>;

/// The objective of a part: all terms that contain its unknowns, with fixed unknowns at their values. Unknowns
/// are counted within the part.
#[derive(Debug)]
pub(super) struct PartObjective {
    /// The unknowns of the whole, and which of them are integers.
    pub members: Vec<usize>,
    pub integer: Vec<bool>,
    number: usize,
    places: Rc<Places>,
    /// The lower triangle of Q.
    pub quadratic: Vec<(usize, usize, Exact)>,
    pub linear: Vec<Exact>,
    pub squares: Vec<ExactSquare>,
    /// Zero, a power of two or the negative of one for each unknown; any number for an integer.
    pub curvature: Vec<Exact>,
    /// The inverse, which for an integer may be rounded.
    pub inverse_curvature: Vec<Exact>,
}

/// All parts, and what the fixed unknowns add to the energy.
pub(super) struct Split {
    pub parts: Vec<PartObjective>,
    pub constant: Exact,
    /// An unknown that is not fixed and in no part. The parts then prove nothing about the whole objective.
    pub left_out: Option<usize>,
}

/// The objective without the squares that stay squares.
struct Summed {
    quadratic: BTreeMap<(usize, usize), Exact>,
    linear: Vec<Exact>,
    constant: Exact,
}

impl Summed {
    /// Q, q and c with some squares expanded.
    fn of(problem: &ExactProblem, expanded: &[&ExactSquare]) -> Self {
        let entries = problem.quadratic.iter();
        let mut sum = Summed {
            quadratic: entries.map(|(i, j, v)| ((*i, *j), v.clone())).collect(),
            linear: problem.linear.clone(),
            constant: problem.constant.clone(),
        };
        for square in expanded {
            for (k, (i, a)) in square.terms.iter().enumerate() {
                let twice = (&square.weight * a).shifted(1);
                for (j, b) in &square.terms[..=k] {
                    let at = (*i.max(j), *i.min(j));
                    let entry = sum.quadratic.entry(at).or_insert_with(Exact::zero);
                    *entry = &*entry + &(&twice * b);
                }
                sum.linear[*i] = &sum.linear[*i] - &(&twice * &square.rhs);
            }
            let square = &square.weight * &(&square.rhs * &square.rhs);
            sum.constant = &sum.constant + &square;
        }
        sum.quadratic.retain(|_, v| !v.is_zero());
        sum
    }
}

impl Split {
    /// Splits the objective into parts. Terms of unknowns that are left out are left out too.
    ///
    /// # Errors
    /// [`FaultKind::Parts`], [`FaultKind::Reference`].
    pub fn of(problem: &ExactProblem, limits: &Limits, parts: &[Vec<u32>]) -> Checked<Self> {
        let n = problem.integer.len();
        let mut places = vec![(NONE, NONE); n];
        for (number, members) in parts.iter().enumerate() {
            for (k, &j) in members.iter().enumerate() {
                let Some(place) = places.get_mut(j as usize) else {
                    return wrong(
                        FaultKind::Reference,
                        format!("there is no unknown {j} of {n}"),
                    );
                };
                if place.0 != NONE {
                    return wrong(FaultKind::Parts, format!("x{j} is in two parts"));
                }
                if limits.fixed(j as usize).is_some() {
                    return wrong(FaultKind::Parts, format!("x{j} is fixed, and in a part"));
                }
                *place = (number, k);
            }
        }
        let places = Rc::new(places);
        // Squares that couple parts may cancel: only their sum has to be apart.
        let couples = |square: &&ExactSquare| {
            let mut parts = square.terms.iter().map(|(j, _)| places[*j].0);
            let mut parts = parts.by_ref().filter(|part| *part != NONE);
            let first = parts.next();
            parts.any(|part| Some(part) != first)
        };
        let (expanded, kept): (Vec<_>, Vec<_>) = problem.squares.iter().partition(couples);
        let sum = Summed::of(problem, &expanded);
        let of_part = |(number, members): (usize, &Vec<u32>)| PartObjective {
            members: members.iter().map(|&j| j as usize).collect(),
            integer: members
                .iter()
                .map(|&j| problem.integer[j as usize])
                .collect(),
            number,
            places: Rc::clone(&places),
            quadratic: Vec::new(),
            linear: members
                .iter()
                .map(|&j| sum.linear[j as usize].clone())
                .collect(),
            squares: Vec::new(),
            curvature: Vec::new(),
            inverse_curvature: Vec::new(),
        };
        let mut split = Split {
            parts: parts.iter().enumerate().map(of_part).collect(),
            constant: sum.constant.clone(),
            left_out: (0..n).find(|&j| places[j].0 == NONE && limits.fixed(j).is_none()),
        };
        for (j, q) in sum.linear.iter().enumerate() {
            if let Some(value) = limits.fixed(j) {
                split.constant = &split.constant + &(q * value);
            }
        }
        for ((i, j), v) in &sum.quadratic {
            split.add_product((*i, *j), v, &places, limits)?;
        }
        for square in kept {
            split.add_square(square, &places, limits);
        }
        Ok(split)
    }

    /// Adds an entry of Q.
    fn add_product(
        &mut self,
        (i, j): (usize, usize),
        v: &Exact,
        places: &Places,
        limits: &Limits,
    ) -> Checked<()> {
        let is_left_out = |k: usize| places[k].0 == NONE && limits.fixed(k).is_none();
        if is_left_out(i) || is_left_out(j) {
            return Ok(());
        }
        match (limits.fixed(i), limits.fixed(j)) {
            (None, None) if places[i].0 == places[j].0 => {
                let at = (places[i].1, places[j].1);
                let (row, column) = (at.0.max(at.1), at.0.min(at.1));
                let part = &mut self.parts[places[i].0];
                part.quadratic.push((row, column, v.clone()));
            }
            (None, None) => {
                let text = format!("the objective couples x{i} and x{j} of two parts");
                return wrong(FaultKind::Parts, text);
            }
            (Some(a), Some(b)) => {
                let product = &(v * a) * b;
                let half = if i == j { -1 } else { 0 };
                self.constant = &self.constant + &product.shifted(half);
            }
            (Some(value), None) => self.add_linear(places[j], &(v * value)),
            (None, Some(value)) => self.add_linear(places[i], &(v * value)),
        }
        Ok(())
    }

    fn add_linear(&mut self, (part, place): (usize, usize), q: &Exact) {
        let sum = &mut self.parts[part].linear[place];
        *sum = &*sum + q;
    }

    /// Adds a square whose free unknowns are in one part.
    fn add_square(&mut self, square: &ExactSquare, places: &Places, limits: &Limits) {
        let mut own = NONE;
        let mut rhs = square.rhs.clone();
        let mut terms: ExactTerms = Vec::new();
        for (j, a) in &square.terms {
            if let Some(value) = limits.fixed(*j) {
                rhs = &rhs - &(a * value);
                continue;
            }
            let (part, place) = places[*j];
            if part == NONE {
                return;
            }
            own = part;
            terms.push((place, a.clone()));
        }
        let weight = square.weight.clone();
        match self.parts.get_mut(own) {
            Some(part) => part.squares.push(ExactSquare { weight, rhs, terms }),
            None => self.constant = &self.constant + &(&weight * &(&rhs * &rhs)),
        }
    }
}

impl PartObjective {
    /// All unknowns, without an objective.
    pub fn all(integer: &[bool]) -> Self {
        let unknowns = integer.len();
        PartObjective {
            members: (0..unknowns).collect(),
            integer: integer.to_vec(),
            number: 0,
            places: Rc::new((0..unknowns).map(|j| (0, j)).collect()),
            quadratic: Vec::new(),
            linear: Vec::new(),
            squares: Vec::new(),
            curvature: vec![Exact::zero(); unknowns],
            inverse_curvature: vec![Exact::zero(); unknowns],
        }
    }

    /// The place of an unknown of the whole in this part. Other numbers have none.
    pub fn place_of(&self, unknown: usize) -> Option<usize> {
        let (number, place) = *self.places.get(unknown)?;
        (number == self.number).then_some(place)
    }

    /// Sets the curvature. Whether the objective has it is not checked here.
    ///
    /// # Errors
    /// [`FaultKind::Certificate`] for numbers that are not finite, and for those of reals that are not zero, powers of
    /// two or their negatives.
    pub fn set_curvature(&mut self, curvature: &[f64]) -> Checked<()> {
        if curvature.len() != self.members.len() {
            let text = format!(
                "{} curvatures of {} unknowns",
                curvature.len(),
                self.members.len()
            );
            return wrong(FaultKind::Certificate, text);
        }
        self.curvature.clear();
        self.inverse_curvature.clear();
        for (&d, &is_integer) in curvature.iter().zip(&self.integer) {
            let inverse = if d == 0.0 { 0.0 } else { 1.0 / d };
            let is_power = d == 0.0 || (d.is_normal() && d.to_bits() << 12 == 0);
            match (Exact::of(d), Exact::of(inverse)) {
                (Some(d), Some(inverse)) if is_power || is_integer => {
                    self.curvature.push(d);
                    self.inverse_curvature.push(inverse);
                }
                _ => {
                    let text = format!("the curvature {d} is no power of two");
                    return wrong(FaultKind::Certificate, text);
                }
            }
        }
        Ok(())
    }
}

/// `constant + sum_j slopes_j z_j + 1/2 sum_j D_j (z_j - point_j)^2`, which is nowhere above the objective for
/// points within the rows.
#[derive(Debug)]
pub(super) struct Minorant {
    constant: Exact,
    slopes: Vec<Exact>,
    /// Empty where there is no objective.
    point: Vec<Exact>,
}

/// Why a minorant has no minimum: it falls for ever along an unknown of the whole.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct Open(pub usize);

impl Minorant {
    /// The minorant of a point and multipliers.
    ///
    /// # Errors
    /// [`FaultKind::Certificate`], [`FaultKind::Reference`], [`FaultKind::Parts`].
    pub fn of(
        problem: &ExactProblem,
        limits: &Limits,
        part: &PartObjective,
        certificate: &Certificate,
    ) -> Checked<Self> {
        let (given, n) = (certificate.point.len(), part.members.len());
        if given != n {
            let text = format!("a point of {given} values for {n} unknowns");
            return wrong(FaultKind::Certificate, text);
        }
        let point: Option<Vec<Exact>> = certificate.point.iter().map(|x| x.exact()).collect();
        let Some(point) = point else {
            return wrong(FaultKind::Certificate, "a value that is no number");
        };
        let mut minorant = Minorant {
            constant: Exact::zero(),
            slopes: vec![Exact::zero(); point.len()],
            point: Vec::new(),
        };
        for (i, j, v) in &part.quadratic {
            minorant.slopes[*i] = &minorant.slopes[*i] + &(v * &point[*j]);
            if i != j {
                minorant.slopes[*j] = &minorant.slopes[*j] + &(v * &point[*i]);
            }
        }
        for ((slope, q), x) in minorant.slopes.iter_mut().zip(&part.linear).zip(&point) {
            minorant.constant = &minorant.constant - &(&*slope * x).shifted(-1);
            *slope = &*slope + q;
        }
        for square in &part.squares {
            let sum = super::problem::product(&square.terms, &point);
            let pull = (&square.weight * &(&sum - &square.rhs)).shifted(1);
            let squares = &(&square.rhs * &square.rhs) - &(&sum * &sum);
            minorant.constant = &minorant.constant + &(&square.weight * &squares);
            for (j, a) in &square.terms {
                minorant.slopes[*j] = &minorant.slopes[*j] + &(&pull * a);
            }
        }
        minorant.add_rows(problem, limits, part, &certificate.multipliers)?;
        minorant.point = point;
        Ok(minorant)
    }

    /// The slopes, one for each unknown of the part.
    pub fn slopes(&self) -> &[Exact] {
        &self.slopes
    }

    /// The minorant of multipliers without the objective.
    ///
    /// # Errors
    /// Those of [`of`](Self::of).
    pub fn of_rows(
        problem: &ExactProblem,
        limits: &Limits,
        part: &PartObjective,
        multipliers: &Multipliers,
    ) -> Checked<Self> {
        let mut minorant = Minorant {
            constant: Exact::zero(),
            slopes: vec![Exact::zero(); part.members.len()],
            point: Vec::new(),
        };
        minorant.add_rows(problem, limits, part, multipliers)?;
        Ok(minorant)
    }

    fn add_rows(
        &mut self,
        problem: &ExactProblem,
        limits: &Limits,
        part: &PartObjective,
        multipliers: &Multipliers,
    ) -> Checked<()> {
        for (number, multiplier) in multipliers {
            let row = row_of(problem, *number)?;
            let Some(multiplier) = multiplier.exact() else {
                return wrong(FaultKind::Certificate, "a multiplier that is no number");
            };
            let (side, name) = match multiplier.sign().is_gt() {
                true => (&row.upper, "upper"),
                false => (&row.lower, "lower"),
            };
            let Some(side) = side else {
                let text =
                    format!("a multiplier holds the {name} side of row {number}, which has none");
                return wrong(FaultKind::Certificate, text);
            };
            self.constant = &self.constant - &(&multiplier * side);
            for (j, a) in &row.terms {
                let term = &multiplier * a;
                let (own, place) = part.places[*j];
                if own == part.number {
                    self.slopes[place] = &self.slopes[place] + &term;
                } else if let Some(least) = least_product(&term, *j, limits) {
                    self.constant = &self.constant + &least;
                } else {
                    let text = format!("row {number} couples x{j} of another part");
                    return wrong(FaultKind::Parts, text);
                }
            }
        }
        Ok(())
    }

    /// Adds `factor (terms . x - side)`.
    pub fn add(&mut self, terms: &ExactTerms, side: &Exact, factor: &Exact) {
        self.constant = &self.constant - &(factor * side);
        for (j, a) in terms {
            self.slopes[*j] = &self.slopes[*j] + &(factor * a);
        }
    }

    /// The least value of rows with multipliers within the limits, if there is one.
    ///
    /// # Errors
    /// [`FaultKind::Certificate`], [`FaultKind::Reference`].
    pub fn of_rows_alone(
        problem: &ExactProblem,
        limits: &Limits,
        multipliers: &Multipliers,
    ) -> Checked<Option<Exact>> {
        let all = PartObjective::all(&problem.integer);
        let rows = Minorant::of_rows(problem, limits, &all, multipliers)?;
        Ok(rows.least(limits, &all).ok())
    }

    /// The least value within the limits.
    pub fn least(&self, limits: &Limits, part: &PartObjective) -> Result<Exact, Open> {
        let mut sum = self.constant.clone();
        for (k, slope) in self.slopes.iter().enumerate() {
            sum = &sum + &self.least_term(k, slope, limits, part)?;
        }
        Ok(sum)
    }

    /// The least value of the terms of one unknown.
    fn least_term(
        &self,
        k: usize,
        slope: &Exact,
        limits: &Limits,
        part: &PartObjective,
    ) -> Result<Exact, Open> {
        let unknown = part.members[k];
        if let Some(centre) = self.point.get(k)
            && part.curvature[k].sign().is_lt()
        {
            // It is least at one of the ends.
            let at = |side| {
                let end = limits.side(unknown, side).as_ref().ok_or(Open(unknown))?;
                Ok(term_at(slope, end, centre, &part.curvature[k]))
            };
            return Ok(at(Side::Lower)?.min(at(Side::Upper)?));
        }
        let centre = self.point.get(k);
        let curved = centre.filter(|_| !part.curvature[k].is_zero());
        if let Some(centre) = curved
            && part.integer[k]
        {
            let at = least_integer(slope, centre, &part.curvature[k], limits, unknown);
            return Ok(term_at(slope, &at, centre, &part.curvature[k]));
        }
        let side = match slope.sign() {
            Ordering::Equal => return Ok(Exact::zero()),
            Ordering::Greater => Side::Lower,
            Ordering::Less => Side::Upper,
        };
        let end = limits.side(unknown, side).as_ref();
        let Some(centre) = curved else {
            let end = end.ok_or(Open(unknown))?;
            return Ok(slope * end);
        };
        // The minimiser without limits is on the side to which the slope falls.
        let step = slope * &part.inverse_curvature[k];
        let free = centre - &step;
        let at = match (end, side) {
            (Some(end), Side::Lower) if *end > free => end.clone(),
            (Some(end), Side::Upper) if *end < free => end.clone(),
            _ => free,
        };
        Ok(term_at(slope, &at, centre, &part.curvature[k]))
    }
}

/// The least value of `factor x` within the limits.
fn least_product(factor: &Exact, unknown: usize, limits: &Limits) -> Option<Exact> {
    let side = match factor.sign() {
        Ordering::Equal => return Some(Exact::zero()),
        Ordering::Greater => Side::Lower,
        Ordering::Less => Side::Upper,
    };
    let end = limits.side(unknown, side).as_ref()?;
    Some(factor * end)
}

/// The integer within the limits at which the terms of one unknown with a positive curvature are least.
fn least_integer(
    slope: &Exact,
    centre: &Exact,
    curvature: &Exact,
    limits: &Limits,
    unknown: usize,
) -> Exact {
    // The step from z to z + 1 is slope + curvature (z + 1/2 - centre): the least z for which it is not negative.
    let step = &(slope + &curvature.shifted(-1)) - &(curvature * centre);
    let free = -&step.floor_of_quotient(curvature);
    match (
        limits.side(unknown, Side::Lower),
        limits.side(unknown, Side::Upper),
    ) {
        (Some(lower), _) if *lower > free => lower.clone(),
        (_, Some(upper)) if *upper < free => upper.clone(),
        _ => free,
    }
}

/// The terms of one unknown at a value.
fn term_at(slope: &Exact, at: &Exact, centre: &Exact, curvature: &Exact) -> Exact {
    let distance = at - centre;
    let square = (curvature * &(&distance * &distance)).shifted(-1);
    &(slope * at) + &square
}
