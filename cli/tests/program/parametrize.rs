//! `roundel parametrize`: what is told of a map, what is written of it, and how it fails.

use std::fs;
use std::path::Path;

use serde_json::{Value, json};

use crate::run::{Scratch, finish, only_object, program, solve};

const CUBE: &str = "shape:rounded-cube:1200";

/// Runs `roundel parametrize WORDS... --json`.
fn parametrize(words: &[&str]) -> (i32, Value) {
    let (code, output) = finish(program(&[&["parametrize"], words, &["--json"]].concat()));
    (code, only_object(&output))
}

fn text(path: &Path) -> &str {
    path.to_str().unwrap()
}

#[test]
fn a_rounded_cube_turns_around_its_corners() {
    let (code, report) = parametrize(&[CUBE, "--quads", "96"]);
    assert_eq!(code, 0, "{report}");
    assert_eq!(report["irregular_vertices"], json!(8), "{report}");
    assert_eq!(report["quads"], json!(96));
    // Two coordinates for each cone but what the Euler characteristic takes away.
    assert_eq!(report["reduced_integers"], json!(12));
    assert_eq!(report["flipped"], json!(0));
    assert_eq!(report["winding_defects"], json!([]));
    assert!(report["cut_edges"].as_u64() > Some(0));
    assert!(report["gradient_energy"].as_f64() <= report["energy"].as_f64());
    assert_eq!(report["field"]["strategy"], json!("adaptive"));
}

#[test]
fn the_problem_written_is_the_problem_solved() {
    let scratch = Scratch::new("parametrize-problem");
    let problem = scratch.path("problem.mps.gz");
    let (_, report) = parametrize(&["shape:genus-2:600", "--write-problem", text(&problem)]);
    let (code, output) = finish(solve(&problem, &["--json"]));
    let again = only_object(&output);
    assert_eq!(code, 0, "{again}");
    assert_eq!(again["integers"], report["integers"]);
    assert_eq!(again["reduced_integers"], report["reduced_integers"]);
    let [a, b] = [&report, &again].map(|r| r["energy"].as_f64().unwrap());
    assert!((a - b).abs() < 1e-8 * a, "{a} {b}");
}

#[test]
fn the_file_written_tears_the_texture_at_the_cut_alone() {
    let scratch = Scratch::new("parametrize-uv");
    let out = scratch.path("uv.obj");
    let (_, report) = parametrize(&[CUBE, "-o", text(&out)]);
    let content = fs::read_to_string(&out).unwrap();
    let lines = |keyword: &str| {
        let of_kind = content
            .lines()
            .filter(|l| l.split(' ').next() == Some(keyword));
        of_kind.collect::<Vec<_>>()
    };
    assert_eq!(json!(lines("v").len()), report["vertices"]);
    assert_eq!(json!(lines("f").len()), report["faces"]);
    // A closed surface of V - E + F = 2, cut open to a disk of V - E + F = 1.
    let cut_edges = report["cut_edges"].as_u64().unwrap() as usize;
    assert_eq!(lines("vt").len(), lines("v").len() + cut_edges - 1);
    let is_covered = |face: &&str| {
        let corners = face.split(' ').skip(1).map(|c| c.split_once('/').unwrap());
        let numbers = corners.map(|(v, vt)| (v.parse().unwrap(), vt.parse().unwrap()));
        numbers.into_iter().all(|(v, vt): (usize, usize)| {
            (1..=lines("v").len()).contains(&v) && (1..=lines("vt").len()).contains(&vt)
        })
    };
    assert!(lines("f").iter().take(50).all(is_covered));
    let mesh = roundel::mesh::io::read(&out).unwrap();
    assert_eq!(json!(mesh.face_count()), report["faces"]);
}

#[test]
fn a_relaxation_is_a_map_of_less_energy() {
    let energy = |strategy| {
        let (code, report) = parametrize(&["shape:torus:600", "--strategy", strategy]);
        assert_eq!((code, &report["strategy"]), (0, &json!(strategy)));
        report["energy"].as_f64().unwrap()
    };
    assert!(energy("relax") <= energy("greedy") + 1e-9);
}

#[test]
fn the_summary_tells_each_phase() {
    let (code, output) = finish(program(&["parametrize", CUBE]));
    let told = String::from_utf8(output.stdout).unwrap();
    assert_eq!(code, 0, "{told}");
    let first = |line: &str| line.split(' ').next().map(str::to_owned);
    let phases: Vec<_> = told.lines().filter_map(first).collect();
    let expected = [
        "read",
        "field",
        "assemble",
        "eliminate",
        "auto",
        "untangle",
        "map",
    ];
    assert_eq!(phases, expected, "{told}");
    assert!(told.contains("8 irregular vertices"), "{told}");
}

/// How many sides of triangles lie on an isoline of integer value, to the last digit.
fn on_isolines(file: &Path) -> usize {
    let content = fs::read_to_string(file).unwrap();
    let words = |keyword: &'static str| {
        let lines = content.lines().filter_map(move |l| l.strip_prefix(keyword));
        lines.map(|l| l.split(' ').collect::<Vec<_>>())
    };
    let uv: Vec<[f64; 2]> = words("vt ")
        .map(|w| [0, 1].map(|axis| w[axis].parse().unwrap()))
        .collect();
    let faces = words("f ").map(|w| {
        let corner = |k: usize| w[k].split('/').nth(1).unwrap().parse::<usize>().unwrap();
        [0, 1, 2].map(|k| uv[corner(k) - 1])
    });
    let lies =
        |a: [f64; 2], b: [f64; 2]| (0..2).any(|axis| a[axis] == b[axis] && a[axis].fract() == 0.0);
    faces
        .map(|p| (0..3).filter(|&k| lies(p[k], p[(k + 1) % 3])).count())
        .sum()
}

#[test]
fn features_and_the_boundary_are_isolines_unless_it_is_free() {
    let scratch = Scratch::new("parametrize-features");
    let out = scratch.path("uv.obj");
    let gear = [
        "shape:gear:2000",
        "--features",
        "40",
        "--edge-length",
        "0.1",
    ];
    let (code, report) = parametrize(&[&gear, &["-o", text(&out)][..]].concat());
    assert_eq!(code, 0, "{report}");
    assert_eq!(report["edge_length"], json!(0.1));
    assert_eq!(report["quads"], Value::Null);
    let features = report["feature_edges"].as_u64().unwrap();
    assert!(features > 100, "{report}");
    assert!(on_isolines(&out) as u64 >= 2 * features);

    let plate = ["shape:plate-with-holes:900", "-o", text(&out)];
    let (_, report) = parametrize(&plate);
    let rim = report["feature_edges"].as_u64().unwrap();
    assert!(rim > 0 && on_isolines(&out) as u64 >= rim, "{report}");
    let (_, report) = parametrize(&[&plate[..], &["--free-boundary"]].concat());
    assert_eq!(report["feature_edges"], json!(0));
    assert!(2 * (on_isolines(&out) as u64) < rim);
}

#[test]
fn guides_lines_and_sizes_come_from_files() {
    let scratch = Scratch::new("parametrize-files");
    let mesh = scratch.path("plane.obj");
    let shape = ["shape", "plane", "--triangles", "200", "-o", text(&mesh)];
    assert_eq!(finish(program(&shape)).0, 0);
    let content = fs::read_to_string(&mesh).unwrap();
    let faces = content.lines().filter(|l| l.starts_with("f ")).count();
    let first: Vec<usize> = {
        let face = content.lines().find(|l| l.starts_with("f ")).unwrap();
        let corners = face.split(' ').skip(1);
        corners
            .map(|w| w.split('/').next().unwrap().parse().unwrap())
            .collect()
    };
    let lines = scratch.write(
        "lines.obj",
        format!("{content}l {} {}\n", first[0], first[1]),
    );
    let guide = format!(
        "direction 7 1 1 0 # hard\ndirection 9 1 0 0 0.5\nedge {} {}\n",
        first[1] - 1,
        first[2] - 1
    );
    let guide = scratch.write("guide.txt", guide);
    let sizes = scratch.write("sizes.txt", "0.2\n".repeat(faces - 1) + "0.2 0.1\n");
    let mut words = vec![
        text(&lines),
        "--free-boundary",
        "--feature-lines",
        text(&lines),
    ];
    words.extend(["--guide", text(&guide), "--edge-lengths", text(&sizes)]);
    let (code, report) = parametrize(&words);
    assert_eq!(code, 0, "{report}");
    assert_eq!(report["feature_edges"], json!(2));

    let wrong = scratch.write("wrong.txt", "edge 0 1\ndirection 0 0 0 1\n");
    for (flag, line) in [
        ("--guide", 2),
        ("--edge-lengths", 1),
        ("--feature-lines", 0),
    ] {
        let (code, report) = parametrize(&[text(&mesh), flag, text(&wrong)]);
        if line > 0 {
            assert_eq!(
                (code, &report["error"]["code"]),
                (1, &json!("parse")),
                "{report}"
            );
            let message = report["error"]["message"].as_str().unwrap();
            assert!(message.contains("wrong.txt"), "{message}");
        } else {
            // A file without line elements asks for nothing.
            assert_eq!(code, 0, "{report}");
        }
    }
}

#[test]
fn what_cannot_be_written_or_asked_for_is_an_error() {
    let scratch = Scratch::new("parametrize-errors");
    let nowhere = scratch.path("missing").join("uv.obj");
    let (code, report) = parametrize(&[CUBE, "-o", text(&nowhere)]);
    assert_eq!((code, &report["error"]["code"]), (1, &json!("io")));
    for flags in [
        ["--quads", "0"],
        ["--edge-length", "0"],
        ["--features", "200"],
        ["--field-strategy", "relax"],
    ] {
        let (code, output) = finish(program(&[&["parametrize", CUBE], &flags[..]].concat()));
        assert_eq!(code, 2);
        let told = String::from_utf8_lossy(&output.stderr).into_owned();
        assert!(told.contains(flags[0]), "{told}");
    }
}

#[test]
fn a_field_from_a_file_gives_the_map_of_that_field() {
    let scratch = Scratch::new("parametrize-field");
    for shape in [CUBE, "shape:plate-with-holes:900"] {
        let file = scratch.path("field.txt");
        let words = ["field", shape, "--strategy", "direct", "-o", text(&file)];
        assert_eq!(finish(program(&words)).0, 0);
        let (code, from_file) = parametrize(&[shape, "--field", text(&file)]);
        assert_eq!(code, 0, "{from_file}");
        assert_eq!(from_file["field"]["strategy"], Value::Null);
        assert_eq!(from_file["field"]["file"], json!(text(&file)));
        let as_it_is = ["--constrain-curvature", "0.1", "--detail", "0"];
        let words = [&[shape, "--field-strategy", "direct"], &as_it_is[..]].concat();
        let solved = parametrize(&words).1;
        assert_eq!(
            from_file["irregular_vertices"],
            solved["irregular_vertices"]
        );
        let [a, b] = [&from_file, &solved].map(|r| r["energy"].as_f64().unwrap());
        assert!((a - b).abs() < 1e-6 * a, "{shape}: {a} {b}");
    }
}

#[test]
fn holes_smaller_than_a_quad_keep_their_sides() {
    for shape in ["shape:plate-with-holes:900", "shape:plate-with-holes:3000"] {
        let (code, report) = parametrize(&[shape, "--quads", "20"]);
        assert_eq!(code, 0, "{report}");
        assert_eq!(report["flipped"], json!(0), "{report}");
        // Finer only for vertices that it would go around too often.
        let refinements = report["untangle"]["refinements"].as_u64();
        assert!(refinements.is_some_and(|n| n <= 2), "{report}");
    }
}

#[test]
fn saddles_are_gone_around_as_often_as_the_field_says() {
    let cases = [("genus-2", "60"), ("genus-2", "240"), ("genus-3", "30")];
    for (name, quads) in cases {
        let shape = format!("shape:{name}:1500");
        let (code, report) = parametrize(&[&shape, "--quads", quads]);
        assert_eq!(code, 0, "{report}");
        assert_eq!(report["flipped"], json!(0), "{report}");
        assert_eq!(report["winding_defects"], json!([]), "{report}");
    }
}

#[test]
fn a_field_of_something_else_is_an_error_with_its_line() {
    let scratch = Scratch::new("parametrize-wrong-field");
    let short = scratch.write("short.txt", "1 0 0\n");
    let long = scratch.write("long.txt", "0.3 0.5 0.7\n".repeat(1201));
    let typed = scratch.write("typed.txt", "1 0 0\n1 O 0\n");
    for (file, line) in [(&short, 1), (&long, 1201), (&typed, 2)] {
        let (code, report) = parametrize(&[CUBE, "--field", text(file)]);
        assert_eq!((code, &report["error"]["code"]), (1, &json!("parse")));
        assert_eq!(report["error"]["line"], json!(line), "{report}");
        let message = report["error"]["message"].as_str().unwrap();
        assert!(message.contains(text(file)), "{message}");
    }
    let nowhere = scratch.path("none.txt");
    let (code, report) = parametrize(&[CUBE, "--field", text(&nowhere)]);
    assert_eq!((code, &report["error"]["code"]), (1, &json!("io")));
    let both = ["parametrize", CUBE, "--field", text(&short), "--fix", "1:2"];
    assert_eq!(finish(program(&both)).0, 2);
}

#[test]
fn a_weight_of_curvature_of_zero_is_taken_at_its_word() {
    let energy = |flags: &[&str]| {
        let words = [
            "parametrize",
            "shape:genus-2:1500",
            "--quads",
            "200",
            "--json",
        ];
        let (code, output) = finish(program(&[&words[..], flags].concat()));
        assert_eq!(code, 0, "{flags:?}");
        only_object(&output)["energy"].as_f64().unwrap()
    };
    let said = energy(&["--curvature-weight", "0"]);
    assert_eq!(said, energy(&["--constrain-curvature", "0.1"]));
    assert_ne!(said, energy(&[]));
}
