//! Meshes from and to files.

use std::ffi::c_char;
use std::path::Path;

use super::guard::{self, boundary};
use super::input::path;
use super::mesh::roundel_mesh;
use super::output::Out;
use super::status::roundel_status;
use crate::error::{Error, Result};
use crate::mesh::TriangleMesh;
use crate::monitor::room_for;

#[cfg(feature = "mesh-io")]
fn read(file: &Path) -> Result<TriangleMesh> {
    crate::mesh::io::read(file).map_err(Error::from)
}

#[cfg(feature = "mesh-io")]
fn write(file: &Path, mesh: &TriangleMesh) -> Result<()> {
    crate::mesh::io::write(file, mesh).map_err(Error::from)
}

// The exported symbols do not depend on features: programs link against either library.
#[cfg(not(feature = "mesh-io"))]
pub(super) fn without_files<T>(file: &Path) -> Result<T> {
    Err(Error::NotSupported {
        what: format!("{}: built without mesh files", file.display()),
        index: None,
        line: None,
    })
}

#[cfg(not(feature = "mesh-io"))]
fn read(file: &Path) -> Result<TriangleMesh> {
    without_files(file)
}

#[cfg(not(feature = "mesh-io"))]
fn write(file: &Path, _: &TriangleMesh) -> Result<()> {
    without_files(file)
}

/// The bytes that reading takes for each byte of a file, about: those of its numbers, and of one in ten that
/// was compressed.
const READING: [usize; 2] = [6, 60];

/// Fails where a file does not fit into memory while it is read. What cannot be asked for its length is not asked.
pub(super) fn room_to_read(file: &Path) -> Result<()> {
    let length = file.metadata().map_or(0, |file| file.len());
    let is_compressed = file.extension().is_some_and(|extension| extension == "gz");
    let length = usize::try_from(length).unwrap_or(usize::MAX);
    room_for("the file", length, READING[usize::from(is_compressed)])
}

/// Makes a mesh from a file in OBJ, OFF, PLY, STL, glTF or GLB, according to its extension; a further
/// extension .gz is passed over. Only triangles are read. roundel_soup_read and roundel_soup_repair take
/// any polygons.
///
/// Fails as roundel_mesh_new does, and with ROUNDEL_ERROR_IO, ROUNDEL_ERROR_PARSE with the line at fault,
/// ROUNDEL_ERROR_NOT_A_TRIANGLE and ROUNDEL_ERROR_INDEX_OUT_OF_RANGE with the face,
/// ROUNDEL_ERROR_NOT_SUPPORTED for another extension.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn roundel_mesh_read(
    file: *const c_char,
    mesh: *mut *mut roundel_mesh,
) -> roundel_status {
    boundary(None, || {
        // SAFETY: the caller gives a text and a place for the handle, or NULL.
        let (file, out) = unsafe { (path("file", file)?, Out::new("mesh", mesh)?) };
        room_to_read(file)?;
        out.set(guard::handle(read(file)?));
        Ok(())
    })
}

/// Writes a mesh as OBJ, OFF, binary PLY, binary STL, glTF, GLB or USD text (.usda), told apart by
/// extension; a further extension .gz compresses. Reading gives back the same numbers, but for STL and
/// glTF, which hold single precision; USD text is not read.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn roundel_mesh_write(
    mesh: *const roundel_mesh,
    file: *const c_char,
) -> roundel_status {
    let body = |mesh: &TriangleMesh| {
        // SAFETY: the caller gives a text, or NULL.
        let file = unsafe { path("file", file) }?;
        Ok(write(file, mesh)?)
    };
    // SAFETY: the caller gives a live handle, or NULL.
    unsafe { guard::read(mesh, body) }
}
