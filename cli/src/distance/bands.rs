//! Distances as colours: bands of equal width, from warm to cold.

use roundel::geodesic::GeodesicDistance;

/// The number of bands up to the largest distance.
const BANDS: f64 = 24.0;

/// The colours at distance 0, halfway and at the largest distance.
const SCALE: [[f64; 3]; 3] = [
    [178.0, 24.0, 43.0],
    [246.0, 239.0, 226.0],
    [33.0, 102.0, 172.0],
];

/// The colour of what is not reached.
const NOT_REACHED: [u8; 3] = [128, 128, 128];

/// The width of a band.
pub fn width(found: &GeodesicDistance) -> f64 {
    match found.farthest().1 {
        0.0 => 1.0,
        largest => largest / BANDS,
    }
}

/// The colour of a distance.
pub fn color(found: &GeodesicDistance, distance: f64) -> [u8; 3] {
    match distance.is_finite() {
        true => of_share(distance / (BANDS * width(found))),
        false => NOT_REACHED,
    }
}

fn of_share(share: f64) -> [u8; 3] {
    let place = 2.0 * share.clamp(0.0, 1.0);
    let (low, high) = if place < 1.0 { (0, 1) } else { (1, 2) };
    let part = place - low as f64;
    // Every second band is darker.
    let is_dark = (share * BANDS) as usize % 2 == 1;
    let light = if is_dark { 0.85 } else { 1.0 };
    let mixed = |k: usize| SCALE[low][k] + part * (SCALE[high][k] - SCALE[low][k]);
    [0, 1, 2].map(|k| (light * mixed(k)).round() as u8)
}

#[cfg(test)]
mod tests {
    use super::of_share;

    #[test]
    fn the_scale_runs_from_red_to_blue() {
        assert_eq!(of_share(0.0), [178, 24, 43]);
        assert_eq!(of_share(1.0), [33, 102, 172]);
        let [near, far] = [0.01, 0.05].map(of_share);
        assert!(near[0] > far[0], "bands differ in lightness");
    }
}
