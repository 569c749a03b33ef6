//! `roundel layout`: quads that follow a layout, and the layout that quads have: counts, files, and bad input.

use std::fs;

use crate::run::{Scratch, finish, only_object, program};

/// The six sides of a cube.
pub const CUBE: &str = "\
v 0 0 0\nv 1 0 0\nv 0 1 0\nv 1 1 0\nv 0 0 1\nv 1 0 1\nv 0 1 1\nv 1 1 1
f 1 3 4 2\nf 5 6 8 7\nf 1 2 6 5\nf 3 7 8 4\nf 1 5 7 3\nf 2 4 8 6\n";

#[test]
fn a_cube_is_its_own_layout() {
    let scratch = Scratch::new("layout");
    let path = |name: &str| scratch.path(name).to_str().unwrap().to_owned();
    let [cube, layout, groups, patches] =
        ["cube.obj", "layout.obj", "groups.obj", "patches.obj"].map(path);
    fs::write(&cube, CUBE).unwrap();
    let words = ["layout", "--of", &cube, "-o", &layout, "--groups", &groups];
    let (code, output) = finish(program(
        &[&words[..], &["--patches", &patches, "--json"]].concat(),
    ));
    let told = only_object(&output);
    assert_eq!(code, 0);
    assert_eq!(
        (&told["irregular"], &told["euler_characteristic"]),
        (&8.into(), &2.into())
    );
    for kind in ["base", "motorcycle"] {
        let counts = ["nodes", "arcs", "patches"].map(|what| told[kind][what].as_u64());
        assert_eq!(counts, [Some(8), Some(12), Some(6)]);
    }
    assert_eq!(told["subdivisions"], serde_json::json!(vec![1; 12]));
    assert_eq!(told["surfaces"]["is_within"], true);
    let count = |file: &str, start: &str| {
        let text = fs::read_to_string(file).unwrap();
        text.lines().filter(|line| line.starts_with(start)).count()
    };
    assert_eq!(
        ["v ", "f ", "l ", "# sides "].map(|start| count(&layout, start)),
        [8, 6, 12, 6]
    );
    assert_eq!(
        ["v ", "g patch_", "f "].map(|start| count(&groups, start)),
        [8, 6, 6]
    );
    assert_eq!(
        ["surf 0 1 0 1 ", "parm u ", "end"].map(|start| count(&patches, start)),
        [6, 6, 6]
    );
}

#[test]
fn what_is_no_surface_of_quads_is_an_error() {
    let scratch = Scratch::new("layout-bad");
    for (name, old, new, code, index) in [
        ("triangle", "f 1 3 4 2", "f 1 3 4", "not_a_quad", 0),
        (
            "turned",
            "f 1 3 4 2",
            "f 2 4 3 1",
            "inconsistent_orientation",
            0,
        ),
        ("nan", "v 1 0 0", "v nan 0 0", "vertex_not_finite", 1),
    ] {
        let file = scratch.path(&format!("{name}.obj"));
        fs::write(&file, CUBE.replace(old, new)).unwrap();
        let words = ["layout", "--of", file.to_str().unwrap(), "--json"];
        let (exit, output) = finish(program(&words));
        let told = only_object(&output);
        assert_eq!((exit, &told["error"]["code"]), (1, &code.into()), "{told}");
        assert_eq!(told["error"]["index"], index, "{told}");
    }
}

/// The cube around the origin.
pub fn cube_around_the_origin() -> String {
    CUBE.replace("v 0 ", "v -1 ")
        .lines()
        .map(|line| match line.strip_prefix("v ") {
            Some(rest) => {
                let at = rest.split(' ').map(|x| if x == "0" { "-1" } else { x });
                format!("v {}\n", at.collect::<Vec<_>>().join(" "))
            }
            None => format!("{line}\n"),
        })
        .collect()
}

#[test]
fn quads_follow_a_layout() {
    let scratch = Scratch::new("layout-along");
    let path = |name: &str| scratch.path(name).to_str().unwrap().to_owned();
    let [cube, quads, colors] = ["cube.obj", "quads.obj", "colors.ply"].map(path);
    fs::write(&cube, cube_around_the_origin()).unwrap();
    let words = ["layout", "shape:sphere:1000", "--layout", &cube, "--json"];
    let more = [
        "--quads", "300", "--fix", "1-3=4", "-o", &quads, "--colors", &colors,
    ];
    let (code, output) = finish(program(&[&words[..], &more].concat()));
    let told = only_object(&output);
    assert_eq!(code, 0, "{told}");
    assert_eq!(
        (&told["patches"], &told["faces"]),
        (&6.into(), &told["faces"])
    );
    for flag in ["conforming", "as_prescribed", "optimal"] {
        assert_eq!(told[flag], true, "{flag}");
    }
    let arcs = told["arcs"].as_array().unwrap();
    let edges = |ends: [u32; 2]| {
        let is_it = |arc: &&serde_json::Value| arc["ends"] == serde_json::json!(ends);
        arcs.iter().find(is_it).unwrap()["edges"].as_u64().unwrap()
    };
    assert_eq!((arcs.len(), edges([1, 3])), (12, 4));
    let count = |file: &str, start: &str| {
        let text = fs::read(file).unwrap();
        let text = String::from_utf8_lossy(&text);
        text.lines().filter(|line| line.starts_with(start)).count()
    };
    assert_eq!(Some(count(&quads, "f ") as u64), told["quads"].as_u64());
    assert_eq!(count(&colors, "property uchar red"), 1);
    let (code, output) = finish(program(
        &[&words[..], &["--fewest", "--hold-vertices"]].concat(),
    ));
    assert_eq!((code, &only_object(&output)["quads"]), (0, &6.into()));
}

#[test]
fn what_contradicts_itself_or_is_not_there_is_told() {
    let scratch = Scratch::new("layout-along-bad");
    let cube = scratch.path("cube.obj").to_str().unwrap().to_owned();
    fs::write(&cube, cube_around_the_origin()).unwrap();
    let words = ["layout", "shape:sphere:300", "--layout", &cube, "--json"];
    for (more, exit_code, code) in [
        (&["--fix", "1-3=4", "--fix", "2-4=5"][..], 3, "infeasible"),
        (&["--fix", "1-8=4"], 1, "invalid_argument"),
        (&["--edge-length", "0"], 1, "invalid_argument"),
    ] {
        let (exit, output) = finish(program(&[&words[..], more].concat()));
        let told = only_object(&output);
        let expected = (exit_code, &code.into());
        assert_eq!((exit, &told["error"]["code"]), expected, "{told}");
    }
    let of = ["layout", "--of", &cube];
    for wrong in [
        &["layout", "shape:sphere:300"][..],
        &["layout", "--layout", &cube],
        &[
            "layout",
            "shape:sphere:300",
            "--layout",
            &cube,
            "--kind",
            "base",
        ],
        &[&of[..], &["--quads", "7"]].concat(),
        &[&words[..], &["--fix", "1-3"]].concat(),
    ] {
        assert_eq!(finish(program(wrong)).0, 2, "{wrong:?}");
    }
}
