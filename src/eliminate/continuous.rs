//! Solves a row with a continuous unknown for such an unknown.

use super::tableau::Tableau;
use crate::error::Result;

/// Solves row `r`, which has a continuous unknown, for one of them. Among those whose coefficient is not
/// small (threshold pivoting) it takes the one that occurs in the fewest other rows; ties go to the lowest
/// unknown.
pub(super) fn eliminate(tableau: &mut Tableau, r: usize) -> Result<()> {
    let entries = &tableau.rows[r].entries;
    let integer = &tableau.unknowns.integer;
    let continuous = (0..entries.len()).filter(|&at| !integer[entries[at].0 as usize]);
    let largest = continuous
        .clone()
        .fold(0.0, |m: f64, at| m.max(entries[at].1.abs()));
    let at = continuous
        .filter(|&at| entries[at].1.abs() >= tableau.pivot_threshold() * largest)
        .min_by_key(|&at| tableau.cost(entries[at].0));
    match at {
        Some(at) => tableau.solve_for(r, at),
        None => Err(tableau.overflow(r)),
    }
}
