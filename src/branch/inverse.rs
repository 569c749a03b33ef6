//! The inverse of the Hessian, block by block.
//!
//! Unknowns that Q couples, directly or through others, form a block. Flows and layouts have blocks of one
//! unknown, portfolios one block of all. A block that is singular is made definite by a multiple of a
//! diagonal ([`Inverse::added`]); the relaxation takes it out again by proximal steps.

use crate::error::{Error, Result};
use crate::linalg::{DisjointSets, Sparse};
use crate::monitor::may_continue;

use super::working_set::dot;

/// A block whose pivots in a Cholesky factorization fall below this part of their diagonals is singular.
const SINGULAR: f64 = 1e-9;

/// A block is singular as well where the square of an unknown in the norm of the inverse exceeds this many times
/// the inverse of its own curvature.
const CONDITION: f64 = 1e8;

/// `(Q + diag(added))^-1` by blocks.
#[derive(Debug)]
pub(super) struct Inverse {
    /// The block of each unknown, and the unknown's place there.
    place: Vec<(u32, u32)>,
    /// The unknowns of each block, increasing.
    members: Vec<Vec<u32>>,
    /// The dense symmetric inverse of each block.
    blocks: Vec<Vec<f64>>,
    /// Whether each block is definite without an addition.
    definite: Vec<bool>,
    /// What was added to each diagonal entry of Q; zero in blocks that are definite.
    pub added: Vec<f64>,
}

impl Inverse {
    /// The inverse of Q, given by its lower triangle. `regularization` is added to the diagonal of singular
    /// blocks.
    ///
    /// # Errors
    /// [`Error::NotConvex`], [`Error::OutOfMemory`], the end of the call.
    pub fn new(hessian: &Sparse, regularization: &[f64]) -> Result<Self> {
        let n = hessian.rows();
        let mut sets = DisjointSets::new(n);
        for (i, j, _) in hessian.entries() {
            sets.join(i as usize, j as usize);
        }
        let mut block_of = vec![u32::MAX; n];
        let mut members: Vec<Vec<u32>> = Vec::new();
        let mut place = Vec::with_capacity(n);
        for j in 0..n {
            let root = sets.root(j);
            if block_of[root] == u32::MAX {
                block_of[root] = members.len() as u32;
                members.push(Vec::new());
            }
            let block = &mut members[block_of[root] as usize];
            place.push((block_of[root], block.len() as u32));
            block.push(j as u32);
        }
        let mut inverse = Inverse {
            place,
            members,
            blocks: Vec::new(),
            definite: Vec::new(),
            added: vec![0.0; n],
        };
        for k in 0..inverse.members.len() {
            let block = inverse.invert(k, hessian, regularization)?;
            inverse.blocks.push(block);
            may_continue()?;
        }
        Ok(inverse)
    }

    fn invert(&mut self, k: usize, hessian: &Sparse, regularization: &[f64]) -> Result<Vec<f64>> {
        let members = &self.members[k];
        let size = members.len();
        let mut matrix = zeros(size * size)?;
        for (i, &v) in members.iter().enumerate() {
            for (j, q) in hessian.row(v as usize) {
                let j = self.place[j].1 as usize;
                matrix[i * size + j] = q;
            }
        }
        let given = matrix.clone();
        if cholesky(&mut matrix, size, SINGULAR).is_ok() {
            let inverse = invert_factor(&mut matrix, size)?;
            let condition = |i: usize| inverse[i * size + i] * given[i * size + i];
            if (0..size).all(|i| condition(i) <= CONDITION) {
                self.definite.push(true);
                return Ok(inverse);
            }
        }
        self.definite.push(false);
        matrix = given;
        for (i, &v) in members.iter().enumerate() {
            let added = regularization[v as usize];
            matrix[i * size + i] += added;
            self.added[v as usize] = added;
        }
        if let Err(at) = cholesky(&mut matrix, size, 0.0) {
            let part = negative_direction(&matrix, size, at);
            let mut direction = vec![0.0; self.place.len()];
            for (&j, v) in members.iter().zip(part) {
                direction[j as usize] = v;
            }
            return Err(not_convex(direction));
        }
        invert_factor(&mut matrix, size)
    }

    /// The column of the inverse for an unknown: the unknowns of its block, and one number for each.
    pub fn column(&self, variable: usize) -> (&[u32], &[f64]) {
        let (block, at) = self.place[variable];
        let members = &self.members[block as usize];
        let (size, at) = (members.len(), at as usize);
        let values = &self.blocks[block as usize][at * size..(at + 1) * size];
        (members, values)
    }

    /// Whether nothing was added.
    pub fn is_definite(&self) -> bool {
        self.definite.iter().all(|definite| *definite)
    }

    /// The blocks that are definite, by their unknowns and their inverses.
    pub fn definite(&self) -> impl Iterator<Item = (&[u32], &[f64])> + '_ {
        let blocks = self.members.iter().zip(&self.blocks).zip(&self.definite);
        let blocks = blocks.filter(|(_, definite)| **definite);
        blocks.map(|((members, block), _)| (&members[..], &block[..]))
    }

    /// The diagonal entry for an unknown.
    pub fn diagonal(&self, variable: usize) -> f64 {
        let (_, at) = self.place[variable];
        self.column(variable).1[at as usize]
    }

    /// The product with a vector.
    pub fn mul(&self, v: &[f64]) -> Vec<f64> {
        let mut product = vec![0.0; v.len()];
        for (members, block) in self.members.iter().zip(&self.blocks) {
            let part: Vec<f64> = members.iter().map(|&j| v[j as usize]).collect();
            for (&i, row) in members.iter().zip(block.chunks_exact(members.len())) {
                product[i as usize] = dot(row, &part);
            }
        }
        product
    }
}

fn zeros(len: usize) -> Result<Vec<f64>> {
    let mut v = Vec::new();
    v.try_reserve_exact(len).map_err(|_| Error::OutOfMemory {
        what: "the inverse of the Hessian",
    })?;
    v.resize(len, 0.0);
    Ok(v)
}

/// Replaces the lower triangle of a dense matrix by its Cholesky factor L, row by row.
///
/// # Errors
/// The place of a pivot that is at most `least` times its diagonal entry.
fn cholesky(matrix: &mut [f64], size: usize, least: f64) -> std::result::Result<(), usize> {
    for i in 0..size {
        let (above, row) = matrix.split_at_mut(i * size);
        let square = row[i].abs();
        for j in 0..i {
            let other = &above[j * size..j * size + j + 1];
            row[j] = (row[j] - dot(&row[..j], &other[..j])) / other[j];
        }
        let pivot = row[i] - dot(&row[..i], &row[..i]);
        if pivot <= least * square {
            return Err(i);
        }
        row[i] = pivot.sqrt();
    }
    Ok(())
}

/// A direction `v` with `v'Qv` equal to the negative pivot at this place: `v = (-L^-T l, 1, 0)`.
fn negative_direction(matrix: &[f64], size: usize, at: usize) -> Vec<f64> {
    let mut v = vec![0.0; size];
    v[at] = 1.0;
    for j in 0..at {
        v[j] = -matrix[at * size + j];
    }
    for j in (0..at).rev() {
        v[j] /= matrix[j * size + j];
        for i in 0..j {
            v[i] -= matrix[j * size + i] * v[j];
        }
    }
    v
}

/// The error for a direction of negative curvature, which is scaled to the largest absolute value 1.
fn not_convex(mut direction: Vec<f64>) -> Error {
    let largest = |a: usize, b: usize| direction[a].abs().total_cmp(&direction[b].abs());
    let variable = (0..direction.len())
        .max_by(|&a, &b| largest(a, b))
        .unwrap_or(0);
    let scale = direction[variable];
    direction.iter_mut().for_each(|d| *d /= scale);
    Error::NotConvex {
        variable,
        direction,
    }
}

/// The inverse `L^-T L^-1`, as a full symmetric matrix, of the matrix with the factor L.
fn invert_factor(factor: &mut [f64], size: usize) -> Result<Vec<f64>> {
    // The rows of `columns` are the columns of L^-1.
    let mut columns = zeros(size * size)?;
    for j in 0..size {
        let column = &mut columns[j * size..(j + 1) * size];
        column[j] = 1.0 / factor[j * size + j];
        for i in j + 1..size {
            let row = &factor[i * size..i * size + i + 1];
            column[i] = -dot(&row[j..i], &column[j..i]) / row[i];
        }
    }
    for i in 0..size {
        for j in 0..=i {
            let product = dot(
                &columns[i * size + i..(i + 1) * size],
                &columns[j * size + i..(j + 1) * size],
            );
            factor[i * size + j] = product;
            factor[j * size + i] = product;
        }
    }
    Ok(factor.to_vec())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn blocks_are_inverted_apart_and_singular_ones_made_definite() {
        // x0 and x2 are coupled, x1 is not in Q at all.
        let entries = [(0, 0, 2.0), (2, 0, 1.0), (2, 2, 1.0)];
        let hessian = Sparse::from_triplets(3, 3, entries.into_iter()).unwrap();
        let inverse = Inverse::new(&hessian, &[0.5; 3]).unwrap();
        assert_eq!(inverse.added, [0.0, 0.5, 0.0]);
        let product = inverse.mul(&[1.0, 1.0, 0.0]);
        for (found, wanted) in product.iter().zip([1.0, 2.0, -1.0]) {
            assert!((found - wanted).abs() < 1e-14, "{product:?}");
        }
    }

    #[test]
    fn a_negative_curvature_is_refused() {
        let entries = [(0, 0, 1.0), (1, 0, 2.0), (1, 1, 1.0)];
        let hessian = Sparse::from_triplets(2, 2, entries.into_iter()).unwrap();
        let error = Inverse::new(&hessian, &[0.5; 2]).unwrap_err();
        assert!(matches!(error, Error::NotConvex { .. }), "{error}");
    }
}
