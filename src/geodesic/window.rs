//! A window: an interval of an edge that straight lines from one root pass.
//!
//! The faces between root and edge are unfolded into a plane, in which the edge runs along the first axis from 0
//! and the root lies below it (`mitchell1987`; `surazhsky2005`). The root is a point, or a segment as in
//! `bommes2007`: all of its lines are perpendicular to it, and distances grow linearly over the plane.

/// An interval of a half-edge and the image of its root, in the plane of the half-edge.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Window {
    /// Where the interval starts, as a length from the origin of the half-edge.
    pub(super) a: f64,
    /// Where it ends.
    pub(super) b: f64,
    /// A point: its image; its second coordinate is negative. A segment: the unit direction of the lines, mirrored
    /// in the edge, so that the second coordinate is negative as well.
    pub(super) x: f64,
    /// The second coordinate.
    pub(super) y: f64,
    /// A point: its distance. A segment: the distance at the origin of the half-edge.
    pub(super) s: f64,
    /// What the lines come from.
    pub(super) root: u32,
    /// Whether the root is a segment.
    pub(super) is_line: bool,
}

impl Window {
    /// The distance at a point of the half-edge.
    pub(super) fn at(&self, t: f64) -> f64 {
        if self.is_line {
            return self.s + self.x * t;
        }
        let along = t - self.x;
        self.s + (along * along + self.y * self.y).sqrt()
    }

    /// The distance at a point of the plane.
    pub(super) fn at_point(&self, p: [f64; 2]) -> f64 {
        if self.is_line {
            return self.s + self.x * p[0] - self.y * p[1];
        }
        let (u, v) = (p[0] - self.x, p[1] - self.y);
        self.s + (u * u + v * v).sqrt()
    }

    /// The direction of the line through a point of the half-edge: any length, upwards.
    pub(super) fn direction(&self, t: f64) -> [f64; 2] {
        let along = if self.is_line { self.x } else { t - self.x };
        [along, -self.y]
    }

    /// Whether the distance at a point of the half-edge is clearly above `bound`.
    pub(super) fn exceeds(&self, t: f64, bound: f64) -> bool {
        let bound = bound * (1.0 + SLACK);
        if self.is_line {
            return self.s + self.x * t > bound;
        }
        let (along, rest) = (t - self.x, bound - self.s);
        rest < 0.0 || along * along + self.y * self.y > rest * rest
    }

    /// Whether the distance grows over the whole interval.
    pub(super) fn rises(&self) -> bool {
        match self.is_line {
            true => self.x >= 0.0,
            false => self.x <= self.a,
        }
    }

    /// Whether the distance falls over the whole interval.
    pub(super) fn falls(&self) -> bool {
        match self.is_line {
            true => self.x < 0.0,
            false => self.x >= self.b,
        }
    }

    /// Whether both are images of one root that differ by no more than rounding.
    pub(super) fn has_image_of(&self, other: &Window) -> bool {
        let near = |a: f64, b: f64, scale: f64| (a - b).abs() <= SAME_IMAGE * scale;
        let size = match self.is_line {
            true => 1.0,
            false => self.x.abs() + self.y.abs(),
        };
        self.root == other.root
            && near(self.x, other.x, size)
            && near(self.y, other.y, size)
            && near(self.s, other.s, self.s.abs())
    }
}

/// A distance is clearly above another if it is more than this share above it. Rounding of a path over some
/// thousand edges is below.
pub(super) const SLACK: f64 = 1e-12;

/// Images that differ by no more than this share of their distance are one: rounding over some hundred edges.
const SAME_IMAGE: f64 = 2e-14;
