//! Files as people have them: what is repaired, what is told of it, and what is refused.

use std::fs;
use std::io::Write;
use std::path::Path;
use std::process::Stdio;

use roundel::mesh::{io, shape};
use serde_json::{Value, json};

use crate::run::{Scratch, finish, only_object, program};

/// A square of two polygons, the second of them turned, with vertices of their own, and a vertex of no face.
const SOUP: &str = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 1 0 0\nv 2 0 0\nv 2 1 0\nv 1 1 0\nv 9 9 9\n\
                    f 1 2 3 4\nf 8 7 6 5\n";

fn text(path: &Path) -> &str {
    path.to_str().unwrap()
}

fn object(words: &[&str]) -> (i32, Value) {
    let (code, output) = finish(program(&[words, &["--json"]].concat()));
    (code, only_object(&output))
}

#[test]
fn what_was_repaired_is_told_and_can_be_traced() {
    let scratch = Scratch::new("repair");
    let soup = scratch.write("soup.obj", SOUP);
    let (out, edits) = (scratch.path("mesh.ply"), scratch.path("edits.json"));
    let (code, report) = object(&[
        "repair",
        text(&soup),
        "-o",
        text(&out),
        "--edits",
        text(&edits),
    ]);
    assert_eq!((code, &report["faces"]), (0, &json!(4)), "{report}");
    let expected = json!({
        "vertex_welded": 2,
        "polygon_triangulated": 2,
        "polygon_turned": 1,
        "vertex_unused": 1,
    });
    assert_eq!(report["repair"], expected);
    let mesh = io::read(&out).unwrap();
    assert_eq!((mesh.face_count(), mesh.euler_characteristic()), (4, 1));
    let list: Value = serde_json::from_slice(&fs::read(&edits).unwrap()).unwrap();
    assert_eq!(list["edits"].as_array().unwrap().len(), 6);
    assert_eq!(list["triangle_origin"], json!([0, 0, 1, 1]));
    let turned = json!({"kind": "polygon_turned", "element": 1, "other": null});
    assert!(
        list["edits"].as_array().unwrap().contains(&turned),
        "{list}"
    );
    // What is sound already stays what it is.
    let (_, again) = object(&["repair", text(&out)]);
    assert_eq!(again["repair"], json!({}));
}

#[test]
fn commands_repair_what_they_read_and_say_so() {
    let scratch = Scratch::new("repair-read");
    let soup = scratch.write("soup.obj", SOUP);
    let out = scratch.path("quads.usda");
    let words = ["quad", text(&soup), "--quads", "50", "-o", text(&out)];
    let (code, output) = finish(program(&words));
    let told = String::from_utf8(output.stderr).unwrap();
    assert_eq!(code, 0, "{told}");
    assert_eq!(told.lines().count(), 1, "{told}");
    assert!(told.contains("repaired: welded 2 vertices"), "{told}");
    assert!(fs::read_to_string(&out).unwrap().starts_with("#usda 1.0"));
    let (code, report) = object(&words);
    assert_eq!((code, &report["conforming"]), (0, &json!(true)), "{report}");
    assert_eq!(report["repair"]["polygon_triangulated"], json!(2));
    let (code, report) = object(&["field", text(&soup), "--strict"]);
    assert_eq!(code, 1);
    assert_eq!(report["error"]["code"], json!("not_a_triangle"), "{report}");
}

#[test]
fn quads_in_a_format_without_quads_are_split_and_that_is_told() {
    let scratch = Scratch::new("repair-split");
    let out = scratch.path("quads.stl");
    let words = [
        "quad",
        "shape:torus:800",
        "--quads",
        "200",
        "-o",
        text(&out),
    ];
    let (code, output) = finish(program(&words));
    let told = String::from_utf8(output.stderr).unwrap();
    assert_eq!((code, told.lines().count()), (0, 1), "{told}");
    assert_eq!(io::read(&out).unwrap().euler_characteristic(), 0);
}

#[test]
fn standard_input_is_read_in_the_format_that_is_named() {
    let scratch = Scratch::new("repair-stdin");
    let file = scratch.path("cube.stl");
    io::write(&file, &shape::by_name("rounded-cube", 600).unwrap()).unwrap();
    let run = |words: &[&str]| {
        let mut command = program(&[&["repair", "-", "--json"], words].concat());
        command.stdin(Stdio::piped()).stdout(Stdio::piped());
        let mut child = command.spawn().unwrap();
        let mut input = child.stdin.take().unwrap();
        // The program may have refused without reading.
        let _ = input.write_all(&fs::read(&file).unwrap());
        drop(input);
        let output = child.wait_with_output().unwrap();
        serde_json::from_slice::<Value>(&output.stdout).unwrap()
    };
    let report = run(&["--format", "stl"]);
    assert_eq!(report["euler_characteristic"], json!(2), "{report}");
    assert!(report["repair"]["vertex_welded"].as_u64().unwrap() > 1000);
    let report = run(&[]);
    assert_eq!(report["error"]["code"], json!("invalid_argument"));
    let report = run(&["--format", "ply"]);
    assert_eq!(report["status"], json!("error"), "{report}");
}

#[test]
fn flags_that_count_elements_need_a_mesh_that_keeps_its_numbers() {
    let scratch = Scratch::new("repair-numbers");
    let soup = scratch.write("soup.obj", SOUP);
    let (code, report) = object(&["field", text(&soup), "--fix", "0:5"]);
    assert_eq!(
        (code, &report["error"]["code"]),
        (1, &json!("invalid_argument"))
    );
    let message = report["error"]["message"].as_str().unwrap();
    assert!(message.contains("roundel repair"), "{message}");
}

#[test]
fn what_holds_no_surface_is_refused() {
    let scratch = Scratch::new("repair-none");
    for (name, content, code) in [
        ("points.obj", "v 0 0 0\nv 1 0 0\n", "no_surface"),
        (
            "flat.obj",
            "v 0 0 0\nv 1 0 0\nv 2 0 0\nf 1 2 3\n",
            "no_surface",
        ),
        (
            "cut.stl",
            "solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0",
            "parse",
        ),
        ("mesh.3mf", "", "unknown_format"),
    ] {
        let file = scratch.write(name, content);
        for command in ["repair", "quad"] {
            let (exit, report) = object(&[command, text(&file)]);
            assert_eq!(exit, 1, "{name}");
            assert_eq!(report["error"]["code"], json!(code), "{report}");
        }
    }
}
