//! The check of integer-grid maps: perfect maps pass, and a planted defect is reported at exactly the
//! elements that it spoils.

use roundel::check::{CheckOptions, MapCheck, Singularity, check_map, feature_edges};
use roundel::mesh::{TriangleMesh, shape};

type Corners = Vec<[[f64; 2]; 3]>;

/// A mesh and the coordinates of its corners.
struct Case {
    mesh: TriangleMesh,
    uv: Corners,
}

/// `side` by `side` unit squares in the plane, with two triangles each.
fn plane(side: u32) -> Case {
    let at = |x: u32, y: u32| y * (side + 1) + x;
    let points = (0..=side).flat_map(|y| (0..=side).map(move |x| [x.into(), y.into(), 0.0]));
    let squares = (0..side).flat_map(|y| (0..side).map(move |x| (x, y)));
    let triangles = squares.flat_map(|(x, y)| {
        let [a, b, c, d] = [at(x, y), at(x + 1, y), at(x + 1, y + 1), at(x, y + 1)];
        [[a, b, c], [a, c, d]]
    });
    let mesh = TriangleMesh::new(points.collect(), triangles.collect()).unwrap();
    let faces = 0..mesh.face_count();
    let uv = faces.map(|f| mesh.corner_positions(f).map(|[x, y, _]| [x, y]));
    Case {
        uv: uv.collect(),
        mesh,
    }
}

/// A cube of `side` by `side` squares a side. Each side is its own chart, turned by another number of
/// quarters.
fn cube(side: u32) -> Case {
    let n = i64::from(side);
    let mut points: Vec<[i64; 3]> = Vec::new();
    let mut number = |p: [i64; 3]| match points.iter().position(|&q| q == p) {
        Some(found) => found as u32,
        None => {
            points.push(p);
            points.len() as u32 - 1
        }
    };
    let (mut triangles, mut uv) = (Vec::new(), Vec::new());
    for chart in 0..6i64 {
        let axis = (chart / 2) as usize;
        let place = |u: i64, v: i64| {
            let mut p = [0; 3];
            p[axis] = n * (chart % 2);
            // The other two axes, in the order that makes the normal point outwards.
            let (a, b) = if chart % 2 == 1 { (1, 2) } else { (2, 1) };
            (p[(axis + a) % 3], p[(axis + b) % 3]) = (u, v);
            p
        };
        let turned = |u: i64, v: i64| {
            let (u, v) = (u as f64, v as f64);
            match chart % 4 {
                0 => [u, v],
                1 => [5.0 - v, u],
                2 => [-u, 7.0 - v],
                _ => [v, -u],
            }
        };
        for (u, v) in (0..n).flat_map(|u| (0..n).map(move |v| (u, v))) {
            let corners = [(u, v), (u + 1, v), (u + 1, v + 1), (u, v + 1)];
            let numbers = corners.map(|(u, v)| number(place(u, v)));
            let images = corners.map(|(u, v)| turned(u, v));
            for [a, b, c] in [[0, 1, 2], [0, 2, 3]] {
                triangles.push([numbers[a], numbers[b], numbers[c]]);
                uv.push([images[a], images[b], images[c]]);
            }
        }
    }
    let points = points.iter().map(|p| p.map(|x| x as f64)).collect();
    let mesh = TriangleMesh::new(points, triangles).unwrap();
    Case { mesh, uv }
}

/// A torus of squares. Each triangle is its own chart, turned by quarters and shifted by integers.
fn torus(side: u32) -> Case {
    let at = |x: u32, y: u32| (y % side) * side + x % side;
    let angle = |i: u32| std::f64::consts::TAU * f64::from(i) / f64::from(side);
    let points = (0..side * side).map(|v| {
        let (a, b) = (angle(v % side), angle(v / side));
        let radius = 3.0 + b.cos();
        [radius * a.cos(), radius * a.sin(), b.sin()]
    });
    let (mut triangles, mut uv) = (Vec::new(), Vec::new());
    for (x, y) in (0..side).flat_map(|y| (0..side).map(move |x| (x, y))) {
        let corners = [(x, y), (x + 1, y), (x + 1, y + 1), (x, y + 1)];
        for order in [[0, 1, 2], [0, 2, 3]] {
            triangles.push(order.map(|k| at(corners[k].0, corners[k].1)));
            let turn = triangles.len() % 4;
            uv.push(order.map(|k| {
                let (u, v) = (f64::from(corners[k].0), f64::from(corners[k].1));
                [[u, v], [-v, u + 3.0], [-u, -v], [v - 8.0, -u]][turn]
            }));
        }
    }
    let mesh = TriangleMesh::new(points.collect(), triangles).unwrap();
    Case { mesh, uv }
}

fn check(case: &Case) -> MapCheck {
    check_map(&case.mesh, &case.uv, &CheckOptions::default()).unwrap()
}

fn elements(defects: &[roundel::check::Defect]) -> Vec<usize> {
    defects.iter().map(|d| d.element).collect()
}

/// The edges of a face in increasing order.
fn edges_of(mesh: &TriangleMesh, face: usize) -> Vec<usize> {
    let mut edges = [0, 1, 2].map(|k| mesh.edge_of(face, k));
    edges.sort_unstable();
    edges.to_vec()
}

/// Moves a vertex in every face around it.
fn move_vertex(case: &mut Case, vertex: usize, by: [f64; 2]) {
    let ring: Vec<_> = case.mesh.ring(vertex).collect();
    for (face, corner) in ring {
        for axis in 0..2 {
            case.uv[face][corner][axis] += by[axis];
        }
    }
}

#[test]
fn perfect_maps_are_valid() {
    for case in [plane(5), cube(1), cube(3), torus(7)] {
        let found = check(&case);
        assert!(found.is_valid(), "{found:?}");
        assert_eq!((found.worst_rotation, found.worst_translation), (0.0, 0.0));
    }
}

#[test]
fn the_corners_of_a_cube_are_its_singularities() {
    let case = cube(2);
    let mut corners: Vec<usize> = (0..case.mesh.vertex_count())
        .filter(|&v| case.mesh.position(v).iter().all(|&x| x == 0.0 || x == 2.0))
        .collect();
    corners.sort_unstable();
    let expected: Vec<_> = corners
        .iter()
        .map(|&vertex| Singularity {
            vertex,
            quarters: 1,
        })
        .collect();
    assert_eq!(check(&case).singularities, expected);
}

#[test]
fn the_edges_of_a_cube_are_its_features_and_lie_on_isolines() {
    let mut case = cube(3);
    let features = feature_edges(&case.mesh, 1.0);
    assert_eq!(features.len(), 36);
    let options = CheckOptions {
        features: features.clone(),
        ..CheckOptions::default()
    };
    let found = check_map(&case.mesh, &case.uv, &options).unwrap();
    assert!(found.is_valid());
    // Shifting one chart as a whole moves its twelve outer edges off the isolines, and no others.
    for uv in case.uv[..18].iter_mut().flatten() {
        *uv = [uv[0] + 0.25, uv[1] + 0.125];
    }
    let found = check_map(&case.mesh, &case.uv, &options).unwrap();
    let off: Vec<usize> = features
        .into_iter()
        .filter(|&e| {
            let edge = case.mesh.edge(e);
            edge.first.0 < 18 || edge.second.unwrap().0 < 18
        })
        .collect();
    assert_eq!(off.len(), 12);
    assert_eq!(elements(&found.features), off);
    assert_eq!(elements(&found.translations), off);
    assert!(found.is_seamless() && !found.is_integer());
}

#[test]
fn a_flipped_triangle_is_the_only_defect_found() {
    // A vertex inside a triangle of the grid, moved out across one side of it.
    let mesh = TriangleMesh::new(
        vec![
            [0.0, 0.0, 0.0],
            [1.0, 0.0, 0.0],
            [0.0, 1.0, 0.0],
            [0.25, 0.25, 0.0],
        ],
        vec![[0, 1, 3], [1, 2, 3], [2, 0, 3]],
    )
    .unwrap();
    let faces = 0..mesh.face_count();
    let uv = faces.map(|f| mesh.corner_positions(f).map(|[x, y, _]| [x, y]));
    let mut case = Case {
        uv: uv.collect(),
        mesh,
    };
    let options = CheckOptions {
        boundary: false,
        ..CheckOptions::default()
    };
    let whole = check_map(&case.mesh, &case.uv, &options).unwrap();
    assert!(whole.is_valid(), "{whole:?}");
    move_vertex(&mut case, 3, [0.0, -0.5]);
    let found = check_map(&case.mesh, &case.uv, &options).unwrap();
    assert_eq!(elements(&found.flipped), [0]);
    assert_eq!(found.flipped[0].amount, -0.125);
    let mended = MapCheck {
        flipped: Vec::new(),
        ..found
    };
    assert!(mended.is_valid(), "{mended:?}");
    // With the vertex on the side itself, the triangle has no area, which is another defect.
    move_vertex(&mut case, 3, [0.0, 0.25]);
    let found = check_map(&case.mesh, &case.uv, &options).unwrap();
    assert_eq!((found.flipped.len(), found.degenerate), (0, vec![0]));
}

#[test]
fn a_translation_off_by_a_thousandth_is_the_only_defect_found() {
    let mut case = torus(6);
    for corner in &mut case.uv[17] {
        corner[1] += 1e-3;
    }
    let found = check(&case);
    assert_eq!(elements(&found.translations), edges_of(&case.mesh, 17));
    for defect in &found.translations {
        assert!((defect.amount - 1e-3).abs() < 1e-12);
    }
    assert!(found.is_seamless() && !found.is_integer());
    let mended = MapCheck {
        translations: Vec::new(),
        ..found
    };
    assert!(mended.is_valid(), "{mended:?}");
}

#[test]
fn a_rotation_that_is_no_quarter_turn_is_the_only_defect_found() {
    let mut case = torus(6);
    let (sin, cos) = 0.01f64.sin_cos();
    for corner in &mut case.uv[17] {
        *corner = [
            cos * corner[0] - sin * corner[1],
            sin * corner[0] + cos * corner[1],
        ];
    }
    let found = check(&case);
    assert_eq!(elements(&found.rotations), edges_of(&case.mesh, 17));
    assert!(!found.is_seamless() && found.translations.is_empty());
    assert!((found.worst_rotation - 0.02 * 0.5f64.sqrt()).abs() < 1e-6);
}

#[test]
fn a_cone_off_the_grid_is_the_only_defect_found() {
    // The corner of an octant, where three quadrants meet, and its three axes.
    let ring = [[0.0, 0.0, 1.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]];
    let points = [vec![[0.0; 3]], ring.to_vec()].concat();
    let mesh = TriangleMesh::new(points, vec![[0, 1, 2], [0, 2, 3], [0, 3, 1]]).unwrap();
    let quadrant = [[0.0, 0.0], [1.0, 0.0], [0.0, 1.0]];
    // Each chart continues the one before it, turned. The last one is closed by a quarter turn, either
    // about (1, 0), which moves the centre, or about the centre, which does not.
    let shifted = |by: [f64; 2]| Case {
        mesh: mesh.clone(),
        uv: vec![quadrant.map(|[u, v]| [u + by[0], v + by[1]]); 3],
    };
    let options = CheckOptions {
        boundary: false,
        ..CheckOptions::default()
    };
    let check = |case: &Case| check_map(&case.mesh, &case.uv, &options).unwrap();
    assert!(check(&shifted([2.0, -3.0])).is_valid());
    // After a shift by (1/2, 1/2) the quarter turns still have integer translations. Only the cone is
    // off the grid.
    let found = check(&shifted([0.5, 0.5]));
    assert_eq!(
        found.singularities,
        [Singularity {
            vertex: 0,
            quarters: 1
        }]
    );
    assert_eq!(elements(&found.off_grid), [0]);
    assert_eq!(found.off_grid[0].amount, 0.5);
    assert!(found.is_seamless() && found.translations.is_empty() && !found.is_integer());
}

#[test]
fn a_boundary_edge_off_the_isoline_is_the_only_defect_found() {
    let mut case = plane(4);
    // The vertex at (2, 0) lies between two boundary edges.
    move_vertex(&mut case, 2, [0.0, 1e-3]);
    let found = check(&case);
    let expected: Vec<usize> = (0..case.mesh.edge_count())
        .filter(|&e| {
            let edge = case.mesh.edge(e);
            edge.second.is_none() && edge.vertices.contains(&2)
        })
        .collect();
    assert_eq!(elements(&found.boundary), expected);
    assert_eq!(expected.len(), 2);
    let mended = MapCheck {
        boundary: Vec::new(),
        ..found
    };
    assert!(mended.is_valid(), "{mended:?}");
}

#[test]
fn bad_coordinates_are_refused_with_their_position() {
    let case = plane(2);
    let refused = |uv: &Corners, options: &CheckOptions| {
        let error = check_map(&case.mesh, uv, options).unwrap_err();
        (error.code(), error.index())
    };
    let defaults = CheckOptions::default();
    let short = case.uv[1..].to_vec();
    assert_eq!(refused(&short, &defaults).0, "length_mismatch");
    let mut infinite = case.uv.clone();
    infinite[3][1][0] = f64::NAN;
    assert_eq!(refused(&infinite, &defaults), ("not_finite", Some(3)));
    let foreign = CheckOptions {
        features: vec![0, case.mesh.edge_count()],
        ..defaults.clone()
    };
    assert_eq!(refused(&case.uv, &foreign), ("index_out_of_range", Some(1)));
    for tolerance in [-1e-9, 0.25, f64::NAN] {
        let blind = CheckOptions {
            tolerance,
            ..defaults.clone()
        };
        assert_eq!(refused(&case.uv, &blind).0, "invalid_argument");
    }
}

#[test]
fn sharp_edges_of_shapes_are_features() {
    let gear = shape::by_name("gear", 1000).unwrap();
    assert!(!feature_edges(&gear, 0.7).is_empty());
    let sphere = shape::by_name("sphere", 1000).unwrap();
    assert!(feature_edges(&sphere, 0.7).is_empty());
}
