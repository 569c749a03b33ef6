//! The number of quads that was asked for, met.
//!
//! A map without folds covers as many unit squares as it has quads, and scaling its gradients scales its
//! relaxation: the number of quads is nearly proportional to the square of the scale, in the steps that the
//! integers allow. So the map of the field that the quads follow is solved for again at other scales, until
//! as many unit squares are covered as quads were asked for. Where few are missing, one more
//! [strip](super::strips) of as many quads is asked for. Where the step between two scales is too large, sizes that
//! change a little along an axis make other integers change first. Only linear terms change, and the solver keeps
//! its factors. Quads are extracted from the maps that promise a better number, and the nearest
//! number whose quads are as whole as those at first is kept. None of these maps is untangled for longer than the
//! first was.

use super::aim::area;
use super::attempt::Attempt;
use super::driver::{Driver, Try};
use super::fields::field_count;
use super::final_error::is_final;
use super::map_solver::Solved;
use super::strips::Strips;
use crate::error::Result;
use crate::map::{SeamlessProblem, Sizing};
use crate::mesh::TriangleMesh;
use crate::monitor::{Monitor, optional};
use crate::search::table::words;

words! {
    /// How nearly a number of quads is met.
    #[derive(Debug, Clone, Copy, PartialEq, Eq)]
    pub enum Count {
        Exact = "exact": "Within one in a hundred, or as near as a few maps of other sizes come.",
        About = "about": "As the map has it that covers as many unit squares before its integers are decided.",
    }
}

/// The part of a number of quads by which it may be missed.
const TOLERANCE: f64 = 0.01;

/// The same for a strip: its number of quads is known nearly as well.
const TOLERANCE_OF_STRIPS: f64 = 0.009;

/// The most maps of other sizes for one field that was tried: each takes a sixth of the time of a run at most.
const MAPS: usize = 3;

/// The most maps of other sizes, one more for each further field.
const MOST_MAPS: usize = 6;

/// Of maps with more integers than this fewer are made, in inverse proportion: each takes long.
const MANY_INTEGERS: usize = 200;

/// The most of them whose quads are extracted.
const EXTRACTIONS: usize = 3;

/// How many quads there are for each further repair that their number is worth.
const QUADS_PER_REPAIR: usize = 100;

/// The part of a number of quads that one strip may add.
const MOST_OF_STRIP: f64 = 0.03;

/// By what part sizes change from the middle of the bounding box to both ends of an axis. What changed from one
/// end to the other would cancel out around symmetric shapes.
const BULGE: f64 = 0.15;

/// The square of a scale, and the number of quads there.
type Step = [f64; 2];

/// The scales between which the number of quads passes the one that was asked for.
struct Scales {
    asked: f64,
    below: Option<Step>,
    above: Option<Step>,
    /// How many steps in a row ended on the same side.
    streak: i32,
    /// Whether the last step has the integers of a known one, with scales on both sides.
    is_stuck: bool,
}

impl Scales {
    fn new(asked: f64, first: Step) -> Self {
        let mut scales = Scales {
            asked,
            below: None,
            above: None,
            streak: 0,
            is_stuck: false,
        };
        scales.add(first);
        scales
    }

    /// Notes the number of quads at a scale.
    fn add(&mut self, step: Step) {
        let is_below = step[1] < self.asked;
        let (side, other) = match is_below {
            true => (&mut self.below, self.above),
            false => (&mut self.above, self.below),
        };
        let has_same_number = side.is_some_and(|known| (known[1] - step[1]).abs() < 0.5);
        self.is_stuck = has_same_number && other.is_some();
        *side = Some(step);
        self.streak = match is_below {
            true => self.streak.min(0) - 1,
            false => self.streak.max(0) + 1,
        };
    }

    /// The square of the next scale: by a line between the two sides, or in the middle where lines keep ending
    /// on one side. With one side alone, numbers are taken to be in proportion to squares, and steps become
    /// longer.
    fn next(&self) -> f64 {
        let known = self.below.or(self.above).unwrap_or([1.0, self.asked]);
        match (self.below, self.above) {
            (Some([low, fewer]), Some([high, more])) => {
                let share = match self.streak.abs() {
                    1 => ((self.asked - fewer) / (more - fewer)).clamp(0.1, 0.9),
                    _ => 0.5,
                };
                low + share * (high - low)
            }
            _ => {
                let ratio = (self.asked / known[1].max(1.0)).clamp(0.5, 2.0);
                known[0] * ratio.powi(self.streak.abs())
            }
        }
    }
}

/// Lengths of a map, as multiples of those at first.
#[derive(Debug, Clone, Copy)]
struct Size {
    scale: f64,
    /// The axis of the bounding box at both ends of which lengths are larger, and smaller between them.
    axis: Option<usize>,
}

impl Size {
    /// The sizes at first.
    const FIRST: Size = Size {
        scale: 1.0,
        axis: None,
    };

    /// The factors of both lengths in every face.
    fn factors(self, mesh: &TriangleMesh) -> Vec<[f64; 2]> {
        let [low, high] = mesh.bounding_box();
        let of_face = |face: usize| match self.axis {
            Some(axis) if high[axis] > low[axis] => {
                let corners = mesh.corners(face).map(|v| mesh.position(v)[axis]);
                let middle = corners.iter().sum::<f64>() / 3.0;
                let from_middle = 2.0 * (middle - low[axis]) / (high[axis] - low[axis]) - 1.0;
                [self.scale * (1.0 + BULGE * (from_middle * from_middle - 1.0 / 3.0)); 2]
            }
            _ => [self.scale; 2],
        };
        (0..mesh.face_count()).map(of_face).collect()
    }
}

/// A map that is known, and the number of quads that it promises.
struct Known {
    count: f64,
    size: Size,
    solved: Solved,
    /// Whether one of its strips was doubled.
    is_used: bool,
}

/// The search for the number of quads.
struct Meeting<'d, 'a, M> {
    driver: &'d mut Driver<'a, M>,
    asked: f64,
    best: Attempt,
    /// Quads a unit square: what repairs add and boundaries that no line follows take.
    per_square: f64,
    /// The problem at first.
    problem: SeamlessProblem,
    /// The sizes of the best quads.
    of_best: Size,
    known: Vec<Known>,
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
    let (mesh, monitor) = (driver.mesh, driver.monitor);
    driver.most_visits = best.map.visited.max(mesh.face_count());
    let mut meeting = Meeting {
        asked: asked as f64,
        per_square: best.quads.quads.len() as f64 / area(mesh, &best.map.map),
        problem: driver.at_hand().maps.problem().clone(),
        driver,
        best,
        of_best: Size::FIRST,
        known: Vec::new(),
        maps: 0,
        extractions: 0,
    };
    match optional(monitor, || meeting.search()) {
        Err(error) if is_final(&error) => return Err(error),
        // The quads that there are remain.
        _ => {}
    }
    // Other strategies are compared by the problem of the best.
    if !meeting.driver.options.compare.is_empty() {
        meeting.size(meeting.of_best)?;
    }
    Ok((meeting.best, meeting.maps))
}

impl<'m, M: Fn() -> Monitor<'m>> Meeting<'_, '_, M> {
    fn search(&mut self) -> Result<()> {
        let mesh = self.driver.mesh;
        let first = self.driver.at_hand().at_hand();
        let mut scales = Scales::new(self.asked, [1.0, self.count(&first)]);
        self.known.push(Known {
            count: self.count(&first),
            size: Size::FIRST,
            solved: first,
            is_used: false,
        });
        let fields = field_count(mesh, self.driver.options);
        let integers = self.best.solution.counts().reduced_integers;
        let most = match integers <= MANY_INTEGERS {
            true => (MAPS + fields - 1).min(MOST_MAPS),
            false => (MAPS * MANY_INTEGERS / integers).max(1),
        };
        let mut axes = 0..3;
        while !self.is_met() && self.maps < most && self.driver.work.get() > 0 {
            if self.add_strip()? {
                continue;
            }
            let square = scales.next();
            let size = Size {
                scale: square.sqrt(),
                axis: match scales.is_stuck {
                    true => axes.next(),
                    false => None,
                },
            };
            self.size(size)?;
            let solved = self.driver.at_hand().solve(mesh)?;
            if size.axis.is_none() {
                scales.add([square, self.count(&solved)]);
            }
            self.meet(size, solved)?;
        }
        let mut known = std::mem::take(&mut self.known);
        known.sort_by(|a, b| self.off(a.count).total_cmp(&self.off(b.count)));
        for Known {
            count,
            size,
            solved,
            ..
        } in known
        {
            // Areas are rounded; integers that are known are not tried again.
            if self.off(count) + 0.5 < self.off_at_best() {
                self.size(size)?;
                self.extract(size, solved)?;
            }
        }
        Ok(())
    }

    /// Solves for a map with the integers of a known one but for one more strip; `false` if no strip has as many quads
    /// as are missing.
    fn add_strip(&mut self) -> Result<bool> {
        let mesh = self.driver.mesh;
        for number in 0..self.known.len() {
            let known = &mut self.known[number];
            let missing = self.asked - known.count;
            let is_near = missing > 0.0 && missing <= MOST_OF_STRIP * self.asked;
            if !is_near || std::mem::replace(&mut known.is_used, true) {
                continue;
            }
            let strips = Strips::new(mesh, &known.solved.map)?;
            let tolerance = TOLERANCE_OF_STRIPS * self.asked / self.per_square;
            let Some(strip) = strips.of_quads(missing / self.per_square, tolerance) else {
                continue;
            };
            let size = known.size;
            let mut factors = size.factors(mesh);
            strips.stretch(strip, &mut factors);
            let at_hand = self.driver.at_hand();
            at_hand.size(mesh, &self.problem, &factors)?;
            at_hand.solve(mesh)?;
            self.size(size)?;
            let solved = self.driver.at_hand().keep_integers()?;
            self.meet(size, solved)?;
            return Ok(true);
        }
        Ok(false)
    }

    /// Extracts the quads of a map of the size that there is if their number is met, and keeps it for later if not.
    fn meet(&mut self, size: Size, solved: Solved) -> Result<()> {
        self.maps += 1;
        self.driver.spend(&solved.solution);
        let count = self.count(&solved);
        if self.off(count) <= TOLERANCE * self.asked {
            return self.extract(size, solved);
        }
        self.known.push(Known {
            count,
            size,
            solved,
            is_used: false,
        });
        Ok(())
    }

    /// How many quads a map promises.
    fn count(&self, solved: &Solved) -> f64 {
        self.per_square * area(self.driver.mesh, &solved.map)
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

    /// Changes to the problem of other sizes.
    fn size(&mut self, size: Size) -> Result<()> {
        let mesh = self.driver.mesh;
        let factors = size.factors(mesh);
        self.driver.at_hand().size(mesh, &self.problem, &factors)
    }

    /// The quads of a map of the size that there is, which are kept if their number is nearer and they are as whole
    /// as the best.
    fn extract(&mut self, size: Size, solved: Solved) -> Result<()> {
        if self.extractions == EXTRACTIONS {
            return Ok(());
        }
        self.extractions += 1;
        self.driver.at_hand().put(solved);
        let mut found = self.driver.as_solved()?;
        let is_whole = |found: &Attempt, best: &Attempt| {
            let more = best.quads.quads.len() / QUADS_PER_REPAIR;
            found.outcome.is_as_whole_as(&best.outcome, more)
        };
        if !is_whole(&found, &self.best)
            && self.driver.may_untangle()
            && let Some(untangled) = self.driver.attempt(Try::Untangled, &found)?
            && untangled.outcome < found.outcome
        {
            found = untangled;
        }
        let is_nearer = self.off(found.quads.quads.len() as f64) < self.off_at_best();
        if is_nearer && is_whole(&found, &self.best) {
            self.best = found;
            self.of_best = size;
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The number of steps until a step function is within 1 % of what is asked for.
    fn steps(asked: f64, of: impl Fn(f64) -> f64) -> Option<usize> {
        let mut scales = Scales::new(asked, [1.0, of(1.0)]);
        (0..=MOST_MAPS).find(|_| {
            let square = scales.next();
            let count = of(square);
            scales.add([square, count]);
            (count - asked).abs() <= TOLERANCE * asked
        })
    }

    #[test]
    fn numbers_in_proportion_are_met_at_once_and_others_soon() {
        for asked in [500.0, 900.0, 1000.0, 1100.0, 1900.0] {
            assert_eq!(steps(asked, |square| 1000.0 * square), Some(0));
            assert!(steps(asked, |square| (980.0 * square.powf(1.3)).floor()).is_some());
        }
        // Steps of nine that lag behind.
        assert!(
            steps(1000.0, |square| 9.0
                * ((950.0 * square - 30.0) / 9.0).floor())
            .is_some()
        );
    }

    #[test]
    fn a_step_over_what_is_asked_for_is_noticed() {
        let of = |square: f64| if square < 1.07 { 726.0 } else { 864.0 };
        let mut scales = Scales::new(800.0, [1.0, of(1.0)]);
        let mut tried = Vec::new();
        while !scales.is_stuck && tried.len() < 9 {
            let square = scales.next();
            scales.add([square, of(square)]);
            tried.push(square);
        }
        assert!(scales.is_stuck && tried.len() <= 3, "{tried:?}");
        let (below, above) = (scales.below.unwrap(), scales.above.unwrap());
        assert!(below[0] < 1.07 && 1.07 <= above[0]);
    }
}
