//! Block improvement: exact optimisation of a few coordinates of the reduced basis at a time, while the
//! others stay fixed, until no block improves.
//!
//! The block of a vector consists of the vectors that are least orthogonal to it, since these can
//! compensate each other's rounding. The block is a smaller closest-vector problem, solved by the same
//! reduction and enumeration. Its reduced basis does not depend on the point that is improved, and is kept.

use super::{Basis, Gram, Target, closest, reduced};
use crate::error::Result;
use crate::monitor::collect_in_parts;

/// The number of coordinates of a block.
const SIZE: usize = 30;

/// The largest number of nodes in the enumeration of a block.
const NODES: u64 = 100_000;

/// The number of blocks that are made at once, on several threads.
const AHEAD: usize = 32;

/// The least number of blocks that are worth a thread.
const LEAST: usize = 4;

/// The blocks of a basis. Each is made before its first use.
#[derive(Default)]
pub struct Blocks {
    of_vector: Vec<Block>,
}

/// A few vectors of a basis.
struct Block {
    /// Their places in the basis, in increasing order.
    places: Vec<usize>,
    gram: Gram,
    reduced: Basis,
}

impl Blocks {
    /// The block of vector `seed`, after those of all vectors before it.
    ///
    /// # Errors
    /// Those of the [reduction](super::lll) of a block.
    fn of(&mut self, basis: &Basis, seed: usize) -> Result<&Block> {
        let made = self.of_vector.len();
        if seed >= made {
            let count = AHEAD.min(different(basis) - made);
            let next = collect_in_parts(count, LEAST, |k| Block::new(basis, made + k));
            for block in next {
                self.of_vector.push(block?);
            }
        }
        Ok(&self.of_vector[seed])
    }
}

impl Block {
    fn new(basis: &Basis, seed: usize) -> Result<Self> {
        let places = around(basis, seed);
        let b = places.len();
        let entry = |k: usize| product(basis, places[k % b], places[k / b]);
        let gram = Gram::new(b, (0..b * b).map(entry).collect())?;
        Ok(Block {
            reduced: reduced(&gram)?,
            places,
            gram,
        })
    }
}

/// Improves `z`, whose squared distance is `value`, and returns the new squared distance. `blocks` are those of this
/// basis. Before each block, `stop` says whether to end. Its argument is the number of multiplications since its last
/// call.
///
/// # Errors
/// [`Error::Overflow`](crate::Error::Overflow), as in [`closest`](super::closest()).
pub fn improve_blocks(
    basis: &Basis,
    target: &Target,
    blocks: &mut Blocks,
    z: &mut [i64],
    mut value: f64,
    stop: &mut dyn FnMut(u64) -> bool,
) -> Result<f64> {
    let m = basis.rank();
    // The number of blocks since the last improvement.
    let mut idle = 0;
    let mut seed = 0;
    let mut work = 0;
    let mut left = offset(basis, target, z);
    while idle < different(basis) && !stop(work) {
        let block = blocks.of(basis, seed)?;
        let before = z.to_vec();
        let (better, nodes) = redecide(basis, &left, z, block)?;
        let b = block.places.len();
        work = (m * m + b * b * (m + b)) as u64;
        work += nodes * b as u64 / 2;
        idle += 1;
        if better {
            let now = target.distance(basis, z);
            // In a nearly singular lattice, the distance in a block may be less accurate than that in the
            // whole lattice. A step without improvement is undone; otherwise two points could alternate
            // forever.
            if now < value {
                (idle, value) = (0, now);
                left = offset(basis, target, z);
            } else {
                z.copy_from_slice(&before);
            }
        }
        seed = (seed + 1) % different(basis);
    }
    Ok(value)
}

/// The number of blocks: those that have all vectors are the same.
fn different(basis: &Basis) -> usize {
    match basis.rank() {
        m if m <= SIZE => m.min(1),
        m => m,
    }
}

/// `seed` and the vectors least orthogonal to it, in increasing order.
fn around(basis: &Basis, seed: usize) -> Vec<usize> {
    let coupling = |j: usize| product(basis, seed, j).powi(2) / product(basis, j, j);
    let mut all: Vec<(f64, usize)> = (0..basis.rank()).map(|j| (coupling(j), j)).collect();
    all.sort_by(|a, b| b.0.total_cmp(&a.0).then(a.1.cmp(&b.1)));
    let mut block: Vec<usize> = all.into_iter().take(SIZE).map(|(_, j)| j).collect();
    block.sort_unstable();
    block
}

fn product(basis: &Basis, i: usize, j: usize) -> f64 {
    dot(basis.column(i), basis.column(j))
}

fn dot(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}

/// The vector from the lattice point at `z` to the target.
fn offset(basis: &Basis, target: &Target, z: &[i64]) -> Vec<f64> {
    let mut left = vec![0.0; basis.rank()];
    for (j, &z) in z.iter().enumerate() {
        let offset = target.rest[j] - z as f64;
        for (l, r) in left.iter_mut().zip(basis.column(j)) {
            *l += r * offset;
        }
    }
    left
}

/// Optimises the coordinates of `block`. `left` is the vector from `z` to the target. Returns whether any coordinate
/// changed, and the nodes of the enumeration.
fn redecide(basis: &Basis, left: &[f64], z: &mut [i64], block: &Block) -> Result<(bool, u64)> {
    let right = block.places.iter().map(|&j| dot(basis.column(j), left));
    let wanted = block.gram.solve(&right.collect::<Vec<f64>>());
    let start = vec![0; block.places.len()];
    let found = closest(&block.reduced, &wanted, Some(&start), NODES)?;
    for (&j, step) in block.places.iter().zip(&found.point) {
        z[j] += step;
    }
    Ok((found.point.iter().any(|&step| step != 0), found.nodes))
}

#[cfg(test)]
mod tests {
    use super::super::{DEPTH, lll, nearest_plane};
    use super::*;
    use crate::monitor::{spawned, with_threads};
    use crate::test_random::Random;

    /// A reduced basis, a target, and a point that is not the closest one.
    fn problem(m: usize, random: &mut Random) -> (Basis, Target, Vec<i64>) {
        let rows: Vec<f64> = (0..m * m).map(|_| random.next()).collect();
        let row = |i: usize| &rows[i * m..(i + 1) * m];
        let entries = (0..m * m).map(|k| dot(row(k / m), row(k % m)));
        let mut basis = Basis::new(&Gram::new(m, entries.collect()).unwrap());
        lll(&mut basis, DEPTH, &mut |_| false).unwrap();
        let point: Vec<f64> = (0..m).map(|_| 10.0 * random.next()).collect();
        let target = Target::new(&basis, &point).unwrap();
        let mut z = nearest_plane(&basis, &target);
        z.iter_mut().step_by(5).for_each(|z| *z += 1);
        (basis, target, z)
    }

    fn improved(of: &(Basis, Target, Vec<i64>), blocks: &mut Blocks) -> (Vec<i64>, f64) {
        let (basis, target, z) = of;
        let (mut z, value) = (z.clone(), target.distance(basis, z));
        let best = improve_blocks(basis, target, blocks, &mut z, value, &mut |_| false).unwrap();
        assert_eq!(best, target.distance(basis, &z));
        assert!(best < value);
        (z, best)
    }

    #[test]
    fn blocks_that_are_kept_improve_like_new_ones() {
        let mut random = Random::new(5);
        for _ in 0..3 {
            let mut of = problem(50, &mut random);
            let mut kept = Blocks::default();
            let mut first = (Vec::new(), 0.0);
            let on_threads = || first = with_threads(3, || improved(&of, &mut kept));
            assert!(spawned(on_threads) > 0);
            assert_eq!(kept.of_vector.len(), 50);
            assert_eq!(
                first,
                with_threads(1, || improved(&of, &mut Blocks::default()))
            );
            of.2 = first.0.clone();
            of.2.iter_mut().step_by(3).for_each(|z| *z -= 1);
            let again = improved(&of, &mut kept);
            assert_eq!(again, improved(&of, &mut Blocks::default()));
            let mut z = again.0.clone();
            let none = improve_blocks(&of.0, &of.1, &mut kept, &mut z, again.1, &mut |_| false);
            assert_eq!((z, none.unwrap()), again);
        }
    }

    #[test]
    fn one_block_with_all_vectors_finds_the_closest_point() {
        let mut random = Random::new(6);
        for m in [1, 7, 14] {
            let of = problem(m, &mut random);
            let mut blocks = Blocks::default();
            let (_, value) = improved(&of, &mut blocks);
            assert_eq!(blocks.of_vector.len(), 1);
            let rest: Vec<f64> = of.1.rest.clone();
            let entry = |k: usize| product(&of.0, k / m, k % m);
            let gram = Gram::new(m, (0..m * m).map(entry).collect()).unwrap();
            let found = closest(&reduced(&gram).unwrap(), &rest, None, u64::MAX).unwrap();
            assert!(found.complete);
            assert!((found.value - value).abs() <= 1e-9 * value);
        }
    }
}
