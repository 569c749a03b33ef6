//! `roundel distance`: figures, the file, the picture, and sources that the mesh does not have.

use std::fs;

use crate::run::{Scratch, finish, only_object, program};

#[test]
fn distances_from_the_boundary_are_told_and_written() {
    let scratch = Scratch::new("distance");
    let path = |name: &str| scratch.path(name).to_str().unwrap().to_owned();
    let (ply, png) = (path("out.ply"), path("out.png"));
    let (code, output) = finish(program(&[
        "distance",
        "shape:plane:200",
        "--from",
        "boundary",
        "-o",
        &ply,
        "--picture",
        &png,
        "--picture-size",
        "160x120",
        "--json",
    ]));
    let told = only_object(&output);
    assert_eq!(code, 0);
    assert!((told["largest_distance"].as_f64().unwrap() - 1.0).abs() < 1e-14);
    assert_eq!(
        (&told["sources"], &told["reached"]),
        (&1.into(), &told["vertices"])
    );
    let written = fs::read(&ply).unwrap();
    let end = b"end_header\n";
    let start = written.windows(end.len()).position(|w| w == end).unwrap() + end.len();
    let header = String::from_utf8_lossy(&written[..start]);
    assert!(
        header.contains("property uchar blue\nproperty double quality\n"),
        "{header}"
    );
    // Three doubles, three bytes of colour, and the distance: that of the middle is the largest.
    let record = 3 * 8 + 3 + 8;
    let far = told["farthest_vertex"].as_u64().unwrap() as usize;
    let at = start + far * record + record - 8;
    let quality = f64::from_le_bytes(written[at..at + 8].try_into().unwrap());
    assert_eq!(Some(quality), told["largest_distance"].as_f64());
    assert!(fs::read(&png).unwrap().starts_with(b"\x89PNG"));
}

#[test]
fn sources_are_counted_and_limits_kept() {
    let run = |words: &[&str]| {
        let (code, output) = finish(program(&[&["distance"], words, &["--json"]].concat()));
        (code, only_object(&output))
    };
    let (_, all) = run(&[
        "shape:gear:2000",
        "--from",
        "features",
        "--from",
        "vertex:5",
    ]);
    let (_, near) = run(&["shape:gear:2000", "--from", "vertex:5", "--limit", "0.2"]);
    assert!(all["sources"].as_u64().unwrap() > 20);
    assert_eq!(all["reached"], all["vertices"]);
    assert!(near["reached"].as_u64() < near["vertices"].as_u64());
    assert!(near["largest_distance"].as_f64().unwrap() <= 0.2);
}

#[test]
fn sources_that_the_mesh_lacks_are_errors() {
    for (words, code) in [
        (
            ["shape:sphere:200", "--from", "boundary"],
            "invalid_argument",
        ),
        (
            ["shape:sphere:200", "--from", "vertex:100000"],
            "index_out_of_range",
        ),
    ] {
        let (exit, output) = finish(program(&[&["distance"], &words[..], &["--json"]].concat()));
        assert_eq!(exit, 1);
        assert_eq!(only_object(&output)["error"]["code"], code);
    }
    let (exit, _) = finish(program(&["distance", "shape:sphere:200"]));
    assert_eq!(exit, 2);
    let (exit, _) = finish(program(&[
        "distance",
        "shape:sphere:200",
        "--from",
        "face:3",
    ]));
    assert_eq!(exit, 2);
}

#[test]
fn lines_of_a_file_are_drawn_onto_the_surface() {
    let scratch = Scratch::new("distance_lines");
    let run = |text: &str| {
        let file = scratch.write("lines.obj", text);
        let file = file.to_str().unwrap().to_owned();
        let words = ["distance", "shape:plane:200", "--json", "--from", &file];
        let (code, output) = finish(program(&words));
        (code, only_object(&output))
    };
    // The left side of the square, a little above it, and a point on it.
    let (code, told) = run("v -1 -1 0.1\nv -1 1 0.1\nl 1 2\nl -1\n");
    assert_eq!((code, &told["sources"]), (0, &2.into()));
    assert!((told["largest_distance"].as_f64().unwrap() - 2.0).abs() < 1e-14);
    for (text, line) in [("v 0\n", 1), ("v 0 0 0\nl 1 2\n", 2), ("v 0 0 x\n", 1)] {
        let (code, told) = run(text);
        assert_eq!((code, &told["error"]["line"]), (1, &line.into()), "{text}");
    }
    assert_eq!(run("v 0 0 0\n").1["error"]["code"], "invalid_argument");
}
