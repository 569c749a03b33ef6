//! Axes: from numbers to pixels, and where the ticks are.

/// One axis of a plot.
#[derive(Debug, Clone, PartialEq)]
pub struct Scale {
    from: f64,
    to: f64,
    is_log: bool,
    pixels: [f64; 2],
}

impl Scale {
    /// A logarithmic axis around these positive values, from the power of ten (or its double or
    /// fivefold) below to that above.
    pub fn log(values: impl Iterator<Item = f64>, pixels: [f64; 2]) -> Self {
        let [low, high] = extent(values.filter(|&v| v > 0.0), [0.1, 10.0]);
        let mut scale = Scale {
            from: round_down(low),
            to: round_up(high),
            is_log: true,
            pixels,
        };
        if scale.from >= scale.to {
            scale.to = 10.0 * scale.from;
        }
        scale
    }

    /// A linear axis around these values.
    pub fn linear(values: impl Iterator<Item = f64>, pixels: [f64; 2]) -> Self {
        let [low, high] = extent(values, [0.0, 1.0]);
        let margin = if high > low { 0.08 * (high - low) } else { 0.5 };
        Scale {
            from: low - margin,
            to: high + margin,
            is_log: false,
            pixels,
        }
    }

    /// The pixel of a value.
    pub fn pixel(&self, value: f64) -> f64 {
        let place = match self.is_log {
            true => (value / self.from).ln() / (self.to / self.from).ln(),
            false => (value - self.from) / (self.to - self.from),
        };
        self.pixels[0] + place * (self.pixels[1] - self.pixels[0])
    }

    /// Round values within the axis: powers of ten, or steps of 1, 2 or 5.
    pub fn ticks(&self) -> Vec<f64> {
        if self.is_log {
            let decades = (self.to / self.from).log10();
            let first = self.from.log10().floor() as i32;
            let last = self.to.log10().ceil() as i32;
            let factors: &[f64] = if decades < 1.5 {
                &[1.0, 2.0, 5.0]
            } else {
                &[1.0]
            };
            let all = (first..=last).flat_map(|d| factors.iter().map(move |f| f * 10f64.powi(d)));
            let slack = 1.0 + 1e-9;
            return all
                .filter(|t| (self.from / slack..=self.to * slack).contains(t))
                .collect();
        }
        let step = round_up((self.to - self.from) / 6.0);
        let first = (self.from / step).ceil() as i64;
        let last = (self.to / step).floor() as i64;
        (first..=last).map(|k| k as f64 * step).collect()
    }
}

fn extent(values: impl Iterator<Item = f64>, none: [f64; 2]) -> [f64; 2] {
    let start = [f64::INFINITY, f64::NEG_INFINITY];
    let found = values.fold(start, |[low, high], v| [low.min(v), high.max(v)]);
    if found[0] <= found[1] { found } else { none }
}

/// The greatest 1, 2 or 5 times a power of ten that is not above.
fn round_down(value: f64) -> f64 {
    let power = 10f64.powf(value.log10().floor());
    let fits = |f: &f64| f * power <= value * (1.0 + 1e-12);
    [5.0, 2.0, 1.0].into_iter().find(fits).unwrap_or(1.0) * power
}

/// The least 1, 2 or 5 times a power of ten that is not below.
fn round_up(value: f64) -> f64 {
    let power = 10f64.powf(value.log10().floor());
    let fits = |f: &f64| f * power >= value * (1.0 - 1e-12);
    [1.0, 2.0, 5.0].into_iter().find(fits).unwrap_or(10.0) * power
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn values_fall_between_the_ends_in_their_order() {
        let values = [0.003, 0.4, 7.0, 800.0];
        for scale in [
            Scale::log(values.into_iter(), [0.0, 100.0]),
            Scale::linear(values.into_iter(), [0.0, 100.0]),
        ] {
            let pixels = values.map(|v| scale.pixel(v));
            assert!(pixels.is_sorted() && pixels[0] >= 0.0 && pixels[3] <= 100.0);
            assert!(scale.ticks().len() > 2 && scale.ticks().is_sorted());
        }
    }

    #[test]
    fn one_value_and_none_have_axes_too() {
        for values in [vec![], vec![1.0], vec![3.0, 3.0]] {
            for scale in [
                Scale::log(values.iter().copied(), [0.0, 1.0]),
                Scale::linear(values.iter().copied(), [0.0, 1.0]),
            ] {
                assert!(scale.pixel(3.0).is_finite() && !scale.ticks().is_empty());
            }
        }
    }
}
