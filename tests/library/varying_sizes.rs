//! Quads have the sizes that were asked for, where these vary over the surface.

use roundel::Monitor;
use roundel::extract::QuadMesh;
use roundel::map::Sizing;
use roundel::mesh::TriangleMesh;
use roundel::mesh::shape::by_name;
use roundel::mesh::vector::{norm, sub};
use roundel::quad::{Near, QuadOptions, quadrangulate};

fn quads(mesh: &TriangleMesh, options: QuadOptions) -> QuadMesh {
    let options = QuadOptions {
        sizing: Sizing::Quads(600),
        ..options
    };
    let made = quadrangulate(mesh, &options, Monitor::default).unwrap();
    assert!(made.quads.is_conforming());
    let count = made.quads.quads.len();
    assert!((510..690).contains(&count), "{count}");
    made.quads
}

/// The mean length of edges of quads whose middle is above this height, and below its negative.
fn lengths(quads: &QuadMesh, height: f64) -> [f64; 2] {
    let mut sums = [(0.0, 0.0); 2];
    for quad in &quads.quads {
        let corners = quad.map(|v| quads.vertices[v as usize]);
        let middle = 0.25 * corners.iter().map(|p| p[2]).sum::<f64>();
        let side = match middle {
            z if z > height => 0,
            z if z < -height => 1,
            _ => continue,
        };
        for k in 0..4 {
            sums[side].0 += norm(sub(corners[(k + 1) % 4], corners[k]));
            sums[side].1 += 1.0;
        }
    }
    sums.map(|(sum, count)| sum / count)
}

#[test]
fn edges_are_shorter_where_the_density_is_higher() {
    let mesh = by_name("sphere", 3_000).unwrap();
    let density = mesh
        .vertices()
        .iter()
        .map(|p| if p[2] > 0.0 { 2.0 } else { 1.0 });
    let made = quads(
        &mesh,
        QuadOptions {
            density: density.collect(),
            ..QuadOptions::default()
        },
    );
    let [dense, sparse] = lengths(&made, 0.5);
    assert!((1.6..2.5).contains(&(sparse / dense)), "{dense} {sparse}");
}

#[test]
fn edges_are_shorter_near_vertices() {
    let mesh = by_name("sphere", 3_000).unwrap();
    let top = (0..mesh.vertex_count())
        .max_by(|&a, &b| mesh.position(a)[2].total_cmp(&mesh.position(b)[2]))
        .unwrap();
    let made = quads(
        &mesh,
        QuadOptions {
            near: Near::Vertices,
            near_vertices: vec![top],
            near_size: 0.4,
            near_distance: Some(0.8),
            ..QuadOptions::default()
        },
    );
    let [near, far] = lengths(&made, 0.9);
    assert!(far / near > 1.4, "{near} {far}");
}

#[test]
fn without_varying_sizes_quads_are_those_of_before() {
    let mesh = by_name("rounded-cube", 1_000).unwrap();
    let plain = quads(&mesh, QuadOptions::default());
    let others = QuadOptions {
        gradation: 1.1,
        near_size: 0.1,
        ..QuadOptions::default()
    };
    assert_eq!(plain.vertices, quads(&mesh, others).vertices);
    let adapted = QuadOptions {
        adapt: 1.0,
        ..QuadOptions::default()
    };
    assert_ne!(plain.vertices, quads(&mesh, adapted).vertices);
}

/// The mean ratio of the two lengths of a quad, the longer over the shorter.
fn mean_aspect_ratio(quads: &QuadMesh) -> f64 {
    let of = |quad: &[u32; 4]| {
        let corners = quad.map(|v| quads.vertices[v as usize]);
        let lengths = [0, 1, 2, 3].map(|k| norm(sub(corners[(k + 1) % 4], corners[k])));
        let ratio = (lengths[0] + lengths[2]) / (lengths[1] + lengths[3]);
        ratio.max(ratio.recip())
    };
    quads.quads.iter().map(of).sum::<f64>() / quads.quads.len() as f64
}

/// On a torus the tube curves more around than along.
#[test]
fn quads_are_longer_where_the_surface_curves_less_if_they_are_stretched() {
    let mesh = by_name("torus", 4_000).unwrap();
    let stretched = |stretch: f64| {
        let options = QuadOptions {
            stretch,
            ..QuadOptions::default()
        };
        mean_aspect_ratio(&quads(&mesh, options))
    };
    let [none, half, full] = [0.0, 0.5, 1.0].map(stretched);
    assert!(
        none < 1.35 && half > 1.1 * none && full > 1.2 * half,
        "{none} {half} {full}"
    );
}
