//! Rows as CSV and as an HTML table.

use super::escape::escape;
use super::experiments::Kind;
use super::row::Row;
use crate::summary::thousands;

/// All columns, for programs: numbers as they are, nothing where nothing is known.
pub fn csv(rows: &[Row]) -> String {
    let mut text = String::from(
        "mesh,stand_in,source,solver,status,faces,integers,continuous,energy,irregular_vertices,\
         factor_nonzeros,seconds,peak_memory_bytes,growth\n",
    );
    for row in rows {
        let fields = [
            row.mesh.clone(),
            row.stand_in.clone().unwrap_or_default(),
            row.source.clone(),
            row.solver.clone(),
            row.status.clone(),
            number(row.faces),
            number(row.integers),
            number(row.continuous),
            number(row.energy),
            number(row.irregular_vertices),
            number(row.factor_nonzeros),
            number(row.seconds),
            number(row.peak_memory_bytes),
            number(row.growth),
        ];
        text += &fields.map(quoted).join(",");
        text += "\n";
    }
    text
}

fn number<T: ToString>(value: Option<T>) -> String {
    value.map(|v| v.to_string()).unwrap_or_default()
}

fn quoted(field: String) -> String {
    match field.contains([',', '"', '\n']) {
        true => format!("\"{}\"", field.replace('"', "\"\"")),
        false => field,
    }
}

/// The columns that say something in a table of this kind, for people.
pub fn html(rows: &[Row], kind: Kind) -> String {
    let mut heads = vec!["mesh", "solver", "integers", "continuous", "energy"];
    heads.extend(match kind {
        Kind::TestBed => ["irregular vertices", "seconds", "peak memory"],
        Kind::Growth => ["seconds", "times the size before", "peak memory"],
        Kind::Ordering => ["entries", "seconds", "peak memory"],
    });
    heads.push("status");
    let heads: String = heads.iter().map(|h| format!("<th>{h}</th>")).collect();
    let mut text = format!("<table>\n<tr>{heads}</tr>\n");
    for (i, row) in rows.iter().enumerate() {
        let is_first = i == 0 || rows[i - 1].mesh != row.mesh;
        text += &html_row(row, kind, is_first);
    }
    text + "</table>\n"
}

fn html_row(row: &Row, kind: Kind, is_first: bool) -> String {
    let mesh = match (is_first, &row.stand_in) {
        (false, _) => String::new(),
        (true, None) => row.mesh.clone(),
        (true, Some(stand_in)) => format!("{} (not there: {stand_in})", row.mesh),
    };
    let memory = row.peak_memory_bytes.map(|b| b as f64 / 1e6);
    let seconds = decimal(row.seconds);
    let count = |value: Option<u64>| value.map(|v| thousands(v as usize)).unwrap_or_default();
    let middle = match kind {
        Kind::TestBed => [count(row.irregular_vertices), seconds],
        Kind::Growth => [seconds, decimal(row.growth)],
        Kind::Ordering => [count(row.factor_nonzeros), seconds],
    };
    let [a, b] = middle;
    let memory = memory.map(|m| format!("{m:.0} MB")).unwrap_or_default();
    let cells = [
        mesh,
        row.label(),
        count(row.integers),
        count(row.continuous),
        decimal(row.energy),
        a,
        b,
        memory,
        row.status.clone(),
    ];
    let cells: String = cells
        .iter()
        .map(|cell| format!("<td>{}</td>", escape(cell)))
        .collect();
    let class = match (is_first, row.is_reference()) {
        (true, _) => "first",
        (false, true) => "reference",
        (false, false) => "ours",
    };
    format!("<tr class=\"{class}\">{cells}</tr>\n")
}

/// Four significant digits.
fn decimal(value: Option<f64>) -> String {
    let Some(value) = value else {
        return String::new();
    };
    let magnitude = if value == 0.0 {
        0.0
    } else {
        value.abs().log10().floor()
    };
    let decimals = (3.0 - magnitude).clamp(0.0, 6.0) as usize;
    format!("{value:.decimals$}")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn four_digits_are_shown_and_not_more() {
        let shown = [0.0, 1.0 / 3.0, 12.3456, 98765.4, 1e-9].map(|x| decimal(Some(x)));
        assert_eq!(shown, ["0.000", "0.3333", "12.35", "98765", "0.000000"]);
    }

    #[test]
    fn csv_fields_with_commas_are_quoted_and_numbers_are_whole() {
        let row = Row {
            solver: "a, \"b\"".into(),
            energy: Some(0.1 + 0.2),
            ..Row::default()
        };
        let text = csv(&[row]);
        assert!(text.contains(",\"a, \"\"b\"\"\",") && text.contains("0.30000000000000004"));
        assert_eq!(text.lines().count(), 2);
    }
}
