//! `--report`: the page of a run, one file for a browser that needs neither network nor library.
//!
//! Figures are tables, so that they are there without scripts. Meshes go along as arrays in base64, and
//! `scripts` draws them by WebGL.

mod arrays;
mod distances;
mod rows;
mod scene;
mod tables;

use std::path::Path;

use roundel::{Error, Result};

pub use distances::distances;
pub use rows::{
    Rows, bound, gap, histogram, mesh_rows, quad_rows, seconds_rows, solve_rows, valences,
};
pub use scene::Scene;
pub use tables::Tables;

const PAGE: &str = include_str!("page.html");
/// The style of all pages.
pub const STYLE: &str = include_str!("page.css");

/// In the order of the page, where they share one scope.
const SCRIPTS: [&str; 15] = [
    include_str!("scripts/vectors.js"),
    include_str!("scripts/model.js"),
    include_str!("scripts/measures.js"),
    include_str!("scripts/colours.js"),
    include_str!("scripts/camera.js"),
    include_str!("scripts/shaders.js"),
    include_str!("scripts/gpu.js"),
    include_str!("scripts/surface.js"),
    include_str!("scripts/crosses.js"),
    include_str!("scripts/numbers.js"),
    include_str!("scripts/view.js"),
    include_str!("scripts/pick.js"),
    include_str!("scripts/histogram.js"),
    include_str!("scripts/gestures.js"),
    include_str!("scripts/panel.js"),
];
const MAIN: &str = include_str!("scripts/main.js");

/// What a page tells and draws.
pub struct Page<'a> {
    /// The mesh, as the command line names it.
    pub mesh: &'a Path,
    /// What came out, in one line.
    pub summary: String,
    /// The figures.
    pub tables: Tables,
    /// What is drawn.
    pub scene: Scene,
}

impl Page<'_> {
    /// Writes the page.
    ///
    /// # Errors
    /// [`Error::Io`] for a file that cannot be written.
    pub fn write(&self, path: &Path) -> Result<()> {
        let failed = |reason: String| Error::Io {
            message: format!("{}: {reason}", path.display()),
        };
        let text = self.text().map_err(|error| failed(error.to_string()))?;
        std::fs::write(path, text).map_err(|error| failed(error.to_string()))
    }

    fn text(&self) -> serde_json::Result<String> {
        let mut scene = serde_json::to_value(&self.scene)?;
        scene["name"] = stem(self.mesh).into();
        // A text in it could end the script.
        let data = serde_json::to_string(&scene)?.replace('<', "\\u003c");
        let script = SCRIPTS.concat() + MAIN;
        let parts = [
            ("VERSION", env!("CARGO_PKG_VERSION")),
            ("TITLE", &escaped(&title(self.mesh))),
            ("SUMMARY", &escaped(&self.summary)),
            ("COMMAND", &escaped(&command_line(std::env::args().skip(1)))),
            ("STYLE", STYLE),
            ("TABLES", self.tables.html()),
            ("SCRIPT", &script),
            ("DATA", &data),
        ];
        Ok(filled(PAGE, &parts))
    }
}

/// The page with its marks `@NAME@` replaced; what replaces one is not looked through again.
pub fn filled(page: &str, parts: &[(&str, &str)]) -> String {
    let mut out = String::new();
    for (i, piece) in page.split('@').enumerate() {
        match parts.iter().find(|(name, _)| i % 2 == 1 && *name == piece) {
            Some((_, text)) => out.push_str(text),
            None => out.push_str(piece),
        }
    }
    out
}

/// The name of a file without its folders, or a shape's.
fn title(mesh: &Path) -> String {
    match mesh.file_name() {
        Some(name) => name.to_string_lossy().into_owned(),
        None => mesh.to_string_lossy().into_owned(),
    }
}

/// How files that the page saves begin.
fn stem(mesh: &Path) -> String {
    let title = title(mesh);
    let title = title.strip_prefix("shape:").unwrap_or(&title);
    let stem = title.split('.').find(|part| !part.is_empty());
    let is_plain = |c: char| c.is_alphanumeric() || c == '_' || c == '-';
    let plain = |c: char| if is_plain(c) { c } else { '-' };
    stem.unwrap_or("mesh").chars().map(plain).collect()
}

/// The words of the command line, as a shell reads them.
pub fn command_line(words: impl Iterator<Item = String>) -> String {
    let is_plain = |c: char| c.is_alphanumeric() || "_-./:,=+%@".contains(c);
    let quoted = words.map(
        |word| match !word.is_empty() && word.chars().all(is_plain) {
            true => word,
            false => format!("'{}'", word.replace('\'', r"'\''")),
        },
    );
    let words: Vec<String> = std::iter::once("roundel".into()).chain(quoted).collect();
    words.join(" ")
}

/// A text as HTML.
pub fn escaped(text: &str) -> String {
    let text = text.replace('&', "&amp;").replace('<', "&lt;");
    text.replace('>', "&gt;").replace('"', "&quot;")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn marks_are_replaced_and_their_texts_left_alone() {
        let parts = [("A", "@B@ and @"), ("B", "two")];
        assert_eq!(filled("<@A@> <@B@>", &parts), "<@B@ and @> <two>");
    }

    #[test]
    fn the_page_has_no_other_mark() {
        let marks = PAGE.split('@').skip(1).step_by(2);
        let known = "VERSION TITLE SUMMARY COMMAND STYLE TABLES SCRIPT DATA";
        let mut count = 0;
        for mark in marks {
            assert!(known.split(' ').any(|name| name == mark), "{mark}");
            count += 1;
        }
        assert_eq!(count, 10);
    }

    #[test]
    fn a_command_line_can_be_pasted_into_a_shell() {
        let words = ["quad", "my mesh.obj", "--quads", "800", "it's", ""];
        let line = command_line(words.map(String::from).into_iter());
        assert_eq!(line, r"roundel quad 'my mesh.obj' --quads 800 'it'\''s' ''");
    }

    #[test]
    fn saved_files_are_named_after_the_mesh() {
        let cases = [
            ("folder/bunny.obj.gz", "bunny"),
            ("shape:gear:4000", "gear-4000"),
            ("-", "-"),
            ("..", "mesh"),
            ("a b.ply", "a-b"),
        ];
        for (mesh, name) in cases {
            assert_eq!(stem(Path::new(mesh)), name);
        }
    }
}
