//! The attributes of a mesh, from those of the file that it was read from.

use super::{FaceNames, NO_NAME, SurfaceAttributes, VertexScalar};
use crate::error::Result;
use crate::mesh::origin::Origin;
use crate::mesh::{MeshError, TriangleMesh};
use crate::soup::io::{Attribute, Attributes};
use crate::soup::{PolygonSoup, Repaired};

impl SurfaceAttributes {
    /// The attributes of a mesh that was read from a file.
    ///
    /// `mesh` is what [`from_soup`](TriangleMesh::from_soup) made of the file's `soup`, and `repaired` what it told
    /// of that; `None` stands for a mesh with the numbers of the soup. Triangles that fill holes have no attributes.
    /// Vertices that repair made have the mean of the vertices around them.
    ///
    /// # Errors
    /// [`SoupError::Malformed`](crate::soup::SoupError::Malformed) for attributes of another soup, and those of
    /// [`check`](Self::check).
    pub fn of_file(
        mesh: &TriangleMesh,
        (soup, repaired): (&PolygonSoup, Option<&Repaired>),
        attributes: &Attributes,
    ) -> Result<Self> {
        attributes.check(soup).map_err(MeshError::from)?;
        let origin = Origin::new(mesh, soup, repaired)?;
        let polygons: Vec<_> = (0..mesh.face_count())
            .map(|face| origin.polygon(face))
            .collect();
        let names = |attribute| {
            let labels = attributes.labels(attribute)?;
            let label =
                |polygon: &Option<usize>| polygon.map_or(NO_NAME, |polygon| labels[polygon]);
            Some(FaceNames {
                names: attributes.names(attribute).to_vec(),
                of_face: polygons.iter().map(label).collect(),
            })
        };
        let face_colors = attributes.labels(Attribute::Colors).map(|labels| {
            let colors = attributes.face_colors();
            let color = |&polygon: &Option<usize>| polygon.map(|p| colors[labels[p] as usize]);
            let colors = polygons.iter().map(color);
            colors.map(|color| color.unwrap_or([f64::NAN; 4])).collect()
        });
        let uv = attributes.labels(Attribute::Seams).map(|labels| {
            let first = first_corners(soup);
            let points = attributes.texture_coordinates();
            let of_faces = (0..mesh.face_count()).flat_map(|face| {
                let found = mesh.corners(face).map(|vertex| {
                    let polygon = polygons[face]?;
                    let corner = origin.corner(polygon, vertex)?;
                    points.get(labels[first[polygon] + corner] as usize)
                });
                let mean = mean(found.iter().flatten().copied());
                found.map(|point| point.copied().unwrap_or(mean))
            });
            of_faces.collect()
        });
        let vertices = |values: &[f64], size: usize| of_vertices(mesh, &origin, values, size);
        let vertex_colors = attributes.vertex_colors().map(|colors| {
            let flat = vertices(colors.as_flattened(), 4);
            flat.as_chunks().0.to_vec()
        });
        let scalars = attributes.scalars().map(|(name, values)| VertexScalar {
            name: name.to_owned(),
            values: vertices(values, 1),
        });
        let found = SurfaceAttributes {
            libraries: attributes.libraries().to_vec(),
            materials: names(Attribute::Materials),
            groups: names(Attribute::Groups),
            face_colors,
            uv,
            vertex_colors,
            scalars: scalars.collect(),
        };
        found.check(
            mesh.vertex_count(),
            mesh.face_count(),
            3 * mesh.face_count(),
        )?;
        Ok(found)
    }
}

/// The number of the first corner of each polygon.
fn first_corners(soup: &PolygonSoup) -> Vec<usize> {
    let sizes = soup.polygons().map(<[i64]>::len);
    let starts = sizes.scan(0, |next, size| {
        *next += size;
        Some(*next - size)
    });
    starts.collect()
}

fn of_vertices(mesh: &TriangleMesh, origin: &Origin, values: &[f64], size: usize) -> Vec<f64> {
    let of = |vertex: usize| {
        let from = size * origin.vertex(vertex)?;
        Some(&values[from..from + size])
    };
    let mut found = Vec::with_capacity(size * mesh.vertex_count());
    for vertex in 0..mesh.vertex_count() {
        if let Some(values) = of(vertex) {
            found.extend(values);
            continue;
        }
        let around = mesh.ring(vertex).flat_map(|(face, _)| mesh.corners(face));
        let around: Vec<_> = around.filter_map(of).collect();
        let sum = |k: usize| around.iter().map(|values| values[k]).sum::<f64>();
        found.extend((0..size).map(|k| sum(k) / around.len() as f64));
    }
    found
}

/// NaN of no points.
fn mean<'a>(points: impl Iterator<Item = &'a [f64; 2]>) -> [f64; 2] {
    let [u, v, count] = points.fold([0.0; 3], |[u, v, n], point| {
        [u + point[0], v + point[1], n + 1.0]
    });
    [u / count, v / count]
}
