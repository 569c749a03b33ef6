//! Properties of every mesh, held on the shapes, jittered and subdivided.

use std::f64::consts::{PI, TAU};

use super::{TriangleMesh, jitter, shape, subdivide};

const SHAPES: &[&str] = &[
    "rounded-cube",
    "sphere",
    "torus",
    "genus-2",
    "genus-5",
    "gear",
    "plane",
    "disk",
    "plate-with-holes",
];

fn meshes() -> impl Iterator<Item = TriangleMesh> {
    SHAPES.iter().map(|name| {
        let mesh = shape::by_name(name, 1_500).expect("a shape");
        jitter(&mesh, 0.05, 11).expect("jitter keeps a shape valid")
    })
}

/// Two components: a tetrahedron and a lone triangle that looks at it.
fn two_pieces() -> TriangleMesh {
    let mut vertices = vec![[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
    vertices.extend([[5.0, 0.0, 0.0], [6.0, 0.0, 0.0], [5.0, 1.0, 0.0]]);
    let triangles = vec![[0, 2, 1], [4, 5, 6], [0, 1, 3], [1, 2, 3], [2, 0, 3]];
    TriangleMesh::new(vertices, triangles).expect("a valid mesh")
}

#[test]
fn the_neighbor_of_the_neighbor_is_the_face_itself_and_they_share_the_edge_reversed() {
    for mesh in meshes().chain([two_pieces()]) {
        let mut boundary = 0;
        for f in 0..mesh.face_count() {
            for k in 0..3 {
                let Some((g, j)) = mesh.neighbor(f, k) else {
                    boundary += 1;
                    continue;
                };
                assert_eq!(mesh.neighbor(g, j), Some((f, k)));
                let (a, b) = (mesh.corners(f), mesh.corners(g));
                assert_eq!([a[k], a[(k + 1) % 3]], [b[(j + 1) % 3], b[j]]);
                assert_eq!(mesh.edge_of(f, k), mesh.edge_of(g, j));
            }
        }
        assert_eq!(boundary == 0, mesh.is_closed());
    }
}

#[test]
fn edges_come_in_order_of_their_lower_side_and_cover_every_half_edge_once() {
    for mesh in meshes() {
        let mut last = None;
        let mut halves = 0;
        for (e, edge) in mesh.edges().enumerate() {
            assert!(last.is_none_or(|side| side < edge.first));
            last = Some(edge.first);
            let (f, k) = edge.first;
            assert_eq!(mesh.edge_of(f, k), e);
            assert_eq!(mesh.neighbor(f, k), edge.second);
            assert!(edge.second.is_none_or(|side| side > edge.first));
            assert_eq!(edge.vertices[0], mesh.corners(f)[k]);
            halves += 1 + usize::from(edge.second.is_some());
        }
        assert_eq!(halves, 3 * mesh.face_count());
    }
}

#[test]
fn rings_go_round_counter_clockwise_and_hold_every_corner_once() {
    for mesh in meshes().chain([two_pieces()]) {
        let mut corners = 0;
        for v in 0..mesh.vertex_count() {
            let ring: Vec<_> = mesh.ring(v).collect();
            corners += ring.len();
            assert_eq!(ring.len(), mesh.face_degree(v));
            for &(f, k) in &ring {
                assert_eq!(mesh.corners(f)[k], v);
            }
            for pair in ring.windows(2) {
                let (f, k) = pair[0];
                assert_eq!(mesh.neighbor(f, (k + 2) % 3), Some(pair[1]));
            }
            let (first, last) = (ring[0], ring[ring.len() - 1]);
            let onward = mesh.neighbor(last.0, (last.1 + 2) % 3);
            if mesh.is_boundary_vertex(v) {
                assert_eq!(mesh.neighbor(first.0, first.1), None);
                assert_eq!(onward, None);
            } else {
                assert_eq!(onward, Some(first));
                assert_eq!(ring.iter().min(), Some(&first));
            }
        }
        assert_eq!(corners, 3 * mesh.face_count());
    }
}

#[test]
fn boundary_loops_are_closed_walks_that_hold_every_boundary_edge_once() {
    for mesh in meshes().chain([two_pieces()]) {
        let mut found = 0;
        let mut last = None;
        for boundary in mesh.boundary_loops() {
            assert_eq!(boundary.iter().min(), Some(&boundary[0]));
            assert!(last.is_none_or(|first| first < boundary[0]));
            last = Some(boundary[0]);
            for (i, &(f, k)) in boundary.iter().enumerate() {
                let (g, j) = boundary[(i + 1) % boundary.len()];
                assert_eq!(mesh.neighbor(f, k), None);
                assert_eq!(mesh.corners(f)[(k + 1) % 3], mesh.corners(g)[j]);
            }
            found += boundary.len();
        }
        let expected = mesh.edges().filter(|e| e.second.is_none()).count();
        assert_eq!(found, expected);
    }
}

#[test]
fn angle_defects_and_boundary_turns_sum_to_the_euler_characteristic() {
    for mesh in meshes().chain([two_pieces()]) {
        let mut sum = 0.0;
        for v in 0..mesh.vertex_count() {
            let around: f64 = mesh.ring(v).map(|(f, k)| mesh.angle(f, k)).sum();
            sum += if mesh.is_boundary_vertex(v) { PI } else { TAU } - around;
        }
        assert!((sum / TAU - mesh.euler_characteristic() as f64).abs() < 1e-9);
    }
}

#[test]
fn the_angles_of_a_face_sum_to_half_a_turn() {
    for mesh in meshes() {
        for f in 0..mesh.face_count() {
            let sum: f64 = (0..3).map(|k| mesh.angle(f, k)).sum();
            assert!((sum - PI).abs() < 1e-12);
        }
    }
}

#[test]
fn transport_there_and_back_is_nothing_and_around_a_vertex_is_its_angle_defect() {
    let same_turn = |a: f64, b: f64| ((a - b) / TAU - ((a - b) / TAU).round()).abs() < 1e-9;
    for mesh in meshes() {
        for v in 0..mesh.vertex_count() {
            if mesh.is_boundary_vertex(v) {
                continue;
            }
            let mut turn = 0.0;
            let mut around = 0.0;
            for (f, k) in mesh.ring(v) {
                let onward = mesh.transport(f, (k + 2) % 3).expect("an interior edge");
                let (g, j) = mesh.neighbor(f, (k + 2) % 3).expect("an interior edge");
                assert!(onward > -PI && onward <= PI);
                assert!(same_turn(
                    onward,
                    -mesh.transport(g, j).expect("the same edge")
                ));
                turn += onward;
                around += mesh.angle(f, k);
            }
            assert!(same_turn(turn, TAU - around));
        }
    }
}

#[test]
fn the_angle_of_an_edge_is_that_of_its_vector_in_the_frame() {
    use super::vector::{dot, sub};
    for mesh in meshes() {
        for f in 0..mesh.face_count() {
            let ([x, y], p) = (mesh.frame(f), mesh.corner_positions(f));
            for k in 0..3 {
                let edge = sub(p[(k + 1) % 3], p[k]);
                let angle = dot(edge, y).atan2(dot(edge, x));
                assert!((angle - mesh.edge_angle(f, k)).abs() < 1e-9);
            }
        }
    }
}

#[test]
fn subdivision_keeps_topology_and_area_and_quarters_the_faces() {
    for mesh in meshes().chain([two_pieces()]) {
        let fine = subdivide(&mesh).expect("midpoints of a valid mesh");
        assert_eq!(fine.face_count(), 4 * mesh.face_count());
        assert_eq!(fine.genus(), mesh.genus());
        assert_eq!(fine.boundary_loop_count(), mesh.boundary_loop_count());
        assert_eq!(fine.components().count, mesh.components().count);
        assert!((fine.surface_area() / mesh.surface_area() - 1.0).abs() < 1e-12);
        for f in 0..mesh.face_count() {
            assert!((fine.area(4 * f + 3) / mesh.area(f) - 0.25).abs() < 1e-9);
        }
    }
}

#[test]
fn jitter_is_the_same_for_the_same_seed_and_stays_within_its_amplitude() {
    let mesh = shape::by_name("gear", 2_000).expect("a shape");
    let moved = jitter(&mesh, 1e-3, 5).expect("valid");
    assert_eq!(
        moved.vertices(),
        jitter(&mesh, 1e-3, 5).expect("valid").vertices()
    );
    assert_ne!(
        moved.vertices(),
        jitter(&mesh, 1e-3, 6).expect("valid").vertices()
    );
    for v in 0..mesh.vertex_count() {
        let shortest = mesh
            .ring(v)
            .flat_map(|(f, k)| [mesh.edge_length(f, k), mesh.edge_length(f, (k + 2) % 3)])
            .fold(f64::INFINITY, f64::min);
        for axis in 0..3 {
            let step = (moved.position(v)[axis] - mesh.position(v)[axis]).abs();
            assert!(step <= 1e-3 * shortest * (1.0 + 1e-9));
        }
    }
    let mut lengths: Vec<_> = moved
        .edges()
        .map(|e| moved.edge_length(e.first.0, e.first.1))
        .collect();
    lengths.sort_by(f64::total_cmp);
    assert!(lengths.windows(2).all(|pair| pair[0] < pair[1]));
}

#[test]
fn pieces_are_counted_and_measured_apart() {
    let mesh = two_pieces();
    let components = mesh.components();
    assert_eq!(components.count, 2);
    assert_eq!(components.of_face, [0, 1, 0, 0, 0]);
    assert_eq!(mesh.genus(), 0);
    assert_eq!(mesh.boundary_loop_count(), 1);
    assert_eq!(mesh.bounding_box(), [[0.0; 3], [6.0, 1.0, 1.0]]);
    assert_eq!(mesh.normal(1), [0.0, 0.0, 1.0]);
    assert_eq!(mesh.area(1), 0.5);
}

#[test]
fn the_centroid_of_a_symmetric_shape_is_its_centre() {
    for name in ["sphere", "rounded-cube", "torus", "disk"] {
        let mesh = shape::by_name(name, 2_000).expect("a shape");
        assert!(super::vector::norm(mesh.centroid()) < 1e-2);
    }
}
