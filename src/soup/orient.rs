//! Step 6: all triangles of a component run alike.
//!
//! A breadth-first search over the paired edges gives every component its two directions; the one that
//! turns fewer triangles is taken, and the lowest triangle's if both turn as many. Where two paths to a
//! triangle disagree, as on a Moebius band, the edge at which they meet is cut. A component that closes and
//! in which a triangle was turned is turned outwards, which its volume decides; one that ran alike as given
//! stays, because it may be the wall of a cavity.

use super::lists::NONE;
use super::surface::{Surface, tail};
use crate::linalg::vector::{cross, dot, sub};

/// Which triangles are turned, and what was found on the way.
pub(super) struct Orientation {
    pub(super) turned: Vec<bool>,
    /// Half-edges whose pairs were cut because both cannot run against each other.
    pub(super) cut: Vec<[u32; 2]>,
    /// Components that were turned outwards: their lowest triangle and the number of triangles.
    pub(super) outwards: Vec<[u32; 2]>,
}

/// Orients the triangles over `twin`, and removes the twins at edges that must be cut.
pub(super) fn orient(surface: &Surface, twin: &mut [u32]) -> Orientation {
    let triangles = &surface.triangles;
    let mut found = Orientation {
        turned: vec![false; triangles.len()],
        cut: Vec::new(),
        outwards: Vec::new(),
    };
    let mut seen = vec![false; triangles.len()];
    let mut queue = Vec::new();
    for seed in 0..triangles.len() {
        if seen[seed] {
            continue;
        }
        seen[seed] = true;
        queue.clear();
        queue.push(seed as u32);
        let mut at = 0;
        while let Some(&t) = queue.get(at) {
            at += 1;
            for h in 3 * t..3 * t + 3 {
                let across = twin[h as usize];
                if across == NONE {
                    continue;
                }
                let other = across as usize / 3;
                let alike = tail(triangles, h) != tail(triangles, across);
                let turn = found.turned[t as usize] == alike;
                if !seen[other] {
                    seen[other] = true;
                    found.turned[other] = turn;
                    queue.push(other as u32);
                } else if found.turned[other] != turn {
                    found.cut.push([h.min(across), h.max(across)]);
                    twin[h as usize] = NONE;
                    twin[across as usize] = NONE;
                }
            }
        }
        let turned = queue.iter().filter(|&&t| found.turned[t as usize]).count();
        if 2 * turned > queue.len() {
            turn_all(&mut found.turned, &queue);
        }
        if turned > 0 && turned < queue.len() && is_inwards(surface, twin, &found.turned, &queue) {
            turn_all(&mut found.turned, &queue);
            found.outwards.push([seed as u32, queue.len() as u32]);
        }
    }
    found
}

fn turn_all(turned: &mut [bool], component: &[u32]) {
    for &t in component {
        turned[t as usize] ^= true;
    }
}

/// Whether a component closes around a negative volume.
fn is_inwards(surface: &Surface, twin: &[u32], turned: &[bool], component: &[u32]) -> bool {
    let center = surface.corners(component[0] as usize)[0];
    let mut volume = 0.0;
    for &t in component {
        if (3 * t..3 * t + 3).any(|h| twin[h as usize] == NONE) {
            return false;
        }
        let [a, b, c] = surface.corners(t as usize).map(|p| sub(p, center));
        let part = dot(a, cross(b, c));
        volume += if turned[t as usize] { -part } else { part };
    }
    volume < 0.0
}

/// Turns the triangles that are to be turned, and renumbers the half-edges of `twin`.
pub(super) fn turn(triangles: &mut [[u32; 3]], twin: &mut Vec<u32>, turned: &[bool]) {
    for (t, triangle) in triangles.iter_mut().enumerate() {
        if turned[t] {
            triangle.swap(1, 2);
        }
    }
    let renumbered = |h: u32| match h {
        NONE => NONE,
        _ if turned[h as usize / 3] => h / 3 * 3 + (2 - h % 3),
        _ => h,
    };
    *twin = (0..twin.len() as u32)
        .map(|h| renumbered(twin[renumbered(h) as usize]))
        .collect();
}
