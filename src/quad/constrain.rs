//! Faces whose direction the surface itself gives: those with a reliable curvature direction.

use super::{Constraint, Guide};
use crate::mesh::TriangleMesh;
use crate::mesh::curvature::curvature;
use crate::{Error, Result};

/// Constrains `fraction` of the faces (rounded to the nearest count), those with the largest
/// difference between the absolute principal curvatures, to the direction of least absolute
/// curvature. In increasing order of faces.
///
/// # Errors
/// [`Error::InvalidArgument`] for a fraction outside [0, 1].
pub fn curvature_constraints(mesh: &TriangleMesh, fraction: f64) -> Result<Vec<Constraint>> {
    if !(0.0..=1.0).contains(&fraction) {
        return Err(Error::InvalidArgument {
            what: format!("the fraction of constrained faces is {fraction}, outside 0 to 1"),
            index: None,
        });
    }
    let count = (fraction * mesh.face_count() as f64).round() as usize;
    if count == 0 {
        return Ok(Vec::new());
    }
    let curvature = curvature(mesh);
    let mut faces = curvature.by_reliability();
    faces.truncate(count);
    faces.sort_unstable();
    let constraint = |face| Constraint {
        face,
        angle: curvature.direction[face],
    };
    Ok(faces.into_iter().map(constraint).collect())
}

/// A guide for every face towards the direction of least absolute curvature, with the weight
/// `weight * area * (|k1| - |k2|)^2`: nothing where the surface is flat or round.
///
/// On a refined mesh the squares of angles between neighbours fall as areas do, so that the balance
/// between smoothness and curvature depends neither on the triangles nor on the size.
///
/// # Errors
/// [`Error::InvalidArgument`] for a weight that is negative or not finite.
pub fn curvature_guides(mesh: &TriangleMesh, weight: f64) -> Result<Vec<Guide>> {
    if !(weight >= 0.0 && weight.is_finite()) {
        return Err(Error::InvalidArgument {
            what: format!("the weight of curvature is {weight}, not a number from 0"),
            index: None,
        });
    }
    if weight == 0.0 {
        return Ok(Vec::new());
    }
    let curvature = curvature(mesh);
    let guide = |face| Guide {
        face,
        angle: curvature.direction[face],
        weight: weight * mesh.area(face) * curvature.reliability(face).powi(2),
    };
    Ok((0..mesh.face_count()).map(guide).collect())
}
