//! The published form of local re-optimisation by Gauss-Seidel: a queue of unknowns. If the step of an
//! unknown exceeds a tolerance, the unknown is updated and its neighbours are queued.
//!
//! The method is that of `bommes2009`, section 3. [`LocalSolve`](super::LocalSolve) is the improved form;
//! this one reproduces the published results, with their errors. An unknown may be in the queue more than
//! once. Of all variants tried, this one gave the energies of the thesis' program, on the orientation fields
//! of a rocker arm (1,000 and 2,000 faces) and of a body with three holes.

use std::collections::VecDeque;

use super::Sparse;
use crate::error::Result;

/// The longest queue. A longer one means that Gauss-Seidel does not converge: it then counts as out of
/// budget, which bounds the memory.
const LONGEST_QUEUE: usize = 1 << 24;

/// A symmetric matrix with both triangles, by rows, and a queue of its unknowns.
#[derive(Debug)]
pub struct QueueGaussSeidel<'a> {
    rows: Sparse,
    gradient: &'a [f64],
    queue: VecDeque<u32>,
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
        Ok(QueueGaussSeidel {
            rows: Sparse::from_triplets(n, n, both)?,
            gradient,
            queue: VecDeque::new(),
        })
    }

    /// Queues the neighbours of `unknown` that are not held.
    pub fn queue_neighbours(&mut self, unknown: u32, held: &[bool]) {
        for (j, v) in self.rows.row(unknown as usize) {
            if v != 0.0 && j != unknown as usize && !held[j] {
                self.queue.push_back(j as u32);
            }
        }
    }

    /// Visits at most `looks` queued unknowns. Each that is further than `tolerance` from its own minimum
    /// moves there in `point` and is entered in `moved`. Returns the number of visits.
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
            let Some(unknown) = self.queue.pop_front() else {
                return taken;
            };
            let i = unknown as usize;
            let (mut slope, mut diagonal) = (self.gradient[i], 0.0);
            for (j, v) in self.rows.row(i) {
                slope += v * point[j];
                if j == i {
                    diagonal = v;
                }
            }
            let step = slope / diagonal;
            if diagonal > 0.0 && step.abs() > tolerance {
                point[i] -= step;
                moved.push(unknown);
                self.queue_neighbours(unknown, held);
            }
        }
        looks
    }

    /// Whether the queue is empty.
    pub fn is_settled(&self) -> bool {
        self.queue.is_empty()
    }

    /// Empties the queue, for a point that was computed elsewhere.
    pub fn clear(&mut self) {
        self.queue.clear();
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
}
