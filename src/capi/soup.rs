//! The soup handle: made from arrays or read from a file, copied out, freed.

use std::ffi::c_char;
use std::path::Path;

use super::failure::Outcome;
use super::guard::{self, Guarded, boundary, object};
use super::input::{Index, path, slice, text};
use super::mesh::{reserved, times_three};
use super::output::{Out, copy_numbers, fill, places};
use super::status::roundel_status;
use crate::error::{Error, Result};
use crate::soup::PolygonSoup;

/// A polygon soup: vertices, and polygons with any number of corners. Nothing is assumed of it: coordinates
/// may be infinite, corners may name vertices that are not there, polygons may overlap. It does not change
/// once made. roundel_soup_repair makes a mesh of it.
pub struct roundel_soup(Guarded<PolygonSoup>);

object!(roundel_soup, PolygonSoup, "soup");

/// The soup of the caller's vertices and polygons.
///
/// # Safety
/// The arrays are as the caller of the entry says.
pub(super) unsafe fn of_arrays<I: Index>(
    (vertex_count, coordinates): (usize, *const f64),
    (polygon_count, sizes): (usize, *const i32),
    (corner_count, corners): (usize, *const I),
) -> Outcome<PolygonSoup> {
    let length = times_three("coordinates", vertex_count)?;
    // SAFETY: handed on.
    let (coordinates, sizes, corners) = unsafe {
        (
            slice("coordinates", coordinates, length)?,
            slice("sizes", sizes, polygon_count)?,
            slice("corners", corners, corner_count)?,
        )
    };
    let mut starts = reserved("the polygons", polygon_count.saturating_add(1))?;
    starts.push(0);
    let mut all = 0_usize;
    for (index, &size) in sizes.iter().enumerate() {
        let size = usize::try_from(size).map_err(|_| Error::InvalidArgument {
            what: format!("sizes: entry {index} is {size}, a negative number of corners"),
            index: Some(index),
        })?;
        all = all.saturating_add(size);
        starts.push(all);
    }
    if all != corner_count {
        Err(Error::LengthMismatch {
            what: "corners",
            expected: all,
            actual: corner_count,
        })?;
    }
    let mut positions = reserved("the vertices", vertex_count)?;
    positions.extend(coordinates.as_chunks::<3>().0);
    let mut named = reserved("the corners", corner_count)?;
    named.extend(corners.iter().map(|&v| -> i64 { v.into() }));
    Ok(PolygonSoup::of_lists(positions, named, starts))
}

/// # Safety
/// The arrays are as the caller of the entry says.
unsafe fn from_arrays<I: Index>(
    vertices: (usize, *const f64),
    polygons: (usize, *const i32),
    corners: (usize, *const I),
    soup: *mut *mut roundel_soup,
) -> Outcome {
    // SAFETY: handed on.
    let (out, made) = unsafe {
        (
            Out::new("soup", soup)?,
            of_arrays(vertices, polygons, corners)?,
        )
    };
    out.set(guard::handle(made));
    Ok(())
}

/// Makes a soup of `vertex_count` vertices, whose `coordinates` are x, y, z in turn, and `polygon_count`
/// polygons. `sizes` are their numbers of corners, and `corners` the vertices of all polygons, one polygon
/// after the other. Corners that name no vertex are kept, for repair to tell.
///
/// Fails with ROUNDEL_ERROR_LENGTH_MISMATCH if the sizes do not add up to `corner_count`, and with
/// ROUNDEL_ERROR_INVALID_ARGUMENT for a negative size.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn roundel_soup_new(
    vertex_count: usize,
    coordinates: *const f64,
    polygon_count: usize,
    sizes: *const i32,
    corner_count: usize,
    corners: *const i32,
    soup: *mut *mut roundel_soup,
) -> roundel_status {
    boundary(None, || {
        let vertices = (vertex_count, coordinates);
        let polygons = (polygon_count, sizes);
        // SAFETY: the caller gives arrays of the lengths given and a place, or NULL.
        unsafe { from_arrays(vertices, polygons, (corner_count, corners), soup) }
    })
}

/// roundel_soup_new with 64-bit corners.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn roundel_soup_new_i64(
    vertex_count: usize,
    coordinates: *const f64,
    polygon_count: usize,
    sizes: *const i32,
    corner_count: usize,
    corners: *const i64,
    soup: *mut *mut roundel_soup,
) -> roundel_status {
    boundary(None, || {
        let vertices = (vertex_count, coordinates);
        let polygons = (polygon_count, sizes);
        // SAFETY: the caller gives arrays of the lengths given and a place, or NULL.
        unsafe { from_arrays(vertices, polygons, (corner_count, corners), soup) }
    })
}

#[cfg(feature = "mesh-io")]
fn read(file: &Path, format: Option<&str>) -> Result<PolygonSoup> {
    use crate::soup::io::{self, Format};
    let read = match format {
        None => io::read(file),
        Some(word) => Format::by_name(word).and_then(|format| io::read_as(file, format)),
    };
    read.map_err(Error::from)
}

#[cfg(not(feature = "mesh-io"))]
fn read(file: &Path, _: Option<&str>) -> Result<PolygonSoup> {
    super::mesh_files::without_files(file)
}

/// Makes a soup of a file in OBJ, OFF, PLY, STL, glTF or GLB, according to its extension; a further
/// extension .gz is passed over. Vertices and polygons keep the numbers of the file.
///
/// Fails with ROUNDEL_ERROR_IO, ROUNDEL_ERROR_PARSE with the line at fault in a text, and
/// ROUNDEL_ERROR_NOT_SUPPORTED for another extension.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn roundel_soup_read(
    file: *const c_char,
    soup: *mut *mut roundel_soup,
) -> roundel_status {
    boundary(None, || {
        // SAFETY: the caller gives a text and a place for the handle, or NULL.
        let (file, out) = unsafe { (path("file", file)?, Out::new("soup", soup)?) };
        super::mesh_files::room_to_read(file)?;
        out.set(guard::handle(read(file, None)?));
        Ok(())
    })
}

/// roundel_soup_read for a file of any name, whose format is "obj", "off", "ply", "stl", "gltf" or "glb".
#[unsafe(no_mangle)]
pub unsafe extern "C" fn roundel_soup_read_as(
    file: *const c_char,
    format: *const c_char,
    soup: *mut *mut roundel_soup,
) -> roundel_status {
    boundary(None, || {
        // SAFETY: the caller gives texts and a place for the handle, or NULL.
        let (file, format, out) = unsafe {
            (
                path("file", file)?,
                text("format", format)?,
                Out::new("soup", soup)?,
            )
        };
        super::mesh_files::room_to_read(file)?;
        out.set(guard::handle(read(file, Some(format))?));
        Ok(())
    })
}

/// Frees a soup. NULL is allowed.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn roundel_soup_free(soup: *mut roundel_soup) -> roundel_status {
    // SAFETY: the caller gives up the handle, or NULL.
    unsafe { guard::free(soup) }
}

/// Gives the number of vertices.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn roundel_soup_vertex_count(
    soup: *const roundel_soup,
    count: *mut usize,
) -> roundel_status {
    let body = |soup: &PolygonSoup| {
        // SAFETY: the caller gives a place for the number, or NULL.
        unsafe { Out::new("vertex count", count) }?.set(soup.positions().len());
        Ok(())
    };
    // SAFETY: the caller gives a live handle, or NULL.
    unsafe { guard::read(soup, body) }
}

/// Gives the number of polygons, and the number of all their corners. Neither place may be NULL.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn roundel_soup_polygon_counts(
    soup: *const roundel_soup,
    count: *mut usize,
    corner_count: *mut usize,
) -> roundel_status {
    let body = |soup: &PolygonSoup| {
        // SAFETY: the caller gives places for the numbers, or NULL.
        let (count, corners) = unsafe {
            (
                Out::new("polygon count", count)?,
                Out::new("corner count", corner_count)?,
            )
        };
        count.set(soup.polygon_count());
        corners.set(soup.corners().len());
        Ok(())
    };
    // SAFETY: the caller gives a live handle, or NULL.
    unsafe { guard::read(soup, body) }
}

/// Copies x, y, z of every vertex. `length` is three times the number of vertices.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn roundel_soup_coordinates(
    soup: *const roundel_soup,
    coordinates: *mut f64,
    length: usize,
) -> roundel_status {
    let body = |soup: &PolygonSoup| {
        let values = soup.positions().as_flattened().iter().copied();
        // SAFETY: the caller gives an array of `length` numbers, or NULL.
        unsafe { copy_numbers("coordinates", values, coordinates, length) }
    };
    // SAFETY: the caller gives a live handle, or NULL.
    unsafe { guard::read(soup, body) }
}

/// Copies the number of corners of every polygon, and the corners of all, one polygon after the other. The
/// lengths are those of roundel_soup_polygon_counts. Corners have 64 bits, as files may name any vertex.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn roundel_soup_polygons(
    soup: *const roundel_soup,
    count: usize,
    sizes: *mut i32,
    corner_count: usize,
    corners: *mut i64,
) -> roundel_status {
    let body = |soup: &PolygonSoup| {
        let fits = |polygon: &[i64]| i32::try_from(polygon.len()).is_ok();
        if let Some(index) = soup.polygons().position(|polygon| !fits(polygon)) {
            Err(Error::Overflow {
                what: format!("polygon {index} has more than 2^31 - 1 corners"),
                index: Some(index),
            })?;
        }
        // SAFETY: the caller gives arrays of the lengths given, or NULL.
        let (sizes, corners) = unsafe {
            (
                places("sizes", soup.polygon_count(), sizes, count)?,
                places("corners", soup.corners().len(), corners, corner_count)?,
            )
        };
        fill(sizes, soup.polygons().map(|polygon| polygon.len() as i32));
        corners.copy_from_slice(soup.corners());
        Ok(())
    };
    // SAFETY: the caller gives a live handle, or NULL.
    unsafe { guard::read(soup, body) }
}
