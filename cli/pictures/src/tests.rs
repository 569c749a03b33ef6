//! What every picture and model holds, whatever the mesh.

use super::balls::{NEGATIVE, OTHER, POSITIVE, balls};
use super::streamlines::streamlines;
use super::{FieldModel, View, draw_field};
use roundel::field::{
    FieldOptions, FieldProblem, OrientationField, PrescribedIndex, curvature_constraints,
    feature_constraints,
};
use roundel::mesh::features::FeatureGraph;
use roundel::mesh::vector::{dot, norm, sub};
use roundel::mesh::{TriangleMesh, io, shape};
use roundel::{Error, Options, solve};

fn field(name: &str, triangles: usize) -> (TriangleMesh, OrientationField) {
    let mesh = shape::by_name(name, triangles).unwrap();
    let constraints = curvature_constraints(&mesh, 0.1).unwrap();
    let problem = FieldProblem::new(&mesh, &constraints).unwrap();
    let solution = solve(problem.problem(), &Options::default()).unwrap();
    let field = problem.field(&mesh, &solution).unwrap();
    (mesh, field)
}

fn small() -> View {
    View {
        width: 160,
        height: 120,
        ..View::default()
    }
}

#[test]
fn streamlines_stay_on_the_surface_and_do_not_jump() {
    for name in ["sphere", "genus-2", "plate-with-holes"] {
        let (mesh, field) = field(name, 1500);
        let spacing = (mesh.surface_area() / 400.0).sqrt();
        let lines = streamlines(&mesh, &field, spacing);
        assert!(lines.len() > 20, "{name}: {}", lines.len());
        for line in &lines {
            for pair in line.points.windows(2) {
                let step = norm(sub(pair[1].position, pair[0].position));
                assert!(step <= 0.5 * spacing, "{name}: {step}");
            }
            for point in &line.points {
                // In the plane of some face, and within reach of its middle.
                let near = (0..mesh.face_count()).any(|f| {
                    let apart = sub(point.position, mesh.face_centroid(f));
                    let reach = (0..3).map(|k| mesh.edge_length(f, k)).fold(0.0, f64::max);
                    norm(apart) <= reach && dot(apart, mesh.normal(f)).abs() < 1e-9
                });
                assert!(near, "{name}: {:?}", point.position);
            }
        }
    }
}

#[test]
fn streamlines_reach_every_component() {
    let (one, _) = field("sphere", 500);
    let count = one.vertex_count() as u32;
    let moved = one.vertices().iter().map(|&[x, y, z]| [x + 3.0, y, z]);
    let vertices = one.vertices().iter().copied().chain(moved).collect();
    let twice = one.triangles().iter().map(|t| t.map(|v| v + count));
    let triangles = one.triangles().iter().copied().chain(twice).collect();
    let mesh = TriangleMesh::new(vertices, triangles).unwrap();
    let problem = FieldProblem::new(&mesh, &[]).unwrap();
    let solution = solve(problem.problem(), &Options::default()).unwrap();
    let field = problem.field(&mesh, &solution).unwrap();
    let lines = streamlines(&mesh, &field, 0.3);
    for side in [-1.0, 1.0] {
        let on_side = |x: f64| (x - 1.5) * side > 0.0;
        assert!(lines.iter().any(|l| on_side(l.points[0].position[0])));
    }
}

#[test]
fn a_picture_shows_the_mesh_on_white_the_same_every_time() {
    let (mesh, field) = field("rounded-cube", 600);
    let image = draw_field(&mesh, &field, &small()).unwrap();
    assert_eq!(image.pixels().len(), 3 * 160 * 120);
    assert_eq!(image.pixels()[..3], [255; 3]);
    let middle = 3 * (60 * 160 + 80);
    assert_ne!(image.pixels()[middle..middle + 3], [255; 3]);
    let again = draw_field(&mesh, &field, &small()).unwrap();
    assert_eq!(image.to_png().unwrap(), again.to_png().unwrap());
}

#[test]
fn the_size_of_the_mesh_does_not_matter() {
    let (mesh, field) = field("genus-2", 900);
    let image = draw_field(&mesh, &field, &small()).unwrap();
    for unit in [2f64.powi(-100), 2f64.powi(100)] {
        let vertices = mesh.vertices().iter().map(|p| p.map(|x| unit * x));
        let scaled = TriangleMesh::new(vertices.collect(), mesh.triangles().to_vec()).unwrap();
        let same = draw_field(&scaled, &field, &small()).unwrap();
        assert!(same == image, "{unit:e}");
    }
}

#[test]
fn views_that_show_nothing_are_refused() {
    let (mesh, field) = field("disk", 200);
    for view in [
        View {
            width: 0,
            ..small()
        },
        View {
            height: 8_193,
            ..small()
        },
        View {
            from: [0.0; 3],
            ..small()
        },
        View {
            from: [0.0, f64::NAN, 1.0],
            ..small()
        },
        View {
            up: [f64::INFINITY, 0.0, 0.0],
            ..small()
        },
        View {
            from: [0.0, -2.0, 0.0],
            ..small()
        },
    ] {
        let error = draw_field(&mesh, &field, &view).unwrap_err();
        assert!(matches!(error, Error::InvalidArgument { .. }), "{view:?}");
    }
}

#[test]
fn a_model_is_the_mesh_with_a_cross_in_every_face_and_a_ball_at_every_irregular_vertex() {
    let (mesh, field) = field("rounded-cube", 600);
    let model = FieldModel::new(&mesh, &field);
    let drawing = model.drawing();
    let irregular = field.irregular_vertices(&mesh).len();
    let crosses = 8 * mesh.face_count();
    let ball = (drawing.vertices.len() - mesh.vertex_count() - crosses) / irregular;
    assert_eq!(drawing.vertices[..mesh.vertex_count()], *mesh.vertices());
    assert_eq!(drawing.triangles[..mesh.face_count()], *mesh.triangles());
    let balls = drawing.vertices[mesh.vertex_count() + crosses..].chunks(ball);
    for (points, vertex) in balls.zip(field.irregular_vertices(&mesh)) {
        let distance = |p: &[f64; 3]| norm(sub(*p, mesh.position(vertex)));
        let radius = distance(&points[0]);
        assert!(points.iter().all(|p| (distance(p) - radius).abs() < 1e-12));
    }
    let path = std::env::temp_dir().join(format!("roundel-model-{}.ply", std::process::id()));
    io::write(&path, drawing).unwrap();
    std::fs::remove_file(path).unwrap();
}

#[test]
fn balls_are_coloured_by_integers() {
    let mesh = shape::by_name("gear", 3_000).unwrap();
    let features = FeatureGraph::by_angle(&mesh, 40f64.to_radians()).unwrap();
    let constraints = feature_constraints(&mesh, &features).unwrap();
    let problem = FieldProblem::new(&mesh, &constraints).unwrap();
    let solution = solve(problem.problem(), &Options::default()).unwrap();
    let field = problem.field(&mesh, &solution).unwrap();
    let drawn = balls(&mesh, &field);
    assert_eq!(drawn.len(), field.irregular_vertices(&mesh).len());
    // A torus has as many of either kind, and a gear no others.
    let count = |color| drawn.iter().filter(|ball| ball.color == color).count();
    assert_eq!(count(POSITIVE), drawn.len() / 2);
    assert_eq!(count(NEGATIVE), drawn.len() / 2);

    let mesh = shape::by_name("sphere", 400).unwrap();
    let indices = [(0, 5), (7, 1), (9, 3), (20, -1)];
    let indices = indices.map(|(vertex, steps)| PrescribedIndex { vertex, steps });
    let options = FieldOptions {
        indices: Some(indices.to_vec()),
        ..FieldOptions::default()
    };
    let problem = FieldProblem::with_options(&mesh, &options).unwrap();
    let solution = solve(problem.problem(), &Options::default()).unwrap();
    let field = problem.field(&mesh, &solution).unwrap();
    let colors = balls(&mesh, &field).into_iter();
    let colors: Vec<[u8; 3]> = colors.map(|ball| ball.color).collect();
    assert_eq!(colors, [OTHER, POSITIVE, OTHER, NEGATIVE]);
}

#[test]
fn arms_lie_inside_their_face_just_above_it() {
    let (mesh, field) = field("gear", 3000);
    let model = FieldModel::new(&mesh, &field);
    let crosses = &model.drawing().vertices[mesh.vertex_count()..];
    for f in 0..mesh.face_count() {
        let normal = mesh.normal(f);
        let corners = mesh.corner_positions(f);
        for &p in &crosses[8 * f..8 * f + 8] {
            let height = dot(sub(p, corners[0]), normal);
            assert!(
                height > 0.0 && height < 0.1 * mesh.edge_length(f, 0),
                "face {f}"
            );
            for k in 0..3 {
                let edge = sub(corners[(k + 1) % 3], corners[k]);
                let inside = roundel::mesh::vector::cross(normal, edge);
                assert!(dot(sub(p, corners[k]), inside) > 0.0, "face {f}");
            }
        }
    }
}
