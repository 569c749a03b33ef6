//! Edges at which an attribute of a file changes.

use std::ffi::c_char;
use std::path::Path;

use super::guard;
use super::input::{path, text};
use super::mesh_files::room_to_read;
use super::output::copy_numbers;
use super::repair::{Made, roundel_repair};
use super::status::roundel_status;
use crate::error::Result;

#[cfg(feature = "mesh-io")]
fn marks(made: &Made, file: &Path, name: &str) -> Result<Vec<i32>> {
    use crate::error::Error;
    use crate::mesh::features::FeatureGraph;
    use crate::soup::io::{Attribute, Attributes, Format, read_as};

    let attribute = Attribute::by_name(name).ok_or_else(|| {
        let known = Attribute::ALL.map(Attribute::name).join(", ");
        Error::InvalidArgument {
            what: format!("'{name}' is no attribute; there are {known}"),
            index: None,
        }
    })?;
    let format = Format::of(file)?;
    let soup = read_as(file, format)?;
    let attributes = Attributes::read_as(file, format, &soup)?;
    let (mesh, repaired) = made.parts();
    let graph = FeatureGraph::by_attribute(mesh, (&soup, Some(repaired)), &attributes, attribute)?;
    let edges = 0..mesh.edge_count();
    Ok(edges.map(|e| i32::from(graph.contains(e))).collect())
}

#[cfg(not(feature = "mesh-io"))]
fn marks(_: &Made, file: &Path, _: &str) -> Result<Vec<i32>> {
    super::mesh_files::without_files(file)
}

/// Marks the edges of a repaired mesh whose two faces differ in an attribute of the file that the soup was
/// read from: 1 for each, 0 for all others. Attributes are "materials", "groups", "smoothing", "seams" (of
/// texture coordinates) and "normals" of OBJ files, and "colors" of the faces of PLY files. `length` is the
/// number of edges of the mesh. roundel_guidance_set_feature_edges makes edges features.
///
/// Fails as roundel_soup_read does, with ROUNDEL_ERROR_INVALID_ARGUMENT for another attribute and for one that
/// the file lacks, and with ROUNDEL_ERROR_LENGTH_MISMATCH for a file of another soup.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn roundel_repair_mark_attribute(
    repair: *const roundel_repair,
    file: *const c_char,
    attribute: *const c_char,
    marks: *mut i32,
    length: usize,
) -> roundel_status {
    let body = |made: &Made| {
        // SAFETY: the caller gives texts, or NULL.
        let (file, name) = unsafe { (path("file", file)?, text("attribute", attribute)?) };
        room_to_read(file)?;
        let found = self::marks(made, file, name)?.into_iter();
        // SAFETY: the caller gives an array of `length` numbers, or NULL.
        unsafe { copy_numbers("marks of edges", found, marks, length) }
    };
    // SAFETY: the caller gives a live handle, or NULL.
    unsafe { guard::read(repair, body) }
}
