//! Step 5: triangles without area go, and the surface stays connected.
//!
//! A needle, whose shortest edge is negligible, is collapsed: that edge's ends become one vertex. A cap
//! has a vertex on its longest edge: the other triangles at that edge are split there, and the cap is
//! gone. With one such triangle this is the flip of the longest edge (`botsch2001`). The sliver with the
//! longest edge comes first, so that an edge is split at a vertex between its ends. The number of steps
//! is bounded; what is left when they are spent is dropped.

use std::cmp::Reverse;
use std::collections::BinaryHeap;

use super::area::ZERO_AREA_TOLERANCE;
use super::edits::EditKind;
use super::lists::NONE;
use super::surface::{Surface, flat};
use crate::linalg::vector::{norm, sub};

/// Removes all triangles without area. Whether there were any is the result.
pub(super) fn remove_slivers(surface: &mut Surface, stands_for: &mut [u32]) -> bool {
    let slivers = (0..surface.triangles.len()).filter(|&t| flat(surface.corners(t)));
    let slivers: Vec<usize> = slivers.collect();
    if slivers.is_empty() {
        return false;
    }
    let mut work = Work::new(surface, stands_for);
    for t in slivers {
        work.enqueue(t);
    }
    while let Some((_, Reverse(t))) = work.queue.pop() {
        if work.alive[t] {
            work.remove(t);
        }
    }
    let alive = work.alive;
    surface.retain(|t| alive[t]);
    sort_by_polygon(surface);
    true
}

/// Triangles that were split get back to their polygons.
fn sort_by_polygon(surface: &mut Surface) {
    let mut order: Vec<usize> = (0..surface.triangles.len()).collect();
    order.sort_by_key(|&t| surface.polygon[t]);
    surface.triangles = order.iter().map(|&t| surface.triangles[t]).collect();
    surface.before = order.iter().map(|&t| surface.before[t]).collect();
    surface.polygon = order.iter().map(|&t| surface.polygon[t]).collect();
}

/// The surface with the corners of each vertex as a linked list.
struct Work<'a> {
    surface: &'a mut Surface,
    stands_for: &'a mut [u32],
    alive: Vec<bool>,
    /// The first corner of every vertex, and the corner after each.
    head: Vec<u32>,
    next: Vec<u32>,
    /// The square of the longest edge as bits, and the triangle.
    queue: BinaryHeap<(u64, Reverse<usize>)>,
    /// The number of steps that are left.
    steps: usize,
}

impl<'a> Work<'a> {
    fn new(surface: &'a mut Surface, stands_for: &'a mut [u32]) -> Self {
        let count = surface.triangles.len();
        let mut work = Work {
            alive: vec![true; count],
            head: vec![NONE; surface.positions.len()],
            next: Vec::with_capacity(3 * count),
            queue: BinaryHeap::new(),
            steps: 64 * count + 10_000,
            surface,
            stands_for,
        };
        for t in 0..count {
            work.link(t);
        }
        work
    }

    fn link(&mut self, t: usize) {
        for k in 0..3 {
            let head = &mut self.head[self.surface.triangles[t][k] as usize];
            self.next.push(*head);
            *head = (3 * t + k) as u32;
        }
    }

    fn length(&self, a: u32, b: u32) -> f64 {
        let [a, b] = [a, b].map(|v| self.surface.positions[v as usize]);
        norm(sub(a, b))
    }

    fn enqueue(&mut self, t: usize) {
        let [a, b, c] = self.surface.triangles[t];
        let lengths = [self.length(a, b), self.length(b, c), self.length(c, a)];
        let longest = lengths.into_iter().fold(0.0, f64::max);
        self.queue.push((longest.to_bits(), Reverse(t)));
    }

    /// Removes a triangle without area.
    fn remove(&mut self, t: usize) {
        let corners = self.surface.triangles[t];
        // The edge opposite to a corner is the longest, and the corner next to its nearest end.
        let opposite = |k: usize| self.length(corners[(k + 1) % 3], corners[(k + 2) % 3]);
        let k = (0..3).fold(0, |k, l| if opposite(l) > opposite(k) { l } else { k });
        let [c, a, b] = [0, 1, 2].map(|i| corners[(k + i) % 3]);
        let longest = self.length(a, b);
        let (to_a, to_b) = (self.length(c, a), self.length(c, b));
        let near = if (to_a, a) <= (to_b, b) { a } else { b };
        if !longest.is_finite() || self.steps == 0 {
            self.kill(t);
            let polygon = self.surface.polygon[t];
            self.surface
                .edits
                .add(EditKind::SliverDropped, polygon, None);
        } else if to_a.min(to_b) <= ZERO_AREA_TOLERANCE * longest {
            self.collapse(c.max(near), c.min(near));
        } else {
            self.split(t, [a, b, c]);
        }
    }

    fn kill(&mut self, t: usize) {
        self.alive[t] = false;
    }

    /// Merges a vertex with a lower one.
    fn collapse(&mut self, from: u32, to: u32) {
        self.surface.edits.add(EditKind::EdgeCollapsed, from, to);
        self.stands_for[from as usize] = to;
        let (mut corner, mut last) = (self.head[from as usize], NONE);
        let mut changed = Vec::new();
        while corner != NONE {
            self.steps = self.steps.saturating_sub(1);
            let (t, k) = (corner as usize / 3, corner as usize % 3);
            if self.alive[t] {
                if self.surface.triangles[t].contains(&to) {
                    self.kill(t);
                } else {
                    self.surface.triangles[t][k] = to;
                    changed.push(t);
                }
            }
            last = corner;
            corner = self.next[corner as usize];
        }
        if last != NONE {
            self.next[last as usize] = self.head[to as usize];
            self.head[to as usize] = self.head[from as usize];
            self.head[from as usize] = NONE;
        }
        for t in changed {
            if flat(self.surface.corners(t)) {
                self.enqueue(t);
            }
        }
    }

    /// Splits the other triangles at edge a b of a cap at its vertex c.
    fn split(&mut self, cap: usize, [a, b, c]: [u32; 3]) {
        self.kill(cap);
        let polygon = self.surface.polygon[cap];
        self.surface.edits.add(EditKind::CapFlipped, polygon, c);
        let mut corner = self.head[a as usize];
        let mut others = Vec::new();
        while corner != NONE {
            self.steps = self.steps.saturating_sub(1);
            let t = corner as usize / 3;
            if self.alive[t] && self.surface.triangles[t].contains(&b) {
                others.push(t);
            }
            corner = self.next[corner as usize];
        }
        others.sort_unstable();
        for t in others {
            self.kill(t);
            if self.surface.triangles[t].contains(&c) {
                continue;
            }
            for end in [b, a] {
                let with = |v: u32| if v == end { c } else { v };
                let triangle = self.surface.triangles[t].map(with);
                let new = self.surface.triangles.len();
                self.surface
                    .push(triangle, triangle, self.surface.polygon[t]);
                self.alive.push(true);
                self.link(new);
                if flat(self.surface.corners(new)) {
                    self.enqueue(new);
                }
            }
        }
    }
}
