//! The README's C and C++ programs are accepted as they stand, with all warnings as errors.
//!
//! That what they call also links and runs is held by the tests of the installed package.

use std::fs;
use std::path::Path;
use std::process::Command;

#[test]
fn the_c_example_compiles() {
    compiles("c", &["cc", "-std=c99"]);
}

#[test]
fn the_cpp_example_compiles() {
    compiles("cpp", &["c++", "-std=c++17"]);
}

fn compiles(language: &str, compiler: &[&str]) {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let file = Path::new(env!("CARGO_TARGET_TMPDIR")).join(format!("readme.{language}"));
    fs::write(&file, example(language)).unwrap();
    let output = Command::new(compiler[0])
        .args(&compiler[1..])
        .args(["-fsyntax-only", "-Wall", "-Wextra", "-Werror", "-pedantic"])
        .arg("-I")
        .arg(root.join("include"))
        .arg(&file)
        .output()
        .unwrap();
    let text = String::from_utf8_lossy(&output.stderr);
    assert!(output.status.success(), "{text}");
}

/// The one block of the README in this language.
fn example(language: &str) -> &'static str {
    let readme = include_str!("../README.md");
    let fence = format!("```{language}\n");
    let mut blocks = readme.split(&fence).skip(1);
    let block = blocks.next().unwrap().split("```").next().unwrap();
    assert!(blocks.next().is_none(), "two examples in {language}");
    block
}
