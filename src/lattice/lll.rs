//! LLL reduction with deep insertion, in floating point, the transformation exact.
//!
//! `lenstra1982`; deep insertion by `schnorr1994`, section 3. R is updated by rotations, which are stable. A
//! result is accepted only if the Lovasz conditions still hold after R was computed again from the exact
//! transformation.

use super::Basis;
use crate::error::Result;

/// The Lovasz condition holds where a vector is not shorter than this part of the square of the
/// one that it would replace.
pub const LOVASZ: f64 = 0.99;

/// What the conditions may lack after R was computed anew.
const SLACK: f64 = 1e-3;

/// At most so many rounds of reduction and renewal.
const ROUNDS: usize = 20;

/// Reduces `basis`. A vector may move forward by up to `depth` places at a time: 1 is plain LLL.
///
/// `stop` is asked before each vector whether to end, with the multiplications that it will take. A basis
/// that is not fully reduced generates the same lattice and can be used, with a worse result.
///
/// # Errors
/// [`Error::Overflow`](crate::Error::Overflow) where the transformation leaves 126 bits.
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

/// One sweep to the end, as long as it takes; whether it came there.
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

/// The first place, at most `depth` before `k`, where vector `k` would be short enough.
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

/// Whether the Lovasz conditions hold with `delta`, and all vectors are rounded.
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
