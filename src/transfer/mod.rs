//! Values of triangles, of their corners and of vertices, carried to quads.
//!
//! | what | how | file |
//! | --- | --- | --- |
//! | a label a face, such as its material | that of most of the area beneath the quad | `labels` |
//! | numbers a vertex | interpolated at the closest point | `vertices` |
//! | numbers a corner, such as texture coordinates | interpolated on the side of the seams beneath the quad | `corners` |
//!
//! Labels and corners see the surface at points inside of each quad (`samples`), so that nothing comes across a
//! feature along which the quad ends. Closest points lie on triangles that face the same way as the quad where there
//! are some nearby (`nearest`): the two sides of a thin plate do not mix.

mod attributes;
mod corners;
mod labels;
mod nearest;
mod samples;
#[cfg(test)]
mod tests;
mod vertices;

pub use attributes::transfer_attributes;

use crate::error::{Error, Result, check_length};
use crate::extract::QuadMesh;
use crate::mesh::TriangleMesh;
use crate::mesh::attributes::check_not_infinite;
use crate::monitor::{Monitor, Stop, room_for};
use nearest::Nearest;

/// The least number of faces or vertices that are worth a thread.
const LEAST: usize = 1 << 6;

/// The label of most of the area beneath each face of the quads.
///
/// `labels` has one for each face of `mesh`. The result has those of the quads, then those of the other faces. Of
/// labels with the same area the lowest wins.
///
/// # Errors
/// [`Error::LengthMismatch`], [`Error::OutOfMemory`], [`Error::Cancelled`].
pub fn transfer_face_labels(
    mesh: &TriangleMesh,
    quads: &QuadMesh,
    labels: &[u32],
    monitor: &mut Monitor,
) -> Result<Vec<u32>> {
    let _watch = monitor.watch();
    check_length("labels of faces", labels.len(), mesh.face_count())?;
    let samples = Nearest::new(mesh, quads)?.samples()?;
    Ok(labels::most(&samples, labels))
}

/// Numbers of vertices at each vertex of the quads, interpolated linearly at the closest point of the mesh.
///
/// `values` has `components` numbers for each vertex of `mesh`. NaN stands for none; so has a vertex of the quads
/// where one of the vertices around has none. Interpolated values are between those of the three vertices around.
///
/// # Errors
/// [`Error::LengthMismatch`]; [`Error::NotFinite`] with the vertex for an infinite value; [`Error::InvalidArgument`]
/// for 0 components; [`Error::OutOfMemory`], [`Error::Cancelled`].
pub fn transfer_vertex_values(
    mesh: &TriangleMesh,
    quads: &QuadMesh,
    components: usize,
    values: &[f64],
    monitor: &mut Monitor,
) -> Result<Vec<f64>> {
    let _watch = monitor.watch();
    let what = "values of vertices";
    check_values(what, values, components, mesh.vertex_count())?;
    room_for(what, quads.vertices.len(), 8 * components)?;
    let places = Nearest::new(mesh, quads)?.places()?;
    Ok(vertices::interpolated(mesh, &places, components, values))
}

/// Numbers of corners, such as texture coordinates, at the corners of all faces of the quads.
///
/// `values` has `components` numbers for each corner of each face of `mesh`; the result has those of the quads, four
/// corners each, and then those of the other faces. Where the two faces of an edge have other values at one of its
/// ends, the edge is a seam. A quad has values of one side of the seams: that of most of the area beneath it; a corner
/// on the other side has the value of the closest point on this one. A triangle with NaN has no values, and neither
/// have quads that lie on such triangles.
///
/// # Errors
/// [`Error::LengthMismatch`]; [`Error::NotFinite`] with the corner for an infinite value; [`Error::InvalidArgument`]
/// for 0 components; [`Error::OutOfMemory`], [`Error::Cancelled`].
pub fn transfer_corner_values(
    mesh: &TriangleMesh,
    quads: &QuadMesh,
    components: usize,
    values: &[f64],
    monitor: &mut Monitor,
) -> Result<Vec<f64>> {
    let _watch = monitor.watch();
    let what = "values of corners";
    check_values(what, values, components, 3 * mesh.face_count())?;
    let count = quads.faces().map(<[u32]>::len).sum();
    room_for(what, count, 8 * components)?;
    let nearest = Nearest::new(mesh, quads)?;
    let samples = nearest.samples()?;
    corners::interpolated(&nearest, &samples, components, values)
}

fn check_values(what: &'static str, values: &[f64], components: usize, count: usize) -> Result<()> {
    if components == 0 {
        return Err(Error::InvalidArgument {
            what: format!("{what}: there are 0 components"),
            index: None,
        });
    }
    check_length(what, values.len(), components.saturating_mul(count))?;
    check_not_infinite(what, values, components)
}

/// The values of all elements, unless the call is to end.
fn all<T>(values: Vec<std::result::Result<T, Stop>>) -> Result<Vec<T>> {
    let all: std::result::Result<Vec<T>, Stop> = values.into_iter().collect();
    Ok(all?)
}
