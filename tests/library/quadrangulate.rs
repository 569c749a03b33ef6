//! From a mesh to quads in one call: properties of the quads that hold whatever the solver decides.

use roundel::extract::{Origin, QuadMesh};
use roundel::field::{Constraint, Guidance};
use roundel::map::Sizing;
use roundel::mesh::{TriangleMesh, shape};
use roundel::quad::{QuadOptions, Quadrangulation, quadrangulate};
use roundel::smooth::{QuadQuality, SmoothOptions, smooth};
use roundel::{Monitor, Strategy};

/// A flat square of `n` by `n` units, with two triangles for each unit square.
fn plane(n: usize) -> TriangleMesh {
    let at = |i: usize, j: usize| (i * (n + 1) + j) as u32;
    let points = (0..=n).flat_map(|i| (0..=n).map(move |j| [i as f64, j as f64, 0.0]));
    let squares = (0..n).flat_map(|i| (0..n).map(move |j| (i, j)));
    let triangles = squares.flat_map(|(i, j)| {
        let [a, b, c, d] = [at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)];
        [[a, b, c], [a, c, d]]
    });
    TriangleMesh::new(points.collect(), triangles.collect()).unwrap()
}

/// Quads of edge length 4, with feature lines across the square at the given heights.
fn with_lines(mesh: &TriangleMesh, n: usize, heights: &[usize]) -> Quadrangulation {
    let lines = heights
        .iter()
        .flat_map(|&j| (0..n).map(move |i| [i, i + 1].map(|i| i * (n + 1) + j)));
    let options = QuadOptions {
        sizing: Sizing::EdgeLength(4.0),
        guidance: Guidance {
            feature_lines: lines.collect(),
            ..Guidance::default()
        },
        ..QuadOptions::default()
    };
    quadrangulate(mesh, &options, Monitor::default).unwrap()
}

#[test]
fn lines_closer_than_a_quad_is_wide_are_both_kept() {
    let mesh = plane(20);
    let heights = |made: &Quadrangulation| {
        let mut heights: Vec<f64> = made.quads.vertices.iter().map(|p| p[1]).collect();
        heights.sort_by(f64::total_cmp);
        heights.dedup_by(|a, b| (*a - *b).abs() < 1e-9);
        heights
    };
    let made = with_lines(&mesh, 20, &[11, 12]);
    assert!(made.quads.is_conforming() && made.missed_features.is_empty());
    for height in [11.0, 12.0] {
        assert!(heights(&made).iter().any(|h| (h - height).abs() < 1e-9));
    }
    // A single line needs no extra strip.
    let one = with_lines(&mesh, 20, &[12]);
    assert_eq!(heights(&made).len(), heights(&one).len() + 1);
}

#[test]
fn strategies_are_compared_in_the_requested_order() {
    let options = QuadOptions {
        sizing: Sizing::Quads(25),
        compare: vec![Strategy::Direct, Strategy::Relax],
        ..QuadOptions::default()
    };
    let made = quadrangulate(&plane(6), &options, Monitor::default).unwrap();
    let order: Vec<Strategy> = made.compared.iter().map(|one| one.strategy).collect();
    assert_eq!(order, options.compare);
}

fn of(shape: &TriangleMesh, quads: usize, change: impl Fn(&mut QuadOptions)) -> Quadrangulation {
    let mut options = QuadOptions {
        sizing: Sizing::Quads(quads),
        ..QuadOptions::default()
    };
    change(&mut options);
    quadrangulate(shape, &options, Monitor::default).unwrap()
}

#[test]
fn trying_smaller_curvature_weights_makes_quads_more_even() {
    let mesh = shape::by_name("genus-1", 2000).unwrap();
    let spread = |vary: bool| {
        let made = of(&mesh, 800, |options| options.vary_curvature = vary);
        assert!(made.quads.is_conforming());
        QuadQuality::new(&made.quads).edge_spread
    };
    let (one, several) = (spread(false), spread(true));
    assert!(several < 0.8 * one, "{several} and {one}");
}

#[test]
fn curvature_weights_are_not_varied_without_curvature_guidance() {
    let mesh = shape::by_name("genus-2", 1000).unwrap();
    let field = |vary: bool| {
        let made = of(&mesh, 300, |options| {
            (options.guidance, options.vary_curvature) = (Guidance::default(), vary);
        });
        made.field
    };
    assert_eq!(field(false), field(true));
}

#[test]
fn larger_details_are_tried_before_smaller_quads_unless_the_detail_is_given() {
    let mesh = shape::by_name("genus-3", 1000).unwrap();
    let edge = (mesh.surface_area() / 20.0).sqrt();
    let given = of(&mesh, 20, |options| {
        options.guidance.detail = Some(0.25 * edge);
        // No edge is as sharp, and none becomes a feature where quads do not conform.
        options.guidance.feature_angle = Some(std::f64::consts::PI);
        options.refine = false;
    });
    let free = of(&mesh, 20, |_| {});
    assert!(free.quads.is_conforming());
    // Only smaller quads around folds are left for the other one, whose details have irregular vertices.
    let irregular = |made: &Quadrangulation| made.quads.figures().irregular;
    assert!(irregular(&given) > irregular(&free));
}

/// The distance from a point to the nearest vertex of the quads.
fn off(quads: &QuadMesh, [x, y]: [f64; 2]) -> f64 {
    let off = quads
        .vertices
        .iter()
        .map(|p| (p[0] - x).hypot(p[1] - y) + p[2].abs());
    off.fold(f64::INFINITY, f64::min)
}

#[test]
fn a_line_that_ends_on_the_surface_has_a_vertex_at_its_end() {
    let mesh = plane(20);
    let along = |i: usize| [i, i + 1].map(|j| 12 * 21 + j);
    for length in [9, 10, 11] {
        let made = of(&mesh, 25, |options| {
            options.guidance.feature_lines = (0..length).map(along).collect();
        });
        assert!(made.quads.is_conforming() && made.missed_features.is_empty());
        assert!(off(&made.quads, [12.0, length as f64]) < 1e-9);
    }
}

#[test]
fn smoothing_moves_a_vertex_beside_a_line_onto_it() {
    let mesh = plane(20);
    let mut made = with_lines(&mesh, 20, &[12]);
    let is_inside = |p: &[f64; 3]| p[1] == 12.0 && p[0] > 6.0 && p[0] < 14.0;
    let v = made.quads.vertices.iter().position(is_inside).unwrap();
    made.quads.vertices[v][1] += 0.7;
    made.quads.origins[v] = Origin::Middle;
    let options = SmoothOptions {
        features: made.features.clone(),
        ..SmoothOptions::default()
    };
    smooth(&mut made.quads, &mesh, &options, &mut Monitor::default()).unwrap();
    assert!((made.quads.vertices[v][1] - 12.0).abs() < 1e-9);
}

#[test]
fn sharp_edges_all_around_a_face_are_accepted() {
    let sphere = shape::by_name("sphere", 1000).unwrap();
    let mut points = sphere.vertices().to_vec();
    for v in sphere.corners(0) {
        points[v] = points[v].map(|x| 1.3 * x);
    }
    let mesh = TriangleMesh::new(points, sphere.triangles().to_vec()).unwrap();
    let made = of(&mesh, 500, |options| {
        options.guidance.feature_angle = Some(40f64.to_radians());
    });
    let around = (0..3).map(|k| mesh.edge_of(0, k));
    let kept = around.filter(|edge| made.features.contains(edge)).count();
    assert!(made.quads.is_conforming() && kept == 2);
}

/// A mesh with its vertices and faces in an order in which neighbours are anywhere.
fn scattered(mesh: &TriangleMesh) -> TriangleMesh {
    let far = |count: usize| {
        // Prime, and no divisor of the count: each number is met once.
        let step = 7_919;
        assert!(!count.is_multiple_of(step));
        (0..count).map(move |k| k * step % count)
    };
    let mut places = vec![0; mesh.vertex_count()];
    let vertices: Vec<usize> = far(mesh.vertex_count()).collect();
    for (place, &vertex) in vertices.iter().enumerate() {
        places[vertex] = place as u32;
    }
    let points = vertices.iter().map(|&v| mesh.position(v));
    let faces = far(mesh.face_count()).map(|f| mesh.corners(f).map(|v| places[v]));
    TriangleMesh::new(points.collect(), faces.collect()).unwrap()
}

#[test]
fn a_large_mesh_in_no_order_has_a_field_a_map_and_quads_of_its_own_elements() {
    let mesh = scattered(&shape::by_name("torus", 34_000).unwrap());
    let made = |threads: usize| {
        let made = of(&mesh, 500, |options| {
            options.field.threads = threads;
            options.guidance.curvature_weight = 0.0;
        });
        let bits: Vec<_> = (made.quads.vertices.iter().flatten())
            .chain(made.field.angles())
            .map(|x| x.to_bits())
            .collect();
        (made, bits)
    };
    let (found, bits) = made(1);
    assert!(bits == made(2).1);
    assert!(found.quads.is_conforming() && found.refined.is_none());
    // The field was solved for in another order.
    let (own, solved) = (found.field.angles(), found.field_solution.values());
    let mut solved = solved[..own.len()].to_vec();
    assert!(own != solved);
    let mut own = own.to_vec();
    own.sort_by(f64::total_cmp);
    solved.sort_by(f64::total_cmp);
    assert!(own == solved);
    let energy = found.field_solution.energy();
    assert!((found.field.energy(&mesh) - energy).abs() < 1e-9 * energy.max(1.0));
    for (place, origin) in found.quads.vertices.iter().zip(&found.quads.origins) {
        let near = match *origin {
            Origin::Vertex(vertex) => mesh.position(vertex),
            Origin::Face(face, _) => mesh.position(mesh.corners(face)[0]),
            Origin::Middle => panic!("no vertex is in the middle of a cell"),
        };
        let moved = (0..3)
            .map(|axis| (near[axis] - place[axis]).powi(2))
            .sum::<f64>();
        // Less than the edge of a quad.
        assert!(moved.sqrt() < 0.3, "{near:?} {place:?}");
    }
}

#[test]
fn errors_of_a_large_mesh_in_no_order_name_its_own_elements() {
    let mesh = scattered(&shape::by_name("torus", 34_000).unwrap());
    let twice = Constraint {
        face: 12_345,
        angle: 0.0,
    };
    let mut options = QuadOptions::default();
    options.guidance.constraints = vec![twice, twice];
    let error = quadrangulate(&mesh, &options, Monitor::default).unwrap_err();
    assert!(
        error.to_string().contains("face 12345 is named twice"),
        "{error}"
    );
}
