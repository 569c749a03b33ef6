//! Streamlines of a cross field, evenly spaced over the surface.
//!
//! `jobard1997`: a streamline is traced until it comes too near to another one, and new
//! ones start at a given distance beside it. On a cross field only lines of similar direction keep
//! their distance (see [`spacing`]), and each line also seeds the lines that cross it, so that both
//! families together look like the quads of the field.

mod spacing;
mod walk;

use std::collections::VecDeque;

use self::spacing::{Index, Sample};
use self::walk::{Stand, Walker};
use roundel::field::OrientationField;
use roundel::mesh::TriangleMesh;
use roundel::mesh::vector::{Vec3, dot, norm, sub};

/// Steps in which a line is traced, and between its samples, in distances between lines.
const STEP: f64 = 0.25;
/// A line ends where another is nearer than this.
const TOO_NEAR: f64 = 0.6;
/// A line may start where no other is nearer than this.
const ROOM: f64 = 0.92;
/// The shortest line that is kept.
const SHORTEST: f64 = 2.5;
/// A line that comes back to its start closes when it misses it by no more than this.
const CLOSING: f64 = 0.3;
/// The longest line, in distances between lines: a spiral on a torus has no end.
const LONGEST: f64 = 2000.0;

/// A point of a streamline.
#[derive(Debug, Clone, Copy)]
pub(super) struct Point {
    pub(super) position: Vec3,
    /// Of the face that it lies in.
    pub(super) normal: Vec3,
}

/// A polygon on the surface that follows the field.
#[derive(Debug, Clone)]
pub(super) struct Streamline {
    pub(super) points: Vec<Point>,
    /// Whether the last point is the first.
    pub(super) closed: bool,
}

/// Streamlines about `spacing` apart, the same ones every time.
pub(super) fn streamlines(
    mesh: &TriangleMesh,
    field: &OrientationField,
    spacing: f64,
) -> Vec<Streamline> {
    let mut tracer = Tracer {
        walker: Walker::new(mesh, field),
        index: Index::new(spacing),
        spacing,
        lines: Vec::new(),
        open: VecDeque::new(),
    };
    // Often enough that no patch of a few spacings stays empty.
    let every = tracer.faces_between_seeds();
    for face in (0..mesh.face_count()).step_by(every) {
        for arm in [0, 1] {
            tracer.start(Stand::centre(face, arm));
            tracer.spread();
        }
    }
    tracer.lines
}

struct Tracer<'a> {
    walker: Walker<'a>,
    index: Index,
    spacing: f64,
    lines: Vec<Streamline>,
    /// Stands on lines beside which nothing has been tried yet.
    open: VecDeque<Stand>,
}

/// One direction of a line under way.
struct Half {
    points: Vec<Point>,
    stands: Vec<Stand>,
    length: f64,
    closed: bool,
}

impl Tracer<'_> {
    fn faces_between_seeds(&self) -> usize {
        let mesh = self.walker.mesh();
        let face = mesh.surface_area() / mesh.face_count() as f64;
        let patch = 0.25 * self.spacing * self.spacing;
        ((patch / face) as usize).max(1)
    }

    /// Starts lines beside and across existing ones until there is no room.
    fn spread(&mut self) {
        while let Some(stand) = self.open.pop_front() {
            for side in [1, 3] {
                let mut seed = stand.turned(side);
                if self.walk(&mut seed, self.spacing, &mut Vec::new()) {
                    self.start(seed.turned(-side));
                }
            }
            self.start(stand.turned(1));
        }
    }

    /// Traces a line from here both ways, and keeps it if there is room and it is long enough.
    fn start(&mut self, stand: Stand) {
        let line = self.lines.len();
        let first = self.sample(&stand, line, 0.0);
        if self.index.is_crowded(&first, ROOM * self.spacing) {
            return;
        }
        let before = self.index.len();
        self.index.insert(first);
        let ahead = self.trace(stand, line, 1.0);
        let mut points = vec![self.point(&stand)];
        let mut stands = vec![stand];
        let mut length = ahead.length;
        if !ahead.closed {
            let behind = self.trace(stand.turned(2), line, -1.0);
            length += behind.length;
            points.splice(0..0, behind.points.into_iter().rev());
            stands.extend(behind.stands);
        }
        points.extend(ahead.points);
        stands.extend(ahead.stands);
        if length < SHORTEST * self.spacing {
            self.index.truncate(before);
            return;
        }
        let closed = ahead.closed;
        self.lines.push(Streamline { points, closed });
        self.open.extend(stands);
    }

    /// Follows the field until the surface, the room or the patience ends; `sign` tells the
    /// samples behind the start from those ahead.
    fn trace(&mut self, start: Stand, line: usize, sign: f64) -> Half {
        let mut half = Half {
            points: Vec::new(),
            stands: Vec::new(),
            length: 0.0,
            closed: false,
        };
        let mut stand = start;
        let first = self.sample(&start, line, 0.0);
        let step = STEP * self.spacing;
        while half.length < LONGEST * self.spacing {
            let reached = half.points.len();
            if !self.walk(&mut stand, step, &mut half.points) {
                // Up to the boundary.
                break;
            }
            half.length += step;
            let here = self.sample(&stand, line, sign * half.length);
            if half.length > 4.0 * self.spacing && first.is_met_by(&here, CLOSING * self.spacing) {
                half.points.push(self.point(&start));
                half.closed = true;
                break;
            }
            if self.index.is_crowded(&here, TOO_NEAR * self.spacing) {
                half.points.truncate(reached);
                break;
            }
            self.index.insert(here);
            half.stands.push(stand);
        }
        half
    }

    /// Walks this far and notes the corners on the way; false if the way ends before.
    fn walk(&self, stand: &mut Stand, length: f64, points: &mut Vec<Point>) -> bool {
        let mut left = length;
        // A way of one step that needs more faces than this runs in circles.
        for _ in 0..10_000 {
            let Some(walked) = self.walker.advance(stand, left) else {
                return false;
            };
            left -= walked;
            let point = self.point(stand);
            let moved = |last: &Point| norm(sub(last.position, point.position)) > 1e-9 * length;
            if points.last().is_none_or(moved) {
                points.push(point);
            }
            if left <= 1e-9 * length {
                return true;
            }
        }
        false
    }

    fn point(&self, stand: &Stand) -> Point {
        Point {
            position: self.walker.position(stand),
            normal: self.walker.normal(stand),
        }
    }

    fn sample(&self, stand: &Stand, line: usize, at: f64) -> Sample {
        Sample {
            position: self.walker.position(stand),
            normal: self.walker.normal(stand),
            direction: self.walker.direction(stand),
            line,
            at,
        }
    }
}

impl Sample {
    /// Whether a line that left here comes back in the same direction.
    fn is_met_by(&self, other: &Sample, distance: f64) -> bool {
        let apart = sub(other.position, self.position);
        dot(apart, apart) <= distance * distance && dot(self.direction, other.direction) > 0.8
    }
}
