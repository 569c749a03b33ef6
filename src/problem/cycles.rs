//! A hint from the caller: short cycles in the graph whose edges are the least-squares rows.

use super::RowList;
use super::check::{in_range, same_length};
use crate::error::{Error, Result};
use crate::monitor::in_parts;

/// An unknown has cancelled if its coefficient is at most this, relative to the coefficients in the sum.
const CANCELLED: f64 = 1e-12;

/// The least number of cycles that are worth a thread.
const LEAST: usize = 1 << 13;

/// Cycles, as signed sums of least-squares rows in which all continuous unknowns cancel.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct CycleHint {
    offsets: Vec<usize>,
    rows: Vec<u32>,
    signs: Vec<i8>,
}

impl CycleHint {
    pub(super) fn new(
        row_count: usize,
        offsets: &[usize],
        rows: &[usize],
        signs: &[i8],
    ) -> Result<Self> {
        same_length("cycle signs", rows.len(), signs.len())?;
        in_range("cycle rows", rows, row_count)?;
        if let Some(position) = signs.iter().position(|s| s.abs() != 1) {
            return Err(Error::InvalidArgument {
                what: format!("cycle sign {} is neither 1 nor -1", signs[position]),
                index: Some(position),
            });
        }
        let grows = offsets.windows(2).all(|w| w[0] <= w[1]);
        if offsets.first() != Some(&0) || offsets.last() != Some(&rows.len()) || !grows {
            return Err(Error::InvalidArgument {
                what: format!("cycle offsets do not grow from 0 to {}", rows.len()),
                index: None,
            });
        }
        Ok(CycleHint {
            offsets: offsets.to_vec(),
            rows: rows.iter().map(|&r| r as u32).collect(),
            signs: signs.to_vec(),
        })
    }

    /// Number of cycles.
    pub fn len(&self) -> usize {
        self.offsets.len().saturating_sub(1)
    }

    /// Whether there is no cycle.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// The rows of cycle `k`, each with its sign.
    pub fn cycle(&self, k: usize) -> impl ExactSizeIterator<Item = (usize, f64)> + '_ {
        let range = self.offsets[k]..self.offsets[k + 1];
        let pairs = self.rows[range.clone()].iter().zip(&self.signs[range]);
        pairs.map(|(&r, &s)| (r as usize, f64::from(s)))
    }

    /// The first cycle in which a continuous unknown does not cancel.
    pub(super) fn fault(&self, rows: &RowList, integer: &[bool]) -> Option<usize> {
        let parts = in_parts(self.len(), LEAST, |mut part| {
            let mut sum = vec![0.0; integer.len()];
            let mut touched = Vec::new();
            part.find(|&k| {
                touched.clear();
                for (row, sign) in self.cycle(k) {
                    for (i, a) in rows.row(row).filter(|&(i, _)| !integer[i]) {
                        sum[i] += sign * a;
                        touched.push((i, a.abs()));
                    }
                }
                let stays = touched.iter().any(|&(i, a)| sum[i].abs() > CANCELLED * a);
                touched.iter().for_each(|&(i, _)| sum[i] = 0.0);
                stays
            })
        });
        parts.into_iter().flatten().next()
    }
}

#[cfg(test)]
mod tests {
    use crate::problem::{Model, Problem};

    #[test]
    fn a_cycle_holds_when_its_angles_cancel() {
        let mut problem = Problem::new(4).unwrap();
        problem.set_integers(&[3]).unwrap();
        for (i, j) in [(0, 1), (1, 2), (2, 0)] {
            problem
                .add_least_squares(&[i, j, 3], &[1.0, -1.0, 2.0], 0.0, 1.0)
                .unwrap();
        }
        problem
            .hint_cycles(&[0, 3], &[0, 1, 2], &[1, 1, 1])
            .unwrap();
        assert_eq!(Model::new(&problem).unwrap().ignored_hint(), None);
        problem
            .hint_cycles(&[0, 3, 5], &[0, 1, 2, 0, 1], &[1, 1, 1, 1, -1])
            .unwrap();
        assert_eq!(Model::new(&problem).unwrap().ignored_hint(), Some(1));
        assert_eq!(
            problem
                .hint_cycles(&[0, 1], &[3], &[1])
                .unwrap_err()
                .index(),
            Some(0)
        );
        assert_eq!(
            problem
                .hint_cycles(&[0, 1], &[0], &[2])
                .unwrap_err()
                .index(),
            Some(0)
        );
        assert!(problem.hint_cycles(&[0, 2], &[0], &[1]).is_err());
        assert!(problem.hint_cycles(&[], &[], &[]).is_err());
    }
}
