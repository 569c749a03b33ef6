//! A run: one computation of one or more solves, and what their monitors share.
//!
//! The share of the run that is done never falls. A run is a sequence of parts, whose sizes come from
//! measured times; a part is a sequence of solves and other steps, whose number is not known beforehand. Each
//! step therefore takes a fixed fraction of what is left of its part.

use std::cell::Cell;
use std::rc::Rc;

use super::event::{Phase, Stage};

/// The fraction of what is left of a part that the next step takes.
const STEP: f64 = 0.75;

/// What the monitors of one run share: how much of it is done, and whether the caller wants to have it
/// finished.
///
/// Every call of the library is a run of its own, unless its monitors are [of one
/// run](super::Monitor::of_run). A clone is the same run.
#[derive(Debug, Clone)]
pub struct Run(Rc<State>);

/// The stages of a plan, in their order.
const PLANNED: [Stage; 4] = [Stage::Field, Stage::Map, Stage::Quads, Stage::Smooth];

#[derive(Debug)]
struct State {
    stage: Cell<Stage>,
    /// The share of the run that is done.
    done: Cell<f64>,
    /// The share of the run that the current call of the library has.
    call: Cell<[f64; 2]>,
    /// The share of the call at which each of the planned stages ends.
    plan: Cell<[f64; 4]>,
    /// Where the current part of the run ends.
    part_end: Cell<f64>,
    is_finishing: Cell<bool>,
    has_solution: Cell<bool>,
    /// Whether the run has a result without the current step as well.
    is_optional: Cell<bool>,
}

impl Default for Run {
    fn default() -> Self {
        Run(Rc::new(State {
            stage: Cell::new(Stage::Solve),
            done: Cell::new(0.0),
            call: Cell::new([0.0, 1.0]),
            plan: Cell::new([1.0; 4]),
            part_end: Cell::new(1.0),
            is_finishing: Cell::new(false),
            has_solution: Cell::new(false),
            is_optional: Cell::new(false),
        }))
    }
}

impl Run {
    /// A run of which nothing is done.
    pub fn new() -> Self {
        Self::default()
    }

    /// Gives the next call of the library the share of the run from `from` to `to`.
    pub fn next_call(&self, from: f64, to: f64) {
        self.0.call.set([from, to]);
        self.0.part_end.set(to);
        self.reach(from);
    }

    /// The share of the run that is done, from 0 to 1. It never falls.
    pub fn share(&self) -> f64 {
        self.0.done.get()
    }

    /// Makes a step that has the share of the current call from `from` to `to`.
    pub(crate) fn with_share<T>(&self, [from, to]: [f64; 2], step: impl FnOnce() -> T) -> T {
        let call = self.0.call.get();
        self.next_call(self.of_call(from), self.of_call(to));
        let made = step();
        self.0.call.set(call);
        self.0.part_end.set(call[1]);
        made
    }

    /// Plans the stages of the current call, from field to smoothing: the share of the call at which each
    /// of them ends.
    pub(crate) fn plan(&self, ends: [f64; 4]) {
        self.0.plan.set(ends);
    }

    /// Starts the part `k` of `count` equal parts of a stage. A stage that was passed before takes half of
    /// what is left before quads are smoothed.
    pub(crate) fn enter(&self, stage: Stage, k: usize, count: usize) {
        self.0.stage.set(stage);
        let plan = self.0.plan.get();
        let at = PLANNED.iter().position(|&s| s == stage);
        let Some(at) = at else {
            return;
        };
        let from = if at == 0 { 0.0 } else { plan[at - 1] };
        let part = |k: usize| self.of_call(from + k as f64 / count as f64 * (plan[at] - from));
        let done = self.share();
        let end = part(k + 1);
        self.0.part_end.set(if done < end {
            self.reach(part(k));
            end
        } else {
            let last = self.of_call(0.5 * (1.0 + plan[2]));
            done + 0.5 * (last - done).max(0.0)
        });
    }

    /// Names the stage of a call that has one.
    pub(crate) fn name_stage(&self, stage: Stage) {
        self.0.stage.set(stage);
    }

    /// Ends the current call.
    pub(crate) fn end_call(&self) {
        self.reach(self.of_call(1.0));
    }

    fn of_call(&self, share: f64) -> f64 {
        let [from, to] = self.0.call.get();
        from + share * (to - from)
    }

    pub(super) fn stage(&self) -> Stage {
        self.0.stage.get()
    }

    /// Asks for the results so far.
    pub(super) fn finish(&self) {
        self.0.is_finishing.set(true);
    }

    pub(super) fn is_finishing(&self) -> bool {
        self.0.is_finishing.get()
    }

    /// Records that integers are known.
    pub(super) fn has_solved(&self) {
        self.0.has_solution.set(true);
    }

    /// Whether a step of the run has found integers, so that the run has a result to finish.
    pub(super) fn has_solution(&self) -> bool {
        self.0.has_solution.get()
    }

    /// Sets whether the run has a result without the current step as well, and gives what was set before.
    pub(super) fn set_optional(&self, is_optional: bool) -> bool {
        self.0.is_optional.replace(is_optional)
    }

    pub(super) fn is_optional(&self) -> bool {
        self.0.is_optional.get()
    }

    /// The share of the run that the next step of its part takes.
    pub(super) fn step(&self) -> [f64; 2] {
        let done = self.share();
        [done, done + STEP * (self.0.part_end.get() - done).max(0.0)]
    }

    /// Records that this much of the run is done, unless more is.
    pub(super) fn reach(&self, share: f64) {
        let share = share.clamp(0.0, 1.0);
        if share > self.share() {
            self.0.done.set(share);
        }
    }
}

/// The fraction of a step that is done with this fraction of its phase. Factorizations take about half of
/// the time of a solve, on fields and maps of 10,000 to 200,000 triangles.
pub(super) fn of_step(phase: Phase, fraction: f64) -> f64 {
    let (from, to) = match phase {
        Phase::Eliminate => (0.0, 0.1),
        Phase::Factor => (0.1, 0.5),
        Phase::Round => (0.5, 1.0),
        Phase::Untangle | Phase::Quads => (0.0, 1.0),
    };
    from + fraction.clamp(0.0, 1.0) * (to - from)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_share_follows_the_plan_and_never_falls() {
        let close = |a: f64, b: f64| assert!((a - b).abs() < 1e-14, "{a} is not {b}");
        let run = Run::new();
        run.next_call(0.2, 0.7);
        assert_eq!(run.share(), 0.2);
        run.plan([0.4, 0.6, 0.8, 1.0]);
        run.enter(Stage::Field, 0, 2);
        assert_eq!((run.share(), run.stage()), (0.2, Stage::Field));
        let [from, to] = run.step();
        close(from, 0.2);
        close(to, 0.2 + STEP * 0.1);
        run.reach(to);
        run.reach(0.1);
        assert_eq!(run.share(), to);
        run.enter(Stage::Field, 1, 2);
        close(run.share(), 0.3);
        run.enter(Stage::Map, 0, 1);
        close(run.share(), 0.4);
        run.enter(Stage::Quads, 0, 1);
        close(run.share(), 0.5);
        run.enter(Stage::Field, 0, 1);
        assert_eq!(run.stage(), Stage::Field);
        let [from, to] = run.step();
        assert!(from < to && to < 0.65, "{to}");
        run.enter(Stage::Smooth, 0, 1);
        close(run.share(), 0.6);
        run.end_call();
        close(run.share(), 0.7);
    }

    #[test]
    fn a_step_with_a_share_of_its_own_stays_within_it() {
        let run = Run::new();
        let at = run.with_share([0.0, 0.5], || {
            run.end_call();
            run.share()
        });
        assert_eq!(at, 0.5);
        assert_eq!(run.step()[1], 0.5 + STEP * 0.5);
    }

    #[test]
    fn any_number_of_steps_stays_within_its_part() {
        let run = Run::new();
        run.plan([0.25, 0.5, 0.75, 1.0]);
        run.enter(Stage::Field, 0, 1);
        for _ in 0..1_000 {
            let [from, to] = run.step();
            assert!(from <= to && to <= 0.25);
            run.reach(to);
        }
    }

    #[test]
    fn the_phases_of_a_step_follow_each_other() {
        let phases = [Phase::Eliminate, Phase::Factor, Phase::Round];
        let ends = phases.map(|phase| [of_step(phase, 0.0), of_step(phase, 1.0)]);
        assert_eq!(ends[0][0], 0.0);
        assert_eq!(ends[0][1], ends[1][0]);
        assert_eq!(ends[1][1], ends[2][0]);
        assert_eq!(ends[2][1], 1.0);
    }
}
