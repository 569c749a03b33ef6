//! A mesh cut along curves on its surface.

use super::pieces::pieces;
use super::source::SurfacePoint;
use crate::error::Result;
use crate::mesh::TriangleMesh;
use crate::mesh::refine::{CutAlong, cut_along_pieces};

/// Cuts faces so that curves on the surface become chains of edges: features that a field and quads can follow.
///
/// The points of a curve that follow each other lie on a common face, as [`draw_curve`](super::draw_curve) makes them.
/// Vertices keep their numbers and places, new ones follow, and the surface stays where it is. A curve is moved by at
/// most a tenth of the shortest edge of the face, and at most 1/1000 of the diagonal of the bounding box, where it then
/// runs through a vertex or along an edge: fewer needles arise. Where curves cross, they get a common vertex.
///
/// # Errors
/// With the number of the curve, [`Error::InvalidArgument`](crate::Error::InvalidArgument) for one of fewer than two
/// points, with points outside of their faces or that lie on no common face, or so short that nothing is left of it;
/// [`Error::IndexOutOfRange`](crate::Error::IndexOutOfRange) and [`Error::NotFinite`](crate::Error::NotFinite)
/// likewise; [`Error::Cancelled`](crate::Error::Cancelled).
pub fn cut_along(mesh: &TriangleMesh, curves: &[Vec<SurfacePoint>]) -> Result<CutAlong> {
    let mut of_curves = Vec::with_capacity(curves.len());
    for (number, curve) in curves.iter().enumerate() {
        let found = pieces(mesh, number, curve)?;
        of_curves.push(found.into_iter().map(|faces| faces[0]).collect());
    }
    cut_along_pieces(mesh, &of_curves)
}
