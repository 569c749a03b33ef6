//! Unknowns that equations give by others, and the objective without them.
//!
//! Each row is solved for one unknown, after those of the rows before it are replaced in it. Its coefficient is a power
//! of two there, or the negative of one, so that no fractions come up.

use std::collections::BTreeMap;

use super::exact::Exact;
use super::fault::{Checked, FaultKind, wrong};
use super::minorant::PartObjective;
use super::problem::{ExactProblem, ExactSquare, ExactTerms, Limits};
use super::steps::row_of;

/// `terms . z + offset`.
#[derive(Debug, Clone)]
struct Affine {
    terms: BTreeMap<usize, Exact>,
    offset: Exact,
}

impl Affine {
    fn zero() -> Self {
        Affine {
            terms: BTreeMap::new(),
            offset: Exact::zero(),
        }
    }

    fn add(&mut self, place: usize, by: &Exact) {
        let sum = self.terms.entry(place).or_insert_with(Exact::zero);
        *sum = &*sum + by;
        if sum.is_zero() {
            self.terms.remove(&place);
        }
    }

    fn add_times(&mut self, factor: &Exact, other: &Affine) {
        for (&place, a) in &other.terms {
            self.add(place, &(factor * a));
        }
        self.offset = &self.offset + &(factor * &other.offset);
    }
}

/// The unknowns of a part that its rows give by others.
#[derive(Debug)]
pub(super) struct Substitution {
    /// By place in the part.
    given: BTreeMap<usize, Affine>,
}

impl Substitution {
    /// The substitution by rows, each solved for an unknown.
    ///
    /// # Errors
    /// [`FaultKind::Lattice`] for a row that is no equation or does not give its unknown, [`FaultKind::Reference`],
    /// [`FaultKind::Parts`].
    pub fn of(
        problem: &ExactProblem,
        limits: &Limits,
        part: &PartObjective,
        solved: &[(u32, u32)],
    ) -> Checked<Self> {
        let mut place_of = Vec::with_capacity(solved.len());
        let mut turn: BTreeMap<usize, usize> = BTreeMap::new();
        let mut steps: Vec<Affine> = Vec::with_capacity(solved.len());
        for &(number, unknown) in solved {
            let mut row = in_part(problem, limits, part, number)?;
            // Replacing an unknown brings in only those of later turns.
            let mut next = 0;
            while next < steps.len() {
                let waiting = row.terms.keys().filter_map(|place| turn.get(place));
                let Some(&first) = waiting.filter(|&&turn| turn >= next).min() else {
                    break;
                };
                if let Some(factor) = row.terms.remove(&place_of[first]) {
                    row.add_times(&factor, &steps[first]);
                }
                next = first + 1;
            }
            let own = part.place_of(unknown as usize);
            let pivot = own.and_then(|own| row.terms.remove(&own));
            let inverse = pivot.and_then(|pivot| pivot.inverse_of_power());
            let (Some(own), Some(inverse)) = (own, inverse) else {
                let text = format!("row {number} does not give x{unknown}");
                return wrong(FaultKind::Lattice, text);
            };
            let mut step = Affine::zero();
            step.add_times(&-&inverse, &row);
            turn.insert(own, steps.len());
            place_of.push(own);
            steps.push(step);
        }
        Ok(Self::without_each_other(&place_of, steps))
    }

    /// The unknowns by those alone that stay, from steps each of which may name unknowns of later ones.
    fn without_each_other(place_of: &[usize], steps: Vec<Affine>) -> Self {
        let mut given: BTreeMap<usize, Affine> = BTreeMap::new();
        for (&place, step) in place_of.iter().zip(steps).rev() {
            let mut all = Affine {
                terms: BTreeMap::new(),
                offset: step.offset,
            };
            for (other, a) in step.terms {
                match given.get(&other) {
                    Some(by) => all.add_times(&a, by),
                    None => all.add(other, &a),
                }
            }
            given.insert(place, all);
        }
        Substitution { given }
    }

    /// Terms in the unknowns that stay, and their constant.
    pub fn replaced(&self, terms: &ExactTerms) -> (ExactTerms, Exact) {
        let mut all = Affine::zero();
        for (place, a) in terms {
            match self.given.get(place) {
                Some(by) => all.add_times(a, by),
                None => all.add(*place, a),
            }
        }
        (all.terms.into_iter().collect(), all.offset)
    }

    /// Replaces the unknowns in the objective of the part. Returns the constant that this leaves.
    pub fn apply(&self, part: &mut PartObjective) -> Exact {
        let mut constant = Exact::zero();
        let whole = part.linear.iter().cloned().enumerate();
        let (linear, offset) = self.replaced(&whole.filter(|(_, q)| !q.is_zero()).collect());
        constant = &constant + &offset;
        part.linear.fill(Exact::zero());
        for (place, q) in linear {
            part.linear[place] = q;
        }
        for square in &mut part.squares {
            let (terms, offset) = self.replaced(&square.terms);
            *square = ExactSquare {
                weight: square.weight.clone(),
                rhs: &square.rhs - &offset,
                terms,
            };
        }
        let mut quadratic: BTreeMap<(usize, usize), Exact> = BTreeMap::new();
        for (i, j, v) in std::mem::take(&mut part.quadratic) {
            // An entry of the diagonal stands for half of it.
            let v = if i == j { v.shifted(-1) } else { v };
            let one = |place: usize| self.replaced(&vec![(place, one())]);
            let ((a, a_offset), (b, b_offset)) = (one(i), one(j));
            for (p, of_p) in &a {
                for (q, of_q) in &b {
                    let product = &(&v * of_p) * of_q;
                    let product = if p == q { product.shifted(1) } else { product };
                    let entry = quadratic.entry((*p.max(q), *p.min(q)));
                    let sum = entry.or_insert_with(Exact::zero);
                    *sum = &*sum + &product;
                }
            }
            for (terms, other) in [(&a, &b_offset), (&b, &a_offset)] {
                let factor = &v * other;
                for (place, of) in terms.iter().filter(|_| !factor.is_zero()) {
                    part.linear[*place] = &part.linear[*place] + &(&factor * of);
                }
            }
            constant = &constant + &(&(&v * &a_offset) * &b_offset);
        }
        quadratic.retain(|_, v| !v.is_zero());
        part.quadratic = quadratic.into_iter().map(|((i, j), v)| (i, j, v)).collect();
        constant
    }
}

fn one() -> Exact {
    Exact::of(1.0).unwrap_or_else(Exact::zero)
}

/// `terms . x - side` of an equation, which is zero, in the unknowns of a part.
fn in_part(
    problem: &ExactProblem,
    limits: &Limits,
    part: &PartObjective,
    number: u32,
) -> Checked<Affine> {
    let row = row_of(problem, number)?;
    let (Some(side), true) = (&row.lower, row.lower == row.upper) else {
        return wrong(FaultKind::Lattice, format!("row {number} is no equation"));
    };
    let mut sum = Affine {
        terms: BTreeMap::new(),
        offset: -side,
    };
    for (j, a) in &row.terms {
        if let Some(value) = limits.fixed(*j) {
            sum.offset = &sum.offset + &(a * value);
        } else if let Some(place) = part.place_of(*j) {
            sum.add(place, a);
        } else {
            let text = format!("row {number} couples x{j} of another part");
            return wrong(FaultKind::Parts, text);
        }
    }
    Ok(sum)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::proof::format::{Equation, Square, Statement};
    use crate::proof::minorant::Split;
    use crate::test_random::Random;

    fn exact(x: f64) -> Exact {
        Exact::of(x).unwrap()
    }

    fn whole(random: &mut Random) -> f64 {
        (4.0 * random.next()).round()
    }

    /// Five unknowns, the last of which is pinned, an objective of every kind of term, and two equations: the first one
    /// gives x1, and the second one x0 after it.
    fn statement(random: &mut Random) -> Statement {
        let terms = |random: &mut Random| (0..5).map(|j| (j, whole(random))).collect();
        let mut first: Vec<(u32, f64)> = terms(random);
        let mut second: Vec<(u32, f64)> = terms(random);
        (first[0].1, first[1].1) = (2.0, -4.0);
        (second[0].1, second[1].1) = (1.0, 6.0);
        Statement {
            variables: 5,
            quadratic: vec![
                (0, 0, whole(random)),
                (2, 1, whole(random)),
                (1, 0, 3.0),
                (4, 3, 1.5),
            ],
            linear: terms(random),
            constant: 0.75,
            least_squares: vec![Square {
                weight: 1.25,
                rhs: whole(random),
                terms: terms(random),
            }],
            constraints: vec![
                Equation {
                    rhs: whole(random),
                    terms: first,
                },
                Equation {
                    rhs: whole(random),
                    terms: second,
                },
            ],
            inequalities: Vec::new(),
            bounds: Vec::new(),
            integers: Vec::new(),
            pins: vec![(4, 1.5)],
        }
    }

    #[test]
    fn the_objective_is_the_same_at_all_points_within_the_equations() {
        let random = &mut Random::new(9);
        let solved = [(0, 1), (1, 0)];
        for _ in 0..200 {
            let stated = statement(random);
            let (problem, limits) = ExactProblem::of(&stated).unwrap();
            let mut split = Split::of(&problem, &limits, &[vec![3, 0, 2, 1]]).unwrap();
            let part = &mut split.parts[0];
            let by = Substitution::of(&problem, &limits, part, &solved).unwrap();
            let mut z: Vec<Exact> = (0..4).map(|_| exact(9.0 * random.next())).collect();
            for place in [1, 3] {
                let (terms, offset) = by.replaced(&vec![(place, one())]);
                assert!(terms.iter().all(|(place, _)| [0, 2].contains(place)));
                z[place] = &crate::proof::problem::product(&terms, &z) + &offset;
            }
            let x = [&z[1], &z[3], &z[2], &z[0], &exact(1.5)].map(Exact::clone);
            for row in &problem.rows {
                let value = crate::proof::problem::product(&row.terms, &x);
                assert_eq!(Some(value), row.lower);
            }
            let constant = by.apply(part);
            let of_part = |of: &PartObjective| {
                let stated = ExactProblem {
                    quadratic: of.quadratic.clone(),
                    linear: of.linear.clone(),
                    constant: Exact::zero(),
                    squares: of.squares.clone(),
                    rows: Vec::new(),
                    integer: vec![false; 4],
                };
                stated.energy(&z)
            };
            let named = part.quadratic.iter().flat_map(|(i, j, _)| [*i, *j]);
            assert!(named.into_iter().all(|place| [0, 2].contains(&place)));
            assert!(part.linear[1].is_zero() && part.linear[3].is_zero());
            let energy = &(&of_part(part) + &constant) + &split.constant;
            assert_eq!(energy, problem.energy(&x));
        }
    }

    #[test]
    fn rows_that_give_no_unknown_are_refused() {
        let mut stated = statement(&mut Random::new(9));
        stated.constraints[1].terms = vec![(0, 3.0), (1, 6.0)];
        stated.constraints[0].terms = vec![(0, 1.0), (1, -2.0), (2, 1.0)];
        let (problem, limits) = ExactProblem::of(&stated).unwrap();
        let split = Split::of(&problem, &limits, &[vec![0, 1, 2, 3]]).unwrap();
        let of = |solved: &[(u32, u32)]| {
            Substitution::of(&problem, &limits, &split.parts[0], solved).map_err(|(kind, _)| kind)
        };
        assert!(of(&[(0, 1)]).is_ok());
        // A coefficient of three, an unknown that is not in the row, one that was given before, and a row that is gone.
        for solved in [
            &[(1, 0)][..],
            &[(0, 3)],
            &[(0, 1), (1, 1)],
            &[(0, 1), (0, 2)],
        ] {
            assert_eq!(of(solved).unwrap_err(), FaultKind::Lattice, "{solved:?}");
        }
        assert_eq!(of(&[(2, 0)]).unwrap_err(), FaultKind::Reference);
    }
}
