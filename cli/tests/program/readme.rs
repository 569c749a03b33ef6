//! The README against the program: its first command runs, its tables are complete.

use std::path::{Path, PathBuf};
use std::process::Command;

use roundel::solve::{OPTIONS, OptionKind};

use crate::run::{finish, only_object, solve};

const README: &str = include_str!("../../../README.md");

fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("..")
}

fn help() -> String {
    let mut command = Command::new(env!("CARGO_BIN_EXE_roundel"));
    let output = command.args(["solve", "--help"]).output().unwrap();
    String::from_utf8(output.stdout).unwrap()
}

#[test]
fn the_first_command_solves_its_example() {
    let start = "cargo run --release -p roundel-cli -- solve ";
    let line = README.lines().find_map(|l| l.strip_prefix(start)).unwrap();
    let (file, flags) = line.split_once(' ').unwrap();
    let flags: Vec<&str> = flags.split(' ').chain(["--json"]).collect();
    let (code, output) = finish(solve(&root().join(file), &flags));
    let report = only_object(&output);
    assert_eq!(code, 0, "{report}");
    assert!(report["integers"].as_u64().unwrap() > 0, "{report}");
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
    assert_eq!(count, 6);
}

#[test]
fn the_table_of_errors_has_every_code() {
    let source = include_str!("../../../src/error.rs");
    let body = source.split("fn code(&self)").nth(1).unwrap();
    let body = body.split("\n    }").next().unwrap();
    let codes: Vec<&str> = body.split('"').skip(1).step_by(2).collect();
    assert!(codes.len() > 10, "{codes:?}");
    for code in codes {
        assert!(README.contains(&format!("`{code}`")), "{code}");
    }
}
