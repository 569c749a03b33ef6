//! Mirror planes: stated or found, how symmetric a mesh is about them, and the part on one side.
//!
//! | idea | file |
//! | --- | --- |
//! | what is asked for, and planes | `plane` |
//! | the plane about which a mesh is most symmetric | `find` |
//! | the part of a mesh on one side of planes, cut exactly | `half` |

mod find;
mod half;
mod plane;
#[cfg(test)]
mod tests;

pub use half::Half;
pub use plane::{Mirror, MirrorPlane};

use super::vector::{dot, norm, sub};
use super::{ClosestPoint, TriangleMesh};
use crate::error::{Error, Result};
use crate::monitor::{collect_in_parts, may_continue};

/// The most planes at once: there are no more that are perpendicular to each other.
const MOST_PLANES: usize = 3;

/// The largest cosine of the angle between two planes that count as perpendicular.
const PERPENDICULAR: f64 = 1e-9;

/// The least number of vertices that are worth a thread.
const LEAST: usize = 1 << 8;

/// The planes that are asked for, with the [deviation](MirrorPlane::deviation) of the mesh from each.
///
/// Planes that are stated come first; those that are to be found are perpendicular to them and to each
/// other. The result is in the order in which they are asked for.
///
/// # Errors
/// [`Error::InvalidArgument`] with the number of the plane: a normal that is no direction, planes that are
/// not perpendicular to each other, more than three, a mesh that deviates from its mirror image by more
/// than `tolerance`, as a part of the diagonal of the bounding box; [`Error::Cancelled`].
pub fn mirror_planes(
    mesh: &TriangleMesh,
    asked: &[Mirror],
    tolerance: f64,
) -> Result<Vec<MirrorPlane>> {
    if tolerance.is_nan() || tolerance < 0.0 {
        return refused(
            format!("the tolerance of mirror planes is {tolerance}; it must be 0 or more"),
            None,
        );
    }
    if asked.len() > MOST_PLANES {
        let what = format!(
            "{} mirror planes: at most {MOST_PLANES} are perpendicular to each other",
            asked.len()
        );
        return refused(what, Some(MOST_PLANES));
    }
    let mut planes: Vec<Option<MirrorPlane>> = Vec::new();
    for (i, one) in asked.iter().enumerate() {
        let plane = one.stated(mesh, i)?;
        if let Some(plane) = &plane
            && let Some(other) = not_perpendicular(&planes, plane)
        {
            let what = format!("mirror planes {other} and {i} are not perpendicular to each other");
            return refused(what, Some(i));
        }
        planes.push(plane);
    }
    let tree = ClosestPoint::new(mesh);
    may_continue()?;
    for i in 0..planes.len() {
        if planes[i].is_none() {
            let known: Vec<MirrorPlane> = planes.iter().flatten().copied().collect();
            planes[i] = Some(find::find(mesh, &tree, &known)?);
        }
    }
    let mut found: Vec<MirrorPlane> = planes.into_iter().flatten().collect();
    for (i, plane) in found.iter_mut().enumerate() {
        plane.deviation = deviation(mesh, &tree, plane)?;
        if plane.deviation > tolerance {
            let words = match asked[i] {
                Mirror::Auto => format!("the best mirror plane that was found, {plane}"),
                _ => format!("mirror plane {i}, {plane}"),
            };
            let what = format!(
                "the mesh is not symmetric: {words}, moves a vertex {:.3} of the diagonal away from the surface, and {tolerance} is allowed",
                plane.deviation
            );
            return refused(what, Some(i));
        }
    }
    Ok(found)
}

/// The largest distance of a mirrored vertex from the surface, as a part of the diagonal.
fn deviation(mesh: &TriangleMesh, tree: &ClosestPoint, plane: &MirrorPlane) -> Result<f64> {
    let distances = collect_in_parts(mesh.vertex_count(), LEAST, |v| {
        let image = plane.reflect(mesh.position(v));
        let point = tree.find(image, None);
        point.map_or(0.0, |(_, point)| norm(sub(point, image)))
    });
    may_continue()?;
    Ok(distances.into_iter().fold(0.0, f64::max) / diagonal(mesh))
}

fn not_perpendicular(planes: &[Option<MirrorPlane>], plane: &MirrorPlane) -> Option<usize> {
    planes.iter().position(|other| {
        other.is_some_and(|other| dot(other.normal, plane.normal).abs() > PERPENDICULAR)
    })
}

fn diagonal(mesh: &TriangleMesh) -> f64 {
    let [low, high] = mesh.bounding_box();
    norm(sub(high, low))
}

fn refused<T>(what: String, index: Option<usize>) -> Result<T> {
    Err(Error::InvalidArgument { what, index })
}
