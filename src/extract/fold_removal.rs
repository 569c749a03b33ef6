//! Removal of folds: lines that cross twice in opposite directions are pulled apart.
//!
//! Where the map folds, an integer point has several preimages, one more of positive than of negative
//! orientation, and lines return to the level that they left. `ebke2013`, section 6, joins such points by
//! rules for each case. This file needs only three moves of the drawing. None of them changes the surface:
//!
//! - two lines that bound an empty lens cross at two points of opposite orientation: both points are
//!   removed, and the lines pass each other;
//! - a line that leaves an irregular vertex and comes back at once is removed;
//! - a line without length between an irregular vertex and a point is contracted to one point.
//!
//! On a disk, two families of lines without lenses have the least number of crossings (the bigon criterion),
//! so folds away from irregular vertices leave no trace. At an irregular vertex, the number of lines that
//! remain is the number of quarter turns of the coordinates around the whole fold.
//! folded together.

use std::collections::VecDeque;

use super::graph::{Graph, Place};

/// Removes folds until there are none. Returns the number of points removed or joined.
pub(super) fn remove_folds(graph: &mut Graph) -> usize {
    let before = graph.live_vertices();
    let mut queue: VecDeque<u32> = (0..graph.port_count() as u32)
        .filter(|&port| graph.is_fold(port))
        .collect();
    settle(graph, &mut queue);
    for joins in [joins_irregular, joins_any] {
        loop {
            let mut is_changed = false;
            for port in 0..graph.port_count() as u32 {
                if !graph.is_fold(port) || !joins(graph, port) {
                    continue;
                }
                is_changed = true;
                let mate = graph.mate[port as usize];
                let kept = match graph.places[graph.vertex(port) as usize] {
                    Place::Vertex(_) => port,
                    _ => mate,
                };
                let around = neighbours(graph, &[port, mate]);
                if graph.vertex(port) == graph.vertex(mate) {
                    graph.remove_line(port);
                } else {
                    graph.contract(kept);
                }
                queue.extend(around);
                settle(graph, &mut queue);
            }
            if !is_changed {
                break;
            }
        }
    }
    before - graph.live_vertices()
}

/// A line between different vertices, one of them irregular.
fn joins_irregular(graph: &Graph, port: u32) -> bool {
    let ends = [port, graph.mate[port as usize]].map(|p| graph.vertex(p));
    let is_irregular = |v: u32| matches!(graph.places[v as usize], Place::Vertex(_));
    ends[0] != ends[1] && ends.into_iter().any(is_irregular)
}

fn joins_any(_: &Graph, _: u32) -> bool {
    true
}

/// Removes lenses and loops until none is left.
fn settle(graph: &mut Graph, queue: &mut VecDeque<u32>) {
    while let Some(port) = queue.pop_front() {
        if !graph.is_fold(port) {
            continue;
        }
        let mate = graph.mate[port as usize];
        if graph.next(port) == mate || graph.next(mate) == port {
            let around = neighbours(graph, &[port, mate]);
            graph.remove_line(port);
            queue.extend(around);
        } else if let Some(lens) = lens(graph, port).or_else(|| lens(graph, mate)) {
            let around = neighbours(graph, &lens);
            // The first may take lines of the second along, but not its ports.
            graph.uncross(lens[0]);
            graph.uncross(lens[1]);
            queue.extend(around);
        }
    }
}

/// Two ports, one at each corner of the lens to the left of a line, if there is one: a face of two
/// lines that fold, between two plain crossings.
fn lens(graph: &Graph, port: u32) -> Option<[u32; 2]> {
    let mate = graph.mate[port as usize];
    let other = graph.next(port);
    let is_lens = graph.is_fold(other)
        && graph.mate[other as usize] == graph.previous(mate)
        && other != mate
        && graph.vertex(port) != graph.vertex(mate)
        && is_crossing(graph, port)
        && is_crossing(graph, mate);
    is_lens.then_some([port, mate])
}

/// Whether the vertex of a port is a crossing of two lines as it was found.
fn is_crossing(graph: &Graph, port: u32) -> bool {
    let is_face = matches!(graph.places[graph.vertex(port) as usize], Place::Face(..));
    let around = graph.next(graph.next(graph.next(graph.next(port))));
    is_face && around == port && graph.next(graph.next(port)) != port
}

/// The ports of the vertices of these ports, and the neighbours of their mates. A move may make another move
/// possible there.
fn neighbours(graph: &Graph, ports: &[u32]) -> Vec<u32> {
    let mut found = Vec::new();
    for &port in ports {
        for p in graph.ring(port) {
            found.push(p);
            if let Some(mate) = graph.mate(p) {
                found.extend([mate, graph.next(mate), graph.previous(mate)]);
            }
        }
    }
    found
}
