//! `roundel census`: a page of all meshes of a folder.

use std::collections::BTreeSet;
use std::fs;
use std::path::Path;
use std::time::{Duration, Instant};

use serde_json::{Value, json};

use crate::page::{Window, found_by};
use crate::run::{Scratch, finish, program};

/// A folder with meshes that become quads, one that is refused, and a file that is no mesh.
fn meshes(scratch: &Scratch) -> String {
    let folder = scratch.path("meshes");
    fs::create_dir_all(folder.join("more")).unwrap();
    for (shape, file) in [
        ("sphere", "sphere.obj"),
        ("plane", "more/plane.off"),
        ("torus", "torus.ply"),
    ] {
        let file = folder.join(file);
        let words = [
            "shape",
            shape,
            "--triangles",
            "200",
            "-o",
            file.to_str().unwrap(),
        ];
        assert_eq!(finish(program(&words)).0, 0);
    }
    fs::write(folder.join("broken.off"), "OFF\n3 1 0\n0 0 0\n").unwrap();
    fs::write(folder.join("notes.txt"), "no mesh").unwrap();
    folder.to_str().unwrap().to_owned()
}

const NAMES: [&str; 4] = ["broken.off", "more/plane.off", "sphere.obj", "torus.ply"];

/// What a census prints: its outcome, and before that a line for each mesh that has run.
fn census(folder: &str, page: &Path, words: &[&str]) -> (String, Vec<String>) {
    let page = page.to_str().unwrap();
    let all = [&["census", folder, "-o", page], words].concat();
    let (code, output) = finish(program(&all));
    let [told, errors] =
        [output.stdout, output.stderr].map(|text| String::from_utf8(text).unwrap());
    assert_eq!((code, &*errors), (0, ""), "{all:?}");
    let is_of_mesh = |line: &&str| {
        line.trim_start().starts_with(|c: char| c.is_ascii_digit()) && line.contains("/")
    };
    let (meshes, rest): (Vec<&str>, Vec<&str>) = told.lines().partition(|line| is_of_mesh(line));
    (
        rest.join("\n"),
        meshes.into_iter().map(String::from).collect(),
    )
}

fn rows(file: &Path) -> Vec<Value> {
    let text = fs::read_to_string(file).unwrap();
    text.lines()
        .map(|line| serde_json::from_str(line).unwrap())
        .collect()
}

fn names(rows: &[Value]) -> Vec<&str> {
    rows.iter()
        .map(|row| row["name"].as_str().unwrap())
        .collect()
}

#[test]
fn every_mesh_has_a_row_with_its_figures_and_its_picture() {
    let scratch = Scratch::new("census");
    let folder = meshes(&scratch);
    let page = scratch.path("page.html");
    let quads = scratch.path("quads");
    let words = [
        "--jobs",
        "2",
        "--quads-to",
        quads.to_str().unwrap(),
        "--",
        "--quads",
        "100",
    ];
    let (told, progress) = census(&folder, &page, &words);
    assert!(
        told.starts_with("4 meshes: 3 became quads, 1 refused\n"),
        "{told}"
    );
    assert_eq!(progress.len(), 4, "{progress:?}");
    let found = rows(&scratch.path("page.jsonl"));
    assert_eq!(names(&found), NAMES);
    assert_eq!(found[0]["outcome"], "refused");
    assert_eq!(found[0]["code"], "parse");
    for row in &found[1..] {
        assert_eq!(row["outcome"], "quads", "{row}");
        let count = |key: &str| row[key].as_u64().unwrap();
        assert!((80..130).contains(&count("quads")), "{row}");
        assert!(count("triangles") > 100 && count("inverted") == 0, "{row}");
        assert!(row["distance"].as_f64().unwrap() < 0.05, "{row}");
        assert!(
            row["thumbnail"]
                .as_str()
                .unwrap()
                .starts_with("iVBORw0KGgo")
        );
        assert_eq!(row["flags"], json!(["--quads", "100"]));
    }
    let html = fs::read_to_string(&page).unwrap();
    assert_eq!(html.matches("<img ").count(), 3);
    assert!(html.contains("<p>3 of 4 meshes became quads"));
    for word in ["http:", "https:", "<link", "import ", "fetch("] {
        assert!(!html.contains(word), "{word}");
    }
    let written = fs::read_dir(&quads)
        .unwrap()
        .map(|entry| entry.unwrap().file_name());
    let written: BTreeSet<String> = written.map(|name| name.into_string().unwrap()).collect();
    let expected = ["more__plane.off.obj", "sphere.obj.obj", "torus.ply.obj"];
    assert_eq!(written, expected.map(String::from).into());
    // Once more: nothing runs, and the page is the same.
    assert_eq!(census(&folder, &page, &words), (told, Vec::new()));
    assert_eq!(fs::read_to_string(&page).unwrap(), html);
}

#[test]
fn a_browser_sorts_and_filters_the_rows() {
    let scratch = Scratch::new("census-browser");
    let folder = meshes(&scratch);
    let page = scratch.path("page.html");
    census(&folder, &page, &["--", "--quads", "60"]);
    let journal = rows(&scratch.path("page.jsonl"));
    let mut sized: Vec<(u64, &str)> = journal
        .iter()
        .filter_map(|row| Some((row["triangles"].as_u64()?, row["name"].as_str()?)))
        .collect();
    sized.sort_unstable();
    assert_eq!(sized.len(), 3);
    let window = Window {
        width: 1400,
        is_dark: false,
    };
    let checks = include_str!("census_checks.js");
    let Some(found) = found_by(checks, &scratch, &page, &window) else {
        return;
    };
    // What has no triangles is last either way.
    let mut expected: Vec<&str> = sized.iter().map(|&(_, name)| name).collect();
    expected.push("broken.off");
    assert_eq!(found["ascending"], json!(expected));
    expected[..3].reverse();
    assert_eq!(found["descending"], json!(expected));
    for names in ["first", "byName", "all"] {
        assert_eq!(found[names], json!(NAMES), "{names}");
    }
    assert_eq!(found["refused"], json!(["broken.off"]));
    assert_eq!(found["named"], json!(["torus.ply"]));
    assert_eq!(found["told"], "1 of 4");
    assert_eq!(found["pictures"], json!([200, 200, 200]));
}

#[test]
fn what_was_cut_off_has_changed_or_has_other_flags_runs_again() {
    let scratch = Scratch::new("census-again");
    let folder = meshes(&scratch);
    let [page, journal] = ["page.html", "page.jsonl"].map(|name| scratch.path(name));
    let run = |words: &[&str]| {
        let (_, progress) = census(&folder, &page, words);
        assert_eq!(names(&rows(&journal)), NAMES);
        progress.len()
    };
    let small = ["--", "--quads", "60"];
    assert_eq!(run(&small), 4);
    // A process that was killed while it wrote.
    let text = fs::read_to_string(&journal).unwrap();
    fs::write(&journal, &text[..text.len() - 40]).unwrap();
    assert_eq!(run(&small), 1);
    // Another process has added the same row.
    let first = text.lines().next().unwrap();
    fs::write(&journal, format!("{text}{first}\n")).unwrap();
    assert_eq!(run(&small), 0);
    let file = Path::new(&folder).join("sphere.obj");
    let mesh = fs::read_to_string(&file).unwrap();
    fs::write(&file, mesh + "# changed\n").unwrap();
    assert_eq!(run(&small), 1);
    fs::write(Path::new(&folder).join("broken.off"), "OFF\n").unwrap();
    assert_eq!(run(&["--", "--quads", "80"]), 4);
    // Quads that are asked for later are made, but for the mesh that has none.
    let folder = scratch.path("quads");
    let words = [
        "--quads-to",
        folder.to_str().unwrap(),
        "--",
        "--quads",
        "80",
    ];
    assert_eq!((run(&words), run(&words)), (3, 0));
}

#[test]
fn parts_are_collected_by_a_census_of_the_whole() {
    let scratch = Scratch::new("census-parts");
    let folder = meshes(&scratch);
    let page = scratch.path("page.html");
    let flags = ["--", "--quads", "60"];
    for part in ["1/3", "3/3"] {
        let (_, progress) = census(&folder, &page, &[&["--part", part][..], &flags].concat());
        assert!(!progress.is_empty(), "{part}");
        assert!(!page.exists());
    }
    // The second part is lost.
    let (told, progress) = census(&folder, &page, &flags);
    assert_eq!(progress.len(), 1, "{progress:?}");
    assert!(progress[0].contains("more/plane.off"), "{progress:?}");
    assert!(told.starts_with("4 meshes: "), "{told}");
    assert_eq!(names(&rows(&scratch.path("page.jsonl"))), NAMES);
}

#[test]
fn a_census_that_was_killed_goes_on_where_it_was() {
    let scratch = Scratch::new("census-killed");
    let folder = meshes(&scratch);
    let [page, journal] = ["page.html", "page.jsonl"].map(|name| scratch.path(name));
    let words = ["census", &folder, "-o", page.to_str().unwrap(), "--quiet"];
    let mut child = program(&words).spawn().unwrap();
    let started = Instant::now();
    let lines = || fs::read_to_string(&journal).map_or(0, |text| text.matches('\n').count());
    while lines() == 0 && started.elapsed() < Duration::from_secs(60) {
        std::thread::sleep(Duration::from_millis(5));
    }
    child.kill().unwrap();
    child.wait().unwrap();
    let before = lines();
    assert!(before > 0);
    let (_, progress) = census(&folder, &page, &[]);
    assert_eq!(progress.len(), 4 - before, "{progress:?}");
    assert_eq!(names(&rows(&journal)), NAMES);
    assert!(fs::read_to_string(&page).unwrap().contains("torus.ply"));
}

/// The most processes that a census has at a time.
#[cfg(target_os = "linux")]
fn most_processes(folder: &str, page: &Path, jobs: &str) -> usize {
    let page = page.to_str().unwrap();
    let words = ["census", folder, "-o", page, "--quiet", "--jobs", jobs];
    let mut child = program(&words).spawn().unwrap();
    let tasks = format!("/proc/{}/task", child.id());
    let mut most = 0;
    while child.try_wait().unwrap().is_none() {
        let threads = fs::read_dir(&tasks).into_iter().flatten().flatten();
        let children =
            threads.filter_map(|thread| fs::read_to_string(thread.path().join("children")).ok());
        let now = children.map(|list| list.split_whitespace().count()).sum();
        most = most.max(now);
        std::thread::sleep(Duration::from_millis(2));
    }
    most
}

#[test]
#[cfg(target_os = "linux")]
fn as_many_meshes_run_at_a_time_as_were_asked_for() {
    if !Path::new("/proc/thread-self/children").exists() {
        eprintln!("skipped: this kernel does not list the children of processes");
        return;
    }
    for jobs in [1, 2] {
        let scratch = Scratch::new(&format!("census-jobs-{jobs}"));
        let folder = meshes(&scratch);
        let most = most_processes(&folder, &scratch.path("page.html"), &jobs.to_string());
        assert_eq!(most, jobs);
    }
}

#[test]
fn a_mesh_that_takes_too_long_is_given_up() {
    let scratch = Scratch::new("census-slow");
    let folder = scratch.path("meshes");
    fs::create_dir_all(&folder).unwrap();
    let (folder, file) = (folder.to_str().unwrap(), folder.join("large.off"));
    let words = ["shape", "torus", "--triangles", "100000", "-o"];
    let words = [&words[..], &[file.to_str().unwrap()]].concat();
    assert_eq!(finish(program(&words)).0, 0);
    let page = scratch.path("page.html");
    let (told, _) = census(folder, &page, &["--kill-after", "0.05"]);
    assert!(told.contains("1 given up for time"), "{told}");
}

#[test]
fn what_cannot_be_read_or_written_is_told() {
    let scratch = Scratch::new("census-refused");
    let folder = meshes(&scratch);
    let page = scratch.path("page.html");
    let page = page.to_str().unwrap();
    let nowhere = scratch.path("nowhere");
    let cases = [
        (
            vec!["census", &folder, "-o", "page.txt"],
            1,
            "must end in .html",
        ),
        (
            vec!["census", nowhere.to_str().unwrap(), "-o", page],
            1,
            "nowhere",
        ),
        (
            vec!["census", &folder, "-o", page, "--part", "3/2"],
            2,
            "3/8",
        ),
        (vec!["census", &folder], 2, "--out"),
    ];
    for (words, expected, message) in cases {
        let (code, output) = finish(program(&words));
        let told = String::from_utf8(output.stderr).unwrap();
        assert!(
            code == expected && told.contains(message),
            "{words:?}: {code} {told}"
        );
    }
}
