//! *Local* integers: integers that couple to few unknowns, none of them integer. The period jumps of an
//! orientation field are local: each couples to two angles.
//!
//! While a local integer is free, it follows its unknowns exactly. A least-squares row with a free local
//! integer therefore leaves no entry in the Schur complement.

use super::Sparse;

/// The largest number of couplings of a local integer. More would fill the Schur complement.
const FEW: usize = 4;

/// Which unknowns of the matrix with lower triangle `lower` are local integers.
pub(super) fn local_integers(lower: &Sparse, integer: &[bool]) -> Vec<bool> {
    let n = lower.rows();
    let mut couplings = vec![0usize; n];
    let mut local = vec![false; n];
    for (i, j, v) in lower.entries() {
        let (i, j) = (i as usize, j as usize);
        if i == j {
            local[i] = integer[i] && v > 0.0;
        }
    }
    for (i, j, _) in lower.entries().filter(|&(i, j, v)| i != j && v != 0.0) {
        let (i, j) = (i as usize, j as usize);
        couplings[i] += 1;
        couplings[j] += 1;
        if integer[i] && integer[j] {
            local[i] = false;
            local[j] = false;
        }
    }
    for (p, count) in local.iter_mut().zip(couplings) {
        *p &= count <= FEW;
    }
    local
}
