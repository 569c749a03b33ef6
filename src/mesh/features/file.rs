//! Features from the line elements of an OBJ file: `l V1 V2 V3 ...`, polylines through vertices.

use std::path::Path;

use super::FeatureGraph;
use crate::error::{Error, Result};
use crate::mesh::{MeshError, TriangleMesh};

impl FeatureGraph {
    /// The graph of a file's line elements, on the mesh of that file.
    ///
    /// Vertex numbers count from 1, or from the end where they are negative; what follows a `/` is
    /// ignored, and so is all else in the file. A file without lines gives the graph without
    /// edges.
    ///
    /// # Errors
    /// [`MeshError::Io`], and [`MeshError::Parse`] with the line for what is not the number of a
    /// vertex, and for two vertices that no edge joins.
    pub fn read(mesh: &TriangleMesh, path: impl AsRef<Path>) -> Result<Self> {
        let path = path.as_ref();
        let bytes = std::fs::read(path).map_err(|reason| MeshError::of_file(path, &reason))?;
        Self::parse(mesh, &String::from_utf8_lossy(&bytes))
    }

    /// The graph of the line elements of an OBJ file's contents.
    ///
    /// # Errors
    /// Those of [`read`](Self::read).
    pub fn parse(mesh: &TriangleMesh, text: &str) -> Result<Self> {
        let (mut lines, mut at_line, mut seen) = (Vec::new(), Vec::new(), 0);
        for (number, content) in (1..).zip(text.lines()) {
            let content = content.split('#').next().unwrap_or_default();
            let mut words = content.split_whitespace();
            match words.next() {
                Some("v") => seen += 1,
                Some("l") => {
                    let vertices: Option<Vec<usize>> = words.map(|w| vertex(w, seen)).collect();
                    let vertices = vertices.filter(|v| v.len() >= 2);
                    let Some(vertices) = vertices else {
                        return Err(wrong(
                            number,
                            "a line element needs the numbers of at least two vertices",
                        ));
                    };
                    for pair in vertices.windows(2) {
                        lines.push([pair[0], pair[1]]);
                        at_line.push(number);
                    }
                }
                _ => {}
            }
        }
        Self::from_lines(mesh, &lines).map_err(|error| {
            let line = error.index().and_then(|position| at_line.get(position));
            wrong(line.copied().unwrap_or(1), &error.to_string())
        })
    }
}

/// The vertex that a word of a line names, counted from 0, after `seen` vertices of the file.
fn vertex(word: &str, seen: i64) -> Option<usize> {
    let number: i64 = word.split('/').next()?.parse().ok()?;
    let vertex = match number {
        0 => return None,
        1.. => number - 1,
        _ => seen.checked_add(number)?,
    };
    usize::try_from(vertex).ok()
}

fn wrong(line: usize, message: &str) -> Error {
    Error::Parse {
        line,
        message: message.into(),
    }
}
