//! glTF 2.0 (Khronos Group, 2021), as JSON and as a binary file.
//!
//! Read are all primitives of triangles of the meshes of a scene, at the places that the nodes give them, with their
//! materials, normals, and first texture coordinates and colours; images, skins, morph targets and animations are not.
//! A transform that mirrors turns the triangles, so that they face the same side as before. Primitives of a mesh that
//! share positions share vertices. A number that names no vertex of its own primitive becomes negative, so that it
//! names none of another.
//!
//! The crate `gltf` was looked at: it refuses positions without bounds and most required extensions, and
//! where its validation is passed over it panics on files that are not sound; it reads positions of
//! single precision only, not those of `KHR_mesh_quantization`; and its loader of buffers requires images.

mod accessor;
mod attributes;
mod buffers;
mod container;
mod document;
mod scene;

use std::collections::BTreeMap;
use std::path::Path;

use super::strips;
use crate::soup::{PolygonSoup, SoupError};
use buffers::Buffers;
use document::{Document, Mesh, Primitive};
use scene::Transform;

pub(super) use attributes::{attributes, has_attributes};
pub(super) use container::MAGIC;

/// How many numbers all instances of the meshes may come to: so many for each byte of the file, and a
/// few million for any file.
const NUMBERS_PER_BYTE: usize = 64;
const NUMBERS: usize = 1 << 24;

pub(super) fn parse(bytes: &[u8], folder: Option<&Path>) -> Result<PolygonSoup, SoupError> {
    let (document, own) = container::open(bytes)?;
    read(&document, own, bytes.len(), folder, |_, _, _| Ok(()))
}

/// What a primitive has added to a soup: its last polygons, and vertices that others may share.
struct Part<'a> {
    primitive: &'a Primitive,
    /// The first of its vertices.
    first: usize,
    vertices: usize,
}

impl Part<'_> {
    /// The accessor of an attribute of its vertices, if they have it.
    fn accessor(&self, attribute: &str) -> Option<usize> {
        self.primitive.attributes.get(attribute).copied()
    }
}

/// Reads the scene of a document whose file has `size` bytes, `own` of them a buffer, and tells of each part, with the
/// soup up to its end.
fn read(
    document: &Document,
    own: Option<&[u8]>,
    size: usize,
    folder: Option<&Path>,
    mut tell: impl FnMut(&mut Source, &Part, &PolygonSoup) -> Result<(), SoupError>,
) -> Result<PolygonSoup, SoupError> {
    let required = document.extensions_required.iter();
    if let Some(name) = required.into_iter().find(|name| !is_harmless(name)) {
        return Err(not_supported(name));
    }
    let mut source = Source {
        document,
        buffers: Buffers::new(document, own, folder),
        json: size,
        spent: 0,
    };
    let mut soup = PolygonSoup::default();
    for (number, transform) in scene::meshes(document)? {
        let mesh = document.meshes.get(number);
        let mesh = mesh.ok_or_else(|| malformed(format!("there is no mesh {number}")))?;
        source.add_mesh(mesh, &transform, &mut soup, &mut tell)?;
    }
    Ok(soup)
}

/// Whether a required extension leaves surfaces as they are, or is read.
fn is_harmless(name: &str) -> bool {
    let parts = [
        "_materials_",
        "_texture_",
        "_lights_",
        "_animation_",
        "_xmp",
    ];
    name == "KHR_mesh_quantization" || parts.iter().any(|part| name.contains(part))
}

/// Where the arrays of a document come from.
struct Source<'a> {
    document: &'a Document,
    buffers: Buffers<'a>,
    /// Bytes of the file itself.
    json: usize,
    /// Numbers read so far.
    spent: usize,
}

impl Source<'_> {
    /// Counts numbers before they are allocated: instances and sparse arrays multiply those of the file.
    fn spend(&mut self, numbers: usize) -> Result<(), SoupError> {
        self.spent = self.spent.saturating_add(numbers);
        let bytes = self.json.saturating_add(self.buffers.size());
        if self.spent > NUMBERS.max(bytes.saturating_mul(NUMBERS_PER_BYTE)) {
            return Err(malformed(format!(
                "the scene repeats its meshes until they hold {} numbers, more than {NUMBERS_PER_BYTE} \
                 for each byte of the file",
                self.spent
            )));
        }
        Ok(())
    }

    fn add_mesh(
        &mut self,
        mesh: &Mesh,
        transform: &Transform,
        soup: &mut PolygonSoup,
        tell: &mut impl FnMut(&mut Source, &Part, &PolygonSoup) -> Result<(), SoupError>,
    ) -> Result<(), SoupError> {
        // The first vertex and the number of vertices of each array of positions.
        let mut placed: BTreeMap<usize, (i64, usize)> = BTreeMap::new();
        for primitive in &mesh.primitives {
            let Some(&accessor) = primitive.attributes.get("POSITION") else {
                continue;
            };
            if !matches!(primitive.mode, None | Some(4..)) {
                continue;
            }
            self.check(primitive, accessor)?;
            let (first, count) = match placed.get(&accessor) {
                Some(&place) => place,
                None => {
                    let positions = self.positions(accessor)?;
                    self.spend(positions.len())?;
                    let place = (soup.positions().len() as i64, positions.len());
                    for position in positions {
                        soup.add_vertex(match transform.is_identity() {
                            true => position,
                            false => transform.of_point(position),
                        });
                    }
                    placed.insert(accessor, place);
                    place
                }
            };
            let mut corners = match primitive.indices {
                Some(accessor) => self.indices(accessor)?,
                None => (0..count as i64).collect(),
            };
            self.spend(corners.len())?;
            for corner in &mut corners {
                *corner = match *corner < count as i64 {
                    true => first + *corner,
                    false => -1 - *corner,
                };
            }
            add_triangles(primitive, &corners, transform.mirrors(), soup)?;
            let part = Part {
                primitive,
                first: first as usize,
                vertices: count,
            };
            tell(self, &part, soup)?;
        }
        Ok(())
    }

    /// Checks that the positions are not those of an extension.
    fn check(&self, primitive: &Primitive, accessor: usize) -> Result<(), SoupError> {
        let stored = self.document.accessors.get(accessor);
        let is_stored = stored.is_some_and(|stored| stored.buffer_view.is_some());
        match primitive
            .extensions
            .keys()
            .find(|name| name.contains("draco"))
        {
            Some(name) if !is_stored => Err(not_supported(name)),
            _ => Ok(()),
        }
    }
}

fn add_triangles(
    primitive: &Primitive,
    corners: &[i64],
    mirrored: bool,
    soup: &mut PolygonSoup,
) -> Result<(), SoupError> {
    let add = |[a, b, c]: [i64; 3]| {
        soup.add_polygon(if mirrored { [a, c, b] } else { [a, b, c] });
    };
    match primitive.mode.unwrap_or(4) {
        4 if corners.len().is_multiple_of(3) => corners.as_chunks().0.iter().copied().for_each(add),
        4 => {
            return Err(malformed(format!(
                "a primitive of triangles has {} corners, not a multiple of 3",
                corners.len()
            )));
        }
        5 => strips::strip(corners, add),
        6 => strips::fan(corners, add),
        mode => return Err(malformed(format!("there is no primitive mode {mode}"))),
    }
    Ok(())
}

fn malformed(message: String) -> SoupError {
    SoupError::Malformed { message }
}

fn not_supported(extension: &str) -> SoupError {
    malformed(format!(
        "the file needs the extension {extension}, which is not read; export it without"
    ))
}
