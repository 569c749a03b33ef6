//! Shortest paths that cross no arc, from a sector of a node to a sector of another.
//!
//! A path runs straight from point to point, where points are vertices that no arc takes and middles of edges
//! that no arc runs along. So wherever the surface is connected between arcs, there is a path: a chain of faces is
//! crossed in the middles of the edges between them. The search is that of `hart1968`, by the distance in space to
//! the end.

use std::cmp::Ordering;
use std::collections::BinaryHeap;

use super::surface::{NONE, Surface, next, previous};
use crate::layout::base_layout::Dart;
use crate::mesh::closest_on_segment;
use crate::mesh::vector::{Vec3, add, norm, scale, sub};

/// The corners at a node between two arcs that follow each other, each by the half-edge where it begins.
#[derive(Debug, Clone)]
pub(in crate::layout) struct Sector {
    pub node: u32,
    pub corners: Vec<u32>,
}

impl Sector {
    /// The sector where a dart leaves a node: between the darts before and after it that are laid already. `around`
    /// has all darts of the node, counter-clockwise.
    pub fn new(surface: &Surface, node: u32, around: &[Dart], dart: Dart, is_closed: bool) -> Self {
        let fan: Vec<u32> = surface.around(node).collect();
        let laid = |d: Dart| {
            fan.iter()
                .position(|&half| surface.dart[half as usize] == d)
        };
        let count = around.len();
        let own = around.iter().position(|&d| d == dart).unwrap_or(0);
        let before = (1..count).find_map(|back| {
            let place = match own.checked_sub(back) {
                Some(place) => place,
                None if is_closed => own + count - back,
                None => return None,
            };
            laid(around[place])
        });
        let corners = match before {
            None => fan,
            Some(first) => {
                let turned = (0..fan.len()).map(|k| fan[(first + k) % fan.len()]);
                let is_inside =
                    |&(k, half): &(usize, u32)| k == 0 || surface.dart[half as usize] == NONE;
                turned
                    .enumerate()
                    .take_while(is_inside)
                    .map(|(_, half)| half)
                    .collect()
            }
        };
        Sector { node, corners }
    }
}

/// The course that a path is to take, about: off it, every step counts more.
#[derive(Debug, Clone)]
pub(in crate::layout) struct Guide {
    points: Vec<Vec3>,
    reach: f64,
}

/// The distance from a course, as a part of its length, at which a step counts twice.
const REACH: f64 = 0.1;

impl Guide {
    /// From points of the course, if they are not all one.
    pub fn new(points: Vec<Vec3>) -> Option<Self> {
        let steps = points.windows(2).map(|pair| norm(sub(pair[1], pair[0])));
        let reach = REACH * steps.sum::<f64>();
        (reach > 0.0).then_some(Guide { points, reach })
    }

    /// What a step to a point counts over its length.
    fn factor(&self, p: Vec3) -> f64 {
        let pieces = self.points.windows(2);
        let off = pieces.map(|pair| norm(sub(p, closest_on_segment([pair[0], pair[1]], p))));
        1.0 + off.fold(f64::INFINITY, f64::min) / self.reach
    }
}

/// A point of a path.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(in crate::layout) enum Point {
    Vertex(u32),
    /// The middle of the edge between two vertices.
    Middle(u32, u32),
}

/// A path and its length, in which steps count as its guide says.
#[derive(Debug, Clone)]
pub(in crate::layout) struct Path {
    pub points: Vec<Point>,
    pub length: f64,
}

/// What a search needs for each point, kept from one search to the next.
#[derive(Default)]
pub(in crate::layout) struct Search {
    length: Vec<f64>,
    from: Vec<u32>,
    touched: Vec<u32>,
}

/// An entry of the queue: the least length of a path by this point.
struct Entry {
    bound: f64,
    point: u32,
}

impl Ord for Entry {
    fn cmp(&self, other: &Self) -> Ordering {
        let by_bound = other.bound.total_cmp(&self.bound);
        by_bound.then_with(|| other.point.cmp(&self.point))
    }
}

impl PartialOrd for Entry {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

impl PartialEq for Entry {
    fn eq(&self, other: &Self) -> bool {
        self.cmp(other) == Ordering::Equal
    }
}

impl Eq for Entry {}

/// The search for one path. Points are numbered: vertices first, then edges by their lower half-edge.
struct Run<'a> {
    surface: &'a Surface,
    search: &'a mut Search,
    queue: BinaryHeap<Entry>,
    to: &'a Sector,
    goal: Vec3,
    guide: Option<&'a Guide>,
}

impl Search {
    /// The shortest path between two sectors, if there is one.
    pub fn shortest(
        &mut self,
        surface: &Surface,
        from: &Sector,
        to: &Sector,
        guide: Option<&Guide>,
    ) -> Option<Path> {
        let count = surface.positions.len() + surface.twin.len();
        self.touched
            .drain(..)
            .for_each(|p| self.length[p as usize] = f64::INFINITY);
        self.length
            .resize(count.max(self.length.len()), f64::INFINITY);
        self.from.resize(count.max(self.from.len()), NONE);
        let mut run = Run {
            surface,
            search: self,
            queue: BinaryHeap::new(),
            to,
            goal: surface.position(to.node),
            guide,
        };
        run.offer(from.node, from.node, 0.0);
        let start = run.queue.pop()?;
        for &corner in &from.corners {
            run.leave(start.point, corner / 3);
        }
        while let Some(Entry { point, .. }) = run.queue.pop() {
            if point == to.node {
                return Some(run.path(from.node));
            }
            if !run.is_settled(point) {
                run.settle(point);
            }
        }
        None
    }
}

/// The sign of a length tells that the point is settled.
impl Run<'_> {
    fn is_settled(&self, point: u32) -> bool {
        self.search.length[point as usize] < 0.0
    }

    fn settle(&mut self, point: u32) {
        let surface = self.surface;
        match (point as usize).checked_sub(surface.positions.len()) {
            None => surface
                .around(point)
                .for_each(|half| self.leave(point, half / 3)),
            Some(half) => {
                self.leave(point, half as u32 / 3);
                self.leave(point, surface.twin[half] / 3);
            }
        }
        self.search.length[point as usize] = -self.search.length[point as usize];
    }

    /// Goes on from a point to all others of a face.
    fn leave(&mut self, point: u32, face: u32) {
        let surface = self.surface;
        let at = self.place(point);
        let so_far = self.search.length[point as usize].abs();
        for half in 3 * face..3 * face + 3 {
            let vertex = surface.tail(half);
            let is_end = vertex == self.to.node && self.to.corners.contains(&half);
            if vertex != point && (is_end || !surface.is_taken[vertex as usize]) {
                self.offer(
                    vertex,
                    point,
                    so_far + self.step(at, surface.position(vertex)),
                );
            }
            let other = surface.twin[half as usize];
            if other != NONE && surface.may_be_split(half) {
                let middle = surface.positions.len() as u32 + half.min(other);
                if middle != point {
                    self.offer(middle, point, so_far + self.step(at, self.place(middle)));
                }
            }
        }
    }

    /// What a step counts.
    fn step(&self, from: Vec3, to: Vec3) -> f64 {
        norm(sub(to, from)) * self.guide.map_or(1.0, |guide| guide.factor(to))
    }

    fn offer(&mut self, point: u32, from: u32, length: f64) {
        let known = self.search.length[point as usize];
        if known >= 0.0 && length < known {
            if known == f64::INFINITY {
                self.search.touched.push(point);
            }
            self.search.length[point as usize] = length;
            self.search.from[point as usize] = from;
            let bound = length + norm(sub(self.goal, self.place(point)));
            self.queue.push(Entry { bound, point });
        }
    }

    fn place(&self, point: u32) -> Vec3 {
        match (point as usize).checked_sub(self.surface.positions.len()) {
            None => self.surface.position(point),
            Some(half) => {
                let half = half as u32;
                let ends = [self.surface.tail(half), self.surface.tip(half)];
                let [a, b] = ends.map(|v| self.surface.position(v));
                scale(add(a, b), 0.5)
            }
        }
    }

    fn path(&self, start: u32) -> Path {
        let vertices = self.surface.positions.len();
        let mut point = self.to.node;
        let mut points = Vec::new();
        loop {
            points.push(match (point as usize).checked_sub(vertices) {
                None => Point::Vertex(point),
                Some(half) => {
                    let half = half as u32;
                    Point::Middle(self.surface.tail(half), self.surface.tip(half))
                }
            });
            if point == start {
                break;
            }
            point = self.search.from[point as usize];
        }
        points.reverse();
        Path {
            points,
            length: self.search.length[self.to.node as usize].abs(),
        }
    }
}

/// Makes a path a chain of edges along which a dart runs, and gives its vertices.
pub(in crate::layout) fn lay(surface: &mut Surface, path: &Path, dart: Dart) -> Vec<u32> {
    let points = path.points.iter();
    let chain: Vec<u32> = points
        .filter_map(|&point| match point {
            Point::Vertex(v) => Some(v),
            Point::Middle(a, b) => {
                let half = surface.half_between(a, b)?;
                Some(surface.split_in_the_middle(half))
            }
        })
        .collect();
    for pair in chain.windows(2) {
        surface.take_edge(pair[0], pair[1], dart);
    }
    chain
}

/// The faces that are connected to a corner without crossing an arc.
pub(in crate::layout) fn reached(surface: &Surface, corner: u32) -> Vec<u32> {
    let mut is_in = vec![false; surface.triangles.len()];
    let mut open = vec![corner / 3];
    is_in[corner as usize / 3] = true;
    let mut next_one = 0;
    while let Some(&face) = open.get(next_one) {
        next_one += 1;
        let first = 3 * face;
        for half in [first, next(first), previous(first)] {
            let across = surface.twin[half as usize];
            if across != NONE
                && surface.dart[half as usize] == NONE
                && !std::mem::replace(&mut is_in[across as usize / 3], true)
            {
                open.push(across / 3);
            }
        }
    }
    open
}
