//! The file formats, and how names of files tell them.

use std::path::Path;

use crate::soup::SoupError;

/// A file format.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Format {
    /// Wavefront, `.obj`.
    Obj,
    /// Object file format of Geomview, `.off`, with its variants, as text and binary.
    Off,
    /// Polygon file format, `.ply`: ascii, and binary of both byte orders.
    Ply,
    /// Stereolithography, `.stl`: binary and text.
    Stl,
    /// glTF 2.0, `.gltf`: JSON, with buffers in files next to it or in the text.
    Gltf,
    /// glTF 2.0, `.glb`: JSON and its buffer in one binary file.
    Glb,
    /// Universal scene description as text, `.usda`. It is written only.
    Usda,
}

impl Format {
    /// All formats.
    pub const ALL: [Format; 7] = [
        Format::Obj,
        Format::Off,
        Format::Ply,
        Format::Stl,
        Format::Gltf,
        Format::Glb,
        Format::Usda,
    ];

    /// The formats that are read, as a list for people.
    pub const READ: &'static str = "obj, off, ply, stl, gltf and glb";

    /// The formats that are written, as a list for people.
    pub const WRITTEN: &'static str = "obj, off, ply, stl, gltf, glb and usda";

    /// The format that the extension of a file name stands for, in any case. A further extension
    /// `.gz` says that the file is compressed, and is passed over.
    ///
    /// # Errors
    ///
    /// [`SoupError::UnknownFormat`].
    pub fn of(path: &Path) -> Result<Format, SoupError> {
        let stem;
        let path = if is_compressed(path) {
            stem = path.with_extension("");
            &stem
        } else {
            path
        };
        Format::by_name(&path.extension().unwrap_or_default().to_string_lossy())
    }

    /// The format of this name, which is its extension without the dot, in any case.
    ///
    /// # Errors
    ///
    /// [`SoupError::UnknownFormat`].
    pub fn by_name(word: &str) -> Result<Format, SoupError> {
        let named = |format: &Format| format.name().eq_ignore_ascii_case(word);
        let unknown = || SoupError::UnknownFormat {
            extension: word.to_owned(),
            known: Format::READ,
        };
        Format::ALL.into_iter().find(named).ok_or_else(unknown)
    }

    /// The extension of its files, without the dot.
    pub fn name(self) -> &'static str {
        match self {
            Format::Obj => "obj",
            Format::Off => "off",
            Format::Ply => "ply",
            Format::Stl => "stl",
            Format::Gltf => "gltf",
            Format::Glb => "glb",
            Format::Usda => "usda",
        }
    }

    /// Whether its polygons may have more than three corners.
    pub fn holds_polygons(self) -> bool {
        !matches!(self, Format::Stl | Format::Gltf | Format::Glb)
    }
}

/// Whether the name of a file ends in `.gz`.
pub(crate) fn is_compressed(path: &Path) -> bool {
    path.extension()
        .is_some_and(|extension| extension.eq_ignore_ascii_case("gz"))
}
