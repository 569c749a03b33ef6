//! What the polygons, corners and vertices of a file have beside positions.

use std::fmt;
use std::path::Path;

use super::{Format, gltf, gzip, look, obj_attributes, ply};
use crate::soup::{PolygonSoup, SoupError};

/// Something in which polygons on both sides of an edge may differ.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Attribute {
    /// The material: `usemtl` of OBJ, that of a primitive of glTF.
    Materials,
    /// The object and the groups: `o` and `g` of OBJ.
    Groups,
    /// The smoothing group: `s` of OBJ; `0` and `off` are the same.
    Smoothing,
    /// Texture coordinates of corners: `vt` of OBJ, `TEXCOORD_0` of glTF.
    Seams,
    /// Normals of corners: `vn` of OBJ, `NORMAL` of glTF.
    Normals,
    /// The colour of the face: `red`, `green`, `blue` and `alpha` of the faces of PLY.
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

/// A colour: red, green, blue and alpha from 0 to 1.
pub(super) type Color = [f64; 4];

/// The attributes of a file's polygons, of their corners and of its vertices, in the order of its
/// [`PolygonSoup`].
///
/// Polygons and corners have labels, which are equal where values are. Texture coordinates, normals and colours
/// are equal if their numbers are, whatever their places in the file.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Attributes {
    /// The polygons' labels, by the place in [`Attribute::ALL`]; none for what the file lacks. Seams and
    /// normals have a label for each corner.
    labels: [Option<Labels>; Attribute::ALL.len()],
    values: Values,
}

/// What the labels stand for, and the values of vertices.
#[derive(Debug, Clone, Default, PartialEq)]
pub(super) struct Values {
    pub(super) libraries: Vec<String>,
    pub(super) materials: Vec<String>,
    pub(super) groups: Vec<String>,
    pub(super) textures: Vec<[f64; 2]>,
    pub(super) face_colors: Vec<Color>,
    pub(super) vertex_colors: Option<Vec<Color>>,
    pub(super) scalars: Vec<(String, Vec<f64>)>,
}

impl Attributes {
    /// The attributes in the contents of a file, whose soup is `soup`.
    ///
    /// OBJ, PLY and glTF files have attributes; those of other formats are not read. Buffers beside a glTF file are not
    /// found: use [`parse_in`](Self::parse_in) or [`read_as`](Self::read_as).
    ///
    /// # Errors
    /// [`SoupError::Parse`] with the line for a corner that names no texture coordinates or no normal, and
    /// for coordinates that are no numbers; [`SoupError::Malformed`] where `soup` is not that of the
    /// file; and those of [`parse`](super::parse).
    pub fn parse(bytes: &[u8], format: Format, soup: &PolygonSoup) -> Result<Self, SoupError> {
        Self::parse_in(bytes, format, None, soup)
    }

    /// As [`parse`](Self::parse), for a file in this folder.
    ///
    /// # Errors
    /// Those of [`parse`](Self::parse), and those of buffers beside the file.
    pub fn parse_in(
        bytes: &[u8],
        format: Format,
        folder: Option<&Path>,
        soup: &PolygonSoup,
    ) -> Result<Self, SoupError> {
        let bytes = &gzip::inflated(bytes)?;
        look::check(bytes, format)?;
        let attributes = match format {
            Format::Obj => obj_attributes::parse(bytes)?,
            Format::Ply => ply::attributes(bytes)?,
            Format::Gltf | Format::Glb => gltf::attributes(bytes, folder)?,
            _ => Attributes::default(),
        };
        attributes.check(soup)?;
        Ok(attributes)
    }

    /// Whether the contents of a file may have attributes other than smoothing groups and normals. This takes
    /// little time.
    ///
    /// # Errors
    /// Those of [`parse`](super::parse) for a compressed file, for the header of a PLY file, and for the JSON of
    /// a glTF file.
    pub fn are_in(bytes: &[u8], format: Format) -> Result<bool, SoupError> {
        match format {
            Format::Obj => Ok(obj_attributes::are_in(&gzip::inflated(bytes)?)),
            Format::Ply => ply::has_attributes(&gzip::inflated(bytes)?),
            Format::Gltf | Format::Glb => gltf::has_attributes(&gzip::inflated(bytes)?),
            _ => Ok(false),
        }
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
        Self::parse_in(&bytes, format, path.parent(), soup)
    }

    /// The attributes that the file has.
    pub fn present(&self) -> impl Iterator<Item = Attribute> + '_ {
        let all = Attribute::ALL.into_iter();
        all.filter(|&attribute| self.labels(attribute).is_some())
    }

    /// Those of no labels.
    pub(super) fn of(values: Values) -> Self {
        Attributes {
            values,
            ..Attributes::default()
        }
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

    /// The names of the materials or of the groups, by label; none of other attributes. The name of a group is
    /// that of its object and its own, with a space between them.
    pub fn names(&self, attribute: Attribute) -> &[String] {
        match attribute {
            Attribute::Materials => &self.values.materials,
            Attribute::Groups => &self.values.groups,
            _ => &[],
        }
    }

    /// The files of materials that the file names: `mtllib` of OBJ.
    pub fn libraries(&self) -> &[String] {
        &self.values.libraries
    }

    /// Texture coordinates, by the labels of [`Attribute::Seams`].
    pub fn texture_coordinates(&self) -> &[[f64; 2]] {
        &self.values.textures
    }

    /// Red, green, blue and alpha from 0 to 1, by the labels of [`Attribute::Colors`].
    pub fn face_colors(&self) -> &[[f64; 4]] {
        &self.values.face_colors
    }

    /// Red, green, blue and alpha of every vertex from 0 to 1, if the file has them: `v x y z r g b` of OBJ,
    /// `red`, `green`, `blue` and `alpha` of PLY, and `COLOR_0` of glTF, as it is stored. NaN for a vertex without a
    /// colour.
    pub fn vertex_colors(&self) -> Option<&[[f64; 4]]> {
        self.values.vertex_colors.as_deref()
    }

    /// The other numbers that every vertex of a PLY file has, by name. Normals are not among them.
    pub fn scalars(&self) -> impl Iterator<Item = (&str, &[f64])> {
        let scalars = self.values.scalars.iter();
        scalars.map(|(name, values)| (name.as_str(), values.as_slice()))
    }

    /// Refuses attributes of other polygons or vertices.
    pub(crate) fn check(&self, soup: &PolygonSoup) -> Result<(), SoupError> {
        let of_faces = self.present().map(|attribute| {
            let (expected, what) = match attribute {
                Attribute::Seams | Attribute::Normals => (soup.corners().len(), "corners"),
                _ => (soup.polygon_count(), "polygons"),
            };
            let found = self.labels(attribute).map_or(0, <[u32]>::len);
            (attribute.name(), found, expected, what)
        });
        let colors = self.vertex_colors().map(|colors| ("colors", colors.len()));
        let scalars = self.scalars().map(|(name, values)| (name, values.len()));
        let vertices = soup.positions().len();
        let of_vertices = colors.into_iter().chain(scalars);
        let of_vertices = of_vertices.map(|(name, found)| (name, found, vertices, "vertices"));
        for (name, found, expected, what) in of_faces.chain(of_vertices) {
            if found != expected {
                return Err(SoupError::Malformed {
                    message: format!("{name}: {found} for {expected} {what}"),
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
