//! All attributes of a mesh, carried to quads.

use std::collections::HashMap;

use super::{Nearest, corners, labels, vertices};
use crate::error::Result;
use crate::extract::QuadMesh;
use crate::mesh::TriangleMesh;
use crate::mesh::attributes::{FaceNames, SurfaceAttributes, VertexScalar};
use crate::monitor::{Monitor, room_for};

/// The attributes of quads, from those of the mesh that they were made of.
///
/// Materials, groups and colours of faces are those of most of the area beneath each face of the quads: see
/// [`transfer_face_labels`](super::transfer_face_labels). Numbers and colours of vertices are interpolated
/// ([`transfer_vertex_values`](super::transfer_vertex_values)), and so are texture coordinates, on one side of their
/// seams ([`transfer_corner_values`](super::transfer_corner_values)). The result counts the quads first, and then the
/// other faces.
///
/// # Errors
/// Those of [`SurfaceAttributes::check`], [`Error::OutOfMemory`](crate::Error::OutOfMemory),
/// [`Error::Cancelled`](crate::Error::Cancelled).
pub fn transfer_attributes(
    mesh: &TriangleMesh,
    quads: &QuadMesh,
    attributes: &SurfaceAttributes,
    monitor: &mut Monitor,
) -> Result<SurfaceAttributes> {
    let _watch = monitor.watch();
    attributes.check(
        mesh.vertex_count(),
        mesh.face_count(),
        3 * mesh.face_count(),
    )?;
    let mut found = SurfaceAttributes {
        libraries: attributes.libraries.clone(),
        ..SurfaceAttributes::default()
    };
    if attributes.is_empty() {
        return Ok(found);
    }
    let nearest = Nearest::new(mesh, quads)?;
    let of_faces = [&attributes.materials, &attributes.groups];
    let colors = &attributes.face_colors;
    if of_faces.into_iter().any(Option::is_some) || colors.is_some() || attributes.uv.is_some() {
        let samples = nearest.samples()?;
        let [materials, groups] = of_faces.map(|given| {
            given.as_ref().map(|given| FaceNames {
                names: given.names.clone(),
                of_face: labels::most(&samples, &given.of_face),
            })
        });
        (found.materials, found.groups) = (materials, groups);
        found.face_colors = colors.as_ref().map(|colors| {
            let labels = labels::most(&samples, &first_equal(colors));
            labels.iter().map(|&label| colors[label as usize]).collect()
        });
        if let Some(uv) = &attributes.uv {
            let flat = corners::interpolated(&nearest, &samples, 2, uv.as_flattened())?;
            found.uv = Some(flat.as_chunks().0.to_vec());
        }
    }
    if attributes.vertex_colors.is_some() || !attributes.scalars.is_empty() {
        let places = nearest.places()?;
        let size = 4 + attributes.scalars.len();
        room_for("values of the quads' vertices", places.len(), 8 * size)?;
        found.vertex_colors = attributes.vertex_colors.as_ref().map(|colors| {
            let flat = vertices::interpolated(mesh, &places, 4, colors.as_flattened());
            flat.as_chunks().0.to_vec()
        });
        let scalars = attributes.scalars.iter().map(|scalar| VertexScalar {
            name: scalar.name.clone(),
            values: vertices::interpolated(mesh, &places, 1, &scalar.values),
        });
        found.scalars = scalars.collect();
    }
    Ok(found)
}

/// For each colour the place of the first that is equal.
fn first_equal(colors: &[[f64; 4]]) -> Vec<u32> {
    let mut first = HashMap::new();
    let numbered = colors.iter().zip(0..);
    let place = |(color, at): (&[f64; 4], u32)| *first.entry(color.map(f64::to_bits)).or_insert(at);
    numbered.map(place).collect()
}
