//! LLL reduction with deep insertion, in floating point with an exact transformation.
//!
//! The reduction is that of `lenstra1982`, with the deep insertion of `schnorr1994`, section 3. Rotations,
//! which are stable, update R. A result is accepted only if the Lovasz conditions still hold for the R that
//! is computed again from the exact transformation.

use super::Basis;
use crate::error::Result;

/// The factor delta of the Lovasz condition: the squared length of a vector must be at least this part of
/// the squared length of the one that it would replace.
pub const LOVASZ: f64 = 0.99;

/// The tolerance of the conditions after R was computed again.
const SLACK: f64 = 1e-3;

/// The largest number of rounds. A round is a reduction and a new computation of R.
const ROUNDS: usize = 20;

/// Reduces `basis`. A deep insertion moves a vector forward by at most `depth` places; a `depth` of 1 is
/// plain LLL.
///
/// Before each vector, `stop` gets the multiplications that it will take and says whether to end. A basis
/// that is not fully reduced generates the same lattice and can be used, with a worse result.
///
/// # Errors
/// [`Error::Overflow`](crate::Error::Overflow) if an entry of the transformation exceeds 126 bits.
pub fn lll(basis: &mut Basis, depth: usize, stop: &mut dyn FnMut(u64) -> bool) -> Result<()> {
    for _ in 0..ROUNDS {
        let mut ended = pass(basis, 1, stop)?;
        if depth > 1 {
            ended = ended && pass(basis, depth, stop)?;
        }
        basis.refresh();
        if !ended || is_reduced(basis, LOVASZ - SLACK) {
            break;
        }
    }
    basis.settle();
    for k in 0..basis.rank() {
        basis.size_reduce(k)?;
    }
    Ok(())
}

/// One full sweep. Returns false if it was stopped.
fn pass(basis: &mut Basis, depth: usize, stop: &mut dyn FnMut(u64) -> bool) -> Result<bool> {
    let mut k = 0;
    while k < basis.rank() {
        if stop((basis.dim() * (k + 1)) as u64) {
            return Ok(false);
        }
        basis.size_reduce(k)?;
        match place(basis, k, depth) {
            Some(i) => {
                basis.insert(k, i);
                k = i;
            }
            None => k += 1,
        }
    }
    Ok(true)
}

/// The first place, at most `depth` before `k`, where vector `k` is short enough to be inserted.
fn place(basis: &Basis, k: usize, depth: usize) -> Option<usize> {
    let from = k.saturating_sub(depth);
    let mut left: f64 = (from..=k).map(|i| basis.r(i, k).powi(2)).sum();
    for i in from..k {
        if left < LOVASZ * basis.r(i, i).powi(2) {
            return Some(i);
        }
        left -= basis.r(i, k).powi(2);
    }
    None
}

/// Whether the Lovasz conditions hold with `delta`, and all vectors are size-reduced.
pub fn is_reduced(basis: &Basis, delta: f64) -> bool {
    (0..basis.rank()).all(|k| {
        let rounded = (0..k).all(|j| basis.r(j, k).abs() <= (0.5 + SLACK) * basis.r(j, j));
        let long = k == 0 || {
            let (above, own) = (basis.r(k - 1, k), basis.r(k, k));
            above * above + own * own >= delta * basis.r(k - 1, k - 1).powi(2)
        };
        rounded && long
    })
}
