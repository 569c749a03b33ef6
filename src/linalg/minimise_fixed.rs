//! Exact minimisation with some unknowns held: the block of the free unknowns is factored.

use super::{Cholesky, Sparse, minimise_bounded, principal_submatrix};
use crate::error::Result;

/// Minimises `1/2 x'Ax + g'x` over the unknowns that are not `held`. The held ones keep their values in
/// `point`. As for `minimise_bounded`, the objective must be known to have a minimum.
///
/// # Errors
/// For lack of memory.
pub fn minimise_fixed(
    lower: &Sparse,
    gradient: &[f64],
    held: &[bool],
    point: &[f64],
) -> Result<Vec<f64>> {
    let free: Vec<u32> = (0..held.len() as u32)
        .filter(|&i| !held[i as usize])
        .collect();
    let mut pull = gradient.to_vec();
    for (i, j, v) in lower.entries() {
        let (i, j) = (i as usize, j as usize);
        match (held[i], held[j]) {
            (true, false) => pull[j] += v * point[i],
            (false, true) => pull[i] += v * point[j],
            _ => {}
        }
    }
    let block = principal_submatrix(lower, &free)?;
    let pick = |v: &[f64]| -> Vec<f64> { free.iter().map(|&i| v[i as usize]).collect() };
    let inner = minimise_bounded(&block, &pick(&pull), &pick(point), &Cholesky::new(&block)?)?;
    let mut all = point.to_vec();
    for (&i, &v) in free.iter().zip(&inner) {
        all[i as usize] = v;
    }
    Ok(all)
}
