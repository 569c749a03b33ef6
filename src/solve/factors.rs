//! Factorizations, each made when it is first asked for and kept.
//!
//! There is no single factor: the relaxation wants a supernodal one, greedy a simplicial one that
//! can fix unknowns, and an offer of integers one of the continuous block.

use std::time::Instant;

use crate::Result;
use crate::eliminate::ReducedModel;
use crate::lattice::schur_factor;
use crate::linalg::{Cholesky, Ldl, Ordering, RelaxedFactor, Sparse};

/// The factors of one reduced model.
#[derive(Debug, Default)]
pub(crate) struct Factors {
    relaxed: Option<RelaxedFactor>,
    continuous: Option<ContinuousBlock>,
    /// As it was made, if it is kept.
    updatable: Option<Ldl>,
    ordering: Ordering,
    keep: bool,
    schur: Option<(Vec<f64>, bool)>,
    seconds: f64,
}

/// The Hessian seen by the continuous unknowns when the integers are given.
#[derive(Debug)]
pub(crate) struct ContinuousBlock {
    /// Lower triangle of the continuous block.
    pub hessian: Sparse,
    /// One row a continuous unknown, one column an integer.
    pub coupling: Sparse,
    pub factor: Cholesky,
}

impl Factors {
    /// None yet, each to be made in this order.
    pub fn new(ordering: Ordering) -> Self {
        Factors {
            ordering,
            ..Factors::default()
        }
    }

    /// As [`new`](Self::new), but what a solve uses up is kept as well, for the next one.
    pub fn kept(ordering: Ordering) -> Self {
        Factors {
            keep: true,
            ..Factors::new(ordering)
        }
    }

    /// Entries below the diagonal of the relaxation's factor; none before there is one.
    pub fn entries(&self) -> usize {
        self.relaxed.as_ref().map_or(0, RelaxedFactor::entries)
    }

    /// Seconds spent in factorizations so far.
    pub fn seconds(&self) -> f64 {
        self.seconds
    }

    /// The factor of the whole reduced Hessian, all integers real.
    pub fn relaxed(&mut self, model: &ReducedModel) -> Result<&RelaxedFactor> {
        let factor = match self.relaxed.take() {
            Some(factor) => factor,
            None => timed(&mut self.seconds, || {
                RelaxedFactor::ordered(model.hessian(), model.integers(), self.ordering)
            })?,
        };
        Ok(self.relaxed.insert(factor))
    }

    /// A factor of the whole reduced Hessian in which unknowns can be fixed: the caller's own, since
    /// fixing uses it up.
    pub fn updatable(&mut self, model: &ReducedModel) -> Result<Ldl> {
        let (keep, ordering) = (self.keep, self.ordering);
        let kept = &mut self.updatable;
        timed(&mut self.seconds, || {
            if let Some(ldl) = kept {
                return Ok(ldl.clone());
            }
            let made = Ldl::new(model.hessian(), &ordering.order(model.hessian())?)?;
            *kept = keep.then(|| made.clone());
            Ok(made)
        })
    }

    /// The triangular factor of the Schur complement of the integers, dense and by columns, and
    /// whether it has no zero on its diagonal.
    pub fn schur(&mut self, model: &ReducedModel) -> Result<(&[f64], bool)> {
        let (r, full) = match self.schur.take() {
            Some(schur) => schur,
            None => timed(&mut self.seconds, || schur_factor(model))?,
        };
        Ok((&self.schur.insert((r, full)).0, full))
    }

    /// The continuous block and its factor.
    pub fn continuous(&mut self, model: &ReducedModel) -> Result<&ContinuousBlock> {
        let block = match self.continuous.take() {
            Some(block) => block,
            None => timed(&mut self.seconds, || {
                ContinuousBlock::new(model, self.ordering)
            })?,
        };
        Ok(self.continuous.insert(block))
    }
}

impl ContinuousBlock {
    fn new(model: &ReducedModel, ordering: Ordering) -> Result<Self> {
        /// Place of an unknown among the integers or the continuous.
        #[derive(Clone, Copy)]
        enum Place {
            Integer(u32),
            Continuous(u32),
        }
        let mut place = vec![Place::Continuous(0); model.dim()];
        for (k, &i) in model.integers().iter().enumerate() {
            place[i as usize] = Place::Integer(k as u32);
        }
        for (k, &i) in model.continuous().iter().enumerate() {
            place[i as usize] = Place::Continuous(k as u32);
        }
        let entries = model.hessian().entries();
        let pair = |i: u32, j: u32| (place[i as usize], place[j as usize]);
        let own = entries.clone().filter_map(|(i, j, v)| match pair(i, j) {
            (Place::Continuous(a), Place::Continuous(b)) => Some((a, b, v)),
            _ => None,
        });
        let mixed = entries.filter_map(|(i, j, v)| match pair(i, j) {
            (Place::Continuous(a), Place::Integer(b)) => Some((a, b, v)),
            (Place::Integer(b), Place::Continuous(a)) => Some((a, b, v)),
            _ => None,
        });
        let (n, m) = (model.continuous().len(), model.integers().len());
        let hessian = Sparse::from_triplets(n, n, own)?;
        let coupling = Sparse::from_triplets(n, m, mixed)?;
        let factor = Cholesky::ordered(&hessian, ordering)?;
        Ok(ContinuousBlock {
            hessian,
            coupling,
            factor,
        })
    }
}

/// What `make` gives; the seconds it took are added to `seconds`.
fn timed<T>(seconds: &mut f64, make: impl FnOnce() -> Result<T>) -> Result<T> {
    let started = Instant::now();
    let made = make();
    *seconds += started.elapsed().as_secs_f64();
    made
}
