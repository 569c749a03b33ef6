//! The factor of the whole reduced Hessian with all integers relaxed to reals.
//!
//! [Local](super::local_integers) integers are eliminated first, with one division each. Only their Schur
//! complement is ordered and factored. On an orientation field the complement is the Laplacian of a forest,
//! whose factor has no fill.

use std::ops::Range;

use super::cholesky::pivot_tolerance;
use super::local_integers::local_integers;
use super::minimise::{CANCELLED, Lowest, Minimum, minimise};
use super::{Cholesky, NO_PLACE, Ordering, Sparse, coupling, places};
use crate::error::Result;
use crate::monitor::{change_in_parts, collect_in_parts, in_parts, may_continue, may_continue_at};

/// The least number of rows that are worth a thread.
const LEAST: usize = 1 << 13;

/// A factor of `A` in two steps: first the local integers, then the other unknowns.
#[derive(Debug)]
pub struct RelaxedFactor {
    /// The place of every unknown among the others; [`NO_PLACE`] for local integers.
    place: Vec<u32>,
    rest: Vec<u32>,
    local: Vec<u32>,
    /// The diagonal entry `A_pp` of each local integer.
    curvature: Vec<f64>,
    /// The couplings of the local integers to the others, one row for each local integer.
    coupling: Sparse,
    /// The same couplings, one row for each of the others.
    by_unknown: Sparse,
    /// Lower triangle of the Schur complement on the other unknowns.
    schur: Sparse,
    factor: Cholesky,
}

impl RelaxedFactor {
    /// Factors the matrix with lower triangle `lower`, some of whose unknowns are `integers`.
    ///
    /// # Errors
    /// As [`Cholesky::new`].
    pub fn new(lower: &Sparse, integers: &[u32]) -> Result<Self> {
        Self::ordered(lower, integers, Ordering::FillReducing)
    }

    /// As [`new`](Self::new), in another order. In the natural order local integers do not come first.
    ///
    /// # Errors
    /// As [`Cholesky::new`].
    pub fn ordered(lower: &Sparse, integers: &[u32], ordering: Ordering) -> Result<Self> {
        let integers = match ordering {
            Ordering::FillReducing | Ordering::LargestPivot => integers,
            Ordering::Natural => &[],
        };
        let n = lower.rows();
        let mut integer = vec![false; n];
        integers.iter().for_each(|&i| integer[i as usize] = true);
        let is_local = local_integers(lower, &integer);
        may_continue()?;
        let all = 0..n as u32;
        let (local, rest): (Vec<u32>, Vec<u32>) = all.partition(|&i| is_local[i as usize]);
        let curvature: Vec<f64> = local.iter().map(|&p| lower.diagonal(p as usize)).collect();
        may_continue()?;
        let coupling = coupling(lower, &local, &rest)?;
        may_continue()?;
        let by_unknown = coupling.transpose();
        may_continue()?;
        let place = places(n, &rest);
        let schur = if local.is_empty() {
            lower.clone()
        } else {
            schur(lower, &place, &rest, [&coupling, &by_unknown], &curvature)?
        };
        Ok(RelaxedFactor {
            factor: Cholesky::ordered(&schur, ordering)?,
            place,
            rest,
            local,
            curvature,
            coupling,
            by_unknown,
            schur,
        })
    }

    /// Number of entries of the factor below the diagonal, including those of the local integers.
    pub fn entries(&self) -> usize {
        self.coupling.len() + self.factor.entries()
    }

    /// Solves `A x = b` in place, as [`Cholesky::solve`].
    ///
    /// # Errors
    /// [`Error::OutOfMemory`](crate::Error::OutOfMemory).
    pub fn solve(&self, b: &mut [f64]) -> Result<()> {
        let mut inner = self.condense(b);
        self.factor.solve(&mut inner)?;
        self.embed(&inner, b);
        Ok(())
    }

    /// As [`Cholesky::null_direction`].
    ///
    /// # Errors
    /// [`Error::OutOfMemory`](crate::Error::OutOfMemory).
    pub fn null_direction(&self) -> Result<Option<(Vec<f64>, f64)>> {
        let inner = self.factor.null_direction()?;
        Ok(inner.map(|(inner, smallest)| {
            let mut whole = vec![0.0; self.place.len()];
            self.embed(&inner, &mut whole);
            (whole, smallest)
        }))
    }

    /// Minimises `1/2 x'Ax + g'x`, as [`minimise`].
    ///
    /// # Errors
    /// Only for lack of memory.
    pub fn minimise(
        &self,
        gradient: &[f64],
        rounding: impl FnOnce() -> Vec<f64>,
        guess: &[f64],
    ) -> Result<Minimum> {
        let start: Vec<f64> = self.rest.iter().map(|&i| guess[i as usize]).collect();
        let slope = self.condense(gradient);
        let noise = || self.condensed_rounding(gradient, &rounding());
        let all = |inner: &[f64], pull: f64| {
            let mut whole: Vec<f64> = gradient.iter().map(|g| -pull * g).collect();
            self.embed(inner, &mut whole);
            whole
        };
        Ok(
            match minimise(&self.schur, &slope, noise, &start, &self.factor)? {
                Minimum::At(Lowest { point, excess }) => Minimum::At(Lowest {
                    point: all(&point, 1.0),
                    excess,
                }),
                Minimum::Unbounded(v) => Minimum::Unbounded(all(&v, 0.0)),
                Minimum::NotConvex(v) => Minimum::NotConvex(all(&v, 0.0)),
            },
        )
    }

    /// The right side of the Schur complement: `b_r - A_rp A_pp^-1 b_p`.
    fn condense(&self, b: &[f64]) -> Vec<f64> {
        let pull = collect_in_parts(self.local.len(), LEAST, |k| {
            b[self.local[k] as usize] / self.curvature[k]
        });
        collect_in_parts(self.rest.len(), LEAST, |i| {
            let own = b[self.rest[i] as usize];
            let couplings = self.by_unknown.row(i);
            couplings.fold(own, |sum, (k, v)| sum - v * pull[k])
        })
    }

    /// The rounding error of the condensed gradient: that of `gradient` itself and that of the condensation.
    /// Where the gradient vanishes, this error must not count as a slope.
    fn condensed_rounding(&self, gradient: &[f64], rounding: &[f64]) -> Vec<f64> {
        let noise = |i: u32| CANCELLED * gradient[i as usize].abs() + rounding[i as usize];
        let mut inner: Vec<f64> = self.rest.iter().map(|&i| noise(i)).collect();
        for (k, &p) in self.local.iter().enumerate() {
            let pull = noise(p) / self.curvature[k];
            for (i, v) in self.coupling.row(k) {
                inner[i] += (v * pull).abs();
            }
        }
        inner
    }

    /// Copies the values of the other unknowns into `b` and computes the local integers from their right
    /// sides in `b`.
    fn embed(&self, inner: &[f64], b: &mut [f64]) {
        change_in_parts(b, LEAST, |i, b| match self.place[i] {
            NO_PLACE => {
                let k = self.local.partition_point(|&p| (p as usize) < i);
                let pull: f64 = self.coupling.row(k).map(|(j, v)| v * inner[j]).sum();
                *b = (*b - pull) / self.curvature[k];
            }
            place => *b = inner[place as usize],
        });
    }
}

/// Lower triangle of `A_rr - A_rp A_pp^-1 A_pr`, without the entries that cancel.
fn schur(
    lower: &Sparse,
    place: &[u32],
    rest: &[u32],
    [coupling, by_unknown]: [&Sparse; 2],
    curvature: &[f64],
) -> Result<Sparse> {
    let dim = rest.len();
    let size = collect_in_parts(dim, LEAST, |a| lower.diagonal(rest[a] as usize).abs());
    let tolerance = pivot_tolerance(dim);
    let is_cancelled =
        |a: usize, b: usize, v: f64| v * v <= tolerance * tolerance * size[a] * size[b];
    let rows = |rows: Range<usize>| {
        let (mut offsets, mut indices, mut values) = (vec![0], Vec::new(), Vec::new());
        let mut row: Vec<(usize, f64)> = Vec::new();
        for a in rows {
            may_continue_at(a)?;
            let given = lower.row(rest[a] as usize);
            let given = given.filter(|&(j, _)| place[j] != NO_PLACE);
            row.clear();
            row.extend(given.map(|(j, v)| (place[j] as usize, v)));
            for (k, u) in by_unknown.row(a) {
                let lower = coupling.row(k).take_while(|&(b, _)| b <= a);
                row.extend(lower.map(|(b, v)| (b, -u * v / curvature[k])));
            }
            // Terms of one entry are summed in their order.
            row.sort_by_key(|&(b, _)| b);
            for terms in row.chunk_by(|x, y| x.0 == y.0) {
                let (b, first) = terms[0];
                let v = terms[1..].iter().fold(first, |sum, (_, v)| sum + v);
                let cancelled = is_cancelled(a, b, v);
                if a == b || !cancelled {
                    indices.push(b as u32);
                    values.push(if cancelled { 0.0 } else { v });
                }
            }
            offsets.push(indices.len());
        }
        Ok(Sparse::from_parts(dim, offsets, indices, values))
    };
    Sparse::stacked(in_parts(dim, LEAST, rows))
}

#[cfg(test)]
mod tests {
    use super::super::minimise_bounded;
    use super::*;
    use crate::monitor::{spawned, with_threads};

    /// Squares of rows `x_i - x_(i+1) + 1.5 p_i` on a path, where every third row has no integer. The angles
    /// are tied weakly to the ground.
    fn path(n: u32) -> (Sparse, Vec<u32>) {
        let mut entries = Vec::new();
        let mut integers = Vec::new();
        for i in 0..n - 1 {
            let mut row = vec![(i, 1.0), (i + 1, -1.0)];
            if i % 3 != 0 {
                integers.push(n + i);
                row.push((n + i, 1.5));
            }
            for &(i, u) in &row {
                let lower = row.iter().filter(|&&(j, _)| j <= i);
                entries.extend(lower.map(|&(j, v)| (i, j, 2.0 * u * v)));
            }
        }
        entries.extend((0..2 * n).map(|i| (i, i, 0.0)));
        entries.extend((0..n).map(|i| (i, i, 0.1)));
        let n = 2 * n as usize;
        let a = Sparse::from_triplets(n, n, entries.into_iter()).unwrap();
        (a, integers)
    }

    #[test]
    fn threads_condense_right_sides_as_one_does() {
        let (a, integers) = path(4 * LEAST as u32);
        let factor = RelaxedFactor::new(&a, &integers).unwrap();
        let b: Vec<f64> = (0..a.rows()).map(|i| (i as f64).sin()).collect();
        // The textbook's sums, one local integer after the other.
        let mut expected: Vec<f64> = factor.rest.iter().map(|&i| b[i as usize]).collect();
        for (k, &p) in factor.local.iter().enumerate() {
            let pull = b[p as usize] / factor.curvature[k];
            for (i, v) in factor.coupling.row(k) {
                expected[i] -= v * pull;
            }
        }
        let condensed = |threads| with_threads(threads, || factor.condense(&b));
        assert!(factor.local.len() > LEAST && condensed(1) == expected);
        assert!(spawned(|| assert!(condensed(3) == expected)) >= 2);
    }

    #[test]
    fn an_angle_that_integers_follow_without_end_is_no_endless_slope() {
        // w (x0 - x1 + 0.7 p + r)^2 for three rows, each with its own local integer.
        let rows = [(0.37, 11.3, 1.03), (0.91, -7.7, 0.61), (0.13, 3.1, 1.47)];
        let (mut entries, mut gradient) = (Vec::new(), vec![0.0; 5]);
        for (p, (w, r, turn)) in (2u32..).zip(rows) {
            let row = [(0u32, 1.0), (1, -1.0), (p, turn)];
            for &(i, u) in &row {
                gradient[i as usize] += 2.0 * w * u * r;
                let lower = row.iter().filter(|&&(j, _)| j <= i);
                entries.extend(lower.map(|&(j, v)| (i, j, 2.0 * w * u * v)));
            }
        }
        let a = Sparse::from_triplets(5, 5, entries.into_iter()).unwrap();
        let factor = RelaxedFactor::new(&a, &[2, 3, 4]).unwrap();
        let minimum = factor
            .minimise(&gradient, || vec![0.0; 5], &[0.0; 5])
            .unwrap();
        assert!(matches!(minimum, Minimum::At(_)), "{minimum:?}");
    }

    #[test]
    fn it_solves_as_the_factor_of_the_whole_does() {
        let (a, integers) = path(30);
        let two_steps = RelaxedFactor::new(&a, &integers).unwrap();
        assert_eq!(two_steps.local.len(), integers.len());
        let gradient: Vec<f64> = (0..60)
            .map(|i| match i {
                // An unknown without curvature must have no slope.
                30.. if !integers.contains(&(i as u32)) => 0.0,
                _ => f64::from(i).sin(),
            })
            .collect();
        let guess = vec![0.0; 60];
        let known = || vec![0.0; 60];
        let minimum = two_steps.minimise(&gradient, known, &guess).unwrap();
        let Minimum::At(Lowest { point: x, .. }) = minimum else {
            panic!()
        };
        let whole = Cholesky::new(&a).unwrap();
        let y = minimise_bounded(&a, &gradient, &guess, &whole).unwrap();
        let mut z: Vec<f64> = gradient.iter().map(|g| -g).collect();
        two_steps.solve(&mut z).unwrap();
        for ((x, y), z) in x.iter().zip(&y).zip(&z) {
            assert!(
                (x - y).abs() < 1e-10 && (x - z).abs() < 1e-10,
                "{x} {y} {z}"
            );
        }
    }

    #[test]
    fn an_absorbed_row_leaves_no_entry() {
        let (a, integers) = path(30);
        let factor = RelaxedFactor::new(&a, &integers).unwrap();
        let couplings = factor.schur.entries().filter(|(i, j, _)| i != j).count();
        assert_eq!(couplings, 10, "every third row has no integer");
    }

    #[test]
    fn directions_are_told_in_all_unknowns() {
        // (x0 - x1 + p)^2 and a slope at x0 alone.
        let row = [(0u32, 1.0), (1, -1.0), (2, 1.0)];
        let entries = row.iter().flat_map(|&(i, u)| {
            let lower = row.iter().filter(move |&&(j, _)| j <= i);
            lower.map(move |&(j, v)| (i, j, 2.0 * u * v))
        });
        let a = Sparse::from_triplets(3, 3, entries).unwrap();
        let factor = RelaxedFactor::new(&a, &[2]).unwrap();
        let slope = [1.0, 0.0, 0.0];
        let minimum = factor.minimise(&slope, || vec![0.0; 3], &[0.0; 3]).unwrap();
        let Minimum::Unbounded(v) = minimum else {
            panic!()
        };
        assert!(v[0] < 0.0 && (v[0] - v[1] + v[2]).abs() < 1e-12, "{v:?}");
    }
}
