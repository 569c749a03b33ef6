//! Quads that are mirrored are symmetric, conforming and on the surface.

use std::collections::{BTreeMap, BTreeSet};

use super::{Near, QuadOptions, Quadrangulation, quadrangulate};
use crate::error::Result;
use crate::extract::{Origin, QuadMesh};
use crate::field::PrescribedIndex;
use crate::map::Sizing;
use crate::mesh::TriangleMesh;
use crate::mesh::mirror::MirrorPlane;
use crate::mesh::shape::by_name;
use crate::mesh::vector::{Vec3, norm, sub};
use crate::monitor::Monitor;
use crate::smooth::QuadQuality;

fn options(words: &[&str], quads: usize) -> QuadOptions {
    let mut options = QuadOptions {
        mirror: words.iter().map(|word| word.parse().unwrap()).collect(),
        sizing: Sizing::Quads(quads),
        ..QuadOptions::default()
    };
    options.guidance.feature_angle = Some(0.7);
    options
}

fn made(mesh: &TriangleMesh, options: &QuadOptions) -> Result<Quadrangulation> {
    quadrangulate(mesh, options, Monitor::default)
}

/// Vertices and quads without a mirror image within a distance: 0 allows no other bit.
pub(super) fn asymmetric(quads: &QuadMesh, plane: &MirrorPlane, tolerance: f64) -> usize {
    let cell = |p: Vec3| p.map(|x| (x / 1e-9).round() as i64);
    let mut near: BTreeMap<[i64; 3], Vec<usize>> = BTreeMap::new();
    for (v, &p) in quads.vertices.iter().enumerate() {
        near.entry(cell(p)).or_default().push(v);
    }
    let image = |v: usize| {
        let p = plane.reflect(quads.vertices[v]);
        let [x, y, z] = cell(p);
        let around = (0..27).map(|i| [x + i % 3 - 1, y + i / 3 % 3 - 1, z + i / 9 - 1]);
        let mut found = around.filter_map(|c| near.get(&c)).flatten().copied();
        found.find(|&w| (0..3).all(|i| (quads.vertices[w][i] - p[i]).abs() <= tolerance))
    };
    let images: Vec<Option<usize>> = (0..quads.vertices.len()).map(image).collect();
    let sorted = |quad: [usize; 4]| {
        let least = (0..4).fold(0, |k, i| if quad[i] < quad[k] { i } else { k });
        [0, 1, 2, 3].map(|i| quad[(least + i) % 4])
    };
    let of = |quad: &[u32; 4]| quad.map(|v| v as usize);
    let all: BTreeSet<[usize; 4]> = quads.quads.iter().map(|q| sorted(of(q))).collect();
    let is_lost = |quad: &&[u32; 4]| match of(quad).map(|v| images[v]) {
        [Some(a), Some(b), Some(c), Some(d)] => !all.contains(&sorted([d, c, b, a])),
        _ => true,
    };
    images.iter().filter(|image| image.is_none()).count()
        + quads.quads.iter().filter(is_lost).count()
}

/// Whether the edges on a plane are closed chains, or end at the boundary of the mesh.
fn has_seam(quads: &QuadMesh, plane: &MirrorPlane) -> bool {
    let on = |v: u32| plane.height(quads.vertices[v as usize]).abs() < 1e-15;
    let mut degree: BTreeMap<u32, usize> = BTreeMap::new();
    let mut edges = BTreeSet::new();
    for quad in &quads.quads {
        for k in 0..4 {
            let [a, b] = [quad[k], quad[(k + 1) % 4]];
            if on(a) && on(b) && edges.insert([a.min(b), a.max(b)]) {
                *degree.entry(a).or_default() += 1;
                *degree.entry(b).or_default() += 1;
            }
        }
    }
    !edges.is_empty() && degree.values().all(|&d| d == 2 || d == 1)
}

#[test]
fn quads_are_symmetric_to_the_last_bit_about_planes_through_the_origin() {
    for (name, words, quads) in [
        ("torus", &["x"][..], 300),
        ("torus", &["-x", "y"], 300),
        ("rounded-cube", &["x", "y", "z"], 300),
        ("gear", &["y"], 400),
        ("plane", &["x", "-y"], 100),
        ("genus-2", &["auto"], 300),
    ] {
        let mesh = by_name(name, 1_500).unwrap();
        let found = made(&mesh, &options(words, quads)).unwrap();
        assert!(found.quads.is_conforming(), "{name} {words:?}");
        assert_eq!(
            found.quads.figures().euler,
            mesh.euler_characteristic(),
            "{name}"
        );
        assert_eq!(QuadQuality::new(&found.quads).inverted, 0, "{name}");
        let count = found.quads.quads.len() as f64;
        assert!(
            (0.6..1.6).contains(&(count / quads as f64)),
            "{name}: {count}"
        );
        let mirrored = found.mirrored.as_ref().unwrap();
        for plane in &mirrored.planes {
            assert_eq!(plane.offset, 0.0, "{name}");
            assert_eq!(asymmetric(&found.quads, plane, 0.0), 0, "{name} {words:?}");
            assert!(has_seam(&found.quads, plane), "{name} {words:?}");
        }
        assert_eq!(found.quads.origins.len(), found.quads.vertices.len());
        for origin in &found.quads.origins {
            match *origin {
                Origin::Vertex(v) => assert!(v < mesh.vertex_count()),
                Origin::Face(f, _) => assert!(f < mesh.face_count()),
                Origin::Middle => {}
            }
        }
        assert!(found.features.iter().all(|&e| e < mesh.edge_count()));
    }
}

#[test]
fn other_planes_are_exact_up_to_rounding() {
    let mesh = by_name("torus", 1_500).unwrap();
    let (s, c) = 0.4f64.sin_cos();
    let turned = mesh
        .vertices()
        .iter()
        .map(|[x, y, z]| [c * x - s * z + 5.0, y + 0.3, s * x + c * z]);
    let mesh = TriangleMesh::new(turned.collect(), mesh.triangles().to_vec()).unwrap();
    let plane = format!("{c},0,{s},{}", 5.0 * c);
    let found = made(&mesh, &options(&[&plane, "y"], 300)).unwrap();
    assert!(found.quads.is_conforming());
    let [low, high] = mesh.bounding_box();
    let mirrored = found.mirrored.unwrap();
    for plane in &mirrored.planes {
        assert!(plane.deviation < 0.05);
        assert_eq!(
            asymmetric(&found.quads, plane, 1e-12 * norm(sub(high, low))),
            0
        );
    }
}

#[test]
fn components_on_both_sides_need_no_seam() {
    let cube = by_name("rounded-cube", 600).unwrap();
    let first = cube.vertex_count() as u32;
    let mut points = cube.vertices().to_vec();
    points.extend(cube.vertices().iter().map(|p| [-9.0 - p[0], p[1], p[2]]));
    let mut triangles = cube.triangles().to_vec();
    triangles.extend(
        cube.triangles()
            .iter()
            .map(|&[a, b, c]| [a, c, b].map(|v| v + first)),
    );
    let mesh = TriangleMesh::new(points, triangles).unwrap();
    let found = made(&mesh, &options(&["x"], 200)).unwrap();
    assert!(found.quads.is_conforming());
    assert!(found.mirrored.as_ref().unwrap().half.seam.is_empty());
    assert_eq!(found.quads.figures().euler, 4);
    assert_eq!(
        asymmetric(&found.quads, &found.mirrored.unwrap().planes[0], 1e-12),
        0
    );
}

#[test]
fn a_density_is_that_of_the_side_that_is_kept() {
    let mesh = by_name("torus", 3000).unwrap();
    let is_high = |p: &Vec3| p[1] > 0.0;
    let mut options = options(&["x"], 800);
    options.density = mesh
        .vertices()
        .iter()
        .map(|p| if is_high(p) { 2.0 } else { 1.0 })
        .collect();
    let quads = made(&mesh, &options).unwrap().quads;
    assert!(quads.is_conforming());
    let high = quads.vertices.iter().filter(|p| is_high(p)).count();
    assert!(3 * high > 2 * quads.vertices.len(), "{high}");
    // Vertices on the other side change nothing.
    let beyond = (0..mesh.vertex_count()).find(|&v| mesh.position(v)[0] < -0.1);
    options.density.clear();
    let evenly = made(&mesh, &options).unwrap().quads;
    options.near = Near::Vertices;
    options.near_vertices = vec![beyond.unwrap()];
    assert_eq!(
        made(&mesh, &options).unwrap().quads.vertices,
        evenly.vertices
    );
    options.density = vec![1.0; 3];
    assert_eq!(made(&mesh, &options).unwrap_err().code(), "length_mismatch");
}

#[test]
fn what_no_part_can_have_is_refused() {
    let mesh = by_name("torus", 600).unwrap();
    let mut given = options(&["1,0,0,8"], 100);
    given.mirror_tolerance = 1.0;
    let error = made(&mesh, &given).unwrap_err();
    assert_eq!(error.index(), Some(0), "{error}");
    assert!(made(&mesh, &options(&["1,0,0,0.4"], 100)).is_err());
    let mut given = options(&["x"], 100);
    given.guidance.indices = Some(vec![PrescribedIndex {
        vertex: 0,
        steps: 0,
    }]);
    assert!(made(&mesh, &given).is_err());
    let mut given = options(&["x"], 100);
    given.sizing = Sizing::Lengths(vec![[0.1; 2]; 3]);
    assert!(made(&mesh, &given).is_err());
}
