//! *Private* integers: those that couple to few unknowns, none of them integer, such as a period
//! jump of an orientation field, which couples to two angles.
//!
//! While it is free, a private integer follows its unknowns exactly, and the Schur complement that
//! remains has not even an entry left of a row that it absorbs.

use super::Sparse;

/// More couplings than this would fill the Schur complement.
const FEW: usize = 4;

/// Which unknowns of the matrix with lower triangle `lower` are private integers.
pub(super) fn local_integers(lower: &Sparse, integer: &[bool]) -> Vec<bool> {
    let n = lower.rows();
    let mut couplings = vec![0usize; n];
    let mut private = vec![false; n];
    for (i, j, v) in lower.entries() {
        let (i, j) = (i as usize, j as usize);
        if i == j {
            private[i] = integer[i] && v > 0.0;
        }
    }
    for (i, j, _) in lower.entries().filter(|&(i, j, v)| i != j && v != 0.0) {
        let (i, j) = (i as usize, j as usize);
        couplings[i] += 1;
        couplings[j] += 1;
        if integer[i] && integer[j] {
            private[i] = false;
            private[j] = false;
        }
    }
    for (p, count) in private.iter_mut().zip(couplings) {
        *p &= count <= FEW;
    }
    private
}
