//! Polylines in space, drawn onto a surface: points by the closest point, segments by shortest paths.

use super::distance::{GeodesicOptions, geodesic_distance};
use super::place::Place;
use super::roots::common_faces;
use super::source::{Source, SurfacePoint};
use crate::error::{Error, Result};
use crate::mesh::vector::{Vec3, cross, dot, norm, sub};
use crate::mesh::{ClosestPoint, TriangleMesh};
use crate::monitor::Monitor;

/// The first limit of a path, in distances of its ends in space. Where it is longer, the limit is doubled.
const DETOUR: f64 = 1.5;

/// How far from the surface the points of a curve may lie, as a part of the diagonal of the bounding box.
pub const FAR_FROM_SURFACE: f64 = 0.05;

/// The curve on a surface that follows a polyline in space, as [`draw_polyline`] draws it: points of the surface, of
/// which those that follow each other lie on a common face. It is closed if the last point is the first.
///
/// # Errors
/// [`Error::InvalidArgument`] for fewer than two points, and with the number of the point for one that lies farther
/// from the surface than [`FAR_FROM_SURFACE`] of the diagonal of the bounding box; those of [`draw_polyline`].
pub fn draw_curve(
    mesh: &TriangleMesh,
    points: &[Vec3],
    monitor: &Monitor<'_>,
) -> Result<Vec<SurfacePoint>> {
    let drawn = closest_points(mesh, points)?;
    if points.len() < 2 {
        return Err(Error::InvalidArgument {
            what: "a curve needs two points or more".into(),
            index: None,
        });
    }
    let [low, high] = mesh.bounding_box();
    let allowed = FAR_FROM_SURFACE * norm(sub(high, low));
    for (i, (&p, on)) in points.iter().zip(&drawn).enumerate() {
        let off = norm(sub(on.position(mesh), p));
        if off > allowed {
            return Err(Error::InvalidArgument {
                what: format!(
                    "point {i} of the curve lies {off:.3e} off the surface; at most {allowed:.3e} is allowed"
                ),
                index: Some(i),
            });
        }
    }
    connect(mesh, &drawn, false, monitor)
}

/// The polyline on a surface that follows one in space: through the closest point of each of its points, along a
/// shortest path where two that follow each other lie on no common face.
///
/// # Errors
/// [`Error::InvalidArgument`] for no points, and with the number of the point for one from which no path leads to
/// the next; [`Error::NotFinite`] for coordinates that are no numbers; the errors of [`geodesic_distance`] that are
/// not about sources.
pub fn draw_polyline(
    mesh: &TriangleMesh,
    points: &[Vec3],
    closed: bool,
    monitor: &Monitor<'_>,
) -> Result<Source> {
    let drawn = closest_points(mesh, points)?;
    Ok(Source::Polyline {
        points: connect(mesh, &drawn, closed, monitor)?,
        closed: false,
    })
}

/// The point of the surface that is closest to each point.
fn closest_points(mesh: &TriangleMesh, points: &[Vec3]) -> Result<Vec<SurfacePoint>> {
    if let Some(position) = points.iter().position(|p| !p.iter().all(|x| x.is_finite())) {
        return Err(Error::NotFinite {
            what: "points of the polyline",
            position,
        });
    }
    if points.is_empty() {
        return Err(Error::InvalidArgument {
            what: "the polyline has no points".into(),
            index: None,
        });
    }
    let tree = ClosestPoint::new(mesh);
    let mut hint = None;
    let mut drawn = Vec::with_capacity(points.len());
    for &p in points {
        if let Some((face, closest)) = tree.find(p, hint) {
            hint = Some(face);
            drawn.push(surface_point(mesh, face, closest));
        }
    }
    Ok(drawn)
}

/// The points and the shortest paths between those that follow each other.
fn connect(
    mesh: &TriangleMesh,
    drawn: &[SurfacePoint],
    closed: bool,
    monitor: &Monitor<'_>,
) -> Result<Vec<SurfacePoint>> {
    let component = mesh.components().of_face;
    let mut line = vec![drawn[0]];
    let pieces = if closed { drawn.len() } else { drawn.len() - 1 };
    for i in 0..pieces {
        let (from, to) = (drawn[i], drawn[(i + 1) % drawn.len()]);
        if component[from.face] != component[to.face] {
            return Err(Error::InvalidArgument {
                what: format!(
                    "point {i} of the polyline: no path on the surface leads to the next"
                ),
                index: Some(i),
            });
        }
        line.extend(join(mesh, from, to, monitor)?);
    }
    Ok(line)
}

/// The points that follow `from` on the way to `to`, which is the last of them.
fn join(
    mesh: &TriangleMesh,
    from: SurfacePoint,
    to: SurfacePoint,
    monitor: &Monitor<'_>,
) -> Result<Vec<SurfacePoint>> {
    let places = [from, to].map(|p| Place::of(mesh, &p));
    if places[0] == places[1] || !common_faces(mesh, places[0], places[1]).is_empty() {
        return Ok(vec![to]);
    }
    let [low, high] = mesh.bounding_box();
    let apart = norm(sub(to.position(mesh), from.position(mesh)));
    let mut limit = DETOUR * apart.max(1e-3 * norm(sub(high, low)));
    loop {
        let options = GeodesicOptions {
            limit,
            everywhere: true,
        };
        let found = geodesic_distance(mesh, &[Source::Point(to)], &options, monitor)?;
        let mut path = found.path(mesh, &from)?;
        if let Some(end) = path.last_mut() {
            *end = to;
            return Ok(path.split_off(1));
        }
        limit *= 2.0;
    }
}

/// A point of a face by its position.
fn surface_point(mesh: &TriangleMesh, face: usize, p: Vec3) -> SurfacePoint {
    let corners = mesh.corner_positions(face);
    let normal = cross(sub(corners[1], corners[0]), sub(corners[2], corners[0]));
    let part = |k: usize| {
        let [a, b] = [1, 2].map(|i| sub(corners[(k + i) % 3], p));
        dot(cross(a, b), normal).max(0.0)
    };
    let parts = [0, 1, 2].map(part);
    let sum: f64 = parts.iter().sum();
    SurfacePoint {
        face,
        barycentric: parts.map(|x| x / sum),
    }
}
