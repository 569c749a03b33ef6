//! Faces whose direction the surface itself gives: those with a reliable curvature direction.

use super::{Constraint, Guide};
use crate::mesh::TriangleMesh;
use crate::mesh::curvature::{Curvature, SMOOTHING_ROUNDS, smoothed_curvature};
use crate::{Error, Result};

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

/// How many faces this fraction is.
pub(super) fn count(mesh: &TriangleMesh, fraction: f64) -> Result<usize> {
    if !(0.0..=1.0).contains(&fraction) {
        return Err(Error::InvalidArgument {
            what: format!("the fraction of constrained faces is {fraction}, outside 0 to 1"),
            index: None,
        });
    }
    Ok((fraction * mesh.face_count() as f64).round() as usize)
}

/// So many faces with the most reliable direction.
pub(super) fn most_reliable(curvature: &Curvature, count: usize) -> Vec<Constraint> {
    let mut faces = curvature.by_reliability();
    faces.truncate(count);
    faces.sort_unstable();
    let constraint = |face| Constraint {
        face,
        angle: curvature.direction[face],
    };
    faces.into_iter().map(constraint).collect()
}

/// A guide lighter than this is left out: edges weigh 1, and it would drown in their rounding.
const LIGHT: f64 = 1e-9;

/// A guide for every face towards the direction of least absolute curvature, with the weight
/// `weight * area * (|k1| - |k2|)^2`: nothing where the surface is flat or round.
///
/// On a refined mesh the squares of angles between neighbours fall as areas do, so that the balance
/// between smoothness and curvature depends neither on the triangles nor on the size.
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
            what: format!("the weight of curvature is {weight}, not a number from 0"),
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
