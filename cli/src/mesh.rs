//! A mesh named on the command line: a file, or a procedural shape.

use std::path::Path;

use roundel::Result;
use roundel::mesh::{TriangleMesh, io, shape};

/// The mesh that `name` stands for: `shape:NAME[:TRIANGLES]` or a file.
pub fn read(name: &Path) -> Result<TriangleMesh> {
    let drawn = name.to_str().and_then(shape::from_spec);
    Ok(drawn.unwrap_or_else(|| io::read(name))?)
}
