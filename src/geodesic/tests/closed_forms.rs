//! Distances that a formula gives.

use std::f64::consts::{PI, TAU};

use super::exact::distances;
use crate::geodesic::{Source, SurfacePoint};
use crate::mesh::TriangleMesh;
use crate::mesh::shape;
use crate::mesh::vector::{Vec3, norm, sub};

/// A grid of `columns` by `rows` squares, each two triangles, with the vertices at these places; `wraps` joins the
/// last column with the first.
fn grid(
    columns: usize,
    rows: usize,
    wraps: bool,
    place: impl Fn(usize, usize) -> Vec3,
) -> TriangleMesh {
    let width = if wraps { columns } else { columns + 1 };
    let count = width * (rows + 1);
    let vertices = (0..count).map(|i| place(i % width, i / width)).collect();
    let at = |i: usize, j: usize| (j * width + i % width) as u32;
    let mut triangles = Vec::new();
    for (i, j) in (0..columns * rows).map(|c| (c % columns, c / columns)) {
        let [a, b, c, d] = [at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)];
        triangles.extend([[a, b, c], [a, c, d]]);
    }
    TriangleMesh::new(vertices, triangles).unwrap()
}

#[test]
fn in_a_convex_plane_distances_are_those_of_space() {
    for name in ["plane", "disk"] {
        let mesh = shape::by_name(name, 20_000).unwrap();
        for source in [0, 137, mesh.vertex_count() / 2] {
            let found = distances(&mesh, &[Source::Vertex(source)]);
            for (v, d) in found.vertices().iter().enumerate() {
                let exact = norm(sub(mesh.position(v), mesh.position(source)));
                assert!(
                    (d - exact).abs() <= 1e-13 * exact,
                    "{name}: {d} is not {exact}"
                );
            }
        }
    }
}

/// A prism of `sides` flat sides is developed into a strip that repeats.
#[test]
fn a_cylinder_is_developed() {
    let (sides, rows, height) = (24, 30, 4.0);
    let mesh = grid(sides, rows, true, |i, j| {
        let angle = TAU * i as f64 / sides as f64;
        [angle.cos(), angle.sin(), height * j as f64 / rows as f64]
    });
    let side = 2.0 * (PI / sides as f64).sin();
    for source in [0, 5, 12 * sides + 7] {
        let found = distances(&mesh, &[Source::Vertex(source)]);
        for (v, d) in found.vertices().iter().enumerate() {
            let columns = (v % sides).abs_diff(source % sides);
            let around = side * columns.min(sides - columns) as f64;
            let rows_up = (v / sides).abs_diff(source / sides);
            let exact = around.hypot(height * rows_up as f64 / rows as f64);
            assert!(
                (d - exact).abs() <= 1e-13 * exact,
                "{v}: {d} is not {exact}"
            );
        }
    }
}

/// A cone without its apex region, of flat sides that are similar triangles cut off: paths do not reach the hole if
/// the source is far from it, and else pass the apex, which the mesh has.
#[test]
fn a_cone_is_developed() {
    for (sides, slope) in [(7, 0.3), (16, 0.9), (5, 0.6)] {
        let rows = 12;
        let place = |i: usize, r: f64| {
            let angle = TAU * i as f64 / f64::from(sides);
            let radius: f64 = slope * r;
            [
                radius * angle.cos(),
                radius * angle.sin(),
                -(r * r - radius * radius).sqrt(),
            ]
        };
        // Rows of vertices at distances 1, 2, ... from the apex, which is vertex 0.
        let mut vertices = vec![[0.0; 3]];
        let sides_count = sides as usize;
        for j in 1..=rows {
            vertices.extend((0..sides_count).map(|i| place(i, f64::from(j))));
        }
        let at = |i: usize, j: usize| (1 + (j - 1) * sides_count + i % sides_count) as u32;
        let mut triangles = Vec::new();
        for i in 0..sides_count {
            triangles.push([0, at(i, 1), at(i + 1, 1)]);
            for j in 1..rows as usize {
                let [a, b, c, d] = [at(i, j), at(i, j + 1), at(i + 1, j + 1), at(i + 1, j)];
                triangles.extend([[a, b, c], [a, c, d]]);
            }
        }
        let mesh = TriangleMesh::new(vertices, triangles).unwrap();
        // The angle of a side at the apex, in its plane.
        let side = 2.0 * (slope * (PI / f64::from(sides)).sin()).asin();
        let source = at(2, 7) as usize;
        let found = distances(&mesh, &[Source::Vertex(source)]);
        for j in 1..=rows {
            for i in 0..sides_count {
                let columns = i.abs_diff(2);
                let turn = side * columns.min(sides_count - columns) as f64;
                let r = f64::from(j);
                let exact = match turn < PI {
                    true => (r * r + 49.0 - 14.0 * r * turn.cos()).sqrt(),
                    false => r + 7.0,
                };
                let d = found.vertices()[at(i, j as usize) as usize];
                assert!(
                    (d - exact).abs() <= 1e-13 * 7.0,
                    "{i}, {j}: {d} is not {exact}"
                );
            }
        }
    }
}

/// On a cube, a shortest path crosses at most a few sides; all unfoldings of strips of sides are tried.
#[test]
fn a_box_is_unfolded() {
    let n = 6;
    let size = [1.0, 2.0, 3.0];
    let mesh = cuboid(n, size);
    for source in [0, 17, 80] {
        let from = mesh.position(source);
        let found = distances(&mesh, &[Source::Vertex(source)]);
        for (v, d) in found.vertices().iter().enumerate() {
            let exact = on_box(size, from, mesh.position(v));
            assert!(
                (d - exact).abs() < 1e-13,
                "{source} to {v}: {d} is not {exact}"
            );
        }
    }
}

/// A box with one corner at the origin; its sides are grids of `n` by `n`.
fn cuboid(n: usize, size: Vec3) -> TriangleMesh {
    let mut vertices: Vec<Vec3> = Vec::new();
    let mut triangles = Vec::new();
    let mut number = |p: Vec3| {
        let found = vertices.iter().position(|q| norm(sub(*q, p)) < 1e-9);
        found.unwrap_or_else(|| {
            vertices.push(p);
            vertices.len() - 1
        }) as u32
    };
    for axis in 0..3 {
        for high in [false, true] {
            let (u, v) = ((axis + 1) % 3, (axis + 2) % 3);
            let mut at = |i: usize, j: usize| {
                let mut p = [0.0; 3];
                p[axis] = if high { size[axis] } else { 0.0 };
                p[u] = size[u] * i as f64 / n as f64;
                p[v] = size[v] * j as f64 / n as f64;
                number(p)
            };
            for (i, j) in (0..n * n).map(|c| (c % n, c / n)) {
                let [a, b, c, d] = [at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)];
                match high {
                    true => triangles.extend([[a, b, c], [a, c, d]]),
                    false => triangles.extend([[a, c, b], [a, d, c]]),
                }
            }
        }
    }
    TriangleMesh::new(vertices, triangles).unwrap()
}

/// The distance of two points on a box, by rolling the box over its edges: the least over all ways to roll it at
/// most four times. A way that rolls to one side and never back winds around no corner, so its straight line is no
/// shorter than a path.
fn on_box(size: Vec3, p: Vec3, q: Vec3) -> f64 {
    let mut best = f64::INFINITY;
    for axis in 0..3 {
        for high in [false, true] {
            let at = if high { size[axis] } else { 0.0 };
            if (p[axis] - at).abs() > 1e-12 {
                continue;
            }
            let (u, v) = ((axis + 1) % 3, (axis + 2) % 3);
            // The side lies in the plane of the first two coordinates, the box above it.
            let lift = |r: Vec3| {
                [
                    r[u],
                    r[v],
                    if high { size[axis] - r[axis] } else { r[axis] },
                ]
            };
            let box_size = [size[u], size[v], size[axis]];
            for ways in [[true, true], [true, false], [false, true], [false, false]] {
                roll(box_size, lift(p), lift(q), [0.0; 2], ways, 4, &mut best);
            }
        }
    }
    best
}

/// `q` in the coordinates of a box that stands on a side whose low corner is at `offset`; `p` is where it was at
/// first. `ways` tells whether the box rolls to higher coordinates.
fn roll(
    size: Vec3,
    p: Vec3,
    q: Vec3,
    offset: [f64; 2],
    ways: [bool; 2],
    left: usize,
    best: &mut f64,
) {
    if q[2].abs() < 1e-12 {
        let to = [q[0] + offset[0] - p[0], q[1] + offset[1] - p[1]];
        *best = best.min(to[0].hypot(to[1]));
    }
    if left == 0 {
        return;
    }
    let [a, b, c] = size;
    let [x, y, z] = q;
    let [s, t] = offset;
    let (moved, to) = match ways[0] {
        true => ([z, y, a - x], [s + a, t]),
        false => ([c - z, y, x], [s - c, t]),
    };
    roll([c, b, a], p, moved, to, ways, left - 1, best);
    let (moved, to) = match ways[1] {
        true => ([x, z, b - y], [s, t + b]),
        false => ([x, c - z, y], [s, t - c]),
    };
    roll([a, c, b], p, moved, to, ways, left - 1, best);
}

#[test]
fn a_vertex_as_a_point_is_the_same_source() {
    let mesh = shape::by_name("genus-2", 2_000).unwrap();
    let vertex = distances(&mesh, &[Source::Vertex(77)]);
    let point = distances(&mesh, &[Source::Point(SurfacePoint::vertex(&mesh, 77))]);
    assert_eq!(vertex, point);
}
