//! Feature lines from files, where the library was built with mesh files.

use std::path::Path;

use crate::error::Result;
use crate::mesh::TriangleMesh;

#[cfg(feature = "mesh-io")]
pub(super) fn read_features(mesh: &TriangleMesh, file: &Path) -> Result<Vec<usize>> {
    let features = crate::mesh::features::FeatureGraph::read(mesh, file)?;
    Ok(features.edges().collect())
}

// The exported symbols do not depend on features: programs link against either library.
#[cfg(not(feature = "mesh-io"))]
pub(super) fn read_features(_: &TriangleMesh, file: &Path) -> Result<Vec<usize>> {
    super::mesh_files::without_files(file)
}
