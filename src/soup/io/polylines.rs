//! Polylines of OBJ files: line elements over vertices, such as curves on a surface.

use std::path::Path;

use super::statements::{Statement, Statements, corner_number, words};
use super::{Format, gzip, parse};
use crate::linalg::vector::Vec3;
use crate::soup::SoupError;

/// A line element.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Polyline {
    /// Its line in the file, counted from 1.
    pub line: usize,
    /// Its vertices, counted from 0: one, which is a point, or more.
    pub vertices: Vec<usize>,
}

/// The line elements of an OBJ file with these contents, in its order.
///
/// # Errors
/// [`SoupError::Parse`] for one without vertices, or that names a vertex which does not come before it.
pub fn polylines(bytes: &[u8]) -> Result<Vec<Polyline>, SoupError> {
    let bytes = &gzip::inflated(bytes)?;
    let mut vertices = 0_i64;
    let mut found = Vec::new();
    for (line, statement) in Statements::with_lines(bytes) {
        let said = match statement {
            Statement::Vertex(_) => {
                vertices += 1;
                continue;
            }
            Statement::Line(said) => said,
            _ => continue,
        };
        let refused = |message: String| SoupError::Parse { line, message };
        let vertex = |word: &[u8]| {
            let number = word.split(|&b| b == b'/').next()?;
            let v = corner_number(number, vertices).filter(|&v| v < vertices)?;
            usize::try_from(v).ok()
        };
        let named = words(&said).map(|word| {
            vertex(word).ok_or_else(|| {
                let word = String::from_utf8_lossy(word);
                refused(format!("'{word}' is no vertex that comes before this line"))
            })
        });
        let named: Vec<usize> = named.collect::<Result<_, _>>()?;
        if named.is_empty() {
            return Err(refused("a line needs vertices".into()));
        }
        found.push(Polyline {
            line,
            vertices: named,
        });
    }
    Ok(found)
}

/// The points of the line elements of an OBJ file, in its order.
///
/// # Errors
/// [`SoupError::Io`], and [`SoupError::Parse`] for what [`polylines`] and [`parse`] refuse.
pub fn read_polylines(path: impl AsRef<Path>) -> Result<Vec<Vec<Vec3>>, SoupError> {
    let path = path.as_ref();
    let bytes = std::fs::read(path).map_err(|reason| SoupError::of_file(path, &reason))?;
    let soup = parse(&bytes, Format::Obj)?;
    let points = |line: Polyline| {
        let vertices = line.vertices.into_iter();
        vertices.map(|v| soup.positions()[v]).collect()
    };
    Ok(polylines(&bytes)?.into_iter().map(points).collect())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lines_name_vertices_from_both_ends() {
        let text = b"v 0 0 0\nv 1 0 0 # right\nf 1 2 1\nl 1/1 2 -2\nv 0 1 0\nl -1 \\\n1\nl 2\n";
        let found = polylines(text).unwrap();
        assert_eq!(found[0].vertices, [0, 1, 0]);
        assert_eq!((found[1].line, &found[1].vertices[..]), (6, &[2, 0][..]));
        assert_eq!(found[2].vertices, [1]);
    }

    #[test]
    fn vertices_that_are_not_there_are_refused_with_the_line() {
        for said in ["l 1 0", "l 1 -2", "l", "l 1 x", "l 1 2"] {
            let text = format!("v 0 0 0\n{said}\nv 1 0 0\n");
            let error = polylines(text.as_bytes()).unwrap_err();
            assert!(matches!(error, SoupError::Parse { line: 2, .. }), "{said}");
        }
    }
}
