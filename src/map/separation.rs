//! Separation rows. They keep cones, corners of a triangle and feature curves in the order in which they lie
//! on the surface (`bommes2013`).

use crate::error::Result;
use crate::problem::Problem;
use crate::solve::SoftRow;

/// The cost of a row that is missed by one unit, times the distance in quads of what it separates: more than
/// any map costs, so that only rows which contradict each other are missed.
const WEIGHT: f64 = 1e3;

/// The least distance that counts.
const NEAREST: f64 = 0.1;

/// `by` times the coordinate `axis` (0 for u, 1 for v) of the second copy minus that of the first is at least
/// one. They should lie `distance` quads apart.
pub(crate) fn apart(copies: [u32; 2], axis: usize, by: f64, distance: f64) -> SoftRow {
    let [a, b] = copies.map(|copy| 2 * copy as usize + axis);
    row(vec![(b, by.signum()), (a, -by.signum())], 1.0, distance)
}

/// The row with these terms between elements that should lie `distance` quads apart.
pub(crate) fn row(terms: Vec<(usize, f64)>, least: f64, distance: f64) -> SoftRow {
    let weight = WEIGHT / distance.abs().max(NEAREST);
    SoftRow {
        terms,
        least,
        weight,
    }
}

/// A problem with only the constraints of another.
pub(crate) fn constraints_of(stated: &Problem) -> Result<Problem> {
    let mut bare = Problem::new(stated.variables())?;
    let rows = stated.constraint_rows();
    for row in 0..rows.len() {
        let (indices, coefficients): (Vec<_>, Vec<_>) = rows.row(row).unzip();
        bare.add_constraint(&indices, &coefficients, rows.rhs()[row])?;
    }
    Ok(bare)
}
