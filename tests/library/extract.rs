//! Quad extraction: properties that hold for any map, with or without defects.

use roundel::extract::{IntegerGridMap, Origin, QuadMesh, extract};
use roundel::field::{FieldProblem, curvature_constraints};
use roundel::map::{SeamlessMap, SeamlessOptions, SeamlessProblem};
use roundel::mesh::{TriangleMesh, shape};
use roundel::smooth::{QuadQuality, SmoothOptions, smooth};
use roundel::{CancelToken, Error, Monitor, Options, solve};

type Corners = Vec<[[f64; 2]; 3]>;

/// A flat square of `n` by `n` units, with two triangles for each unit square, and its coordinates.
fn plane(n: usize) -> (TriangleMesh, Corners) {
    let at = |i: usize, j: usize| (i * (n + 1) + j) as u32;
    let mut vertices = Vec::new();
    for i in 0..=n {
        for j in 0..=n {
            vertices.push([i as f64, j as f64, 0.0]);
        }
    }
    let mut triangles = Vec::new();
    for i in 0..n {
        for j in 0..n {
            let [a, b, c, d] = [at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)];
            triangles.extend([[a, b, c], [a, c, d]]);
        }
    }
    let mesh = TriangleMesh::new(vertices, triangles).unwrap();
    let uvs = mesh.triangles().iter().map(|t| t.map(|v| flat(&mesh, v)));
    let uvs = uvs.collect();
    (mesh, uvs)
}

fn flat(mesh: &TriangleMesh, vertex: u32) -> [f64; 2] {
    let [x, y, _] = mesh.position(vertex as usize);
    [x, y]
}

/// The surface of the unit cube, `n` by `n` squares a side. Each side is a chart of `scale` units.
fn cube(n: usize, scale: f64) -> (TriangleMesh, Corners) {
    let mut vertices: Vec<[f64; 3]> = Vec::new();
    let mut triangles = Vec::new();
    let mut uvs = Vec::new();
    for (axis, side) in [(0, 0.0), (0, 1.0), (1, 0.0), (1, 1.0), (2, 0.0), (2, 1.0)] {
        let corner = |i: usize, j: usize| {
            let [s, t] = [i, j].map(|x| x as f64 / n as f64);
            // Counter-clockwise seen from outside.
            let [s, t] = if side == 0.0 { [t, s] } else { [s, t] };
            let mut p = [0.0; 3];
            p[axis] = side;
            p[(axis + 1) % 3] = s;
            p[(axis + 2) % 3] = t;
            p
        };
        for i in 0..n {
            for j in 0..n {
                let square = [[i, j], [i + 1, j], [i + 1, j + 1], [i, j + 1]];
                for pick in [[0, 1, 2], [0, 2, 3]] {
                    let corners = pick.map(|k| square[k]);
                    uvs.push(corners.map(|c| c.map(|x| scale * x as f64 / n as f64)));
                    triangles.push(corners.map(|[i, j]| {
                        let p = corner(i, j);
                        let known = vertices.iter().position(|&q| q == p);
                        known.unwrap_or_else(|| {
                            vertices.push(p);
                            vertices.len() - 1
                        }) as u32
                    }));
                }
            }
        }
    }
    (TriangleMesh::new(vertices, triangles).unwrap(), uvs)
}

fn quads_of(mesh: &TriangleMesh, uvs: &Corners) -> QuadMesh {
    let map = IntegerGridMap::new(mesh, uvs).unwrap();
    extract(mesh, &map, &mut Monitor::default()).unwrap()
}

fn map_of(mesh: &TriangleMesh, quads: usize) -> SeamlessMap {
    let problem = FieldProblem::new(mesh, &curvature_constraints(mesh, 0.1).unwrap()).unwrap();
    let solution = solve(problem.problem(), &Options::default()).unwrap();
    let field = problem.field(mesh, &solution).unwrap();
    let problem = SeamlessProblem::new(mesh, &field, &SeamlessOptions { quads }).unwrap();
    let solution = solve(problem.problem(), &Options::default()).unwrap();
    problem.map(mesh, &solution).unwrap()
}

/// The number of edges at every vertex of a closed mesh, sorted.
fn valences(quads: &QuadMesh) -> Vec<usize> {
    let mut valence = vec![0; quads.vertices.len()];
    for &v in quads.faces().flatten() {
        valence[v as usize] += 1;
    }
    valence.sort_unstable();
    valence
}

#[test]
fn a_square_of_units_gives_each_unit_square_as_a_quad() {
    for n in [1, 2, 5] {
        let (mesh, uvs) = plane(n);
        let quads = quads_of(&mesh, &uvs);
        assert_eq!((quads.quads.len(), quads.others.len()), (n * n, 0));
        assert_eq!(quads.vertices.len(), (n + 1) * (n + 1));
        assert!(quads.is_conforming());
        for quad in &quads.quads {
            let corners = quad.map(|v| quads.vertices[v as usize]);
            let low = corners
                .iter()
                .fold([f64::MAX; 2], |m, p| [m[0].min(p[0]), m[1].min(p[1])]);
            let start = corners.iter().position(|p| p[..2] == low).unwrap();
            let around = [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]];
            for (k, [x, y]) in around.into_iter().enumerate() {
                let found = corners[(start + k) % 4];
                assert_eq!(found, [low[0] + x, low[1] + y, 0.0], "counter-clockwise");
            }
        }
    }
}

/// A plate with holes of one unit each, in half units.
#[test]
fn holes_of_one_unit_square_stay_open() {
    let (whole, _) = plane(14);
    let in_hole = |t: &[u32; 3]| {
        let middle = [0, 1].map(|i| {
            t.iter()
                .map(|&v| whole.position(v as usize)[i])
                .sum::<f64>()
                / 6.0
        });
        [[2.0, 2.0], [4.0, 3.0], [1.0, 5.0]]
            .iter()
            .any(|low: &[f64; 2]| (0..2).all(|i| (low[i]..low[i] + 1.0).contains(&middle[i])))
    };
    let triangles = whole.triangles().iter().filter(|t| !in_hole(t)).copied();
    let used: Vec<[u32; 3]> = triangles.collect();
    let mut number = vec![u32::MAX; whole.vertex_count()];
    let mut points = Vec::new();
    for &v in used.as_flattened() {
        if number[v as usize] == u32::MAX {
            number[v as usize] = points.len() as u32;
            points.push(whole.position(v as usize).map(|x| 0.5 * x));
        }
    }
    let triangles = used.iter().map(|t| t.map(|v| number[v as usize])).collect();
    let mesh = TriangleMesh::new(points, triangles).unwrap();
    let uvs: Corners = mesh
        .triangles()
        .iter()
        .map(|t| t.map(|v| flat(&mesh, v)))
        .collect();
    let quads = quads_of(&mesh, &uvs);
    assert_eq!(mesh.euler_characteristic(), -2);
    assert!(quads.is_conforming(), "{:?}", quads.figures());
    assert_eq!(quads.quads.len(), 7 * 7 - 3);
}

#[test]
fn partial_cells_at_a_boundary_off_the_isolines_are_reported() {
    let (mesh, uvs) = plane(4);
    let shifted = uvs
        .iter()
        .map(|uv| uv.map(|[u, v]| [u + 0.25, v + 0.5]))
        .collect();
    let quads = quads_of(&mesh, &shifted);
    assert_eq!((quads.quads.len(), quads.others.len()), (9, 0));
    assert_eq!(quads.partial_cells, 16);
    assert!(quads.is_conforming());
}

#[test]
fn a_chart_for_each_side_of_a_cube_gives_its_squares() {
    for (n, scale) in [(1, 1.0), (1, 3.0), (2, 3.0), (4, 2.0), (3, 3.0)] {
        let (mesh, uvs) = cube(n, scale);
        let quads = quads_of(&mesh, &uvs);
        let side = scale as usize;
        assert_eq!(quads.quads.len(), 6 * side * side, "{n} {scale}");
        assert!(quads.is_conforming(), "{n} {scale}");
        let valences = valences(&quads);
        assert!(valences[..8] == [3; 8] && valences[8..].iter().all(|&v| v == 4));
        let at_corners = quads
            .origins
            .iter()
            .filter(|o| matches!(o, Origin::Vertex(_)));
        assert_eq!(at_corners.count(), 8);
        for p in &quads.vertices {
            let on_lines = p
                .iter()
                .all(|x| (x * scale - (x * scale).round()).abs() < 1e-6);
            assert!(on_lines, "{p:?}");
        }
    }
}

#[test]
fn turning_and_shifting_charts_does_not_change_the_quads() {
    let (mesh, uvs) = cube(3, 4.0);
    let before = quads_of(&mesh, &uvs);
    let charts: Corners = (uvs.iter().enumerate())
        .map(|(face, uv)| {
            let chart = face / 18;
            uv.map(|[u, v]| {
                let turned = (0..chart).fold([u, v], |[u, v], _| [-v, u]);
                [turned[0] + 7.0 * chart as f64, turned[1] - 3.0]
            })
        })
        .collect();
    let after = quads_of(&mesh, &charts);
    assert_eq!(before.quads.len(), after.quads.len());
    let sorted = |quads: &QuadMesh| {
        let mut all: Vec<Vec<[i64; 3]>> = (quads.quads.iter())
            .map(|quad| {
                let corner =
                    |&v: &u32| quads.vertices[v as usize].map(|x| (x * 1e6).round() as i64);
                let mut corners: Vec<[i64; 3]> = quad.iter().map(corner).collect();
                let least = corners.iter().enumerate().min_by_key(|c| c.1).unwrap().0;
                corners.rotate_left(least);
                corners
            })
            .collect();
        all.sort_unstable();
        all
    };
    assert_eq!(sorted(&before), sorted(&after));
}

#[test]
fn folds_away_from_irregular_vertices_do_not_change_the_quads() {
    let (mesh, uvs) = plane(6);
    let mut at: Vec<[f64; 2]> = (0..mesh.vertex_count() as u32)
        .map(|v| flat(&mesh, v))
        .collect();
    // Move two vertices over their neighbours and over integer points.
    at[3 * 7 + 3] = [4.6, 4.3];
    at[2 * 7 + 2] = [2.4, 3.7];
    let folded = mesh
        .triangles()
        .iter()
        .map(|t| t.map(|v| at[v as usize]))
        .collect();
    let (before, after) = (quads_of(&mesh, &uvs), quads_of(&mesh, &folded));
    assert!(after.folds_removed > 0);
    assert_eq!(
        (after.quads.len(), after.others.len()),
        (before.quads.len(), 0)
    );
    assert_eq!(after.vertices.len(), before.vertices.len());
    assert!(after.is_conforming());
}

#[test]
fn quads_have_the_topology_of_their_shape() {
    for name in [
        "rounded-cube",
        "sphere",
        "torus",
        "genus-2",
        "genus-3",
        "gear",
    ] {
        let mesh = shape::by_name(name, 2000).unwrap();
        let map = map_of(&mesh, 400);
        let grid = IntegerGridMap::from_seamless(&mesh, &map).unwrap();
        let mut quads = extract(&mesh, &grid, &mut Monitor::default()).unwrap();
        assert!(quads.is_conforming(), "{name}: {:?}", quads.figures());
        assert_eq!(quads.figures().boundary_edges, 0, "{name}");
        let same = quads_of(&mesh, &map.corner_uvs());
        assert_eq!(
            quads, same,
            "{name}: with given and with computed transitions"
        );
        if quads.folds_removed + quads.repaired == 0 {
            assert_eq!(quads.figures().irregular, map.cones().len(), "{name}");
        }
        let before = QuadQuality::new(&quads);
        smooth(
            &mut quads,
            &mesh,
            &SmoothOptions::default(),
            &mut Monitor::default(),
        )
        .unwrap();
        let after = QuadQuality::new(&quads);
        assert!(after.angle_deviation < before.angle_deviation, "{name}");
        assert!(after.scaled_jacobian_min > 0.0, "{name}: {after:?}");
    }
}

#[test]
fn valences_follow_from_the_indices_of_the_field() {
    let mesh = shape::by_name("rounded-cube", 3000).unwrap();
    let quads = quads_of(&mesh, &map_of(&mesh, 500).corner_uvs());
    let valences = valences(&quads);
    assert!(valences[..8] == [3; 8] && valences[8..].iter().all(|&v| v == 4));
}

#[test]
fn bad_input_is_refused_with_the_element_at_fault() {
    let (mesh, uvs) = cube(2, 2.0);
    let refused = |face: usize, value: f64| {
        let mut uvs = uvs.clone();
        uvs[face][1][0] = value;
        IntegerGridMap::new(&mesh, &uvs).unwrap_err()
    };
    for value in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
        let error = refused(7, value);
        assert_eq!((error.code(), error.index()), ("not_finite", Some(7)));
    }
    let error = refused(11, 1e300);
    assert_eq!((error.code(), error.index()), ("overflow", Some(11)));
    // The first of the two edges at the corner.
    let error = refused(3, 0.77);
    let first = [0, 1].map(|k| mesh.edge_of(3, k)).into_iter().min();
    assert_eq!((error.code(), error.index()), ("invalid_argument", first));
    let short = IntegerGridMap::new(&mesh, &uvs[1..]).unwrap_err();
    assert_eq!(short.code(), "length_mismatch");
    let huge = uvs
        .iter()
        .map(|uv| uv.map(|p| p.map(|x| 1e6 * x)))
        .collect::<Corners>();
    let map = IntegerGridMap::new(&mesh, &huge).unwrap();
    let error = extract(&mesh, &map, &mut Monitor::default()).unwrap_err();
    assert_eq!(error.code(), "overflow");
}

#[test]
fn irregular_vertices_off_the_integers_are_refused() {
    let (mesh, uvs) = cube(1, 1.0);
    // Transitions are still integers after a shift by half a unit, but irregular vertices are not.
    let halved: Corners = uvs
        .iter()
        .map(|uv| uv.map(|p| p.map(|x| x + 0.5)))
        .collect();
    let error = IntegerGridMap::new(&mesh, &halved).unwrap_err();
    assert_eq!(error.code(), "invalid_argument");
    assert!(error.index().is_some());
}

#[test]
fn maps_with_moved_vertices_give_faces_with_an_even_number_of_sides() {
    let (mesh, _) = plane(7);
    let mut state = 0.123;
    let mut random = || {
        state = (state * 997.31_f64).fract();
        state
    };
    for _ in 0..30 {
        let at: Vec<[f64; 2]> = (0..mesh.vertex_count())
            .map(|_| [0; 2].map(|_| 9.0 * random()))
            .collect();
        let uvs = mesh
            .triangles()
            .iter()
            .map(|t| t.map(|v| at[v as usize]))
            .collect();
        let quads = quads_of(&mesh, &uvs);
        assert!(quads.others.iter().all(|face| face.len() % 2 == 0));
        let unused =
            (0..quads.vertices.len() as u32).find(|v| !quads.faces().flatten().any(|w| w == v));
        assert_eq!(unused, None);
    }
}

#[test]
fn a_cancelled_extraction_returns_that_error() {
    let (mesh, uvs) = plane(3);
    let token = CancelToken::new();
    token.cancel();
    let mut monitor = Monitor::default().cancel_token(token);
    let map = IntegerGridMap::new(&mesh, &uvs).unwrap();
    assert_eq!(extract(&mesh, &map, &mut monitor), Err(Error::Cancelled));
}
