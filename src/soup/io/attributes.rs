//! What the polygons of a file have beside their corners, as far as it tells parts of a surface apart.

use std::fmt;
use std::path::Path;

use super::{Format, gzip, look, obj_attributes, ply};
use crate::soup::{PolygonSoup, SoupError};

/// Something in which polygons on both sides of an edge may differ.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Attribute {
    /// The material: `usemtl` of OBJ.
    Materials,
    /// The object and the groups: `o` and `g` of OBJ.
    Groups,
    /// The smoothing group: `s` of OBJ; `0` and `off` are the same.
    Smoothing,
    /// Texture coordinates of corners: `vt` of OBJ.
    Seams,
    /// Normals of corners: `vn` of OBJ.
    Normals,
    /// The colour of the face: `red`, `green` and `blue` of the faces of PLY.
    Colors,
}

impl Attribute {
    /// All of them.
    pub const ALL: [Attribute; 6] = [
        Attribute::Materials,
        Attribute::Groups,
        Attribute::Smoothing,
        Attribute::Seams,
        Attribute::Normals,
        Attribute::Colors,
    ];

    /// Its name in the program and in messages.
    pub fn name(self) -> &'static str {
        match self {
            Attribute::Materials => "materials",
            Attribute::Groups => "groups",
            Attribute::Smoothing => "smoothing",
            Attribute::Seams => "seams",
            Attribute::Normals => "normals",
            Attribute::Colors => "colors",
        }
    }

    /// The attribute of this name.
    pub fn by_name(name: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|a| a.name() == name)
    }
}

impl fmt::Display for Attribute {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name())
    }
}

/// Equal numbers stand for equal values; polygons and corners without one have [`NO_LABEL`].
pub(super) type Labels = Vec<u32>;

/// Of what has no value.
pub(super) const NO_LABEL: u32 = u32::MAX;

/// The attributes of a file's polygons and of their corners, in the order of its [`PolygonSoup`].
///
/// Only whether two values are equal is kept. Texture coordinates, normals and colours are equal if their
/// numbers are, whatever their places in the file.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Attributes {
    /// The polygons' labels, by the place in [`Attribute::ALL`]; none for what the file lacks. Seams and
    /// normals have a label for each corner.
    labels: [Option<Labels>; Attribute::ALL.len()],
}

impl Attributes {
    /// The attributes in the contents of a file, whose soup is `soup`.
    ///
    /// OBJ and PLY files have attributes; those of other formats are not read.
    ///
    /// # Errors
    /// [`SoupError::Parse`] with the line for a corner that names no texture coordinates or no normal, and
    /// for coordinates that are no numbers; [`SoupError::Malformed`] where `soup` is not that of the
    /// file; and those of [`parse`](super::parse).
    pub fn parse(bytes: &[u8], format: Format, soup: &PolygonSoup) -> Result<Self, SoupError> {
        let bytes = &gzip::inflated(bytes)?;
        look::check(bytes, format)?;
        let attributes = match format {
            Format::Obj => obj_attributes::parse(bytes)?,
            Format::Ply => Attributes::default().with(
                Attribute::Colors,
                ply::face_colors(bytes)?.map(|colors| labels_of(&colors)),
            ),
            _ => Attributes::default(),
        };
        attributes.check(soup)?;
        Ok(attributes)
    }

    /// The attributes in a file of this format, whose soup is `soup`.
    ///
    /// # Errors
    /// [`SoupError::Io`], and those of [`parse`](Self::parse).
    pub fn read_as(
        path: impl AsRef<Path>,
        format: Format,
        soup: &PolygonSoup,
    ) -> Result<Self, SoupError> {
        let path = path.as_ref();
        let bytes = std::fs::read(path).map_err(|reason| SoupError::of_file(path, &reason))?;
        Self::parse(&bytes, format, soup)
    }

    /// The attributes that the file has.
    pub fn present(&self) -> impl Iterator<Item = Attribute> + '_ {
        let all = Attribute::ALL.into_iter();
        all.filter(|&attribute| self.labels(attribute).is_some())
    }

    pub(super) fn with(mut self, attribute: Attribute, labels: Option<Labels>) -> Self {
        self.labels[attribute as usize] = labels;
        self
    }

    /// A number for each polygon, for seams and normals for each corner of all polygons: equal for equal
    /// values, `u32::MAX` where there is none.
    pub fn labels(&self, attribute: Attribute) -> Option<&[u32]> {
        self.labels[attribute as usize].as_deref()
    }

    /// Refuses labels of other polygons.
    pub(crate) fn check(&self, soup: &PolygonSoup) -> Result<(), SoupError> {
        for attribute in self.present() {
            let (expected, what) = match attribute {
                Attribute::Seams | Attribute::Normals => (soup.corners().len(), "corners"),
                _ => (soup.polygon_count(), "polygons"),
            };
            let found = self.labels(attribute).map_or(0, <[u32]>::len);
            if found != expected {
                return Err(SoupError::Malformed {
                    message: format!("{attribute}: {found} for {expected} {what}"),
                });
            }
        }
        Ok(())
    }
}

/// A label for each value: the position of the first one that is equal.
pub(super) fn labels_of<const N: usize>(values: &[[f64; N]]) -> Labels {
    let mut first = std::collections::HashMap::new();
    let labels = values.iter().zip(0..);
    labels
        // The two zeros are equal.
        .map(|(value, at)| {
            *first
                .entry(value.map(|x| (x + 0.0).to_bits()))
                .or_insert(at)
        })
        .collect()
}
