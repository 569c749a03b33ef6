//! The field handle: queries of an orientation field.

use super::failure::Outcome;
use super::guard::{self, Guarded, object};
use super::output::{Out, copy_numbers};
use super::solution::roundel_solution;
use super::status::roundel_status;
use crate::field::OrientationField;
use crate::mesh::TriangleMesh;
use crate::mesh::features::FeatureGraph;
use crate::solve::Solution;

/// The results of a field, copied so that the mesh need not live as long.
pub(super) struct Found {
    field: OrientationField,
    /// The edges that the field was told to follow.
    features: FeatureGraph,
    solution: Solution,
    energy: f64,
    /// Indices in steps of 1/N of a turn.
    vertex_index_steps: Vec<i32>,
    traced_index_steps: Vec<i32>,
    boundary_index_steps: Vec<i32>,
}

impl Found {
    pub(super) fn new(
        mesh: &TriangleMesh,
        field: OrientationField,
        features: FeatureGraph,
        solution: Solution,
    ) -> Self {
        Found {
            energy: field.energy(mesh),
            vertex_index_steps: field.vertex_index_steps(mesh),
            traced_index_steps: field.traced_index_steps(mesh),
            boundary_index_steps: field.boundary_index_steps(mesh),
            field,
            features,
            solution,
        }
    }

    pub(super) fn field(&self) -> &OrientationField {
        &self.field
    }

    pub(super) fn features(&self) -> &FeatureGraph {
        &self.features
    }
}

/// An N-symmetric direction field of a mesh: N arms in every face, a cross for N = 4, and their matching
/// across edges. The mesh may be freed before the field.
pub struct roundel_field(Guarded<Found>);

object!(roundel_field, Found, "field");

/// Frees a field. NULL is allowed.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn roundel_field_free(field: *mut roundel_field) -> roundel_status {
    // SAFETY: the caller gives up the handle, or NULL.
    unsafe { guard::free(field) }
}

/// An entry that copies one list of numbers of a field.
///
/// # Safety
/// `field` is NULL or a live handle, `to` NULL or an array of `length` numbers.
unsafe fn copy<T: Copy>(
    field: *const roundel_field,
    what: &'static str,
    values: impl FnOnce(&Found) -> &[T],
    to: *mut T,
    length: usize,
) -> roundel_status {
    let body = |found: &Found| -> Outcome {
        // SAFETY: handed on.
        unsafe { copy_numbers(what, values(found).iter().copied(), to, length) }
    };
    // SAFETY: handed on.
    unsafe { guard::read(field, body) }
}

/// An entry that copies one list of indices of a field in full turns.
///
/// # Safety
/// As [`copy`].
unsafe fn copy_turns(
    field: *const roundel_field,
    what: &'static str,
    steps: impl FnOnce(&Found) -> &[i32],
    to: *mut f64,
    length: usize,
) -> roundel_status {
    let body = |found: &Found| -> Outcome {
        let turns = steps(found).iter().map(|&n| found.field.turns(n));
        // SAFETY: handed on.
        unsafe { copy_numbers(what, turns, to, length) }
    };
    // SAFETY: handed on.
    unsafe { guard::read(field, body) }
}

/// Copies the angle of one arm of every face, in radians, counter-clockwise about the normal from the
/// face's first edge. The angle is not reduced modulo the angle between arms, because the period jumps
/// belong to these values. `length` is the number of faces.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn roundel_field_angles(
    field: *const roundel_field,
    angles: *mut f64,
    length: usize,
) -> roundel_status {
    // SAFETY: the caller gives a live handle and an array of `length` numbers, or NULL.
    unsafe { copy(field, "angles", |f| f.field.angles(), angles, length) }
}

/// Copies the period jump of every edge, from its first to its second face: angle + kappa + 2 pi/N
/// jump is the matching arm of the second. Zero at the boundary. `length` is the number of edges.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn roundel_field_period_jumps(
    field: *const roundel_field,
    jumps: *mut i32,
    length: usize,
) -> roundel_status {
    // SAFETY: the caller gives a live handle and an array of `length` numbers, or NULL.
    unsafe {
        copy(
            field,
            "period jumps",
            |f| f.field.period_jumps(),
            jumps,
            length,
        )
    }
}

/// Copies kappa of every edge: the angle of the frame of its first face seen in that of its second,
/// after unfolding, in (-pi, pi]. Zero at the boundary. `length` is the number of edges.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn roundel_field_kappa(
    field: *const roundel_field,
    kappa: *mut f64,
    length: usize,
) -> roundel_status {
    // SAFETY: the caller gives a live handle and an array of `length` numbers, or NULL.
    unsafe { copy(field, "kappa", |f| f.field.kappa(), kappa, length) }
}

/// Copies the index of every vertex in full turns, from the period jumps: the steps that
/// roundel_field_vertex_index_steps gives over N, and +1/4 at the corner of a cube. Multiples of 1/4 are
/// exact; those of 1/6 are rounded once. Zero for vertices of the boundary. `length` is the number of
/// vertices.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn roundel_field_vertex_indices(
    field: *const roundel_field,
    indices: *mut f64,
    length: usize,
) -> roundel_status {
    // SAFETY: the caller gives a live handle and an array of `length` numbers, or NULL.
    unsafe {
        copy_turns(
            field,
            "vertex indices",
            |f| &f.vertex_index_steps,
            indices,
            length,
        )
    }
}

/// Copies the same indices as roundel_field_vertex_indices, computed in another way: by following an arm
/// of the cross in space around each vertex.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn roundel_field_traced_indices(
    field: *const roundel_field,
    indices: *mut f64,
    length: usize,
) -> roundel_status {
    // SAFETY: the caller gives a live handle and an array of `length` numbers, or NULL.
    unsafe {
        copy_turns(
            field,
            "traced indices",
            |f| &f.traced_index_steps,
            indices,
            length,
        )
    }
}

/// Copies the index of every boundary loop in full turns, as roundel_field_vertex_indices those of the
/// vertices. Together they sum to the Euler characteristic. `length` is the number of boundary loops.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn roundel_field_boundary_indices(
    field: *const roundel_field,
    indices: *mut f64,
    length: usize,
) -> roundel_status {
    // SAFETY: the caller gives a live handle and an array of `length` numbers, or NULL.
    unsafe {
        copy_turns(
            field,
            "boundary indices",
            |f| &f.boundary_index_steps,
            indices,
            length,
        )
    }
}

/// Gives the energy, recomputed on the mesh from angles and period jumps: the sum over interior
/// edges, not between two constrained faces, of (angle + kappa + 2 pi/N jump - other angle)^2.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn roundel_field_energy(
    field: *const roundel_field,
    energy: *mut f64,
) -> roundel_status {
    let body = |found: &Found| {
        // SAFETY: the caller gives a place for the number, or NULL.
        unsafe { Out::new("energy", energy) }?.set(found.energy);
        Ok(())
    };
    // SAFETY: the caller gives a live handle, or NULL.
    unsafe { guard::read(field, body) }
}

/// Gives the number of irregular vertices: those whose index is not zero.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn roundel_field_irregular_count(
    field: *const roundel_field,
    count: *mut usize,
) -> roundel_status {
    let body = |found: &Found| {
        // SAFETY: the caller gives a place for the number, or NULL.
        let out = unsafe { Out::new("irregular count", count) }?;
        out.set(found.vertex_index_steps.iter().filter(|&&n| n != 0).count());
        Ok(())
    };
    // SAFETY: the caller gives a live handle, or NULL.
    unsafe { guard::read(field, body) }
}

/// Makes a copy of the solution behind a field, which tells how the solve ended, its lower bound
/// and its times. To be freed with roundel_solution_free.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn roundel_field_solution(
    field: *const roundel_field,
    solution: *mut *mut roundel_solution,
) -> roundel_status {
    let body = |found: &Found| {
        // SAFETY: the caller gives a place for the handle, or NULL.
        let out = unsafe { Out::new("solution", solution) }?;
        out.set(guard::handle(found.solution.clone()));
        Ok(())
    };
    // SAFETY: the caller gives a live handle, or NULL.
    unsafe { guard::read(field, body) }
}

/// Gives N, the number of arms that a field has in a face.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn roundel_field_symmetry(
    field: *const roundel_field,
    arms: *mut i32,
) -> roundel_status {
    let body = |found: &Found| {
        // SAFETY: the caller gives a place for the number, or NULL.
        let out = unsafe { Out::new("symmetry", arms) }?;
        out.set(i32::from(found.field().symmetry()));
        Ok(())
    };
    // SAFETY: the caller gives a live handle, or NULL.
    unsafe { guard::read(field, body) }
}

/// Copies the index of every vertex in steps of 1/N of a turn, which are quarters for crosses: 1 at the
/// corner of a cube. They are integers, to be compared and counted. Vertices of the boundary have no
/// index, and 0 here: boundary loops have one. `length` is the number of vertices.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn roundel_field_vertex_index_steps(
    field: *const roundel_field,
    steps: *mut i32,
    length: usize,
) -> roundel_status {
    // SAFETY: the caller gives a live handle and an array of `length` numbers, or NULL.
    unsafe {
        copy(
            field,
            "vertex index steps",
            |f| &f.vertex_index_steps,
            steps,
            length,
        )
    }
}

/// Copies the index of every boundary loop in steps of 1/N of a turn. With those of the vertices they sum
/// to N times the Euler characteristic. `length` is the number of boundary loops.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn roundel_field_boundary_index_steps(
    field: *const roundel_field,
    steps: *mut i32,
    length: usize,
) -> roundel_status {
    // SAFETY: the caller gives a live handle and an array of `length` numbers, or NULL.
    unsafe {
        copy(
            field,
            "boundary index steps",
            |f| &f.boundary_index_steps,
            steps,
            length,
        )
    }
}
