//! The shared library exports exactly the functions that the header declares.
#![cfg(target_os = "linux")]

use std::collections::BTreeSet;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

fn root() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR"))
}

/// The library that cargo built beside this test.
fn library() -> PathBuf {
    let test = std::env::current_exe().unwrap();
    let deps = test.parent().unwrap();
    [deps, deps.parent().unwrap()]
        .map(|dir| dir.join("libroundel.so"))
        .into_iter()
        .find(|path| path.exists())
        .expect("cargo builds the cdylib with the tests")
}

fn output(program: &str, arguments: &[&str]) -> String {
    let output = Command::new(program)
        .args(arguments)
        .arg(library())
        .output()
        .unwrap();
    assert!(output.status.success());
    String::from_utf8(output.stdout).unwrap()
}

fn golden() -> BTreeSet<String> {
    let list = fs::read_to_string(root().join("tests/symbols.txt")).unwrap();
    list.lines().map(String::from).collect()
}

fn declared() -> BTreeSet<String> {
    let header = fs::read_to_string(root().join("include/roundel/roundel.h")).unwrap();
    let code = header
        .split("/*")
        .map(|part| part.split_once("*/").map_or(part, |(_, code)| code));
    let code: String = code.collect();
    let words = code.match_indices('(').filter_map(|(at, _)| {
        let before = &code[..at];
        let start = before
            .rfind(|c: char| !c.is_alphanumeric() && c != '_')
            .map_or(0, |i| i + 1);
        Some(&before[start..]).filter(|word| word.starts_with("roundel_"))
    });
    words.map(String::from).collect()
}

#[test]
fn the_header_declares_the_golden_list() {
    if std::env::var_os("ROUNDEL_BLESS").is_some_and(|v| v == "1") {
        let list: String = declared().iter().map(|name| format!("{name}\n")).collect();
        // Replace the list in one step, because the other test reads it at the same time.
        let fresh = root().join("tests/symbols.txt.new");
        fs::write(&fresh, list).unwrap();
        fs::rename(fresh, root().join("tests/symbols.txt")).unwrap();
    }
    assert_eq!(declared(), golden());
}

#[test]
fn the_library_exports_the_golden_list() {
    let mut expected = golden();
    if cfg!(feature = "test-panic") {
        expected.insert("roundel_test_panic".into());
    }
    let listing = output("nm", &["-D", "--defined-only"]);
    let exported: BTreeSet<String> = listing
        .lines()
        .filter_map(|line| line.split_whitespace().last())
        .map(String::from)
        .collect();
    assert_eq!(exported, expected);
}

#[test]
fn the_soname_carries_the_abi_number() {
    let dynamic = output("readelf", &["-d"]);
    let soname = format!("[libroundel.so.{}]", roundel::capi::ROUNDEL_ABI_VERSION);
    assert!(dynamic.contains(&soname), "{dynamic}");
}
