//! Features from what a file's polygons have: edges whose two faces differ in an attribute.

use super::FeatureGraph;
use crate::error::{Error, Result};
use crate::mesh::{MeshError, TriangleMesh};
use crate::soup::io::{Attribute, Attributes};
use crate::soup::{PolygonSoup, Repaired};

impl FeatureGraph {
    /// The edges at which an attribute of a file changes.
    ///
    /// `mesh` is what [`from_soup`](TriangleMesh::from_soup) made of the file's `soup`, and `repaired` what
    /// it told of that; `None` stands for a mesh with the numbers of the soup, as
    /// [`mesh::io`](crate::mesh::io) reads it. Texture coordinates and normals change at an edge if they
    /// differ at one of its ends. Triangles that repair made to fill holes have no attributes: no edge of
    /// theirs is a feature, and neither are edges inside one polygon.
    ///
    /// # Errors
    /// [`MeshError::InvalidArgument`] for an attribute that the file lacks, with those that it has;
    /// [`SoupError::Malformed`](crate::soup::SoupError::Malformed) for attributes of another soup; and
    /// [`Error::LengthMismatch`] for a soup or a repair of another mesh.
    pub fn by_attribute(
        mesh: &TriangleMesh,
        (soup, repaired): (&PolygonSoup, Option<&Repaired>),
        attributes: &Attributes,
        attribute: Attribute,
    ) -> Result<Self> {
        let Some(labels) = attributes.labels(attribute) else {
            return Err(missing(attributes, attribute).into());
        };
        attributes.check(soup).map_err(MeshError::from)?;
        check_origins(mesh, soup, repaired)?;
        let origin = Origin { soup, repaired };
        let differs: Box<dyn Fn(usize) -> bool> = match attribute {
            Attribute::Seams | Attribute::Normals => {
                let mut first = vec![0; soup.polygon_count() + 1];
                for (k, polygon) in soup.polygons().enumerate() {
                    first[k + 1] = first[k] + polygon.len();
                }
                Box::new(move |edge| {
                    sides(mesh, &origin, edge).is_some_and(|sides| {
                        mesh.edge(edge).vertices.iter().any(|&vertex| {
                            let [a, b] = sides.map(|polygon| {
                                let corner = origin.corner(polygon, vertex)?;
                                Some(labels[first[polygon] + corner])
                            });
                            a.is_some() && b.is_some() && a != b
                        })
                    })
                })
            }
            _ => Box::new(move |edge| {
                sides(mesh, &origin, edge).is_some_and(|[a, b]| labels[a] != labels[b])
            }),
        };
        Ok(Self::of(
            mesh,
            (0..mesh.edge_count()).map(differs).collect(),
        ))
    }
}

/// Refuses a soup and a repair that are not those of the mesh.
fn check_origins(
    mesh: &TriangleMesh,
    soup: &PolygonSoup,
    repaired: Option<&Repaired>,
) -> Result<()> {
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

/// The polygons on the two sides of an edge.
fn sides(mesh: &TriangleMesh, origin: &Origin, edge: usize) -> Option<[usize; 2]> {
    let edge = mesh.edge(edge);
    let second = edge.second?;
    Some([origin.polygon(edge.first.0)?, origin.polygon(second.0)?])
}

/// Where the elements of a mesh come from.
struct Origin<'a> {
    soup: &'a PolygonSoup,
    repaired: Option<&'a Repaired>,
}

impl Origin<'_> {
    fn polygon(&self, face: usize) -> Option<usize> {
        match self.repaired {
            Some(repaired) => repaired.triangle_origin[face].map(|polygon| polygon as usize),
            None => Some(face),
        }
    }

    /// The place in a polygon of the corner that became a vertex of the mesh; none where repair gave the
    /// polygon a vertex that it did not have.
    fn corner(&self, polygon: usize, vertex: usize) -> Option<usize> {
        let vertex = match self.repaired {
            Some(repaired) => (*repaired.vertex_origin.get(vertex)?)? as usize,
            None => vertex,
        };
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

fn missing(attributes: &Attributes, attribute: Attribute) -> MeshError {
    let present: Vec<_> = attributes.present().map(Attribute::name).collect();
    let has = match present.is_empty() {
        true => "no attributes that are read".to_owned(),
        false => present.join(", "),
    };
    MeshError::InvalidArgument {
        what: format!("the file has no {attribute}; it has {has}"),
    }
}
