//! The factor `K = G G'` of the cycles' matrix `K = M W^-1 M'`, along the tree of patches.
//!
//! Two cycles share an edge only if the patch of one is an ancestor of the other's, so K is block-arrow, and
//! a multifrontal factorization (`duff1983`) needs only dense blocks: for each patch the rows of its own
//! cycles and those of the ancestors' cycles that meet the patch.

use std::ops::Range;

use super::dissect::Patch;
use super::nested::NestedBasis;
use crate::cycle::graph::Graph;
use crate::monitor::{is_room_for, is_wanted_at};

/// A front of more rows is not factored.
const WIDEST: usize = 3_000;

/// The part of G for the cycles of one patch.
#[derive(Debug, Clone)]
pub(super) struct Front {
    /// The number of the patch's own cycles.
    pub own: usize,
    /// The ancestors' cycles that meet the patch, in increasing order.
    pub above: Vec<u32>,
    /// By rows: the lower triangular block of the own cycles.
    pub diagonal: Vec<f64>,
    /// By rows: the block of the ancestors' cycles.
    pub below: Vec<f64>,
    /// By child: the place of each of the child's ancestor rows, among the own rows first, then among those
    /// above.
    pub places: Vec<Vec<u32>>,
}

/// The factor by patches. None if a front is too large, also for the memory that is left, if a pivot is not positive,
/// if the call ends, or if `stop`, which gets the multiplications, says so.
pub(super) fn factor(
    graph: &Graph,
    patches: &[Patch],
    basis: &NestedBasis,
    stop: &mut dyn FnMut(u64) -> bool,
) -> Option<Vec<Front>> {
    let mut fronts: Vec<Front> = Vec::with_capacity(patches.len());
    let mut updates: Vec<Vec<f64>> = vec![Vec::new(); patches.len()];
    let mut place = vec![u32::MAX; basis.len()];
    // By cycle: the last patch that meets it from below.
    let mut met_by = vec![usize::MAX; basis.len()];
    for (at, patch) in patches.iter().enumerate() {
        let rows = basis.own[at].clone();
        let n = rows.len();
        let mut above: Vec<u32> = Vec::new();
        let mut meets = |j: u32| {
            if j as usize >= rows.end && met_by[j as usize] != at {
                met_by[j as usize] = at;
                above.push(j);
            }
        };
        for &child in patch.children.iter().flatten() {
            fronts[child].above.iter().copied().for_each(&mut meets);
        }
        for i in rows.clone() {
            for &(e, _) in basis.cycles.get(i) {
                let through = basis.through[e as usize].iter();
                through.map(|t| t.0).for_each(&mut meets);
            }
        }
        above.sort_unstable();
        let all = n + above.len();
        // The front, what is kept of it, and its update.
        let bytes = 3 * std::mem::size_of::<f64>();
        if all > WIDEST || stop((n * all * all) as u64 / 2) || !is_room_for(all * all, bytes) {
            return None;
        }
        for (k, i) in rows.clone().enumerate() {
            place[i] = k as u32;
        }
        for (k, &j) in above.iter().enumerate() {
            place[j as usize] = (n + k) as u32;
        }
        let mut front = vec![0.0; all * all];
        for (k, i) in rows.clone().enumerate() {
            for &(e, sign) in basis.cycles.get(i) {
                let weight = graph.edges[e as usize].weight;
                for &(j, other) in &basis.through[e as usize] {
                    if j as usize >= i {
                        front[place[j as usize] as usize * all + k] +=
                            f64::from(sign * other) / weight;
                    }
                }
            }
        }
        let mut places = Vec::new();
        for &child in patch.children.iter().flatten() {
            let to: Vec<u32> = fronts[child]
                .above
                .iter()
                .map(|&j| place[j as usize])
                .collect();
            let update = std::mem::take(&mut updates[child]);
            let m = to.len();
            for (i, &row) in to.iter().enumerate() {
                for (j, &column) in to[..=i].iter().enumerate() {
                    front[row as usize * all + column as usize] += update[i * m + j];
                }
            }
            places.push(to);
        }
        eliminate(&mut front, all, n)?;
        let block = |rows: Range<usize>, columns: Range<usize>| {
            let mut block = Vec::with_capacity(rows.len() * columns.len());
            for i in rows {
                block.extend_from_slice(&front[i * all + columns.start..i * all + columns.end]);
            }
            block
        };
        updates[at] = block(n..all, n..all);
        fronts.push(Front {
            own: n,
            above,
            diagonal: block(0..n, 0..n),
            below: block(n..all, 0..n),
            places,
        });
    }
    Some(fronts)
}

/// Eliminates the first `n` columns of a lower triangle by rows. None if a pivot is not positive, or if the call ends.
pub(super) fn eliminate(front: &mut [f64], all: usize, n: usize) -> Option<()> {
    let mut column = vec![0.0; all];
    for k in 0..n {
        is_wanted_at(k, all).ok()?;
        let pivot = front[k * all + k];
        if pivot.is_nan() || pivot <= 0.0 {
            return None;
        }
        let root = pivot.sqrt();
        for i in k..all {
            let entry = &mut front[i * all + k];
            *entry = if i == k { root } else { *entry / root };
            column[i] = *entry;
        }
        for i in k + 1..all {
            let factor = column[i];
            if factor != 0.0 {
                let row = &mut front[i * all + k + 1..=i * all + i];
                for (entry, other) in row.iter_mut().zip(&column[k + 1..=i]) {
                    *entry -= factor * other;
                }
            }
        }
    }
    // The strict upper triangle held nothing but zeros.
    Some(())
}
