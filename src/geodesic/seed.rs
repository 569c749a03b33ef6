//! The first windows: of points and segments within the faces that hold them.

use super::roots::{Point2, Root, at, flat};
use super::wavefront::{Arrival, Wavefront};
use super::window::Window;

/// What lies no farther above a segment than this share of the face's size lies on it.
const ON_SEGMENT: f64 = 1e-13;

impl Wavefront<'_> {
    /// Starts at a root: its lines leave all faces that hold it.
    pub(super) fn seed(&mut self, number: usize, root: &Root) {
        for &(face, one, two) in &root.faces {
            let corners = flat(self.mesh, face);
            if root.is_segment {
                self.seed_segment(number, face, corners, [at(corners, one), at(corners, two)]);
            } else {
                self.seed_point(number, face, corners, one);
            }
        }
    }

    fn seed_point(&mut self, number: usize, face: usize, corners: [Point2; 3], weights: [f64; 3]) {
        let point = at(corners, weights);
        for k in 0..3 {
            let local = Local::new(corners, k);
            let [x, y] = local.place(point);
            let top = self.mesh.corners(face)[(k + 2) % 3];
            let apex = local.place(corners[(k + 2) % 3]);
            let arrival = Arrival {
                half: (3 * face + k) as u32,
                root: number as u32,
                x,
                y,
            };
            self.reach(top, length([apex[0] - x, apex[1] - y]), arrival);
            // The corner opposite edge k has no weight if the point lies on the edge.
            if weights[(k + 2) % 3] > 0.0 {
                self.start_window(
                    face,
                    k,
                    Window {
                        a: 0.0,
                        b: local.length,
                        x: local.length - x,
                        y: -y,
                        s: 0.0,
                        root: number as u32,
                        is_line: false,
                    },
                );
            }
        }
    }

    fn seed_segment(
        &mut self,
        number: usize,
        face: usize,
        corners: [Point2; 3],
        ends: [Point2; 2],
    ) {
        let along = minus(ends[1], ends[0]);
        let size = length(along);
        let along = along.map(|x| x / size);
        let heights = |n: Point2| corners.map(|c| dot(n, minus(c, ends[0])));
        let extent = length(minus(corners[1], corners[0])).max(length(corners[2]));
        for normal in [[-along[1], along[0]], [along[1], -along[0]]] {
            let above = heights(normal);
            for k in 0..3 {
                let local = Local::new(corners, k);
                let (x, y) = (dot(normal, local.axis), dot(normal, local.up()));
                let from_start = [k, (k + 1) % 3].map(|c| dot(along, minus(corners[c], ends[0])));
                let heights = [above[k], above[(k + 1) % 3]];
                // The apex opposite this edge, straight above the segment.
                let top = (k + 2) % 3;
                let foot = dot(along, minus(corners[top], ends[0]));
                if (0.0..=size).contains(&foot) && above[top] >= 0.0 {
                    let arrival = Arrival {
                        half: (3 * face + k) as u32,
                        root: number as u32,
                        x,
                        y: -y,
                    };
                    self.reach(self.mesh.corners(face)[top], above[top], arrival);
                }
                if heights[0].max(heights[1]) <= ON_SEGMENT * extent {
                    continue;
                }
                let mut shares = [0.0, 1.0];
                clip(&mut shares, from_start);
                clip(&mut shares, from_start.map(|x| size - x));
                clip(&mut shares, heights);
                // Lines leave the face over edge k, downwards in its plane.
                if shares[0] < shares[1] && y < 0.0 {
                    self.start_window(
                        face,
                        k,
                        Window {
                            a: (1.0 - shares[1]) * local.length,
                            b: (1.0 - shares[0]) * local.length,
                            x: -x,
                            y,
                            s: heights[1],
                            root: number as u32,
                            is_line: true,
                        },
                    );
                }
            }
        }
    }

    /// A window that leaves a face over its local edge `k`; nothing at the boundary.
    fn start_window(&mut self, face: usize, k: usize, window: Window) {
        let is_open = window.y < 0.0 && window.a < window.b;
        if let (Some(twin), true) = (self.twin(face, k), is_open) {
            self.deliver_one(twin, window);
        }
    }
}

/// The plane of a local edge of a face, within the plane of the face.
struct Local {
    origin: Point2,
    axis: Point2,
    length: f64,
}

impl Local {
    fn new(corners: [Point2; 3], k: usize) -> Local {
        let edge = minus(corners[(k + 1) % 3], corners[k]);
        let length = length(edge);
        Local {
            origin: corners[k],
            axis: edge.map(|x| x / length),
            length,
        }
    }

    fn up(&self) -> Point2 {
        [-self.axis[1], self.axis[0]]
    }

    fn place(&self, point: Point2) -> Point2 {
        let p = minus(point, self.origin);
        [dot(p, self.axis), dot(p, self.up())]
    }
}

/// Cuts an interval of shares down to where a linear function, given at shares 0 and 1, is not negative.
fn clip(shares: &mut [f64; 2], [f0, f1]: [f64; 2]) {
    if f0 < 0.0 && f1 < 0.0 {
        *shares = [1.0, 0.0];
    } else if f0 < 0.0 {
        shares[0] = shares[0].max(f0 / (f0 - f1));
    } else if f1 < 0.0 {
        shares[1] = shares[1].min(f0 / (f0 - f1));
    }
}

fn minus(a: Point2, b: Point2) -> Point2 {
    [a[0] - b[0], a[1] - b[1]]
}

fn dot(a: Point2, b: Point2) -> f64 {
    a[0] * b[0] + a[1] * b[1]
}

fn length(a: Point2) -> f64 {
    dot(a, a).sqrt()
}
