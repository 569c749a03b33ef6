//! `roundel quad` and `roundel extract`: what is told and written of quads, and the page.

use std::fs;
use std::path::Path;
use std::process::Command;

use serde_json::{Value, json};

use crate::run::{Scratch, finish, only_object, program};
use crate::skip::skip_unless_ci;

const GEAR: &str = "shape:gear:2000";

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

/// The page of a gear and what was told of it.
fn report(scratch: &Scratch) -> (std::path::PathBuf, Value) {
    let page = scratch.path("report.html");
    let words = ["quad", GEAR, "--quads", "400", "--features", "40", "--json"];
    let more = ["--compare-strategies", "direct,relax", "--report"];
    let (code, told) = run(&[&words[..], &more, &[text(&page)]].concat());
    assert_eq!(code, 0, "{told}");
    (page, told)
}

#[test]
fn the_page_holds_its_numbers_and_asks_for_nothing_else() {
    let scratch = Scratch::new("quad-page");
    let (page, told) = report(&scratch);
    let content = fs::read_to_string(page).unwrap();
    for word in ["http:", "https:", "src=", "<link", "import ", "fetch("] {
        assert!(!content.contains(word), "{word}");
    }
    let count = |key: &str| told[key].as_u64().unwrap();
    assert!(content.contains(&format!("{} quads, ", count("quads"))));
    let energy = told["energy"].as_f64().unwrap();
    assert!(content.contains(&format!("{energy:.6}")), "{energy}");
    let data = content.split("application/json\">").nth(1).unwrap();
    let data: Value = serde_json::from_str(data.split("</script>").next().unwrap()).unwrap();
    let length = |key: &str| data[key].as_array().unwrap().len() as u64;
    assert_eq!(length("faces"), count("faces"));
    assert_eq!(length("uvs"), count("faces"));
    assert_eq!(length("quads"), count("quads"));
    assert_eq!(length("quad_vertices"), count("vertices"));
    assert_eq!(length("irregular"), count("field_irregular_vertices"));
    // Pairs of a vertex and an integer of quarters, which the script compares.
    let irregular = data["irregular"].as_array().unwrap().iter();
    let quarters = irregular.map(|pair| pair[1].as_i64().unwrap());
    assert_eq!(quarters.clone().sum::<i64>(), 0);
    assert!(quarters.into_iter().all(|k| k.abs() == 1));
    assert!(content.contains("quarters === 1 ?") && content.contains("quarters === -1 ?"));
}

/// Says so where there is no chromium.
#[test]
fn a_browser_draws_the_page() {
    if Command::new("chromium").arg("--version").output().is_err() {
        return skip_unless_ci("chromium is not installed: the page is not drawn");
    }
    let scratch = Scratch::new("quad-browser");
    let (page, told) = report(&scratch);
    let picture = scratch.path("page.png");
    let browse = |what: &str| {
        let mut command = Command::new("chromium");
        command.args(["--headless", "--no-sandbox", "--disable-dev-shm-usage"]);
        command.args(["--use-angle=swiftshader", "--enable-unsafe-swiftshader"]);
        command.args([
            "--host-resolver-rules=MAP * ~NOTFOUND",
            "--window-size=1400,900",
        ]);
        command.arg(format!(
            "--user-data-dir={}",
            text(&scratch.path("profile"))
        ));
        command.args(["--virtual-time-budget=5000", what]);
        command.arg(format!("file://{}", text(&page)));
        command.output().unwrap()
    };
    // The script sets the mark at its very end: nothing has thrown.
    let dom = String::from_utf8(browse("--dump-dom").stdout).unwrap();
    assert!(dom.contains("data-drawn=\"yes\""));
    for one in told["compared"].as_array().unwrap() {
        for problem in ["field", "map"] {
            let energy = one[problem]["energy"].as_f64().unwrap();
            let cells = format!("<td>{energy:.6}</td>");
            assert!(dom.contains(&cells), "{problem} {cells}");
        }
    }
    browse(&format!("--screenshot={}", text(&picture)));
    let file = std::io::BufReader::new(fs::File::open(&picture).unwrap());
    let mut reader = png::Decoder::new(file).read_info().unwrap();
    let mut pixels = vec![0; reader.output_buffer_size().unwrap()];
    let info = reader.next_frame(&mut pixels).unwrap();
    let samples = info.color_type.samples();
    let [width, height] = [info.width as usize, info.height as usize];
    // The thirds of the page's upper half, where the three views are.
    for third in 0..3 {
        let mut colours = std::collections::BTreeSet::new();
        for y in height / 8..height / 2 {
            for x in (third * width / 3)..((third + 1) * width / 3) {
                let at = samples * (y * width + x);
                colours.insert([pixels[at], pixels[at + 1], pixels[at + 2]]);
            }
        }
        assert!(
            colours.len() > 100,
            "view {third}: {} colours",
            colours.len()
        );
    }
}

#[test]
fn strategies_are_compared_on_the_same_two_problems() {
    let words = ["quad", "shape:genus-2:800", "--quads", "200", "--json"];
    let (code, told) = run(&[
        &words[..],
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
