//! `--keep`: attributes of a mesh that its quads get.

use std::fmt::Write;
use std::fs;
use std::path::{Path, PathBuf};

use roundel::soup::PolygonSoup;
use roundel::soup::io::{Attribute, Attributes, Format, parse};
use serde_json::{Value, json};

use crate::run::{Scratch, finish, only_object, program};

/// The corners of the sides of a cube, whose number is two for each axis, and one more for the larger coordinate.
const SIDES: [[usize; 4]; 6] = [
    [0, 4, 6, 2],
    [1, 3, 7, 5],
    [0, 1, 5, 4],
    [2, 6, 7, 3],
    [0, 2, 3, 1],
    [4, 5, 7, 6],
];

/// A cube about the origin in OBJ, each side with a material and a square of texture of its own, and coloured by
/// position.
fn cube() -> String {
    let mut text = String::from("mtllib paint.mtl\n");
    for v in 0..8 {
        let bit = |k: usize| (v >> k & 1) as f64;
        let [x, y, z] = [0, 1, 2].map(bit);
        let position = [x, y, z].map(|x| 2.0 * x - 1.0);
        let [a, b, c] = position;
        writeln!(text, "v {a} {b} {c} {x} {y} {z}").unwrap();
    }
    for (side, corners) in SIDES.iter().enumerate() {
        let group = if side < 2 { "ends" } else { "sides" };
        writeln!(text, "g {group}\nusemtl paint {side}").unwrap();
        for (u, v) in [(0, 0), (1, 0), (1, 1), (0, 1)] {
            writeln!(text, "vt {} {v}", 2 * side + u).unwrap();
        }
        let corner = |k: usize| format!("{}/{}", corners[k] + 1, 4 * side + k + 1);
        for [a, b, c] in [[0, 1, 2], [0, 2, 3]] {
            writeln!(text, "f {} {} {}", corner(a), corner(b), corner(c)).unwrap();
        }
    }
    text
}

fn side(p: [f64; 3]) -> usize {
    let axis = (0..3).fold(
        0,
        |best, k| if p[k].abs() > p[best].abs() { k } else { best },
    );
    2 * axis + usize::from(p[axis] > 0.0)
}

fn run(words: &[&str]) -> (i32, Value) {
    let (code, output) = finish(program(&[words, &["--json"]].concat()));
    (code, only_object(&output))
}

fn read(path: &Path, format: Format) -> (PolygonSoup, Attributes) {
    let bytes = fs::read(path).unwrap();
    let soup = parse(&bytes, format).unwrap();
    let attributes = Attributes::parse(&bytes, format, &soup).unwrap();
    (soup, attributes)
}

fn text(path: &Path) -> &str {
    path.to_str().unwrap()
}

/// Lines of geometry without what attributes add to them.
fn geometry(path: &Path) -> Vec<Vec<String>> {
    let text = fs::read_to_string(path).unwrap();
    let lines = text
        .lines()
        .filter(|line| line.starts_with("v ") || line.starts_with("f "));
    let words = |line: &str| {
        let count = if line.starts_with('v') { 4 } else { 5 };
        let words = line.split(' ').take(count);
        words
            .map(|word| word.split('/').next().unwrap().to_owned())
            .collect()
    };
    lines.map(words).collect()
}

#[test]
fn quads_of_a_cube_of_six_materials_keep_all_attributes() {
    let scratch = Scratch::new("kept-cube");
    let folder = scratch.path("sub");
    fs::create_dir(&folder).unwrap();
    let mesh = scratch.write("cube.obj", cube());
    scratch.write("paint.mtl", "newmtl paint 0\nKd 1 0 0\n");
    let out = folder.join("quads.obj");
    let words = [
        "quad",
        text(&mesh),
        "--quads",
        "400",
        "--features",
        "angle:40,materials",
        "-o",
    ];
    let (code, report) = run(&[&words[..], &[text(&out)]].concat());
    assert_eq!(code, 0, "{report}");
    let kept = &report["kept"];
    let names: Vec<String> = (0..6).map(|side| format!("paint {side}")).collect();
    assert_eq!(kept["materials"], json!(names));
    assert_eq!(kept["groups"], json!(["ends", "sides"]));
    assert_eq!(kept["libraries"], json!(["../paint.mtl"]));
    assert_eq!(
        [&kept["vertex_colors"], &kept["uv"], &kept["face_colors"]],
        [true, true, false]
    );
    let (soup, attributes) = read(&out, Format::Obj);
    assert!(folder.join(&attributes.libraries()[0]).is_file());
    let labels = |attribute| attributes.labels(attribute).unwrap();
    let materials = labels(Attribute::Materials);
    let seams = labels(Attribute::Seams);
    let (mut count, mut area) = ([0; 6], 0.0);
    for (q, quad) in soup.polygons().enumerate() {
        let corners = quad.iter().map(|&v| soup.positions()[v as usize]);
        let center = corners.fold([0.0; 3], |sum, p| [0, 1, 2].map(|k| sum[k] + p[k] / 4.0));
        let side = side(center);
        count[side] += 1;
        let name = &attributes.names(Attribute::Materials)[materials[q] as usize];
        assert_eq!(*name, format!("paint {side}"), "{center:?}");
        let group = labels(Attribute::Groups)[q] as usize;
        let expected = if side < 2 { "ends" } else { "sides" };
        assert_eq!(attributes.names(Attribute::Groups)[group], expected);
        // No quad reaches out of the square of its side.
        let uv = [0, 1, 2, 3].map(|k| attributes.texture_coordinates()[seams[4 * q + k] as usize]);
        let from = 2.0 * side as f64;
        assert!(
            uv.iter()
                .all(|[u, v]| (from..=from + 1.0).contains(u) && (0.0..=1.0).contains(v))
        );
        let across = [
            uv[2][0] - uv[0][0],
            uv[2][1] - uv[0][1],
            uv[3][0] - uv[1][0],
            uv[3][1] - uv[1][1],
        ];
        area += 0.5 * (across[0] * across[3] - across[1] * across[2]);
    }
    assert!(count.iter().all(|&n| n > 40), "{count:?}");
    // Together the quads cover the six squares.
    assert!((area - 6.0).abs() < 1e-9, "{area}");
    for (p, color) in soup
        .positions()
        .iter()
        .zip(attributes.vertex_colors().unwrap())
    {
        for k in 0..3 {
            assert!(
                (color[k] - 0.5 * (p[k] + 1.0)).abs() < 1e-12,
                "{p:?} {color:?}"
            );
        }
    }
    // Without attributes the quads are the same.
    let bare = scratch.path("bare.obj");
    let (code, report) = run(&[&words[..], &[text(&bare), "--keep", "none"]].concat());
    assert_eq!((code, &report["kept"]), (0, &Value::Null));
    assert_eq!(geometry(&bare), geometry(&out));
    let content = fs::read_to_string(&bare).unwrap();
    assert!(
        content
            .lines()
            .all(|line| line.starts_with("v ") || line.starts_with("f "))
    );
}

/// A square of 10 by 10 squares as PLY, of triangles with a number at each vertex.
fn square() -> String {
    let mut text = String::from(
        "ply\nformat ascii 1.0\nelement vertex 121\nproperty double x\nproperty double y\nproperty double z\n\
         property double heat\nproperty uchar red\nproperty uchar green\nproperty uchar blue\nelement face 200\n\
         property list uchar int vertex_indices\nproperty uchar red\nproperty uchar green\nproperty uchar blue\n\
         end_header\n",
    );
    for v in 0..121 {
        let (x, y) = (v % 11, v / 11);
        writeln!(text, "{x} {y} 0 {} {} 0 255", 3 * x - y, 20 * x).unwrap();
    }
    for f in 0..100 {
        let (x, y) = (f % 10, f / 10);
        let [a, b] = [11 * y + x, 11 * y + x + 12];
        let red = if x < 5 { 9 } else { 200 };
        for (c, d) in [(a + 1, b), (b, a + 11)] {
            writeln!(text, "3 {a} {c} {d} {red} 1 2").unwrap();
        }
    }
    text
}

#[test]
fn numbers_and_colours_of_ply_come_back() {
    let scratch = Scratch::new("kept-ply");
    let mesh = scratch.write("square.ply", square());
    let out = scratch.path("quads.ply");
    let words = [
        "quad",
        text(&mesh),
        "--quads",
        "36",
        "--features",
        "colors",
        "-o",
        text(&out),
    ];
    let (code, report) = run(&words);
    assert_eq!(code, 0, "{report}");
    assert_eq!(report["kept"]["scalars"], json!(["heat"]));
    assert_eq!(
        [
            &report["kept"]["vertex_colors"],
            &report["kept"]["face_colors"]
        ],
        [true, true]
    );
    let (soup, attributes) = read(&out, Format::Ply);
    let (name, heat) = attributes.scalars().next().unwrap();
    assert_eq!(name, "heat");
    for (p, heat) in soup.positions().iter().zip(heat) {
        assert!((heat - 3.0 * p[0] + p[1]).abs() < 1e-12, "{p:?} {heat}");
    }
    for (p, color) in soup
        .positions()
        .iter()
        .zip(attributes.vertex_colors().unwrap())
    {
        assert!((255.0 * color[0] - 20.0 * p[0]).abs() <= 0.5 + 1e-9);
        assert_eq!(color[1..], [0.0, 1.0, 1.0]);
    }
    let labels = attributes.labels(Attribute::Colors).unwrap();
    for (quad, &label) in soup.polygons().zip(labels) {
        let x: f64 = quad
            .iter()
            .map(|&v| soup.positions()[v as usize][0] / 4.0)
            .sum();
        let red = if x < 5.0 { 9.0 } else { 200.0 };
        assert_eq!(
            attributes.face_colors()[label as usize][0],
            red / 255.0,
            "{x}"
        );
    }
}

#[test]
fn what_cannot_be_kept_is_refused_if_it_is_asked_for() {
    let scratch = Scratch::new("kept-refused");
    let mesh = scratch.write("cube.obj", cube());
    let refused = |mesh: &Path, out: &str, keep: &str, words: &str| {
        let out = scratch.path(out);
        let (code, report) = run(&["quad", text(mesh), "-o", text(&out), "--keep", keep]);
        let message = report["error"]["message"]
            .as_str()
            .unwrap_or_default()
            .to_owned();
        assert!(code == 1 && message.contains(words), "{report}");
        assert!(!out.exists());
    };
    refused(
        &mesh,
        "q.obj",
        "scalars",
        "obj files have no place for scalars",
    );
    refused(
        &mesh,
        "q.off",
        "materials",
        "off files have no place for materials",
    );
    refused(
        &mesh,
        "q.ply",
        "uv,scalars",
        "the file has no scalars; it has materials, groups, colors, uv",
    );
    // The last corner names texture coordinates that there are not.
    let damaged = cube().replace("7/24", "7/99");
    assert_ne!(damaged, cube());
    let damaged = scratch.write("damaged.obj", damaged);
    refused(
        &damaged,
        "q.obj",
        "all",
        "a corner names no texture coordinates",
    );
    let out = scratch.path("note.obj");
    let words = ["quad", text(&damaged), "--quads", "100", "-o", text(&out)];
    let (code, output) = finish(program(&words));
    let note = String::from_utf8(output.stderr).unwrap();
    assert!(
        code == 0 && note.contains("attributes are not kept: line"),
        "{note}"
    );
    let (_, attributes) = read(&out, Format::Obj);
    assert_eq!(attributes, Attributes::default());
    let (code, report) = run(&words);
    let reason = report["not_kept"].as_str().unwrap_or_default();
    assert!(
        code == 0 && reason.starts_with("line 57: a corner names no"),
        "{report}"
    );
}

/// A square of 10 by 10 squares as glTF, with a buffer beside it: positions, texture coordinates and colours that grow
/// along x and y, then triangles.
fn square_of_gltf(scratch: &Scratch) -> PathBuf {
    let place = |v: u16| [f32::from(v % 11), f32::from(v / 11)];
    let positions = (0..121).map(place).flat_map(|[x, y]| [x, y, 0.0]);
    // They start at the upper side of the image.
    let textures = (0..121)
        .map(place)
        .flat_map(|[x, y]| [x / 10.0, 1.0 - y / 10.0]);
    let colors = (0..121)
        .map(place)
        .flat_map(|[x, y]| [x / 10.0, y / 10.0, 0.0]);
    let numbers = positions.chain(textures).chain(colors);
    let mut bytes: Vec<u8> = numbers.flat_map(f32::to_le_bytes).collect();
    let corners = (0..100).flat_map(|f: u16| {
        let a = 11 * (f / 10) + f % 10;
        [a, a + 1, a + 12, a, a + 12, a + 11]
    });
    bytes.extend(corners.flat_map(u16::to_le_bytes));
    fs::write(scratch.path("square.bin"), &bytes).unwrap();
    let view = |start: usize, length: usize| json!({"buffer": 0, "byteOffset": start, "byteLength": length});
    let array = |view: usize, kind: u32, count: usize, shape: &str| json!({"bufferView": view, "componentType": kind, "count": count, "type": shape});
    let document = json!({
        "asset": {"version": "2.0"},
        "meshes": [{"primitives": [{
            "attributes": {"POSITION": 0, "TEXCOORD_0": 1, "COLOR_0": 2},
            "indices": 3,
        }]}],
        "accessors": [
            array(0, 5126, 121, "VEC3"),
            array(1, 5126, 121, "VEC2"),
            array(2, 5126, 121, "VEC3"),
            array(3, 5123, 600, "SCALAR"),
        ],
        "bufferViews": [view(0, 1452), view(1452, 968), view(2420, 1452), view(3872, 1200)],
        "buffers": [{"uri": "square.bin", "byteLength": bytes.len()}],
    });
    scratch.write("square.gltf", document.to_string())
}

#[test]
fn texture_coordinates_and_colours_of_gltf_come_back() {
    let scratch = Scratch::new("kept-gltf");
    let mesh = square_of_gltf(&scratch);
    let out = scratch.path("quads.obj");
    let words = ["quad", text(&mesh), "--quads", "64", "-o", text(&out)];
    let (code, report) = run(&words);
    assert_eq!(code, 0, "{report}");
    let kept = &report["kept"];
    assert_eq!([&kept["vertex_colors"], &kept["uv"]], [true, true]);
    let (soup, attributes) = read(&out, Format::Obj);
    let near = |a: f64, b: f64| (a - b).abs() < 1e-6;
    let seams = attributes.labels(Attribute::Seams).unwrap();
    for (&v, &label) in soup.corners().iter().zip(seams) {
        let [x, y, _] = soup.positions()[v as usize];
        let [s, t] = attributes.texture_coordinates()[label as usize];
        assert!(near(s, x / 10.0) && near(t, y / 10.0), "{x} {y}: {s} {t}");
    }
    for (&[x, y, _], color) in soup
        .positions()
        .iter()
        .zip(attributes.vertex_colors().unwrap())
    {
        assert!(
            near(color[0], x / 10.0) && near(color[1], y / 10.0),
            "{x} {y}: {color:?}"
        );
    }
    // The density of quads follows the colours as well.
    let dense = scratch.path("dense.obj");
    let words = [
        "quad",
        text(&mesh),
        "--quads",
        "200",
        "--density",
        "colors",
        "-o",
        text(&dense),
    ];
    let (code, report) = run(&words);
    assert_eq!(code, 0, "{report}");
    let (soup, _) = read(&dense, Format::Obj);
    let mean = |axis: usize| {
        let sum: f64 = soup.positions().iter().map(|p| p[axis]).sum();
        sum / soup.positions().len() as f64
    };
    let [x, y] = [mean(0), mean(1)];
    assert!(x > 5.5 && y < 4.75, "{x} {y}");
}
