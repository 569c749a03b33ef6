//! From a soup to a mesh, by way of repair.

use super::{MeshError, TriangleMesh};
use crate::monitor::{allowed_threads, both};
use crate::soup::{PolygonSoup, RepairOptions, Repaired, repair};

/// The mesh of so many polygons is worth a thread while it is not known whether they need repair.
const LARGE: usize = 1 << 13;

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
        let is_large = soup.polygon_count() >= LARGE && allowed_threads() > 1;
        let as_it_is = || is_large.then(|| without_repair(soup)).flatten();
        let (repaired, mesh) = both(is_large, || repair(soup, options), as_it_is);
        let repaired = repaired?;
        let is_unchanged = |mesh: &TriangleMesh| {
            mesh.triangles() == repaired.triangles && mesh.vertices() == repaired.vertices
        };
        let mesh = match mesh.filter(is_unchanged) {
            Some(mesh) => mesh,
            None => TriangleMesh::new(repaired.vertices.clone(), repaired.triangles.clone())?,
        };
        Ok((mesh, repaired))
    }
}

/// The mesh of a soup that needs no repair.
fn without_repair(soup: &PolygonSoup) -> Option<TriangleMesh> {
    let corner = |&v: &i64| u32::try_from(v).ok();
    let triangle = |polygon: &[i64]| match polygon {
        [a, b, c] => Some([corner(a)?, corner(b)?, corner(c)?]),
        _ => None,
    };
    let triangles: Option<Vec<[u32; 3]>> = soup.polygons().map(triangle).collect();
    TriangleMesh::new(soup.positions().to_vec(), triangles?).ok()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mesh::shape;
    use crate::monitor::{Span, traced, with_threads};

    #[test]
    fn threads_change_neither_the_mesh_nor_what_repair_did() {
        let sphere = shape::by_name("sphere", 2 * LARGE).unwrap();
        let soup = |is_whole: bool| {
            let mut soup = PolygonSoup::new(sphere.vertices().to_vec());
            for (face, corners) in sphere.triangles().iter().enumerate() {
                let [a, b, c] = corners.map(i64::from);
                // One face runs the other way round.
                soup.add_polygon(if face == 7 && !is_whole {
                    [a, c, b]
                } else {
                    [a, b, c]
                });
            }
            soup
        };
        for is_whole in [true, false] {
            let soup = soup(is_whole);
            let made = |threads: usize| {
                let options = RepairOptions::default();
                let (mesh, repaired) =
                    with_threads(threads, || TriangleMesh::from_soup(&soup, &options)).unwrap();
                let of_mesh = (mesh.vertices().to_vec(), mesh.triangles().to_vec());
                (of_mesh, repaired)
            };
            let one = made(1);
            assert_eq!(one.1.edits.list().is_empty(), is_whole);
            let (three, trace) = with_threads(3, || traced(false, || made(3)));
            assert_eq!(three, one);
            let elsewhere = |span: &Span| span.name == "half-edges" && span.thread > 0;
            assert!(trace.spans.iter().any(elsewhere));
        }
    }
}
