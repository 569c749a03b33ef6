//! The attributes handle: what a file says of the faces, corners and vertices of a mesh.

use std::ffi::c_char;
use std::path::Path;

use super::guard::{self, Guarded, object};
use super::input::{path, text};
use super::mesh::roundel_mesh;
use super::mesh_files::room_to_read;
use super::output::{Out, copy_numbers, copy_whole};
use super::repair::{Made, roundel_repair};
use super::status::roundel_status;
use crate::error::{Error, Result};
use crate::mesh::TriangleMesh;
use crate::mesh::attributes::{FaceNames, SurfaceAttributes, VertexScalar};
use crate::soup::Repaired;

/// The attributes of a mesh: materials and groups of faces, colours of faces and vertices, texture coordinates of
/// corners, and scalars of vertices. They are arrays by the numbers of the mesh, which
/// roundel_quads_transfer_face_labels and its kin carry to quads. The mesh may be freed before them.
pub struct roundel_attributes(Guarded<SurfaceAttributes>);

object!(roundel_attributes, SurfaceAttributes, "attributes");

/// The names of all kinds.
const KINDS: [&str; 6] = [
    "materials",
    "groups",
    "face_colors",
    "uv",
    "vertex_colors",
    "scalars",
];

#[cfg(feature = "mesh-io")]
fn read(
    mesh: &TriangleMesh,
    repaired: Option<&Repaired>,
    file: &Path,
) -> Result<SurfaceAttributes> {
    use crate::soup::io::{Attributes, Format, read_as};

    let format = Format::of(file)?;
    let soup = read_as(file, format)?;
    let attributes = Attributes::read_as(file, format, &soup)?;
    SurfaceAttributes::of_file(mesh, (&soup, repaired), &attributes)
}

#[cfg(not(feature = "mesh-io"))]
fn read(_: &TriangleMesh, _: Option<&Repaired>, file: &Path) -> Result<SurfaceAttributes> {
    super::mesh_files::without_files(file)
}

/// Reads the attributes of a mesh from the file that roundel_mesh_read read it from. A file without attributes gives
/// none.
///
/// Fails as roundel_mesh_read does, and with ROUNDEL_ERROR_LENGTH_MISMATCH for a file of another mesh.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn roundel_mesh_read_attributes(
    mesh: *const roundel_mesh,
    file: *const c_char,
    attributes: *mut *mut roundel_attributes,
) -> roundel_status {
    let body = |mesh: &TriangleMesh| {
        // SAFETY: the caller gives a text and a place for the handle, or NULL.
        let (file, out) = unsafe { (path("file", file)?, Out::new("attributes", attributes)?) };
        room_to_read(file)?;
        out.set(guard::handle(read(mesh, None, file)?));
        Ok(())
    };
    // SAFETY: the caller gives a live handle, or NULL.
    unsafe { guard::read(mesh, body) }
}

/// Reads the attributes of a repaired mesh from the file that its soup was read from. Faces that repair made to fill
/// holes have none; vertices that it made have the mean of those around.
///
/// Fails as roundel_soup_read does, and with ROUNDEL_ERROR_LENGTH_MISMATCH for a file of another soup.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn roundel_repair_read_attributes(
    repair: *const roundel_repair,
    file: *const c_char,
    attributes: *mut *mut roundel_attributes,
) -> roundel_status {
    let body = |made: &Made| {
        // SAFETY: the caller gives a text and a place for the handle, or NULL.
        let (file, out) = unsafe { (path("file", file)?, Out::new("attributes", attributes)?) };
        room_to_read(file)?;
        let (mesh, repaired) = made.parts();
        out.set(guard::handle(read(mesh, Some(repaired), file)?));
        Ok(())
    };
    // SAFETY: the caller gives a live handle, or NULL.
    unsafe { guard::read(repair, body) }
}

/// Frees attributes. NULL is allowed.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn roundel_attributes_free(
    attributes: *mut roundel_attributes,
) -> roundel_status {
    // SAFETY: the caller gives up the handle, or NULL.
    unsafe { guard::free(attributes) }
}

/// Gives 1 if there are attributes of a kind: "materials", "groups", "face_colors", "uv", "vertex_colors" or
/// "scalars"; 0 if not.
///
/// Fails with ROUNDEL_ERROR_INVALID_ARGUMENT for another kind.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn roundel_attributes_has(
    attributes: *const roundel_attributes,
    kind: *const c_char,
    has: *mut i32,
) -> roundel_status {
    let body = |all: &SurfaceAttributes| {
        // SAFETY: the caller gives a text and a place for the number, or NULL.
        let (kind, out) = unsafe { (text("kind", kind)?, Out::new("has", has)?) };
        let found = match kind {
            "materials" | "groups" => names_of(all, kind).is_ok(),
            "scalars" => !all.scalars.is_empty(),
            "face_colors" | "uv" | "vertex_colors" => values_of(all, kind).is_ok(),
            _ => Err(unknown(kind, &KINDS))?,
        };
        out.set(found.into());
        Ok(())
    };
    // SAFETY: the caller gives a live handle, or NULL.
    unsafe { guard::read(attributes, body) }
}

/// Gives the number of names of a kind: of "materials", "groups" or "scalars"; 0 if there are none.
///
/// Fails with ROUNDEL_ERROR_INVALID_ARGUMENT for another kind.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn roundel_attributes_name_count(
    attributes: *const roundel_attributes,
    kind: *const c_char,
    count: *mut usize,
) -> roundel_status {
    let body = |all: &SurfaceAttributes| {
        // SAFETY: the caller gives a text and a place for the number, or NULL.
        let (kind, out) = unsafe { (text("kind", kind)?, Out::new("count", count)?) };
        out.set(all_names(all, kind)?.len());
        Ok(())
    };
    // SAFETY: the caller gives a live handle, or NULL.
    unsafe { guard::read(attributes, body) }
}

/// Copies a name of a kind, of "materials", "groups" or "scalars", to `buffer`, which has `capacity` bytes, with the
/// terminating NUL. Its length without the NUL is written to `length`, which may be NULL. If `buffer` is NULL and
/// `capacity` 0, only the length is written.
///
/// Fails with ROUNDEL_ERROR_INVALID_ARGUMENT for another kind, with ROUNDEL_ERROR_INDEX_OUT_OF_RANGE, and with
/// ROUNDEL_ERROR_LENGTH_MISMATCH if the buffer is too small.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn roundel_attributes_name(
    attributes: *const roundel_attributes,
    kind: *const c_char,
    index: usize,
    buffer: *mut c_char,
    capacity: usize,
    length: *mut usize,
) -> roundel_status {
    let body = |all: &SurfaceAttributes| {
        // SAFETY: the caller gives a text, or NULL.
        let kind = unsafe { text("kind", kind) }?;
        let names = all_names(all, kind)?;
        let name = *at("names", &names, index)?;
        // SAFETY: the caller gives a buffer of `capacity` bytes and a place for the length, or NULL.
        unsafe { copy_whole(name, buffer, capacity, length) }
    };
    // SAFETY: the caller gives a live handle, or NULL.
    unsafe { guard::read(attributes, body) }
}

/// Copies the number of each face's name of a kind, "materials" or "groups", or -1 for none. `length` is the number of
/// faces.
///
/// Fails with ROUNDEL_ERROR_INVALID_ARGUMENT for another kind and for one that there is not.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn roundel_attributes_labels(
    attributes: *const roundel_attributes,
    kind: *const c_char,
    labels: *mut i32,
    length: usize,
) -> roundel_status {
    let body = |all: &SurfaceAttributes| {
        // SAFETY: the caller gives a text, or NULL.
        let kind = unsafe { text("kind", kind) }?;
        // NO_NAME has the bits of -1.
        let found = names_of(all, kind)?.of_face.iter();
        let found = found.map(|label| label.cast_signed());
        // SAFETY: the caller gives an array of `length` numbers, or NULL.
        unsafe { copy_numbers("labels of faces", found, labels, length) }
    };
    // SAFETY: the caller gives a live handle, or NULL.
    unsafe { guard::read(attributes, body) }
}

/// Copies the numbers of a kind: "face_colors", red, green, blue and alpha from 0 to 1 of each face; "uv", two numbers
/// of each of the three corners of each face; or "vertex_colors", four numbers of each vertex. NaN stands for none.
///
/// Fails with ROUNDEL_ERROR_INVALID_ARGUMENT for another kind and for one that there is not, and with
/// ROUNDEL_ERROR_LENGTH_MISMATCH.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn roundel_attributes_values(
    attributes: *const roundel_attributes,
    kind: *const c_char,
    values: *mut f64,
    length: usize,
) -> roundel_status {
    let body = |all: &SurfaceAttributes| {
        // SAFETY: the caller gives a text, or NULL.
        let kind = unsafe { text("kind", kind) }?;
        let found = values_of(all, kind)?.iter().copied();
        // SAFETY: the caller gives an array of `length` numbers, or NULL.
        unsafe { copy_numbers("values", found, values, length) }
    };
    // SAFETY: the caller gives a live handle, or NULL.
    unsafe { guard::read(attributes, body) }
}

/// Copies the scalar of this index at every vertex; roundel_attributes_name tells its name. NaN stands for none.
///
/// Fails with ROUNDEL_ERROR_INDEX_OUT_OF_RANGE and ROUNDEL_ERROR_LENGTH_MISMATCH.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn roundel_attributes_scalar(
    attributes: *const roundel_attributes,
    index: usize,
    values: *mut f64,
    length: usize,
) -> roundel_status {
    let body = |all: &SurfaceAttributes| {
        let found = at("scalars", &all.scalars, index)?.values.iter().copied();
        // SAFETY: the caller gives an array of `length` numbers, or NULL.
        unsafe { copy_numbers("values", found, values, length) }
    };
    // SAFETY: the caller gives a live handle, or NULL.
    unsafe { guard::read(attributes, body) }
}

fn at<'a, T>(what: &'static str, all: &'a [T], index: usize) -> Result<&'a T> {
    all.get(index).ok_or_else(|| Error::IndexOutOfRange {
        what,
        position: 0,
        value: index.try_into().unwrap_or(i64::MAX),
        len: all.len(),
    })
}

fn unknown(kind: &str, known: &[&str]) -> Error {
    Error::InvalidArgument {
        what: format!(
            "'{kind}' is no kind of attributes here; there are {}",
            known.join(", ")
        ),
        index: None,
    }
}

fn missing(kind: &str) -> Error {
    Error::InvalidArgument {
        what: format!("there are no attributes of the kind '{kind}'"),
        index: None,
    }
}

fn names_of<'a>(all: &'a SurfaceAttributes, kind: &str) -> Result<&'a FaceNames> {
    let found = match kind {
        "materials" => &all.materials,
        "groups" => &all.groups,
        _ => return Err(unknown(kind, &["materials", "groups"])),
    };
    found.as_ref().ok_or_else(|| missing(kind))
}

fn all_names<'a>(all: &'a SurfaceAttributes, kind: &str) -> Result<Vec<&'a str>> {
    let of_faces = |names: &'a Option<FaceNames>| {
        let names = names.iter().flat_map(|names| &names.names);
        names.map(String::as_str).collect()
    };
    Ok(match kind {
        "materials" => of_faces(&all.materials),
        "groups" => of_faces(&all.groups),
        "scalars" => {
            let name = |scalar: &'a VertexScalar| scalar.name.as_str();
            all.scalars.iter().map(name).collect()
        }
        _ => return Err(unknown(kind, &["materials", "groups", "scalars"])),
    })
}

fn values_of<'a>(all: &'a SurfaceAttributes, kind: &str) -> Result<&'a [f64]> {
    let found = match kind {
        "face_colors" => all.face_colors.as_ref().map(|colors| colors.as_flattened()),
        "uv" => all.uv.as_ref().map(|uv| uv.as_flattened()),
        "vertex_colors" => {
            let colors = all.vertex_colors.as_ref();
            colors.map(|colors| colors.as_flattened())
        }
        _ => return Err(unknown(kind, &["face_colors", "uv", "vertex_colors"])),
    };
    found.ok_or_else(|| missing(kind))
}
