//! Results of other mixed-integer solvers on the same MPS files, from the CSV file of
//! `scripts/other-solvers`, as a table of the page.

use std::fmt::Write;
use std::fs;
use std::path::Path;

use roundel::{Error, Result};

use super::escape::escape;
use crate::output;

/// The columns of the file, in its order.
const HEADS: [&str; 8] = [
    "problem",
    "solver",
    "version",
    "status",
    "energy",
    "lower_bound",
    "gap",
    "seconds",
];

/// The lines of such a file, one text a column.
#[derive(Debug, PartialEq)]
pub struct Others(Vec<Vec<String>>);

/// Reads the file at `path`.
pub fn read(path: &Path) -> Result<Others> {
    let text = fs::read_to_string(path)
        .map_err(|reason| output::io_error(&path.to_string_lossy(), &reason))?;
    parse(&text).map_err(|(line, reason)| Error::Io {
        message: format!("{}: line {line}: {reason}", path.display()),
    })
}

/// The lines of `text`, or which line is at fault and why.
fn parse(text: &str) -> std::result::Result<Others, (usize, String)> {
    let mut lines = text.lines().enumerate();
    let heads = lines.next().map(|(_, line)| fields(line));
    if heads.is_none_or(|heads| heads != HEADS) {
        return Err((1, format!("expected the columns {}", HEADS.join(","))));
    }
    let row = |(at, line): (usize, &str)| {
        let row = fields(line);
        if row.len() != HEADS.len() {
            return Err((at + 1, format!("expected 8 columns, found {}", row.len())));
        }
        let number = |field: &&String| !field.is_empty() && field.parse::<f64>().is_err();
        match row[4..].iter().find(number) {
            Some(field) => Err((at + 1, format!("{field:?} is not a number"))),
            None => Ok(row),
        }
    };
    lines
        .map(row)
        .collect::<std::result::Result<_, _>>()
        .map(Others)
}

/// The fields of a line; commas between quotes are text, and a quote in text is doubled.
fn fields(line: &str) -> Vec<String> {
    let mut fields = vec![String::new()];
    let mut quoted = false;
    let mut characters = line.chars().peekable();
    while let Some(c) = characters.next() {
        let field = fields.last_mut().expect("there is always one");
        match c {
            '"' if quoted && characters.next_if_eq(&'"').is_some() => field.push('"'),
            '"' => quoted = !quoted,
            ',' if !quoted => fields.push(String::new()),
            c => field.push(c),
        }
    }
    fields
}

/// The section of the page.
pub fn html(others: &Others) -> String {
    let heads: String = [
        "problem",
        "solver",
        "energy",
        "lower bound",
        "gap, %",
        "seconds",
        "status",
    ]
    .map(|head| format!("<th>{head}</th>"))
    .concat();
    let mut text = format!(
        "<h2>Other solvers</h2>\n<p>The same MPS files, one thread and one time limit for all; energies \
         recomputed from the values that came back (scripts/other-solvers).</p>\n\
         <table>\n<tr>{heads}</tr>\n"
    );
    for (i, row) in others.0.iter().enumerate() {
        let first = i == 0 || others.0[i - 1][0] != row[0];
        let ours = row[1].starts_with("roundel");
        let classes = match (first, ours) {
            (true, true) => "first",
            (true, false) => "first reference",
            (false, true) => "",
            (false, false) => "reference",
        };
        let problem = if first { &row[0] } else { "" };
        let solver = format!("{} {}", row[1], row[2]);
        let gap = row[6]
            .parse()
            .map_or_else(|_| String::new(), |gap: f64| format!("{:.3}", 100.0 * gap));
        let cells = [
            problem,
            solver.trim_end(),
            &shortened(&row[4], 6),
            &shortened(&row[5], 6),
            &gap,
            &shortened(&row[7], 2),
            &row[3],
        ];
        let cells: String = cells
            .map(|cell| format!("<td>{}</td>", escape(cell)))
            .concat();
        let _ = writeln!(text, "<tr class=\"{classes}\">{cells}</tr>");
    }
    text + "</table>\n"
}

/// A number with this many decimals; empty text stays empty.
fn shortened(number: &str, decimals: usize) -> String {
    let number = number.parse();
    number.map_or_else(|_| String::new(), |v: f64| format!("{v:.decimals$}"))
}

#[cfg(test)]
mod tests {
    use super::*;

    const HEAD: &str = "problem,solver,version,status,energy,lower_bound,gap,seconds\n";

    #[test]
    fn a_file_becomes_a_table_with_what_is_not_known_left_empty() {
        let text = format!(
            "{HEAD}a,roundel exact,1,optimal,2,2,0,0.5\na,x,3,\"error: <a>, \"\"b\"\"\",,1.5,,\n"
        );
        let page = html(&parse(&text).unwrap());
        let ours = "<tr class=\"first\"><td>a</td><td>roundel exact 1</td><td>2.000000</td>";
        assert!(page.contains(ours), "{page}");
        let other = "<td></td><td>x 3</td><td></td><td>1.500000</td><td></td><td></td>";
        assert!(page.contains(other), "{page}");
        assert!(
            page.contains("<td>error: &lt;a&gt;, &quot;b&quot;</td>"),
            "{page}"
        );
    }

    #[test]
    fn a_file_of_another_kind_is_refused_with_its_line() {
        assert_eq!(parse("").unwrap_err().0, 1);
        assert_eq!(parse("a,b\n").unwrap_err().0, 1);
        assert_eq!(parse(&format!("{HEAD}a,b\n")).unwrap_err().0, 2);
        let error = parse(&format!("{HEAD}a,b,c,d,1,,,\na,b,c,d,much,,,\n")).unwrap_err();
        assert_eq!(error, (3, "\"much\" is not a number".into()));
    }
}
