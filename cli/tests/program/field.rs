//! `roundel field`: what is told of a field, what is written of it, and how it fails.

use std::collections::HashSet;
use std::fs;
use std::path::Path;

use roundel::mesh::{io, shape};
use serde_json::{Value, json};

use crate::run::{Scratch, finish, only_object, program, solve};

const CUBE: &str = "shape:rounded-cube:1200";

/// Runs `roundel field WORDS... --json`.
fn field(words: &[&str]) -> (i32, Value) {
    let (code, output) = finish(program(&[&["field"], words, &["--json"]].concat()));
    (code, only_object(&output))
}

fn number(report: &Value, key: &str) -> f64 {
    report[key].as_f64().unwrap_or_else(|| panic!("{key}"))
}

fn text(path: &Path) -> &str {
    path.to_str().unwrap()
}

/// The pixels of a PNG file: width, height, three bytes each.
fn decode(path: &Path) -> (u32, u32, Vec<u8>) {
    let file = std::io::BufReader::new(fs::File::open(path).unwrap());
    let mut reader = png::Decoder::new(file).read_info().unwrap();
    let mut pixels = vec![0; reader.output_buffer_size().unwrap()];
    let info = reader.next_frame(&mut pixels).unwrap();
    assert_eq!(info.color_type, png::ColorType::Rgb);
    (info.width, info.height, pixels)
}

#[test]
fn the_report_is_that_of_a_solve_and_of_the_mesh() {
    let (code, report) = field(&[CUBE]);
    assert_eq!(code, 0, "{report}");
    let scratch = Scratch::new("field-fields");
    let problem = scratch.path("problem.mps");
    field(&[CUBE, "--write-problem", text(&problem)]);
    let (_, output) = finish(solve(&problem, &["--json"]));
    for key in only_object(&output).as_object().unwrap().keys() {
        assert!(report.get(key).is_some(), "{key} is missing: {report}");
    }
    assert_eq!(report["file"], json!(CUBE));
    assert_eq!(report["faces"], json!(1200));
    assert_eq!(report["vertices"], json!(602));
    assert_eq!(report["euler_characteristic"], json!(2));
    assert_eq!(report["index_sum"], json!(2.0));
    let seconds = &report["seconds"];
    let phases = ["read", "assemble", "eliminate", "factor", "round"];
    let sum: f64 = phases.iter().map(|k| number(seconds, k)).sum();
    assert!(number(seconds, "total") >= sum - 1e-9, "{seconds}");
}

#[test]
fn the_rounded_cube_has_its_eight_corners_irregular() {
    for mesh in ["shape:rounded-cube:3000", "shape:rounded-cube"] {
        let (_, report) = field(&[mesh]);
        assert_eq!(report["irregular_vertices"], json!(8), "{report}");
        assert_eq!(report["index_counts"], json!({"1": 8}), "{report}");
        assert_eq!(report["index_sum"], json!(2.0));
    }
}

#[test]
fn the_problem_written_is_the_problem_solved() {
    let scratch = Scratch::new("field-problem");
    for name in ["problem.mps", "problem.mps.gz"] {
        let problem = scratch.path(name);
        let words = ["shape:genus-2:600", "--write-problem", text(&problem)];
        let (_, report) = field(&words);
        let (code, output) = finish(solve(&problem, &["--json"]));
        let again = only_object(&output);
        assert_eq!(code, 0, "{again}");
        assert_eq!(again["integers"], report["integers"]);
        let [a, b] = [&report, &again].map(|r| number(r, "energy"));
        assert!((a - b).abs() <= 1e-7 * a, "{a} {b}");
    }
}

#[test]
fn a_file_gives_the_field_of_its_shape() {
    let scratch = Scratch::new("field-file");
    let mesh = shape::by_name("torus", 800).unwrap();
    let expected = number(&field(&["shape:torus:800"]).1, "energy");
    for name in ["torus.obj", "torus.off", "torus.ply"] {
        let file = scratch.path(name);
        io::write(&file, &mesh).unwrap();
        let (code, report) = field(&[text(&file)]);
        assert_eq!((code, &report["file"]), (0, &json!(text(&file))));
        assert_eq!(number(&report, "energy"), expected, "{name}");
    }
}

#[test]
fn directions_that_are_given_come_before_curvature() {
    let flat = [
        "shape:plane:200",
        "--free-boundary",
        "--constrain-curvature",
        "0",
    ];
    let one = field(&[&flat[..], &["--fix", "3:30"]].concat()).1;
    assert!(number(&one, "energy").abs() < 1e-12, "{one}");
    let two = field(&[&flat[..], &["--fix", "3:30", "--fix", "150:0"]].concat()).1;
    assert!(number(&two, "energy") > 1e-3, "{two}");
    // Every face has a direction by curvature; that of one is another.
    let all = ["--constrain-curvature", "1"];
    let (code, report) = field(&[&[CUBE, "--fix", "0:10"], &all[..]].concat());
    assert_eq!((code, &report["integers"]), (0, &json!(0)), "{report}");
}

#[test]
fn the_model_opens_with_the_mesh_and_more_in_it() {
    let scratch = Scratch::new("field-model");
    for name in ["field.ply", "field.obj"] {
        let out = scratch.path(name);
        let (code, report) = field(&[CUBE, "-o", text(&out)]);
        assert_eq!(code, 0, "{report}");
        let bytes = fs::read(&out).unwrap();
        let model = io::parse(&bytes, io::Format::of(&out).unwrap()).unwrap();
        let (faces, components) = (model.face_count(), model.components().count);
        // A cross a face of two triangles of a square and four arms; each is a piece of its own.
        assert!(faces > 1200 + 6 * 1200, "{faces}");
        assert!(components > 1200, "{components}");
        if name.ends_with("ply") {
            let header = String::from_utf8_lossy(&bytes[..400]);
            for channel in ["red", "green", "blue"] {
                assert!(header.contains(&format!(" {channel}\n")), "{header}");
            }
        }
    }
}

#[test]
fn the_picture_shows_surface_lines_and_red_corners_on_white() {
    let scratch = Scratch::new("field-picture");
    let out = scratch.path("field.png");
    field(&[CUBE, "--picture", text(&out), "--picture-size", "400x300"]);
    let (width, height, pixels) = decode(&out);
    assert_eq!((width, height), (400, 300));
    let pixels = pixels.as_chunks::<3>().0;
    let colors: HashSet<_> = pixels.iter().collect();
    assert!(colors.len() > 1000, "{}", colors.len());
    let count = |is: &dyn Fn(&[u8; 3]) -> bool| pixels.iter().filter(|p| is(p)).count();
    let white = count(&|p| *p == [255; 3]);
    assert!((20_000..100_000).contains(&white), "{white}");
    let red = count(&|[r, g, b]| *r > 150 && *g < 90 && *b < 90);
    assert!(red > 50, "{red}");
    let blue = count(&|[r, _, b]| *b > *r && *b - *r > 20);
    assert!(blue > 500, "{blue}");
}

#[test]
fn the_picture_is_the_same_every_time() {
    let scratch = Scratch::new("field-same");
    let draw = |name: &str| {
        let out = scratch.path(name);
        let words = ["shape:gear:3000", "--picture", text(&out)];
        let (code, report) = field(&[&words[..], &["--picture-size", "320x240"]].concat());
        assert_eq!(code, 0, "{report}");
        fs::read(out).unwrap()
    };
    assert!(draw("a.png") == draw("b.png"));
}

#[test]
fn a_mesh_that_is_refused_as_it_stands_is_an_error_that_names_the_element() {
    let scratch = Scratch::new("field-broken");
    let broken = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 2 3\nf 1 2 4\n";
    let flat = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 2 0 0\nf 1 2 3\nf 1 2 4\n";
    let quad = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3 4\n";
    for (name, content, code, index) in [
        ("broken.obj", broken, "inconsistent_orientation", json!(0)),
        ("flat.obj", flat, "zero_area", json!(1)),
        ("quad.obj", quad, "not_a_triangle", json!(0)),
        ("empty.obj", "", "no_faces", Value::Null),
        ("mesh.3mf", "", "unknown_format", Value::Null),
    ] {
        let file = scratch.write(name, content);
        let (exit, report) = field(&[text(&file), "--strict"]);
        assert_eq!((exit, &report["status"]), (1, &json!("error")));
        assert_eq!(report["error"]["code"], json!(code), "{report}");
        assert_eq!(report["error"]["index"], index, "{report}");
    }
    for (mesh, code) in [
        ("no-such-file.obj", "io"),
        ("shape:teapot", "unknown_shape"),
        ("shape:torus:many", "invalid_argument"),
    ] {
        let (exit, report) = field(&[mesh]);
        assert_eq!((exit, &report["error"]["code"]), (1, &json!(code)));
    }
}

#[test]
fn faces_that_there_are_not_and_faces_given_twice_are_errors() {
    for (fixes, code, index) in [
        (["0:5", "1200:5"], "index_out_of_range", 1),
        (["7:5", "7:6"], "invalid_argument", 1),
    ] {
        let (exit, report) = field(&[CUBE, "--fix", fixes[0], "--fix", fixes[1]]);
        assert_eq!((exit, &report["error"]["code"]), (1, &json!(code)));
        assert_eq!(report["error"]["index"], json!(index), "{report}");
    }
}

#[test]
fn a_wrong_command_line_is_a_usage_error() {
    for flags in [
        ["--fix", "7"],
        ["--fix", "-1:0"],
        ["--fix", "7:nan"],
        ["--constrain-curvature", "1.5"],
        ["--constrain-curvature", "-0.5"],
        ["--picture-size", "0x10"],
        ["--picture-from", "1,2"],
        ["--strategy", "guess"],
    ] {
        let (code, output) = finish(program(&["field", CUBE, flags[0], flags[1]]));
        assert_eq!((code, output.stdout.len()), (2, 0), "{flags:?}");
    }
}

#[test]
fn files_that_cannot_be_written_are_errors_that_name_them() {
    for flag in ["-o", "--picture", "--write-problem"] {
        let (code, report) = field(&[CUBE, flag, "no-such-folder/out.ply"]);
        assert_eq!((code, &report["error"]["code"]), (1, &json!("io")));
        let message = report["error"]["message"].as_str().unwrap();
        assert!(message.contains("no-such-folder/out.ply"), "{message}");
    }
}

#[test]
fn the_summary_tells_faces_energy_and_irregular_vertices() {
    let (code, output) = finish(program(&["field", "shape:rounded-cube:3000"]));
    let text = String::from_utf8(output.stdout).unwrap();
    assert_eq!((code, text.lines().count()), (0, 4), "{text}");
    for (line, word) in text.lines().zip(["read", "assemble", "auto", "field"]) {
        assert!(line.starts_with(word), "{line}");
    }
    assert!(text.contains("8 irregular vertices"), "{text}");
}

#[test]
fn a_failed_solve_leaves_no_files() {
    let scratch = Scratch::new("field-no-files");
    let (model, picture) = (scratch.path("a.ply"), scratch.path("a.png"));
    let words = [CUBE, "-o", text(&model), "--picture", text(&picture)];
    let (code, _) = field(&[&words[..], &["--time-limit", "0"]].concat());
    assert_eq!(code, 5);
    assert!(!model.exists() && !picture.exists());
}

#[test]
fn the_field_written_as_text_is_a_direction_in_every_face() {
    let scratch = Scratch::new("field-text");
    let out = scratch.path("field.txt");
    let (code, report) = field(&[CUBE, "-o", text(&out)]);
    assert_eq!(code, 0, "{report}");
    let mesh = shape::by_name("rounded-cube", 1200).unwrap();
    let content = fs::read_to_string(&out).unwrap();
    let lines: Vec<&str> = content.lines().filter(|l| !l.starts_with("jump")).collect();
    assert_eq!(lines.len(), mesh.face_count());
    for (face, line) in lines.into_iter().enumerate() {
        let numbers: Vec<f64> = line.split(' ').map(|w| w.parse().unwrap()).collect();
        let along = |v: [f64; 3]| (0..3).map(|i| v[i] * numbers[i]).sum::<f64>();
        let length: f64 = numbers.iter().map(|x| x * x).sum();
        assert!((length - 1.0).abs() < 1e-12 && along(mesh.normal(face)).abs() < 1e-12);
    }
}

#[test]
fn fields_of_every_symmetry_sum_to_the_euler_characteristic() {
    let scratch = Scratch::new("field-symmetry");
    for symmetry in ["1", "2", "6"] {
        let file = scratch.path("field.txt");
        let words = ["shape:disk:300", "--symmetry", symmetry, "-o"];
        let (code, report) = field(&[&words[..], &[file.to_str().unwrap()]].concat());
        assert_eq!(code, 0, "{report}");
        assert_eq!(report["symmetry"].to_string(), symmetry);
        assert_eq!(report["index_sum"], json!(1.0));
        // Only a single direction has no side of the boundary to lie along.
        assert_eq!(report["feature_edges"].as_u64() > Some(0), symmetry != "1");
    }
    let words = [
        "shape:disk:300",
        "--symmetry",
        "6",
        "--picture",
        "never.png",
    ];
    assert_eq!(field(&words).0, 1);
    assert!(!std::path::Path::new("never.png").exists());
    let output = finish(program(&["field", "shape:disk", "--symmetry", "3"]));
    assert_eq!(output.0, 2);
}

#[test]
fn all_irregular_vertices_can_be_given() {
    let scratch = Scratch::new("field-indices");
    let guide = scratch.write("guide.txt", "index 0 5\nindex 9 3\n");
    let words = ["shape:sphere:400", "--guide", guide.to_str().unwrap()];
    let (code, report) = field(&words);
    assert_eq!(code, 0, "{report}");
    assert_eq!(report["irregular_vertices"].as_u64(), Some(2), "{report}");
    assert_eq!(report["index_counts"], json!({"3": 1, "5": 1}), "{report}");
    let guide = scratch.write("guide.txt", "index 0 5\n");
    let words = ["shape:sphere:400", "--guide", guide.to_str().unwrap()];
    let (code, report) = field(&words);
    assert_eq!(code, 1);
    assert_eq!(report["error"]["code"].as_str(), Some("invalid_argument"));
}
