//! `--density colors` and `--density property:NAME`: densities that the vertices of the mesh have.

use std::fmt::Write;
use std::fs;
use std::path::Path;

use roundel::mesh::{TriangleMesh, shape};
use serde_json::Value;

use crate::run::{Scratch, finish, only_object, program};

/// A sphere as an OBJ file with red above and cyan below, in which every triangle has vertices of its own: repair
/// welds them.
fn colored(mesh: &TriangleMesh) -> String {
    let mut text = String::from("v 9 9 9 0 0 0\n");
    for face in 0..mesh.face_count() {
        for [x, y, z] in mesh.corner_positions(face) {
            let color = if z > 0.0 { "1 0 0" } else { "0 1 1" };
            writeln!(text, "v {x} {y} {z} {color}").unwrap();
        }
        text += "f -3 -2 -1\n";
    }
    text
}

/// The same as PLY with the property `weight`, 2 above and 1 below.
fn weighted(mesh: &TriangleMesh) -> String {
    let mut text = format!(
        "ply\nformat ascii 1.0\nelement vertex {}\nproperty double x\nproperty double y\nproperty double z\n\
        property float weight\nelement face {}\nproperty list uchar int vertex_indices\nend_header\n",
        mesh.vertex_count(),
        mesh.face_count()
    );
    for [x, y, z] in mesh.vertices() {
        writeln!(text, "{x} {y} {z} {}", if *z > 0.0 { 2 } else { 1 }).unwrap();
    }
    for [a, b, c] in mesh.triangles() {
        writeln!(text, "3 {a} {b} {c}").unwrap();
    }
    text
}

fn run(words: &[&str]) -> (i32, Value) {
    let (code, output) = finish(program(&[words, &["--json"]].concat()));
    (code, only_object(&output))
}

/// How much longer edges of quads are well below the middle than well above.
fn ratio(quads: &Path) -> f64 {
    let text = fs::read_to_string(quads).unwrap();
    let (mut points, mut sums) = (Vec::new(), [(0.0, 0.0); 2]);
    for line in text.lines() {
        let mut words = line.split_whitespace();
        match words.next() {
            Some("v") => points.push(words.map(|w| w.parse().unwrap()).collect::<Vec<f64>>()),
            Some("f") => {
                let corner = |w: &str| w.split('/').next().unwrap().parse::<usize>().unwrap() - 1;
                let corners: Vec<&Vec<f64>> = words.map(|w| &points[corner(w)]).collect();
                let middle = corners.iter().map(|p| p[2]).sum::<f64>() / 4.0;
                if middle.abs() > 0.4 {
                    let sum = &mut sums[usize::from(middle > 0.0)];
                    for k in 0..4 {
                        let (p, q) = (corners[k], corners[(k + 1) % 4]);
                        let square: f64 = (0..3).map(|i| (p[i] - q[i]).powi(2)).sum();
                        *sum = (sum.0 + square.sqrt(), sum.1 + 1.0);
                    }
                }
            }
            _ => {}
        }
    }
    let [below, above] = sums.map(|(sum, count)| sum / count);
    below / above
}

#[test]
fn quads_are_as_dense_as_vertices_are_painted() {
    let scratch = Scratch::new("painted");
    let mesh = shape::by_name("sphere", 3_000).unwrap();
    let colors = scratch.write("colors.obj", colored(&mesh));
    let weights = scratch.write("weights.ply", weighted(&mesh));
    let quads = scratch.path("quads.obj");
    for (file, density, asked) in [(&colors, "colors", 4.0), (&weights, "property:weight", 2.0)] {
        let (file, out) = (file.to_str().unwrap(), quads.to_str().unwrap());
        let words = [
            "quad",
            file,
            "--density",
            density,
            "--quads",
            "1000",
            "-o",
            out,
        ];
        let (code, report) = run(&words);
        assert_eq!(code, 0, "{report}");
        let found = ratio(&quads);
        assert!((found / asked - 1.0).abs() < 0.15, "{density}: {found}");
    }
}

#[test]
fn densities_that_vertices_do_not_have_are_refused() {
    let scratch = Scratch::new("unpainted");
    let mesh = shape::by_name("sphere", 200).unwrap();
    let weights = scratch.write("weights.ply", weighted(&mesh));
    let weights = weights.to_str().unwrap();
    for (file, density, message) in [
        (weights, "property:size", "are: weight"),
        (weights, "property:z", "no such property"),
        (weights, "colors", "no colours"),
        ("shape:sphere:200", "colors", "no colours"),
    ] {
        let (code, report) = run(&["quad", file, "--density", density]);
        let told = report["error"]["message"].as_str().unwrap_or_default();
        assert!(code != 0 && told.contains(message), "{report}");
    }
}
