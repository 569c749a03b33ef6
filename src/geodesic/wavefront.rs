//! The propagation: windows cross faces in lists, one half-edge after the other, the nearest first.
//!
//! That whole lists cross at a time is the idea of `qin2016`. The result does not depend on the order in which
//! lists cross: a list that comes later, with nearer windows, crosses again. The order decides how often that
//! happens.

use super::envelope::merge;
use super::frame::Frame;
use super::queue::Queue;
use super::roots::Roots;
use super::window::{SLACK, Window};
use crate::error::Result;
use crate::mesh::TriangleMesh;
use crate::monitor::{may_continue, room_for};

/// How a vertex was reached: by the last piece of a straight line.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Arrival {
    /// The half-edge opposite the vertex in the face of that piece.
    pub(super) half: u32,
    /// What the line comes from: a vertex, or from the number of vertices on, one of the other roots.
    pub(super) root: u32,
    /// The image of the root in the plane of the half-edge, as in a window.
    pub(super) x: f64,
    pub(super) y: f64,
}

/// No half-edge, and no root.
pub(super) const NONE: u32 = u32::MAX;

impl Arrival {
    const NEVER: Arrival = Arrival {
        half: NONE,
        root: NONE,
        x: 0.0,
        y: 0.0,
    };
}

/// After so many lists, the call is asked whether it ends.
const ASKED: usize = 1 << 9;

/// The bytes that a triangle needs for vertices and half-edges, without windows.
const BYTES: usize = 150;

/// The state of the propagation.
pub(super) struct Wavefront<'m> {
    pub(super) mesh: &'m TriangleMesh,
    roots: &'m Roots,
    pub(super) distance: Vec<f64>,
    pub(super) arrival: Vec<Arrival>,
    /// The windows that have crossed each half-edge's face, if they are kept.
    pub(super) crossed: Option<Vec<Vec<Window>>>,
    /// The distance of each vertex when it became the root of windows.
    pub(super) left_at: Vec<f64>,
    /// The windows that are to cross the face of each half-edge.
    pub(super) pending: Vec<Vec<Window>>,
    /// The least distance for which each half-edge waits in the queue.
    waits_for: Vec<f64>,
    queue: Queue,
    /// Whether an edge lies on a source.
    pub(super) is_source: Vec<bool>,
    pub(super) scratch: Scratch,
}

/// Lists that are filled and emptied again.
#[derive(Debug, Default)]
pub(super) struct Scratch {
    pub(super) left: Vec<Window>,
    pub(super) right: Vec<Window>,
    pub(super) spare: Vec<Window>,
}

impl<'m> Wavefront<'m> {
    /// The state at the start.
    pub(super) fn new(mesh: &'m TriangleMesh, roots: &'m Roots, keeps: bool) -> Result<Self> {
        room_for("geodesic distances", mesh.face_count(), BYTES)?;
        let (vertices, halves) = (mesh.vertex_count(), 3 * mesh.face_count());
        let mut front = Wavefront {
            mesh,
            roots,
            distance: vec![f64::INFINITY; vertices],
            arrival: vec![Arrival::NEVER; vertices],
            crossed: keeps.then(|| vec![Vec::new(); halves]),
            left_at: vec![f64::INFINITY; vertices],
            pending: vec![Vec::new(); halves],
            waits_for: vec![f64::INFINITY; halves],
            queue: Queue::default(),
            is_source: vec![false; mesh.edge_count()],
            scratch: Scratch::default(),
        };
        for &(v, _) in &roots.vertices {
            front.distance[v] = 0.0;
            front.arrival[v].root = v as u32;
            front.queue.push(0.0, (halves + v) as u32);
        }
        roots.edges.iter().for_each(|&e| front.is_source[e] = true);
        for (i, root) in roots.others.iter().enumerate() {
            front.seed(vertices + i, root);
        }
        Ok(front)
    }

    /// Propagates until all that is not farther than `limit` is reached.
    pub(super) fn run(&mut self, limit: f64) -> Result<()> {
        let halves = self.pending.len();
        let mut steps = 0;
        while let Some((key, item)) = self.queue.pop() {
            if key > limit {
                break;
            }
            if steps % ASKED == 0 {
                may_continue()?;
            }
            steps += 1;
            let item = item as usize;
            if item >= halves {
                if self.distance[item - halves] == key {
                    self.leave(item - halves);
                }
            } else if self.waits_for[item] == key {
                self.waits_for[item] = f64::INFINITY;
                self.cross(item);
            }
        }
        Ok(())
    }

    /// Hands the windows of a list to a half-edge, whose face they are to cross.
    pub(super) fn deliver(&mut self, half: usize, list: &[Window]) {
        let least = least(list);
        let pending = &mut self.pending[half];
        if pending.is_empty() {
            pending.extend_from_slice(list);
        } else {
            merge(pending, list, &mut self.scratch.spare);
            pending.clear();
            pending.extend_from_slice(&self.scratch.spare);
        }
        if least < self.waits_for[half] {
            self.waits_for[half] = least;
            self.queue.push(least, half as u32);
        }
    }

    /// Hands one window to a half-edge.
    pub(super) fn deliver_one(&mut self, half: usize, window: Window) {
        self.deliver(half, &[window]);
    }

    /// A line ends at a vertex.
    pub(super) fn reach(&mut self, vertex: usize, distance: f64, arrival: Arrival) {
        if distance < self.distance[vertex] {
            self.distance[vertex] = distance;
            self.arrival[vertex] = arrival;
            let item = self.pending.len() + vertex;
            self.queue.push(distance, item as u32);
        }
    }

    /// Whether a vertex has been the root of windows, at a distance that has not fallen since.
    pub(super) fn has_left(&self, vertex: usize) -> bool {
        self.left_at[vertex] <= self.distance[vertex] * (1.0 + 0.1 * SLACK)
    }

    pub(super) fn is_segment(&self, root: u32) -> bool {
        self.roots.is_segment(self.mesh, root)
    }

    /// The frame of a half-edge.
    pub(super) fn frame(&self, half: usize) -> Frame {
        Frame::new(self.mesh, half / 3, half % 3)
    }

    pub(super) fn twin(&self, face: usize, k: usize) -> Option<usize> {
        self.mesh.neighbor(face, k).map(|(f, j)| 3 * f + j)
    }
}

/// The least distance on a list. Where a window continues the way of its neighbour, up or down, the distance need
/// not be known.
fn least(list: &[Window]) -> f64 {
    let mut least = f64::INFINITY;
    let mut last: Option<&Window> = None;
    for window in list {
        let touching = last.is_some_and(|w| w.b >= window.a);
        let falls_on = touching && window.falls();
        if let (Some(before), false) = (last.filter(|w| w.falls()), falls_on) {
            least = least.min(before.at(before.b));
        }
        if window.rises() {
            if !(touching && last.is_some_and(Window::rises)) {
                least = least.min(window.at(window.a));
            }
        } else if !window.falls() {
            least = least.min(window.s - window.y);
        }
        last = Some(window);
    }
    match last {
        Some(w) if w.falls() => least.min(w.at(w.b)),
        _ => least,
    }
}
