//! Nearest plane: the lattice point that successive rounding reaches in a reduced basis.
//!
//! `babai1986`, section 3. Coordinates are decided from the last to the first, each rounded where
//! the later ones already are. On an LLL-reduced basis the distance is within 2^(m/2) of the
//! least, and in practice within a few per cent of the energy.

use super::{Basis, Target};
use crate::round::nearest;

/// The steps from the whole part of `target` to the lattice point that nearest plane reaches.
///
/// Ties go away from zero, as everywhere in the library. What distances do not decide
/// ([`Basis::decides`]) stays at the whole part.
pub fn nearest_plane(basis: &Basis, target: &Target) -> Vec<i64> {
    let m = basis.rank();
    let mut z = vec![0i64; m];
    // What the decided coordinates add up to, in each row.
    let mut settled = vec![0.0; m];
    for k in (0..m).rev() {
        if basis.is_discrete() || basis.decides(k) {
            z[k] = nearest(target.rest[k] + settled[k] / basis.r(k, k)) as i64;
        }
        let offset = target.rest[k] - z[k] as f64;
        for i in 0..k {
            settled[i] += basis.r(i, k) * offset;
        }
    }
    z
}
