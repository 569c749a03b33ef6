//! The pages of the book and their fenced blocks.

use std::fs;
use std::path::{Path, PathBuf};

/// A fenced block of a page.
pub struct Block {
    /// The page, from the root of the repository.
    pub page: String,
    /// The line of its fence, counted from 1.
    pub line: usize,
    /// The word behind the fence.
    pub language: String,
    /// What is between the fences.
    pub text: String,
    /// The `text` block that follows, where nothing but the word "prints" stands in between.
    pub prints: Option<String>,
}

impl Block {
    /// Where a reader finds it.
    pub fn place(&self) -> String {
        format!("{}:{}", self.page, self.line)
    }
}

/// The root of the repository, from the package that is tested.
pub fn root() -> PathBuf {
    let package = Path::new(env!("CARGO_MANIFEST_DIR"));
    match package.ends_with("cli") {
        true => package.join(".."),
        false => package.into(),
    }
}

/// The README, the pages of docs, and the pages beside the sources of bindings and plugins.
pub fn pages() -> Vec<(String, String)> {
    let mut names: Vec<String> = fs::read_dir(root().join("docs"))
        .unwrap()
        .map(|entry| entry.unwrap().file_name().into_string().unwrap())
        .filter(|name| name.ends_with(".md"))
        .map(|name| format!("docs/{name}"))
        .collect();
    names.sort();
    for name in [
        "README.md",
        "CONTRIBUTING.md",
        "SECURITY.md",
        "bindings/python/README.md",
        "plugins/meshlab/README.md",
    ] {
        names.push(name.into());
    }
    let read = |name: String| {
        let text = fs::read_to_string(root().join(&name)).unwrap();
        (name, text)
    };
    names.into_iter().map(read).collect()
}

/// The blocks of all pages, in order.
pub fn blocks() -> Vec<Block> {
    let all = pages();
    all.iter()
        .flat_map(|(page, text)| blocks_of(page, text))
        .collect()
}

fn blocks_of(page: &str, text: &str) -> Vec<Block> {
    let mut blocks: Vec<Block> = Vec::new();
    let mut between: Vec<&str> = Vec::new();
    let mut lines = (1..).zip(text.lines());
    while let Some((line, content)) = lines.next() {
        let Some(language) = content.strip_prefix("```") else {
            if !content.is_empty() {
                between.push(content);
            }
            continue;
        };
        let body: Vec<&str> = lines
            .by_ref()
            .map(|(_, content)| content)
            .take_while(|content| *content != "```")
            .collect();
        let text = body.join("\n") + "\n";
        if language == "text"
            && between == ["prints"]
            && let Some(before) = blocks.last_mut()
        {
            before.prints = Some(text.clone());
        }
        blocks.push(Block {
            page: page.into(),
            line,
            language: language.into(),
            text,
            prints: None,
        });
        between.clear();
    }
    blocks
}
