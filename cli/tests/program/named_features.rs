//! `--features` by names of what the faces on both sides of an edge differ in, and sharp edges that are too short.

use std::fmt::Write;
use std::fs;
use std::path::Path;

use serde_json::{Value, json};

use crate::run::{Scratch, finish, only_object, program};

/// A square of ten by ten squares, each vertex written anew by both halves, the left of them red and the
/// right blue, in OBJ.
fn halves(path: &Path) {
    let mut text = String::new();
    for (name, from) in [("red", 0), ("blue", 5)] {
        for y in 0..=10 {
            for x in from..=from + 5 {
                writeln!(text, "v {x} {y} 0").unwrap();
            }
        }
        writeln!(text, "usemtl {name}").unwrap();
        for y in 0..10 {
            for x in 0..5 {
                let corner = |x: i32, y: i32| 6 * y + x - 66;
                let [a, b, c, d] = [(x, y), (x + 1, y), (x + 1, y + 1), (x, y + 1)];
                let corners = [a, b, c, d].map(|(x, y)| corner(x, y));
                let [a, b, c, d] = corners;
                writeln!(text, "f {a} {b} {c} {d}").unwrap();
            }
        }
    }
    fs::write(path, text).unwrap();
}

fn run(words: &[&str]) -> (i32, Value) {
    let (code, output) = finish(program(&[words, &["--json"]].concat()));
    (code, only_object(&output))
}

/// A square of 20 by 20 squares with a spike of one square's height in its middle, in OBJ.
fn spike(path: &Path) {
    let mut text = String::new();
    for y in 0..=20 {
        for x in 0..=20 {
            let height = i32::from((x, y) == (10, 10));
            writeln!(text, "v {x} {y} {height}").unwrap();
        }
    }
    for y in 0..20 {
        for x in 0..20 {
            let a = 21 * y + x + 1;
            writeln!(text, "f {a} {} {}", a + 1, a + 22).unwrap();
            writeln!(text, "f {a} {} {}", a + 22, a + 21).unwrap();
        }
    }
    fs::write(path, text).unwrap();
}

#[test]
fn sharp_edges_too_short_for_quads_are_left_out_and_counted() {
    let scratch = Scratch::new("short-features");
    let file = scratch.path("spike.obj");
    spike(&file);
    let quad = ["quad", file.to_str().unwrap(), "--quads", "25"];
    let sharp = [&quad[..], &["--features", "40"]].concat();
    let all = [&sharp[..], &["--feature-length", "0"]].concat();
    let short = |words: &[&str]| {
        let (code, report) = run(words);
        assert_eq!(code, 0, "{report}");
        report["short_features"].as_u64().unwrap()
    };
    // What is sharp: some of the edges at the tip, and around it.
    let (code, field) = run(&["field", quad[1], "--features", "40"]);
    assert_eq!(code, 0);
    let edges = field["feature_edges"].as_u64().unwrap();
    assert!(edges > 80, "those of the boundary, and more: {edges}");
    assert_eq!([&quad[..], &all, &sharp].map(short), [0, 0, edges - 80]);
    let map = [&["parametrize"], &sharp[1..]].concat();
    assert_eq!(short(&map), edges - 80);
    for words in [sharp, map] {
        let (code, output) = finish(program(&words));
        let summary = String::from_utf8(output.stdout).unwrap();
        assert_eq!(code, 0);
        let told = "left out: too short for quads";
        assert!(summary.contains(told), "{summary}");
    }
}

#[test]
fn quads_follow_the_edge_between_two_materials_after_repair() {
    let scratch = Scratch::new("named-features");
    let (file, quads) = (scratch.path("halves.obj"), scratch.path("quads.obj"));
    halves(&file);
    let (name, out) = (file.to_str().unwrap(), quads.to_str().unwrap());
    let (code, report) = run(&["field", name, "--features", "materials"]);
    assert_eq!((code, &report["feature_edges"]), (0, &json!(10 + 40)));
    let (code, report) = run(&["field", name, "--features", "angle:40"]);
    assert_eq!((code, &report["feature_edges"]), (0, &json!(40)));
    let (code, report) = run(&[
        "quad",
        name,
        "--quads",
        "90",
        "--features",
        "40,materials",
        "-o",
        out,
    ]);
    assert_eq!(code, 0, "{report}");
    assert_eq!(report["missed_features"], json!([]));
    // A chain of edges of the quads runs along x = 5 from one side to the other.
    let written = roundel::soup::io::read(&quads).unwrap();
    let on_line = |v: i64| {
        let [x, y, _] = written.positions()[v as usize];
        ((x - 5.0).abs() < 1e-9).then_some(y)
    };
    let mut length = 0.0;
    for quad in written.polygons() {
        for k in 0..4 {
            if let (Some(a), Some(b)) = (on_line(quad[k]), on_line(quad[(k + 1) % 4])) {
                length += (a - b).abs();
            }
        }
    }
    // Each of its edges has a quad on both sides.
    assert!((length - 20.0).abs() < 1e-9, "{length}");
}

#[test]
fn strict_reading_has_attributes_too() {
    let scratch = Scratch::new("named-features-strict");
    let file = scratch.path("two.obj");
    let text = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\ng a\nf 1 2 3\ng b\nf 1 3 4\n";
    fs::write(&file, text).unwrap();
    let name = file.to_str().unwrap();
    let (code, report) = run(&["field", name, "--strict", "--features", "groups"]);
    assert_eq!((code, &report["feature_edges"]), (0, &json!(5)));
}

#[test]
fn what_the_file_lacks_is_an_error_that_says_what_it_has() {
    let scratch = Scratch::new("named-features-missing");
    let file = scratch.path("halves.obj");
    halves(&file);
    for command in ["field", "parametrize", "quad"] {
        let (code, report) = run(&[command, file.to_str().unwrap(), "--features", "seams"]);
        assert_ne!(code, 0, "{command}");
        let message = report["error"]["message"].as_str().unwrap_or_default();
        assert!(
            message.contains("no seams; it has materials"),
            "{command}: {report}"
        );
        let (code, report) = run(&[command, "shape:sphere:500", "--features", "materials"]);
        assert_ne!(code, 0, "{command}");
        assert_eq!(
            report["error"]["code"],
            json!("invalid_argument"),
            "{report}"
        );
    }
}
