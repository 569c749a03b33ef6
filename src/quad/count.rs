//! The number of quads that was asked for, met.
//!
//! A map without folds covers as many unit squares as it has quads, and scaling its gradients scales its
//! relaxation: the number of quads is nearly proportional to the square of the scale, in the steps that the
//! integers allow. So the map of the field that the quads follow is solved for again at other scales, until
//! as many unit squares are covered as quads were asked for. Only linear terms change, and the solver keeps
//! its factors. Quads are extracted from the maps that promise a better number, and the nearest number whose
//! quads are as whole as those at first is kept.

use super::aim::area;
use super::attempt::Attempt;
use super::driver::{Driver, Try};
use super::final_error::is_final;
use super::map_solver::Solved;
use crate::error::Result;
use crate::map::Sizing;
use crate::monitor::{Monitor, optional};
use crate::search::table::words;

words! {
    /// How nearly a number of quads is met.
    #[derive(Debug, Clone, Copy, PartialEq, Eq)]
    pub enum Count {
        Exact = "exact": "Within one in a hundred, or as near as a few maps at other scales come.",
        About = "about": "As the map has it that covers as many unit squares before its integers are decided.",
    }
}

/// The part of a number of quads by which it may be missed.
const TOLERANCE: f64 = 0.01;

/// The most maps at other scales.
const MAPS: usize = 8;

/// The most of them whose quads are extracted.
const EXTRACTIONS: usize = 3;

/// Scales whose squares differ by less than this part have the same integers, but for a tie.
const NARROW: f64 = 1e-4;

/// A square of a scale, and the number of quads there.
type Step = [f64; 2];

/// The scales between which the number of quads passes the one that was asked for.
struct Scales {
    asked: f64,
    below: Option<Step>,
    above: Option<Step>,
    /// How many steps in a row ended on the side of the last one; negative below.
    streak: i32,
}

impl Scales {
    fn new(asked: f64) -> Self {
        Scales {
            asked,
            below: None,
            above: None,
            streak: 0,
        }
    }

    /// Notes the number of quads at a scale.
    fn add(&mut self, step: Step) {
        let is_below = step[1] < self.asked;
        self.streak = match is_below {
            true => self.streak.min(0) - 1,
            false => self.streak.max(0) + 1,
        };
        *(if is_below { &mut self.below } else { &mut self.above }) = Some(step);
    }

    /// The square of the next scale; `None` if the scales cannot be told apart any more. Between two scales it
    /// is found by a line, or in the middle where lines keep ending on one side. With scales on one side alone,
    /// their number is taken to be in proportion, and steps become longer.
    fn next(&self) -> Option<f64> {
        match (self.below, self.above) {
            (Some([low, fewer]), Some([high, more])) => {
                let share = match self.streak.abs() {
                    1 => ((self.asked - fewer) / (more - fewer)).clamp(0.1, 0.9),
                    _ => 0.5,
                };
                (high - low > NARROW * low).then_some(low + share * (high - low))
            }
            (Some([square, count]), None) | (None, Some([square, count])) => {
                let ratio = self.asked / count.max(1.0);
                let power = self.streak.abs().min(MAPS as i32);
                Some(square * ratio.clamp(0.25, 4.0).powi(power))
            }
            (None, None) => None,
        }
    }
}

/// The search for the number of quads.
struct Meeting<'d, 'a, M> {
    driver: &'d mut Driver<'a, M>,
    asked: f64,
    best: Attempt,
    /// Quads a unit square: what repairs add and boundaries that no line follows take.
    per_square: f64,
    /// The square of the scale of the field's problem.
    square: f64,
    maps: usize,
    extractions: usize,
}

/// The best quads with as many of them as the options ask for, and the number of maps that were solved for that.
pub(super) fn meet<'m, M: Fn() -> Monitor<'m>>(
    driver: &mut Driver<'_, M>,
    best: Attempt,
) -> Result<(Attempt, usize)> {
    let Sizing::Quads(asked) = driver.options.sizing else {
        return Ok((best, 0));
    };
    if driver.options.count == Count::About || !best.outcome.conforms() {
        return Ok((best, 0));
    }
    driver.current = best.field;
    let monitor = driver.monitor;
    let mut meeting = Meeting {
        asked: asked as f64,
        per_square: best.quads.quads.len() as f64 / area(driver.mesh, &best.map.map),
        driver,
        best,
        square: 1.0,
        maps: 0,
        extractions: 0,
    };
    match optional(monitor, || meeting.search()) {
        Err(error) if is_final(&error) => Err(error),
        // The quads that there are remain.
        _ => Ok((meeting.best, meeting.maps)),
    }
}

impl<'m, M: Fn() -> Monitor<'m>> Meeting<'_, '_, M> {
    fn search(&mut self) -> Result<()> {
        let mut scales = Scales::new(self.asked);
        let mesh = self.driver.mesh;
        let squares = area(mesh, self.driver.at_hand().map());
        scales.add([1.0, self.per_square * squares]);
        let mut kept = Vec::new();
        while !self.is_met() && self.maps < MAPS && self.driver.work.get() > 0 {
            let Some(square) = scales.next() else {
                break;
            };
            self.scale(square)?;
            let solved = self.driver.at_hand().solve(mesh)?;
            self.maps += 1;
            let count = self.per_square * area(mesh, &solved.map);
            if std::env::var("RC").is_ok() { eprintln!("  x {square:.6} count {count:.2}"); }
            scales.add([square, count]);
            match self.off(count) <= TOLERANCE * self.asked {
                true => self.extract(solved)?,
                false => kept.push((square, count, solved)),
            }
        }
        kept.sort_by(|a, b| self.off(a.1).total_cmp(&self.off(b.1)));
        for (square, count, solved) in kept {
            if self.off(count) < self.off_at_best() {
                self.scale(square)?;
                self.extract(solved)?;
            }
        }
        Ok(())
    }

    /// By how many quads a number misses what was asked for.
    fn off(&self, count: f64) -> f64 {
        (count - self.asked).abs()
    }

    fn off_at_best(&self) -> f64 {
        self.off(self.best.quads.quads.len() as f64)
    }

    fn is_met(&self) -> bool {
        self.off_at_best() <= TOLERANCE * self.asked
    }

    /// Changes the field's problem to a scale by its square.
    fn scale(&mut self, square: f64) -> Result<()> {
        let factor = (square / self.square).sqrt();
        self.square = square;
        self.driver.at_hand().scale(factor)
    }

    /// The quads of a map, which are kept if there are fewer too many or too few of them, and they are as
    /// whole.
    fn extract(&mut self, solved: Solved) -> Result<()> {
        if self.extractions == EXTRACTIONS {
            return Ok(());
        }
        self.extractions += 1;
        self.driver.at_hand().put(solved);
        let mut found = self.driver.as_solved()?;
        if !found.outcome.is_whole()
            && self.driver.may_untangle()
            && let Some(untangled) = self.driver.attempt(Try::Untangled, &found)?
            && untangled.outcome < found.outcome
        {
            found = untangled;
        }
        if std::env::var("RC").is_ok() { eprintln!("  extracted {} {:?} best {:?}", found.quads.quads.len(), found.outcome, self.best.outcome); }
        let is_nearer = self.off(found.quads.quads.len() as f64) < self.off_at_best();
        if is_nearer && found.outcome.is_as_whole_as(&self.best.outcome) {
            self.best = found;
        }
        Ok(())
    }
}
