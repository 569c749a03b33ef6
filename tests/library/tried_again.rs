//! Meshes whose first quads do not conform: several components of which one is hard, and holes smaller than a
//! quad.

use roundel::Monitor;
use roundel::extract::Origin;
use roundel::map::Sizing;
use roundel::mesh::{TriangleMesh, shape};
use roundel::quad::{QuadOptions, Quadrangulation, quadrangulate};

/// A flat square of `n` by `n` units without every third unit square: holes of four corners.
fn sieve(n: u32) -> TriangleMesh {
    let at = |i: u32, j: u32| i * (n + 1) + j;
    let points = (0..=n).flat_map(|i| (0..=n).map(move |j| [f64::from(i), f64::from(j), 0.0]));
    let squares = (0..n).flat_map(|i| (0..n).map(move |j| (i, j)));
    let is_hole = |&(i, j): &(u32, u32)| i % 3 == 1 && j % 3 == 1;
    let triangles = squares
        .filter(|square| !is_hole(square))
        .flat_map(|(i, j)| {
            let [a, b, c, d] = [at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)];
            [[a, b, c], [a, c, d]]
        });
    TriangleMesh::new(points.collect(), triangles.collect()).unwrap()
}

/// Two meshes as the components of one.
fn beside(a: &TriangleMesh, b: &TriangleMesh, far: f64) -> TriangleMesh {
    let first = a.vertex_count() as u32;
    let mut points = a.vertices().to_vec();
    points.extend(b.vertices().iter().map(|p| [p[0] + far, p[1], p[2]]));
    let mut triangles = a.triangles().to_vec();
    triangles.extend(b.triangles().iter().map(|t| t.map(|v| v + first)));
    TriangleMesh::new(points, triangles).unwrap()
}

fn quads(mesh: &TriangleMesh, count: usize) -> Quadrangulation {
    let options = QuadOptions {
        sizing: Sizing::Quads(count),
        ..QuadOptions::default()
    };
    quadrangulate(mesh, &options, Monitor::default).unwrap()
}

#[test]
fn holes_smaller_than_a_quad_stay_open() {
    let mesh = sieve(6);
    let made = quads(&mesh, 12);
    assert!(made.quads.is_conforming(), "{:?}", made.quads.figures());
    assert_eq!(made.quads.figures().euler, -3);
    assert!(made.apart.is_empty());
}

#[test]
fn a_hard_component_has_quads_of_its_own_and_the_other_keeps_its_quads() {
    let cube = shape::by_name("rounded-cube", 600).unwrap();
    let mesh = beside(&cube, &sieve(9), 20.0);
    let made = quads(&mesh, 20);
    assert!(made.quads.is_conforming(), "{:?}", made.quads.figures());
    assert_eq!(made.quads.figures().euler, 2 - 8);
    let hard: Vec<usize> = (cube.face_count()..mesh.face_count()).collect();
    assert_eq!(made.apart, hard);
    // Places are those of the whole mesh.
    for (origin, p) in made.quads.origins.iter().zip(&made.quads.vertices) {
        let x = match *origin {
            Origin::Vertex(v) => mesh.position(v)[0],
            Origin::Face(f, _) => mesh.corner_positions(f)[0][0],
            Origin::Middle => continue,
        };
        assert_eq!(x > 10.0, p[0] > 10.0);
    }
    for &edge in made.features.iter().chain(&made.missed_features) {
        assert!(mesh.edge(edge).second.is_none());
    }
    // Once more, the same.
    assert_eq!(quads(&mesh, 20).quads, made.quads);
}

#[test]
fn components_tried_side_by_side_have_the_same_quads_as_one_after_the_other() {
    let mut mesh = shape::by_name("rounded-cube", 600).unwrap();
    for (k, n) in [9, 6, 12, 9].into_iter().enumerate() {
        mesh = beside(&mesh, &sieve(n), 20.0 * (1.0 + k as f64));
    }
    let [one, two, five] = [1, 2, 5].map(|threads| {
        let mut options = QuadOptions {
            sizing: Sizing::Quads(30),
            ..QuadOptions::default()
        };
        options.field.threads = threads;
        quadrangulate(&mesh, &options, Monitor::default).unwrap()
    });
    assert!(one.apart.len() > sieve(9).face_count());
    for other in [two, five] {
        assert_eq!(other.quads, one.quads);
        assert_eq!(other.apart, one.apart);
    }
}
