//! The polygons, corners and vertices of a soup from which the elements of a mesh come.

use super::TriangleMesh;
use crate::error::{Error, Result};
use crate::soup::{PolygonSoup, Repaired};

/// Where the elements of a mesh come from.
pub(super) struct Origin<'a> {
    soup: &'a PolygonSoup,
    repaired: Option<&'a Repaired>,
}

impl<'a> Origin<'a> {
    /// The origins in a soup, by its repair; without one mesh and soup have the same numbers.
    ///
    /// # Errors
    /// [`Error::LengthMismatch`] for a soup or a repair of another mesh.
    pub(super) fn new(
        mesh: &TriangleMesh,
        soup: &'a PolygonSoup,
        repaired: Option<&'a Repaired>,
    ) -> Result<Self> {
        check(mesh, soup, repaired)?;
        Ok(Origin { soup, repaired })
    }

    /// The polygon of which a face is a part; none for a face that fills a hole.
    pub(super) fn polygon(&self, face: usize) -> Option<usize> {
        match self.repaired {
            Some(repaired) => repaired.triangle_origin[face].map(|polygon| polygon as usize),
            None => Some(face),
        }
    }

    /// The vertex of the soup; none for one that repair made.
    pub(super) fn vertex(&self, vertex: usize) -> Option<usize> {
        match self.repaired {
            Some(repaired) => (*repaired.vertex_origin.get(vertex)?).map(|v| v as usize),
            None => Some(vertex),
        }
    }

    /// The place in a polygon of the corner that became a vertex of the mesh; none where repair gave the
    /// polygon a vertex that it did not have.
    pub(super) fn corner(&self, polygon: usize, vertex: usize) -> Option<usize> {
        let vertex = self.vertex(vertex)?;
        let stands_for = |corner: i64| {
            let corner = usize::try_from(corner).ok()?;
            match self.repaired {
                Some(repaired) => repaired.welded_to(corner).map(|v| v as usize),
                None => Some(corner),
            }
        };
        let mut corners = self.soup.polygon(polygon).iter();
        corners.position(|&corner| stands_for(corner) == Some(vertex))
    }
}

/// Refuses a soup and a repair that are not those of the mesh.
fn check(mesh: &TriangleMesh, soup: &PolygonSoup, repaired: Option<&Repaired>) -> Result<()> {
    let lengths = match repaired {
        Some(repaired) => {
            let origins = repaired.triangle_origin.iter().flatten();
            let last = origins.max().map_or(0, |&polygon| polygon as usize + 1);
            [
                (
                    "triangles of the repair",
                    mesh.face_count(),
                    repaired.triangle_origin.len(),
                ),
                (
                    "vertices of the soup",
                    repaired.input_vertex_count(),
                    soup.positions().len(),
                ),
                (
                    "polygons of the soup",
                    last.max(soup.polygon_count()),
                    soup.polygon_count(),
                ),
            ]
        }
        None => [
            (
                "polygons of the soup",
                mesh.face_count(),
                soup.polygon_count(),
            ),
            (
                "corners of the soup",
                3 * mesh.face_count(),
                soup.corners().len(),
            ),
            (
                "vertices of the soup",
                mesh.vertex_count(),
                soup.positions().len(),
            ),
        ],
    };
    let wrong = lengths
        .into_iter()
        .find(|(_, expected, actual)| expected != actual);
    match wrong {
        Some((what, expected, actual)) => Err(Error::LengthMismatch {
            what,
            expected,
            actual,
        }),
        None => Ok(()),
    }
}
