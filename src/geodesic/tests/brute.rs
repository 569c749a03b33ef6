//! An exhaustive search for shortest paths on tiny meshes, which shares nothing with the propagation.
//!
//! Between vertices where it bends, a shortest path is straight in an unfolded strip of faces, each of which it
//! visits once. All such strips are unfolded from every vertex, as complex numbers; then distances over several
//! bends follow by the algorithm of Floyd and Warshall. Nothing is left out but what cannot be seen.

use crate::mesh::TriangleMesh;
use crate::mesh::vector::{dot, norm, sub};

type Point = [f64; 2];

/// All distances between vertices.
pub(super) fn all_distances(mesh: &TriangleMesh) -> Vec<Vec<f64>> {
    let count = mesh.vertex_count();
    let mut table = vec![vec![f64::INFINITY; count]; count];
    for v in 0..count {
        table[v][v] = 0.0;
        for (f, k) in mesh.ring(v) {
            let c = mesh.corners(f);
            let (a, b) = (c[(k + 1) % 3], c[(k + 2) % 3]);
            let from = mesh.position(v);
            let (la, lb) = (
                norm(sub(mesh.position(a), from)),
                norm(sub(mesh.position(b), from)),
            );
            table[v][a] = table[v][a].min(la);
            table[v][b] = table[v][b].min(lb);
            let angle = mesh.angle(f, k);
            let mut visited = vec![false; mesh.face_count()];
            visited[f] = true;
            let edge = [[la, 0.0], [lb * angle.cos(), lb * angle.sin()]];
            strip(
                mesh,
                (f, (k + 1) % 3),
                edge,
                edge,
                &mut visited,
                &mut table[v],
            );
        }
    }
    for k in 0..count {
        for i in 0..count {
            for j in 0..count {
                table[i][j] = table[i][j].min(table[i][k] + table[k][j]);
            }
        }
    }
    table
}

/// Unfolds what lies across an edge, seen from the origin between two directions, right before left.
fn strip(
    mesh: &TriangleMesh,
    (face, k): (usize, usize),
    edge: [Point; 2],
    view: [Point; 2],
    visited: &mut [bool],
    found: &mut [f64],
) {
    let Some((across, j)) = mesh.neighbor(face, k) else {
        return;
    };
    if visited[across] {
        return;
    }
    // Across the edge runs the other way: from the left end to the right end.
    let c = mesh.corners(across);
    let [from, to, top] = [c[j], c[(j + 1) % 3], c[(j + 2) % 3]].map(|v| mesh.position(v));
    let base = sub(to, from);
    let side = sub(top, from);
    let length = norm(base);
    let along = dot(base, side) / length;
    let height = (dot(side, side) - along * along).max(0.0).sqrt();
    let [right, left] = edge;
    let axis = [(right[0] - left[0]) / length, (right[1] - left[1]) / length];
    let apex = [
        left[0] + along * axis[0] - height * axis[1],
        left[1] + along * axis[1] + height * axis[0],
    ];
    let tolerance = 1e-12 * (apex[0].abs() + apex[1].abs());
    let sees = |d: Point, p: Point| cross(d, p) / (d[0].hypot(d[1]));
    if sees(view[0], apex) >= -tolerance && sees(view[1], apex) <= tolerance {
        let v = c[(j + 2) % 3];
        found[v] = found[v].min(apex[0].hypot(apex[1]));
    }
    visited[across] = true;
    for (next, edge) in [((j + 2) % 3, [apex, left]), ((j + 1) % 3, [right, apex])] {
        let from = if cross(view[0], edge[0]) > 0.0 {
            edge[0]
        } else {
            view[0]
        };
        let to = if cross(view[1], edge[1]) < 0.0 {
            edge[1]
        } else {
            view[1]
        };
        if cross(from, to) > 0.0 {
            strip(mesh, (across, next), edge, [from, to], visited, found);
        }
    }
    visited[across] = false;
}

fn cross(a: Point, b: Point) -> f64 {
    a[0] * b[1] - a[1] * b[0]
}
