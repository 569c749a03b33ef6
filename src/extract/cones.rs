//! Lines that start at irregular vertices.

use super::graph::{Graph, Place};
use super::refined::{NONE, Refined};

/// A line that starts at a corner of a triangle.
#[derive(Debug, Clone, Copy)]
pub(super) struct Ray {
    /// The half-edge that starts at the corner.
    pub(super) corner: u32,
    /// The place on the border where it leaves the triangle.
    pub(super) towards: usize,
    pub(super) piece: u32,
    pub(super) end: u8,
    pub(super) direction: u8,
}

/// Adds every irregular vertex with its rays to the graph. Returns the port of each ray.
pub(super) fn add(mesh: &Refined, rays: &[Ray], graph: &mut Graph) -> Vec<u32> {
    let mut ports = vec![NONE; rays.len()];
    // Rays are ordered by face.
    let of_face = |face: u32| {
        let start = rays.partition_point(|ray| ray.corner / 3 < face);
        let end = rays.partition_point(|ray| ray.corner / 3 <= face);
        start..end
    };
    let mut is_done = vec![false; mesh.is_irregular.len()];
    for h in 0..mesh.twin.len() {
        let vertex = mesh.vertices[h / 3][h % 3];
        let is_new = mesh.is_irregular[vertex as usize] && !is_done[vertex as usize];
        if !is_new {
            continue;
        }
        is_done[vertex as usize] = true;
        let mut found = Vec::new();
        let mut corner = h as u32;
        loop {
            found.extend(of_face(corner / 3).filter(|&ray| rays[ray].corner == corner));
            // Counter-clockwise around the corner means over the edge that ends at it.
            let before = if corner.is_multiple_of(3) {
                corner + 2
            } else {
                corner - 1
            };
            corner = mesh.twin[before as usize];
            if corner == NONE || corner == h as u32 {
                break;
            }
        }
        let first = graph.port_count() as u32;
        for (i, &ray) in found.iter().enumerate() {
            ports[ray] = first + i as u32;
        }
        let directions: Vec<u8> = found.iter().map(|&ray| rays[ray].direction).collect();
        graph.add(Place::Vertex(vertex), &directions);
    }
    ports
}
