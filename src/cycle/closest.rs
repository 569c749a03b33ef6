//! Exact optimisation of the charges of one block.
//!
//! This is a closest-vector problem of few dimensions. It is solved by enumeration (see
//! [`crate::lattice::enumerate`]) without a reduction first. A basis of short cycles is nearly reduced
//! already, and a reduction would cost several times what it saves.

use crate::error::Result;
use crate::lattice::{Basis, Gram, Limits, Target, enumerate};

/// Integers t that minimise `t'Gt + 2 h't`, as far as an enumeration of `nodes` nodes finds them. None
/// unless the minimum is below zero by more than the rounding errors.
///
/// `gram` is G by rows, `pull` is h.
///
/// # Errors
/// [`Error::Overflow`](crate::Error::Overflow) for integers too large to be exact.
pub(super) fn decide(gram: Vec<f64>, pull: &[f64], nodes: u64) -> Result<Option<Vec<i64>>> {
    let basis = Basis::new(&Gram::new(pull.len(), gram)?);
    if basis.rank() < pull.len() {
        return Ok(None);
    }
    let target = Target::new(&basis, &minimiser(&basis, pull))?;
    let stay = target.steps(&basis, &vec![0; pull.len()])?;
    let value = target.distance(&basis, &stay);
    let limits = Limits {
        radius: value * (1.0 - TOLERANCE),
        margin: 0.0,
        nodes,
    };
    let found = enumerate(&basis, &target, None, limits, &mut |_| false).near;
    match found.first() {
        Some((steps, _)) => target.integers(&basis, steps).map(Some),
        None => Ok(None),
    }
}

/// A gain below this does not count. It is relative to the largest possible gain of the block.
const TOLERANCE: f64 = 1e-9;

/// The minimiser of the quadratic over real t: `R'R t = -h`.
fn minimiser(basis: &Basis, pull: &[f64]) -> Vec<f64> {
    let m = pull.len();
    let mut t = vec![0.0; m];
    for i in 0..m {
        let before: f64 = (0..i).map(|k| basis.r(k, i) * t[k]).sum();
        t[i] = (-pull[i] - before) / basis.r(i, i);
    }
    for i in (0..m).rev() {
        let behind: f64 = (i + 1..m).map(|k| basis.r(i, k) * t[k]).sum();
        t[i] = (t[i] - behind) / basis.r(i, i);
    }
    t
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_decided_is_what_trying_everything_finds() {
        for seed in 0..200 {
            let random = |k: u32| (f64::from(k + 31 * seed) * 12.9898).sin();
            let m = 4;
            let root: Vec<f64> = (0..16).map(random).collect();
            let mut gram = vec![0.0; 16];
            for i in 0..m {
                for j in 0..m {
                    gram[i * m + j] = (0..m).map(|k| root[k * m + i] * root[k * m + j]).sum();
                }
                gram[i * m + i] += 0.3;
            }
            let pull: Vec<f64> = (0..4).map(|k| random(100 + k)).collect();
            let value = |t: &[f64]| -> f64 {
                let row = |i: usize| (0..m).map(|j| gram[i * m + j] * t[j]).sum::<f64>();
                (0..m).map(|i| t[i] * (row(i) + 2.0 * pull[i])).sum()
            };
            let all = (0..9usize.pow(4)).map(|c| {
                let digit = |k| (c / 9usize.pow(k) % 9) as f64 - 4.0;
                value(&[digit(0), digit(1), digit(2), digit(3)])
            });
            let least = all.fold(0.0, f64::min);
            let found = decide(gram.clone(), &pull, u64::MAX).unwrap();
            let found = found.map_or(0.0, |t| {
                value(&t.iter().map(|&t| t as f64).collect::<Vec<_>>())
            });
            assert!((found - least).abs() < 1e-12, "{seed}: {found} {least}");
        }
    }

    #[test]
    fn a_block_that_is_best_as_it_is_stays() {
        assert_eq!(decide(vec![1.0], &[0.4], 99).unwrap(), None);
        assert_eq!(decide(vec![1.0], &[0.6], 99).unwrap(), Some(vec![-1]));
        assert_eq!(decide(Vec::new(), &[], 99).unwrap(), None);
    }
}
