//! The materials of the triangles of a scene.

use std::path::Path;

use super::document::Document;
use super::{container, malformed, read};
use crate::soup::SoupError;
use crate::soup::io::attributes::{Attribute, Attributes, NO_LABEL, Values};

/// Whether a document has materials.
pub(in crate::soup::io) fn has_attributes(bytes: &[u8]) -> Result<bool, SoupError> {
    let (document, _) = container::open(bytes)?;
    Ok(!document.materials.is_empty())
}

/// The attributes of a file: the material of every triangle.
pub(in crate::soup::io) fn attributes(
    bytes: &[u8],
    folder: Option<&Path>,
) -> Result<Attributes, SoupError> {
    let (document, own) = container::open(bytes)?;
    let mut labels = Vec::new();
    let mut missing = None;
    read(&document, own, bytes.len(), folder, |primitive, end| {
        missing = missing.or(primitive
            .material
            .filter(|&m| m >= document.materials.len()));
        labels.resize(end, primitive.material.map_or(NO_LABEL, |m| m as u32));
    })?;
    if let Some(missing) = missing {
        return Err(malformed(format!("there is no material {missing}")));
    }
    let is_named = labels.iter().any(|&label| label != NO_LABEL);
    let values = Values {
        materials: names(&document),
        ..Values::default()
    };
    Ok(Attributes::of(values).with(Attribute::Materials, is_named.then_some(labels)))
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
