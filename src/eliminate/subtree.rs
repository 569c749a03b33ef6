//! Long rows are shortened by sums over the subtrees of a spanning tree.
//!
//! Solving a row `sum_v a_v x_v + (rest) = d` of thousands of unknowns for one of them would couple
//! all the others: a dense Hessian. Its solutions have a sparse basis all the same, of pairs of
//! unknowns that move against each other. Take a spanning tree of the unknowns, and for each the
//! sum over its subtree:
//!
//! ```text
//! s_v = a_v x_v + sum of s_c over the children c of v,    so    x_v = (s_v - sum of s_c) / a_v,
//! ```
//!
//! one to one, and the row becomes `s_root + (rest) = d`, which is short. With a tree along the
//! edges of the Hessian's graph only near unknowns get coupled. Children hang one below the other
//! (Knuth 1997, section 2.3.2: first child, next sibling), so that none has more than two and an
//! unknown with very many neighbours does no harm.
//!
//! Integers with equal |a_v| are shortened alike: `x_v = +-(s_v - sum of s_c) / |a|` with `s` in
//! units of `|a|` is unimodular. Each `s_v` is scaled by the smaller of |a_v| and |a_parent|, which
//! keeps the columns of the basis at unit size.
//!
//! Sums of sums lose accuracy (the condition number multiplies), so the length that calls for
//! them grows eightfold with each level.

use super::stack::Substitution;
use super::tableau::Tableau;
use super::tolerance::LONG;
use super::unknowns::Unknowns;
use crate::Result;
use crate::linalg::Sparse;
use crate::solve::Monitor;

/// A level of sums of sums costs this factor in the length that is tolerated.
const LEVEL: usize = 8;

/// Replaces each long group of like unknowns in row `r`, which must be free of replaced unknowns,
/// by one.
pub(super) fn shorten(tableau: &mut Tableau, r: usize, monitor: &mut Monitor) -> Result<()> {
    let row = &tableau.rows[r];
    if row.entries.len() <= LONG {
        return Ok(());
    }
    // Continuous unknowns are one group; each |coefficient| of integers is one.
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
    if groups.is_empty() {
        return Ok(());
    }
    let upper = tableau.model.hessian().transpose();
    for group in groups {
        shorten_group(tableau, r, &group, &upper, monitor)?;
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
    upper: &Sparse,
    monitor: &mut Monitor,
) -> Result<()> {
    let unknowns = &tableau.unknowns;
    let places: Vec<u32> = group.iter().map(|e| unknowns.place[e.0 as usize]).collect();
    let tree = Tree::new(&places, tableau.model.hessian(), upper, monitor)?;
    let mut unit: Vec<f64> = group.iter().map(|e| e.1.abs()).collect();
    for &v in tree.order.iter().rev() {
        for child in tree.children(v) {
            unit[child] = unit[child].min(group[v].1.abs());
        }
    }
    let mut guess = vec![0.0; group.len()];
    for &v in tree.order.iter().rev() {
        let below: f64 = tree.children(v).map(|c| unit[c] * guess[c]).sum();
        let (unknown, a) = group[v];
        guess[v] = (a * tableau.unknowns.guess[unknown as usize] + below) / unit[v];
    }
    let first = tableau.unknowns.len() as u32;
    let root = tree.order[0];
    for (v, &(unknown, _)) in group.iter().enumerate() {
        let unknowns = &mut tableau.unknowns;
        let integer = unknowns.integer[unknown as usize];
        let depth = unknowns.depth[unknown as usize].saturating_add(1);
        // The root's sum is a number that the row gives, or nearly so: it has no place.
        let place = if v == root {
            Unknowns::NOWHERE
        } else {
            places[v]
        };
        unknowns.introduce(integer, guess[v], place, depth);
    }
    for (v, &(pivot, a)) in group.iter().enumerate() {
        monitor.check()?;
        let below = tree.children(v).map(|c| (first + c as u32, -unit[c] / a));
        let terms = std::iter::once((first + v as u32, unit[v] / a)).chain(below);
        let by = Substitution {
            pivot,
            constraint: r as u32,
            constant: 0.0,
            magnitude: 1.0,
            constant_magnitude: 0.0,
        };
        tableau.unknowns.replaced[pivot as usize] = tableau.stack.len() as u32;
        tableau.stack.push(by, terms);
    }
    let row = &mut tableau.rows[r];
    let mut gone = vec![false; first as usize];
    group.iter().for_each(|e| gone[e.0 as usize] = true);
    row.entries.retain(|e| e.0 >= first || !gone[e.0 as usize]);
    row.entries.push((first + root as u32, unit[root]));
    if !tableau.unknowns.integer[group[0].0 as usize] {
        row.continuous = 1;
    }
    tableau.occurrences.resize(tableau.unknowns.len());
    Ok(())
}

/// A spanning tree of the members of a group, as a binary tree.
struct Tree {
    /// Members, parents before children.
    order: Vec<usize>,
    first_child: Vec<Option<u32>>,
    next_sibling: Vec<Option<u32>>,
}

impl Tree {
    /// Breadth first along the Hessian's graph; the components hang together as siblings.
    fn new(places: &[u32], lower: &Sparse, upper: &Sparse, monitor: &mut Monitor) -> Result<Self> {
        let mut member: Vec<Option<u32>> = vec![None; lower.rows()];
        for (v, &place) in places.iter().enumerate() {
            if place != Unknowns::NOWHERE {
                member[place as usize] = Some(v as u32);
            }
        }
        let mut tree = Tree {
            order: Vec::with_capacity(places.len()),
            first_child: vec![None; places.len()],
            next_sibling: vec![None; places.len()],
        };
        let mut seen = vec![false; places.len()];
        let mut last_root: Option<usize> = None;
        for root in 0..places.len() {
            if seen[root] {
                continue;
            }
            seen[root] = true;
            if let Some(last) = last_root.replace(root) {
                tree.next_sibling[last] = Some(root as u32);
            }
            let mut next = tree.order.len();
            tree.order.push(root);
            while let Some(&v) = tree.order.get(next) {
                monitor.check()?;
                next += 1;
                if places[v] == Unknowns::NOWHERE {
                    continue;
                }
                let place = places[v] as usize;
                let mut last_child: Option<usize> = None;
                for (j, _) in lower.row(place).chain(upper.row(place)) {
                    let Some(child) = member[j].filter(|&c| !seen[c as usize]) else {
                        continue;
                    };
                    seen[child as usize] = true;
                    tree.order.push(child as usize);
                    match last_child.replace(child as usize) {
                        None => tree.first_child[v] = Some(child),
                        Some(last) => tree.next_sibling[last] = Some(child),
                    }
                }
            }
        }
        Ok(tree)
    }

    /// First child and next sibling, which both count as children here.
    fn children(&self, v: usize) -> impl Iterator<Item = usize> + use<> {
        let both = [self.first_child[v], self.next_sibling[v]];
        both.into_iter().flatten().map(|c| c as usize)
    }
}
