//! *Local* integers: integers that couple to few unknowns, none of them integer. The period jumps of an
//! orientation field are local: each couples to two angles.
//!
//! While a local integer is free, it follows its unknowns exactly. A least-squares row with a free local
//! integer therefore leaves no entry in the Schur complement.

use std::ops::Range;
use std::sync::atomic::AtomicU32;
use std::sync::atomic::Ordering::Relaxed;

use super::Sparse;
use crate::monitor::{collect_in_parts, in_parts, joined};

/// The largest number of couplings of a local integer. More would fill the Schur complement.
const FEW: u32 = 4;

/// The least number of rows that are worth a thread.
const LEAST: usize = 1 << 14;

/// Which unknowns of the matrix with lower triangle `lower` are local integers.
pub(super) fn local_integers(lower: &Sparse, integer: &[bool]) -> Vec<bool> {
    let n = lower.rows();
    // The couplings of an integer to the unknowns before it, which are in its row, and to those after it. A count of
    // more than a few stands for all larger ones, and for integers that cannot be local.
    let after: Vec<AtomicU32> = (0..n).map(|_| AtomicU32::new(0)).collect();
    let before = |rows: Range<usize>| -> Vec<u32> {
        let of_row = rows.map(|i| {
            let (mut count, mut curves) = (0, false);
            for (j, v) in lower.row(i) {
                if j == i {
                    curves = v > 0.0;
                } else if v != 0.0 && (integer[i] || integer[j]) {
                    let more = if integer[i] && integer[j] { FEW + 1 } else { 1 };
                    count = (count + more).min(FEW + 1);
                    if integer[j] && after[j].load(Relaxed) <= FEW {
                        after[j].fetch_add(more, Relaxed);
                    }
                }
            }
            match integer[i] && curves {
                true => count,
                false => FEW + 1,
            }
        });
        of_row.collect()
    };
    let before = joined(in_parts(n, LEAST, before));
    collect_in_parts(n, LEAST, |i| before[i] + after[i].load(Relaxed) <= FEW)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::linalg::Random;
    use crate::monitor::{spawned, with_threads};

    /// By the definition, entry by entry.
    fn by_definition(lower: &Sparse, integer: &[bool]) -> Vec<bool> {
        let n = lower.rows();
        let entries: Vec<_> = lower.entries().filter(|entry| entry.2 != 0.0).collect();
        let mut partners = vec![Vec::new(); n];
        let mut curves = vec![false; n];
        for (i, j, v) in entries {
            let (i, j) = (i as usize, j as usize);
            if i == j {
                curves[i] = v > 0.0;
            } else {
                partners[i].push(j);
                partners[j].push(i);
            }
        }
        let is_local = |i: usize| {
            let few = partners[i].len() <= FEW as usize;
            integer[i] && curves[i] && few && partners[i].iter().all(|&j| !integer[j])
        };
        (0..n).map(is_local).collect()
    }

    #[test]
    fn any_number_of_threads_finds_those_of_the_definition() {
        let n = 2 * LEAST + 10;
        let mut random = Random::new(3);
        let integer: Vec<bool> = (0..n).map(|_| random.next().is_multiple_of(3)).collect();
        let entries: Vec<(u32, u32, f64)> = (0..n)
            .flat_map(|i| {
                let diagonal = [-1.0, 0.0, 2.0, 3.0, 4.0][random.next() as usize % 5];
                let others = [0, 1, 1, 2][random.next() as usize % 4];
                let others: Vec<_> = (0..others)
                    .map(|_| {
                        let j = random.next() as usize % (i + 1);
                        let v = [0.0, 1.0, -1.0][random.next() as usize % 3];
                        (i as u32, j as u32, if i == j { 0.0 } else { v })
                    })
                    .collect();
                others.into_iter().chain([(i as u32, i as u32, diagonal)])
            })
            .collect();
        let lower = Sparse::from_triplets(n, n, entries.into_iter()).unwrap();
        let expected = by_definition(&lower, &integer);
        assert!(expected.iter().filter(|&&is_local| is_local).count() > n / 50);
        let of = |threads| with_threads(threads, || local_integers(&lower, &integer));
        assert_eq!(of(1), expected);
        assert!(spawned(|| assert_eq!(of(2), expected)) > 0);
    }
}
