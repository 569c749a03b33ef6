//! The independent parts of a reduced model: integers that its Hessian does not couple, directly or through
//! other unknowns, are in different components.
//!
//! What depends on the Hessian alone is a [`Part`], which can be made before the model's other numbers are known.

use std::sync::Arc;

use super::{Expansion, ReducedModel};
use crate::error::Result;
use crate::linalg::{NO_PLACE, Sparse, columns, joined_sets, principal_submatrix};
use crate::monitor::{may_continue, may_continue_at};

/// One component: some unknowns of a model, and the model in these alone.
#[derive(Debug, Clone)]
pub struct Component {
    /// The unknowns in the whole model, increasing.
    pub members: Vec<u32>,
    /// The model, without the constant of the whole one.
    pub model: ReducedModel,
}

/// What a component has of the Hessian of a model, around whatever point that is stated.
#[derive(Debug)]
pub struct Part {
    /// The unknowns in the whole model, increasing.
    members: Vec<u32>,
    hessian: Arc<Sparse>,
    integers: Vec<u32>,
    continuous: Vec<u32>,
    /// The columns of the expansion, if the component is large; else no rows.
    expansion: Arc<Sparse>,
}

impl Part {
    /// Lower triangle of the Hessian, every diagonal entry stored.
    pub fn hessian(&self) -> &Sparse {
        &self.hessian
    }

    /// The integers, by their places among the members.
    pub fn integers(&self) -> &[u32] {
        &self.integers
    }

    /// The other unknowns, by their places among the members.
    pub fn continuous(&self) -> &[u32] {
        &self.continuous
    }

    /// The component of `model`, which has this Hessian.
    pub fn of(&self, model: &ReducedModel) -> Component {
        let members = &self.members;
        let pick = |v: &[f64]| -> Vec<f64> { members.iter().map(|&i| v[i as usize]).collect() };
        let offset = match self.expansion.rows() {
            0 => Vec::new(),
            _ => model.expansion.offset().to_vec(),
        };
        Component {
            members: members.clone(),
            model: ReducedModel {
                hessian: Arc::clone(&self.hessian),
                gradient: pick(&model.gradient),
                constant: 0.0,
                integers: self.integers.clone(),
                continuous: self.continuous.clone(),
                guess: pick(&model.guess),
                origin: members.iter().map(|&i| model.origin(i as usize)).collect(),
                rounding: model.rounding.of(members),
                free: members.iter().map(|&i| model.free[i as usize]).collect(),
                expansion: Expansion::new(Arc::clone(&self.expansion), offset),
            },
        }
    }
}

/// The sets of unknowns that the Hessian couples: the set of each unknown, and the number of sets.
fn coupled(model: &ReducedModel) -> Result<(Vec<u32>, usize)> {
    let before = |i: usize| {
        let row = model.hessian().row(i);
        let coupled = row.filter(move |&(j, v)| j != i && v != 0.0);
        coupled.map(|(j, _)| j)
    };
    Ok(joined_sets(model.dim(), before, may_continue_at)?)
}

/// Whether integers are in different sets.
fn divides(set: &[u32], integers: &[u32]) -> bool {
    let mut sets = integers.iter().map(|&i| set[i as usize]);
    let first = sets.next();
    sets.any(|other| Some(other) != first)
}

/// The components of `model` that have integers, in the order of their first unknowns. No part at all
/// if there is only one.
///
/// # Errors
/// For lack of memory.
pub fn parts(model: &ReducedModel) -> Result<Vec<Part>> {
    let (set_of, count) = coupled(model)?;
    if !divides(&set_of, model.integers()) {
        return Ok(Vec::new());
    }
    let mut is_integer = vec![false; model.dim()];
    for &i in model.integers() {
        is_integer[i as usize] = true;
    }
    let mut sets: Vec<Vec<usize>> = vec![Vec::new(); count];
    for (i, &set) in set_of.iter().enumerate() {
        sets[set as usize].push(i);
    }
    may_continue()?;
    sets.retain(|set| set.iter().any(|&i| is_integer[i]));
    let mut component = vec![NO_PLACE; model.dim()];
    let mut place = vec![NO_PLACE; model.dim()];
    for (k, set) in sets.iter().enumerate() {
        for (at, &i) in set.iter().enumerate() {
            (component[i], place[i]) = (k as u32, at as u32);
        }
    }
    let mut entries = vec![Vec::new(); sets.len()];
    may_continue()?;
    let large = model.dim() / LARGE;
    let is_small: Vec<bool> = sets.iter().map(|set| set.len() <= large).collect();
    for i in 0..model.dim() {
        let k = component[i];
        if k == NO_PLACE || !is_small[k as usize] {
            continue;
        }
        for (j, v) in model.hessian().row(i).filter(|&(j, _)| component[j] == k) {
            entries[k as usize].push((place[i], place[j], v));
        }
    }
    let made = sets.iter().zip(entries).map(|(set, entries)| {
        let members: Vec<u32> = set.iter().map(|&i| i as u32).collect();
        let of_part = 0..members.len() as u32;
        let (integers, continuous) = of_part.partition(|&at| is_integer[set[at as usize]]);
        let n = members.len();
        let (hessian, expansion) = match n > large {
            true => (
                principal_submatrix(model.hessian(), &members)?,
                columns(model.expansion.matrix(), &members)?,
            ),
            false => (
                Sparse::from_triplets(n, n, entries.into_iter())?,
                Sparse::zeros(0, n),
            ),
        };
        Ok(Part {
            members,
            hessian: Arc::new(hessian),
            integers,
            continuous,
            expansion: Arc::new(expansion),
        })
    });
    made.collect()
}

/// A component with more than one in so many unknowns is large: its entries are copied by themselves, and it has its part
/// of the expansion, which the cycles that the caller knows need. For all the small ones such copies would take more time
/// than the cycles save, and their entries are found in one pass.
const LARGE: usize = 64;

#[cfg(test)]
mod tests {
    use super::{Component, parts};
    use crate::eliminate::{ReducedModel, eliminate};
    use crate::linalg::principal_submatrix;
    use crate::monitor::Monitor;
    use crate::problem::{Model, Problem};

    fn components(model: &ReducedModel) -> Vec<Component> {
        let parts = parts(model).unwrap();
        parts.iter().map(|part| part.of(model)).collect()
    }

    #[test]
    fn the_energy_is_the_sum_of_the_components_energies() {
        // Unknowns 0, 2, 5 are a chain, 1 and 3 are another, 4 is continuous and alone.
        let mut problem = Problem::new(6).unwrap();
        for (i, j) in [(0, 2), (2, 5), (1, 3)] {
            problem
                .add_least_squares(&[i, j], &[1.0, -0.7], 0.3, 1.0)
                .unwrap();
        }
        for i in 0..6 {
            problem
                .add_least_squares(&[i], &[1.0], 0.1 * i as f64, 0.5)
                .unwrap();
        }
        problem.set_integers(&[1, 2]).unwrap();
        let model = Model::new(&problem).unwrap();
        let reduced = eliminate(&model, &mut Monitor::default()).unwrap();
        let parts = components(&reduced);
        assert_eq!(parts[0].members, [0, 2, 5]);
        assert_eq!(parts[1].members, [1, 3]);
        assert_eq!(parts[0].model.integers(), [1]);
        let y = [0.4, -2.0, 3.0, 0.7, 0.0, -1.1];
        let sum: f64 = parts
            .iter()
            .map(|part| {
                let own: Vec<f64> = part.members.iter().map(|&i| y[i as usize]).collect();
                part.model.energy(&own).0
            })
            .sum();
        assert!((reduced.constant() + sum - reduced.energy(&y).0).abs() < 1e-12);
    }

    #[test]
    fn small_components_have_their_entries_as_large_ones_do() {
        // A chain of all unknowns but two, which are a component of their own.
        let pair = [7, 200];
        let chain: Vec<usize> = (0..300).filter(|i| !pair.contains(i)).collect();
        let mut problem = Problem::new(300).unwrap();
        for ends in chain.windows(2).chain([&pair[..]]) {
            let coefficients = [1.0, -0.1 * ends[0] as f64 - 0.7];
            problem
                .add_least_squares(ends, &coefficients, 0.3, 1.0)
                .unwrap();
        }
        problem.set_integers(&[5, 200]).unwrap();
        let model = Model::new(&problem).unwrap();
        let reduced = eliminate(&model, &mut Monitor::default()).unwrap();
        let parts = components(&reduced);
        assert_eq!(
            parts.iter().map(|p| p.members.len()).collect::<Vec<_>>(),
            [298, 2]
        );
        for part in parts {
            let own = principal_submatrix(reduced.hessian(), &part.members).unwrap();
            assert_eq!(part.model.hessian(), &own);
        }
    }
}
