//! What the layout promises, read off the sources.
//!
//! Geometry and the C interface are clients of the solver, `unsafe` has one home, the library never
//! prints, and files stay short enough to be one idea.

use std::fs;
use std::path::{Path, PathBuf};

/// The parts that solve. None of them names a client.
const SOLVER: [&str; 7] = [
    "problem",
    "eliminate",
    "linalg",
    "round",
    "lattice",
    "cycle",
    "solve",
];

/// The parts that use the solver.
const CLIENTS: [&str; 4] = ["mesh", "quad", "picture", "capi"];

/// No file is longer, in lines.
const LONGEST: usize = 600;

#[test]
fn the_solver_never_names_its_clients() {
    for (path, text) in sources() {
        if SOLVER.contains(&module(&path)) {
            let named = named_in_paths(&tokens(&text), &CLIENTS);
            assert!(named.is_empty(), "{} names {named:?}", path.display());
        }
    }
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
fn every_file_says_first_what_it_is() {
    for (path, text) in sources() {
        assert!(
            text.starts_with("//! "),
            "{} has no heading",
            path.display()
        );
    }
}

#[test]
fn a_client_is_found_in_every_way_to_name_it() {
    for text in [
        "use crate::mesh::Mesh;",
        "use crate::{error::Error, mesh};",
        "use super::super::quad as q;",
        "fn f(m: &crate::mesh::Mesh) {}",
        "let m = mesh::read(path);",
        "mod capi;",
    ] {
        let named = named_in_paths(&tokens(text), &CLIENTS);
        assert_eq!(named.len(), 1, "{text}");
    }
}

#[test]
fn words_in_comments_strings_and_longer_names_are_no_paths() {
    for text in [
        "// use crate::mesh;",
        "/* crate::mesh /* crate::quad */ mesh::x */",
        "let s = \"crate::mesh \\\" println!()\";",
        "let s = r#\"crate::mesh \" println!()\"#;",
        "use crate::problem::mesh_free; let quadratic = quad_terms::<'static>('\"');",
    ] {
        let tokens = tokens(text);
        assert!(named_in_paths(&tokens, &CLIENTS).is_empty(), "{text}");
        assert!(macros_called(&tokens, &["println"]).is_empty(), "{text}");
    }
}

#[test]
fn a_macro_is_found_where_it_is_called_and_nowhere_else() {
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

/// Words and signs of Rust source, `::` as one, without comments, strings and characters.
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

/// Those of `names` that stand in a path, in a `use`, or behind `mod`.
fn named_in_paths(tokens: &[String], names: &[&str]) -> Vec<String> {
    let mut found = Vec::new();
    let mut in_use = false;
    for (i, token) in tokens.iter().enumerate() {
        match token.as_str() {
            "use" => in_use = true,
            ";" => in_use = false,
            _ => {}
        }
        let before = i.checked_sub(1).map(|k| tokens[k].as_str());
        let after = tokens.get(i + 1).map(String::as_str);
        let is_path = in_use || matches!(before, Some("::" | "mod")) || after == Some("::");
        if is_path && names.contains(&token.as_str()) {
            found.push(token.clone());
        }
    }
    found
}

/// Those of `names` that are called as macros.
fn macros_called(tokens: &[String], names: &[&str]) -> Vec<String> {
    let called = |w: &&[String]| {
        names.contains(&w[0].as_str()) && w[1] == "!" && matches!(w[2].as_str(), "(" | "[" | "{")
    };
    let calls = tokens.windows(3).filter(called);
    calls.map(|w| w[0].clone()).collect()
}
