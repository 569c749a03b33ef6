//! Curves in space as guides of a field and as edge loops of quads, against closed forms.

use std::collections::BTreeMap;
use std::f64::consts::{FRAC_PI_2, TAU};

use crate::common::Random;
use crate::common::archive::{MISSING, archive};

use roundel::field::{Guidance, guides_along, smoothest_field};
use roundel::geodesic::{SurfacePoint, cut_along, draw_curve};
use roundel::map::Sizing;
use roundel::mesh::refine::CutAlong;
use roundel::mesh::vector::{Vec3, dot, norm, sub};
use roundel::mesh::{ClosestPoint, TriangleMesh, io, shape};
use roundel::quad::{QuadOptions, Quadrangulation, quadrangulate};
use roundel::{Monitor, Options};

const HEIGHT: f64 = 3.0;

/// An open cylinder of radius 1 from height 0 to [`HEIGHT`].
fn cylinder(around: u32, up: u32) -> TriangleMesh {
    let rows = 0..=up;
    let point = |row: u32, k: u32| {
        let (s, c) = (TAU * f64::from(k) / f64::from(around)).sin_cos();
        [c, s, HEIGHT * f64::from(row) / f64::from(up)]
    };
    let points = rows.flat_map(|row| (0..around).map(move |k| point(row, k)));
    let faces = (0..up).flat_map(|row| {
        (0..around).flat_map(move |k| {
            let at = |row: u32, k: u32| row * around + k % around;
            let (a, b, c, d) = (
                at(row, k),
                at(row, k + 1),
                at(row + 1, k + 1),
                at(row + 1, k),
            );
            [[a, b, c], [a, c, d]]
        })
    });
    TriangleMesh::new(points.collect(), faces.collect()).unwrap()
}

/// A helix that rises at this slope, six tenths of the way around.
fn helix(slope: f64, from: f64) -> Vec<Vec3> {
    let angles = (0..=400).map(|i| 0.6 * TAU * f64::from(i) / 400.0);
    angles
        .map(|a| [a.cos(), a.sin(), from + a * slope])
        .collect()
}

/// A closed circle around the cylinder.
fn circle(height: f64, points: u32) -> Vec<Vec3> {
    let angles = (0..=points).map(|i| TAU * f64::from(i % points) / f64::from(points) + 0.01);
    angles.map(|a| [a.cos(), a.sin(), height]).collect()
}

fn drawn(mesh: &TriangleMesh, points: &[Vec3]) -> Vec<SurfacePoint> {
    draw_curve(mesh, points, &Monitor::default()).unwrap()
}

/// The angle between an arm of a cross and a direction, at most an eighth of a turn.
fn off(angle: f64) -> f64 {
    let quarters = angle / FRAC_PI_2;
    (quarters - quarters.round()).abs() * FRAC_PI_2
}

#[test]
fn a_field_follows_a_helix_at_30_degrees() {
    let mesh = cylinder(60, 30);
    let slope = 30f64.to_radians();
    let curve = drawn(&mesh, &helix(slope.tan(), 0.35));
    for align_boundary in [false, true] {
        let guidance = Guidance {
            guides: guides_along(&mesh, std::slice::from_ref(&curve), 4, 10.0).unwrap(),
            align_boundary,
            ..Guidance::default()
        };
        assert!(guidance.guides.len() > 70);
        let features = guidance.features(&mesh).unwrap();
        let options = guidance.field_options(&mesh, &features).unwrap();
        let monitor = Monitor::default;
        let (field, _) = smoothest_field(&mesh, &options, &Options::default(), monitor).unwrap();
        for guide in &guidance.guides {
            let [x, y, _] = mesh.face_centroid(guide.face);
            let round = [-y / x.hypot(y), x / x.hypot(y), 0.0];
            let along =
                [0, 1, 2].map(|i| slope.cos() * round[i] + slope.sin() * [0.0, 0.0, 1.0][i]);
            let [u, v] = mesh.frame(guide.face).map(|axis| dot(along, axis));
            let error = off(field.angles()[guide.face] - v.atan2(u)).to_degrees();
            assert!(error < 2.0, "face {}: {error} degrees", guide.face);
        }
    }
}

#[test]
fn a_cut_keeps_the_surface_and_has_the_curve_as_edges() {
    let mesh = cylinder(40, 20);
    let curve = drawn(&mesh, &circle(1.234, 97));
    let CutAlong { cut, curves } = cut_along(&mesh, &[curve]).unwrap();
    assert_eq!(cut.mesh.vertices()[..mesh.vertex_count()], *mesh.vertices());
    let area = cut.mesh.surface_area() / mesh.surface_area();
    assert!((area - 1.0).abs() < 1e-13, "{area}");
    assert_eq!(cut.mesh.euler_characteristic(), 0);
    for (face, &origin) in cut.face_origin.iter().enumerate() {
        let turned = dot(cut.mesh.normal(face), mesh.normal(origin as usize));
        assert!(turned > 1.0 - 1e-9);
    }
    let length: f64 = curves[0]
        .iter()
        .map(|&e| {
            let [p, q] = cut.mesh.edge(e).vertices.map(|v| cut.mesh.position(v));
            assert!((p[2] - 1.234).abs() < 1e-12 && (q[2] - 1.234).abs() < 1e-12);
            norm(sub(q, p))
        })
        .sum();
    let exact = 80.0 * (TAU / 80.0).sin();
    assert!((length / exact - 1.0).abs() < 1e-12, "{length} {exact}");
    // Two vertices for each side: on its upright edge, and on its diagonal.
    assert_eq!(cut.splits, 80);
    assert_eq!(curves[0].len(), 80);
}

fn quads(cut: &CutAlong, quads: usize) -> Quadrangulation {
    let mut options = QuadOptions {
        sizing: Sizing::Quads(quads),
        ..QuadOptions::default()
    };
    options.guidance.constrain_curvature = 0.0;
    options.guidance.feature_edges = cut.edges();
    let made = quadrangulate(&cut.cut.mesh, &options, Monitor::default).unwrap();
    assert!(made.quads.is_conforming());
    assert!(made.missed_features.is_empty());
    made
}

/// The length of the longest closed chain of quad edges between vertices of a kind, each of which has two of them.
fn closed_chain(made: &Quadrangulation, is_on: impl Fn(Vec3) -> bool) -> Option<f64> {
    let quads = &made.quads;
    let on: Vec<bool> = quads.vertices.iter().map(|&p| is_on(p)).collect();
    let mut beside = vec![Vec::new(); on.len()];
    for quad in &quads.quads {
        for k in 0..4 {
            let [a, b] = [quad[k], quad[(k + 1) % 4]].map(|v| v as usize);
            if on[a] && on[b] && !beside[a].contains(&b) {
                beside[a].push(b);
                beside[b].push(a);
            }
        }
    }
    let start = (0..on.len()).find(|&v| on[v])?;
    let (mut last, mut here, mut length) = (usize::MAX, start, 0.0);
    loop {
        if beside[here].len() != 2 {
            return None;
        }
        let next = match beside[here][0] == last {
            true => beside[here][1],
            false => beside[here][0],
        };
        length += norm(sub(quads.vertices[next], quads.vertices[here]));
        (last, here) = (here, next);
        if here == start {
            return Some(length);
        }
    }
}

#[test]
fn a_circle_at_any_height_is_an_edge_loop() {
    let mesh = cylinder(60, 30);
    for height in [0.777, 1.512_345, 2.2] {
        let cut = cut_along(&mesh, &[drawn(&mesh, &circle(height, 100))]).unwrap();
        let made = quads(&cut, 500);
        let length = closed_chain(&made, |p| (p[2] - height).abs() < 1e-6);
        let length = length.unwrap_or_else(|| panic!("no loop at {height}"));
        assert!((length / TAU - 1.0).abs() < 0.02, "{length}");
    }
}

#[test]
fn a_tilted_great_circle_is_an_edge_loop_of_a_sphere() {
    let mesh = shape::by_name("sphere", 3_000).unwrap();
    // In the plane across this normal.
    let normal = [0.36, 0.48, 0.8];
    let [x, y] = [[0.8, -0.6, 0.0], [0.48, 0.64, -0.6]];
    let points: Vec<Vec3> = (0..=200)
        .map(|i| {
            let (s, c) = (TAU * f64::from(i % 200) / 200.0).sin_cos();
            [0, 1, 2].map(|k| c * x[k] + s * y[k])
        })
        .collect();
    let cut = cut_along(&mesh, &[drawn(&mesh, &points)]).unwrap();
    let made = quads(&cut, 600);
    // The curve runs through vertices that are nearer than a tenth of an edge.
    let near = 1e-3 * 12f64.sqrt() + 1e-9;
    let length = closed_chain(&made, |p| dot(p, normal).abs() < near);
    let length = length.expect("a loop");
    assert!((length / TAU - 1.0).abs() < 0.02, "{length}");
}

#[test]
fn a_curve_around_an_elephant_is_an_edge_loop() {
    let Some(folder) = archive() else {
        return crate::common::skip::skip_unless_ci(MISSING);
    };
    let mesh = io::read(folder.join("elephant.off")).unwrap();
    let section = section(&mesh, -0.036);
    // Every eighth point, as a hand would draw it.
    let few: Vec<Vec3> = section
        .iter()
        .step_by(8)
        .chain(&section[..1])
        .copied()
        .collect();
    assert!(few.len() >= 8, "{}", few.len());
    let curve = drawn(&mesh, &few);
    let places: Vec<Vec3> = curve.iter().map(|p| p.position(&mesh)).collect();
    let whole: f64 = places.windows(2).map(|w| norm(sub(w[1], w[0]))).sum();
    let cut = cut_along(&mesh, &[curve]).unwrap();
    let made = quads(&cut, 2000);
    // A closed chain of edges of the quads that lies on the edges of the cut.
    let segments: Vec<[Vec3; 3]> = cut
        .edges()
        .iter()
        .map(|&e| {
            let [p, q] = cut
                .cut
                .mesh
                .edge(e)
                .vertices
                .map(|v| cut.cut.mesh.position(v));
            [p, q, q]
        })
        .collect();
    let tree = ClosestPoint::of_triangles(segments);
    let is_on = |p: Vec3| norm(sub(tree.find(p, None).unwrap().1, p)) < 1e-9;
    let length = closed_chain(&made, is_on).expect("a loop");
    assert!((length / whole - 1.0).abs() < 0.05, "{length} {whole}");
}

/// Where a plane across x cuts a mesh: the loop with most points.
fn section(mesh: &TriangleMesh, x: f64) -> Vec<Vec3> {
    let is_left = |v: usize| mesh.position(v)[0] < x;
    let mut next = BTreeMap::new();
    for face in 0..mesh.face_count() {
        let corners = mesh.corners(face).map(is_left);
        let side = |to: [bool; 2]| (0..3).find(|&k| [corners[k], corners[(k + 1) % 3]] == to);
        if let (Some(k), Some(l)) = (side([true, false]), side([false, true])) {
            next.insert(mesh.edge_of(face, k), mesh.edge_of(face, l));
        }
    }
    let mut best: Vec<usize> = Vec::new();
    while let Some((&first, _)) = next.first_key_value() {
        let (mut edges, mut here) = (Vec::new(), first);
        while let Some(there) = next.remove(&here) {
            edges.push(here);
            here = there;
        }
        if edges.len() > best.len() {
            best = edges;
        }
    }
    let point = |e: usize| {
        let [p, q] = mesh.edge(e).vertices.map(|v| mesh.position(v));
        let share = (x - p[0]) / (q[0] - p[0]);
        [0, 1, 2].map(|i| p[i] + share * (q[i] - p[i]))
    };
    best.into_iter().map(point).collect()
}

#[test]
fn curves_that_cross_share_a_vertex() {
    let mesh = shape::by_name("plane", 200).unwrap();
    let lines = [
        [[-0.83, -0.71, 0.0], [0.77, 0.63, 0.0]],
        [[-0.52, 0.81, 0.0], [0.61, -0.67, 0.0]],
        // Along the first one.
        [[-0.03, -0.04, 0.0], [0.77, 0.63, 0.0]],
    ];
    let curves: Vec<_> = lines.iter().map(|line| drawn(&mesh, line)).collect();
    let found = cut_along(&mesh, &curves).unwrap();
    let vertices = |curve: &Vec<usize>| {
        let ends = curve.iter().flat_map(|&e| found.cut.mesh.edge(e).vertices);
        ends.collect::<std::collections::BTreeSet<usize>>()
    };
    let [one, two] = [0, 1].map(|i| vertices(&found.curves[i]));
    assert_eq!(one.intersection(&two).count(), 1);
    for (line, curve) in lines.iter().zip(&found.curves) {
        let length = |e: &usize| {
            let [p, q] = found
                .cut
                .mesh
                .edge(*e)
                .vertices
                .map(|v| found.cut.mesh.position(v));
            norm(sub(q, p))
        };
        let whole: f64 = curve.iter().map(length).sum();
        let exact = norm(sub(line[1], line[0]));
        assert!((whole / exact - 1.0).abs() < 0.01, "{whole} {exact}");
    }
}

/// Whether edges follow each other tip to tail.
fn is_chain(mesh: &TriangleMesh, edges: &[usize]) -> bool {
    edges.windows(2).all(|pair| {
        let [one, two] = [pair[0], pair[1]].map(|e| mesh.edge(e).vertices);
        one.iter().any(|v| two.contains(v))
    })
}

#[test]
fn many_random_curves_are_cut_into_fine_and_coarse_meshes() {
    let mut random = Random::new(7);
    let coarse = cylinder(7, 1);
    let shapes = ["plate-with-holes", "gear", "genus-3", "sphere"];
    let mut meshes: Vec<_> = shapes.map(|name| shape::by_name(name, 600).unwrap()).into();
    meshes.push(coarse);
    for mesh in meshes {
        let mut curves = Vec::new();
        for _ in 0..12 {
            let points: Vec<Vec3> = (0..5)
                .map(|_| {
                    let share = 0.5 + 0.5 * random.next().clamp(-1.0, 1.0);
                    let face = (share * (mesh.face_count() - 1) as f64) as usize;
                    let [u, v] = [0, 1].map(|_| random.next().abs().fract());
                    let barycentric = [1.0 - u, u * (1.0 - v), u * v];
                    SurfacePoint { face, barycentric }.position(&mesh)
                })
                .collect();
            curves.push(drawn(&mesh, &points));
        }
        let found = cut_along(&mesh, &curves).unwrap();
        let cut = &found.cut;
        let area = cut.mesh.surface_area() / mesh.surface_area();
        assert!((area - 1.0).abs() < 1e-12, "{area}");
        let euler = mesh.euler_characteristic();
        assert_eq!(cut.mesh.euler_characteristic(), euler);
        let [low, high] = mesh.bounding_box();
        let near = 2e-3 * norm(sub(high, low));
        for (curve, edges) in curves.iter().zip(&found.curves) {
            assert!(is_chain(&cut.mesh, edges));
            let places: Vec<Vec3> = curve.iter().map(|p| p.position(&mesh)).collect();
            let pieces = places.windows(2).map(|w| [w[0], w[1], w[1]]);
            let tree = ClosestPoint::of_triangles(pieces.collect());
            for &e in edges {
                for v in cut.mesh.edge(e).vertices {
                    let p = cut.mesh.position(v);
                    let off = norm(sub(tree.find(p, None).unwrap().1, p));
                    assert!(off < near, "{off}");
                }
            }
            let length = |edges: &[Vec3; 2]| norm(sub(edges[1], edges[0]));
            let drawn: f64 = places.windows(2).map(|w| length(&[w[0], w[1]])).sum();
            let ends = |&e: &usize| cut.mesh.edge(e).vertices.map(|v| cut.mesh.position(v));
            let cut: f64 = edges.iter().map(ends).map(|ends| length(&ends)).sum();
            assert!((cut / drawn - 1.0).abs() < 0.03, "{cut} {drawn}");
        }
    }
}

#[test]
fn bad_curves_are_refused_with_their_place() {
    let mesh = cylinder(20, 10);
    let draw = |points: &[Vec3]| draw_curve(&mesh, points, &Monitor::default()).unwrap_err();
    let on = [1.0, 0.0, 1.0];
    let error = draw(&[on, [0.0, 1.0, 1.0], [0.0, 9.0, 1.0]]);
    assert_eq!((error.code(), error.index()), ("invalid_argument", Some(2)));
    assert_eq!(draw(&[on]).code(), "invalid_argument");
    assert_eq!(draw(&[]).code(), "invalid_argument");
    let error = draw(&[on, [f64::NAN, 0.0, 0.0]]);
    assert_eq!((error.code(), error.index()), ("not_finite", Some(1)));
    let good = drawn(&mesh, &[on, [0.0, 1.0, 1.5]]);
    let far = vec![good[0], good[good.len() - 1]];
    let curve = |curve: Vec<SurfacePoint>| [good.clone(), curve];
    let outside = vec![
        good[0],
        SurfacePoint {
            face: 400,
            barycentric: [1.0, 0.0, 0.0],
        },
    ];
    let beside = vec![
        good[0],
        SurfacePoint {
            face: 0,
            barycentric: [1.5, -0.5, 0.0],
        },
    ];
    for (bad, code) in [
        (far, "invalid_argument"),
        (vec![good[0]], "invalid_argument"),
        (outside, "index_out_of_range"),
        (beside, "invalid_argument"),
    ] {
        for error in [
            cut_along(&mesh, &curve(bad.clone())).unwrap_err(),
            guides_along(&mesh, &curve(bad.clone()), 4, 1.0).unwrap_err(),
        ] {
            assert_eq!((error.code(), error.index()), (code, Some(1)), "{error}");
        }
    }
    let error = cut_along(&mesh, &[vec![good[0]; 2]]).unwrap_err();
    assert_eq!((error.code(), error.index()), ("invalid_argument", Some(0)));
    for weight in [-1.0, f64::NAN, f64::INFINITY] {
        assert!(guides_along(&mesh, std::slice::from_ref(&good), 4, weight).is_err());
    }
    assert!(guides_along(&mesh, &[good], 3, 1.0).is_err());
}
