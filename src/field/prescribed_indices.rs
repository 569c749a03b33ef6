//! Prescribed indices as linear constraints on the period jumps around every vertex.
//!
//! The index of a vertex is what its ring of jumps sums to (see [`super::index`]), so that
//!
//! ```text
//! sum over the ring, counter-clockwise, of +-p = (2 pi (1 - I) - sum of angles - sum of +-kappa) N / 2 pi
//! ```
//!
//! an integer for every index that is a multiple of 1/N. Fields with given singularities, such as the
//! trivial connections of `crane2010`, section 2, are the special case in which all integers but those
//! around handles are given.

use super::PrescribedIndex;
use super::index::steps_without_jumps;
use crate::error::{Error, Result};
use crate::mesh::TriangleMesh;

/// The steps of every vertex: those of `given`, and zero.
///
/// # Errors
/// With the position, [`Error::IndexOutOfRange`], and [`Error::InvalidArgument`] for a vertex named
/// twice or on the boundary; [`Error::InvalidArgument`] where the indices of a closed component do
/// not sum to its Euler characteristic.
pub(super) fn steps(
    mesh: &TriangleMesh,
    symmetry: u8,
    given: &[PrescribedIndex],
) -> Result<Vec<i32>> {
    let mut steps = vec![None; mesh.vertex_count()];
    let refused = |position: usize, what: String| Error::InvalidArgument {
        what,
        index: Some(position),
    };
    for (position, &PrescribedIndex { vertex, steps: n }) in given.iter().enumerate() {
        let len = steps.len();
        let Some(place) = steps.get_mut(vertex) else {
            return Err(Error::IndexOutOfRange {
                what: "vertices with an index",
                position,
                value: i64::try_from(vertex).unwrap_or(i64::MAX),
                len,
            });
        };
        if mesh.is_boundary_vertex(vertex) {
            let what = format!("vertex {vertex} has no index: it lies on the boundary");
            return Err(refused(position, what));
        }
        if place.replace(n).is_some() {
            return Err(refused(
                position,
                format!("vertex {vertex} is given two indices"),
            ));
        }
    }
    let steps: Vec<i32> = steps.into_iter().map(Option::unwrap_or_default).collect();
    check_sums(mesh, symmetry, &steps)?;
    Ok(steps)
}

/// Checks that the indices of every closed component sum to its Euler characteristic (Poincaré, Hopf).
fn check_sums(mesh: &TriangleMesh, symmetry: u8, steps: &[i32]) -> Result<()> {
    let components = mesh.components();
    let of_face = |face: usize| components.of_face[face] as usize;
    // Euler characteristic, sum of steps, and whether there is a boundary.
    let mut sums = vec![(0_i64, 0_i64, false); components.count];
    for face in 0..mesh.face_count() {
        sums[of_face(face)].0 += 1;
    }
    for edge in mesh.edges() {
        let (euler, _, is_open) = &mut sums[of_face(edge.first.0)];
        *euler -= 1;
        *is_open |= edge.second.is_none();
    }
    for (v, &n) in steps.iter().enumerate() {
        let face = mesh.ring(v).next().map_or(0, |(face, _)| face);
        let (euler, sum, _) = &mut sums[of_face(face)];
        *euler += 1;
        *sum += i64::from(n);
    }
    for (component, (euler, sum, is_open)) in sums.into_iter().enumerate() {
        if !is_open && sum != i64::from(symmetry) * euler {
            return Err(Error::InvalidArgument {
                what: format!(
                    "the indices of component {component} sum to {sum}/{symmetry}, not to its \
                     Euler characteristic, {euler}"
                ),
                index: None,
            });
        }
    }
    Ok(())
}

/// What the jumps around an interior vertex sum to, counter-clockwise, for an index of `steps`.
pub(super) fn ring_sum(
    mesh: &TriangleMesh,
    kappa: &[f64],
    step: f64,
    vertex: usize,
    steps: i32,
) -> f64 {
    (steps_without_jumps(mesh, kappa, step, vertex) - i64::from(steps)) as f64
}
