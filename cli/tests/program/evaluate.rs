//! `roundel evaluate`: a quick run on procedural shapes, its page, its CSV files, its limits.

use std::collections::BTreeMap;
use std::fs;
use std::path::Path;

use roundel::Strategy;
use roundel::mesh::{io, shape};
use serde_json::json;

use crate::run::{Scratch, finish, only_object, program};

const TABLES: [&str; 5] = [
    "table-5.1",
    "table-5.2",
    "table-5.3",
    "table-5.4",
    "ordering",
];

/// Runs `roundel evaluate --tables OUT WORDS...` and gives what it prints.
fn evaluate(out: &Path, words: &[&str]) -> String {
    let mut command = program(&["evaluate", "--tables"]);
    command.arg(out).args(words);
    let (code, output) = finish(command);
    let told = String::from_utf8(output.stdout).unwrap();
    let complaint = String::from_utf8_lossy(&output.stderr);
    assert_eq!((code, &*complaint), (0, ""), "{told}");
    told
}

/// The rows of a CSV file, by the names of its columns.
fn rows(file: &Path) -> Vec<BTreeMap<String, String>> {
    let text = fs::read_to_string(file).unwrap();
    let mut lines = text.lines().map(fields);
    let heads = lines.next().unwrap();
    lines
        .map(|fields| {
            assert_eq!(fields.len(), heads.len(), "{fields:?}");
            heads.iter().cloned().zip(fields).collect()
        })
        .collect()
}

/// The fields of a line; commas between quotes are text.
fn fields(line: &str) -> Vec<String> {
    let mut fields = vec![String::new()];
    let mut quoted = false;
    for c in line.chars() {
        match c {
            '"' => quoted = !quoted,
            ',' if !quoted => fields.push(String::new()),
            c => fields.last_mut().unwrap().push(c),
        }
    }
    fields
}

/// Whether every tag is closed, in the right order.
fn assert_well_formed(page: &str) {
    let body = page.strip_prefix("<!DOCTYPE html>\n").unwrap();
    let mut open = Vec::new();
    for piece in body.split('<').skip(1) {
        let tag = piece.split_once('>').unwrap_or_else(|| panic!("{piece}")).0;
        let name = tag.trim_start_matches('/').split(' ').next().unwrap();
        if tag.starts_with('/') {
            assert_eq!(open.pop(), Some(name.to_owned()), "{tag}");
        } else if !tag.ends_with('/') {
            open.push(name.to_owned());
        }
    }
    assert_eq!(open, Vec::<String>::new());
}

#[test]
fn a_quick_run_is_a_page_that_stands_alone_and_complete_tables() {
    let scratch = Scratch::new("evaluate");
    let out = scratch.path("tables");
    let others = scratch.write(
        "others.csv",
        "problem,solver,version,status,energy,lower_bound,gap,seconds\n\
         ring,scip,6,timelimit,2.5,2,0.2,60\n",
    );
    let others = others.to_str().unwrap();
    let told = evaluate(
        &out,
        &["--max-triangles", "1000", "--other-solvers", others],
    );
    let page = fs::read_to_string(out.join("index.html")).unwrap();
    assert_well_formed(&page);
    assert!(page.contains("<td>ring</td><td>scip 6</td><td>2.500000</td>"));
    for word in [
        "http", "src=", "href", "url(", "@import", "<script", "<link",
    ] {
        assert!(!page.contains(word), "{word}");
    }
    assert!(page.matches("<svg").count() >= 2 * 2 + 2 * 2 * 2);
    assert!(
        !page.contains("NaN") && !page.contains("inf"),
        "a plot without numbers"
    );

    for table in TABLES {
        let rows = rows(&out.join(format!("{table}.csv")));
        let (ours, reference): (Vec<_>, Vec<_>) =
            rows.iter().partition(|row| row["source"] == "roundel");
        assert!(!ours.is_empty(), "{table}");
        // A solver is not run on larger meshes than one that took it too long.
        for row in ours
            .into_iter()
            .filter(|row| !row["status"].starts_with("not run"))
        {
            for column in ["faces", "integers", "continuous", "energy", "seconds"] {
                let number: f64 = row[column].parse().unwrap_or_else(|_| panic!("{row:?}"));
                assert!(number.is_finite() && number >= 0.0, "{row:?}");
            }
            // What stands in is said in the row, on the page and while it runs.
            let said = format!("{}: not there, {}", row["mesh"], row["stand_in"]);
            assert!(
                row["stand_in"].starts_with("shape:") && told.contains(&said),
                "{said}"
            );
            assert!(page.contains(&format!("{}: {}", row["mesh"], row["stand_in"])));
        }
        if ["table-5.1", "table-5.2"].contains(&table) {
            assert!(reference.iter().any(|row| row["source"] == "thesis"));
            assert!(reference.iter().any(|row| row["source"] == "original"));
        }
        let solvers: Vec<&str> = rows.iter().map(|row| &*row["solver"]).collect();
        if table != "ordering" {
            assert!(Strategy::ALL.iter().all(|s| solvers.contains(&s.name())));
        }
    }
    // Nothing but what was asked for is left behind.
    assert_eq!(fs::read_dir(&out).unwrap().count(), TABLES.len() + 1);
}

#[test]
fn energies_are_those_of_the_commands_it_runs() {
    let scratch = Scratch::new("evaluate-energies");
    let out = scratch.path("tables");
    evaluate(&out, &["--max-triangles", "250"]);
    let mut compared = 0;
    for row in rows(&out.join("table-5.1.csv")) {
        let plain = Strategy::ALL.iter().any(|s| s.name() == row["solver"]);
        if row["source"] != "roundel" || !plain {
            continue;
        }
        let words = ["field", &row["stand_in"], "--json"];
        let flags = [
            "--strategy",
            &row["solver"],
            "--constrain-curvature",
            "0.235",
        ];
        let report = only_object(&finish(program(&[&words[..], &flags].concat())).1);
        let energy: f64 = row["energy"].parse().unwrap();
        assert_eq!(report["energy"], json!(energy), "{}", row["solver"]);
        assert_eq!(report["reduced_integers"].to_string(), row["integers"]);
        compared += 1;
    }
    assert_eq!(compared, Strategy::ALL.len());
}

#[test]
fn meshes_that_are_there_are_taken_and_what_differs_between_runs_is_time() {
    let scratch = Scratch::new("evaluate-meshes");
    let meshes = scratch.path("meshes");
    fs::create_dir(&meshes).unwrap();
    let mesh = shape::by_name("torus", 200).unwrap();
    io::write(meshes.join("rockerarm_200.off"), &mesh).unwrap();
    let folder = meshes.to_str().unwrap();
    let mut runs = Vec::new();
    for name in ["first", "second"] {
        let out = scratch.path(name);
        evaluate(&out, &["--max-triangles", "250", "--meshes", folder]);
        let mut rows = rows(&out.join("table-5.1.csv"));
        assert!(rows.iter().all(|row| row["stand_in"].is_empty()));
        assert_eq!(rows[0]["faces"], mesh.face_count().to_string());
        for row in &mut rows {
            for column in ["seconds", "peak_memory_bytes"] {
                row.remove(column);
            }
        }
        runs.push(rows);
    }
    assert_eq!(runs[0], runs[1]);
}

#[test]
fn a_folder_that_cannot_be_made_is_an_error_that_names_it() {
    let scratch = Scratch::new("evaluate-errors");
    let file = scratch.write("file", "");
    let mut command = program(&["evaluate", "--tables"]);
    command.arg(file.join("tables"));
    let (code, output) = finish(command);
    let told = String::from_utf8(output.stderr).unwrap();
    assert!(code == 1 && told.contains("tables"), "{told}");
    for flags in [["--max-triangles", "10"], ["--time-limit", "0"]] {
        let mut command = program(&["evaluate", "--tables"]);
        command.arg(scratch.path("none")).args(flags);
        assert_eq!(finish(command).0, 2);
    }
}
