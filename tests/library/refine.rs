//! Quads of solids as CAD programs write them, with as few triangles as the shape allows.

use std::f64::consts::TAU;

use roundel::Monitor;
use roundel::extract::Origin;
use roundel::field::{Constraint, PrescribedIndex};
use roundel::map::Sizing;
use roundel::mesh::vector::{add, dot, norm, scale, sub};
use roundel::mesh::{TriangleMesh, shape};
use roundel::quad::{QuadOptions, Quadrangulation, RefinedInput, quadrangulate};
use roundel::smooth::QuadQuality;

/// The solid between heights 0 and `height` over triangles of the plane.
fn extruded(points: &[[f64; 2]], triangles: &[[u32; 3]], height: f64) -> TriangleMesh {
    let n = points.len() as u32;
    let at = |z: f64| points.iter().map(move |&[x, y]| [x, y, z]);
    let mut faces = triangles.to_vec();
    faces.extend(triangles.iter().map(|&[a, b, c]| [n + a, n + c, n + b]));
    let sides = |t: &[u32; 3]| [[t[0], t[1]], [t[1], t[2]], [t[2], t[0]]];
    let all: Vec<[u32; 2]> = triangles.iter().flat_map(sides).collect();
    for &[a, b] in all.iter().filter(|&&[a, b]| !all.contains(&[b, a])) {
        faces.extend([[a, n + a, n + b], [a, n + b, b]]);
    }
    TriangleMesh::new(at(height).chain(at(0.0)).collect(), faces).unwrap()
}

fn on_circle(radius: f64, turn: f64) -> [f64; 2] {
    let (sin, cos) = (TAU * turn).sin_cos();
    [radius * cos, radius * sin]
}

fn cuboid([x, y, z]: [f64; 3]) -> TriangleMesh {
    let corners = [[0.0, 0.0], [x, 0.0], [x, y], [0.0, y]];
    extruded(&corners, &[[0, 1, 2], [0, 2, 3]], z)
}

/// Its caps are fans from one vertex of the boundary.
fn cylinder(sides: u32, height: f64) -> TriangleMesh {
    let circle: Vec<_> = (0..sides)
        .map(|i| on_circle(1.0, f64::from(i) / f64::from(sides)))
        .collect();
    let fan: Vec<_> = (1..sides - 1).map(|i| [0, i, i + 1]).collect();
    extruded(&circle, &fan, height)
}

/// Three unit cells with a hole each, whose sides are joined to the corners of the cell.
fn plate(sides: u32) -> TriangleMesh {
    let mut points: Vec<[f64; 2]> = Vec::new();
    for x in 0..4 {
        points.extend([[f64::from(x), 0.0], [f64::from(x), 1.0]]);
    }
    let mut triangles = Vec::new();
    for cell in 0..3 {
        let corners = [2 * cell + 3, 2 * cell + 1, 2 * cell, 2 * cell + 2];
        let first = points.len() as u32;
        for i in 0..sides {
            let [x, y] = on_circle(0.3, f64::from(i) / f64::from(sides));
            points.push([x + f64::from(cell) + 0.5, y + 0.5]);
            let corner = (4 * i / sides) as usize;
            triangles.push([corners[corner], first + (i + 1) % sides, first + i]);
            if 4 * (i + 1) / sides > 4 * i / sides {
                let next = corners[(corner + 1) % 4];
                triangles.push([corners[corner], next, first + (i + 1) % sides]);
            }
        }
    }
    extruded(&points, &triangles, 0.2)
}

/// Teeth of four corners, and a bore with as many sides.
fn gear(teeth: u32) -> TriangleMesh {
    let tooth = [(-0.28, 1.0), (-0.15, 1.25), (0.15, 1.25), (0.28, 1.0)];
    let outline = (0..teeth).flat_map(|t| {
        tooth.map(|(turn, radius)| (radius, (f64::from(t) + turn) / f64::from(teeth)))
    });
    let outline: Vec<(f64, f64)> = outline.collect();
    let n = outline.len() as u32;
    let outer = outline
        .iter()
        .map(|&(radius, turn)| on_circle(radius, turn));
    let inner = outline.iter().map(|&(_, turn)| on_circle(0.4, turn));
    let triangles = (0..n).flat_map(|i| {
        let j = (i + 1) % n;
        [[i, j, n + j], [i, n + j, n + i]]
    });
    let (points, triangles): (Vec<_>, Vec<_>) = (outer.chain(inner).collect(), triangles.collect());
    extruded(&points, &triangles, 0.5)
}

fn options(quads: usize) -> QuadOptions {
    let mut options = QuadOptions {
        sizing: Sizing::Quads(quads),
        ..QuadOptions::default()
    };
    options.guidance.feature_angle = Some(30f64.to_radians());
    options
}

fn quads_of(mesh: &TriangleMesh, options: &QuadOptions) -> Quadrangulation {
    quadrangulate(mesh, options, Monitor::default).unwrap()
}

#[test]
fn quads_of_coarse_solids_conform_and_are_well_shaped() {
    for (name, mesh) in [
        ("cube", cuboid([1.0, 1.0, 1.0])),
        ("box", cuboid([10.0, 1.0, 2.0])),
        ("plate", plate(32)),
        ("cylinder", cylinder(64, 20.0)),
        ("gear", gear(12)),
    ] {
        for count in [500, 2_000] {
            let made = quads_of(&mesh, &options(count));
            let quality = QuadQuality::new(&made.quads);
            let least = quality.scaled_jacobian_min;
            assert!(made.refined.is_some(), "{name}");
            assert!(made.quads.is_conforming(), "{name} {count}");
            assert!(made.missed_features.is_empty(), "{name} {count}");
            assert!(least > 0.3, "{name} {count}: {least}");
            let found = made.quads.quads.len();
            assert!(2 * found > count && found < 2 * count, "{name}: {found}");
        }
    }
}

/// The map of the first size puts two edges of teeth on one line.
#[test]
fn features_that_are_missed_are_tried_with_smaller_quads() {
    let made = quads_of(&gear(16), &options(700));
    assert!(made.quads.is_conforming() && made.missed_features.is_empty());
    let found = made.quads.quads.len();
    assert!(found < 1_400, "{found}");
    assert!(QuadQuality::new(&made.quads).scaled_jacobian_min > 0.3);
}

#[test]
fn results_name_elements_of_the_mesh_that_was_given() {
    let mesh = cuboid([10.0, 1.0, 2.0]);
    let made = quads_of(&mesh, &options(500));
    let sharp = (0..mesh.edge_count()).filter(|&e| {
        let edge = mesh.edge(e);
        let faces = [edge.first.0, edge.second.unwrap().0];
        let [m, n] = faces.map(|face| mesh.normal(face));
        dot(m, n) < 0.5
    });
    assert_eq!(made.features, sharp.collect::<Vec<_>>());
    let corners = made.quads.origins.iter();
    let corners = corners.filter(|origin| matches!(origin, Origin::Vertex(_)));
    assert_eq!(corners.count(), mesh.vertex_count());
    for (&p, origin) in made.quads.vertices.iter().zip(&made.quads.origins) {
        let q = match *origin {
            Origin::Vertex(v) => mesh.position(v),
            Origin::Face(face, weights) => {
                let corners = mesh.corner_positions(face);
                (0..3).fold([0.0; 3], |sum, k| add(sum, scale(corners[k], weights[k])))
            }
            Origin::Middle => panic!("off the surface"),
        };
        // Smoothing moves vertices by less than an edge of the quads.
        assert!(norm(sub(p, q)) < 0.3);
    }
}

#[test]
fn meshes_that_need_no_refinement_are_used_as_they_are() {
    let mesh = shape::by_name("gear", 4_000).unwrap();
    let [with, without] = [true, false].map(|refine| {
        let options = QuadOptions {
            refine,
            ..options(500)
        };
        quads_of(&mesh, &options)
    });
    assert!(with.refined.is_none());
    assert_eq!(with.quads, without.quads);
}

#[test]
fn refinement_can_be_turned_off() {
    let options = QuadOptions {
        refine: false,
        ..options(500)
    };
    assert!(quads_of(&cuboid([1.0; 3]), &options).refined.is_none());
}

#[test]
fn a_direction_holds_for_all_parts_of_its_face() {
    let mesh = cuboid([1.0; 3]);
    let mut given = options(500).guidance;
    given.constraints.push(Constraint {
        face: 3,
        angle: 0.3,
    });
    let none = roundel::mesh::features::FeatureGraph::none(&mesh);
    let input = RefinedInput::new(&mesh, &given, &none, &Sizing::Quads(500)).unwrap();
    let input = input.expect("a refinement");
    let in_space = |mesh: &TriangleMesh, face: usize, angle: f64| {
        let [x, y] = mesh.frame(face);
        add(scale(x, angle.cos()), scale(y, angle.sin()))
    };
    let wanted = in_space(&mesh, 3, 0.3);
    let constraints = &input.guidance.constraints;
    let area = constraints.iter().map(|c| input.refined.mesh.area(c.face));
    assert!((area.sum::<f64>() - mesh.area(3)).abs() < 1e-12);
    assert!(constraints.len() > 10);
    for c in constraints {
        let found = in_space(&input.refined.mesh, c.face, c.angle);
        assert!(norm(sub(found, wanted)) < 1e-12);
    }
}

#[test]
fn indices_stay_at_their_vertices() {
    let mesh = cuboid([1.0; 3]);
    let mut options = options(500);
    options.guidance.feature_angle = None;
    let all = (0..8).map(|vertex| PrescribedIndex { vertex, steps: 1 });
    options.guidance.indices = Some(all.collect());
    let made = quads_of(&mesh, &options);
    assert!(made.quads.is_conforming());
    let irregular = made.field.irregular_vertices(made.mesh(&mesh));
    assert_eq!(irregular, (0..8).collect::<Vec<_>>());
}
