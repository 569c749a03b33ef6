//! The interface of the strategies. A strategy offers integers, and the search evaluates them.
//!
//! For every offer, the search re-optimises the continuous unknowns exactly and evaluates the energy
//! itself. So no energy comes from a strategy, and every strategy can be stopped at any time.

mod factors;
mod incumbent;
mod lazy_rows;
mod options;
mod presets;
mod status;
mod stopped_by;
mod strategy;
pub(crate) mod table;
mod warm_start;
mod work;

pub use lazy_rows::{Candidate, LazyCallback, LazyRows};
pub use options::{OPTIONS, Options};
pub use presets::{PRESETS, Preset};
pub use status::{GAP_TOLERANCE, SolveStatus};
pub use stopped_by::StoppedBy;
pub use strategy::Strategy;
pub use table::{OptionInfo, OptionKind, OptionValue, UNSET};
pub use warm_start::WarmStart;

pub(crate) use factors::{Factors, MadeAhead};
pub(crate) use incumbent::Incumbent;
pub(crate) use lazy_rows::LazyProblem;
pub(crate) use status::is_closed;
pub(crate) use work::{ALWAYS, Work, of_relaxation};

use crate::eliminate::ReducedModel;
use crate::error::{Error, Result};
use crate::linalg::sum_below;
use crate::monitor::{Monitor, Phase, Stop, may_continue, span};

/// Integers are kept as floats, which are exact up to this size.
pub(crate) const LARGEST_INTEGER: f64 = 9_007_199_254_740_992.0;

/// An energy whose error may be larger than this part of it is computed again from the caller's numbers.
const JUDGED: f64 = 1e-12;

/// The exact energy of a point in the unknowns of the model, rounded once.
type Exact<'s> = Box<dyn Fn(&[f64]) -> Result<f64> + 's>;

/// The incumbent, the lower bound, the work spent and the monitor.
pub(crate) struct Search<'s, 'm> {
    model: &'s ReducedModel,
    relaxed: Vec<f64>,
    lower_bound: f64,
    incumbent: Option<Incumbent>,
    /// The exact energy of a point, if the model's own numbers may be too inaccurate.
    exact: Option<Exact<'s>>,
    /// The energy of what is not in the model, to which relative gaps refer as well.
    elsewhere: f64,
    /// The part of a gap that is allowed here.
    share: f64,
    complete: bool,
    stopped_by: StoppedBy,
    /// The multiplications spent, and their limit.
    pub work: Work,
    /// Progress, cancel, time limit.
    pub monitor: &'s mut Monitor<'m>,
}

impl<'s, 'm> Search<'s, 'm> {
    /// A search that starts from the relaxation's minimiser and the bound that it proves.
    pub fn new(
        model: &'s ReducedModel,
        relaxed: Vec<f64>,
        lower_bound: f64,
        monitor: &'s mut Monitor<'m>,
    ) -> Self {
        monitor.bounded(lower_bound);
        Search {
            model,
            relaxed,
            lower_bound,
            incumbent: None,
            exact: None,
            elsewhere: 0.0,
            share: 1.0,
            complete: false,
            stopped_by: StoppedBy::Nothing,
            work: Work::unlimited(),
            monitor,
        }
    }

    /// The same search, for one of `count` independent components of a problem. The others have the energy
    /// `elsewhere`, and `always` is this one's share of the budget that every problem has.
    pub fn of_component(mut self, count: usize, elsewhere: f64, always: u64) -> Self {
        self.elsewhere = elsewhere;
        self.share = 1.0 / count as f64;
        self.work.always = always;
        self
    }

    /// The same search, with a judge for energies that differ by less than the rounding errors of the model.
    pub fn judged_by(mut self, exact: impl Fn(&[f64]) -> Result<f64> + 's) -> Self {
        self.exact = Some(Box::new(exact));
        self
    }

    /// Counts this many multiplications. Returns whether to end.
    pub fn ends(&mut self, multiplications: u64) -> bool {
        let ends = self.work.ends(multiplications, self.monitor);
        if self.work.left() == 0 {
            self.stop_by(StoppedBy::Budget);
        }
        ends
    }

    /// Records that the strategy ends for this reason, unless one is known already.
    pub fn stop_by(&mut self, reason: StoppedBy) {
        if self.stopped_by == StoppedBy::Nothing {
            self.stopped_by = reason;
        }
    }

    /// Records that no solution that has not been evaluated has less energy than the incumbent.
    pub fn complete(&mut self) {
        self.complete = true;
    }

    /// The minimiser of the relaxation.
    pub fn relaxed(&self) -> &[f64] {
        &self.relaxed
    }

    /// The integers of the best solution so far, in their order.
    pub fn incumbent_integers(&self) -> Option<Vec<f64>> {
        let of = |best: &Incumbent| {
            let integers = self.model.integers().iter();
            integers.map(|&i| best.point[i as usize]).collect()
        };
        self.incumbent.as_ref().map(of)
    }

    /// The lower bound: no solution has less energy.
    pub fn lower_bound(&self) -> f64 {
        self.lower_bound
    }

    /// The best solution offered so far.
    ///
    /// # Errors
    /// The reason why the search was stopped, if there was no offer before.
    pub fn into_best(self) -> Result<Incumbent> {
        let stopped = self.monitor.stopped();
        self.incumbent
            .ok_or_else(|| stopped.map_or(Error::Cancelled, Error::from))
    }

    /// Makes the factor that offers need. After that an offer costs two solves. So a strategy that has to
    /// stop can still make one.
    ///
    /// # Errors
    /// An error for lack of memory, and the reason why the search was stopped, since there is no solution
    /// yet.
    pub fn prepare(&mut self, factors: &mut Factors) -> Result<()> {
        self.monitor.progress(Phase::Factor, 0.5)?;
        self.monitor.watching(|| factors.prepare(self.model))?;
        self.monitor.progress(Phase::Factor, 1.0)?;
        Ok(())
    }

    /// Offers one value for each integer unknown, in their order. Returns whether the offer is the best so
    /// far.
    ///
    /// # Errors
    /// [`Error::Overflow`] for integers beyond 2^53, an error for lack of memory, and the reason why the solve was
    /// stopped.
    pub fn offer(&mut self, factors: &mut Factors, integers: &[f64]) -> Result<bool> {
        let _span = span("evaluate");
        let _watch = self.monitor.watch();
        self.offer_in_any_case(factors, integers)
    }

    /// As [`offer`](Self::offer), also after the solve was stopped.
    ///
    /// # Errors
    /// As [`offer`](Self::offer).
    pub fn offer_in_any_case(&mut self, factors: &mut Factors, integers: &[f64]) -> Result<bool> {
        let model = self.model;
        let too_large = |(&i, z): (&u32, &f64)| {
            let whole = model.origin(i as usize) + z;
            whole.is_nan() || whole.abs() > LARGEST_INTEGER
        };
        if let Some(k) = model.integers().iter().zip(integers).position(too_large) {
            return Err(Error::Overflow {
                what: "an integer of the solution is beyond 2^53".into(),
                index: Some(model.integers()[k] as usize),
            });
        }
        may_continue()?;
        let mut point = self.relaxed.clone();
        for (&i, &z) in model.integers().iter().zip(integers) {
            point[i as usize] = z;
        }
        if !model.continuous().is_empty() {
            point = factors.follow(model, &point)?;
        }
        may_continue()?;
        let (mut energy, error) = model.energy(&point);
        may_continue()?;
        let at_least = sum_below(&[energy, -error]);
        if let Some(exact) = self
            .exact
            .as_ref()
            .filter(|_| error > JUDGED * energy.abs())
        {
            energy = exact(&point)?;
        }
        let best = self.incumbent.as_ref();
        let better = best.is_none_or(|best| energy < best.energy);
        if better {
            self.incumbent = Some(Incumbent {
                point,
                energy,
                at_least: at_least.min(energy),
            });
            self.monitor.improved(energy);
        }
        Ok(better)
    }

    /// The best solution so far.
    pub fn best(&self) -> Option<&Incumbent> {
        self.incumbent.as_ref()
    }

    /// Raises the lower bound to `bound` if `bound` is higher.
    pub fn raise_bound(&mut self, bound: f64) {
        if bound > self.lower_bound {
            self.lower_bound = bound;
            self.monitor.raised(bound);
        }
    }

    /// The lower bound at which the incumbent's relative gap is `gap`.
    pub fn wanted_bound(&self, gap: f64) -> f64 {
        let best = self.incumbent.as_ref();
        best.map_or(f64::INFINITY, |b| b.energy - self.allowed(gap, b.energy))
    }

    /// The difference of energy and bound that a relative gap allows.
    fn allowed(&self, gap: f64, energy: f64) -> f64 {
        gap * self.share * (energy + self.elsewhere).abs()
    }

    /// Whether the incumbent is proved to be optimal, or its relative gap is at most `gap`.
    pub fn is_within(&self, gap: f64) -> bool {
        let within = |_: &Incumbent| self.wanted_bound(gap) <= self.lower_bound;
        self.is_proved() || self.incumbent.as_ref().is_some_and(within)
    }

    /// Whether every solution that could be better has been visited, or none is left because the bound has
    /// reached the energy.
    pub fn is_complete(&self) -> bool {
        let reached = |best: &Incumbent| best.energy <= self.lower_bound;
        self.complete || self.incumbent.as_ref().is_some_and(reached)
    }

    fn is_proved(&self) -> bool {
        let rounding = 4.0 * self.model.rounding().constant;
        let closed = |best: &Incumbent| status::is_closed(best.energy, self.lower_bound, rounding);
        self.is_complete() || self.incumbent.as_ref().is_some_and(closed)
    }

    /// Why the search ended before it was complete, if it ended now.
    pub fn stopped_by(&self) -> StoppedBy {
        match self.monitor.stopped() {
            _ if self.is_proved() => StoppedBy::Nothing,
            Some(Stop::Cancelled) => StoppedBy::Cancel,
            Some(Stop::TimeLimit) => StoppedBy::Time,
            Some(Stop::OutOfMemory) => StoppedBy::Memory,
            None => self.stopped_by,
        }
    }

    /// The status of the search if it ended now.
    pub fn status(&self) -> SolveStatus {
        if self.incumbent.is_none() {
            SolveStatus::Relaxed
        } else if self.is_proved() {
            SolveStatus::Optimal
        } else {
            SolveStatus::unproved(self.stopped_by())
        }
    }
}
