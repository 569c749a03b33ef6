//! Regions that may move: everything within a number of rings around folded faces.
//!
//! A fold only affects its neighbourhood, and a small system is cheap. Regions that touch are merged.

use std::cmp::Reverse;
use std::sync::Mutex;

use super::freedom::Freedom;
use crate::error::Result;
use crate::monitor::{Monitor, span, tasks};

/// A connected set of free unknowns and all faces that they move, both increasing.
pub(super) struct Region {
    pub unknowns: Vec<u32>,
    pub faces: Vec<u32>,
}

/// The regions within `rings` of these faces (increasing), in the order of their lowest such face.
///
/// Faces that cannot move belong to no region.
pub(super) fn regions(freedom: &Freedom, folded: &[usize], rings: usize) -> Vec<Region> {
    let faces = freedom.copies.len();
    let mut is_free = vec![false; freedom.dim()];
    let mut is_near = vec![false; faces];
    let mut front = folded.to_vec();
    front.iter().for_each(|&f| is_near[f] = true);
    for _ in 0..rings {
        let mut next = Vec::new();
        for y in front.iter().flat_map(|&f| freedom.of_face(f)) {
            if !std::mem::replace(&mut is_free[y], true) {
                let far = |f: &usize| !std::mem::replace(&mut is_near[*f], true);
                next.extend(freedom.faces_of(y).filter(far));
            }
        }
        if next.is_empty() {
            break;
        }
        front = next;
    }
    let mut is_taken = vec![false; faces];
    let mut found = Vec::new();
    for &seed in folded {
        for y in freedom.of_face(seed) {
            if is_free[y] {
                found.push(connected(freedom, y, &mut is_free, &mut is_taken));
            }
        }
    }
    found
}

/// Coordinates of a region, and where they have moved to.
pub(super) struct Moved {
    pub coordinates: Vec<u32>,
    pub to: Vec<f64>,
}

impl Moved {
    pub fn put(&self, values: &mut [f64]) {
        for (&i, to) in self.coordinates.iter().zip(&self.to) {
            values[i as usize] = *to;
        }
    }
}

/// Works on regions at the same time, the largest first, and gives the results in order. Every work gets the number of
/// its region and these values of all coordinates, reads and changes none but those of its region, and leaves them as
/// they were: no two regions have a face in common.
pub(super) fn at_once<T: Send>(
    values: &[f64],
    regions: &[Region],
    monitor: &mut Monitor,
    work: impl Fn(usize, &mut [f64], &mut Monitor) -> Result<T> + Sync,
) -> Result<Vec<T>> {
    let mut order: Vec<usize> = (0..regions.len()).collect();
    order.sort_by_key(|&k| Reverse(regions[k].faces.len()));
    let copies: Mutex<Vec<Vec<f64>>> = Mutex::default();
    let done = tasks(regions.len(), monitor, |place, monitor| {
        let _span = span("region");
        let spare = copies.lock().ok().and_then(|mut copies| copies.pop());
        let mut copy = spare.unwrap_or_else(|| values.to_vec());
        let result = work(order[place], &mut copy, monitor);
        if let Ok(mut copies) = copies.lock() {
            copies.push(copy);
        }
        result
    });
    let mut done: Vec<_> = order.into_iter().zip(done).collect();
    done.sort_unstable_by_key(|(k, _)| *k);
    done.into_iter().map(|(_, result)| result).collect()
}

/// The region of a free unknown; its unknowns are removed from `is_free`.
fn connected(
    freedom: &Freedom,
    first: usize,
    is_free: &mut [bool],
    is_taken: &mut [bool],
) -> Region {
    let (mut unknowns, mut faces) = (vec![first as u32], Vec::new());
    is_free[first] = false;
    let mut next = 0;
    while let Some(&y) = unknowns.get(next) {
        next += 1;
        for face in freedom.faces_of(y as usize) {
            if std::mem::replace(&mut is_taken[face], true) {
                continue;
            }
            faces.push(face as u32);
            for other in freedom.of_face(face) {
                if std::mem::replace(&mut is_free[other], false) {
                    unknowns.push(other as u32);
                }
            }
        }
    }
    unknowns.sort_unstable();
    faces.sort_unstable();
    Region { unknowns, faces }
}

#[cfg(test)]
mod tests {
    use super::super::stiffen::tests::with_work;
    use super::*;
    use crate::monitor::{spawned, with_threads};

    #[test]
    fn regions_at_once_move_as_one_after_the_other() {
        with_work("genus-2", 80, |work, _| {
            let regions = regions(work.freedom, &work.folded(), 3);
            assert!(regions.len() > 2);
            let (values, whole) = (work.values.clone(), work.budget);
            let faces: usize = regions.iter().map(|region| region.faces.len()).sum();
            let limits = |work: &super::super::Untangling| -> Vec<usize> {
                regions
                    .iter()
                    .map(|region| work.steps_for(region))
                    .collect()
            };
            for (budget, is_enough) in [(whole, true), (12 * faces, false)] {
                let mut results = Vec::new();
                let mut undo = |group: usize, threads: usize| {
                    (work.values, work.budget, work.steps) = (values.clone(), budget, 0);
                    let before = limits(work);
                    with_threads(threads, || {
                        for some in regions.chunks(group) {
                            work.undo_folds(some, 1.0, &mut Monitor::default()).unwrap();
                        }
                    });
                    assert_eq!(limits(work) == before, is_enough);
                    results.push((work.values.clone(), work.budget, work.steps));
                };
                undo(1, 1);
                undo(regions.len(), 1);
                assert!(spawned(|| undo(regions.len(), 3)) > 0);
                assert!(results[0].0 != values && results[0].2 > 0);
                assert!(results.iter().all(|result| *result == results[0]));
            }
        });
    }

    #[test]
    fn the_largest_region_is_the_first() {
        with_work("genus-2", 80, |work, _| {
            let regions = regions(work.freedom, &work.folded(), 3);
            let begun = Mutex::new(Vec::new());
            let size = |k: usize, _: &mut [f64], _: &mut Monitor| {
                begun.lock().unwrap().push(regions[k].faces.len());
                Ok(regions[k].faces.len())
            };
            let mut monitor = Monitor::default();
            let sizes = with_threads(1, || at_once(&work.values, &regions, &mut monitor, size));
            assert!(
                sizes
                    .unwrap()
                    .into_iter()
                    .eq(regions.iter().map(|of| of.faces.len()))
            );
            let begun = begun.into_inner().unwrap();
            assert!(begun.is_sorted_by(|a, b| a >= b) && begun[0] > begun[begun.len() - 1]);
        });
    }
}
