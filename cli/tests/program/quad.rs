//! `roundel quad` and `roundel extract`: what is told and written of quads.

use std::fs;
use std::path::Path;

use roundel::mesh::{TriangleMesh, io, shape};
use serde_json::{Value, json};

use crate::run::{Scratch, finish, only_object, program};

fn run(words: &[&str]) -> (i32, Value) {
    let (code, output) = finish(program(words));
    (code, only_object(&output))
}

fn text(path: &Path) -> &str {
    path.to_str().unwrap()
}

/// How many corners each face of an OBJ file has, at most one word for all of them.
fn sides(path: &Path) -> Vec<usize> {
    let content = fs::read_to_string(path).unwrap();
    let faces = content.lines().filter(|line| line.starts_with("f "));
    faces
        .map(|line| line.split_whitespace().count() - 1)
        .collect()
}

#[test]
fn a_shape_becomes_quads_of_its_topology() {
    let scratch = Scratch::new("quad-shape");
    let file = scratch.path("quads.obj");
    let words = ["quad", "shape:torus:1000", "--quads", "300", "--json", "-o"];
    let (code, report) = run(&[&words[..], &[text(&file)]].concat());
    assert_eq!(code, 0, "{report}");
    assert_eq!(report["conforming"], json!(true), "{report}");
    assert_eq!(report["euler_characteristic"], json!(0));
    assert_eq!(report["inverted"], json!(0));
    let quads = report["quads"].as_u64().unwrap();
    assert!((270..=330).contains(&quads), "{quads} quads for 300 asked");
    let sides = sides(&file);
    assert_eq!(sides.len() as u64, quads);
    assert!(sides.iter().all(|&n| n == 4));
}

#[test]
fn quads_are_drawn_and_their_distance_is_measured() {
    let scratch = Scratch::new("quad-picture");
    let picture = scratch.path("quads.png");
    let words = ["--picture-size", "64x48", "--picture", text(&picture)];
    let flags = ["--quads", "100", "--measure-distance", "--json"];
    let run = |shape| run(&[&["quad", shape][..], &words, &flags].concat());
    let (code, report) = run("shape:sphere:500");
    assert_eq!(code, 0, "{report}");
    let png = fs::read(&picture).unwrap();
    assert_eq!(&png[..8], b"\x89PNG\r\n\x1a\n");
    assert_eq!(
        (&png[16..20], &png[20..24]),
        (&[0, 0, 0, 64][..], &[0, 0, 0, 48][..])
    );
    // A quad with sides of 0.35 on a sphere of radius 1 is about 0.35^2 / 4 below it in its middle.
    let distance = &report["distance"];
    let largest = distance["largest"].as_f64().unwrap();
    assert!(largest > 0.01 && largest < 0.08, "{distance}");
    let diagonal = largest / distance["of_diagonal"].as_f64().unwrap();
    assert!((diagonal - 12f64.sqrt()).abs() < 0.1, "{diagonal}");
    let (_, flat) = run("shape:plane:500");
    assert!(
        flat["distance"]["largest"].as_f64().unwrap() < 1e-9,
        "{flat}"
    );
}

#[test]
fn where_few_quads_are_missing_a_strip_has_as_many() {
    let scratch = Scratch::new("quad-strip");
    let file = scratch.path("quads.obj");
    // A torus of 35 by 15 quads, of which 540 are asked for: one more strip has 15.
    let words = ["quad", "shape:torus:1000", "--quads", "540", "--json"];
    let report = |count| {
        let more = ["--count", count, "-o", text(&file)];
        let (code, report) = run(&[&words[..], &more].concat());
        assert_eq!(code, 0, "{report}");
        assert_eq!(report["conforming"], json!(true), "{report}");
        assert_eq!(report["irregular_vertices"], json!(0), "{report}");
        report["count"].clone()
    };
    let about = json!({"asked": 540, "found": 525, "maps": 0});
    assert_eq!(report("about"), about);
    let exact = json!({"asked": 540, "found": 540, "maps": 1});
    assert_eq!(report("exact"), exact);
    assert_eq!(sides(&file), vec![4; 540]);
}

#[test]
fn mirrored_quads_tell_their_planes_and_have_as_many_vertices_on_both_sides() {
    let scratch = Scratch::new("quad-mirror");
    let file = scratch.path("quads.obj");
    let words = ["quad", "shape:torus:1000", "--quads", "300", "--mirror"];
    let (code, report) = run(&[&words[..], &["-1,0,0,0", "--json", "-o", text(&file)]].concat());
    assert_eq!(code, 0, "{report}");
    assert_eq!(report["conforming"], json!(true), "{report}");
    assert_eq!(report["mirror"][0]["normal"], json!([-1.0, 0.0, 0.0]));
    let content = fs::read_to_string(&file).unwrap();
    let vertices = content.lines().filter_map(|line| line.strip_prefix("v "));
    let points = vertices.map(|line| line.split(' ').map(|x| x.parse().unwrap()).collect());
    let points: Vec<Vec<f64>> = points.collect();
    let has_image = |p: &Vec<f64>| points.contains(&vec![-p[0], p[1], p[2]]);
    assert!(points.iter().all(has_image));
    assert!(points.iter().any(|p| p[0] == 0.0));
    let refused = |plane| {
        let (code, output) = finish(program(&[&words[..], &[plane, "--json"]].concat()));
        let printed = [output.stdout, output.stderr].concat();
        (code, String::from_utf8(printed).unwrap())
    };
    let (code, printed) = refused("1,0,0,9");
    assert!(
        code == 1 && printed.contains("the mesh is not symmetric"),
        "{printed}"
    );
    let (code, printed) = refused("w");
    assert!(
        code == 2 && printed.contains("'w' is no mirror"),
        "{printed}"
    );
}

#[test]
fn maps_of_other_programs_are_extracted() {
    let scratch = Scratch::new("quad-extract");
    let (map, file) = (scratch.path("uv.obj"), scratch.path("quads.obj"));
    let made = ["parametrize", "shape:rounded-cube:1200", "--quads", "150"];
    let (code, _) = run(&[&made[..], &["--json", "-o", text(&map)]].concat());
    assert_eq!(code, 0);
    let (code, report) = run(&["extract", text(&map), "--json", "-o", text(&file)]);
    assert_eq!(code, 0, "{report}");
    assert_eq!(report["conforming"], json!(true), "{report}");
    assert_eq!(report["irregular_vertices"], json!(8));
    assert!(sides(&file).iter().all(|&n| n == 4));
}

#[test]
fn a_map_that_is_not_seamless_is_refused() {
    let scratch = Scratch::new("quad-refused");
    let square = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\nvt 0.3 0.7\n";
    let faces = "f 1/1 2/2 3/3\nf 1/1 3/5 4/4\n";
    let map = scratch.write("uv.obj", format!("{square}{faces}"));
    let (code, report) = run(&["extract", text(&map), "--json"]);
    assert_ne!(code, 0);
    assert_eq!(report["error"]["code"], json!("invalid_argument"));
}

#[test]
fn strategies_are_compared_on_the_same_two_problems() {
    // To meet a number of quads, integers may be others than the best of any problem.
    let words = ["quad", "shape:genus-2:800", "--quads", "200", "--json"];
    let (code, told) = run(&[
        &words[..],
        &["--count", "about"],
        &["--compare-strategies", "relax,direct,lattice"],
    ]
    .concat());
    assert_eq!(code, 0, "{told}");
    let compared = told["compared"].as_array().unwrap();
    let energy = |i: usize, problem: &str| compared[i][problem]["energy"].as_f64().unwrap();
    assert_eq!(compared.len(), 3);
    for (i, strategy) in ["relax", "direct", "lattice"].into_iter().enumerate() {
        assert_eq!(compared[i]["strategy"], json!(strategy));
    }
    for problem in ["field", "map"] {
        assert!(energy(0, problem) < energy(2, problem));
        assert!(energy(2, problem) <= energy(1, problem));
    }
    // What was taken is what lattice decoding finds.
    let taken = told["energy"].as_f64().unwrap();
    assert!((energy(2, "map") - taken).abs() < 1e-9 * taken, "{taken}");
}

#[test]
fn faults_are_told_by_number_on_one_line() {
    let scratch = Scratch::new("quad-faults");
    // One square of the grid that is folded over its diagonal: no quads, and a fold.
    let square = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 1 1\n";
    let map = scratch.write("uv.obj", format!("{square}f 1/1 2/2 3/3\nf 1/1 3/3 4/2\n"));
    let (code, told) = run(&["extract", text(&map), "--json"]);
    assert_eq!((code, &told["conforming"]), (0, &json!(false)), "{told}");
    assert_eq!(told["faults"]["folded_triangles"], json!([1]), "{told}");
    let (code, output) = finish(program(&["extract", text(&map), "--quiet"]));
    let stderr = String::from_utf8(output.stderr).unwrap();
    assert_eq!((code, stderr.lines().count()), (0, 1), "{stderr}");
    assert!(stderr.contains("triangles folded by the map 1"), "{stderr}");
}

/// A sphere with vertices that are pulled towards its centre: no map of few quads covers it.
#[test]
fn triangles_whose_quads_are_pairs_are_told() {
    let scratch = Scratch::new("quad-pairs");
    let sphere = shape::by_name("sphere", 80).unwrap();
    let points = sphere.vertices().iter().enumerate().map(|(v, p)| {
        let scale = if v * 7 % 5 < 2 { 0.1 } else { 1.0 };
        p.map(|x| scale * x)
    });
    let spikes = TriangleMesh::new(points.collect(), sphere.triangles().to_vec()).unwrap();
    let file = scratch.path("spikes.obj");
    io::write(&file, &spikes).unwrap();
    let words = ["quad", text(&file), "--quads", "100"];
    let (code, told) = run(&[&words[..], &["--json"]].concat());
    assert_eq!((code, &told["conforming"]), (0, &json!(true)), "{told}");
    assert_eq!(told["paired_faces"], json!(spikes.face_count()), "{told}");
    let (_, output) = finish(program(&words));
    let summary = String::from_utf8(output.stdout).unwrap();
    assert!(summary.contains("pairs      of 80 triangles"), "{summary}");
    let (_, told) = run(&["quad", "shape:sphere:80", "--quads", "100", "--json"]);
    assert_eq!(told["paired_faces"], json!(0), "{told}");
}
