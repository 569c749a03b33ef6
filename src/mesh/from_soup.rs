//! From a soup to a mesh, by way of repair.

use super::{MeshError, TriangleMesh};
use crate::soup::{PolygonSoup, RepairOptions, Repaired, repair};

impl TriangleMesh {
    /// The mesh that repair makes of a soup, and what repair did. A soup that
    /// [`new`](TriangleMesh::new) accepts keeps its numbers and its coordinates.
    ///
    /// ```
    /// use roundel::mesh::TriangleMesh;
    /// use roundel::soup::{EditKind, PolygonSoup, RepairOptions};
    ///
    /// let mut soup = PolygonSoup::new(vec![[0.0; 3], [1.0, 0.0, 0.0], [1.0, 1.0, 0.0], [0.0, 1.0, 0.0]]);
    /// soup.add_polygon([0, 1, 2, 3]);
    /// let (mesh, repaired) = TriangleMesh::from_soup(&soup, &RepairOptions::default())?;
    /// assert_eq!(mesh.face_count(), 2);
    /// assert_eq!(repaired.edits.count(EditKind::PolygonTriangulated), 1);
    /// # Ok::<(), roundel::mesh::MeshError>(())
    /// ```
    ///
    /// # Errors
    /// [`MeshError::NoSurface`], [`MeshError::TooLarge`].
    pub fn from_soup(
        soup: &PolygonSoup,
        options: &RepairOptions,
    ) -> Result<(TriangleMesh, Repaired), MeshError> {
        let repaired = repair(soup, options)?;
        let mesh = TriangleMesh::new(repaired.vertices.clone(), repaired.triangles.clone())?;
        Ok((mesh, repaired))
    }
}
