//! The kinds of attributes, by which some of them are chosen.

use std::fmt;

use super::SurfaceAttributes;

/// A kind of [`SurfaceAttributes`].
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum AttributeKind {
    /// The materials of faces, and the files that describe them.
    Materials,
    /// The groups of faces.
    Groups,
    /// The colours of faces and of vertices.
    Colors,
    /// Texture coordinates of corners.
    Uv,
    /// Numbers of vertices.
    Scalars,
}

impl AttributeKind {
    /// All of them.
    pub const ALL: [AttributeKind; 5] = [
        AttributeKind::Materials,
        AttributeKind::Groups,
        AttributeKind::Colors,
        AttributeKind::Uv,
        AttributeKind::Scalars,
    ];

    /// Its name in the program and in messages.
    pub fn name(self) -> &'static str {
        match self {
            AttributeKind::Materials => "materials",
            AttributeKind::Groups => "groups",
            AttributeKind::Colors => "colors",
            AttributeKind::Uv => "uv",
            AttributeKind::Scalars => "scalars",
        }
    }

    /// The kind of this name.
    pub fn by_name(name: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|kind| kind.name() == name)
    }
}

impl fmt::Display for AttributeKind {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name())
    }
}

impl SurfaceAttributes {
    /// Whether there are attributes of this kind.
    pub fn has(&self, kind: AttributeKind) -> bool {
        match kind {
            AttributeKind::Materials => self.materials.is_some(),
            AttributeKind::Groups => self.groups.is_some(),
            AttributeKind::Colors => self.face_colors.is_some() || self.vertex_colors.is_some(),
            AttributeKind::Uv => self.uv.is_some(),
            AttributeKind::Scalars => !self.scalars.is_empty(),
        }
    }

    /// The kinds that there are.
    pub fn kinds(&self) -> impl Iterator<Item = AttributeKind> + '_ {
        let all = AttributeKind::ALL.into_iter();
        all.filter(|&kind| self.has(kind))
    }

    /// Leaves out what is not of these kinds.
    pub fn keep(&mut self, kinds: &[AttributeKind]) {
        for kind in AttributeKind::ALL {
            if !kinds.contains(&kind) {
                self.drop_kind(kind);
            }
        }
    }

    fn drop_kind(&mut self, kind: AttributeKind) {
        match kind {
            AttributeKind::Materials => {
                self.materials = None;
                self.libraries.clear();
            }
            AttributeKind::Groups => self.groups = None,
            AttributeKind::Colors => (self.face_colors, self.vertex_colors) = (None, None),
            AttributeKind::Uv => self.uv = None,
            AttributeKind::Scalars => self.scalars.clear(),
        }
    }

    /// Leaves out what files of this format have no place for: all but materials, groups, colours of vertices and
    /// texture coordinates in OBJ, the files of materials in PLY and USD, and everything in other formats.
    #[cfg(feature = "mesh-io")]
    pub fn keep_what_fits(&mut self, format: crate::soup::io::Format) {
        use crate::soup::io::Format;
        match format {
            Format::Ply | Format::Usda => self.libraries.clear(),
            Format::Obj => {
                self.face_colors = None;
                self.scalars.clear();
            }
            _ => self.keep(&[]),
        }
    }
}
