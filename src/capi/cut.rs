//! The cut handle: a mesh cut along curves.

use super::curves::roundel_curves;
use super::guard::{self, Guarded, object};
use super::mesh::roundel_mesh;
use super::output::{Out, copy_numbers};
use super::status::roundel_status;
use crate::geodesic::{SurfacePoint, cut_along};
use crate::mesh::TriangleMesh;
use crate::mesh::refine::CutAlong;

/// A mesh that was cut along curves, so that they are chains of edges: features that a field and quads can follow.
pub struct roundel_cut(Guarded<CutAlong>);

object!(roundel_cut, CutAlong, "cut");

/// Cuts the faces of a mesh along curves. Vertices keep their numbers and places, new ones follow, and the surface stays
/// where it is. A curve is moved by at most a tenth of the shortest edge of the face, and at most 1/1000 of the diagonal
/// of the bounding box, where it then runs through a vertex or along an edge. To be freed with roundel_cut_free.
///
/// Fails, with the number of the curve as roundel_last_error_index, with ROUNDEL_ERROR_INVALID_ARGUMENT for one of fewer
/// than two points, with points that are not on the surface or lie on no common face, or so short that nothing is left
/// of it; ROUNDEL_ERROR_INDEX_OUT_OF_RANGE for a face that the mesh does not have; ROUNDEL_ERROR_NOT_FINITE for
/// barycentric coordinates that are no numbers.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn roundel_cut_new(
    mesh: *const roundel_mesh,
    curves: *const roundel_curves,
    cut: *mut *mut roundel_cut,
) -> roundel_status {
    let body = |mesh: &TriangleMesh| {
        // SAFETY: the caller gives live curves and a place for the handle, or NULL.
        let (curves, out): (&Vec<Vec<SurfacePoint>>, _) =
            unsafe { (guard::value(curves)?, Out::new("cut", cut)?) };
        out.set(guard::handle(cut_along(mesh, curves)?));
        Ok(())
    };
    // SAFETY: the caller gives a live handle, or NULL.
    unsafe { guard::read(mesh, body) }
}

/// Frees a cut. NULL is allowed.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn roundel_cut_free(cut: *mut roundel_cut) -> roundel_status {
    // SAFETY: the caller gives up the handle, or NULL.
    unsafe { guard::free(cut) }
}

/// Gives the mesh, to be freed with roundel_mesh_free. It does not need the cut.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn roundel_cut_mesh(
    cut: *const roundel_cut,
    mesh: *mut *mut roundel_mesh,
) -> roundel_status {
    let body = |found: &CutAlong| {
        // SAFETY: the caller gives a place for the handle, or NULL.
        let out = unsafe { Out::new("mesh", mesh) }?;
        out.set(guard::handle(found.cut.mesh.clone()));
        Ok(())
    };
    // SAFETY: the caller gives a live handle, or NULL.
    unsafe { guard::read(cut, body) }
}

/// Copies the face of the given mesh of which each face is a part. `length` is the number of faces.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn roundel_cut_face_origins(
    cut: *const roundel_cut,
    faces: *mut i32,
    length: usize,
) -> roundel_status {
    let body = |found: &CutAlong| {
        let origins = found.cut.face_origin.iter().map(|&face| face as i32);
        // SAFETY: the caller gives an array of `length` numbers, or NULL.
        unsafe { copy_numbers("faces of origin", origins, faces, length) }
    };
    // SAFETY: the caller gives a live handle, or NULL.
    unsafe { guard::read(cut, body) }
}

/// Marks the edges of the mesh that lie on curves: 1 for each, 0 for all others. `length` is the number of edges.
/// roundel_guidance_set_feature_edges makes edges features.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn roundel_cut_mark_curves(
    cut: *const roundel_cut,
    marks: *mut i32,
    length: usize,
) -> roundel_status {
    let body = |found: &CutAlong| {
        let mut is_on = vec![0; found.cut.mesh.edge_count()];
        found.edges().into_iter().for_each(|edge| is_on[edge] = 1);
        // SAFETY: the caller gives an array of `length` numbers, or NULL.
        unsafe { copy_numbers("marks of edges", is_on.into_iter(), marks, length) }
    };
    // SAFETY: the caller gives a live handle, or NULL.
    unsafe { guard::read(cut, body) }
}
