//! Long rows are shortened by sums over the subtrees of a shallow tree.
//!
//! A row `sum_v a_v x_v + (rest) = d` may have thousands of unknowns. If it is solved for one of them, all
//! the others are coupled, and the Hessian becomes dense. The solutions of the row still have a sparse basis,
//! of pairs of unknowns that move against each other. To find it, arrange the unknowns in a tree and
//! introduce for each the sum over its subtree:
//!
//! ```text
//! s_v = a_v x_v + sum of s_c over the children c of v,    so    x_v = (s_v - sum of s_c) / a_v,
//! ```
//!
//! This is one to one, and the row becomes `s_root + (rest) = d`, which is short. `cluster` builds the tree:
//! in each group of a few near unknowns, the heaviest is the parent of the others. Hence only near unknowns
//! are coupled, and the depth is logarithmic. With `s_v` in units of |a_v|, all coefficients are at most 1.
//! Chains of partial sums would be as sparse, but their condition number grows with the length and with the
//! ratio of neighbouring weights.
//!
//! Integers with equal |a_v| are treated in the same way: `x_v = +-(s_v - sum of s_c)` is unimodular.
//!
//! Sums of sums lose accuracy (the condition number multiplies), so the length that calls for
//! them grows eightfold with each level.

use super::cluster::Tree;
use super::steps::Step;
use super::substitution::Substitution;
use super::tableau::Tableau;
use super::tolerance::LONG;
use super::unknowns::Unknowns;
use crate::error::Result;
use crate::monitor::Monitor;

/// The factor by which the tolerated length grows with each level of sums.
const LEVEL: usize = 8;

/// Replaces each long group of like unknowns in row `r` by one unknown. The row must hold no replaced
/// unknown.
pub(super) fn shorten(tableau: &mut Tableau, r: usize, monitor: &mut Monitor) -> Result<()> {
    let row = &tableau.rows[r];
    if row.entries.len() <= LONG {
        return Ok(());
    }
    // Continuous unknowns form one group. Integers form one group for each |coefficient|.
    let integer = &tableau.unknowns.integer;
    let key = |e: &(u32, f64)| match integer[e.0 as usize] {
        false => 0,
        true => e.1.abs().to_bits(),
    };
    let mut entries = row.entries.clone();
    entries.sort_by_key(key);
    let groups: Vec<Vec<(u32, f64)>> = entries
        .chunk_by(|a, b| key(a) == key(b))
        .filter(|group| is_long(group, &tableau.unknowns))
        .map(<[_]>::to_vec)
        .collect();
    for group in groups {
        shorten_group(tableau, r, &group, monitor)?;
    }
    Ok(())
}

fn is_long(group: &[(u32, f64)], unknowns: &Unknowns) -> bool {
    let depth = |e: &(u32, f64)| unknowns.depth[e.0 as usize];
    let deepest = group.iter().map(depth).max().unwrap_or(0);
    let limit = LEVEL
        .checked_pow(u32::from(deepest))
        .and_then(|factor| factor.checked_mul(LONG));
    limit.is_some_and(|limit| group.len() > limit)
}

fn shorten_group(
    tableau: &mut Tableau,
    r: usize,
    group: &[(u32, f64)],
    monitor: &mut Monitor,
) -> Result<()> {
    let unknowns = &tableau.unknowns;
    let places: Vec<u32> = group.iter().map(|e| unknowns.place[e.0 as usize]).collect();
    let weights: Vec<f64> = group.iter().map(|e| e.1.abs()).collect();
    let tree = Tree::new(&places, &weights, tableau.model.hessian(), monitor)?;
    let first = tableau.unknowns.len() as u32;
    for &v in &tree.order {
        let below = tree.children(v).map(|c| (first + c as u32, weights[c]));
        let terms = std::iter::once(group[v]).chain(below);
        let sum = first + v as u32;
        tableau.definitions.push(sum, terms, weights[v]);
    }
    let root = tree.root;
    for (v, &(unknown, _)) in group.iter().enumerate() {
        let unknowns = &mut tableau.unknowns;
        let integer = unknowns.integer[unknown as usize];
        let depth = unknowns.depth[unknown as usize].saturating_add(1);
        // The row determines the sum of the root, or nearly so. The sum therefore has no place.
        let place = if v == root {
            Unknowns::NOWHERE
        } else {
            places[v]
        };
        unknowns.introduce(integer, place, depth);
    }
    for (v, &(pivot, a)) in group.iter().enumerate() {
        monitor.check()?;
        let below = tree
            .children(v)
            .map(|c| (first + c as u32, -weights[c] / a));
        let terms = std::iter::once((first + v as u32, weights[v] / a)).chain(below);
        let by = Substitution {
            pivot,
            constraint: r as u32,
            largest: 1.0,
            magnitude: 1.0,
            denominator: None,
        };
        tableau.unknowns.replaced[pivot as usize] = tableau.stack.len() as u32;
        tableau.stack.push(by, terms);
        tableau.steps.push(Step::Introduce);
    }
    let row = &mut tableau.rows[r];
    let mut gone = vec![false; first as usize];
    group.iter().for_each(|e| gone[e.0 as usize] = true);
    row.entries.retain(|e| e.0 >= first || !gone[e.0 as usize]);
    row.entries.push((first + root as u32, weights[root]));
    if !tableau.unknowns.integer[group[0].0 as usize] {
        row.continuous = 1;
    }
    tableau.occurrences.resize(tableau.unknowns.len());
    Ok(())
}
