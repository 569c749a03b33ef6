//! What the book names is there: functions, papers, files, pages.

use std::collections::BTreeSet;
use std::fs;
use std::path::{Path, PathBuf};

use roundel::search::PRESETS;

use crate::page::{pages, root};

const BIBLIOGRAPHY: &str = include_str!("../../docs/references.bib");

/// The README has no more lines.
const README_LINES: usize = 160;

fn page(name: &str) -> String {
    fs::read_to_string(root().join(name)).unwrap()
}

/// The lines outside of blocks.
fn prose(text: &str) -> impl Iterator<Item = &str> {
    let mut in_block = false;
    text.lines().filter(move |line| {
        let is_fence = line.starts_with("```");
        in_block ^= is_fence;
        !in_block && !is_fence
    })
}

/// What stands between single backquotes.
fn quoted(text: &str) -> Vec<&str> {
    prose(text)
        .flat_map(|line| line.split('`').skip(1).step_by(2))
        .collect()
}

#[test]
fn the_readme_is_short() {
    assert!(page("README.md").lines().count() <= README_LINES);
}

#[test]
fn every_link_leads_somewhere() {
    let mut count = 0;
    for (name, text) in pages() {
        let folder = root().join(&name);
        let folder = folder.parent().unwrap();
        for target in prose(&text).flat_map(|line| line.split("](").skip(1)) {
            let target = target.split(')').next().unwrap();
            if target.starts_with("http") {
                continue;
            }
            let (file, heading) = target.split_once('#').unwrap_or((target, ""));
            let path = match file.is_empty() {
                true => root().join(&name),
                false => folder.join(file),
            };
            assert!(path.exists(), "{name}: {target}");
            if !heading.is_empty() {
                let text = fs::read_to_string(&path).unwrap();
                let has = text
                    .lines()
                    .filter(|l| l.starts_with('#'))
                    .any(|l| anchor(l) == heading);
                assert!(has, "{name}: {target}");
            }
            count += 1;
        }
    }
    assert!(count > 100);
}

/// A heading as links name it.
fn anchor(heading: &str) -> String {
    let text = heading.trim_start_matches('#').trim().to_lowercase();
    let kept = text
        .chars()
        .filter(|c| c.is_alphanumeric() || " -_".contains(*c));
    kept.collect::<String>().replace(' ', "-")
}

#[test]
fn the_contents_name_every_page() {
    let contents = page("docs/README.md");
    for (name, _) in pages() {
        if let Some(file) = name
            .strip_prefix("docs/")
            .filter(|file| *file != "README.md")
        {
            assert!(contents.contains(&format!("({file})")), "{name}");
        }
    }
}

#[test]
fn the_map_of_the_house_names_every_folder() {
    let map = page("CONTRIBUTING.md");
    let mut count = 0;
    for entry in fs::read_dir(root().join("src")).unwrap() {
        let entry = entry.unwrap();
        if entry.path().is_dir() {
            let row = format!("| `src/{}` |", entry.file_name().to_str().unwrap());
            assert!(map.contains(&row), "{row}");
            count += 1;
        }
    }
    assert!(count > 20);
}

#[test]
fn pictures_are_small() {
    let mut count = 0;
    for entry in fs::read_dir(root().join("docs/pictures")).unwrap() {
        assert!(entry.unwrap().metadata().unwrap().len() < 400_000);
        count += 1;
    }
    assert!(count > 0);
}

#[test]
fn every_function_of_c_is_in_the_header() {
    let header = page("include/roundel/roundel.h");
    let words = |text: &str| -> BTreeSet<String> {
        let is_name = |c: char| c.is_ascii_alphanumeric() || c == '_';
        let all = text.split(|c| !is_name(c));
        all.filter(|w| w.starts_with("roundel_"))
            .map(String::from)
            .collect()
    };
    let known = words(&header);
    let mut count = 0;
    for (name, text) in pages() {
        // That page names functions of CoMISo's classes.
        if name == "docs/comiso.md" {
            continue;
        }
        // A target of CMake, and names of which only the beginning is given.
        let is_function = |word: &String| !word.ends_with('_') && word != "roundel_static";
        for word in quoted(&text)
            .iter()
            .flat_map(|q| words(q))
            .filter(is_function)
        {
            assert!(known.contains(&word), "{name}: {word}");
            count += 1;
        }
    }
    assert!(count > 30);
}

#[test]
fn every_source_that_is_named_is_there() {
    let mut count = 0;
    // The page of the plugin names MeshLab's sources.
    let is_ours = |name: &str| !name.starts_with("plugins/");
    for (name, text) in pages().into_iter().filter(|(name, _)| is_ours(name)) {
        for word in quoted(&text) {
            let folders = [
                "src/",
                "tests/",
                "cpp_tests/",
                "scripts/",
                "cli/",
                "examples/",
                "fuzz/",
                "packaging/",
            ];
            if folders.iter().any(|folder| word.starts_with(folder)) {
                let path = word.split(' ').next().unwrap();
                assert!(root().join(path).exists(), "{name}: {word}");
                count += 1;
            }
        }
    }
    assert!(count > 50);
}

#[test]
fn every_paper_that_is_cited_is_in_the_bibliography() {
    let entries = keys();
    let mut cited = 0;
    for (name, text) in pages() {
        for word in quoted(&text).into_iter().filter(|word| is_key(word)) {
            assert!(entries.contains(&word), "{name}: {word}");
            cited += 1;
        }
    }
    assert!(cited > 50);
    for path in sources(&root().join("src")) {
        let text = fs::read_to_string(&path).unwrap();
        for word in quoted(&text).into_iter().filter(|word| is_key(word)) {
            assert!(entries.contains(&word), "{}: {word}", path.display());
        }
    }
}

/// Every Rust file of a folder and those in it.
fn sources(folder: &Path) -> Vec<PathBuf> {
    let mut found = Vec::new();
    for entry in fs::read_dir(folder).unwrap() {
        let path = entry.unwrap().path();
        match path.is_dir() {
            true => found.extend(sources(&path)),
            false if path.extension().is_some_and(|e| e == "rs") => found.push(path),
            false => {}
        }
    }
    found
}

#[test]
fn the_bibliography_is_complete_and_in_order() {
    let entries = keys();
    assert!(
        entries.windows(2).all(|pair| pair[0] < pair[1]),
        "{entries:?}"
    );
    for entry in BIBLIOGRAPHY.split("\n@").skip(1) {
        let key = entry.split(['{', ',']).nth(1).unwrap();
        assert!(is_key(key), "{key}");
        let year = &key[key.len() - 4..];
        assert!(entry.contains(&format!("year = {{{year}}}")), "{key}");
        for field in ["author = {", "title = {"] {
            assert!(entry.contains(field), "{key}: no {field}");
        }
    }
}

fn keys() -> Vec<&'static str> {
    let entries = BIBLIOGRAPHY.split("\n@").skip(1);
    entries
        .map(|e| e.split(['{', ',']).nth(1).unwrap())
        .collect()
}

/// An author and a year, such as bommes2009.
fn is_key(word: &str) -> bool {
    let author = word.trim_end_matches(|c: char| c.is_ascii_digit());
    let years = ["18", "19", "20"];
    word.len() == author.len() + 4
        && years.iter().any(|y| word[author.len()..].starts_with(y))
        && author.len() > 1
        && author.chars().all(|c| c.is_ascii_lowercase())
}

#[test]
fn the_table_of_presets_is_complete() {
    let page = page("docs/options.md");
    for preset in PRESETS {
        assert!(page.contains(&format!("| `{}` |", preset.name)));
    }
}

#[test]
fn the_table_of_strategies_is_complete() {
    let page = page("docs/strategies.md");
    assert!(page.contains("## The eight strategies"));
    assert_eq!(roundel::Strategy::ALL.len(), 8);
    for strategy in roundel::Strategy::ALL {
        assert!(page.contains(&format!("\n| `{}`", strategy.name())));
    }
}

#[test]
fn the_table_of_errors_has_every_code() {
    let page = page("docs/errors.md");
    for file in ["src/error.rs", "src/mesh/error.rs"] {
        let source = fs::read_to_string(Path::new(env!("CARGO_MANIFEST_DIR")).join(file)).unwrap();
        let body = source.split("fn code(&self)").nth(1).unwrap();
        let body = body.split("\n    }").next().unwrap();
        let codes: Vec<&str> = body.split('"').skip(1).step_by(2).collect();
        assert!(codes.len() > 10, "{codes:?}");
        for code in codes {
            assert!(page.contains(&format!("`{code}`")), "{code}");
        }
    }
}
