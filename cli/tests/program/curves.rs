//! `--guide-curves` and `--feature-curves`: curves in space that a field or quads follow.

use std::f64::consts::TAU;
use std::fmt::Write;

use serde_json::{Value, json};

use crate::run::{Scratch, finish, only_object, program};

/// A closed circle of radius 1 around the z-axis, in OBJ.
fn circle(height: f64) -> String {
    let mut text = String::new();
    for i in 0..60 {
        let (s, c) = (TAU * f64::from(i) / 60.0).sin_cos();
        writeln!(text, "v {c} {s} {height}").unwrap();
    }
    let numbers: Vec<String> = (1..=60).map(|i| i.to_string()).collect();
    writeln!(text, "l {} 1", numbers.join(" ")).unwrap();
    text
}

fn run(words: &[&str]) -> (i32, Value) {
    let (code, output) = finish(program(&[words, &["--json"]].concat()));
    (code, only_object(&output))
}

#[test]
fn curves_guide_a_field_and_are_edges_of_quads() {
    let scratch = Scratch::new("curves");
    let file = scratch.write("circle.obj", circle(0.037));
    let (lines, quads) = (file.to_str().unwrap(), scratch.path("quads.obj"));
    let shape = "shape:sphere:2000";
    let (code, report) = run(&["field", shape, "--guide-curves", lines]);
    assert_eq!(code, 0, "{report}");
    assert!(
        report["curves"]["guided_faces"].as_u64() > Some(60),
        "{report}"
    );
    assert_eq!(report["curves"]["inserted_vertices"], json!(0));
    let (code, report) = run(&["parametrize", shape, "--feature-curves", lines]);
    assert_eq!(code, 0, "{report}");
    assert_eq!(report["feature_edges"], report["curves"]["curve_edges"]);
    let out = quads.to_str().unwrap();
    let words = [
        "quad",
        shape,
        "--quads",
        "400",
        "-o",
        out,
        "--feature-curves",
        lines,
    ];
    let (code, report) = run(&words);
    assert_eq!(code, 0, "{report}");
    assert_eq!(report["curves"]["feature_curves"], json!(1));
    assert!(
        report["curves"]["inserted_vertices"].as_u64() > Some(30),
        "{report}"
    );
    assert_eq!(report["missed_features"], json!([]));
    // Flags that count faces count those of the mesh that was given.
    let (code, report) = run(&[&words[..], &["--fix", "1990:10"]].concat());
    assert_eq!(code, 0, "{report}");
}

#[test]
fn curves_that_cannot_be_drawn_are_refused() {
    let scratch = Scratch::new("bad-curves");
    let shape = "shape:sphere:500";
    for (text, message) in [
        (circle(3.0), "off the surface"),
        ("v 0 0 1\nl 1\n".into(), "two points"),
        ("v 0 0 1\n".into(), "no lines"),
        ("v 0 0 1\nl 1 2\n".into(), "'2' is no vertex"),
        ("v 0 0 1\nv nan 0 1\nl 1 2\n".into(), "point"),
    ] {
        let file = scratch.write("lines.obj", &text);
        for flag in ["--guide-curves", "--feature-curves"] {
            let (code, report) = run(&["field", shape, flag, file.to_str().unwrap()]);
            let told = report["error"]["message"].as_str().unwrap_or_default();
            assert!(code != 0 && told.contains(message), "{report}");
        }
    }
}
