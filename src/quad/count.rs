//! The number of quads that was asked for.
//!
//! The map of so many unit squares seldom has as many quads once its integers are decided. Its area is their
//! number, so the scale of the map is changed and its integers are decided anew until the area is right: that
//! needs neither another field nor another factor. The number jumps where an integer changes, so it is searched
//! for between scales that give too few and too many.

/// How far from the number that was asked for is near enough: 1 percent.
const TOLERANCE: f64 = 0.01;

/// The most scales that are tried.
const SCALES: usize = 6;

/// A search for the scale of a map, relative to the first, at which it has the area that is wanted.
pub(super) struct ScaleSearch {
    wanted: f64,
    /// The logarithms of the largest scale of too small an area and of the smallest of too large a one, with those of the
    /// areas over the wanted one.
    below: Option<[f64; 2]>,
    above: Option<[f64; 2]>,
    tried: usize,
}

impl ScaleSearch {
    pub(super) fn new(wanted: usize) -> Self {
        ScaleSearch {
            wanted: wanted.max(1) as f64,
            below: None,
            above: None,
            tried: 0,
        }
    }

    /// How far this many quads are from those that are wanted, as a part of them.
    pub(super) fn error(&self, quads: f64) -> f64 {
        (quads / self.wanted - 1.0).abs()
    }

    /// Whether this many are near enough.
    pub(super) fn is_met(&self, quads: f64) -> bool {
        self.error(quads) <= TOLERANCE
    }

    /// Notes the area at a scale, and gives the next scale to try. `None` if there is none.
    pub(super) fn next(&mut self, scale: f64, area: f64) -> Option<f64> {
        let found = [scale.ln(), (area / self.wanted).ln()];
        if !found[1].is_finite() || self.tried == SCALES {
            return None;
        }
        self.tried += 1;
        let side = match found[1] < 0.0 {
            true => &mut self.below,
            false => &mut self.above,
        };
        *side = Some(found);
        let next = match (self.below, self.above) {
            (Some([low, few]), Some([high, many])) if low < high => {
                // The area jumps: where the secant is near an end, it is the middle that tells more.
                let part = (-few / (many - few)).clamp(0.2, 0.8);
                low + part * (high - low)
            }
            // The area grows with the square of the scale.
            _ => found[0] - 0.5 * found[1],
        };
        (next != found[0]).then(|| next.exp())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The number of tries until an area is met, or none.
    fn tries(wanted: usize, first: f64, area: impl Fn(f64) -> f64) -> Option<usize> {
        let mut search = ScaleSearch::new(wanted);
        let (mut scale, mut found) = (1.0, first);
        for count in 0..=SCALES {
            if search.is_met(found) {
                return Some(count);
            }
            scale = search.next(scale, found)?;
            found = area(scale);
        }
        None
    }

    #[test]
    fn an_area_that_grows_with_the_square_is_met_at_once() {
        assert_eq!(tries(1000, 700.0, |s| 700.0 * s * s), Some(1));
        assert_eq!(tries(1000, 1005.0, |s| s), Some(0));
    }

    #[test]
    fn an_area_that_jumps_is_met_where_a_step_is_near_enough() {
        let steps = |s: f64| (28.0 * s).round() * (33.0 * s).round();
        assert!(tries(1000, steps(1.0), steps).is_some());
    }

    #[test]
    fn a_search_ends_where_no_step_is_near_enough() {
        let steps = |s: f64| if s < 1.05 { 10.0 } else { 40.0 };
        assert_eq!(tries(20, 10.0, steps), None);
        assert_eq!(tries(20, 0.0, |_| 0.0), None);
    }
}
