//! The Hessian of a region: one sparsity pattern for all steps, analysed once and summed in place.

use crate::error::Result;
use crate::linalg::{Analysis, Cholesky, Sparse};

/// The sum of quadratic forms of three corners, whose coordinates are affine in the unknowns.
pub(super) struct Hessian {
    /// The lower triangle.
    sum: Sparse,
    /// The entry of the sum that each term belongs to, in the order of [`each_term`].
    places: Vec<u32>,
    analysis: Analysis,
}

impl Hessian {
    /// The Hessian of faces. The coordinates of each face's corners are six rows of `corners`.
    pub fn new(corners: &Sparse) -> Result<Self> {
        let dim = corners.cols();
        let faces = corners.rows() / 6;
        let mut terms = Vec::with_capacity(21 * faces);
        for face in 0..faces {
            each_term(corners, face, |_, _, i, j, _| {
                terms.push((i as u32, j as u32, 0.0));
            });
        }
        let sum = Sparse::from_triplets(dim, dim, terms.iter().copied())?;
        let place = |&(i, j, _): &(u32, u32, f64)| {
            let start = sum.offsets()[i as usize];
            let row = &sum.indices()[start..sum.offsets()[i as usize + 1]];
            (start + row.partition_point(|&k| k < j)) as u32
        };
        Ok(Hessian {
            analysis: Analysis::new(&sum)?,
            places: terms.iter().map(place).collect(),
            sum,
        })
    }

    /// Sums the forms of all faces anew. `of_face` gives them in the order of the faces.
    pub fn sum(&mut self, corners: &Sparse, of_face: impl Iterator<Item = [[f64; 6]; 6]>) {
        let values = self.sum.values_mut();
        values.fill(0.0);
        let mut places = self.places.iter();
        for (face, form) in of_face.enumerate() {
            each_term(corners, face, |a, b, _, _, factor| {
                if let Some(&place) = places.next() {
                    values[place as usize] += form[a][b] * factor;
                }
            });
        }
    }

    /// The factor of the sum.
    pub fn factor(&self) -> Result<Cholesky> {
        Cholesky::with(&self.analysis, &self.sum)
    }
}

/// Calls `term` with two coordinates a and b of a face, the unknowns `i >= j` that move them, and the
/// product of the two coefficients.
fn each_term(corners: &Sparse, face: usize, mut term: impl FnMut(usize, usize, usize, usize, f64)) {
    let rows: [_; 6] = std::array::from_fn(|a| corners.row(6 * face + a));
    if rows.iter().all(|row| row.len() <= 1) {
        // Most faces are such: their terms need no search.
        let entries = rows.map(|mut row| row.next());
        for (a, first) in entries.iter().enumerate() {
            let Some((i, u)) = *first else { continue };
            for (b, second) in entries.iter().enumerate() {
                if let Some((j, v)) = second.filter(|&(j, _)| j <= i) {
                    term(a, b, i, j, u * v);
                }
            }
        }
        return;
    }
    for a in 0..6 {
        for (i, u) in rows[a].clone() {
            for b in 0..6 {
                for (j, v) in rows[b].clone().filter(|&(j, _)| j <= i) {
                    term(a, b, i, j, u * v);
                }
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_sum_is_that_of_all_products_whatever_was_summed_before() {
        // Three faces over five unknowns. Some coordinates are held, and some of the first two faces are moved by two
        // unknowns.
        let entries = (0..18u32).flat_map(|row| {
            let one = (row % 4 != 3).then_some((row, row % 5, 1.0 + f64::from(row)));
            let other = (row % 3 == 0 && row < 12).then_some((row, (row + 2) % 5, -0.5));
            one.into_iter().chain(other)
        });
        let corners = Sparse::from_triplets(18, 5, entries).unwrap();
        let form = |face: usize| {
            let entry = |a: usize, b: usize| ((a * b + a + b + face) as f64).sin();
            std::array::from_fn(|a| std::array::from_fn(|b| entry(a, b)))
        };
        let mut hessian = Hessian::new(&corners).unwrap();
        hessian.sum(&corners, [[[9.0; 6]; 6]; 3].into_iter());
        hessian.sum(&corners, (0..3).map(form));
        let dense = |row: usize| {
            let mut dense = [0.0; 5];
            corners.row(row).for_each(|(i, u)| dense[i] = u);
            dense
        };
        for i in 0..5 {
            for j in 0..=i {
                let mut expected = 0.0;
                for face in 0..3 {
                    let form: [[f64; 6]; 6] = form(face);
                    for a in 0..6 {
                        for b in 0..6 {
                            let (u, v) = (dense(6 * face + a)[i], dense(6 * face + b)[j]);
                            expected += u * form[a][b] * v;
                        }
                    }
                }
                let found = hessian.sum.row(i).find(|&(k, _)| k == j);
                let found = found.map_or(0.0, |(_, v)| v);
                assert!((found - expected).abs() < 1e-12, "{i}, {j}");
            }
        }
    }
}
