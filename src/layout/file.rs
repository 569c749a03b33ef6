//! Layout files: OBJ with vertices, polygons, and lines for the arcs whose course is given.
//!
//! Vertices that polygons use come first; a line starts and ends at two of them that an edge joins, and runs over
//! further vertices in between. All other elements are left out.

use std::fs;
use std::path::Path;

use super::base_layout::BaseLayout;
use crate::error::{Error, Result};
use crate::mesh::vector::Vec3;

/// A layout, and the arcs whose course is given: the arc, and points from its first end to its second.
#[derive(Debug, Clone, PartialEq)]
pub struct LayoutFile {
    /// The layout.
    pub layout: BaseLayout,
    /// The courses, as [`LayoutOptions::curves`](super::LayoutOptions::curves) takes them.
    pub curves: Vec<(usize, Vec<Vec3>)>,
}

/// Reads a layout.
///
/// # Errors
/// [`Error::Io`], [`Error::Parse`] with the line, and those of [`BaseLayout::new`].
pub fn read_layout(path: impl AsRef<Path>) -> Result<LayoutFile> {
    let path = path.as_ref();
    let text = fs::read_to_string(path).map_err(|reason| Error::Io {
        message: format!("{}: {reason}", path.display()),
    })?;
    parse_layout(&text)
}

/// Reads a layout from the text of a file.
///
/// # Errors
/// As [`read_layout`], without [`Error::Io`].
pub fn parse_layout(text: &str) -> Result<LayoutFile> {
    let (mut positions, mut polygons, mut lines) = (Vec::new(), Vec::new(), Vec::new());
    for (number, line) in text.lines().enumerate() {
        let line_number = number + 1;
        let mut words = line.split('#').next().unwrap_or("").split_whitespace();
        let parsed = match words.next() {
            Some("v") => position(words).map(|p| positions.push(p)),
            Some("f") => corners(words, positions.len()).map(|f| polygons.push(f)),
            Some("l") => corners(words, positions.len()).map(|l| lines.push((line_number, l))),
            _ => Ok(()),
        };
        parsed.map_err(|message| Error::Parse {
            line: line_number,
            message,
        })?;
    }
    let used = polygons
        .iter()
        .flatten()
        .max()
        .map_or(0, |&v: &u32| v as usize + 1);
    let layout = BaseLayout::new(positions[..used].to_vec(), polygons)?;
    let mut curves = Vec::with_capacity(lines.len());
    for (line, corners) in lines {
        let refuse = |message: &str| {
            Err(Error::Parse {
                line,
                message: message.into(),
            })
        };
        let [from, .., to] = corners.as_slice() else {
            return refuse("a line has two vertices or more");
        };
        let Some(arc) = layout.arc_between(*from as usize, *to as usize) else {
            return refuse("a line starts and ends at vertices that an edge of the layout joins");
        };
        let mut points: Vec<Vec3> = corners.iter().map(|&v| positions[v as usize]).collect();
        if layout.arcs()[arc][0] != *from {
            points.reverse();
        }
        curves.push((arc, points));
    }
    Ok(LayoutFile { layout, curves })
}

fn position<'a>(words: impl Iterator<Item = &'a str>) -> std::result::Result<Vec3, String> {
    let parsed: std::result::Result<Vec<f64>, _> = words.take(3).map(str::parse).collect();
    let numbers = parsed.map_err(|_| "a coordinate is not a number")?;
    let found = numbers.try_into();
    found.map_err(|_| "a vertex has three coordinates".into())
}

/// Numbers of vertices from 0 on; in the file they count from 1, or from -1 backwards.
fn corners<'a>(
    words: impl Iterator<Item = &'a str>,
    count: usize,
) -> std::result::Result<Vec<u32>, String> {
    let corner = |word: &str| {
        let number: i64 = word.split('/').next()?.parse().ok()?;
        let index = match number {
            1.. => number - 1,
            _ => i64::try_from(count).ok()? + number,
        };
        let index = u32::try_from(index).ok()?;
        ((index as usize) < count && number != 0).then_some(index)
    };
    words
        .map(|word| {
            corner(word).ok_or_else(|| format!("'{word}' is not a vertex that comes before"))
        })
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    const SQUARE: &str = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 0.5 -0.1 0\nf 1/1 2 3//3 -2\n";

    #[test]
    fn polygons_and_given_courses_are_read() {
        let text = format!("# a layout\no name\n{SQUARE}l 2 5 1\nl 3 4\n");
        let file = parse_layout(&text).unwrap();
        assert_eq!(file.layout.polygons(), [vec![0, 1, 2, 3]]);
        assert_eq!(file.layout.vertex_count(), 4);
        assert_eq!(file.curves.len(), 2);
        assert_eq!(
            file.curves[0],
            (0, vec![[0.0; 3], [0.5, -0.1, 0.0], [1.0, 0.0, 0.0]])
        );
    }

    #[test]
    fn faults_are_told_with_their_line() {
        for (text, line) in [
            ("v 0 0\n", 1),
            ("v 0 0 x\n", 1),
            ("v 0 0 0\nf 1 2 3\n", 2),
            ("v 0 0 0\nf 0 1 1\n", 2),
            (&format!("{SQUARE}l 1 3\n"), 7),
            (&format!("{SQUARE}l 1\n"), 7),
        ] {
            let error = parse_layout(text).unwrap_err();
            assert!(
                matches!(error, Error::Parse { line: l, .. } if l == line),
                "{error}"
            );
        }
        assert!(read_layout("there/is/no/such.obj").is_err());
    }
}
