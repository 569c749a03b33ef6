//! Mirror planes of a mesh.

use std::ffi::c_char;

use super::guard;
use super::input::text;
use super::mesh::roundel_mesh;
use super::output::{Out, copy_numbers};
use super::status::roundel_status;
use crate::mesh::TriangleMesh;
use crate::mesh::mirror::{Mirror, mirror_planes};

/// Gives the mirror plane that a text means for a mesh, as roundel_quad_options_add_mirror takes it: the
/// points p with n . p = d. `plane` is four numbers: n, of length 1, which points to the side that is kept,
/// and d. `deviation` is the largest distance of a mirrored vertex from the surface, as a part of the diagonal
/// of the bounding box: 0 for a mesh that is symmetric.
///
/// Fails with ROUNDEL_ERROR_INVALID_ARGUMENT for another text or a plane without a direction.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn roundel_mesh_mirror_plane(
    mesh: *const roundel_mesh,
    mirror: *const c_char,
    plane: *mut f64,
    deviation: *mut f64,
) -> roundel_status {
    let body = |mesh: &TriangleMesh| {
        // SAFETY: the caller gives a text and a place, or NULL.
        let (word, place) = unsafe { (text("mirror", mirror)?, Out::new("deviation", deviation)?) };
        let asked: Mirror = word.parse()?;
        // Any plane is told, however far the mesh is from symmetric.
        let found = mirror_planes(mesh, &[asked], f64::INFINITY)?;
        let [x, y, z] = found[0].normal;
        let numbers = [x, y, z, found[0].offset].into_iter();
        // SAFETY: the caller gives four numbers, or NULL.
        unsafe { copy_numbers("plane", numbers, plane, 4) }?;
        place.set(found[0].deviation);
        Ok(())
    };
    // SAFETY: the caller gives a live handle, or NULL.
    unsafe { guard::read(mesh, body) }
}
