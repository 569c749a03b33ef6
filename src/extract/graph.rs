//! The graph of integer points and the lines between them, drawn on the surface.
//!
//! The graph is a rotation system. Every vertex has a counter-clockwise ring of ports, the ends of the lines
//! that leave it. Every port has a mate at the other end of its line. Ports and mates determine the faces.
//! Every move here keeps the drawing on the same surface.

use super::refined::NONE;

/// The place of an integer point on the mesh.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) enum Place {
    /// In a refined face, with these levels.
    Face(u32, [i64; 2]),
    /// An irregular vertex of the mesh.
    Vertex(u32),
    /// In the middle of a cell with these corners.
    Middle(Vec<u32>),
}

/// The end of a walk around a cell.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Walk {
    /// The walk returned to its start.
    Closed,
    /// The walk came to a line that leaves the surface.
    Cut,
    /// The walk came to the start of another walk, in the middle of a cell that is not closed.
    Met,
}

/// The graph.
#[derive(Debug, Default)]
pub(super) struct Graph {
    pub(super) places: Vec<Place>,
    /// The vertex of every port; none once the port is gone.
    pub(super) vertex: Vec<u32>,
    /// The port after every port around its vertex.
    pub(super) next: Vec<u32>,
    pub(super) previous: Vec<u32>,
    /// The port at the other end of the line; none where the line leaves the surface.
    pub(super) mate: Vec<u32>,
    /// Quarter turns of coordinates on the way to the mate.
    pub(super) turn: Vec<u8>,
    /// Where the line goes, in the coordinates of the port's face: 0 to 3 for +u, +v, -u, -v.
    pub(super) direction: Vec<u8>,
    /// Whether the cell to the left of the line, as it was traced, contains a part of the boundary. Ports that
    /// were added later are not in the list.
    pub(super) is_open: Vec<bool>,
}

impl Graph {
    /// Adds a vertex with ports in these directions, counter-clockwise.
    pub(super) fn add(&mut self, place: Place, directions: &[u8]) {
        let vertex = self.places.len() as u32;
        let (first, count) = (self.vertex.len() as u32, directions.len() as u32);
        self.places.push(place);
        for (i, &direction) in (0..count).zip(directions) {
            self.vertex.push(vertex);
            self.next.push(first + (i + 1) % count);
            self.previous.push(first + (i + count - 1) % count);
            self.mate.push(NONE);
            self.turn.push(0);
            self.direction.push(direction);
        }
    }

    /// How many vertices have ports.
    pub(super) fn live_vertices(&self) -> usize {
        let mut is_live = vec![false; self.places.len()];
        for &vertex in self.vertex.iter().filter(|&&vertex| vertex != NONE) {
            is_live[vertex as usize] = true;
        }
        is_live.into_iter().filter(|&is_live| is_live).count()
    }

    pub(super) fn port_count(&self) -> usize {
        self.vertex.len()
    }

    /// The mate of a port that is still there, if it has one.
    pub(super) fn mate(&self, port: u32) -> Option<u32> {
        let mate = self.mate[port as usize];
        (self.vertex[port as usize] != NONE && mate != NONE).then_some(mate)
    }

    /// Makes two ports the ends of one line.
    pub(super) fn join(&mut self, a: u32, b: u32, turn: u8) {
        self.mate[a as usize] = b;
        self.mate[b as usize] = a;
        self.turn[a as usize] = turn % 4;
        self.turn[b as usize] = (4 - turn % 4) % 4;
    }

    /// Whether a line comes back to the level that it left, because a fold of the map turned it around.
    pub(super) fn is_fold(&self, port: u32) -> bool {
        let Some(mate) = self.mate(port) else {
            return false;
        };
        let p = port as usize;
        (self.direction[p] + self.turn[p]) % 4 == self.direction[mate as usize]
    }

    /// Whether a cell contains a part of the boundary, as it was traced.
    pub(super) fn is_open(&self, cell: &[u32]) -> bool {
        let is_open = |&port: &u32| self.is_open.get(port as usize).is_some_and(|&open| open);
        cell.iter().any(is_open)
    }

    pub(super) fn next(&self, port: u32) -> u32 {
        self.next[port as usize]
    }

    pub(super) fn previous(&self, port: u32) -> u32 {
        self.previous[port as usize]
    }

    pub(super) fn vertex(&self, port: u32) -> u32 {
        self.vertex[port as usize]
    }

    /// The ports of the vertex of `port`, counter-clockwise from it.
    pub(super) fn ring(&self, port: u32) -> Vec<u32> {
        let mut ring = vec![port];
        let mut at = self.next(port);
        while at != port {
            ring.push(at);
            at = self.next(at);
        }
        ring
    }

    /// Walks around all cells, along lines that keep to the left: the ports at which its lines leave
    /// their vertices, and how the walk ended.
    pub(super) fn for_each_cell(&self, mut visit: impl FnMut(&[u32], Walk)) {
        let mut is_seen = vec![false; self.port_count()];
        let mut cell = Vec::new();
        for first in 0..self.port_count() as u32 {
            if self.vertex(first) == NONE || is_seen[first as usize] {
                continue;
            }
            cell.clear();
            let mut port = first;
            let end = loop {
                is_seen[port as usize] = true;
                cell.push(port);
                let Some(mate) = self.mate(port) else {
                    break Walk::Cut;
                };
                port = self.previous(mate);
                if port == first {
                    break Walk::Closed;
                }
                if is_seen[port as usize] {
                    break Walk::Met;
                }
            };
            visit(&cell, end);
        }
    }

    /// Removes a port from its ring.
    pub(super) fn remove(&mut self, port: u32) {
        let (before, after) = (self.previous(port), self.next(port));
        self.next[before as usize] = after;
        self.previous[after as usize] = before;
        self.vertex[port as usize] = NONE;
    }

    /// Removes the line of a port, at both ends.
    pub(super) fn remove_line(&mut self, port: u32) {
        let mate = self.mate[port as usize];
        self.remove(port);
        if mate != NONE {
            self.remove(mate);
        }
    }

    /// Removes a crossing of two lines, both of which then run through.
    pub(super) fn uncross(&mut self, port: u32) {
        let ring = self.ring(port);
        let half = ring.len() / 2;
        for i in 0..half {
            let (p, q) = (ring[i], ring[i + half]);
            let (a, b) = (self.mate[p as usize], self.mate[q as usize]);
            if a == q {
                continue;
            }
            match (a, b) {
                (NONE, NONE) => {}
                (NONE, end) | (end, NONE) => self.mate[end as usize] = NONE,
                (a, b) => {
                    let turn = self.turn[a as usize] + self.turn[q as usize];
                    self.join(a, b, turn);
                }
            }
        }
        for p in ring {
            self.remove(p);
        }
    }

    /// Contracts a line to one point: its two vertices become that of `port`.
    pub(super) fn contract(&mut self, port: u32) {
        let mate = self.mate[port as usize];
        let kept = self.vertex(port);
        let ring = self.ring(mate);
        for &p in &ring {
            self.vertex[p as usize] = kept;
        }
        let (before, after) = (self.previous(port), self.next(port));
        let (first, last) = (self.next(mate), self.previous(mate));
        let link = |graph: &mut Self, a: u32, b: u32| {
            graph.next[a as usize] = b;
            graph.previous[b as usize] = a;
        };
        match (before == port, first == mate) {
            (true, true) => {}
            (true, false) => link(self, last, first),
            (false, true) => link(self, before, after),
            (false, false) => {
                link(self, before, first);
                link(self, last, after);
            }
        }
        for p in [port, mate] {
            self.vertex[p as usize] = NONE;
        }
    }
}
