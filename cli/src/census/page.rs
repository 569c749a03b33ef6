//! The page: one file with a row for every mesh, to be sorted and filtered.

use std::path::Path;

use roundel::{Error, Result};

use super::row::{Outcome, Row};
use crate::page::{STYLE, command_line, escaped, filled};
use crate::summary::thousands;

const PAGE: &str = include_str!("page.html");
const OWN_STYLE: &str = include_str!("page.css");
const SCRIPT: &str = include_str!("page.js");

/// The columns after the picture.
const COLUMNS: [&str; 11] = [
    "mesh",
    "outcome",
    "repair",
    "triangles",
    "quads",
    "irregular",
    "scaled Jacobian, least",
    "turned over",
    "distance, % of diagonal",
    "seconds",
    "memory, MB",
];

/// Writes the page.
///
/// # Errors
/// [`Error::Io`] for a file that cannot be written.
pub(super) fn write(path: &Path, folder: &Path, flags: &[String], rows: &[Row]) -> Result<()> {
    let text = text(folder, flags, rows);
    std::fs::write(path, text).map_err(|reason| Error::Io {
        message: format!("{}: {reason}", path.display()),
    })
}

fn text(folder: &Path, flags: &[String], rows: &[Row]) -> String {
    let name = match folder.file_name() {
        Some(name) => name.to_string_lossy().into_owned(),
        None => folder.to_string_lossy().into_owned(),
    };
    let words = ["quad", "MESH"].map(String::from).into_iter();
    let command = command_line(words.chain(flags.iter().cloned()));
    let heads = COLUMNS.map(|name| format!("<th><button type=\"button\">{name}</button></th>"));
    let parts = [
        ("VERSION", env!("CARGO_PKG_VERSION")),
        ("TITLE", &escaped(&name)),
        ("SUMMARY", &escaped(&summary(rows))),
        ("STYLE", &format!("{STYLE}{OWN_STYLE}")),
        ("OUTCOMES", &outcomes(rows)),
        ("HEAD", &format!("<th></th>{}", heads.concat())),
        ("ROWS", &rows.iter().map(html).collect::<String>()),
        ("COMMAND", &escaped(&command)),
        ("SCRIPT", SCRIPT),
    ];
    filled(PAGE, &parts)
}

fn summary(rows: &[Row]) -> String {
    let quads = rows
        .iter()
        .filter(|row| row.outcome == Outcome::Quads)
        .count();
    let seconds: f64 = rows.iter().map(|row| row.seconds).sum();
    format!(
        "{} of {} meshes became quads; {seconds:.0} seconds in all",
        thousands(quads),
        thousands(rows.len())
    )
}

/// A button for every outcome that there is.
fn outcomes(rows: &[Row]) -> String {
    let mut buttons = format!(
        "<button type=\"button\" value=\"\" aria-pressed=\"true\">all {}</button>",
        thousands(rows.len())
    );
    for outcome in Outcome::ALL {
        let count = rows.iter().filter(|row| row.outcome == outcome).count();
        if count > 0 {
            let (name, words) = (outcome.name(), outcome.words());
            let count = thousands(count);
            buttons += &format!(
                "\n<button type=\"button\" value=\"{name}\" aria-pressed=\"false\">{words} {count}</button>"
            );
        }
    }
    buttons
}

fn html(row: &Row) -> String {
    let figures = &row.figures;
    let picture = match &figures.thumbnail {
        Some(png) => format!(
            "<img loading=\"lazy\" width=\"200\" height=\"150\" alt=\"quads of {}\" src=\"data:image/png;base64,{png}\"/>",
            escaped(&row.name)
        ),
        None => String::new(),
    };
    let outcome = match &figures.message {
        Some(message) => format!("{}: {message}", row.outcome.words()),
        None => row.outcome.words().into(),
    };
    let repair = figures.repair.iter();
    let repair = repair.map(|(kind, count)| format!("{} {count}", kind.replace('_', " ")));
    let repair = repair.collect::<Vec<_>>().join(", ");
    let count = |n: Option<u64>| number(n.map(|n| n as f64), n.map(|n| thousands(n as usize)));
    let real = |x: Option<f64>, digits: usize| number(x, x.map(|x| format!("{x:.digits$}")));
    let cells = [
        format!("<td>{picture}</td>"),
        format!("<td>{}</td>", escaped(&row.name)),
        format!("<td>{}</td>", escaped(&outcome)),
        format!("<td>{}</td>", escaped(&repair)),
        count(figures.triangles),
        count(figures.quads),
        count(figures.irregular_vertices),
        real(figures.scaled_jacobian_min, 3),
        count(figures.inverted),
        real(figures.distance.map(|share| 100.0 * share), 3),
        real(Some(row.seconds), 2),
        real(figures.peak_memory_bytes.map(|bytes| bytes as f64 / 1e6), 0),
    ];
    format!(
        "<tr class=\"{}\">{}</tr>\n",
        row.outcome.name(),
        cells.concat()
    )
}

/// A cell of a number, which may not be there.
fn number(value: Option<f64>, text: Option<String>) -> String {
    let value = value.map_or(String::new(), |value| value.to_string());
    format!(
        "<td data-value=\"{value}\">{}</td>",
        text.unwrap_or_default()
    )
}

#[cfg(test)]
mod tests {
    use super::super::meshes::MeshFile;
    use super::*;

    fn row(name: &str, outcome: Outcome) -> Row {
        let mesh = MeshFile {
            name: name.into(),
            path: name.into(),
            bytes: 1,
            modified: 0,
        };
        Row::new(&mesh, &[], outcome, 1.5)
    }

    #[test]
    fn rows_have_their_values_and_texts_are_escaped() {
        let mut good = row("a<b>.obj", Outcome::Quads);
        good.figures.quads = Some(1234);
        let mut bad = row("b.off", Outcome::Refused);
        bad.figures.message = Some("1 < 2".into());
        let html = text(
            Path::new("some/folder"),
            &["--quads".into(), "9".into()],
            &[good, bad],
        );
        for part in [
            "<title>folder – census</title>",
            "<p>1 of 2 meshes became quads; 3 seconds in all</p>",
            "<td>a&lt;b&gt;.obj</td>",
            "<td data-value=\"1234\">1,234</td>",
            "<td>refused: 1 &lt; 2</td>",
            "<td data-value=\"\"></td>",
            "value=\"refused\" aria-pressed=\"false\">refused 1</button>",
            "<code>roundel quad MESH --quads 9</code>",
        ] {
            assert!(html.contains(part), "{part}");
        }
        assert!(!html.contains("crashed 0"));
    }
}
