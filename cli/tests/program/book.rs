//! The book against the program: its commands run, its flags and exit codes are the program's.

#[path = "../../../tests/book/page.rs"]
mod page;

use std::collections::BTreeSet;
use std::fs;
use std::process::Command;

use crate::run::{Scratch, finish, program};
use page::{Block, blocks, pages, root};

/// How a command of the book names the program.
const NAMES: [&str; 2] = ["cargo run --release -p roundel-cli -- ", "roundel "];

/// The commands of the program.
const COMMANDS: [&str; 14] = [
    "census",
    "quad",
    "field",
    "parametrize",
    "check",
    "check-proof",
    "distance",
    "extract",
    "layout",
    "repair",
    "solve",
    "shape",
    "evaluate",
    "generate",
];

fn page(name: &str) -> String {
    fs::read_to_string(root().join(name)).unwrap()
}

fn help(command: &str) -> String {
    let output = program(&[command, "--help-all"]).output().unwrap();
    String::from_utf8(output.stdout).unwrap()
}

/// A command of the program, and the place of its block.
struct Shown<'a> {
    place: String,
    words: Vec<&'a str>,
}

/// The commands of a page that run the program.
fn commands_of<'a>(all: &'a [Block], page: &str) -> Vec<Shown<'a>> {
    let shell = all.iter().filter(|b| b.page == page && b.language == "sh");
    let lines = shell.flat_map(|b| b.text.lines().map(|line| (b.place(), line)));
    let mine = lines.filter_map(|(place, line)| {
        let rest = NAMES.iter().find_map(|name| line.strip_prefix(name))?;
        let words = rest.split(' ').collect();
        Some(Shown { place, words })
    });
    mine.collect()
}

/// Commands of a page run in order, in one folder: what one writes, the next may read.
#[test]
fn every_command_that_it_shows_succeeds() {
    let all = blocks();
    let mut count = 0;
    for (name, _) in pages() {
        let commands = commands_of(&all, &name);
        let scratch = Scratch::new(&format!("book-{}", name.replace('/', "-")));
        for folder in ["examples", "meshes"] {
            fs::create_dir(scratch.path(folder)).unwrap();
        }
        let example = "examples/torus_field.mps";
        fs::copy(root().join(example), scratch.path(example)).unwrap();
        // The tests of `evaluate` run it on smaller meshes.
        for Shown { place, words } in commands.iter().filter(|c| c.words[0] != "evaluate") {
            let mut command: Command = program(words);
            command.current_dir(scratch.path(""));
            let (code, output) = finish(command);
            let errors = String::from_utf8_lossy(&output.stderr);
            assert_eq!((code, &*errors), (0, ""), "{place}: {words:?}");
            count += 1;
        }
    }
    assert!(count > 15);
}

#[test]
fn the_first_command_of_the_readme_makes_the_quads_that_it_promises() {
    let all = blocks();
    let words = &commands_of(&all, "README.md")[0].words;
    assert_eq!(words[..2], ["quad", "shape:gear:4000"]);
    let scratch = Scratch::new("book-first");
    let mut command = program(words);
    command.arg("--json").current_dir(scratch.path(""));
    let (_, output) = finish(command);
    let report = crate::run::only_object(&output);
    let promise = format!("It turns a gear into {} quads", report["quads"]);
    assert!(page("README.md").contains(&promise), "{promise}");
    assert_eq!(report["conforming"], true);
}

/// The long flags in a text.
fn flags(text: &str) -> BTreeSet<String> {
    let is_flag = |c: char| c.is_ascii_lowercase() || c == '-';
    text.split(|c| !is_flag(c))
        .filter(|w| w.len() > 3 && w.starts_with("--") && w.as_bytes()[2] != b'-')
        .map(String::from)
        .collect()
}

#[test]
fn every_flag_is_in_the_book_and_the_book_has_no_other() {
    let of_options: BTreeSet<String> = roundel::search::OPTIONS
        .iter()
        .map(|info| format!("--{}", info.name.replace('_', "-")))
        .collect();
    let known: BTreeSet<String> = COMMANDS.iter().flat_map(|c| flags(&help(c))).collect();
    let told = page("docs/program.md");
    for flag in known.difference(&of_options).filter(|f| *f != "--help") {
        assert!(told.contains(&format!("`{flag}")), "{flag}");
    }
    for name in ["program", "fields", "maps", "quads"] {
        let name = format!("docs/{name}.md");
        // Lines of commands of other programs have flags of their own.
        let lines = page(&name);
        let lines = lines.lines().filter(|l| !l.starts_with("cargo"));
        for flag in lines.flat_map(flags) {
            assert!(known.contains(&flag), "{name}: {flag}");
        }
    }
}

#[test]
fn the_table_of_exit_codes_is_the_programs() {
    let help = help("solve");
    let codes = help.split("Exit codes:\n").nth(1).unwrap();
    let rows = codes.lines().filter_map(|l| l.trim().split_once("  "));
    let told = page("docs/program.md");
    let mut count = 0;
    for (code, meaning) in rows {
        let row = format!("| {code} | {meaning} |");
        assert!(told.contains(&row), "{row}");
        count += 1;
    }
    assert_eq!(count, 8);
}
