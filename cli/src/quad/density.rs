//! `--density`: a file with a number for every vertex, or what the vertices of the mesh have.

use std::path::{Path, PathBuf};

use roundel::Error;
use roundel::mesh::MeshError;
use roundel::quad::density_of_color;
use roundel::soup::io::{Format, vertex_colors, vertex_property};

/// Where densities are.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Density {
    File(PathBuf),
    /// A scalar property of the vertices of the mesh.
    Property(String),
    /// Their colours.
    Colors,
}

impl Density {
    /// Reads an argument. A file of the name `colors` is `./colors`.
    pub(super) fn parse(text: &str) -> Result<Self, String> {
        match (text, text.strip_prefix("property:")) {
            ("colors", _) => Ok(Density::Colors),
            (_, Some("")) => Err("property: needs the name of a property".into()),
            (_, Some(name)) => Ok(Density::Property(name.into())),
            _ => Ok(Density::File(text.into())),
        }
    }

    /// The file beside the mesh that is read.
    pub(super) fn file(&self) -> Option<&Path> {
        match self {
            Density::File(path) => Some(path),
            Density::Property(_) | Density::Colors => None,
        }
    }

    /// The densities that the contents of the mesh's file say.
    ///
    /// # Errors
    /// [`Error::InvalidArgument`] where vertices have no colours, and those of reading.
    pub(super) fn of_mesh(&self, bytes: &[u8], format: Format) -> roundel::Result<Vec<f64>> {
        match self {
            Density::Property(name) => {
                Ok(vertex_property(bytes, format, name).map_err(MeshError::from)?)
            }
            Density::Colors => match vertex_colors(bytes, format).map_err(MeshError::from)? {
                Some(colors) => Ok(colors.into_iter().map(density_of_color).collect()),
                None => Err(Error::InvalidArgument {
                    what: "--density colors: the vertices of the mesh have no colours; those of .obj and .ply files are read".into(),
                    index: None,
                }),
            },
            Density::File(path) => read(path),
        }
    }
}

/// The numbers of a file, one a line; `#` begins a comment.
pub(super) fn read(path: &Path) -> roundel::Result<Vec<f64>> {
    let text = std::fs::read_to_string(path).map_err(|reason| Error::Io {
        message: format!("{}: {reason}", path.display()),
    })?;
    let mut numbers = Vec::new();
    for (line, content) in (1..).zip(text.lines()) {
        let content = content.split('#').next().unwrap_or_default().trim();
        if content.is_empty() {
            continue;
        }
        let number = content.parse().map_err(|_| Error::Parse {
            line,
            message: format!("expected the density of a vertex ({})", path.display()),
        })?;
        numbers.push(number);
    }
    Ok(numbers)
}

#[cfg(test)]
mod tests {
    use super::Density;

    #[test]
    fn a_density_is_a_file_a_property_or_colors() {
        let parse = Density::parse;
        assert_eq!(parse("colors"), Ok(Density::Colors));
        assert_eq!(parse("property:size"), Ok(Density::Property("size".into())));
        assert_eq!(parse("./colors"), Ok(Density::File("./colors".into())));
        assert!(parse("property:").is_err());
    }
}
