//! What is left of a problem in its integers, for a proof.
//!
//! After elimination, the continuous unknowns are minimised: the Schur complement of the integers is left, whose factor
//! has a reduced basis. The proof computes with the combinations of integers that are the coordinates in this basis
//! (`src/proof/lattice.rs`).

use super::around::around_relaxation;
use super::eliminated::EliminatedProblem;
use crate::eliminate::{Elimination, Equations, ReducedModel};
use crate::error::Result;
use crate::lattice::{Diagonals, Piece, Splits, pieces, radius_for};
use crate::linalg::{SchurFactor, joined_sets, minimum_degree, principal_submatrix};
use crate::monitor::{Monitor, may_continue, may_continue_at};
use crate::problem::{Model, Problem};
use crate::proof::{Condensed, Derivation, Distances, Searched, Split};
use crate::search::{Factors, Options, Strategy};

/// The most integers of a part. Their forms are made in exact numbers.
const LARGEST: usize = 512;

/// The most integers of a form with diagonals. They take `m^4` steps.
const WIDEST: usize = 160;

/// The nodes that are predicted for the enumeration of a form. Fewer integers are looked at where a proof needs more.
const NODES: f64 = 2e8;

/// The most multiplications for the splits of a form.
const WORK: u64 = 40_000_000_000;

/// Where a solution with rounding errors is looked for, relative to its squared distance.
const BEYOND: f64 = 1.0 + 1e-6;

/// What a proof needs of a problem without rows and bounds, whose solution is known. None if its integers are no lattice,
/// or too many.
///
/// # Errors
/// Those of the elimination and of the relaxation.
pub(super) fn condense(
    problem: &Problem,
    model: &Model,
    options: &Options,
    solution: &[f64],
    monitor: &mut Monitor,
) -> Result<Option<Derivation>> {
    let elimination = Elimination::new(model, options.ordering, monitor)?;
    let equations = elimination.equations();
    let mut eliminated = EliminatedProblem {
        problem,
        model,
        elimination: &elimination,
        factors: &mut Factors::new(options.ordering),
        earlier: model.guess(),
    };
    let (reduced, _) = eliminated.reduce(monitor)?;
    let _watch = monitor.watch();
    let (centre, relaxation) = around_relaxation(&mut eliminated, &reduced, Strategy::Exact)?;
    let relaxed = centre.expand_each(&relaxation.point, |_, x| x.high);
    let all = Values {
        numbers: reduced
            .unknowns()
            .iter()
            .map(|&u| equations.numbers[u as usize])
            .collect(),
        relaxed: elimination.with_introduced(&equations, &relaxed),
        solution: elimination.with_introduced(&equations, solution),
    };
    let mut derivation = Derivation {
        is_begun: true,
        defined: equations.defined.clone(),
        ..Derivation::default()
    };
    for part in parts(model, &equations, &all)? {
        may_continue()?;
        let Some(searched) = part.condensed(&reduced, &all)? else {
            return Ok(None);
        };
        derivation.parts.push(searched);
    }
    Ok(Some(derivation))
}

/// The values of all unknowns by their numbers in the proof, and the number of each reduced unknown.
struct Values {
    numbers: Vec<u32>,
    relaxed: Vec<f64>,
    solution: Vec<f64>,
}

/// The parts that nothing couples.
fn parts(model: &Model, equations: &Equations, all: &Values) -> Result<Vec<Members>> {
    let (mut set_of, count) = coupled(model)?;
    for sum in &equations.defined {
        set_of.push(sum.first().map_or(0, |&(j, _)| set_of[j as usize]));
    }
    let mut parts = vec![Members::default(); count];
    for (y, &unknown) in all.numbers.iter().enumerate() {
        parts[set_of[unknown as usize] as usize].kept.push(y as u32);
    }
    for &(row, unknown) in &equations.solved {
        let part = &mut parts[set_of[unknown as usize] as usize];
        part.solved.push((row, unknown));
    }
    parts.retain(|part| !part.kept.is_empty() || !part.solved.is_empty());
    Ok(parts)
}

/// The sets of unknowns that the objective or constraints couple: the set of each one, and the number of sets. Pinned
/// unknowns couple nothing.
fn coupled(model: &Model) -> Result<(Vec<u32>, usize)> {
    let mut before: Vec<Vec<usize>> = vec![Vec::new(); model.variables()];
    let is_free = |j: usize| model.pinned().get(j).is_none();
    for (i, j, _) in model.hessian().entries() {
        let (i, j) = (i as usize, j as usize);
        if i != j && is_free(i) && is_free(j) {
            before[i.max(j)].push(i.min(j));
        }
    }
    for row in 0..model.constraints().rows() {
        let members = model.constraints().row(row).map(|(j, _)| j);
        let members: Vec<usize> = members.filter(|&j| is_free(j)).collect();
        for pair in members.windows(2) {
            before[pair[0].max(pair[1])].push(pair[0].min(pair[1]));
        }
    }
    let before = |i: usize| before[i].iter().copied();
    Ok(joined_sets(model.variables(), before, may_continue_at)?)
}

/// The unknowns of a part.
#[derive(Debug, Clone, Default)]
struct Members {
    /// Those that are left, as reduced unknowns.
    kept: Vec<u32>,
    /// Constraints, and the unknown that each one gives.
    solved: Vec<(u32, u32)>,
}

impl Members {
    /// What a proof needs of the part: its unknowns in the order in which the factor of the checker takes them, the
    /// integers last of those that are left.
    fn condensed(&self, reduced: &ReducedModel, all: &Values) -> Result<Option<Searched>> {
        let hessian = principal_submatrix(reduced.hessian(), &self.kept)?;
        let is_integer = |&at: &u32| {
            let y = self.kept[at as usize];
            reduced.integers().binary_search(&y).is_ok()
        };
        let (integers, continuous): (Vec<u32>, Vec<u32>) =
            (0..self.kept.len() as u32).partition(is_integer);
        if integers.len() > LARGEST {
            return Ok(None);
        }
        let order = minimum_degree(&principal_submatrix(&hessian, &continuous)?)?;
        let number = |&at: &u32| all.numbers[self.kept[at as usize] as usize];
        let first = order.iter().map(|&k| continuous[k as usize]);
        let kept: Vec<u32> = first.chain(integers.iter().copied()).collect();
        let mut unknowns: Vec<u32> = kept.iter().map(number).collect();
        unknowns.extend(self.solved.iter().map(|&(_, unknown)| unknown));
        let mut forms = Vec::new();
        if !integers.is_empty() {
            let factor = SchurFactor::new(&hessian, &continuous, &integers)?;
            let (r, full) = factor.schur();
            let numbers: Vec<u32> = integers.iter().map(number).collect();
            let point: Vec<f64> = numbers.iter().map(|&i| all.relaxed[i as usize]).collect();
            let mut stop = |_| may_continue().is_err();
            let pieces = pieces(numbers.len(), r, full, &point, &mut stop)?;
            may_continue()?;
            for mut piece in pieces {
                if !piece.is_regular() {
                    return Ok(None);
                }
                forms.push(distances(&mut piece, &numbers, &all.solution)?);
            }
        }
        let point = unknowns.iter().map(|&i| all.relaxed[i as usize]).collect();
        Ok(Some(Searched {
            unknowns,
            condensed: Some(Condensed {
                solved: self.solved.clone(),
                point,
                forms,
            }),
            ..Searched::default()
        }))
    }
}

/// The distances in the lattice of a piece, of which the integers have these numbers.
fn distances(piece: &mut Piece, numbers: &[u32], solution: &[f64]) -> Result<Distances> {
    let m = piece.places.len();
    let numbers: Vec<u32> = piece.places.iter().map(|&at| numbers[at]).collect();
    let known: Vec<i64> = numbers
        .iter()
        .map(|&i| solution[i as usize] as i64)
        .collect();
    let steps = piece.target.steps(&piece.basis, &known)?;
    piece.take(steps);
    let mut combinations = vec![Vec::new(); m];
    for (at, &i) in numbers.iter().enumerate() {
        let unit: Vec<i64> = (0..m).map(|k| i64::from(k == at)).collect();
        let column = piece.basis.whole_coordinates(&unit)?;
        for (combination, by) in combinations.iter_mut().zip(column) {
            if by != 0 {
                combination.push((i, by as f64));
            }
        }
    }
    let diagonals = match m <= WIDEST {
        true => Diagonals::new(&piece.basis, &mut || may_continue().is_err()),
        false => None,
    };
    may_continue()?;
    let row = |i: usize| (i..m).map(|j| piece.basis.r(i, j)).collect();
    let whole = piece.value * BEYOND;
    let square = radius_for(&piece.basis, diagonals.as_ref(), NODES, whole);
    let (splits, level) = match square < whole {
        true => splits(piece, square)?,
        false => (Vec::new(), 0.0),
    };
    Ok(Distances {
        combinations,
        rows: (0..m).map(row).collect(),
        diagonals: diagonals.map_or_else(Vec::new, |all| {
            (1..m).map(|k| all.level(k).to_vec()).collect()
        }),
        splits,
        level,
        square,
    })
}

/// The splits that show more than an enumeration up to a squared distance, and the number that is taken off; none if
/// there are no such.
fn splits(piece: &Piece, square: f64) -> Result<(Vec<Split>, f64)> {
    let mut spent = 0;
    let mut stop = |work: u64| {
        spent += work;
        spent > WORK || may_continue().is_err()
    };
    let found = Splits::new(&piece.basis, &piece.target, piece.value, &mut stop);
    may_continue()?;
    let Some(found) = found.filter(|found| found.bound > square) else {
        return Ok((Vec::new(), 0.0));
    };
    let all = found.splits.iter().map(|split| {
        let whole = |&(k, entry): &(usize, i32)| f64::from(entry) * piece.target.whole[k] as f64;
        let vector = split.vector.iter();
        Split {
            at: split.floor + vector.clone().map(whole).sum::<f64>(),
            vector: vector.map(|&(k, entry)| (k as u32, entry)).collect(),
            by: split.multiplier,
        }
    });
    let all: Vec<Split> = all.collect();
    let quarters: f64 = all.iter().map(|split| 0.25 * split.by).sum();
    Ok((all, (quarters - found.constant).max(0.0)))
}
