//! Traces integer lines from point to point over edges. Transitions turn the direction of a line.

use super::arrangement::{Arrangement, RAY};
use super::cones;
use super::graph::Graph;
use super::refined::{NONE, Refined};

/// The graph of all integer points.
pub(super) fn graph(mesh: &Refined, arrangement: &mut Arrangement) -> Graph {
    let mut graph = std::mem::take(&mut arrangement.points);
    let of_rays = cones::add(mesh, &arrangement.rays, &mut graph);
    let tracer = Tracer {
        mesh,
        arrangement,
        of_rays: &of_rays,
    };
    for (piece, chord) in arrangement.pieces.iter().enumerate() {
        for end in 0..2 {
            let port = chord.ports[end];
            if port != NONE {
                tracer.join(&mut graph, port, piece, end);
            }
        }
    }
    for (ray, &port) in arrangement.rays.iter().zip(&of_rays) {
        // If lines cross the ray in its first triangle, it is already joined to them.
        let piece = ray.piece as usize;
        if arrangement.pieces[piece].ports[usize::from(ray.end)] == NONE {
            tracer.join(&mut graph, port, piece, 1 - usize::from(ray.end));
        }
    }
    graph.is_open = vec![false; graph.port_count()];
    for &side in &arrangement.near_boundary {
        if let Some(port) = tracer.cell_left_of(&graph, side) {
            graph.is_open[port as usize] = true;
        }
    }
    graph
}

struct Tracer<'a> {
    mesh: &'a Refined,
    arrangement: &'a Arrangement,
    of_rays: &'a [u32],
}

impl Tracer<'_> {
    /// Joins a port to the port that its line reaches after it leaves a piece at an end.
    fn join(&self, graph: &mut Graph, port: u32, piece: usize, end: usize) {
        if graph.mate[port as usize] != NONE {
            return;
        }
        if let Some((mate, turn)) = self.follow(piece, end) {
            graph.join(port, mate, turn);
        }
    }

    /// A port of the cell to the left of a line that enters a triangle by this side of a crossing, if the line
    /// comes from an integer point.
    fn cell_left_of(&self, graph: &Graph, side: u32) -> Option<u32> {
        let at = self.arrangement.at_crossing[side as usize] as usize;
        let (piece, end) = (at / 2, at % 2);
        let ahead = match self.arrangement.pieces[piece].ports[end] {
            NONE => self.follow(piece, 1 - end)?.0,
            port => port,
        };
        graph.mate(ahead)
    }

    /// The port reached and the quarter turns on the way, or `None` if the line leaves the surface or returns to
    /// the piece without a port.
    fn follow(&self, mut piece: usize, mut end: usize) -> Option<(u32, u8)> {
        let start = (piece, end);
        let mut turn = 0;
        loop {
            let side = self.arrangement.pieces[piece].ends[end];
            if side & RAY != 0 {
                return Some((self.of_rays[(side & !RAY) as usize], turn));
            }
            let h = self.arrangement.half_edge[side as usize] as usize;
            if self.mesh.twin[h] == NONE {
                return None;
            }
            turn = (turn + self.mesh.turn[h]) % 4;
            let across = self.arrangement.at_crossing[(side ^ 1) as usize];
            (piece, end) = ((across / 2) as usize, (across % 2) as usize);
            let port = self.arrangement.pieces[piece].ports[end];
            if port != NONE {
                return Some((port, turn));
            }
            end = 1 - end;
            if (piece, end) == start {
                return None;
            }
        }
    }
}
