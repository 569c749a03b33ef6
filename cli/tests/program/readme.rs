//! The README against the program: its first command runs, its tables are complete.

use std::fs;
use std::path::{Path, PathBuf};

use roundel::search::{OPTIONS, OptionKind};

use crate::run::{Scratch, finish, only_object, program};

const README: &str = include_str!("../../../README.md");

fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("..")
}

fn help() -> String {
    let output = program(&["solve", "--help"]).output().unwrap();
    String::from_utf8(output.stdout).unwrap()
}

/// The words behind the program's name, of every command of the README that runs it.
fn commands() -> Vec<Vec<&'static str>> {
    let start = "cargo run --release -p roundel-cli -- ";
    let lines = README.lines().filter_map(|l| l.strip_prefix(start));
    lines.map(|l| l.split(' ').collect()).collect()
}

#[test]
fn every_command_that_it_shows_succeeds() {
    let commands = commands();
    assert_eq!(commands[0][..2], ["quad", "shape:gear:4000"]);
    for words in commands {
        let scratch = Scratch::new(&format!("readme-{}", words[0]));
        let mut command = program(&words);
        // What is written goes into a folder of its own, where the examples are found too.
        fs::create_dir(scratch.path("examples")).unwrap();
        for example in fs::read_dir(root().join("examples")).unwrap() {
            let example = example.unwrap();
            if !example.file_type().unwrap().is_file() {
                continue;
            }
            let copy = scratch.path("examples").join(example.file_name());
            fs::copy(example.path(), copy).unwrap();
        }
        command.arg("--json").current_dir(scratch.path(""));
        let (code, output) = finish(command);
        let report = only_object(&output);
        assert_eq!(code, 0, "{report}");
        assert!(report["integers"].as_u64().unwrap() > 0, "{report}");
    }
}

#[test]
fn its_pictures_are_there_and_small() {
    let mut shown = 0;
    for target in README.split("](").skip(1) {
        let file = root().join(target.split(')').next().unwrap());
        if file.extension().is_some_and(|e| e == "png") {
            assert!(fs::metadata(file).unwrap().len() < 400_000);
            shown += 1;
        }
    }
    assert!(shown > 0);
}

#[test]
fn the_table_of_options_is_the_librarys() {
    for info in OPTIONS {
        let range = match info.kind {
            OptionKind::Text => info.range.replace('|', ", "),
            _ => info.range.into(),
        };
        let row = format!(
            "| `{}` | {} | {range} | {} |",
            info.name, info.default, info.text
        );
        assert!(README.contains(&row), "{row}");
    }
}

#[test]
fn the_table_of_exit_codes_is_the_programs() {
    let help = help();
    let codes = help.split("Exit codes:\n").nth(1).unwrap();
    let rows = codes.lines().filter_map(|l| l.trim().split_once("  "));
    let mut count = 0;
    for (code, meaning) in rows {
        let row = format!("| {code} | {meaning} |");
        assert!(README.contains(&row), "{row}");
        count += 1;
    }
    assert_eq!(count, 7);
}

#[test]
fn the_table_of_errors_has_every_code() {
    for source in [
        include_str!("../../../src/error.rs"),
        include_str!("../../../src/mesh/error.rs"),
    ] {
        let body = source.split("fn code(&self)").nth(1).unwrap();
        let body = body.split("\n    }").next().unwrap();
        let codes: Vec<&str> = body.split('"').skip(1).step_by(2).collect();
        assert!(codes.len() > 10, "{codes:?}");
        for code in codes {
            assert!(README.contains(&format!("`{code}`")), "{code}");
        }
    }
}
