//! Numbers as little-endian bytes in base64: a third of the size of their digits.

use base64::Engine;
use base64::engine::general_purpose::STANDARD;
use serde::Serialize;

/// An array of a page: the kind of its numbers, and their bytes.
#[derive(Serialize)]
pub(super) struct Array {
    #[serde(rename = "type")]
    kind: &'static str,
    data: String,
}

impl Array {
    /// Of 8 bits.
    pub(super) fn bytes(numbers: &[u8]) -> Self {
        Array::new("u8", numbers.to_vec())
    }

    /// Of 16 bits if all numbers have no more, else of 32.
    pub(super) fn indices(numbers: &[u32]) -> Self {
        let narrow = numbers.iter().map(|&n| u16::try_from(n));
        match narrow.collect::<Result<Vec<u16>, _>>() {
            Ok(narrow) => Array::shorts(&narrow),
            Err(_) => Array::new(
                "u32",
                numbers.iter().flat_map(|n| n.to_le_bytes()).collect(),
            ),
        }
    }

    /// Of 16 bits.
    pub(super) fn shorts(numbers: &[u16]) -> Self {
        Array::new(
            "u16",
            numbers.iter().flat_map(|n| n.to_le_bytes()).collect(),
        )
    }

    /// In single precision.
    pub(super) fn floats(numbers: &[f32]) -> Self {
        Array::new(
            "f32",
            numbers.iter().flat_map(|x| x.to_le_bytes()).collect(),
        )
    }

    /// In double precision.
    pub(super) fn doubles(numbers: &[f64]) -> Self {
        Array::new(
            "f64",
            numbers.iter().flat_map(|x| x.to_le_bytes()).collect(),
        )
    }

    fn new(kind: &'static str, bytes: Vec<u8>) -> Self {
        let data = STANDARD.encode(bytes);
        Array { kind, data }
    }
}

/// Points on a grid of 65,536 steps along the longest side of their box.
#[derive(Serialize)]
pub(super) struct Grid {
    low: Vec<f64>,
    step: f64,
}

impl Grid {
    /// The grid of these points, and their steps on it.
    pub(super) fn of<const N: usize>(points: &[[f64; N]]) -> (Self, Array) {
        let mut low = points.first().copied().unwrap_or([0.0; N]);
        let mut high = low;
        for point in points {
            for k in 0..N {
                low[k] = low[k].min(point[k]);
                high[k] = high[k].max(point[k]);
            }
        }
        let longest = (0..N).map(|k| high[k] - low[k]).fold(0.0, f64::max);
        let step = longest / f64::from(u16::MAX);
        let on_grid = |x: f64, k: usize| match step > 0.0 {
            // The quotient is from 0 to 65,535.
            true => ((x - low[k]) / step).round() as u16,
            false => 0,
        };
        let coordinates = points.iter().flat_map(|point| point.iter().enumerate());
        let steps: Vec<u16> = coordinates.map(|(k, &x)| on_grid(x, k % N)).collect();
        let low = low.to_vec();
        (Grid { low, step }, Array::shorts(&steps))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn indices_are_as_narrow_as_they_can_be() {
        let array = Array::indices(&[1, 0xFFFF]);
        assert_eq!((array.kind, &*array.data), ("u16", "AQD//w=="));
        let array = Array::indices(&[1, 0x1_0000]);
        assert_eq!((array.kind, &*array.data), ("u32", "AQAAAAAAAQA="));
    }

    #[test]
    fn points_keep_their_place_on_a_grid() {
        let points = [[-1.0, 4.0], [3.0, 5.0], [1.0, 4.5]];
        let (grid, array) = Grid::of(&points);
        assert_eq!(grid.low, [-1.0, 4.0]);
        let bytes = STANDARD.decode(array.data).unwrap();
        let (steps, _) = bytes.as_chunks::<2>();
        for (i, &step) in steps.iter().enumerate() {
            let place = grid.low[i % 2] + grid.step * f64::from(u16::from_le_bytes(step));
            assert!((place - points[i / 2][i % 2]).abs() <= 0.5 * grid.step);
        }
        let (grid, _) = Grid::of(&[[7.0; 3]; 2]);
        assert_eq!(grid.step, 0.0);
    }
}
