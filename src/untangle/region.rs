//! Regions that may move: everything within a number of rings around folded faces.
//!
//! A fold only affects its neighbourhood, and a small system is cheap. Regions that touch are merged.

use super::freedom::Freedom;

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
