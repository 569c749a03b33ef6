//! The objective in the reduced unknowns.
//!
//! With `x = T y + t`, the objective `1/2 x'Qx + q'x + c` becomes
//!
//! ```text
//! 1/2 y' (T'QT) y + (T'(Qt + q))' y + (c + q't + 1/2 t'Qt).
//! ```

use super::Expansion;
use crate::error::{Error, Result};
use crate::linalg::sparse::reserve;
use crate::linalg::{Accumulator, CompensatedSum, Sparse, TwoFold};
use crate::monitor::Monitor;
use crate::problem::Model;

/// The lower triangle of `T'QT` by rows, with every diagonal entry stored (`gustavson1978`). It first
/// computes `W = QT`, in twice the working precision, since an integer of a map may couple a thousand
/// unknowns whose terms nearly cancel. Row `a` of the result is the combination of the rows of `W` with the entries of column
/// `a` of `T`.
pub(super) fn hessian(lower: &Sparse, expansion: &Sparse, monitor: &mut Monitor) -> Result<Sparse> {
    let upper = lower.transpose();
    let by_unknown = expansion.transpose();
    let dim = expansion.cols();
    let mut row: Accumulator<Entry> = Accumulator::new(dim);
    let mut w = Rows::new(expansion.rows(), lower.len())?;
    for i in 0..expansion.rows() {
        monitor.check()?;
        let mirrored = upper.row(i).filter(|&(j, _)| j > i);
        for (j, q) in lower.row(i).chain(mirrored) {
            for (b, t) in expansion.row(j) {
                row.slot(b as u32).add(q, t.into(), t.abs());
            }
        }
        w.push(&mut row, |entry| (entry.sum.two_fold(), entry.size))?;
    }
    let is_rounded = expansion.values().iter().any(|t| *t != t.round());
    let mut h = Rows::new(dim, lower.len())?;
    for a in 0..dim {
        monitor.check()?;
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
        h.push(&mut row, |entry| entry.value(is_rounded))?;
    }
    if h.values.iter().any(|v| !v.is_finite()) {
        return Err(overflow());
    }
    Ok(Sparse::from_parts(dim, h.offsets, h.indices, h.values))
}

/// The lower triangle with the same values, and with every diagonal entry stored.
pub(super) fn with_diagonal(lower: &Sparse) -> Result<Sparse> {
    let n = lower.rows();
    let mut offsets = reserve(n + 1)?;
    let mut indices = reserve(lower.len() + n)?;
    let mut values = reserve(lower.len() + n)?;
    offsets.push(0);
    for i in 0..n {
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
    Ok(Sparse::from_parts(n, offsets, indices, values))
}

/// The linear term and the constant. Both cancel badly on real problems, so both sums are compensated.
pub(super) fn linear(model: &Model, expansion: &Expansion) -> Result<(Vec<f64>, f64)> {
    let offset = expansion.offset();
    let pulled = model.hessian().mul_symmetric(offset);
    let mut gradient = vec![CompensatedSum::new(0.0); expansion.matrix().cols()];
    let mut constant = CompensatedSum::new(model.constant());
    for (i, (&q, &qt)) in model.gradient().iter().zip(&pulled).enumerate() {
        for (a, t) in expansion.matrix().row(i) {
            gradient[a].add_product(t, q);
            gradient[a].add_product(t, qt);
        }
        constant.add_product(offset[i], q);
        constant.add_product(offset[i], 0.5 * qt);
    }
    let gradient: Vec<f64> = gradient.iter().map(CompensatedSum::value).collect();
    let constant = constant.value();
    if !constant.is_finite() || gradient.iter().any(|g| !g.is_finite()) {
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

impl<T> Rows<T> {
    fn new(rows: usize, entries: usize) -> Result<Self> {
        let mut offsets = reserve(rows + 1)?;
        offsets.push(0);
        Ok(Rows {
            offsets,
            indices: reserve(entries)?,
            values: reserve(entries)?,
        })
    }

    /// Appends `row` in the order of its list, and empties it.
    fn push(&mut self, row: &mut Accumulator<Entry>, value: impl Fn(Entry) -> T) -> Result<()> {
        let out_of_memory = |_| Error::OutOfMemory {
            what: "the reduced Hessian",
        };
        let more = row.len();
        self.indices.try_reserve(more).map_err(out_of_memory)?;
        self.values.try_reserve(more).map_err(out_of_memory)?;
        row.drain(|j, v| {
            self.indices.push(j);
            self.values.push(value(v));
        });
        self.offsets.push(self.indices.len());
        Ok(())
    }
}
