//! Moves of the drawing that turn the cells left by folds into quads.
//!
//! Where the map winds around a point more often than it should, removing folds leaves cells that
//! are not squares: an irregular vertex with a single line, and near it a cell of eight sides. The
//! parity of `i + j` changes along every line, and neither quarter turns nor the removal of folds
//! change that. Every cell that is a disk therefore has an even number of sides, and these moves
//! make quads of all:
//!
//! - a cell of two sides is closed, and a line that ends inside a cell or bounds nothing is removed;
//! - a vertex of two lines, a doublet (`daniels2008`), is removed with the edge between its two cells;
//! - of two lines between the same two vertices one is removed, if its two cells have four sides each;
//! - a cell of six or more sides gets a vertex in its middle, joined to every other one of its corners.

use super::graph::{Graph, Place, Walk};
use super::refined::NONE;

/// Doublets stay if only this many vertices are left: a cube is the smallest closed surface of quads.
const LEAST: usize = 8;

/// Makes the moves until none is possible. Returns their number.
pub(super) fn repair(graph: &mut Graph) -> usize {
    let mut moves = 0;
    let mut queue: Vec<u32> = (0..graph.port_count() as u32).rev().collect();
    let mut vertices = graph.live_vertices();
    while let Some(port) = queue.pop() {
        let Some(mate) = graph.mate(port) else {
            continue;
        };
        let around = [port, mate].map(|p| [p, graph.next(p), graph.previous(p)]);
        let closes_nothing = graph.vertex(port) == graph.vertex(mate) && graph.next(port) == mate;
        let is_end = graph.next(port) == port;
        if is_end || closes_nothing || sides(graph, port, 2) == Some(2) {
            graph.remove_line(port);
            vertices -= usize::from(is_end);
        } else if vertices > LEAST && is_doublet(graph, port) {
            let other = graph.next(port);
            let far = graph.mate[other as usize];
            queue.extend([far, graph.next(far), graph.previous(far)]);
            graph.remove_line(port);
            graph.remove_line(other);
            vertices -= 1;
        } else {
            continue;
        }
        moves += 1;
        for p in around.into_iter().flatten() {
            queue.extend([Some(p), graph.mate(p)].into_iter().flatten());
        }
    }
    moves += fill(graph);
    moves + part_doubles(graph)
}

/// Whether a vertex of two lines lies between two quads, its neighbours differ, and both keep three
/// lines or more. Otherwise one removal would make the next doublet, along every finger of the shape.
fn is_doublet(graph: &Graph, port: u32) -> bool {
    let other = graph.next(port);
    let (Some(a), Some(b)) = (graph.mate(port), graph.mate(other)) else {
        return false;
    };
    let valence = |p: u32| graph.ring(p).len();
    other != port
        && graph.next(other) == port
        && graph.vertex(a) != graph.vertex(b)
        && [a, b].into_iter().all(|p| valence(p) >= 4)
        && [port, other]
            .into_iter()
            .all(|p| sides(graph, p, 4) == Some(4))
}

/// The number of sides of the cell to the left of a line, if it is at most `most`.
fn sides(graph: &Graph, first: u32, most: usize) -> Option<usize> {
    let mut port = first;
    for count in 1..=most {
        port = graph.previous(graph.mate(port)?);
        if port == first {
            return Some(count);
        }
    }
    None
}

/// Removes one of two lines between the same vertices, and fills the cell of six sides that is left.
/// Returns the number of such cells.
fn part_doubles(graph: &mut Graph) -> usize {
    let mut lines: Vec<([u32; 2], u32)> = Vec::new();
    for port in 0..graph.port_count() as u32 {
        if let Some(mate) = graph.mate(port).filter(|&mate| port < mate) {
            let ends = [port, mate].map(|p| graph.vertex(p));
            lines.push(([ends[0].min(ends[1]), ends[0].max(ends[1])], port));
        }
    }
    lines.sort_unstable();
    let mut parted = 0;
    for pair in lines.windows(2).filter(|pair| pair[0].0 == pair[1].0) {
        let port = pair[1].1;
        let Some(mate) = graph.mate(port) else {
            continue;
        };
        let is_between_quads = [port, mate]
            .into_iter()
            .all(|p| sides(graph, p, 4) == Some(4));
        let after = graph.previous(mate);
        let cell = ring_of_six(graph, port, mate);
        let is_simple = cell.is_some_and(|cell| {
            let mut members = cell.map(|p| graph.vertex(p));
            members.sort_unstable();
            members.windows(2).all(|pair| pair[0] != pair[1])
        });
        if is_between_quads && is_simple {
            graph.remove_line(port);
            parted += fill_from(graph, after);
        }
    }
    parted
}

/// The cell that the quads on both sides of a line make together.
fn ring_of_six(graph: &Graph, port: u32, mate: u32) -> Option<[u32; 6]> {
    let step = |p: u32| Some(graph.previous(graph.mate(p)?));
    let a = step(port)?;
    let b = step(a)?;
    let c = step(b)?;
    let d = step(mate)?;
    let e = step(d)?;
    let f = step(e)?;
    Some([a, b, c, d, e, f])
}

/// Fills the cell to the left of a line. Returns the number of cells filled: 1, or 0 if it is open.
fn fill_from(graph: &mut Graph, first: u32) -> usize {
    let mut cell = vec![first];
    while let Some(mate) = graph.mate(cell[cell.len() - 1]) {
        let port = graph.previous(mate);
        if port == first {
            let start = better_half(graph, &cell);
            graph.fill(&cell[start..]);
            return 1;
        }
        cell.push(port);
    }
    0
}

/// Puts a vertex into every cell of six sides or more. Returns the number of such cells.
fn fill(graph: &mut Graph) -> usize {
    let mut large = Vec::new();
    graph.for_each_cell(|cell, end| {
        if end == Walk::Closed && cell.len() >= 6 && cell.len().is_multiple_of(2) {
            large.push(cell.to_vec());
        }
    });
    for cell in &large {
        graph.fill(&cell[better_half(graph, cell)..]);
    }
    large.len()
}

/// The half of a cell's corners that gets one line more: the even ones, 0, or the odd ones, 1.
fn better_half(graph: &Graph, cell: &[u32]) -> usize {
    let cost = |start: usize| -> i64 {
        let valence = |&port: &u32| graph.ring(port).len() as i64;
        let after = cell[start..].iter().step_by(2).map(valence);
        after.map(|v| (v - 3).pow(2) - (v - 4).pow(2)).sum()
    };
    usize::from(cost(1) < cost(0))
}

impl Graph {
    /// Joins the vertices of every other of these ports, which follow each other around a cell, to
    /// a new vertex in it.
    fn fill(&mut self, cell: &[u32]) {
        let corners: Vec<u32> = cell.iter().copied().step_by(2).collect();
        let center = self.places.len() as u32;
        let members = cell.iter().map(|&port| self.vertex(port)).collect();
        self.add(Place::Middle(members), &vec![0; corners.len()]);
        let first = self.port_count() as u32 - corners.len() as u32;
        debug_assert_eq!(self.vertex(first), center);
        for (i, &corner) in corners.iter().enumerate() {
            let spoke = self.port_count() as u32;
            let after = self.next(corner);
            self.vertex.push(self.vertex(corner));
            self.next.push(after);
            self.previous.push(corner);
            self.mate.push(NONE);
            self.turn.push(0);
            self.direction.push(0);
            self.next[corner as usize] = spoke;
            self.previous[after as usize] = spoke;
            self.join(spoke, first + i as u32, 0);
        }
    }
}
