//! Guidance as a text file, with one item on each line:
//!
//! ```text
//! direction FACE X Y Z          the face has this direction
//! direction FACE X Y Z WEIGHT   it should have it
//! edge VERTEX VERTEX            the edge between them is a feature
//! index VERTEX STEPS            the vertex has this index, in quarters for crosses (1/N)
//! ```
//!
//! Faces and vertices are counted from 0; empty lines and text after a `#` are ignored. Directions are
//! vectors in space; their component normal to the face is dropped. If there is any `index`, all
//! vertices without one are regular.

use std::path::Path;

use super::directions::angle;
use super::{Constraint, Guidance, Guide, PrescribedIndex};
use crate::error::{Error, Result};
use crate::mesh::features::edge_between;
use crate::mesh::{MeshError, TriangleMesh};

impl Guidance {
    /// Adds what a file asks for.
    ///
    /// # Errors
    /// [`Error::Io`]; [`Error::Parse`] with the line for any other text, an element that the mesh does
    /// not have, and a direction perpendicular to its face. Elements that are named twice are refused
    /// when the field is made.
    pub fn read(&mut self, mesh: &TriangleMesh, path: impl AsRef<Path>) -> Result<()> {
        let path = path.as_ref();
        let text = std::fs::read(path).map_err(|reason| MeshError::of_file(path, &reason))?;
        self.parse(mesh, &String::from_utf8_lossy(&text))
    }

    /// Adds what the contents of a file ask for.
    ///
    /// # Errors
    /// Those of [`read`](Self::read).
    pub fn parse(&mut self, mesh: &TriangleMesh, text: &str) -> Result<()> {
        let mut all = self.clone();
        for (line, content) in (1..).zip(text.lines()) {
            let content = content.split('#').next().unwrap_or_default();
            let words: Vec<&str> = content.split_whitespace().collect();
            all.add_line(mesh, &words)
                .map_err(|message| Error::Parse { line, message })?;
        }
        *self = all;
        Ok(())
    }

    fn add_line(&mut self, mesh: &TriangleMesh, words: &[&str]) -> std::result::Result<(), String> {
        match *words {
            [] => {}
            ["direction", face, ref numbers @ ..] if numbers.len() == 3 || numbers.len() == 4 => {
                let face = element("face", face, mesh.face_count())?;
                let mut vector = [0.0; 3];
                for (x, word) in vector.iter_mut().zip(numbers) {
                    *x = number(word)?;
                }
                let angle = angle(mesh, face, vector).map_err(|error| error.to_string())?;
                match numbers.get(3) {
                    None => self.constraints.push(Constraint { face, angle }),
                    Some(word) => {
                        let weight = number(word)?;
                        if weight < 0.0 {
                            return Err(format!("the weight {weight} is negative"));
                        }
                        self.guides.push(Guide {
                            face,
                            angle,
                            weight,
                        });
                    }
                }
            }
            ["edge", a, b] => {
                let line = [vertex(mesh, a)?, vertex(mesh, b)?];
                if edge_between(mesh, line).is_none() {
                    return Err(format!("no edge joins vertices {a} and {b}"));
                }
                self.feature_lines.push(line);
            }
            ["index", v, steps] => {
                let vertex = vertex(mesh, v)?;
                let steps = steps
                    .parse()
                    .map_err(|_| format!("'{steps}' is not an integer"))?;
                let indices = self.indices.get_or_insert_default();
                indices.push(PrescribedIndex { vertex, steps });
            }
            _ => {
                return Err(
                    "expected direction FACE X Y Z [WEIGHT], edge VERTEX VERTEX or index VERTEX STEPS"
                        .into(),
                );
            }
        }
        Ok(())
    }
}

fn vertex(mesh: &TriangleMesh, word: &str) -> std::result::Result<usize, String> {
    element("vertex", word, mesh.vertex_count())
}

fn element(what: &str, word: &str, count: usize) -> std::result::Result<usize, String> {
    match word.parse() {
        Ok(number) if number < count => Ok(number),
        _ => Err(format!("'{word}' is not a {what} from 0 to {}", count - 1)),
    }
}

fn number(word: &str) -> std::result::Result<f64, String> {
    match word.parse::<f64>() {
        Ok(value) if value.is_finite() => Ok(value),
        _ => Err(format!("'{word}' is not a finite number")),
    }
}
