//! One step of the propagation: the windows of a half-edge cross its face to the two other edges.
//!
//! Windows that cannot be part of a shortest path are left out, by the rules of `xin2009`.

use super::envelope::push;
use super::frame::{Frame, moved};
use super::wavefront::{Arrival, Wavefront};
use super::window::Window;

/// A vertex is on a line if it is no farther from it than this share of the line's length: the line may have
/// missed it by rounding. Its distance changes by the square of that.
const ON_LINE: f64 = 2e-12;

/// A half-edge, its corners' distances and its neighbours.
struct Crossing {
    half: usize,
    frame: Frame,
    /// Distances of the origin and the end.
    ends: [f64; 2],
    apex: usize,
    up: [f64; 2],
    down: [f64; 2],
    /// The half-edges across the edge from the origin to the apex, and from there to the end.
    twins: [Option<usize>; 2],
}

/// A line through the edge, as seen from the apex.
#[derive(Clone, Copy)]
struct Line {
    /// Where it crosses the edge.
    place: f64,
    /// The cross product of its direction and the way to the apex: positive if the apex is to its left.
    side: f64,
    /// A bound of it up to which the apex is on the line.
    tolerance: f64,
}

impl Crossing {
    fn line(&self, window: &Window, place: f64) -> Line {
        let [x, y] = window.direction(place);
        let [px, py] = self.frame.apex;
        let scale = match window.is_line {
            true => self.frame.length + self.frame.left,
            false => x * x + y * y + py * py,
        };
        Line {
            place,
            side: x * py - y * (px - place),
            tolerance: ON_LINE * scale,
        }
    }

    /// Where a line with the apex to its right meets the edge from the origin to the apex.
    fn on_left(&self, line: Line, rise: f64) -> f64 {
        let below = line.place * rise;
        match line.side < 0.0 {
            true => self.frame.left * (below / (below - line.side)),
            false => self.frame.left,
        }
    }

    /// Where a line with the apex to its left meets the edge from the apex to the end.
    fn on_right(&self, line: Line, rise: f64) -> f64 {
        let below = (self.frame.length - line.place) * rise;
        match line.side > 0.0 {
            true => self.frame.right * (line.side / (below + line.side)),
            false => 0.0,
        }
    }
}

/// Whether an end of an edge of this length is so near that no shortest path crosses the window. `ends` are the
/// distances of both.
fn is_shadowed(window: &Window, ends: [f64; 2], length: f64) -> bool {
    window.exceeds(window.b, ends[0] + window.b)
        || window.exceeds(window.a, ends[1] + (length - window.a))
}

impl Wavefront<'_> {
    /// All windows that wait at a half-edge cross its face.
    pub(super) fn cross(&mut self, half: usize) {
        let mut windows = std::mem::take(&mut self.pending[half]);
        let (face, k) = (half / 3, half % 3);
        if self.is_source[self.mesh.edge_of(face, k)] {
            return;
        }
        let corners = self.mesh.corners(face);
        let frame = self.frame(half);
        let crossing = Crossing {
            half,
            frame,
            ends: [corners[k], corners[(k + 1) % 3]].map(|v| self.distance[v]),
            apex: corners[(k + 2) % 3],
            up: frame.up(),
            down: frame.down(),
            twins: [self.twin(face, (k + 2) % 3), self.twin(face, (k + 1) % 3)],
        };
        let mut scratch = std::mem::take(&mut self.scratch);
        scratch.left.clear();
        scratch.right.clear();
        windows.retain(|w| !is_shadowed(w, crossing.ends, frame.length));
        for window in &windows {
            let from = crossing.line(window, window.a);
            let to = crossing.line(window, window.b);
            if from.side <= from.tolerance && to.side >= -to.tolerance {
                self.reach_apex(&crossing, window);
            }
            let top = self.distance[crossing.apex];
            let rise = -window.y;
            if from.side < 0.0 && crossing.twins[0].is_some() {
                let child = Window {
                    a: crossing.on_left(from, rise),
                    b: crossing.on_left(to, rise),
                    ..moved(window, [0.0; 2], crossing.up)
                };
                let ends = [crossing.ends[0], top];
                if is_open(&child) && !is_shadowed(&child, ends, frame.left) {
                    push(&mut scratch.left, child, &mut scratch.spare);
                }
            }
            if to.side > 0.0 && crossing.twins[1].is_some() {
                let child = Window {
                    a: crossing.on_right(from, rise),
                    b: crossing.on_right(to, rise),
                    ..moved(window, frame.apex, crossing.down)
                };
                let ends = [top, crossing.ends[1]];
                if is_open(&child) && !is_shadowed(&child, ends, frame.right) {
                    push(&mut scratch.right, child, &mut scratch.spare);
                }
            }
        }
        self.scratch.spare = std::mem::take(&mut scratch.spare);
        for (twin, list) in crossing
            .twins
            .into_iter()
            .zip([&scratch.left, &scratch.right])
        {
            if let (Some(twin), false) = (twin, list.is_empty()) {
                self.deliver(twin, list);
            }
        }
        scratch.spare = std::mem::take(&mut self.scratch.spare);
        self.scratch = scratch;
        if let Some(crossed) = &mut self.crossed {
            crossed[half].append(&mut windows);
        }
    }

    fn reach_apex(&mut self, crossing: &Crossing, window: &Window) {
        let arrival = Arrival {
            half: crossing.half as u32,
            root: window.root,
            x: window.x,
            y: window.y,
        };
        let distance = window.at_point(crossing.frame.apex);
        self.reach(crossing.apex, distance, arrival);
    }
}

/// Whether lines pass a window. Rounding leaves none where they run along the edge, or so few that nothing lies
/// between their neighbours: the angle between the first and the last is less than that by which lines miss vertices.
fn is_open(window: &Window) -> bool {
    if !(window.y < 0.0 && window.a < window.b) {
        return false;
    }
    let along = window.a - window.x;
    let width = (window.b - window.a) * -window.y;
    window.is_line || width > NO_ANGLE * (along * along + window.y * window.y)
}

/// The least angle of a window.
const NO_ANGLE: f64 = 1e-14;
