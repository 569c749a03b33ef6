//! The published form of local re-optimisation by Gauss-Seidel: a queue of unknowns. If the step of an
//! unknown exceeds a tolerance, the unknown is updated and its neighbours are queued.
//!
//! The method is that of `bommes2009`, section 3. [`LocalSolve`](super::LocalSolve) is the improved form;
//! this one reproduces the published results, with their errors. An unknown may be in the queue more than
//! once. Of all variants tried, this one gave the energies of the thesis' program, on the orientation fields
//! of a rocker arm (1,000 and 2,000 faces) and of a body with three holes.
//!
//! A visit to an unknown around which nothing has changed since its last one is counted, but not computed again.

use super::Sparse;
use super::ring::Ring;
use super::sparse::reserve;
use crate::error::Result;

/// The longest queue. A longer one means that Gauss-Seidel does not converge: it then counts as out of
/// budget, which bounds the memory.
const LONGEST_QUEUE: usize = 1 << 24;

/// A symmetric matrix with both triangles, by rows, and a queue of its unknowns.
#[derive(Debug)]
pub struct QueueGaussSeidel<'a> {
    rows: Sparse,
    diagonal: Vec<f64>,
    gradient: &'a [f64],
    queue: Ring,
    /// By unknown: whether it, or what it couples to, has changed since its last visit.
    changed: Vec<bool>,
}

impl<'a> QueueGaussSeidel<'a> {
    /// Prepares `1/2 x'Hx + g'x`, where `lower` is the lower triangle of H.
    ///
    /// # Errors
    /// [`Error::OutOfMemory`](crate::Error::OutOfMemory).
    pub fn new(lower: &Sparse, gradient: &'a [f64]) -> Result<Self> {
        let n = lower.rows();
        let mirrored = lower.entries().filter(|(i, j, _)| i != j);
        let both = lower.entries().chain(mirrored.map(|(i, j, v)| (j, i, v)));
        let mut diagonal = reserve(n)?;
        diagonal.resize(n, 0.0);
        for (i, _, v) in lower.entries().filter(|(i, j, _)| i == j) {
            diagonal[i as usize] = v;
        }
        let mut changed = reserve(n)?;
        changed.resize(n, true);
        Ok(QueueGaussSeidel {
            rows: Sparse::from_triplets(n, n, both)?,
            diagonal,
            gradient,
            queue: Ring::default(),
            changed,
        })
    }

    /// H.
    pub fn rows(&self) -> &Sparse {
        &self.rows
    }

    /// Queues the neighbours of `unknown`, which has changed, that are not held.
    pub fn queue_neighbours(&mut self, unknown: u32, held: &[bool]) {
        let row = self.rows.row(unknown as usize);
        self.queue.reserve(row.len());
        for (j, v) in row {
            let enters = (v != 0.0) & (j != unknown as usize) & !held[j];
            self.changed[j] |= enters;
            self.queue.push_if(j as u32, enters);
        }
    }

    /// Visits at most `looks` queued unknowns. Each that is further than `tolerance` from its own minimum
    /// moves there in `point` and is entered in `moved`. Returns the number of visits.
    ///
    /// Between two calls, [`clear`](Self::clear) must tell if `point` was changed elsewhere, or the tolerance.
    pub fn relax(
        &mut self,
        point: &mut [f64],
        held: &[bool],
        tolerance: f64,
        looks: usize,
        moved: &mut Vec<u32>,
    ) -> usize {
        for taken in 0..looks {
            if self.queue.len() > LONGEST_QUEUE {
                break;
            }
            let Some(unknown) = self.queue.pop() else {
                return taken;
            };
            let i = unknown as usize;
            if !self.changed[i] {
                continue;
            }
            self.changed[i] = false;
            let (mut slope, diagonal) = (self.gradient[i], self.diagonal[i]);
            for (j, v) in self.rows.row(i) {
                slope += v * point[j];
            }
            let step = slope / diagonal;
            if diagonal > 0.0 && step.abs() > tolerance {
                point[i] -= step;
                moved.push(unknown);
                self.changed[i] = true;
                self.queue_neighbours(unknown, held);
            }
        }
        looks
    }

    /// Whether the queue is empty.
    pub fn is_settled(&self) -> bool {
        self.queue.is_empty()
    }

    /// Empties the queue, for a point that is computed elsewhere.
    pub fn clear(&mut self) {
        self.queue.clear();
        self.changed.fill(true);
    }
}

#[cfg(test)]
mod tests {
    use super::super::minimise_fixed;
    use super::*;

    #[test]
    fn relaxing_ends_at_the_minimiser_with_the_held_unknowns_kept() {
        let n = 30u32;
        let springs = (0..n - 1).flat_map(|i| [(i, i, 2.0), (i + 1, i + 1, 2.0), (i + 1, i, -2.0)]);
        let ground = (0..n).map(|i| (i, i, 0.3));
        let a = Sparse::from_triplets(30, 30, springs.chain(ground)).unwrap();
        let gradient = vec![0.0; 30];
        let mut held = vec![false; 30];
        let mut point = vec![0.0; 30];
        let mut local = QueueGaussSeidel::new(&a, &gradient).unwrap();
        let mut moved = Vec::new();
        for i in [4usize, 17] {
            held[i] = true;
            point[i] = 3.0;
            local.queue_neighbours(i as u32, &held);
            local.relax(&mut point, &held, 1e-12, usize::MAX, &mut moved);
        }
        assert!(local.is_settled() && moved.iter().all(|&i| !held[i as usize] || i == 17));
        let expected = minimise_fixed(&a, &gradient, &held, &point).unwrap();
        for (x, y) in point.iter().zip(&expected) {
            assert!((x - y).abs() < 1e-9);
        }
    }

    #[test]
    fn a_budget_ends_early_and_what_is_forgotten_can_be_queued_again() {
        let a = Sparse::from_triplets(3, 3, (0..3).map(|i| (i, i, 2.0))).unwrap();
        let coupled = a.entries().chain([(1, 0, -1.0), (2, 1, -1.0)]);
        let a = Sparse::from_triplets(3, 3, coupled).unwrap();
        let mut local = QueueGaussSeidel::new(&a, &[0.0; 3]).unwrap();
        let held = [true, false, false];
        let mut point = [1.0, 0.0, 0.0];
        local.queue_neighbours(0, &held);
        assert_eq!(local.relax(&mut point, &held, 0.0, 1, &mut Vec::new()), 1);
        assert_eq!(point, [1.0, 0.5, 0.0]);
        assert!(!local.is_settled());
        local.clear();
        assert!(local.is_settled());
        local.queue_neighbours(0, &held);
        assert!(!local.is_settled());
    }

    #[test]
    fn visits_that_are_not_computed_again_change_no_bit() {
        let n = 60u32;
        let springs = (0..n - 1).flat_map(|i| [(i, i, 2.0), (i + 1, i + 1, 2.0), (i + 1, i, -2.0)]);
        let chords = (0..n - 7).flat_map(|i| [(i, i, 1.5), (i + 7, i + 7, 1.5), (i + 7, i, -1.5)]);
        let ground = (0..n).map(|i| (i, i, 0.1));
        let a = Sparse::from_triplets(60, 60, springs.chain(chords).chain(ground)).unwrap();
        let rows: Vec<Vec<(usize, f64)>> = {
            let mirrored = a.entries().filter(|(i, j, _)| i != j);
            let both = a.entries().chain(mirrored.map(|(i, j, v)| (j, i, v)));
            let both = Sparse::from_triplets(60, 60, both).unwrap();
            (0..60).map(|i| both.row(i).collect()).collect()
        };
        let gradient: Vec<f64> = (0..n).map(|i| 1e-4 * f64::from(i).sin()).collect();
        let mut held = vec![false; 60];
        let (mut point, mut plain) = (vec![0.0; 60], vec![0.0; 60]);
        let mut local = QueueGaussSeidel::new(&a, &gradient).unwrap();
        let (mut looks, mut plain_looks) = (0, 0);
        for fixed in [5usize, 40, 22, 23] {
            let value = 1.0 + fixed as f64;
            held[fixed] = true;
            (point[fixed], plain[fixed]) = (value, value);
            local.queue_neighbours(fixed as u32, &held);
            looks += local.relax(&mut point, &held, 1e-3, usize::MAX, &mut Vec::new());
            let neighbours = |i: usize| {
                let others = rows[i].iter().map(|&(j, _)| j);
                others.filter(|&j| j != i && !held[j]).collect::<Vec<_>>()
            };
            let mut queue: std::collections::VecDeque<usize> = neighbours(fixed).into();
            while let Some(i) = queue.pop_front() {
                plain_looks += 1;
                let slope = rows[i]
                    .iter()
                    .fold(gradient[i], |s, &(j, v)| s + v * plain[j]);
                let diagonal = rows[i].iter().find(|&&(j, _)| j == i).unwrap().1;
                let step: f64 = slope / diagonal;
                if step.abs() > 1e-3 {
                    plain[i] -= step;
                    queue.extend(neighbours(i));
                }
            }
            let bits = |v: &[f64]| v.iter().map(|x| x.to_bits()).collect::<Vec<_>>();
            assert!(bits(&point) == bits(&plain) && looks == plain_looks);
        }
    }
}
