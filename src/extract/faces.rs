//! The faces of the graph, found by walks along lines that keep to the left, and their corners' positions.

use super::graph::{Graph, Place, Walk};
use super::grid_map::ONE;
use super::place::barycentric;
use super::quad_mesh::{Origin, QuadMesh};
use super::refined::{NONE, Refined};
use crate::mesh::TriangleMesh;
use crate::mesh::vector::{Vec3, add, scale};

/// The mesh of all faces of the graph.
pub(super) fn quad_mesh(mesh: &TriangleMesh, refined: &Refined, graph: &Graph) -> QuadMesh {
    let mut quads = Vec::new();
    let mut others = Vec::new();
    let mut holes = Vec::new();
    let mut partial_cells = 0;
    graph.for_each_cell(|cell, end| {
        partial_cells += usize::from(end == Walk::Cut);
        if end != Walk::Closed {
            return;
        }
        let corners: Vec<u32> = cell.iter().map(|&port| graph.vertex(port)).collect();
        match <[u32; 4]>::try_from(corners) {
            Ok(quad) => {
                if graph.is_open(cell) {
                    holes.push(quads.len());
                }
                quads.push(quad);
            }
            Err(corners) => others.push(corners),
        }
    });
    let mut result = QuadMesh {
        vertices: Vec::new(),
        origins: Vec::new(),
        quads,
        others,
        partial_cells,
        folds_removed: 0,
        repaired: 0,
        folded: Vec::new(),
        expected_euler: mesh.euler_characteristic(),
    };
    place(mesh, refined, graph, &mut result);
    open_holes(&mut result, &holes);
    result
}

/// Removes the cells around holes of one unit square, where the Euler characteristic says that they are holes:
/// no line ends at their sides, so that they look like quads. Where folds were removed, the boundary may have been
/// in another cell.
fn open_holes(quads: &mut QuadMesh, holes: &[usize]) {
    let filled = quads.figures().euler - quads.expected_euler;
    if !holes.is_empty() && filled == holes.len() as i64 {
        let mut holes = holes.iter().peekable();
        let mut number = 0;
        quads.quads.retain(|_| {
            let is_hole = holes.next_if(|&&hole| hole == number).is_some();
            number += 1;
            !is_hole
        });
    }
}

/// Numbers the vertices that have faces, and computes their positions.
fn place(mesh: &TriangleMesh, refined: &Refined, graph: &Graph, result: &mut QuadMesh) {
    let mut number = vec![NONE; graph.places.len()];
    let used: Vec<u32> = result.faces().flatten().copied().collect();
    for vertex in used {
        number[vertex as usize] = 0;
    }
    for (vertex, number) in number.iter_mut().enumerate().filter(|(_, n)| **n == 0) {
        *number = result.vertices.len() as u32;
        let place = &graph.places[vertex];
        let origin = origin(refined, place);
        let position = match (origin, place) {
            (Origin::Middle, Place::Middle(corners)) => {
                let corners = corners.iter().map(|&v| &graph.places[v as usize]);
                mean(corners.map(|place| position(mesh, self::origin(refined, place))))
            }
            _ => position(mesh, origin),
        };
        result.origins.push(origin);
        result.vertices.push(position);
    }
    let rename = |v: &mut u32| *v = number[*v as usize];
    result.quads.as_flattened_mut().iter_mut().for_each(rename);
    result.others.iter_mut().flatten().for_each(rename);
}

fn origin(refined: &Refined, place: &Place) -> Origin {
    match place {
        Place::Vertex(vertex) => Origin::Vertex(*vertex as usize),
        Place::Face(face, levels) => {
            let at = barycentric(refined.corners[*face as usize], levels.map(|x| x * ONE));
            let (face, at) = refined.origin(*face as usize, at);
            Origin::Face(face, at)
        }
        Place::Middle(_) => Origin::Middle,
    }
}

fn position(mesh: &TriangleMesh, origin: Origin) -> Vec3 {
    match origin {
        Origin::Vertex(vertex) => mesh.position(vertex),
        Origin::Face(face, at) => {
            let corners = mesh.corner_positions(face);
            (0..3).fold([0.0; 3], |sum, k| add(sum, scale(corners[k], at[k])))
        }
        Origin::Middle => [0.0; 3],
    }
}

fn mean(points: impl Iterator<Item = Vec3>) -> Vec3 {
    let (sum, count) = points.fold(([0.0; 3], 0), |(sum, n), p| (add(sum, p), n + 1));
    scale(sum, 1.0 / f64::from(count))
}
