//! Problems small enough to know the answer by hand.

/// An MPS file of columns A (continuous), I and J (integers), with these rows, coefficients
/// (`COLUMN ROW VALUE`, objective row `OBJ`), right sides and entries of Q.
pub fn mps(
    rows: &[&str],
    columns: &[(&str, &str, f64)],
    rhs: &[(&str, f64)],
    q: &[(&str, &str, f64)],
) -> String {
    let mut text = String::from("NAME test\nROWS\n N OBJ\n");
    for row in rows {
        text += &format!(" E {row}\n");
    }
    text += "COLUMNS\n";
    for name in ["A", "I", "J"] {
        if name == "I" {
            text += " M1 'MARKER' 'INTORG'\n";
        }
        text += &format!(" {name} OBJ {}\n", sum(columns, name, "OBJ"));
        for row in rows {
            text += &format!(" {name} {row} {}\n", sum(columns, name, row));
        }
    }
    text += " M2 'MARKER' 'INTEND'\nRHS\n";
    for (row, value) in rhs {
        text += &format!(" RHS {row} {value}\n");
    }
    text += "BOUNDS\n FR BND A\n FR BND I\n FR BND J\nQUADOBJ\n";
    for (row, column, value) in q {
        text += &format!(" {row} {column} {value}\n");
    }
    text + "ENDATA\n"
}

fn sum(columns: &[(&str, &str, f64)], column: &str, row: &str) -> f64 {
    let matching = columns.iter().filter(|c| c.0 == column && c.1 == row);
    matching.map(|c| c.2).sum()
}
