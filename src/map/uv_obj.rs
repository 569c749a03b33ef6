//! A map as a Wavefront OBJ file: positions `v`, coordinates `vt`, corners `f v/vt`.
//!
//! There is one `vt` for each vertex of the cut surface, so that a viewer tears the texture at the cut
//! and nowhere else.

use std::fs::File;
use std::io::{self, Write};
use std::path::Path;

use super::SeamlessMap;
use crate::error::{Error, Result};
use crate::mesh::{MeshError, TriangleMesh};
use crate::monitor::write_lines;

impl SeamlessMap {
    /// Writes the mesh with the coordinates of its corners. Numbers are written so that reading
    /// gives back the same; vertices and faces keep theirs.
    ///
    /// # Errors
    /// [`Error::LengthMismatch`] for another mesh, [`Error::Io`] for a file that cannot be
    /// written.
    pub fn write_obj(&self, mesh: &TriangleMesh, path: &Path) -> Result<()> {
        if self.copies().len() != mesh.face_count() {
            return Err(Error::LengthMismatch {
                what: "the faces of the map",
                expected: mesh.face_count(),
                actual: self.copies().len(),
            });
        }
        let file = File::create(path).and_then(|file| self.encode(mesh, file));
        Ok(file.map_err(|reason| MeshError::of_file(path, &reason))?)
    }

    fn encode(&self, mesh: &TriangleMesh, mut out: impl Write) -> io::Result<()> {
        let (vertices, uvs) = (mesh.vertices(), self.vertex_uvs());
        write_lines(&mut out, vertices.len(), |vertex, text| {
            let [x, y, z] = vertices[vertex];
            writeln!(text, "v {x} {y} {z}")
        })?;
        write_lines(&mut out, uvs.len(), |copy, text| {
            let [u, v] = uvs[copy];
            writeln!(text, "vt {u} {v}")
        })?;
        write_lines(&mut out, mesh.face_count(), |face, text| {
            let (corners, copies) = (mesh.triangles()[face], self.copies()[face]);
            let [a, b, c] = [0, 1, 2].map(|k| (corners[k] + 1, copies[k] + 1));
            writeln!(text, "f {}/{} {}/{} {}/{}", a.0, a.1, b.0, b.1, c.0, c.1)
        })?;
        out.flush()
    }
}
