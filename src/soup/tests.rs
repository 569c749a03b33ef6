//! Defects planted in shapes: the edit list that comes out, and the shape that comes back.

use super::{Edit, EditKind, PolygonSoup, RepairOptions, Repaired, SoupError, repair};
use crate::linalg::vector::add;
use crate::mesh::{TriangleMesh, shape};

const SHAPES: [&str; 5] = ["rounded-cube", "torus", "sphere", "plane", "genus-2"];

fn shape_of(name: &str) -> TriangleMesh {
    shape::by_name(name, 400).unwrap()
}

fn soup_of(mesh: &TriangleMesh) -> PolygonSoup {
    PolygonSoup::of_triangles(mesh.vertices().to_vec(), mesh.triangles())
}

fn by_default(soup: &PolygonSoup) -> Repaired {
    let repaired = repair(soup, &RepairOptions::default()).unwrap();
    TriangleMesh::new(repaired.vertices.clone(), repaired.triangles.clone()).unwrap();
    repaired
}

fn edit(kind: EditKind, element: usize, other: Option<usize>) -> Edit {
    Edit {
        kind,
        element: element as u32,
        other: other.map(|o| o as u32),
    }
}

/// A defect added behind a shape's own vertices and triangles, undone without a trace but the edits.
type Plant = fn(&TriangleMesh, &mut PolygonSoup) -> Vec<Edit>;

fn corners(mesh: &TriangleMesh, face: usize) -> [i64; 3] {
    mesh.triangles()[face].map(i64::from)
}

fn not_finite(mesh: &TriangleMesh, soup: &mut PolygonSoup) -> Vec<Edit> {
    let vertex = soup.add_vertex([0.0, f64::NAN, 0.0]);
    let [a, b, _] = corners(mesh, 3);
    let polygon = soup.add_polygon([a, b, vertex as i64]);
    vec![
        edit(EditKind::VertexNotFinite, vertex, None),
        edit(EditKind::PolygonNotFinite, polygon, Some(vertex)),
    ]
}

fn missing(mesh: &TriangleMesh, soup: &mut PolygonSoup) -> Vec<Edit> {
    let [a, b, _] = corners(mesh, 4);
    let polygon = soup.add_polygon([a, b, 1_000_000]);
    vec![edit(EditKind::PolygonOutOfRange, polygon, Some(2))]
}

fn degenerate(mesh: &TriangleMesh, soup: &mut PolygonSoup) -> Vec<Edit> {
    let [a, b, _] = corners(mesh, 5);
    let polygon = soup.add_polygon([a, b, b, a]);
    vec![edit(EditKind::PolygonDegenerate, polygon, None)]
}

fn duplicate(mesh: &TriangleMesh, soup: &mut PolygonSoup) -> Vec<Edit> {
    let [a, b, c] = corners(mesh, 6);
    let polygon = soup.add_polygon([b, c, a]);
    vec![edit(EditKind::DuplicateDropped, polygon, Some(6))]
}

fn unused(_: &TriangleMesh, soup: &mut PolygonSoup) -> Vec<Edit> {
    let vertex = soup.add_vertex([9.0, 9.0, 9.0]);
    vec![edit(EditKind::VertexUnused, vertex, None)]
}

const PLANTS: [Plant; 5] = [not_finite, missing, degenerate, duplicate, unused];

#[test]
fn a_clean_mesh_passes_through_bit_by_bit() {
    for name in SHAPES {
        let mesh = shape_of(name);
        let repaired = by_default(&soup_of(&mesh));
        assert!(repaired.edits.is_empty(), "{name}");
        assert_eq!(repaired.vertices, mesh.vertices());
        assert_eq!(repaired.triangles, mesh.triangles());
        let turned = mesh
            .triangles()
            .iter()
            .map(|&[a, b, c]| [a, c, b])
            .collect::<Vec<_>>();
        let inwards = PolygonSoup::of_triangles(mesh.vertices().to_vec(), &turned);
        assert!(by_default(&inwards).edits.is_empty(), "{name}");
    }
}

#[test]
fn planted_defects_are_undone_alone_and_in_pairs() {
    for name in SHAPES {
        let mesh = shape_of(name);
        for (i, first) in PLANTS.iter().enumerate() {
            for second in &PLANTS[i..] {
                let mut soup = soup_of(&mesh);
                let mut expected = first(&mesh, &mut soup);
                if !std::ptr::fn_addr_eq(*first, *second) {
                    expected.extend(second(&mesh, &mut soup));
                }
                expected.sort_unstable();
                let repaired = by_default(&soup);
                let mut found = repaired.edits.list().to_vec();
                found.sort_unstable();
                assert_eq!(found, expected, "{name}");
                assert_eq!(repaired.vertices, mesh.vertices());
                assert_eq!(repaired.triangles, mesh.triangles());
            }
        }
    }
}

#[test]
fn a_torn_shape_with_turned_triangles_becomes_whole() {
    for name in SHAPES {
        let mesh = shape_of(name);
        let mut soup = PolygonSoup::default();
        for face in 0..mesh.face_count() {
            let mut torn = mesh
                .corner_positions(face)
                .map(|p| soup.add_vertex(p) as i64);
            if face % 5 == 0 {
                torn.swap(1, 2);
            }
            soup.add_polygon(torn);
        }
        let repaired = by_default(&soup);
        let count = |kind| repaired.edits.count(kind);
        let welded = 3 * mesh.face_count() - mesh.vertex_count();
        assert_eq!(count(EditKind::VertexWelded), welded, "{name}");
        assert_eq!(
            count(EditKind::PolygonTurned),
            mesh.face_count().div_ceil(5)
        );
        assert_eq!(
            repaired.edits.list().len(),
            welded + mesh.face_count().div_ceil(5)
        );
        for face in 0..mesh.face_count() {
            let [a, b, c] = repaired.triangles[face].map(|v| repaired.vertices[v as usize]);
            let given = mesh.corner_positions(face);
            assert!([[a, b, c], [b, c, a], [c, a, b]].contains(&given), "{name}");
        }
    }
}

#[test]
fn a_cap_on_an_edge_gives_way_and_the_surface_stays_whole() {
    // A square whose diagonal has a vertex in its middle on one side only, and a cap between.
    let positions = vec![
        [0.0, 0.0, 0.0],
        [2.0, 0.0, 0.0],
        [2.0, 2.0, 0.0],
        [0.0, 2.0, 0.0],
        [1.0, 1.0, 0.0],
    ];
    let triangles = [[0, 1, 4], [1, 2, 4], [0, 4, 2], [0, 2, 3]];
    let repaired = by_default(&PolygonSoup::of_triangles(positions, &triangles));
    assert_eq!(
        repaired.edits.list(),
        [edit(EditKind::CapFlipped, 2, Some(4))]
    );
    assert_eq!(repaired.triangles.len(), 4);
    assert_eq!(repaired.triangles_of(3), [2, 3]);
    let mesh = TriangleMesh::new(repaired.vertices, repaired.triangles).unwrap();
    assert_eq!(
        (mesh.euler_characteristic(), mesh.boundary_loop_count()),
        (1, 1)
    );
}

#[test]
fn a_fin_is_cut_from_the_surface_that_goes_on() {
    for name in SHAPES {
        let mesh = shape_of(name);
        let edge = mesh.edges().find(|e| e.second.is_some()).unwrap();
        let [a, b] = edge.vertices;
        let mut soup = soup_of(&mesh);
        let out = [edge.first.0, edge.second.unwrap().0].map(|f| mesh.normal(f));
        let tip = soup.add_vertex(add(mesh.position(a), add(out[0], out[1])));
        soup.add_polygon([a, b, tip].map(|v| v as i64));
        let repaired = by_default(&soup);
        let (low, high) = (a.min(b), a.max(b));
        let expected = [
            edit(EditKind::EdgeCut, low, Some(high)),
            edit(EditKind::VertexSplit, low, Some(2)),
            edit(EditKind::VertexSplit, high, Some(2)),
        ];
        assert_eq!(repaired.edits.list(), expected, "{name}");
        assert_eq!(repaired.triangles[..mesh.face_count()], *mesh.triangles());
        assert_eq!(repaired.vertices_of(low).len(), 2);
    }
}

#[test]
fn a_moebius_band_is_cut_once_across() {
    let positions: Vec<_> = (0..20)
        .map(|i| {
            let (turn, side) = (f64::from(i / 2) * 0.1, f64::from(i % 2) - 0.5);
            let (around, twist) = (turn * std::f64::consts::TAU, turn * std::f64::consts::PI);
            let radius = 3.0 + side * twist.cos();
            [
                radius * around.cos(),
                radius * around.sin(),
                side * twist.sin(),
            ]
        })
        .collect();
    let mut soup = PolygonSoup::new(positions);
    for i in 0..10 {
        let next = if i == 9 {
            [1, 0]
        } else {
            [2 * i + 2, 2 * i + 3]
        };
        soup.add_polygon([2 * i, next[0], next[1], 2 * i + 1]);
    }
    let repaired = by_default(&soup);
    assert_eq!(repaired.edits.count(EditKind::EdgeCut), 1);
    let mesh = TriangleMesh::new(repaired.vertices, repaired.triangles).unwrap();
    assert_eq!(
        (mesh.euler_characteristic(), mesh.boundary_loop_count()),
        (1, 1)
    );
}

#[test]
fn two_cubes_that_share_a_wall_or_an_edge_are_two_solids() {
    for shift in [[1.0, 0.0, 0.0], [1.0, 1.0, 0.0]] {
        let mut soup = PolygonSoup::default();
        for cube in [0.0, 1.0] {
            let first = soup.positions().len() as i64;
            for i in 0..8 {
                let bit = |k: usize| f64::from(i >> k & 1) + cube * shift[k];
                soup.add_vertex([bit(0), bit(1), bit(2)]);
            }
            for face in [
                [0, 2, 3, 1],
                [4, 5, 7, 6],
                [0, 1, 5, 4],
                [2, 6, 7, 3],
                [0, 4, 6, 2],
                [1, 3, 7, 5],
            ] {
                soup.add_polygon(face.map(|v| v + first));
            }
        }
        let repaired = by_default(&soup);
        let mesh = TriangleMesh::new(repaired.vertices, repaired.triangles).unwrap();
        assert_eq!(
            (mesh.components().count, mesh.euler_characteristic()),
            (2, 4)
        );
        assert!(mesh.is_closed());
    }
}

#[test]
fn holes_are_filled_and_small_components_dropped_where_asked_for() {
    let mesh = shape_of("torus");
    let mut soup = PolygonSoup::of_triangles(mesh.vertices().to_vec(), &mesh.triangles()[1..]);
    let first = soup.positions().len() as i64;
    for position in [[9.0, 0.0, 0.0], [9.1, 0.0, 0.0], [9.0, 0.1, 0.0]] {
        soup.add_vertex(position);
    }
    soup.add_polygon([first, first + 1, first + 2]);
    let options = RepairOptions {
        drop_components: 0.01,
        fill_holes: 3,
        ..RepairOptions::default()
    };
    let repaired = repair(&soup, &options).unwrap();
    let kinds: Vec<_> = repaired.edits.list().iter().map(|e| e.kind).collect();
    assert_eq!(kinds, [EditKind::ComponentDropped, EditKind::HoleFilled]);
    assert_eq!(repaired.triangle_origin.last(), Some(&None));
    let mesh = TriangleMesh::new(repaired.vertices, repaired.triangles).unwrap();
    assert!(mesh.is_closed() && mesh.euler_characteristic() == 0);
}

#[test]
fn a_polygon_with_a_hole_on_a_bridge_keeps_its_area() {
    let square = |h: f64| [[-h, -h, 0.0], [h, -h, 0.0], [h, h, 0.0], [-h, h, 0.0]];
    let positions = [square(2.0), square(1.0)].concat();
    let mut soup = PolygonSoup::new(positions);
    soup.add_polygon([0, 1, 2, 3, 0, 4, 7, 6, 5, 4]);
    let repaired = by_default(&soup);
    let mesh = TriangleMesh::new(repaired.vertices, repaired.triangles).unwrap();
    let area: f64 = (0..mesh.face_count()).map(|f| mesh.area(f)).sum();
    assert_eq!((area, mesh.boundary_loop_count()), (12.0, 2));
}

#[test]
fn what_holds_no_surface_is_refused() {
    let line = [[0.0; 3], [1.0, 0.0, 0.0], [2.0, 0.0, 0.0]];
    let soups = [
        PolygonSoup::default(),
        PolygonSoup::of_triangles(line.to_vec(), &[[0, 1, 2]]),
        PolygonSoup::of_triangles(line.to_vec(), &[[0, 1, 7]]),
    ];
    for soup in soups {
        let refused = repair(&soup, &RepairOptions::default()).unwrap_err();
        assert!(matches!(refused, SoupError::NoSurface { .. }), "{refused}");
    }
}

#[test]
fn a_polygon_that_runs_several_times_round_is_taken_once() {
    let mut soup = PolygonSoup::default();
    for p in [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]] {
        soup.add_vertex([p[0], p[1], 0.0]);
    }
    soup.add_polygon([0, 1, 2, 3].repeat(5));
    let repaired = by_default(&soup);
    assert_eq!(repaired.triangles.len(), 2);
    let removed = edit(EditKind::CornersRemoved, 0, Some(16));
    assert!(
        repaired.edits.list().contains(&removed),
        "{:?}",
        repaired.edits
    );
}
