//! Improves the worst quads one vertex at a time.
//!
//! For each corner of a poor quad a few places are tried: towards the mean of its neighbours, towards the
//! targets of its quads, and along its edges and diagonals. The corner moves to the place where the worst of
//! its quads is best, if that is an improvement.

use super::quality::scaled_jacobian;
use super::square;
use super::surface::Surface;
use crate::extract::QuadMesh;
use crate::mesh::vector::{Vec3, add, scale, sub};

/// Quads with a scaled Jacobian below this are improved.
const POOR: f64 = 0.5;

/// The most passes over all poor quads.
const ROUNDS: usize = 20;

/// Improves poor quads until no vertex moves.
pub(super) fn mend(quads: &mut QuadMesh, surface: &mut Surface) {
    let around = quads.around();
    for _ in 0..ROUNDS {
        let mut is_better = false;
        for q in 0..quads.quads.len() {
            if quality(quads, q) >= POOR {
                continue;
            }
            for v in quads.quads[q] {
                is_better |= improve(quads, surface, v as usize, &around[v as usize]);
            }
        }
        if !is_better {
            return;
        }
    }
}

fn quality(quads: &QuadMesh, quad: usize) -> f64 {
    scaled_jacobian(quads.quads[quad].map(|v| quads.vertices[v as usize]))
}

fn worst(quads: &QuadMesh, around: &[u32]) -> f64 {
    let qualities = around.iter().map(|&q| quality(quads, q as usize));
    qualities.fold(f64::INFINITY, f64::min)
}

/// Moves a vertex to the best of the places tried. Returns whether it moved.
fn improve(quads: &mut QuadMesh, surface: &mut Surface, v: usize, around: &[u32]) -> bool {
    /// The least improvement for which a vertex moves.
    const GAIN: f64 = 1e-3;
    let before = quads.vertices[v];
    let mut best = (worst(quads, around) + GAIN, before);
    for place in places(quads, v, around) {
        let place = surface.project(v, place);
        quads.vertices[v] = place;
        let found = worst(quads, around);
        if found > best.0 {
            best = (found, place);
        }
    }
    quads.vertices[v] = best.1;
    best.1 != before
}

fn places(quads: &QuadMesh, v: usize, around: &[u32]) -> Vec<Vec3> {
    let here = quads.vertices[v];
    let (mut ring, mut asked) = ([0.0; 3], [0.0; 3]);
    let mut arms = Vec::new();
    for &q in around {
        let corners = quads.quads[q as usize].map(|v| quads.vertices[v as usize]);
        let targets = square::closest(corners, 0.0, 0.0);
        for (k, _) in quads.quads[q as usize]
            .iter()
            .enumerate()
            .filter(|(_, w)| **w as usize == v)
        {
            let next = corners[(k + 1) % 4];
            ring = add(ring, add(next, corners[(k + 3) % 4]));
            asked = add(asked, targets[k]);
            arms.push(sub(next, here));
            arms.push(sub(corners[(k + 2) % 4], here));
        }
    }
    let count = (arms.len() / 2) as f64;
    let means = [scale(ring, 0.5 / count), scale(asked, 1.0 / count)];
    let towards = |goal: Vec3, part: f64| add(here, scale(sub(goal, here), part));
    let mut places = Vec::new();
    for goal in means {
        places.extend([1.0, 0.5, 0.2].map(|part| towards(goal, part)));
    }
    for arm in arms {
        places.extend([0.25, 0.08, -0.08, -0.25].map(|part| add(here, scale(arm, part))));
    }
    places
}
