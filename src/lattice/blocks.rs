//! Block improvement: exact optimisation of a few coordinates of the reduced basis at a time, while the
//! others stay fixed, until no block improves.
//!
//! The block of a vector consists of the vectors that are least orthogonal to it, since these can
//! compensate each other's rounding. The block is a smaller closest-vector problem, solved by the same
//! reduction and enumeration.

use super::{Basis, Gram, Target, closest};
use crate::error::Result;

/// The number of coordinates of a block.
const SIZE: usize = 30;

/// The largest number of nodes in the enumeration of a block.
const NODES: u64 = 100_000;

/// Improves `z`, whose squared distance is `value`, and returns the new squared distance. Before each
/// block, `stop` says whether to end. Its argument is the number of multiplications since its last call.
///
/// # Errors
/// [`Error::Overflow`](crate::Error::Overflow), as in [`closest`].
pub fn improve_blocks(
    basis: &Basis,
    target: &Target,
    z: &mut [i64],
    mut value: f64,
    stop: &mut dyn FnMut(u64) -> bool,
) -> Result<f64> {
    let m = basis.rank();
    // The number of blocks since the last improvement.
    let mut idle = 0;
    let mut seed = 0;
    let mut work = 0;
    while idle < m && !stop(work) {
        let block = around(basis, seed);
        let before = z.to_vec();
        let (better, nodes) = redecide(basis, target, z, &block)?;
        work = (m * m + block.len() * block.len() * (m + block.len())) as u64;
        work += nodes * block.len() as u64 / 2;
        idle += 1;
        if better {
            let now = target.distance(basis, z);
            // In a nearly singular lattice, the distance in a block may be less accurate than that in the
            // whole lattice. A step without improvement is undone; otherwise two points could alternate
            // forever.
            if now < value {
                (idle, value) = (0, now);
            } else {
                z.copy_from_slice(&before);
            }
        }
        seed = (seed + 1) % m;
    }
    Ok(value)
}

/// `seed` and the vectors least orthogonal to it, in increasing order.
fn around(basis: &Basis, seed: usize) -> Vec<usize> {
    let own = basis.column(seed);
    let coupling = |j: usize| {
        let other = basis.column(j);
        let product: f64 = own.iter().zip(other).map(|(a, b)| a * b).sum();
        let length: f64 = other.iter().map(|b| b * b).sum();
        product * product / length
    };
    let mut all: Vec<(f64, usize)> = (0..basis.rank()).map(|j| (coupling(j), j)).collect();
    all.sort_by(|a, b| b.0.total_cmp(&a.0).then(a.1.cmp(&b.1)));
    let mut block: Vec<usize> = all.into_iter().take(SIZE).map(|(_, j)| j).collect();
    block.sort_unstable();
    block
}

/// Optimises the coordinates of `block`. Returns whether any changed, and the nodes of the enumeration.
fn redecide(basis: &Basis, target: &Target, z: &mut [i64], block: &[usize]) -> Result<(bool, u64)> {
    let m = basis.rank();
    let mut left = vec![0.0; m];
    for j in 0..m {
        let offset = target.rest[j] - z[j] as f64;
        for (l, r) in left.iter_mut().zip(basis.column(j)) {
            *l += r * offset;
        }
    }
    let b = block.len();
    let dot = |x: &[f64], y: &[f64]| x.iter().zip(y).map(|(x, y)| x * y).sum::<f64>();
    let column = |k: usize| basis.column(block[k % b]);
    let gram = Gram::new(
        b,
        (0..b * b).map(|k| dot(column(k / b), column(k))).collect(),
    )?;
    let right: Vec<f64> = (0..b).map(|k| dot(column(k), &left)).collect();
    let wanted = gram.solve(&right);
    let found = closest(&gram, &wanted, Some(&vec![0; b]), NODES)?;
    for (&j, step) in block.iter().zip(&found.point) {
        z[j] += step;
    }
    Ok((found.point.iter().any(|&step| step != 0), found.nodes))
}
