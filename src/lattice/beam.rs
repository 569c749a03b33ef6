//! Beam search: nearest plane that keeps the best `width` partial points instead of one.
//!
//! This is the K-best decoder of communication theory (`guo2006`, section III). It works level by level
//! from the last coordinate to the first. On each level, all partial points are extended by their nearest
//! integers, and the `width` extensions with the least distances are kept. With width 1 this is nearest
//! plane. The work is `width * m^2 / 2` multiplications for every lattice.

use std::cmp::Ordering;
use std::collections::BinaryHeap;

use super::{Basis, Target};

/// A partial point: its coordinates from some level on.
#[derive(Clone)]
struct Beginning {
    distance: f64,
    z: Vec<i64>,
    /// The contribution of the decided coordinates to each row above.
    settled: Vec<f64>,
}

/// The nearest integer of a partial point at the next level that has not been used yet.
struct Extension {
    distance: f64,
    parent: usize,
    z: f64,
    step: f64,
}

impl Ord for Extension {
    /// The heap returns its greatest element first: the least distance, and among equal distances the first
    /// parent.
    fn cmp(&self, other: &Self) -> Ordering {
        let by_distance = other.distance.total_cmp(&self.distance);
        by_distance.then(other.parent.cmp(&self.parent))
    }
}

impl PartialOrd for Extension {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

impl PartialEq for Extension {
    fn eq(&self, other: &Self) -> bool {
        self.cmp(other) == Ordering::Equal
    }
}

impl Eq for Extension {}

/// The steps from the whole part of `target` to the best point of a beam search of this `width`. None if
/// `stop` ends the search. It is called once a level, with the multiplications since its last call.
pub fn beam(
    basis: &Basis,
    target: &Target,
    width: usize,
    stop: &mut dyn FnMut(u64) -> bool,
) -> Option<Vec<i64>> {
    let m = basis.rank();
    let mut beginnings = vec![Beginning {
        distance: 0.0,
        z: vec![0; m],
        settled: vec![0.0; m],
    }];
    for k in (0..m).rev() {
        if stop((beginnings.len() * k) as u64) {
            return None;
        }
        let pivot = basis.r(k, k);
        let centre = |b: &Beginning| target.rest[k] + b.settled[k] / pivot;
        let extension = |parent: usize, z: f64, step: f64| {
            let b: &Beginning = &beginnings[parent];
            Extension {
                distance: b.distance + ((centre(b) - z) * pivot).powi(2),
                parent,
                z,
                step,
            }
        };
        let mut heap: BinaryHeap<Extension> = (0..beginnings.len())
            .map(|parent| {
                let c = centre(&beginnings[parent]);
                let z = c.round();
                extension(parent, z, if c < z { -1.0 } else { 1.0 })
            })
            .collect();
        let mut kept = Vec::with_capacity(width);
        while kept.len() < width {
            let Some(best) = heap.pop() else { break };
            let next = best.z + best.step;
            heap.push(extension(
                best.parent,
                next,
                -best.step - best.step.signum(),
            ));
            kept.push(best);
        }
        let column = basis.column(k);
        beginnings = kept
            .into_iter()
            .map(|e| {
                let mut b = beginnings[e.parent].clone();
                b.distance = e.distance;
                b.z[k] = e.z as i64;
                b.settled.truncate(k);
                let offset = target.rest[k] - e.z;
                for (s, r) in b.settled.iter_mut().zip(column) {
                    *s += r * offset;
                }
                b
            })
            .collect();
    }
    beginnings.into_iter().next().map(|b| b.z)
}
