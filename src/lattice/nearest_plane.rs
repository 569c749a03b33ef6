//! Nearest plane: the lattice point that successive rounding reaches in a reduced basis.
//!
//! The method is that of `babai1986`, section 3. It decides the coordinates from the last to the first and
//! rounds each one, given the later ones. On an LLL-reduced basis the distance is at most 2^(m/2) times the
//! least distance. In practice the energy is within a few per cent of the least.

use super::{Basis, Target};
use crate::round::nearest;

/// The steps from the whole part of `target` to the nearest-plane point.
///
/// Halves are rounded away from zero, as everywhere in the library. A coordinate that distances do not
/// determine ([`Basis::decides`]) keeps its whole part.
pub fn nearest_plane(basis: &Basis, target: &Target) -> Vec<i64> {
    let m = basis.rank();
    let mut z = vec![0i64; m];
    // The contribution of the decided coordinates to each row.
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
