//! The materials of the triangles of a scene, texture coordinates and normals of their corners, and colours of its
//! vertices.

use std::collections::{BTreeMap, BTreeSet};
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
    /// The accessors that were read for them, and the first vertices that they were read for.
    colored: BTreeSet<(usize, usize)>,
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
        self.textures.add(source, part, soup, (TEXTURE, "VEC2"))?;
        self.normals.add(source, part, soup, (NORMAL, "VEC3"))?;
        if let Some(accessor) = part.accessor(COLOR)
            && self.colored.insert((accessor, part.first))
        {
            let colors = colors(source, accessor, part.vertices)?;
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
        // In glTF they start at the upper side of the image, in the other formats at the lower one.
        for [_, v] in &mut self.textures.values {
            *v = 1.0 - *v;
        }
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

/// The colours that an accessor gives to so many vertices. Those without alpha are opaque.
fn colors(source: &mut Source, accessor: usize, vertices: usize) -> Result<Vec<Color>, SoupError> {
    if source.shape(accessor)? == "VEC4" {
        return source.of_vertices(accessor, (COLOR, "VEC4"), vertices);
    }
    let colors = source.of_vertices(accessor, (COLOR, "VEC3"), vertices)?;
    Ok(colors.into_iter().map(|[r, g, b]| [r, g, b, 1.0]).collect())
}

/// The values of corners, which are those of vertices.
#[derive(Default)]
struct OfCorners<const N: usize> {
    values: Vec<[f64; N]>,
    /// For each corner the number of its value.
    corners: Vec<u32>,
    /// Where the values of an accessor start, for so many vertices: primitives share accessors.
    starts: BTreeMap<(usize, usize), usize>,
}

impl<const N: usize> OfCorners<N> {
    /// Adds the corners that a part has added to a soup.
    fn add(
        &mut self,
        source: &mut Source,
        part: &Part,
        soup: &PolygonSoup,
        (name, shape): (&str, &str),
    ) -> Result<(), SoupError> {
        let start = match part.accessor(name) {
            Some(accessor) => Some(self.start(source, accessor, (name, shape), part.vertices)?),
            None => None,
        };
        let of_corner = |&corner: &i64| match (start, usize::try_from(corner)) {
            (Some(start), Ok(vertex)) => (start + vertex - part.first) as u32,
            _ => NO_LABEL,
        };
        let corners = &soup.corners()[self.corners.len()..];
        self.corners.extend(corners.iter().map(of_corner));
        Ok(())
    }

    /// Where the values of an accessor start. They are read if they were not yet.
    fn start(
        &mut self,
        source: &mut Source,
        accessor: usize,
        what: (&str, &str),
        vertices: usize,
    ) -> Result<usize, SoupError> {
        if let Some(&start) = self.starts.get(&(accessor, vertices)) {
            return Ok(start);
        }
        let start = self.values.len();
        let values = source.of_vertices(accessor, what, vertices)?;
        self.values.extend(values);
        self.starts.insert((accessor, vertices), start);
        Ok(start)
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
