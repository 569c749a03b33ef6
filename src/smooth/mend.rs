//! Improves the worst quads one vertex at a time.
//!
//! For each corner of a poor quad a few places are tried: towards the mean of its neighbours, towards the
//! targets of its quads, and along its edges and diagonals. The corner moves to the place where the worst of
//! its quads is best, if that is an improvement.
//!
//! Three corners of a quad may lie on one straight boundary or crease. No motion along it makes such a quad
//! convex, so a corner of a quad that is still inverted may leave the surface by a part of an edge.

use super::quality::scaled_jacobian;
use super::square;
use super::surface::Surface;
use crate::extract::QuadMesh;
use crate::mesh::vector::{Vec3, add, cross, norm, normalize, scale, sub};

/// Quads with a scaled Jacobian below this are improved.
const POOR: f64 = 0.5;

/// The least improvement for which a vertex moves.
const GAIN: f64 = 1e-3;

/// The most passes over all poor quads.
const ROUNDS: usize = 20;

/// Quads with a scaled Jacobian of at most this count as inverted: a rounding of the vertices makes them so.
pub(super) const INVERTED: f64 = 1e-3;

/// An edge that is not longer than this part of the longest of its quad is a point.
const NO_EDGE: f64 = 1e-6;

/// How far a corner of an inverted quad may leave the surface, in the mean edge of the quad: more only if
/// less does not suffice.
const LEAVES: [f64; 4] = [0.02, 0.05, 0.1, 0.2];

/// How often such a quad is moved by each part: one corner at a time.
const TIMES: usize = 3;

/// Moves corners of inverted quads off the surface.
pub(super) fn leave_surface(quads: &mut QuadMesh) {
    let around = quads.around();
    for part in LEAVES.into_iter().flat_map(|part| [part; TIMES]) {
        for q in 0..quads.quads.len() {
            if quality(quads, q) <= INVERTED {
                leave(quads, q, part, &around);
            }
        }
    }
}

/// Moves the corner of a quad, off the surface, for which the worst quad around it becomes best.
fn leave(quads: &mut QuadMesh, quad: usize, part: f64, around: &[Vec<u32>]) {
    let vertices = quads.quads[quad].map(|v| v as usize);
    let corners = vertices.map(|v| quads.vertices[v]);
    let edge = |k: usize| norm(sub(corners[(k + 1) % 4], corners[k]));
    let reach = part * 0.25 * (0..4).map(edge).sum::<f64>();
    let mut best: Option<(f64, usize, Vec3)> = None;
    for (k, &v) in vertices.iter().enumerate() {
        let before = worst(quads, &around[v]);
        let arms = [1, 2, 3].map(|turn| sub(corners[k], corners[(k + turn) % 4]));
        let sides = [cross(arms[0], arms[1]), cross(arms[1], arms[2])];
        for direction in arms.into_iter().chain(sides).map(normalize) {
            for step in [reach, -reach] {
                let place = add(corners[k], scale(direction, step));
                quads.vertices[v] = place;
                let found = worst(quads, &around[v]);
                if found > before + GAIN && best.is_none_or(|(most, ..)| found > most) {
                    best = Some((found, v, place));
                }
            }
        }
        quads.vertices[v] = corners[k];
    }
    if let Some((_, v, place)) = best {
        quads.vertices[v] = place;
    }
}

/// Improves poor quads until no vertex moves, on the surface.
pub(super) fn mend(quads: &mut QuadMesh, surface: &mut Surface) {
    let around = quads.around();
    for _ in 0..ROUNDS {
        let mut is_better = false;
        for q in 0..quads.quads.len() {
            if quality(quads, q) >= POOR {
                continue;
            }
            if surface.has_spent_its_work() {
                return;
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

/// The scaled Jacobian of a quad; the least one if two of its corners are at one point.
pub(super) fn quality(quads: &QuadMesh, quad: usize) -> f64 {
    let corners = quads.quads[quad].map(|v| quads.vertices[v as usize]);
    let length = |k: usize| norm(sub(corners[(k + 1) % 4], corners[k]));
    let lengths = [0, 1, 2, 3].map(length);
    let [least, most] = [f64::min, f64::max].map(|of| lengths.into_iter().fold(lengths[0], of));
    match least <= NO_EDGE * most {
        true => -1.0,
        false => scaled_jacobian(corners),
    }
}

/// The least quality of these quads, less one for each that has an edge of no length.
fn worst(quads: &QuadMesh, around: &[u32]) -> f64 {
    let qualities = around.iter().map(|&q| quality(quads, q as usize));
    qualities.fold(f64::INFINITY, |worst, quality| match quality <= -1.0 {
        true => worst.min(0.0) - 1.0,
        false => worst.min(quality),
    })
}

/// Moves a vertex to the best of the places tried. Returns whether it moved.
pub(super) fn improve(
    quads: &mut QuadMesh,
    surface: &mut Surface,
    v: usize,
    around: &[u32],
) -> bool {
    let before = quads.vertices[v];
    let mut best = (worst(quads, around) + GAIN, before);
    for place in places(quads, v, around) {
        let Some(place) = surface.project(v, place) else {
            continue;
        };
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_quad_with_three_corners_on_a_straight_boundary_becomes_convex() {
        // Corner 1 is straight: the quad is a triangle until it leaves the line.
        let vertices = vec![[0.0; 3], [1.0, 0.0, 0.0], [2.0, 0.0, 0.0], [1.0, 1.0, 0.0]];
        let mut quads = QuadMesh::from_quads(vertices, vec![[0, 1, 2, 3]], 1);
        let around = quads.around();
        assert_eq!(quality(&quads, 0), 0.0);
        leave(&mut quads, 0, LEAVES[0], &around);
        assert!(quality(&quads, 0) > 0.02);
        let lengths = quads.vertices.iter().map(|p| p[1].abs());
        assert!(lengths.filter(|y| *y > 0.0 && *y < 0.05).count() <= 1);
    }

    #[test]
    fn a_vertex_leaves_another_one_even_if_more_quads_have_edges_of_no_length() {
        // Two quads side by side, each with two corners at one point.
        let flat = |[x, y]: [f64; 2]| [x, y, 0.0];
        let corners = [
            [0.0; 2],
            [0.0; 2],
            [1.0; 2],
            [0.0, 1.0],
            [2.0, 0.0],
            [2.0, 1.0],
        ];
        let vertices = corners.map(flat).to_vec();
        let mut quads = QuadMesh::from_quads(vertices, vec![[0, 1, 2, 3], [1, 4, 5, 2]], 1);
        assert_eq!(quality(&quads, 0), -1.0);
        quads.vertices[4] = quads.vertices[5];
        assert_eq!(worst(&quads, &[0, 1]), -2.0);
        quads.vertices[1] = [1.0, 0.0, 0.0];
        assert_eq!(worst(&quads, &[0, 1]), -1.0);
        quads.vertices[4] = [2.0, 0.0, 0.0];
        assert_eq!(worst(&quads, &[0, 1]), 1.0);
    }
}
