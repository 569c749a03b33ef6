//! Walls: edges of quads that divide a surface into rectangles.
//!
//! The lines that leave irregular vertices, and the boundary, leave no irregular vertex and no reflex corner inside
//! a region. A region is then flat, and by the theorem of Gauss and Bonnet it is a rectangle with four corners, a ring
//! without corners, or a whole torus. One more line opens a ring, and two open a torus.

use std::collections::HashSet;

use super::QuadSurface;
use super::layout::arcs;
use super::rectangle::Rectangle;

const NONE: u32 = u32::MAX;

/// Where a line ends that is added to open a ring or a torus.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum LineEnd {
    /// At the boundary, or where it closes: lines cross.
    Closed,
    /// At the first wall.
    Wall,
}

/// The edges that are walls.
pub(super) struct Walls<'a> {
    pub(super) surface: &'a QuadSurface,
    is_wall: Vec<bool>,
}

impl<'a> Walls<'a> {
    /// The boundary as walls.
    pub(super) fn boundary(surface: &'a QuadSurface) -> Self {
        let outside = |h: usize| surface.is_outside(h) || surface.is_outside(surface.twin(h));
        Walls {
            surface,
            is_wall: (0..surface.half_edges()).map(outside).collect(),
        }
    }

    /// Makes the edge of a half-edge a wall.
    pub(super) fn add(&mut self, h: usize) {
        self.is_wall[h] = true;
        self.is_wall[self.surface.twin(h)] = true;
    }

    /// Whether the edge of a half-edge is a wall.
    pub(super) fn contains(&self, h: usize) -> bool {
        self.is_wall[h]
    }

    /// Whether walls do more at a vertex than pass straight through, or the vertex is irregular.
    pub(super) fn is_node(&self, vertex: usize) -> bool {
        if self.surface.is_irregular(vertex) {
            return true;
        }
        let mut walls = self.surface.around(vertex).map(|h| self.is_wall[h]);
        match self.surface.is_boundary(vertex) {
            // Of three edges, those at the boundary are walls.
            true => walls.nth(1) == Some(true),
            false => {
                let walls: Vec<bool> = walls.collect();
                let pairs = [walls[0] || walls[2], walls[1] || walls[3]];
                pairs == [true, true]
            }
        }
    }

    /// The vertices that are nodes, in increasing order.
    pub(super) fn nodes(&self) -> Vec<u32> {
        let vertices = 0..self.surface.positions().len();
        let nodes = vertices.filter(|&v| self.is_node(v));
        nodes.map(|v| v as u32).collect()
    }

    /// Adds a line across the middle of an arc that joins the same nodes as a shorter one, or returns to its node.
    /// Gives whether there was one.
    pub(super) fn divide_a_parallel_arc(&mut self) -> bool {
        let (mut arcs, _) = arcs(self, &self.nodes());
        arcs.sort_by_key(|arc| arc.vertices.len());
        let mut joined = HashSet::new();
        let parallel = arcs.iter().find(|arc| {
            let [from, to] = arc.nodes;
            !joined.insert([from.min(to), from.max(to)]) || from == to
        });
        let Some(arc) = parallel.filter(|arc| arc.vertices.len() > 2) else {
            return false;
        };
        let middle = arc.vertices[arc.vertices.len() / 2] as usize;
        let across = self.surface.around(middle).find(|&h| !self.is_wall[h]);
        let line = across.map(|h| self.line(h, LineEnd::Closed));
        line.into_iter().flatten().for_each(|h| self.add(h));
        true
    }

    /// The rectangles between the walls, after lines were added that open rings and tori.
    ///
    /// A ring is opened by the line across it that has the fewest edges, of equals by that from the lowest vertex. A
    /// torus becomes a ring by the shorter line through its lowest vertex, which is like all others.
    pub(super) fn rectangles(&mut self, end: LineEnd) -> Vec<Rectangle> {
        loop {
            let (rectangles, rectangle_of) = Rectangle::all(self);
            let added = self.open(&rectangle_of, end);
            if !added {
                return rectangles;
            }
        }
    }

    /// Adds a line to every region that is no rectangle, unless the line of another runs through it. Gives whether
    /// there was one.
    fn open(&mut self, rectangle_of: &[u32], end: LineEnd) -> bool {
        let mut is_done: Vec<bool> = rectangle_of.iter().map(|&r| r != NONE).collect();
        let is_rectangle = !is_done.contains(&false);
        for face in 0..is_done.len() {
            if is_done[face] {
                continue;
            }
            let region = self.region(face, &mut is_done);
            for h in self.opening(&region, end) {
                is_done[h / 4] = true;
                self.add(h);
            }
        }
        !is_rectangle
    }

    /// The faces of a region, which are marked.
    fn region(&self, face: usize, is_done: &mut [bool]) -> Vec<usize> {
        let mut region = vec![face];
        is_done[face] = true;
        let mut next = 0;
        while let Some(&face) = region.get(next) {
            next += 1;
            for h in 4 * face..4 * face + 4 {
                let across = self.surface.twin(h) / 4;
                if !self.is_wall[h] && !std::mem::replace(&mut is_done[across], true) {
                    region.push(across);
                }
            }
        }
        region
    }

    /// The edges of the line that opens a region without corners.
    fn opening(&self, region: &[usize], end: LineEnd) -> Vec<usize> {
        let surface = self.surface;
        let sides = region.iter().flat_map(|&face| 4 * face..4 * face + 4);
        let lowest = sides.clone().map(|h| surface.from(h)).min();
        // Half-edges that leave a wall on their right.
        let is_across = |h: &usize| !self.is_wall[*h] && self.is_wall[surface.before(*h)];
        let across: Vec<usize> = sides.clone().filter(is_across).collect();
        let starts = match across.is_empty() {
            true => sides.filter(|&h| Some(surface.from(h)) == lowest).collect(),
            false => across,
        };
        let lines = starts
            .into_iter()
            .map(|h| (surface.from(h), self.line(h, end)));
        let shortest = lines.min_by_key(|(from, line)| (line.len(), *from));
        shortest.map(|(_, line)| line).unwrap_or_default()
    }

    /// The edges of the line through a half-edge.
    fn line(&self, first: usize, end: LineEnd) -> Vec<usize> {
        let surface = self.surface;
        let is_wall_at = |v: u32| surface.around(v as usize).any(|h| self.is_wall[h]);
        let mut line = vec![first];
        let mut h = first;
        while !(end == LineEnd::Wall && is_wall_at(surface.to(h))) {
            match surface.straight(h) {
                Some(next) if next == first => return line,
                Some(next) => h = next,
                None => break,
            }
            line.push(h);
        }
        if end == LineEnd::Closed {
            // The part before the first edge.
            h = surface.twin(first);
            while let Some(next) = surface.straight(h) {
                line.push(next);
                h = next;
            }
        }
        line
    }
}
