//! Polylines in space from an OBJ file: its vertices and line elements, whatever else it holds.

use std::fs;
use std::path::Path;

use roundel::mesh::vector::Vec3;
use roundel::{Error, Result};

use crate::output::io_error;

/// The polylines of a file, in its order.
///
/// # Errors
/// [`Error::Io`], and [`Error::Parse`] with the line.
pub fn read(path: &Path) -> Result<Vec<Vec<Vec3>>> {
    let text = fs::read_to_string(path);
    let text = text.map_err(|reason| io_error(&path.to_string_lossy(), &reason))?;
    parse(&text)
}

fn parse(text: &str) -> Result<Vec<Vec<Vec3>>> {
    let (mut vertices, mut lines) = (Vec::new(), Vec::new());
    for (number, line) in text.lines().enumerate() {
        let mut words = line.split('#').next().unwrap_or("").split_whitespace();
        let kind = words.next();
        let parsed = match kind {
            Some("v") => position(words).map(|p| vertices.push(p)),
            Some("l") => polyline(words, &vertices).map(|l| lines.push(l)),
            _ => Ok(()),
        };
        parsed.map_err(|message| Error::Parse {
            line: number + 1,
            message,
        })?;
    }
    Ok(lines)
}

fn position<'a>(words: impl Iterator<Item = &'a str>) -> std::result::Result<Vec3, String> {
    let parsed = words.take(3).map(str::parse);
    let numbers: Vec<f64> = parsed
        .collect::<std::result::Result<_, _>>()
        .map_err(|_| "a coordinate is not a number")?;
    let found = numbers.try_into();
    found.map_err(|_| "a vertex has three coordinates".into())
}

/// The positions that a line element names: from 1 on, or from -1 backwards.
fn polyline<'a>(
    words: impl Iterator<Item = &'a str>,
    vertices: &[Vec3],
) -> std::result::Result<Vec<Vec3>, String> {
    let place = |word: &str| {
        let number: i64 = word.split('/').next()?.parse().ok()?;
        let index = match number {
            1.. => usize::try_from(number - 1).ok()?,
            _ => vertices.len().checked_sub(usize::try_from(-number).ok()?)?,
        };
        vertices.get(index).copied()
    };
    let found: Vec<Vec3> = words
        .map(|word| place(word).ok_or_else(|| format!("there is no vertex {word}")))
        .collect::<std::result::Result<_, _>>()?;
    match found.is_empty() {
        true => Err("a line has no vertices".into()),
        false => Ok(found),
    }
}

#[cfg(test)]
mod tests {
    use super::parse;

    #[test]
    fn lines_name_vertices_from_both_ends() {
        let text = "v 0 0 0\nv 1 0 0 # right\nf 1 2 1\nl 1/1 2 -2\nv 0 1 0\nl -1 1\n";
        let [a, b, c] = [[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]];
        assert_eq!(parse(text).unwrap(), [vec![a, b, a], vec![c, a]]);
    }

    #[test]
    fn vertices_that_are_not_there_are_refused() {
        for text in [
            "l 1",
            "v 0 0 0\nl 0",
            "v 0 0 0\nl -2",
            "v 0 0 0\nl",
            "v 0 0 0\nl x",
        ] {
            assert!(parse(text).is_err(), "{text}");
        }
    }
}
