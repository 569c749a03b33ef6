//! Directions from the curvature of the surface, as hard constraints on the faces where they are most
//! reliable and as soft guides for all faces.

use super::{Constraint, Guide};
use crate::error::{Error, Result};
use crate::mesh::TriangleMesh;
use crate::mesh::curvature::{Curvature, SMOOTHING_ROUNDS, smoothed_curvature};

/// Constrains `fraction` of the faces (rounded to the nearest count), those with the largest
/// difference between the absolute principal curvatures, to the direction of least absolute
/// curvature. In increasing order of faces.
///
/// # Errors
/// [`Error::InvalidArgument`] for a fraction outside [0, 1].
pub fn curvature_constraints(mesh: &TriangleMesh, fraction: f64) -> Result<Vec<Constraint>> {
    let count = count(mesh, fraction)?;
    let curvature = (count > 0).then(|| smoothed_curvature(mesh, SMOOTHING_ROUNDS));
    Ok(curvature.map_or_else(Vec::new, |found| most_reliable(&found, count)))
}

/// The number of faces that this fraction stands for.
pub(super) fn count(mesh: &TriangleMesh, fraction: f64) -> Result<usize> {
    if !(0.0..=1.0).contains(&fraction) {
        return Err(Error::InvalidArgument {
            what: format!(
                "the fraction of constrained faces is {fraction}; it must be from 0 to 1"
            ),
            index: None,
        });
    }
    Ok((fraction * mesh.face_count() as f64).round() as usize)
}

/// The `count` faces whose direction is most reliable.
pub(super) fn most_reliable(curvature: &Curvature, count: usize) -> Vec<Constraint> {
    let constraint = |face| Constraint {
        face,
        angle: curvature.direction[face],
    };
    let faces = curvature.most_reliable(count).into_iter();
    faces.map(constraint).collect()
}

/// Guides with less weight are left out: they are below the rounding error of edges, which weigh 1.
const LIGHT: f64 = 1e-9;

/// A guide for every face towards the direction of least absolute curvature, with the weight
/// `weight * area * (|k1| - |k2|)^2`: nothing where the surface is flat or round.
///
/// If a mesh is refined, the squared angles between neighbours shrink as areas do. The balance between
/// smoothness and curvature therefore depends neither on the triangulation nor on the size.
///
/// # Errors
/// [`Error::InvalidArgument`] for a weight that is negative or not finite.
pub fn curvature_guides(mesh: &TriangleMesh, weight: f64) -> Result<Vec<Guide>> {
    check_weight(weight)?;
    if weight == 0.0 {
        return Ok(Vec::new());
    }
    Ok(all_guides(
        mesh,
        &smoothed_curvature(mesh, SMOOTHING_ROUNDS),
        weight,
    ))
}

pub(super) fn check_weight(weight: f64) -> Result<()> {
    if !(weight >= 0.0 && weight.is_finite()) {
        return Err(Error::InvalidArgument {
            what: format!("the curvature weight is {weight}; it must be finite and at least 0"),
            index: None,
        });
    }
    Ok(())
}

/// The guides of a curvature.
pub(super) fn all_guides(mesh: &TriangleMesh, curvature: &Curvature, weight: f64) -> Vec<Guide> {
    let guide = |face| Guide {
        face,
        angle: curvature.direction[face],
        weight: weight * mesh.area(face) * curvature.reliability(face).powi(2),
    };
    let guides = (0..mesh.face_count()).map(guide);
    guides.filter(|guide| guide.weight > LIGHT).collect()
}
