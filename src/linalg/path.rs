//! Blocks of an inverse, computed by solves along paths of the elimination tree.
//!
//! Forward substitution from one unknown touches only the path from its position to the root (`davis2006`,
//! sections 3.2 and 4.1). Let B be a set of unknowns and `V = L^-1 E_B`, whose rows outside the union of the
//! paths are zero. Then `(A^-1)_BB = V' D^-1 V`. faer has no sparse right-hand sides and does not expose its
//! factors.

use super::Ldl;
use super::ordering::NONE;

/// The largest number of unknowns in one block.
pub const WIDEST: usize = 32;

/// The number of columns that are substituted at a time.
const LANES: usize = 8;

/// Buffers for solves along paths, which every solve reuses.
#[derive(Debug, Clone)]
pub struct PathSolve {
    /// The place of each position on the path. It is valid if `stamp` is that of the current solve.
    place: Vec<u32>,
    stamp: Vec<u32>,
    round: u32,
    path: Vec<u32>,
    columns: Vec<f64>,
    work: usize,
}

impl PathSolve {
    /// Buffers for factors of dimension `n`.
    pub fn new(n: usize) -> Self {
        PathSolve {
            place: vec![0; n],
            stamp: vec![0; n],
            round: 0,
            path: Vec::new(),
            columns: Vec::new(),
            work: 0,
        }
    }

    /// Number of multiplications so far.
    pub fn work(&self) -> usize {
        self.work
    }

    /// The block of `A^-1` that belongs to `unknowns`, at most `WIDEST` different ones. A must be definite.
    /// Entry `(i, j)` is at `i * unknowns.len() + j`.
    pub fn inverse_block(&mut self, ldl: &Ldl, unknowns: &[u32]) -> Vec<f64> {
        let width = unknowns.len().div_ceil(LANES);
        self.collect(ldl, unknowns);
        let wide = match width {
            0 | 1 => self.substitute::<LANES>(ldl, unknowns),
            2 => self.substitute::<{ 2 * LANES }>(ldl, unknowns),
            3 => self.substitute::<{ 3 * LANES }>(ldl, unknowns),
            _ => self.substitute::<WIDEST>(ldl, unknowns),
        };
        let (m, w) = (unknowns.len(), width.clamp(1, WIDEST / LANES) * LANES);
        let entry = |k: usize| wide[k / m * w + k % m];
        (0..m * m).map(entry).collect()
    }

    /// Collects the union of the paths from `unknowns` to the roots, in increasing order.
    fn collect(&mut self, ldl: &Ldl, unknowns: &[u32]) {
        self.round += 1;
        self.path.clear();
        for &u in unknowns {
            let mut j = ldl.tree.position[u as usize];
            while j != NONE && self.stamp[j as usize] != self.round {
                self.stamp[j as usize] = self.round;
                self.path.push(j);
                j = ldl.tree.parent[j as usize];
            }
        }
        self.path.sort_unstable();
        for (k, &j) in self.path.iter().enumerate() {
            self.place[j as usize] = k as u32;
        }
    }

    /// Computes `V' D^-1 V`, where V is padded with zeros to width `W`.
    fn substitute<const W: usize>(&mut self, ldl: &Ldl, unknowns: &[u32]) -> Vec<f64> {
        self.columns.clear();
        self.columns.resize(self.path.len() * W, 0.0);
        let (columns, _) = self.columns.as_chunks_mut::<W>();
        for (k, &u) in unknowns.iter().enumerate() {
            let position = ldl.tree.position[u as usize];
            columns[self.place[position as usize] as usize][k] = ldl.scale[u as usize];
        }
        let mut block = vec![0.0; W * W];
        let (sums, _) = block.as_chunks_mut::<W>();
        for (at, &j) in self.path.iter().enumerate() {
            let j = j as usize;
            let row = columns[at];
            let column = ldl.offsets[j]..ldl.ends[j];
            for (&i, &l) in ldl.indices[column.clone()]
                .iter()
                .zip(&ldl.values[column.clone()])
            {
                let below = &mut columns[self.place[i as usize] as usize];
                for (b, y) in below.iter_mut().zip(&row) {
                    *b -= l * y;
                }
            }
            for (&y, sum) in row.iter().zip(sums.iter_mut()) {
                if y != 0.0 {
                    let scaled = y / ldl.pivots[j];
                    for (s, v) in sum.iter_mut().zip(&row) {
                        *s += scaled * v;
                    }
                }
            }
            self.work += W * (column.len() + unknowns.len());
        }
        block
    }
}

#[cfg(test)]
mod tests {
    use super::super::{Sparse, minimum_degree};
    use super::*;

    /// A ring of springs with chords, grounded at every unknown.
    fn springs(n: u32) -> Sparse {
        let pairs = (0..n).flat_map(move |i| [(i, (i + 1) % n), (i, (i * 3 + 2) % n)]);
        let off = pairs
            .filter(|(i, j)| i != j)
            .map(|(i, j)| (i.max(j), i.min(j)));
        let entries = off.flat_map(|(i, j)| [(i, i, 1.5), (j, j, 1.5), (i, j, -1.5)]);
        let ground = (0..n).map(|i| (i, i, 0.1 * f64::from(i % 4 + 1)));
        Sparse::from_triplets(n as usize, n as usize, entries.chain(ground)).unwrap()
    }

    #[test]
    fn a_solve_undoes_the_product() {
        let a = springs(40);
        let ldl = Ldl::new(&a, &minimum_degree(&a).unwrap()).unwrap();
        let x: Vec<f64> = (0..40).map(|i| f64::from(i).sin()).collect();
        let solved = ldl.solve(&a.mul_symmetric(&x));
        assert!(x.iter().zip(solved).all(|(x, s)| (x - s).abs() < 1e-12));
    }

    #[test]
    fn a_block_of_the_inverse_agrees_with_full_solves() {
        let a = springs(50);
        let ldl = Ldl::new(&a, &minimum_degree(&a).unwrap()).unwrap();
        let mut paths = PathSolve::new(50);
        for size in [1, 7, 8, 9, 23, 32] {
            let unknowns: Vec<u32> = (0..size).map(|k| (k * 7 + 3) % 50).collect();
            let block = paths.inverse_block(&ldl, &unknowns);
            for (i, &u) in unknowns.iter().enumerate() {
                let mut unit = vec![0.0; 50];
                unit[u as usize] = 1.0;
                let column = ldl.solve(&unit);
                for (j, &v) in unknowns.iter().enumerate() {
                    let error = block[i * unknowns.len() + j] - column[v as usize];
                    assert!(error.abs() < 1e-13, "{size}: {error}");
                }
            }
        }
    }
}
