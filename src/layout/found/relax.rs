//! Smoothing of the quads of a simplified layout: regular vertices move to the middle of their neighbours, and from
//! there to the closest point of the surface. Irregular vertices, and all on lines that must stay, do not move.

use crate::extract::QuadMesh;
use crate::mesh::vector::{Vec3, add, norm, scale, sub};
use crate::mesh::{ClosestPoint, TriangleMesh};
use crate::smooth::QuadQuality;

/// A vertex closer to a line than this part of the mean edge of the triangles is on it.
const ON_LINE: f64 = 1e-6;

/// Smooths quads on the mesh that they were extracted from, whose edges `lines` stay lines of the quads. Does nothing
/// where that would invert a quad.
pub(super) fn relax(quads: &mut QuadMesh, mesh: &TriangleMesh, lines: &[usize], rounds: usize) {
    let before = quads.vertices.clone();
    let inverted = QuadQuality::new(quads).inverted;
    let mut neighbours: Vec<Vec<u32>> = vec![Vec::new(); quads.vertices.len()];
    for edge in quads.sides().chunk_by(|a, b| a.0 == b.0) {
        let [a, b] = edge[0].0;
        neighbours[a as usize].push(b);
        neighbours[b as usize].push(a);
    }
    let free = free(quads, mesh, lines, &neighbours);
    let surface = ClosestPoint::new(mesh);
    let mut hint = vec![None; quads.vertices.len()];
    for _ in 0..rounds {
        let last = quads.vertices.clone();
        for &v in &free {
            let around = &neighbours[v];
            let sum = around
                .iter()
                .fold([0.0; 3], |sum, &n| add(sum, last[n as usize]));
            let middle = scale(sum, 1.0 / around.len() as f64);
            if let Some((face, point)) = surface.find(middle, hint[v]) {
                hint[v] = Some(face);
                quads.vertices[v] = point;
            }
        }
    }
    if QuadQuality::new(quads).inverted > inverted {
        quads.vertices = before;
    }
}

/// The vertices that may move.
fn free(
    quads: &QuadMesh,
    mesh: &TriangleMesh,
    lines: &[usize],
    neighbours: &[Vec<u32>],
) -> Vec<usize> {
    let segment = |&edge: &usize| {
        let [a, b] = mesh.edge(edge).vertices.map(|v| mesh.position(v));
        [a, b, b]
    };
    let lines = ClosestPoint::of_triangles(lines.iter().map(segment).collect());
    let near = ON_LINE * mesh.mean_edge_length();
    let is_on_line = |p: Vec3| {
        let closest = lines.find(p, None);
        closest.is_some_and(|(_, point)| norm(sub(point, p)) < near)
    };
    let is_free = |&v: &usize| neighbours[v].len() == 4 && !is_on_line(quads.vertices[v]);
    (0..quads.vertices.len()).filter(is_free).collect()
}
