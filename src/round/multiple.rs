//! Multiple rounding in its published form, for programs that depend on its results.
//!
//! The method is that of `bommes2009`, section 3, and `bommes2012`, chapter 5. Each pass rounds the
//! integers with the least deviations. It takes as many as have a sum of at most a threshold. Then it
//! re-optimises by Gauss-Seidel, starting from their neighbours. If that exceeds its budget, conjugate
//! gradients follow. If these fail, a factorization follows, unless the options turn it off.
//!
//! [`adaptive`](super::adaptive) follows the same plan and is more accurate and faster. But if integers
//! with wide influence are rounded after a few iterations, the decisions depend on these iterations. A
//! program whose results must not change needs the same iterations. Together with
//! [`Ordering::LargestPivot`](crate::linalg::Ordering::LargestPivot), which keeps the same integers in the
//! elimination, this reproduces the decisions of the thesis' program on its seamless parametrizations.

use super::candidates::Candidates;
use crate::eliminate::ReducedModel;
use crate::error::Result;
use crate::linalg::{
    Effort, QueueGaussSeidel, minimise_fixed, unpreconditioned_conjugate_gradient,
};
use crate::monitor::Phase;
use crate::search::{Factors, Options, Search};

/// Gauss-Seidel updates between two checks of the monitor.
const LOOKS_AT_A_TIME: usize = 10_000;

/// Rounds by passes.
///
/// If it has to stop early, it offers the integers decided so far and rounds the others.
///
/// # Errors
/// [`Error::OutOfMemory`](crate::Error::OutOfMemory), and the errors of [`Search::offer`].
pub(crate) fn multiple(
    model: &ReducedModel,
    options: &Options,
    factors: &mut Factors,
    search: &mut Search,
) -> Result<()> {
    let integers = model.integers();
    let mut passes = Passes {
        model,
        options,
        local: QueueGaussSeidel::new(model.hessian(), model.gradient())?,
        point: search.relaxed().to_vec(),
        fixed: vec![false; model.dim()],
    };
    let mut candidates = Candidates::new(model.dim());
    for &i in integers {
        candidates.push(i, passes.point[i as usize]);
    }
    let mut is_integer = vec![false; model.dim()];
    integers.iter().for_each(|&i| is_integer[i as usize] = true);
    let mut left = integers.len();
    while left > 0 {
        let done = 1.0 - left as f64 / integers.len() as f64;
        if search.monitor.ends_at(Phase::Round, done) {
            break;
        }
        let batch = candidates.take(options.rounding_threshold, |i| {
            (!passes.fixed[i as usize]).then(|| passes.point[i as usize])
        });
        left -= batch.len();
        let changed = passes.round(&batch, search)?;
        let open = |&i: &u32| is_integer[i as usize] && !passes.fixed[i as usize];
        match changed {
            Changed::These(moved) => moved
                .into_iter()
                .filter(open)
                .for_each(|i| candidates.push(i, passes.point[i as usize])),
            Changed::Anything => integers
                .iter()
                .copied()
                .filter(open)
                .for_each(|i| candidates.push(i, passes.point[i as usize])),
        }
    }
    let nearest = |&i: &u32| model.nearest(i as usize, passes.point[i as usize]);
    let rounded: Vec<f64> = integers.iter().map(nearest).collect();
    search.offer(factors, &rounded)?;
    Ok(())
}

/// The state of the passes.
struct Passes<'a> {
    model: &'a ReducedModel,
    options: &'a Options,
    local: QueueGaussSeidel<'a>,
    point: Vec<f64>,
    fixed: Vec<bool>,
}

/// The unknowns that a pass moved.
enum Changed {
    These(Vec<u32>),
    Anything,
}

impl Passes<'_> {
    /// Rounds a batch and re-optimises: locally, then iteratively, then exactly.
    fn round(&mut self, batch: &[u32], search: &mut Search) -> Result<Changed> {
        let options = self.options;
        for &i in batch {
            let i = i as usize;
            self.point[i] = self.model.nearest(i, self.point[i]);
            self.fixed[i] = true;
        }
        let mut budget = options.gauss_seidel_updates;
        if budget > 0 {
            for &i in batch {
                self.local.queue_neighbours(i, &self.fixed);
            }
            let mut moved = Vec::new();
            while budget > 0 && !self.local.is_settled() {
                budget -= self.local.relax(
                    &mut self.point,
                    &self.fixed,
                    options.gauss_seidel_tolerance,
                    budget.min(LOOKS_AT_A_TIME),
                    &mut moved,
                );
                if search.monitor.ends() {
                    return Ok(Changed::Anything);
                }
            }
            if self.local.is_settled() {
                return Ok(Changed::These(moved));
            }
            self.local.clear();
        }
        let (hessian, gradient) = (self.model.hessian(), self.model.gradient());
        let effort = Effort {
            iterations: options.cg_iterations,
            tolerance: options.cg_tolerance,
        };
        let converged = unpreconditioned_conjugate_gradient(
            self.local.rows(),
            gradient,
            &self.fixed,
            &mut self.point,
            effort,
            || !search.monitor.ends(),
        );
        if !converged && options.exact_steps && !search.monitor.ends() {
            self.point = minimise_fixed(hessian, gradient, &self.fixed, &self.point)?;
        }
        Ok(Changed::Anything)
    }
}
