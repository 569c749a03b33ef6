//! Layout files: OBJ with vertices, polygons, and lines for the arcs whose course is given.
//!
//! Vertices that polygons use come first; a line starts and ends at two of them that an edge joins, and runs over
//! further vertices in between. All other elements are left out.

use std::path::Path;

use super::base_layout::BaseLayout;
use super::drawn_layout::DrawnLayout;
use crate::error::{Error, Result};
use crate::mesh::MeshError;
use crate::mesh::vector::Vec3;
use crate::soup::io::{Format, parse, polylines};
use crate::soup::{PolygonSoup, SoupError};

/// Reads a layout.
///
/// # Errors
/// Those of [`parse`] and [`polylines`] and of [`BaseLayout::new`], and [`Error::Io`]; [`Error::Parse`] for a line that
/// does not start and end at vertices which an edge of the layout joins.
pub fn read_layout(path: impl AsRef<Path>) -> Result<DrawnLayout> {
    let path = path.as_ref();
    let bytes = std::fs::read(path).map_err(|reason| Error::Io {
        message: format!("{}: {reason}", path.display()),
    })?;
    parse_layout(&bytes)
}

/// Reads a layout from the contents of a file.
///
/// # Errors
/// As [`read_layout`], without [`Error::Io`].
pub fn parse_layout(bytes: &[u8]) -> Result<DrawnLayout> {
    let refused = |error: SoupError| Error::from(MeshError::from(error));
    let soup = parse(bytes, Format::Obj).map_err(refused)?;
    let lines = polylines(bytes).map_err(refused)?;
    let layout = BaseLayout::from_soup(&without_further_vertices(&soup))?;
    let mut curves = Vec::with_capacity(lines.len());
    for line in lines {
        let (from, to) = (line.vertices[0], line.vertices[line.vertices.len() - 1]);
        let arc = layout.arc_between(from, to).ok_or_else(|| Error::Parse {
            line: line.line,
            message: format!("no edge of the layout joins vertices {from} and {to}, where the line starts and ends"),
        })?;
        let mut points: Vec<Vec3> = line.vertices.iter().map(|&v| soup.positions()[v]).collect();
        if layout.arcs()[arc][0] as usize != from {
            points.reverse();
        }
        curves.push((arc, points));
    }
    Ok(DrawnLayout { layout, curves })
}

/// The soup without the vertices after the last that a polygon uses: points of lines.
fn without_further_vertices(soup: &PolygonSoup) -> PolygonSoup {
    let used = soup
        .corners()
        .iter()
        .max()
        .map_or(0, |&v| v.saturating_add(1));
    let used = usize::try_from(used)
        .unwrap_or(0)
        .min(soup.positions().len());
    let mut kept = PolygonSoup::new(soup.positions()[..used].to_vec());
    for polygon in soup.polygons() {
        kept.add_polygon(polygon.iter().copied());
    }
    kept
}

#[cfg(test)]
mod tests {
    use super::*;

    const SQUARE: &str =
        "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 0.5 -0.1 0\nvt 0 0\nf 1/1 2 3//3 -2\n";

    #[test]
    fn polygons_and_given_courses_are_read() {
        let text = format!("# a layout\no name\n{SQUARE}l 2 5 1\nl 3 4\n");
        let file = parse_layout(text.as_bytes()).unwrap();
        assert_eq!(file.layout.polygons(), [vec![0, 1, 2, 3]]);
        assert_eq!(file.layout.vertex_count(), 4);
        assert_eq!(file.curves.len(), 2);
        let points = vec![[0.0; 3], [0.5, -0.1, 0.0], [1.0, 0.0, 0.0]];
        assert_eq!(file.curves[0], (0, points));
    }

    #[test]
    fn what_is_written_is_read() {
        let text = format!("{SQUARE}l 2 5 1\nl 3 4\n");
        let file = parse_layout(text.as_bytes()).unwrap();
        let path = std::env::temp_dir().join(format!("roundel-layout-{}.obj", std::process::id()));
        file.write_obj(&path).unwrap();
        let read = read_layout(&path);
        std::fs::remove_file(&path).unwrap();
        assert_eq!(read.unwrap(), file);
        assert_eq!(
            file.write_obj("no/such.obj".as_ref()).unwrap_err().code(),
            "io"
        );
    }

    #[test]
    fn faults_are_told() {
        for (text, code) in [
            ("v 0 0 zero\nf 1 1 1\n", "parse"),
            ("v 0 0 0\nf 1 2 3\n", "index_out_of_range"),
            ("v 0 0 0\n", "invalid_argument"),
            (&format!("{SQUARE}l 1 3\n"), "parse"),
            (&format!("{SQUARE}l 1\n"), "parse"),
        ] {
            let error = parse_layout(text.as_bytes()).unwrap_err();
            assert_eq!(error.code(), code, "{error}");
        }
        assert_eq!(read_layout("no/such.obj").unwrap_err().code(), "io");
    }
}
