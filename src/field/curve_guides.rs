//! Guides along curves that are drawn on the surface.

use super::{FieldOptions, Guide};
use crate::error::{Error, Result};
use crate::geodesic::{SurfacePoint, pieces};
use crate::mesh::TriangleMesh;
use crate::mesh::vector::{dot, norm, sub};

/// A guide for every face that curves pass, towards the direction of the curve there: the weight is
/// `weight * length / size`, with the length of the curves inside the face and the square root of its area. In
/// increasing order of faces.
///
/// The points of a curve that follow each other lie on a common face, as [`draw_curve`](crate::geodesic::draw_curve)
/// makes them. Where several pieces pass a face, the mean of their directions counts, by length and up to the
/// symmetry of the field: for crosses, curves that meet at a right angle agree.
///
/// # Errors
/// [`Error::InvalidArgument`] for a weight that is negative or not finite or another symmetry than 1, 2, 4 and 6; with
/// the number of the curve, for one of fewer than two points or with points that are not on the surface or lie on no
/// common face; [`Error::IndexOutOfRange`] and [`Error::NotFinite`] likewise.
pub fn guides_along(
    mesh: &TriangleMesh,
    curves: &[Vec<SurfacePoint>],
    symmetry: u8,
    weight: f64,
) -> Result<Vec<Guide>> {
    if !(weight >= 0.0 && weight.is_finite()) {
        return Err(Error::InvalidArgument {
            what: format!("the weight of curves is {weight}; it must be finite and at least 0"),
            index: None,
        });
    }
    let options = FieldOptions {
        symmetry,
        ..FieldOptions::default()
    };
    options.step()?;
    let arms = f64::from(symmetry);
    // A face, and a piece of a curve there as a vector of its length that is the same for all arms.
    let mut passed: Vec<(usize, [f64; 2])> = Vec::new();
    for (number, curve) in curves.iter().enumerate() {
        for piece in pieces(mesh, number, curve)?.into_iter().flatten() {
            let [from, to] = piece.ends(mesh);
            let along = sub(to, from);
            let [x, y] = mesh.frame(piece.face).map(|axis| dot(along, axis));
            let (sin, cos) = (arms * y.atan2(x)).sin_cos();
            let length = norm(along);
            passed.push((piece.face, [length * cos, length * sin]));
        }
    }
    passed.sort_by_key(|&(face, _)| face);
    let guide = |of_face: &[(usize, [f64; 2])]| {
        let face = of_face[0].0;
        let sum = |i: usize| of_face.iter().map(|(_, v)| v[i]).sum::<f64>();
        let [x, y] = [sum(0), sum(1)];
        Guide {
            face,
            angle: y.atan2(x) / arms,
            weight: weight * x.hypot(y) / mesh.area(face).sqrt(),
        }
    };
    Ok(passed.chunk_by(|a, b| a.0 == b.0).map(guide).collect())
}
