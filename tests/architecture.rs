//! The layout of the sources: the rules that it promises, checked in the text of every file.
//!
//! Each layer names only lower ones, `unsafe` occurs only in the C interface, the library never prints,
//! and every file is short enough to hold one idea.

use std::fs;
use std::path::{Path, PathBuf};

/// The layers from the lowest to the highest. A file names its own layer and lower ones, nothing else.
const LAYERS: [&str; 27] = [
    "error",
    "monitor",
    "linalg",
    "problem",
    "proof",
    "eliminate",
    "search",
    "round",
    "cut",
    "network",
    "lattice",
    "cycle",
    "branch",
    "solve",
    "soup",
    "mesh",
    "geodesic",
    "field",
    "map",
    "untangle",
    "check",
    "extract",
    "smooth",
    "transfer",
    "layout",
    "quad",
    "capi",
];

/// The largest number of lines in a file.
const LONGEST: usize = 600;

#[test]
fn every_file_names_only_its_own_layer_and_those_below() {
    for (path, text) in sources() {
        let own = module(&path);
        if own == "lib" || own == "internals" || is_test(&path) {
            continue;
        }
        let height = height(own).unwrap_or_else(|| panic!("{} is in no layer", path.display()));
        for name in layers_named(&without_tests(&tokens(&text)), depth(&path)) {
            let below = self::height(&name).is_some_and(|other| other <= height);
            assert!(below, "{} names {name}", path.display());
        }
    }
}

#[test]
fn the_check_shares_no_code_with_the_construction_of_maps() {
    let makers = ["solve", "field", "map", "untangle"];
    for (path, text) in sources() {
        if module(&path) == "check" {
            let named = layers_named(&without_tests(&tokens(&text)), depth(&path));
            let shared: Vec<_> = named
                .iter()
                .filter(|n| makers.contains(&n.as_str()))
                .collect();
            assert!(shared.is_empty(), "{} names {shared:?}", path.display());
        }
    }
}

/// The checker of proofs must not believe what the search does: of the lower layers, it may read a problem and
/// name an error.
#[test]
fn proofs_share_no_code_with_the_search() {
    for (path, text) in sources() {
        if module(&path) == "proof" {
            let named = layers_named(&without_tests(&tokens(&text)), depth(&path));
            let allowed = ["error", "problem", "proof"];
            let shared: Vec<_> = named
                .iter()
                .filter(|n| !allowed.contains(&n.as_str()))
                .collect();
            assert!(shared.is_empty(), "{} names {shared:?}", path.display());
        }
    }
}

#[test]
fn the_documented_layers_are_these() {
    let text = described();
    let listed = text.lines().filter_map(|line| line.strip_prefix("- `"));
    let names: Vec<_> = listed.filter_map(|line| line.split('`').next()).collect();
    assert_eq!(names, LAYERS);
}

#[test]
fn documented_files_exist() {
    let text = described();
    let named: Vec<_> = text.split('`').filter(|t| t.ends_with(".rs")).collect();
    assert!(named.len() > 25, "{named:?}");
    for name in named {
        let path = root().parent().unwrap().join(name);
        assert!(path.is_file(), "docs/architecture.md names {name}");
    }
}

/// The solver's steps, in italics, are called by the field and the map.
#[test]
fn no_documented_step_returns_to_an_earlier_layer() {
    let text = described();
    let is_step = |line: &&str| line.strip_prefix("| ").is_some_and(starts_with_number);
    let mut last = height("mesh").unwrap();
    let mut count = 0;
    for step in text.lines().filter(is_step) {
        let file = step.split("`src/").nth(1).unwrap();
        let layer = height(file.split('/').next().unwrap()).unwrap();
        let is_solver = layer < height("mesh").unwrap();
        assert_eq!(is_solver, step.contains("| *"), "{step}");
        if !is_solver {
            assert!(layer >= last, "{step}");
            last = layer;
        }
        count += 1;
        assert!(step.starts_with(&format!("| {count} |")), "{step}");
    }
    assert!(count > 20 && last == height("smooth").unwrap());
}

fn described() -> String {
    fs::read_to_string(root().parent().unwrap().join("docs/architecture.md")).unwrap()
}

fn starts_with_number(text: &str) -> bool {
    text.starts_with(|c: char| c.is_ascii_digit())
}

#[test]
fn unsafe_code_lives_in_the_c_interface_only() {
    for (path, text) in sources() {
        if module(&path) == "capi" {
            continue;
        }
        let tokens = tokens(&text);
        let found = tokens.iter().any(|t| t == "unsafe");
        assert!(!found, "{} is unsafe", path.display());
        let allowed = tokens
            .windows(3)
            .any(|w| w == ["allow", "(", "unsafe_code"]);
        let is_gate = path.ends_with("src/lib.rs");
        assert!(is_gate || !allowed, "{} allows unsafe", path.display());
    }
}

#[test]
fn the_library_never_prints() {
    for (path, text) in sources() {
        let found = macros_called(
            &tokens(&text),
            &["print", "println", "eprint", "eprintln", "dbg"],
        );
        assert!(found.is_empty(), "{} calls {found:?}", path.display());
    }
}

#[test]
fn no_file_is_longer_than_a_reader_can_hold() {
    for (path, text) in sources() {
        let lines = text.lines().count();
        assert!(lines <= LONGEST, "{} has {lines} lines", path.display());
    }
}

#[test]
fn every_file_starts_with_a_heading() {
    for (path, text) in sources() {
        assert!(
            text.starts_with("//! "),
            "{} has no heading",
            path.display()
        );
    }
}

#[test]
fn every_way_to_name_a_layer_is_recognised() {
    for text in [
        "use crate::solve::Thing;",
        "use crate::{solve};",
        "use crate::{solve::{Thing, Other}};",
        "use crate::{self as root, solve as s};",
        "use super::super::solve::Thing;",
        "fn f(s: &crate::solve::Thing) {}",
    ] {
        let named = layers_named(&tokens(text), 2);
        assert_eq!(named, ["solve"], "{text}");
    }
}

#[test]
fn words_in_comments_strings_and_inner_paths_name_no_layer() {
    for text in [
        "// use crate::mesh;",
        "/* crate::mesh /* crate::quad */ mesh::x */",
        "let s = \"crate::mesh \\\" println!()\";",
        "let s = r#\"crate::mesh \" println!()\"#;",
        "use super::mesh::Thing; let quadratic = quad_terms::<'static>('\"');",
        "use std::{mesh, quad};",
    ] {
        let tokens = tokens(text);
        assert!(layers_named(&tokens, 2).is_empty(), "{text}");
        assert!(macros_called(&tokens, &["println"]).is_empty(), "{text}");
    }
}

#[test]
fn code_for_tests_is_left_out_and_the_code_after_it_is_kept() {
    let text = "use a; #[cfg(test)] mod tests { fn f() { { } } } fn g() {} #[cfg(test)] use b; c";
    assert_eq!(without_tests(&tokens(text)), tokens("use a; fn g() {} c"));
}

#[test]
fn a_macro_is_found_only_where_it_is_called() {
    let tokens = tokens("fn print() { if print != 0 { eprintln! (\"x\"); std::println!() } }");
    let found = macros_called(&tokens, &["print", "println", "eprintln"]);
    assert_eq!(found, ["eprintln", "println"]);
}

/// Every source file of the library, with its text.
fn sources() -> Vec<(PathBuf, String)> {
    let mut found = Vec::new();
    let mut folders = vec![root()];
    while let Some(folder) = folders.pop() {
        for entry in fs::read_dir(folder).unwrap() {
            let path = entry.unwrap().path();
            if path.is_dir() {
                folders.push(path);
            } else if path.extension().is_some_and(|e| e == "rs") {
                let text = fs::read_to_string(&path).unwrap();
                found.push((path, text));
            }
        }
    }
    assert!(found.len() > 10, "the sources are elsewhere");
    found
}

fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("src")
}

/// The top-level module that a file belongs to.
fn module(path: &Path) -> &str {
    let inner = path.strip_prefix(root()).unwrap();
    let first = Path::new(inner.iter().next().unwrap());
    first.file_stem().unwrap().to_str().unwrap()
}

/// The words and signs of Rust source, without comments, strings and characters; `::` is one sign.
fn tokens(text: &str) -> Vec<String> {
    let chars: Vec<char> = text.chars().collect();
    let mut tokens = Vec::new();
    let mut i = 0;
    while i < chars.len() {
        let c = chars[i];
        let next = chars.get(i + 1).copied();
        if c == '/' && next == Some('/') {
            i = skip_until(&chars, i, '\n');
        } else if c == '/' && next == Some('*') {
            i = skip_block_comment(&chars, i);
        } else if c == '"' {
            i = skip_string(&chars, i);
        } else if c == 'r' && matches!(next, Some('"' | '#')) && is_raw_string(&chars, i) {
            i = skip_raw_string(&chars, i);
        } else if c == '\'' {
            i = skip_character_or_lifetime(&chars, i);
        } else if c.is_alphabetic() || c == '_' {
            let end = (i..chars.len())
                .find(|&k| !(chars[k].is_alphanumeric() || chars[k] == '_'))
                .unwrap_or(chars.len());
            tokens.push(chars[i..end].iter().collect());
            i = end;
        } else if c == ':' && next == Some(':') {
            tokens.push("::".into());
            i += 2;
        } else {
            if !c.is_whitespace() {
                tokens.push(c.into());
            }
            i += 1;
        }
    }
    tokens
}

fn skip_until(chars: &[char], from: usize, end: char) -> usize {
    let found = chars[from..].iter().position(|&c| c == end);
    found.map_or(chars.len(), |k| from + k + 1)
}

fn skip_block_comment(chars: &[char], from: usize) -> usize {
    let (mut depth, mut i) = (0, from);
    while i + 1 < chars.len() {
        match (chars[i], chars[i + 1]) {
            ('/', '*') => (depth, i) = (depth + 1, i + 2),
            ('*', '/') => (depth, i) = (depth - 1, i + 2),
            _ => i += 1,
        }
        if depth == 0 {
            return i;
        }
    }
    chars.len()
}

fn skip_string(chars: &[char], from: usize) -> usize {
    let mut i = from + 1;
    while i < chars.len() && chars[i] != '"' {
        i += if chars[i] == '\\' { 2 } else { 1 };
    }
    i + 1
}

fn is_raw_string(chars: &[char], from: usize) -> bool {
    chars[from + 1..].iter().find(|&&c| c != '#') == Some(&'"')
}

fn skip_raw_string(chars: &[char], from: usize) -> usize {
    let hashes = chars[from + 1..].iter().take_while(|&&c| c == '#').count();
    let mut close = vec!['"'];
    close.resize(1 + hashes, '#');
    let inside = from + 2 + hashes;
    let end = chars[inside..]
        .windows(close.len())
        .position(|w| w == close);
    end.map_or(chars.len(), |k| inside + k + close.len())
}

fn skip_character_or_lifetime(chars: &[char], from: usize) -> usize {
    match (chars.get(from + 1), chars.get(from + 2)) {
        // The escaped character itself may be a quote.
        (Some('\\'), _) => skip_until(chars, from + 3, '\''),
        (_, Some('\'')) => from + 3,
        _ => from + 1,
    }
}

/// The place of a layer in the list, counted from the lowest.
fn height(layer: &str) -> Option<usize> {
    LAYERS.iter().position(|&l| l == layer)
}

/// How many modules a file is below the root of the crate.
fn depth(path: &Path) -> usize {
    let inner = path.strip_prefix(root()).unwrap();
    let is_folder = inner.ends_with("mod.rs");
    inner.iter().count() - usize::from(is_folder)
}

/// Whether the file contains only tests.
fn is_test(path: &Path) -> bool {
    let stem = path.file_stem().unwrap().to_str().unwrap();
    stem == "tests" || stem.ends_with("_tests")
}

/// Leaves out the code marked `#[cfg(test)]`, because tests may use higher layers. Such code ends at
/// its closing brace, or at its semicolon if it has no braces.
fn without_tests(tokens: &[String]) -> Vec<String> {
    let marker = ["#", "[", "cfg", "(", "test", ")", "]"];
    let mut kept = Vec::new();
    let mut i = 0;
    while i < tokens.len() {
        if !tokens[i..].iter().take(marker.len()).eq(marker) {
            kept.push(tokens[i].clone());
            i += 1;
            continue;
        }
        let mut open = 0;
        while i < tokens.len() {
            match tokens[i].as_str() {
                "{" => open += 1,
                "}" => open -= 1,
                _ => {}
            }
            let ends = matches!(tokens[i].as_str(), "}" | ";") && open == 0;
            i += 1;
            if ends {
                break;
            }
        }
    }
    kept
}

/// The layers that a file names by paths from the root of the crate, one entry a path. `depth` is the
/// number of modules between the file and the root.
fn layers_named(tokens: &[String], depth: usize) -> Vec<String> {
    let mut found = Vec::new();
    let mut i = 0;
    while i < tokens.len() {
        let supers = tokens[i..]
            .chunks(2)
            .take_while(|pair| matches!(pair, [a, b] if a == "super" && b == "::"));
        let climbs = supers.count();
        let from_root = tokens[i] == "crate" && tokens.get(i + 1).is_some_and(|t| t == "::");
        if from_root || climbs >= depth {
            i += if from_root { 2 } else { 2 * climbs };
            found.extend(first_segments(&tokens[i..]));
        } else {
            i += (2 * climbs).max(1);
        }
    }
    found.retain(|name| name != "self");
    found
}

/// The first segment of a path, or those of each path of a group in braces.
fn first_segments(tokens: &[String]) -> Vec<String> {
    if tokens[0] != "{" {
        return vec![tokens[0].clone()];
    }
    let (mut open, mut found) = (0, Vec::new());
    for (i, token) in tokens.iter().enumerate() {
        match token.as_str() {
            "{" => open += 1,
            "}" => open -= 1,
            _ => {}
        }
        if open == 0 {
            break;
        }
        if open == 1 && matches!(token.as_str(), "{" | ",") && tokens[i + 1] != "}" {
            found.push(tokens[i + 1].clone());
        }
    }
    found
}

/// The names in `names` that are called as macros.
fn macros_called(tokens: &[String], names: &[&str]) -> Vec<String> {
    let called = |w: &&[String]| {
        names.contains(&w[0].as_str()) && w[1] == "!" && matches!(w[2].as_str(), "(" | "[" | "{")
    };
    let calls = tokens.windows(3).filter(called);
    calls.map(|w| w[0].clone()).collect()
}
