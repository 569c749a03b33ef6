//! Density painted as a colour.

/// How dense quads are where the surface is painted in this colour, red, green and blue from 0 to 1, as a factor of the
/// number of edges along a length: `2^s` with `s = red - (green + blue) / 2`.
///
/// Red doubles the edges along a length, and so has four times as many quads an area; cyan halves them, and has a
/// quarter; white, grey and black are neutral, and a colour between has a factor between. Numbers beyond 0 and 1 count
/// as these.
pub fn density_of_color(color: [f64; 3]) -> f64 {
    let [red, green, blue] = color.map(|x| x.clamp(0.0, 1.0));
    (red - 0.5 * (green + blue)).exp2()
}

#[cfg(test)]
mod tests {
    use super::density_of_color;

    #[test]
    fn red_is_dense_and_cyan_is_coarse() {
        for (color, factor) in [
            ([1.0, 0.0, 0.0], 2.0),
            ([0.0, 1.0, 1.0], 0.5),
            ([1.0, 1.0, 1.0], 1.0),
            ([0.3, 0.3, 0.3], 1.0),
            ([0.0, 0.0, 0.0], 1.0),
            ([1.0, 0.5, 0.5], 2f64.sqrt()),
            ([0.0, 0.0, 1.0], 0.5f64.sqrt()),
            ([7.0, -1.0, 0.0], 2.0),
        ] {
            let found = density_of_color(color);
            assert!((found - factor).abs() < 1e-15, "{color:?}: {found}");
        }
    }
}
