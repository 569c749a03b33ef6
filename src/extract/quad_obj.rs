//! Quads as a file: Wavefront OBJ, or any format that the name tells.

use std::fs::File;
use std::io::{self, Write};
use std::path::Path;

use super::QuadMesh;
use crate::error::Result;
use crate::mesh::MeshError;
#[cfg(feature = "mesh-io")]
use crate::mesh::attributes::SurfaceAttributes;
use crate::monitor::write_lines;

impl QuadMesh {
    /// Writes vertices and faces to a file whose extension tells the format: see
    /// [`write_polygons`](crate::mesh::io::write_polygons). As OBJ, what [`QuadMesh::write_obj`] writes.
    ///
    /// # Errors
    /// [`Error::Io`](crate::Error::Io) for a file that cannot be written, and
    /// [`Error::Input`](crate::Error::Input) for an unknown format.
    #[cfg(feature = "mesh-io")]
    pub fn write(&self, path: &Path) -> Result<()> {
        self.write_with(path, &SurfaceAttributes::default())
    }

    /// As [`write`](Self::write), with attributes, of which the file has those that its format holds: see
    /// [`Polygons::attributes`](crate::mesh::io::Polygons::attributes). They count the quads first, and then the other
    /// faces.
    ///
    /// # Errors
    /// Those of [`write`](Self::write), and [`Error::Input`](crate::Error::Input) for attributes that do not fit.
    #[cfg(feature = "mesh-io")]
    pub fn write_with(&self, path: &Path, attributes: &SurfaceAttributes) -> Result<()> {
        let polygons = crate::mesh::io::Polygons {
            vertices: &self.vertices,
            faces: self.faces().collect(),
            attributes: Some(attributes),
        };
        Ok(crate::mesh::io::write_polygons(path, &polygons)?)
    }

    /// Writes vertices and faces. Coordinates are written so that reading gives back the same.
    ///
    /// # Errors
    /// [`Error::Io`](crate::Error::Io) for a file that cannot be written.
    pub fn write_obj(&self, path: &Path) -> Result<()> {
        let file = File::create(path).and_then(|file| self.encode(file));
        Ok(file.map_err(|reason| MeshError::of_file(path, &reason))?)
    }

    fn encode(&self, mut out: impl Write) -> io::Result<()> {
        write_lines(&mut out, self.vertices.len(), |vertex, text| {
            let [x, y, z] = self.vertices[vertex];
            writeln!(text, "v {x} {y} {z}")
        })?;
        let faces: Vec<&[u32]> = self.faces().collect();
        write_lines(&mut out, faces.len(), |face, text| {
            write!(text, "f")?;
            let mut corners = faces[face].iter();
            corners.try_for_each(|corner| write!(text, " {}", corner + 1))?;
            writeln!(text)
        })?;
        out.flush()
    }
}
