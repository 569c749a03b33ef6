//! The plane of a half-edge: its face, unfolded so that the half-edge runs along the first axis from 0.

use super::window::Window;
use crate::mesh::TriangleMesh;
use crate::mesh::vector::{cross, dot, norm, sub};

/// A face in the plane of one of its half-edges. The corners are the origin, `(length, 0)` and the apex above.
#[derive(Debug, Clone, Copy)]
pub(super) struct Frame {
    /// The length of the half-edge.
    pub(super) length: f64,
    /// The third corner.
    pub(super) apex: [f64; 2],
    /// The length of the edge from the origin to the apex.
    pub(super) left: f64,
    /// The length of the edge from the apex to the end.
    pub(super) right: f64,
}

impl Frame {
    /// The frame of half-edge `3 face + k`.
    pub(super) fn new(mesh: &TriangleMesh, face: usize, k: usize) -> Frame {
        let p = mesh.corner_positions(face);
        let (from, to, apex) = (p[k], p[(k + 1) % 3], p[(k + 2) % 3]);
        let (edge, side) = (sub(to, from), sub(apex, from));
        let length = norm(edge);
        let inverse = 1.0 / length;
        Frame {
            length,
            apex: [dot(edge, side) * inverse, norm(cross(edge, side)) * inverse],
            left: norm(side),
            right: norm(sub(apex, to)),
        }
    }

    /// The point of the face with these weights of its corners, if the half-edge is local edge `k`.
    pub(super) fn place(&self, weights: [f64; 3], k: usize) -> [f64; 2] {
        let (to, apex) = (weights[(k + 1) % 3], weights[(k + 2) % 3]);
        [to * self.length + apex * self.apex[0], apex * self.apex[1]]
    }

    /// Unit vector from the origin to the apex.
    pub(super) fn up(&self) -> [f64; 2] {
        unit(self.apex)
    }

    /// Unit vector from the apex to the end.
    pub(super) fn down(&self) -> [f64; 2] {
        unit([self.length - self.apex[0], -self.apex[1]])
    }
}

fn unit([x, y]: [f64; 2]) -> [f64; 2] {
    let inverse = 1.0 / (x * x + y * y).sqrt();
    [x * inverse, y * inverse]
}

/// The image of a window's root in the plane of another half-edge, which starts at `origin` and runs along the unit
/// vector `axis`; the interval is to be set.
pub(super) fn moved(window: &Window, origin: [f64; 2], axis: [f64; 2]) -> Window {
    if window.is_line {
        let n = [window.x, -window.y];
        return Window {
            x: n[0] * axis[0] + n[1] * axis[1],
            y: n[0] * axis[1] - n[1] * axis[0],
            s: window.s + n[0] * origin[0] + n[1] * origin[1],
            ..*window
        };
    }
    let (u, v) = (window.x - origin[0], window.y - origin[1]);
    Window {
        x: u * axis[0] + v * axis[1],
        y: v * axis[0] - u * axis[1],
        ..*window
    }
}
