//! The materials of the triangles of a scene, texture coordinates and normals of their corners, and colours of its
//! vertices.

use std::path::Path;

use super::document::Document;
use super::{Part, Source, container, malformed, read};
use crate::soup::io::attributes::{
    Attribute, Attributes, Color, Labels, NO_LABEL, Values, labels_of,
};
use crate::soup::{PolygonSoup, SoupError};

const TEXTURE: &str = "TEXCOORD_0";
const NORMAL: &str = "NORMAL";
const COLOR: &str = "COLOR_0";

/// Whether a document has materials, texture coordinates or colours.
pub(in crate::soup::io) fn has_attributes(bytes: &[u8]) -> Result<bool, SoupError> {
    let (document, _) = container::open(bytes)?;
    let has = |name| {
        let mut primitives = document.meshes.iter().flat_map(|mesh| &mesh.primitives);
        primitives.any(|primitive| primitive.attributes.contains_key(name))
    };
    Ok(!document.materials.is_empty() || has(TEXTURE) || has(COLOR))
}

/// The attributes of a file.
pub(in crate::soup::io) fn attributes(
    bytes: &[u8],
    folder: Option<&Path>,
) -> Result<Attributes, SoupError> {
    let (document, own) = container::open(bytes)?;
    let mut found = Found::default();
    let add = |source: &mut Source, part: &Part, soup: &PolygonSoup| found.add(source, part, soup);
    let soup = read(&document, own, bytes.len(), folder, add)?;
    Ok(found.attributes(&document, &soup))
}

/// The attributes of the primitives so far.
#[derive(Default)]
struct Found {
    materials: Labels,
    textures: OfCorners<2>,
    normals: OfCorners<3>,
    /// Of the first vertices; NaN for those that have none.
    colors: Vec<Color>,
}

impl Found {
    fn add(
        &mut self,
        source: &mut Source,
        part: &Part,
        soup: &PolygonSoup,
    ) -> Result<(), SoupError> {
        let material = part.primitive.material;
        let count = source.document.materials.len();
        if let Some(missing) = material.filter(|&material| material >= count) {
            return Err(malformed(format!("there is no material {missing}")));
        }
        let label = material.map_or(NO_LABEL, |material| material as u32);
        self.materials.resize(soup.polygon_count(), label);
        let mut textures = source.of_vertices::<2>(part, TEXTURE, "VEC2")?;
        // In glTF they start at the upper side of the image, in the other formats at the lower one.
        for [_, v] in textures.iter_mut().flatten() {
            *v = 1.0 - *v;
        }
        self.textures.add(textures, part, soup);
        let normals = source.of_vertices::<3>(part, NORMAL, "VEC3")?;
        self.normals.add(normals, part, soup);
        if let Some(colors) = colors(source, part)? {
            self.colors.resize(soup.positions().len(), [f64::NAN; 4]);
            for (known, color) in self.colors[part.first..].iter_mut().zip(colors) {
                // Primitives that share vertices may differ: the first counts.
                if known[0].is_nan() {
                    *known = color;
                }
            }
        }
        Ok(())
    }

    fn attributes(mut self, document: &Document, soup: &PolygonSoup) -> Attributes {
        let is_named = self.materials.iter().any(|&label| label != NO_LABEL);
        let has_colors = !self.colors.is_empty();
        self.colors.resize(soup.positions().len(), [f64::NAN; 4]);
        let (seams, normals) = (self.textures.labels(), self.normals.labels());
        let values = Values {
            materials: names(document),
            textures: self.textures.values,
            vertex_colors: has_colors.then_some(self.colors),
            ..Values::default()
        };
        Attributes::of(values)
            .with(Attribute::Materials, is_named.then_some(self.materials))
            .with(Attribute::Seams, seams)
            .with(Attribute::Normals, normals)
    }
}

/// The colours of the vertices of a part, if it has some. Those without alpha are opaque.
fn colors(source: &mut Source, part: &Part) -> Result<Option<Vec<Color>>, SoupError> {
    let Some(&accessor) = part.primitive.attributes.get(COLOR) else {
        return Ok(None);
    };
    if source.shape(accessor)? == "VEC4" {
        return source.of_vertices::<4>(part, COLOR, "VEC4");
    }
    let colors = source.of_vertices::<3>(part, COLOR, "VEC3")?;
    let opaque = |[r, g, b]: [f64; 3]| [r, g, b, 1.0];
    Ok(colors.map(|colors| colors.into_iter().map(opaque).collect()))
}

/// The values of corners, which are those of vertices.
#[derive(Default)]
struct OfCorners<const N: usize> {
    values: Vec<[f64; N]>,
    /// For each corner the number of its value.
    corners: Vec<u32>,
}

impl<const N: usize> OfCorners<N> {
    /// Adds the corners that a part has added to a soup.
    fn add(&mut self, values: Option<Vec<[f64; N]>>, part: &Part, soup: &PolygonSoup) {
        let start = self.values.len();
        let has_values = values.is_some();
        let of_corner = |&corner: &i64| match usize::try_from(corner) {
            Ok(vertex) if has_values => (start + vertex - part.first) as u32,
            _ => NO_LABEL,
        };
        let corners = &soup.corners()[self.corners.len()..];
        self.corners.extend(corners.iter().map(of_corner));
        self.values.extend(values.into_iter().flatten());
    }

    /// The labels of the corners, none if no corner has a value.
    fn labels(&self) -> Option<Labels> {
        if self.corners.iter().all(|&number| number == NO_LABEL) {
            return None;
        }
        let of_values = labels_of(&self.values);
        let label = |&number: &u32| of_values.get(number as usize).copied().unwrap_or(NO_LABEL);
        Some(self.corners.iter().map(label).collect())
    }
}

/// The names of the materials; those without one are numbered from 0.
fn names(document: &Document) -> Vec<String> {
    let materials = document.materials.iter().enumerate();
    let name = materials.map(|(number, material)| match &material.name {
        Some(name) if !name.trim().is_empty() => name.clone(),
        _ => format!("material {number}"),
    });
    name.collect()
}
