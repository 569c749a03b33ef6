//! A curve on the surface as straight pieces, each inside one face.

use super::place::Place;
use super::roots::common_faces;
use super::source::{SurfacePoint, check_point};
use crate::error::{Error, Result};
use crate::mesh::TriangleMesh;
use crate::mesh::refine::Piece;

/// What errors call a curve, its faces and its coordinates.
const CURVE: [&str; 3] = [
    "curve",
    "faces of curves",
    "barycentric coordinates of curves",
];

/// The pieces of the curve of number `number` between points that follow each other, each with all faces that hold
/// it: two for a piece along an edge. Points that repeat the one before have none.
pub(crate) fn pieces(
    mesh: &TriangleMesh,
    number: usize,
    curve: &[SurfacePoint],
) -> Result<Vec<Vec<Piece>>> {
    if curve.len() < 2 {
        return Err(Error::InvalidArgument {
            what: format!("curve {number} has fewer than two points"),
            index: Some(number),
        });
    }
    let mut places = Vec::with_capacity(curve.len());
    for (i, point) in curve.iter().enumerate() {
        check_point(mesh, CURVE, number, i, point)?;
        places.push(Place::of(mesh, point));
    }
    let mut found = Vec::with_capacity(places.len());
    for (i, pair) in places.windows(2).enumerate() {
        if pair[0] == pair[1] {
            continue;
        }
        let common = common_faces(mesh, pair[0], pair[1]);
        if common.is_empty() {
            return Err(Error::InvalidArgument {
                what: format!(
                    "curve {number}: points {i} and {} lie on no common face",
                    i + 1
                ),
                index: Some(number),
            });
        }
        let piece = |(face, from, to)| Piece { face, from, to };
        found.push(common.into_iter().map(piece).collect());
    }
    Ok(found)
}
