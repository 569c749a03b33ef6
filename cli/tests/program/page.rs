//! The page of a run: what it holds, and what a browser makes of it.

use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

use serde_json::{Value, json};

use crate::layout::cube_around_the_origin;
use crate::run::{Scratch, finish, only_object, program};
use crate::skip::skip_unless_ci;

/// The page of a run, what was told, and the quads that were written.
struct Made {
    page: PathBuf,
    told: Value,
    quads: PathBuf,
}

fn make(scratch: &Scratch, words: &[&str]) -> Made {
    let [page, quads] = ["report.html", "quads.obj"].map(|name| scratch.path(name));
    let files = [
        "--json",
        "-o",
        quads.to_str().unwrap(),
        "--report",
        page.to_str().unwrap(),
    ];
    let (code, output) = finish(program(&[&["quad"], words, &files].concat()));
    let told = only_object(&output);
    assert_eq!(code, 0, "{told}");
    Made { page, told, quads }
}

fn gear(scratch: &Scratch) -> Made {
    let words = ["shape:gear:4000", "--quads", "800", "--features", "40"];
    make(
        scratch,
        &[&words[..], &["--compare-strategies", "direct,relax"]].concat(),
    )
}

/// The JSON that the page draws.
fn data(content: &str) -> Value {
    let data = content.split("application/json\">").nth(1).unwrap();
    serde_json::from_str(data.split("</script>").next().unwrap()).unwrap()
}

#[test]
fn a_page_holds_its_figures_and_asks_for_nothing_else() {
    let scratch = Scratch::new("page-figures");
    let Made { page, told, .. } = gear(&scratch);
    let content = fs::read_to_string(page).unwrap();
    for word in ["http:", "https:", "src=", "<link", "import ", "fetch("] {
        assert!(!content.contains(word), "{word}");
    }
    assert!(content.contains("default-src 'none'"));
    let count = |key: &str| told[key].as_u64().unwrap();
    assert!(content.contains(&format!("<p>{} quads, ", count("quads"))));
    let energy = told["energy"].as_f64().unwrap();
    assert!(
        content.contains(&format!("<td>{energy:.6}</td>")),
        "{energy}"
    );
    assert!(content.contains("<td>triangles</td><td>4,032</td>"));
    assert!(content.contains("<code>roundel quad shape:gear:4000 --quads 800 "));
    assert!(content.contains(&format!("Roundel {}", env!("CARGO_PKG_VERSION"))));
    for one in told["compared"].as_array().unwrap() {
        for problem in ["field", "map"] {
            let energy = one[problem]["energy"].as_f64().unwrap();
            assert!(content.contains(&format!("<td>{energy:.6}</td>")));
        }
    }
    let data = data(&content);
    let irregular = data["field"]["irregular"].as_array().unwrap();
    assert_eq!(irregular.len() as u64, count("field_irregular_vertices"));
    assert_eq!(irregular.len(), 96);
    // Integers of quarters; a torus has as many of either sign.
    let quarters = irregular.iter().map(|pair| pair[1].as_i64().unwrap());
    assert_eq!(quarters.sum::<i64>(), 0);
}

#[test]
fn a_page_of_50_000_triangles_is_below_a_megabyte_and_a_half() {
    let scratch = Scratch::new("page-size");
    let Made { page, told, .. } = make(&scratch, &["shape:torus:50400", "--quads", "5000"]);
    assert!(told["faces"].as_u64().unwrap() >= 50_000, "{told}");
    let size = fs::metadata(page).unwrap().len();
    assert!(size < 1_500_000, "{size} bytes");
}

#[test]
fn a_page_shows_what_repair_changed() {
    let scratch = Scratch::new("page-repair");
    let sphere = scratch.path("sphere.obj");
    let made = [
        "shape",
        "sphere",
        "--triangles",
        "600",
        "-o",
        sphere.to_str().unwrap(),
    ];
    assert_eq!(finish(program(&made)).0, 0);
    let mut text = fs::read_to_string(&sphere).unwrap();
    // The first triangle the other way round, and the second once more.
    let faces: Vec<&str> = text.lines().filter(|line| line.starts_with("f ")).collect();
    let corners: Vec<&str> = faces[0].split(' ').collect();
    let turned = format!("f {} {} {}", corners[1], corners[3], corners[2]);
    let again = format!("{}\n", faces[1]);
    text = text.replacen(faces[0], &turned, 1) + &again;
    fs::write(&sphere, text).unwrap();
    let Made { page, .. } = make(&scratch, &[sphere.to_str().unwrap(), "--quads", "100"]);
    let changes = data(&fs::read_to_string(page).unwrap())["changes"].clone();
    let names = changes
        .as_array()
        .unwrap()
        .iter()
        .map(|change| &change["name"]);
    let names: Vec<&Value> = names.collect();
    assert_eq!(names, ["dropped 1 duplicate", "turned 1 polygon"]);
    // The first and the second triangle, as u16 in base64.
    assert_eq!(changes[0]["triangles"]["data"], "AQA=");
    assert_eq!(changes[1]["triangles"]["data"], "AAA=");
}

/// A window of a browser.
pub struct Window {
    pub width: u32,
    pub is_dark: bool,
}

/// The document that a browser makes of a page, and what it complains of; none where there is no browser.
fn drawn(scratch: &Scratch, page: &Path, window: &Window) -> Option<(String, String)> {
    if Command::new("chromium").arg("--version").output().is_err() {
        skip_unless_ci("chromium is not installed: the page is not drawn");
        return None;
    }
    let mut command = Command::new("chromium");
    command.args(["--headless", "--no-sandbox", "--disable-dev-shm-usage"]);
    command.args(["--use-angle=swiftshader", "--enable-unsafe-swiftshader"]);
    command.args(["--host-resolver-rules=MAP * ~NOTFOUND", "--hide-scrollbars"]);
    // A browser's window is at least 500 wide; the checks make the page as narrow as it is to be.
    command.arg(format!("--window-size={},900", window.width));
    let scheme = if window.is_dark { 0 } else { 1 };
    command.arg(format!("--blink-settings=preferredColorScheme={scheme}"));
    let profile = scratch.path("profile");
    command.arg(format!("--user-data-dir={}", profile.display()));
    command.args(["--virtual-time-budget=5000", "--dump-dom"]);
    command.arg(format!("file://{}#{}", page.display(), window.width));
    let output = command.output().unwrap();
    let errors = String::from_utf8_lossy(&output.stderr).into_owned();
    Some((String::from_utf8(output.stdout).unwrap(), errors))
}

/// What the checks of the page of a run find in a window of a browser.
fn found(scratch: &Scratch, page: &Path, window: &Window) -> Option<Value> {
    found_by(include_str!("page_checks.js"), scratch, page, window)
}

/// What a script finds in a page, and leaves in an element with the id `found`; none where there is no browser.
pub fn found_by(checks: &str, scratch: &Scratch, page: &Path, window: &Window) -> Option<Value> {
    let script = format!("<script type=\"module\">{checks}</script></body>");
    let content = fs::read_to_string(page).unwrap();
    let checked = scratch.path("checked.html");
    fs::write(&checked, content.replacen("</body>", &script, 1)).unwrap();
    let (dom, errors) = drawn(scratch, &checked, window)?;
    let found = dom.split("<pre id=\"found\">").nth(1);
    let found = found.unwrap_or_else(|| panic!("the checks ended early: {errors}"));
    let found = found.split("</pre>").next().unwrap();
    let found = found
        .replace("&lt;", "<")
        .replace("&gt;", ">")
        .replace("&amp;", "&");
    Some(serde_json::from_str(&found).unwrap())
}

/// Numbers and words of a list of pairs.
fn pairs(list: &Value) -> Vec<(u64, Value)> {
    let pair = |pair: &Value| (pair[0].as_u64().unwrap(), pair[1].clone());
    list.as_array().unwrap().iter().map(pair).collect()
}

fn hue(steps: i64) -> &'static str {
    match steps {
        1 => "red",
        -1 => "blue",
        _ => "other",
    }
}

/// The irregular vertices of a closed mesh of quads in an OBJ file, and the steps of their index.
fn irregular_of(file: &Path) -> BTreeMap<u64, i64> {
    let text = fs::read_to_string(file).unwrap();
    let mut quads_at = BTreeMap::new();
    for face in text.lines().filter_map(|line| line.strip_prefix("f ")) {
        for corner in face.split(' ') {
            *quads_at
                .entry(corner.parse::<u64>().unwrap() - 1)
                .or_insert(0) += 1;
        }
    }
    let steps = quads_at.into_iter().map(|(v, quads)| (v, 4 - quads));
    steps.filter(|&(_, steps)| steps != 0).collect()
}

#[test]
fn a_browser_draws_layers_and_picks_elements_and_colours_every_irregular_vertex() {
    let scratch = Scratch::new("page-browser");
    let Made { page, told, quads } = gear(&scratch);
    let window = Window {
        width: 1400,
        is_dark: false,
    };
    let Some(found) = found(&scratch, &page, &window) else {
        return;
    };
    has_layers(&found);
    has_colours(&found, &quads);
    picks(&found);
    has_measures(&found, &told);
    saves(&found, &quads);
}

fn has_layers(found: &Value) {
    assert_eq!(found["layers"]["nothing"], 0);
    let drawn = found["layers"]["drawn"].as_object().unwrap();
    for name in [
        "input",
        "triangles",
        "features",
        "field",
        "irregular",
        "integers",
        "quads",
        "poles",
    ] {
        let pixels = drawn[&format!("layer-{name}")].as_u64().unwrap();
        assert!(pixels > 2_000, "{name}: {pixels} pixels");
    }
    assert_eq!(drawn.len(), 8);
    let reset = &found["reset"];
    assert!(reset["turned"].as_u64() > Some(10_000), "{reset}");
    assert!(reset["wireframe"].as_u64() > Some(10_000), "{reset}");
    assert_eq!(reset["left"], 0);
}

fn has_colours(found: &Value, quads: &Path) {
    let of_field = pairs(&found["irregular"]);
    let hues = pairs(&found["hues"]);
    assert_eq!((of_field.len(), hues.len()), (96, 96));
    for ((v, steps), (w, seen)) in of_field.iter().zip(&hues) {
        assert_eq!(
            (v, seen),
            (w, &json!(hue(steps.as_i64().unwrap()))),
            "{steps}"
        );
    }
    let of_quads = irregular_of(quads);
    let hues = pairs(&found["poleHues"]);
    assert_eq!((of_quads.len(), hues.len()), (96, 96));
    for (v, seen) in hues {
        assert_eq!(seen, hue(of_quads[&v]), "vertex {v} of the quads");
    }
    for legend in found["legends"].as_array().unwrap() {
        assert_eq!(legend, "+1/4: 48−1/4: 48");
    }
}

fn picks(found: &Value) {
    for (kind, title, count) in [
        ("quads", "Quad", 12),
        ("triangles", "Triangle", 12),
        ("vertices", "Vertex of triangles", 96),
    ] {
        let picks = found[kind].as_array().unwrap();
        assert_eq!(picks.len(), count);
        for pick in picks {
            assert_eq!(pick["before"], "Click an element of the mesh.");
            let number = pick["number"].to_string();
            assert_eq!(pick["rows"][0], json!([title, number]), "{pick}");
        }
    }
    let rows = found["quads"][0]["rows"].as_array().unwrap();
    let value = |name: &str| {
        let row = rows.iter().find(|row| row[0] == name);
        row.unwrap_or_else(|| panic!("{name}"))[1].as_str().unwrap()
    };
    let jacobian: f64 = value("Scaled Jacobian").parse().unwrap();
    assert!(jacobian > 0.5 && jacobian <= 1.0);
    let angles = value("Angles")
        .split(", ")
        .map(|angle| angle.trim_end_matches('°'));
    let sum: f64 = angles.map(|angle| angle.parse::<f64>().unwrap()).sum();
    assert!((sum - 360.0).abs() < 3.0, "{sum}");
}

fn has_measures(found: &Value, told: &Value) {
    let measures = found["measures"].as_array().unwrap();
    let jacobian = told["scaled_jacobian_min"].as_f64().unwrap();
    let least = format!("least {jacobian:.3}, ");
    assert!(
        measures[0]["statistics"]
            .as_str()
            .unwrap()
            .starts_with(&least),
        "{least}"
    );
    // A bar for every quad, and other colours for another measure.
    for measure in &measures[..4] {
        assert_eq!(measure["counted"], told["quads"], "{measure}");
        assert!(measure["changed"].as_u64() > Some(1_000), "{measure}");
    }
}

fn saves(found: &Value, quads: &Path) {
    let saved = &found["downloads"];
    assert_eq!(
        saved["names"],
        json!(["gear-4000-quads.obj", "gear-4000.png"])
    );
    assert_eq!(
        (&saved["png"], &saved["finer"]),
        (&json!("PNG"), &json!([2, 2]))
    );
    let numbers = |text: &str| -> Vec<(String, Vec<f64>)> {
        let line = |line: &str| {
            let mut words = line.split(' ');
            let kind = words.next().unwrap().to_owned();
            (kind, words.map(|word| word.parse().unwrap()).collect())
        };
        text.lines().map(line).collect()
    };
    let written = fs::read_to_string(quads).unwrap();
    assert!(numbers(saved["obj"].as_str().unwrap()) == numbers(&written));
}

#[test]
fn a_page_fits_a_telephone_in_the_dark() {
    let scratch = Scratch::new("page-narrow");
    let words = ["shape:gear:2000", "--quads", "400", "--features", "40"];
    let Made { page, .. } = make(&scratch, &words);
    let windows = [
        (390, true, "rgb(17, 20, 23)"),
        (1400, false, "rgb(251, 251, 249)"),
    ];
    for (width, is_dark, background) in windows {
        let Some(found) = found(&scratch, &page, &Window { width, is_dark }) else {
            return;
        };
        assert_eq!(found["fits"], true);
        assert_eq!(found["dark"], is_dark);
        assert_eq!(found["background"], background);
        assert!(found["layers"]["drawn"]["layer-quads"].as_u64() > Some(10_000));
    }
}

#[test]
fn fields_and_maps_have_pages_of_what_they_have() {
    let scratch = Scratch::new("page-others");
    let page = scratch.path("report.html");
    let field = ["field", "shape:sphere:800", "--symmetry", "6"];
    let map = ["parametrize", "shape:rounded-cube:1200", "--quads", "150"];
    let cases = [
        (
            &field[..],
            "12 irregular vertices",
            ["triangles", "field", "irregular"],
            ["integers", "quads"],
        ),
        (
            &map[..],
            "8 irregular vertices",
            ["field", "irregular", "integers"],
            ["quads", "poles"],
        ),
    ];
    for (words, summary, layers, others) in cases {
        let (code, _) = finish(program(
            &[words, &["--report", page.to_str().unwrap()]].concat(),
        ));
        assert_eq!(code, 0, "{words:?}");
        let content = fs::read_to_string(&page).unwrap();
        assert!(content.contains(&format!("<p>{summary}")), "{words:?}");
        assert!(content.contains(&format!("<code>roundel {} {} ", words[0], words[1])));
        let window = Window {
            width: 1400,
            is_dark: false,
        };
        let Some((dom, errors)) = drawn(&scratch, &page, &window) else {
            return;
        };
        // The script sets the mark at its very end: nothing has thrown.
        assert!(dom.contains("data-drawn=\"yes\""), "{errors}");
        let has = |layer: &str| dom.contains(&format!("id=\"layer-{layer}\""));
        assert!(
            layers.into_iter().all(has) && !others.into_iter().any(has),
            "{words:?}"
        );
    }
}

#[test]
fn layouts_have_pages_with_patches_in_colours_and_numbers_along_arcs() {
    let scratch = Scratch::new("page-layout");
    let cube = scratch.write("cube.obj", cube_around_the_origin());
    let quads = scratch.path("quads.obj");
    let page = scratch.path("report.html");
    let [cube, quads, report] = [&cube, &quads, &page].map(|path| path.to_str().unwrap());
    let along = ["shape:sphere:600", "--layout", cube, "--quads", "600"];
    let along = [&along[..], &["-o", quads]].concat();
    let back = ["--of", quads, "--force"];
    for words in [&along[..], &back[..]] {
        let words = [&["layout", "--json", "--report", report], words].concat();
        let (code, output) = finish(program(&words));
        assert_eq!(code, 0, "{words:?}: {output:?}");
        let content = fs::read_to_string(&page).unwrap();
        assert!(content.contains("<p>600 quads, 8 irregular, watertight</p>"));
        assert!(content.contains("<td>10</td><td>12</td>"), "{words:?}");
        let layout = data(&content)["layout"].clone();
        // Twelve arcs of ten edges, as u16 in base64.
        let ten = "CgAKAAoA".repeat(4);
        assert_eq!(layout["edges"]["data"], ten, "{words:?}");
        let window = Window {
            width: 1400,
            is_dark: false,
        };
        let Some(found) = found(&scratch, &page, &window) else {
            return;
        };
        let drawn = &found["layers"]["drawn"];
        assert!(drawn["layer-arcs"].as_u64() > Some(2_000), "{drawn}");
        assert!(drawn["layer-numbers"].as_u64() > Some(200), "{drawn}");
        let patches: Vec<&Value> = found["quads"].as_array().unwrap().iter().collect();
        let patch = |pick: &&Value| pick["rows"][2][1].as_str().unwrap().to_owned();
        let patches: std::collections::BTreeSet<String> = patches.iter().map(patch).collect();
        assert!(patches.len() > 4, "{patches:?}");
    }
}

#[test]
fn guide_curves_are_a_layer_of_fields_maps_and_quads() {
    let scratch = Scratch::new("page-guides");
    let square = "v 1 0 0.03\nv 0 1 0.03\nv -1 0 0.03\nv 0 -1 0.03\nl 1 2 3 4 1\n";
    let (lines, page) = (
        scratch.write("square.obj", square),
        scratch.path("report.html"),
    );
    let with_page = [
        "shape:sphere:800",
        "--guide-curves",
        lines.to_str().unwrap(),
        "--force",
        "--report",
        page.to_str().unwrap(),
    ];
    for words in [
        &["field"][..],
        &["parametrize", "--quads", "150"],
        &["quad", "--quads", "150"],
    ] {
        let (code, output) = finish(program(&[words, &with_page].concat()));
        assert_eq!(code, 0, "{words:?}: {output:?}");
        let guides = &data(&fs::read_to_string(&page).unwrap())["guides"];
        assert!(guides["positions"]["data"].as_str().unwrap().len() > 1_000);
    }
    let window = Window {
        width: 1400,
        is_dark: false,
    };
    // Of the quads, which are last.
    if let Some(found) = found(&scratch, &page, &window) {
        let drawn = &found["layers"]["drawn"];
        assert!(drawn["layer-guides"].as_u64() > Some(500), "{drawn}");
    }
}

#[test]
fn a_browser_without_webgl_is_told_so_and_shows_the_figures() {
    let scratch = Scratch::new("page-without-webgl");
    let Made { page, .. } = make(&scratch, &["shape:rounded-cube:600", "--quads", "100"]);
    let content = fs::read_to_string(&page).unwrap();
    let without = "<body><script>HTMLCanvasElement.prototype.getContext = () => null</script>";
    let parts = "['#view', 'aside', '.bar', '#failure', '.figures']";
    let after = format!(
        "<script>addEventListener('load', () => {{ document.body.dataset.seen = {parts}\
        .map((one) => document.querySelector(one).getClientRects().length).join(' ') }})</script></body>"
    );
    let content = content.replacen("<body>", without, 1);
    fs::write(&page, content.replacen("</body>", &after, 1)).unwrap();
    let window = Window {
        width: 1400,
        is_dark: false,
    };
    let Some((dom, errors)) = drawn(&scratch, &page, &window) else {
        return;
    };
    assert!(dom.contains("data-drawn=\"no\""), "{errors}");
    assert!(dom.contains("this browser has no WebGL 2"), "{errors}");
    assert!(dom.contains("data-seen=\"0 0 0 1 1\""), "{dom}");
}
