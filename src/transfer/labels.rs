//! The label of most of the area beneath a face.

use super::samples::Sample;

/// Areas that differ by less than this part of their sum are equal.
pub(super) const TIE: f64 = 1e-9;

pub(super) fn most(samples: &[Vec<Sample>], labels: &[u32]) -> Vec<u32> {
    let of_face = |samples: &Vec<Sample>| {
        let labelled = samples.iter();
        heaviest(labelled.map(|sample| (labels[sample.triangle as usize], sample.area)))
    };
    samples.iter().map(of_face).collect()
}

/// The number with the largest sum of areas; of equal ones the lowest.
pub(super) fn heaviest(items: impl Iterator<Item = (u32, f64)>) -> u32 {
    let mut sums: Vec<(u32, f64)> = Vec::new();
    for (number, area) in items {
        match sums.iter_mut().find(|(other, _)| *other == number) {
            Some((_, sum)) => *sum += area,
            None => sums.push((number, area)),
        }
    }
    let total: f64 = sums.iter().map(|(_, sum)| sum).sum();
    let most = sums.iter().map(|(_, sum)| *sum).fold(0.0, f64::max);
    let best = sums.iter().filter(|(_, sum)| *sum >= most - TIE * total);
    // A face has samples.
    best.map(|(number, _)| *number).min().unwrap_or_default()
}
