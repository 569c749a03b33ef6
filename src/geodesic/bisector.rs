//! Which of two windows is nearer, over an interval that both cover.

use super::window::Window;

/// The nearer of two windows over an interval: one of them, up to a first place, then the other, and up to a
/// second place, then the first again.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Nearer {
    /// Whether the first window is nearer at the start.
    pub(super) first: bool,
    /// Where the nearer window changes: within the interval, in order; infinite where it does not.
    pub(super) changes: [f64; 2],
}

const NEVER: [f64; 2] = [f64::INFINITY; 2];

/// Compares two windows on `[from, to]`.
///
/// The difference of their distances has one extremum on the line of the edge, where that line meets the line
/// through both images. So there are at most two changes.
pub(super) fn nearer(one: &Window, two: &Window, from: f64, to: f64) -> Nearer {
    match one.is_line || two.is_line {
        true => nearer_of_any(one, two, from, to),
        false => nearer_of_points(one, two, from, to),
    }
}

/// By the places where distances are equal, and which window is nearer between them.
fn nearer_of_points(one: &Window, two: &Window, from: f64, to: f64) -> Nearer {
    let middle = 0.5 * (from + to);
    let (difference, places) = equal_distances(one, two, middle);
    if is_tie(one, two, difference, from, to) {
        return Nearer {
            first: true,
            changes: NEVER,
        };
    }
    let inside = places.map(|t| if from < t && t < to { t } else { f64::INFINITY });
    let passed = places.iter().filter(|t| from < **t && **t < middle).count();
    let [a, b] = inside;
    Nearer {
        first: (difference <= 0.0) == passed.is_multiple_of(2),
        changes: if b < a { [b, a] } else { [a, b] },
    }
}

/// Whether two windows are equally near on an interval, up to rounding, by the difference of their distances in its
/// middle. Rounding would cut them into ever more pieces.
fn is_tie(one: &Window, two: &Window, difference: f64, from: f64, to: f64) -> bool {
    let middle = 0.5 * (from + to);
    let noise = NOISE * (one.s - one.y);
    if difference.abs() > noise {
        return false;
    }
    let slope = |w: &Window| {
        let along = middle - w.x;
        along / (along * along + w.y * w.y).sqrt()
    };
    (slope(one) - slope(two)).abs() * (to - from) <= noise
}

/// The share of a distance that rounding may change.
const NOISE: f64 = 1e-15;

/// By the signs of the difference of distances at the ends and at its extremum.
fn nearer_of_any(one: &Window, two: &Window, from: f64, to: f64) -> Nearer {
    let difference = |t: f64| one.at(t) - two.at(t);
    let ends = [difference(from), difference(to)];
    let first = ends[0] < 0.0 || ends[0] == 0.0 && ends[1] <= 0.0;
    if ends[0] * ends[1] < 0.0 {
        let change = zero(difference, [from, to], ends);
        return Nearer {
            first,
            changes: [change, f64::INFINITY],
        };
    }
    if let Some(middle) = extremum(one, two).filter(|t| from < *t && *t < to) {
        let value = difference(middle);
        if first && value > 0.0 || !first && value < 0.0 {
            let changes = [
                zero(difference, [from, middle], [ends[0], value]),
                zero(difference, [middle, to], [value, ends[1]]),
            ];
            return Nearer { first, changes };
        }
    }
    Nearer {
        first,
        changes: NEVER,
    }
}

/// Where the difference of distances from a segment and a point, or of two segments, is extreme: where the lines of
/// both are parallel.
fn extremum(one: &Window, two: &Window) -> Option<f64> {
    let (line, point) = match (one.is_line, two.is_line) {
        (true, true) => return None,
        (true, false) => (one, two),
        _ => (two, one),
    };
    let t = point.x + line.x * (point.y / line.y);
    t.is_finite().then_some(t)
}

/// The difference of the distances from two points with offsets at `middle`, and the places of the line of the
/// edge where there is none, in closed form; NaN where there are fewer.
///
/// With t counted from `middle`, r the distances of the images from there, D the difference of the distances with
/// offsets, k the difference of the offsets, d = x1 - x2 and w = D (r1 + r2 + k) + 2 k r2, squaring
/// r1(t) = r2(t) + k twice gives (d^2 - k^2) t^2 - (d w - 2 k^2 x2) t + (w^2 - 4 k^2 r2^2) / 4 = 0. Written as below,
/// neither the discriminant nor the last coefficient loses digits to cancellation. Squaring adds solutions with
/// w - 2 d t = -2 k r2(t): one of both if |d| > |k|; else none or both, by the sign of k (w - 2 d x2).
fn equal_distances(one: &Window, two: &Window, middle: f64) -> (f64, [f64; 2]) {
    let (x1, x2) = (one.x - middle, two.x - middle);
    let r1 = (x1 * x1 + one.y * one.y).sqrt();
    let r2 = (x2 * x2 + two.y * two.y).sqrt();
    let k = two.s - one.s;
    let d = x1 - x2;
    let difference = (r1 - r2) - k;
    let scaled = difference * (r1 + r2 + k);
    let w = scaled + 2.0 * k * r2;
    let square = (d - k) * (d + k);
    let half = k * k * x2 - 0.5 * d * w;
    let constant = 0.25 * scaled * (scaled + 4.0 * k * r2);
    let to_axis = w - 2.0 * d * x2;
    let inner = to_axis * to_axis + 4.0 * square * two.y * two.y;
    let root = 0.5 * k * inner.sqrt();
    let place = |here: f64, there: f64| match here.abs() > there.abs() {
        true => middle + here / square,
        false => middle + constant / there,
    };
    let (plus, minus) = (root - half, -root - half);
    let places = if square >= 0.0 {
        match d > 0.0 {
            true => [place(minus, plus), f64::NAN],
            false => [place(plus, minus), f64::NAN],
        }
    } else if inner >= 0.0 && k * to_axis >= 0.0 {
        [place(plus, minus), place(minus, plus)]
    } else {
        [f64::NAN; 2]
    };
    (difference, places)
}

/// The zero of a function whose values at two places have opposite signs, by false position (Illinois).
fn zero(f: impl Fn(f64) -> f64, [mut a, mut b]: [f64; 2], [mut fa, mut fb]: [f64; 2]) -> f64 {
    let tolerance = 1e-15 * a.abs().max(b.abs());
    for _ in 0..60 {
        let t = (a * fb - b * fa) / (fb - fa);
        if !(a < t && t < b) || b - a <= tolerance {
            break;
        }
        let value = f(t);
        if value == 0.0 {
            return t;
        }
        if (value < 0.0) == (fa < 0.0) {
            (a, fa) = (t, value);
            fb *= 0.5;
        } else {
            (b, fb) = (t, value);
            fa *= 0.5;
        }
    }
    if fa.abs() < fb.abs() { a } else { b }
}
