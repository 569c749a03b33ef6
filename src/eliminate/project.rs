//! The objective in the reduced unknowns.
//!
//! With `x = T y + t`, the objective `1/2 x'Qx + q'x + c` becomes
//!
//! ```text
//! 1/2 y' (T'QT) y + (T'(Qt + q))' y + (c + q't + 1/2 t'Qt).
//! ```

use std::ops::Range;
use std::sync::Arc;

use super::Expansion;
use crate::error::{Error, Result};
use crate::linalg::sparse::reserve;
use crate::linalg::{Accumulator, CompensatedSum, Sparse, TwoFold};
use crate::monitor::{Monitor, both, in_parts, joined, may_continue, may_continue_at};
use crate::problem::Model;

/// The least number of rows that are worth a thread.
const LEAST: usize = 1 << 13;

/// The most rows that are summed up before the monitor is asked again.
const UNASKED: usize = 1 << 17;

/// The lower triangle of `T'QT` by rows, with every diagonal entry stored (`gustavson1978`). It first
/// computes `W = QT`, in twice the working precision, since an integer of a map may couple a thousand
/// unknowns whose terms nearly cancel. Row `a` of the result is the combination of the rows of `W` with the entries of column
/// `a` of `T`.
pub(super) fn hessian(lower: &Sparse, expansion: &Sparse, monitor: &mut Monitor) -> Result<Sparse> {
    let (upper, by_unknown) = both(
        expansion.rows() >= LEAST,
        || lower.transpose(),
        || expansion.transpose(),
    );
    let dim = expansion.cols();
    let times_expansion = |i: usize, row: &mut Accumulator<Entry>| {
        let mirrored = upper.row(i).filter(|&(j, _)| j > i);
        for (j, q) in lower.row(i).chain(mirrored) {
            for (b, t) in expansion.row(j) {
                row.slot(b as u32).add(q, t.into(), t.abs());
            }
        }
    };
    let both_parts = |entry: Entry| (entry.sum.two_fold(), entry.size);
    let w = Rows::summed(expansion.rows(), dim, monitor, times_expansion, both_parts)?;
    let is_rounded = expansion.values().iter().any(|t| *t != t.round());
    let lower_part = |a: usize, row: &mut Accumulator<Entry>| {
        row.slot(a as u32);
        for (i, t) in by_unknown.row(a) {
            for (&b, &(v, size)) in w.indices[w.offsets[i]..w.offsets[i + 1]]
                .iter()
                .zip(&w.values[w.offsets[i]..w.offsets[i + 1]])
            {
                if b as usize <= a {
                    row.slot(b).add(t, v, size);
                }
            }
        }
        row.sort();
    };
    let value = |entry: Entry| entry.value(is_rounded);
    let h = Rows::summed(dim, dim, monitor, lower_part, value)?;
    if h.values.iter().any(|v| !v.is_finite()) {
        return Err(overflow());
    }
    Ok(Sparse::from_parts(dim, h.offsets, h.indices, h.values))
}

/// The lower triangle with the same values, and with every diagonal entry stored. Where it has them all, it is not
/// copied.
pub(super) fn with_diagonal(lower: Arc<Sparse>) -> Result<Arc<Sparse>> {
    let n = lower.rows();
    if (0..n).all(|i| lower.row(i).next_back().is_some_and(|(j, _)| j == i)) {
        return Ok(lower);
    }
    let mut offsets = reserve(n + 1)?;
    let mut indices = reserve(lower.len() + n)?;
    let mut values = reserve(lower.len() + n)?;
    offsets.push(0);
    for i in 0..n {
        may_continue_at(i)?;
        let range = lower.offsets()[i]..lower.offsets()[i + 1];
        let row = &lower.indices()[range.clone()];
        indices.extend_from_slice(row);
        values.extend_from_slice(&lower.values()[range]);
        if row.last() != Some(&(i as u32)) {
            indices.push(i as u32);
            values.push(0.0);
        }
        offsets.push(indices.len());
    }
    Ok(Arc::new(Sparse::from_parts(n, offsets, indices, values)))
}

/// The linear term and the constant. Both cancel badly on real problems, so both sums are compensated.
pub(super) fn linear(model: &Model, expansion: &Expansion) -> Result<(Vec<f64>, f64)> {
    let offset = expansion.offset();
    let pulled = match offset.iter().all(|t| *t == 0.0) {
        true => vec![0.0; offset.len()],
        false => model.hessian().mul_symmetric(offset),
    };
    may_continue()?;
    let terms = || model.gradient().iter().zip(&pulled).enumerate();
    let matrix = expansion.matrix();
    let parts = in_parts(matrix.cols(), LEAST, |part| {
        // Each part looks at all terms and adds those of its own unknowns.
        let mut sums = vec![CompensatedSum::new(0.0); part.len()];
        for (i, (&q, &qt)) in terms() {
            may_continue_at(i)?;
            for (a, t) in matrix.row(i) {
                if let Some(sum) = sums.get_mut(a.wrapping_sub(part.start)) {
                    sum.add_product(t, q);
                    sum.add_product(t, qt);
                }
            }
        }
        Ok(sums.iter().map(CompensatedSum::value).collect())
    });
    let gradient = joined(parts.into_iter().collect::<Result<Vec<_>>>()?);
    let mut constant = CompensatedSum::new(model.constant());
    for (i, (&q, &qt)) in terms().filter(|(i, _)| offset[*i] != 0.0) {
        may_continue_at(i)?;
        constant.add_product(offset[i], q);
        constant.add_product(offset[i], 0.5 * qt);
    }
    let constant = constant.value();
    if !constant.is_finite() || gradient.iter().any(|g: &f64| !g.is_finite()) {
        return Err(overflow());
    }
    Ok((gradient, constant))
}

/// The sums of the absolute values of all terms of the linear term in [`linear`].
pub(super) fn linear_size(model: &Model, expansion: &Expansion) -> Vec<f64> {
    let offset = expansion.offset();
    let mut size = model.gradient_size();
    for (i, j, q) in model.hessian().entries() {
        let (i, j) = (i as usize, j as usize);
        size[i] += (q * offset[j]).abs();
        if i != j {
            size[j] += (q * offset[i]).abs();
        }
    }
    let mut reduced = vec![0.0; expansion.matrix().cols()];
    for (i, a, t) in expansion.matrix().entries() {
        reduced[a as usize] += t.abs() * size[i as usize];
    }
    reduced
}

fn overflow() -> Error {
    Error::Overflow {
        what: "the objective overflows when the constraints are put into it".into(),
        index: None,
    }
}

/// An entry that is being summed, and the sum of the absolute values of its terms.
#[derive(Debug, Clone, Copy, Default)]
struct Entry {
    sum: CompensatedSum,
    size: f64,
}

impl Entry {
    /// Adds `a * b`, where `b` is a sum of terms of this `size`.
    fn add(&mut self, a: f64, b: TwoFold, size: f64) {
        self.sum.add_multiple(a, b);
        self.size += a.abs() * size;
    }

    /// The sum. With a rounded expansion, a sum that has cancelled is zero: only the rounding is left.
    fn value(&self, is_rounded: bool) -> f64 {
        let value = self.sum.value();
        let cancelled = is_rounded && value.abs() <= 16.0 * f64::EPSILON * self.size;
        if cancelled { 0.0 } else { value }
    }
}

/// Sparse rows, one after the other.
struct Rows<T> {
    offsets: Vec<usize>,
    indices: Vec<u32>,
    values: Vec<T>,
}

impl<T: Send> Rows<T> {
    /// Rows of length `dim`. `sum` sums up the row of a number, and `value` is what is kept of an entry.
    fn summed(
        rows: usize,
        dim: usize,
        monitor: &mut Monitor,
        sum: impl Fn(usize, &mut Accumulator<Entry>) + Sync,
        value: impl Fn(Entry) -> T + Sync,
    ) -> Result<Self> {
        let some = |numbers: Range<usize>| -> Result<Self> {
            let mut row: Accumulator<Entry> = Accumulator::new(dim);
            let mut some = Rows::new(numbers.len())?;
            for i in numbers {
                sum(i, &mut row);
                some.push(&mut row, &value)?;
            }
            Ok(some)
        };
        let mut all = Rows::new(rows)?;
        for start in (0..rows).step_by(UNASKED) {
            monitor.check()?;
            let count = UNASKED.min(rows - start);
            let parts = in_parts(count, LEAST, |part| {
                some(start + part.start..start + part.end)
            });
            for part in parts {
                all.append(part?)?;
            }
        }
        Ok(all)
    }

    fn new(rows: usize) -> Result<Self> {
        let mut offsets = reserve(rows + 1)?;
        offsets.push(0);
        Ok(Rows {
            offsets,
            indices: Vec::new(),
            values: Vec::new(),
        })
    }

    /// Appends `row` in the order of its list, and empties it.
    fn push(&mut self, row: &mut Accumulator<Entry>, value: impl Fn(Entry) -> T) -> Result<()> {
        self.reserve(row.len())?;
        row.drain(|j, v| {
            self.indices.push(j);
            self.values.push(value(v));
        });
        self.offsets.push(self.indices.len());
        Ok(())
    }

    /// Appends the rows of `other`.
    fn append(&mut self, mut other: Self) -> Result<()> {
        let before = self.indices.len();
        if before == 0 {
            (self.indices, self.values) = (other.indices, other.values);
        } else {
            self.reserve(other.indices.len())?;
            self.indices.append(&mut other.indices);
            self.values.append(&mut other.values);
        }
        self.offsets
            .extend(other.offsets[1..].iter().map(|at| before + at));
        Ok(())
    }

    /// Makes room for more entries.
    fn reserve(&mut self, entries: usize) -> Result<()> {
        let out_of_memory = |_| Error::OutOfMemory {
            what: "the reduced Hessian",
        };
        self.indices.try_reserve(entries).map_err(out_of_memory)?;
        self.values.try_reserve(entries).map_err(out_of_memory)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::monitor::{spawned, with_threads};

    #[test]
    fn any_number_of_threads_gives_the_same_hessian() {
        let n = 3 * LEAST as u32;
        let band =
            (0..n).flat_map(|i| (i.saturating_sub(2)..=i).map(move |j| (i, j, f64::from(1 + j))));
        let lower = Sparse::from_triplets(n as usize, n as usize, band).unwrap();
        // Unknowns 2 a and 2 a + 1 are y_a and y_a / 3 + y_0.
        let rows = (0..n).flat_map(|i| match i % 2 {
            0 => vec![(i, i / 2, 1.0)],
            _ => vec![(i, i / 2, 1.0 / 3.0), (i, 0, 1.0)],
        });
        let expansion = Sparse::from_triplets(n as usize, n as usize / 2, rows).unwrap();
        let of = |threads| {
            let projected = || hessian(&lower, &expansion, &mut Monitor::default());
            with_threads(threads, projected).unwrap()
        };
        let one = of(1);
        assert!(spawned(|| assert_eq!(of(3), one)) > 2);
        let y: Vec<f64> = (0..n / 2).map(|a| f64::from(a % 7)).collect();
        let energy = |matrix: &Sparse, x: &[f64]| -> f64 {
            let slopes = matrix.mul_symmetric(x);
            slopes.iter().zip(x).map(|(s, x)| s * x).sum()
        };
        let whole = energy(&lower, &expansion.mul(&y));
        assert!((energy(&one, &y) - whole).abs() < 1e-10 * whole);
    }
}
