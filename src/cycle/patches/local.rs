//! The lattice of a patch's own charges: the step times the inverse of its diagonal block of G, reduced.
//!
//! With the sums `c` around the own cycles, less what the descendants send, the patch adds the energy `|w|^2`
//! with `w = G_SS^-1 (c + step n)`. In a reduced basis U of the charges, `n = U z`, and with an orthogonal Q
//!
//! ```text
//! |w| = |R z + M c|,    R = step Q' G_SS^-1 U,    M = Q' G_SS^-1.
//! ```

use super::factor::Front;
use crate::error::Result;
use crate::lattice::{Basis, lll};
use crate::monitor::is_wanted_at;

/// The reduced lattice of one patch, and what an entry of its list needs.
#[derive(Debug, Clone)]
pub(super) struct Local {
    pub own: usize,
    pub step: f64,
    /// R by rows.
    pub r: Vec<f64>,
    /// M by rows.
    pub map: Vec<f64>,
    /// U by rows.
    pub charges: Vec<f64>,
    /// `-M alpha`, where alpha are the sums of offsets around the own cycles.
    pub target: Vec<f64>,
    pub alpha: Vec<f64>,
}

impl Local {
    /// Reduces the lattice. `stop` gets the multiplications and says whether to end early, which gives a
    /// worse basis of the same lattice.
    ///
    /// # Errors
    /// For entries that are too large to be exact, and the end of the call.
    pub fn new(
        front: &Front,
        alpha: &[f64],
        step: f64,
        stop: &mut dyn FnMut(u64) -> bool,
    ) -> Result<Self> {
        let n = front.own;
        let inverse = inverse(&front.diagonal, n)?;
        // In the reverse order of rows and columns the inverse is upper triangular.
        let mut factor = vec![0.0; n * n];
        for i in 0..n {
            for j in 0..=i {
                factor[(n - 1 - j) * n + n - 1 - i] = step * inverse[i * n + j];
            }
        }
        let mut basis = Basis::from_factor(n, factor, true);
        if n > 0 {
            lll(&mut basis, 1, stop)?;
        }
        let mut r = vec![0.0; n * n];
        let mut charges = vec![0.0; n * n];
        for j in 0..n {
            for (i, &v) in basis.column(j).iter().enumerate() {
                r[i * n + j] = v;
            }
            for (i, u) in basis.transform().column(j).into_iter().enumerate() {
                charges[(n - 1 - i) * n + j] = u;
            }
        }
        let mut map = vec![0.0; n * n];
        let mut unit = vec![0.0; n];
        for j in 0..n {
            is_wanted_at(j, n)?;
            unit[n - 1 - j] = 1.0;
            let coordinates = basis.coordinates(&unit);
            unit[n - 1 - j] = 0.0;
            for i in 0..n {
                let row = &r[i * n + i..(i + 1) * n];
                let sum: f64 = row.iter().zip(&coordinates[i..]).map(|(r, z)| r * z).sum();
                map[i * n + j] = sum / step;
            }
        }
        let target = (0..n)
            .map(|i| -dot(&map[i * n..(i + 1) * n], alpha))
            .collect();
        Ok(Local {
            own: n,
            step,
            r,
            map,
            charges,
            target,
            alpha: alpha.to_vec(),
        })
    }
}

/// The inverse of a lower triangular matrix, by rows.
///
/// # Errors
/// The end of the call.
pub(super) fn inverse(lower: &[f64], n: usize) -> Result<Vec<f64>> {
    let mut inverse = vec![0.0; n * n];
    for i in 0..n {
        is_wanted_at(i, n)?;
        for k in 0..i {
            let factor = lower[i * n + k];
            for j in 0..=k {
                inverse[i * n + j] -= factor * inverse[k * n + j];
            }
        }
        inverse[i * n + i] = 1.0;
        let pivot = lower[i * n + i];
        inverse[i * n..=i * n + i]
            .iter_mut()
            .for_each(|v| *v /= pivot);
    }
    Ok(inverse)
}

pub(super) fn dot(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}
