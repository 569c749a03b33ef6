//! Quads that follow a base layout, on shapes and on meshes of the archive.

#[cfg(feature = "mesh-io")]
use roundel::layout::{BaseLayout, LayoutOptions, LayoutQuads, LayoutSizing, layout_quads};
use roundel::mesh::vector::Vec3;
use roundel::mesh::{TriangleMesh, shape};
use roundel::{Error, Monitor, Result};

/// The corners of a box by bits, and its sides, seen from outside.
const SIDES: [[u32; 4]; 6] = [
    [0, 2, 3, 1],
    [4, 5, 7, 6],
    [0, 1, 5, 4],
    [2, 6, 7, 3],
    [0, 4, 6, 2],
    [1, 3, 7, 5],
];

/// The box around a mesh.
fn box_around(mesh: &TriangleMesh) -> BaseLayout {
    let ends = mesh.bounding_box();
    let corner = |v: usize| [0, 1, 2].map(|axis| ends[v >> axis & 1][axis]);
    let polygons = SIDES.iter().map(|side| side.to_vec()).collect();
    BaseLayout::new((0..8).map(corner).collect(), polygons).unwrap()
}

/// Triangles around the middle of a box: each side in four.
fn pyramids(mesh: &TriangleMesh) -> BaseLayout {
    let whole = box_around(mesh);
    let mut positions = whole.positions().to_vec();
    let mut polygons = Vec::new();
    for side in SIDES {
        let middle = positions.len() as u32;
        let corners = side.map(|v| positions[v as usize]);
        positions.push([0, 1, 2].map(|axis| corners.iter().map(|p| p[axis]).sum::<f64>() / 4.0));
        polygons.extend((0..4).map(|k| vec![side[k], side[(k + 1) % 4], middle]));
    }
    BaseLayout::new(positions, polygons).unwrap()
}

fn solve(mesh: &TriangleMesh, layout: &BaseLayout, options: &LayoutOptions) -> Result<LayoutQuads> {
    layout_quads(mesh, layout, options, Monitor::default)
}

fn sized(sizing: LayoutSizing) -> LayoutOptions {
    LayoutOptions {
        sizing,
        ..LayoutOptions::default()
    }
}

fn hold(found: &LayoutQuads, name: &str) {
    assert!(found.is_as_prescribed, "{name}");
    assert_eq!(found.folded, 0, "{name}");
    assert!(found.subdivisions.is_optimal, "{name}");
}

#[test]
fn a_box_around_a_shape_gives_quads_of_any_number() {
    for (name, triangles) in [("sphere", 1_000), ("rounded-cube", 2_000)] {
        let mesh = shape::by_name(name, triangles).unwrap();
        let layout = box_around(&mesh);
        let fewest = solve(&mesh, &layout, &sized(LayoutSizing::Fewest)).unwrap();
        hold(&fewest, name);
        assert_eq!(fewest.quads.quads.len(), 6, "{name}");
        for asked in [100, 1_500] {
            let found = solve(&mesh, &layout, &sized(LayoutSizing::Quads(asked))).unwrap();
            hold(&found, name);
            let off = (found.quads.quads.len() as f64 / asked as f64 - 1.0).abs();
            assert!(off < 0.15, "{name}: {} of {asked}", found.quads.quads.len());
        }
    }
}

#[test]
fn patches_of_three_sides_get_an_irregular_vertex_in_their_middle() {
    let mesh = shape::by_name("sphere", 2_000).unwrap();
    let layout = pyramids(&mesh);
    let fewest = solve(&mesh, &layout, &sized(LayoutSizing::Fewest)).unwrap();
    hold(&fewest, "fewest");
    assert_eq!(fewest.quads.quads.len(), 3 * 24);
    let found = solve(&mesh, &layout, &sized(LayoutSizing::Quads(1_500))).unwrap();
    hold(&found, "1500");
}

#[test]
fn arcs_at_the_boundary_run_along_it() {
    let mesh = shape::by_name("plane", 800).unwrap();
    let positions: Vec<Vec3> = [-1.0, 1.0]
        .into_iter()
        .flat_map(|y| [-1.0, 0.2, 1.0].map(|x| [x, y, 0.1]))
        .collect();
    let layout = BaseLayout::new(positions, vec![vec![0, 1, 4, 3], vec![1, 2, 5, 4]]).unwrap();
    let fewest = solve(&mesh, &layout, &sized(LayoutSizing::Fewest)).unwrap();
    hold(&fewest, "fewest");
    assert_eq!(fewest.quads.quads.len(), 2);
    let found = solve(&mesh, &layout, &sized(LayoutSizing::Quads(400))).unwrap();
    hold(&found, "400");
    let [low, high] = mesh.bounding_box();
    let area: f64 = found
        .quads
        .quads
        .iter()
        .map(|quad| {
            let [a, b, c, d] = quad.map(|v| found.quads.vertices[v as usize]);
            0.5 * ((c[0] - a[0]) * (d[1] - b[1]) - (c[1] - a[1]) * (d[0] - b[0]))
        })
        .sum();
    assert!((area - (high[0] - low[0]) * (high[1] - low[1])).abs() < 1e-9);
}

#[test]
fn the_bytes_do_not_depend_on_threads_or_orientation() {
    let mesh = shape::by_name("rounded-cube", 2_000).unwrap();
    let layout = box_around(&mesh);
    let with = |threads| LayoutOptions {
        threads,
        ..LayoutOptions::default()
    };
    let one = solve(&mesh, &layout, &with(1)).unwrap();
    for threads in [2, 4] {
        assert_eq!(solve(&mesh, &layout, &with(threads)).unwrap(), one);
    }
    let turned = SIDES
        .iter()
        .map(|side| side.iter().rev().copied().collect());
    let turned = BaseLayout::new(layout.positions().to_vec(), turned.collect()).unwrap();
    let other = solve(&mesh, &turned, &with(1)).unwrap();
    hold(&other, "turned over");
    assert_eq!(other.quads.quads.len(), one.quads.quads.len());
}

#[test]
fn a_fixed_number_of_edges_is_kept_and_spreads() {
    let mesh = shape::by_name("sphere", 1_000).unwrap();
    let layout = box_around(&mesh);
    let arc = layout.arc_between(0, 1).unwrap();
    let options = LayoutOptions {
        fixed: vec![(arc, 7)],
        ..sized(LayoutSizing::Quads(300))
    };
    let found = solve(&mesh, &layout, &options).unwrap();
    hold(&found, "sphere");
    for ends in [[0, 1], [2, 3], [4, 5], [6, 7]] {
        let arc = layout.arc_between(ends[0], ends[1]).unwrap();
        assert_eq!(found.subdivisions.arcs[arc], 7);
    }
}

#[test]
fn an_arc_follows_the_course_that_is_given() {
    let mesh = shape::by_name("sphere", 4_000).unwrap();
    let layout = box_around(&mesh);
    let arc = layout.arc_between(0, 1).unwrap();
    let [a, b] = layout.arcs()[arc].map(|v| layout.positions()[v as usize]);
    // A detour towards the middle of a side.
    let middle = [0, 1, 2].map(|axis| 0.5 * (a[axis] + b[axis]) * [1.0, 0.6, 1.3][axis]);
    let on = |p: Vec3| {
        let length = p.iter().map(|x| x * x).sum::<f64>().sqrt();
        p.map(|x| x / length)
    };
    let radius = mesh.bounding_box()[1][0];
    let course = [a, middle, b].map(|p| on(p).map(|x| radius * x));
    let nearest = |points: &[Vec3]| {
        let off = points
            .iter()
            .map(|p| (0..3).map(|k| (p[k] - course[1][k]).powi(2)).sum::<f64>());
        off.fold(f64::INFINITY, f64::min).sqrt()
    };
    for (hold_curves, most) in [(true, 0.02), (false, 0.1)] {
        let options = LayoutOptions {
            curves: vec![(arc, course.to_vec())],
            hold_curves,
            ..sized(LayoutSizing::Quads(600))
        };
        let found = solve(&mesh, &layout, &options).unwrap();
        hold(&found, "sphere");
        assert!(nearest(&found.arcs[arc]) < most * radius, "{hold_curves}");
    }
}

/// A torus of `columns` times `rows` patches about the z axis.
fn torus_layout(columns: usize, rows: usize, [great, small]: [f64; 2]) -> BaseLayout {
    let angle = |i: usize, n: usize| std::f64::consts::TAU * i as f64 / n as f64;
    let at = |i: usize, j: usize| (j % rows * columns + i % columns) as u32;
    let positions = (0..columns * rows).map(|v| {
        let (s, c) = angle(v % columns, columns).sin_cos();
        let (z, r) = angle(v / columns, rows).sin_cos();
        [(great + small * r) * c, (great + small * r) * s, small * z]
    });
    let polygons = (0..columns * rows).map(|p| {
        let (i, j) = (p % columns, p / columns);
        vec![at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)]
    });
    BaseLayout::new(positions.collect(), polygons.collect()).unwrap()
}

#[test]
fn a_torus_is_covered_by_patches_around_it() {
    let mesh = shape::by_name("torus", 2_000).unwrap();
    let [low, high] = mesh.bounding_box();
    let small = 0.5 * (high[2] - low[2]);
    let layout = torus_layout(5, 3, [high[0] - small, small]);
    for (asked, quads) in [
        (LayoutSizing::Fewest, 15..16),
        (LayoutSizing::Quads(900), 700..1100),
    ] {
        let found = solve(&mesh, &layout, &sized(asked)).unwrap();
        hold(&found, "torus");
        assert!(
            quads.contains(&found.quads.quads.len()),
            "{}",
            found.quads.quads.len()
        );
    }
}

#[test]
fn vertices_may_be_well_off_their_best_places() {
    let mesh = shape::by_name("torus", 4_000).unwrap();
    let [low, high] = mesh.bounding_box();
    let small = 0.5 * (high[2] - low[2]);
    let even = torus_layout(12, 5, [high[0] - small, small]);
    let wave = |v: usize, k: usize| (7.0 * v as f64 + 3.0 * k as f64).sin();
    let moved = even
        .positions()
        .iter()
        .enumerate()
        .map(|(v, p)| [0, 1, 2].map(|k| p[k] + 0.25 * small * wave(v, k)));
    let layout = BaseLayout::new(moved.collect(), even.polygons().to_vec()).unwrap();
    let found = solve(&mesh, &layout, &sized(LayoutSizing::Fewest)).unwrap();
    hold(&found, "moved");
    assert_eq!(found.quads.quads.len(), 60);
    let total = |found: &LayoutQuads| found.lengths.iter().sum::<f64>();
    let best = solve(&mesh, &even, &sized(LayoutSizing::Fewest)).unwrap();
    assert!(
        total(&found) < 1.5 * total(&best),
        "{} {}",
        total(&found),
        total(&best)
    );
}

#[cfg(feature = "mesh-io")]
#[test]
fn patches_of_whole_legs_are_filled() {
    let Some(archive) = crate::common::archive::archive() else {
        return crate::common::skip::skip_unless_ci(crate::common::archive::MISSING);
    };
    let cow = roundel::mesh::io::read(archive.join("cow.off")).unwrap();
    let found = solve(&cow, &box_around(&cow), &sized(LayoutSizing::Fewest)).unwrap();
    hold(&found, "cow");
    assert_eq!(found.quads.quads.len(), 6);
}

#[test]
fn layouts_that_do_not_fit_name_what_is_wrong() {
    let sphere = shape::by_name("sphere", 1_000).unwrap();
    let layout = box_around(&sphere);
    let default = LayoutOptions::default();
    let torus = shape::by_name("torus", 1_000).unwrap();
    let error = solve(&torus, &layout, &default).unwrap_err();
    assert!(
        error.to_string().contains("Euler characteristic 2"),
        "{error}"
    );
    let mut far = layout.positions().to_vec();
    far[3] = [40.0; 3];
    let far = BaseLayout::new(far, layout.polygons().to_vec()).unwrap();
    let error = solve(&sphere, &far, &default).unwrap_err();
    assert_eq!(error.index(), Some(3), "{error}");
    for sizing in [
        LayoutSizing::Quads(0),
        LayoutSizing::EdgeLength(0.0),
        LayoutSizing::EdgeLength(f64::NAN),
    ] {
        let error = solve(&sphere, &layout, &sized(sizing)).unwrap_err();
        assert_eq!(error.code(), "invalid_argument", "{error}");
    }
    let arc = |a, b| layout.arc_between(a, b).unwrap();
    let options = LayoutOptions {
        fixed: vec![(arc(0, 1), 3), (arc(6, 7), 4)],
        ..LayoutOptions::default()
    };
    let error = solve(&sphere, &layout, &options).unwrap_err();
    assert!(matches!(error, Error::Contradiction { .. }), "{error}");
    let crossing = |a: usize, b: usize| {
        let [p, q] = [a, b].map(|v| layout.positions()[v]);
        (arc(0, 1), vec![p, q])
    };
    let options = LayoutOptions {
        curves: vec![crossing(0, 1), crossing(0, 1)],
        hold_curves: true,
        ..LayoutOptions::default()
    };
    let error = solve(&sphere, &layout, &options).unwrap_err();
    assert_eq!(error.index(), Some(arc(0, 1)), "{error}");
    // Both through the middle of a side.
    let middle = [0.0, 0.0, sphere.bounding_box()[0][2]];
    let through = |a: usize, b: usize| {
        let [p, q] = layout.arcs()[arc(a, b)].map(|v| layout.positions()[v as usize]);
        (arc(a, b), vec![p, middle, q])
    };
    let options = LayoutOptions {
        curves: vec![through(0, 1), through(2, 3)],
        hold_curves: true,
        ..LayoutOptions::default()
    };
    let error = solve(&sphere, &layout, &options).unwrap_err();
    assert_eq!(error.index(), Some(arc(2, 3)), "{error}");
    assert!(error.to_string().contains("meets"), "{error}");
    let far = (arc(0, 1), vec![[0.0; 3], [9.0; 3], [0.0; 3]]);
    let options = LayoutOptions {
        curves: vec![far],
        hold_curves: true,
        ..LayoutOptions::default()
    };
    let error = solve(&sphere, &layout, &options).unwrap_err();
    assert!(error.to_string().contains("off the surface"), "{error}");
    let not_finite = (arc(0, 1), vec![[0.0; 3], [f64::NAN; 3], [0.0; 3]]);
    let options = LayoutOptions {
        curves: vec![not_finite],
        ..LayoutOptions::default()
    };
    let error = solve(&sphere, &layout, &options).unwrap_err();
    assert_eq!(error.index(), Some(arc(0, 1)), "{error}");
    let options = LayoutOptions {
        curves: vec![(12, Vec::new())],
        ..LayoutOptions::default()
    };
    let error = solve(&sphere, &layout, &options).unwrap_err();
    assert_eq!(error.code(), "index_out_of_range", "{error}");
    let plane = shape::by_name("plane", 200).unwrap();
    let open = BaseLayout::new(
        [[-1.0, -1.0, 0.0], [1.0, -1.0, 0.0], [0.0, 1.0, 0.0]].to_vec(),
        vec![vec![0, 1, 2]],
    );
    let error = solve(&sphere, &open.clone().unwrap(), &default).unwrap_err();
    assert!(
        error.to_string().contains("Euler characteristic 1"),
        "{error}"
    );
    assert!(
        solve(&plane, &open.unwrap(), &default)
            .unwrap()
            .is_as_prescribed
    );
}
