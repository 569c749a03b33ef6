//! `--density`: a file with a number for every vertex, or what the vertices of the mesh have.

use std::path::{Path, PathBuf};

use roundel::Error;
use roundel::mesh::attributes::SurfaceAttributes;
use roundel::quad::density_of_color;

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

    /// The densities of vertices with these attributes. Those without a colour are neutral. Colours are parts of 255
    /// where a number is above 1.
    ///
    /// # Errors
    /// [`Error::InvalidArgument`] for colours or a property that the vertices lack, and those of [`read`].
    pub(super) fn of(&self, attributes: &SurfaceAttributes) -> roundel::Result<Vec<f64>> {
        let refused = |what: String| Err(Error::InvalidArgument { what, index: None });
        match self {
            Density::File(path) => read(path),
            Density::Property(name) => {
                let mut scalars = attributes.scalars.iter();
                if let Some(found) = scalars.find(|scalar| scalar.name == *name) {
                    return Ok(found.values.clone());
                }
                let names = attributes.scalars.iter().map(|scalar| &*scalar.name);
                let names: Vec<_> = names.collect();
                let known = match names.is_empty() {
                    true => "none".to_owned(),
                    false => names.join(", "),
                };
                refused(format!(
                    "--density property:{name}: the vertices have no such property; those of the file are: {known}"
                ))
            }
            Density::Colors => {
                let Some(colors) = &attributes.vertex_colors else {
                    return refused(
                        "--density colors: the vertices of the mesh have no colours; those of .obj, .ply, \
                         .gltf and .glb files are read"
                            .into(),
                    );
                };
                let is_above = |[r, g, b, _]: &[f64; 4]| *r > 1.0 || *g > 1.0 || *b > 1.0;
                let full = match colors.iter().any(is_above) {
                    true => 255.0,
                    false => 1.0,
                };
                let density = |&[r, g, b, _]: &[f64; 4]| match r.is_nan() {
                    true => 1.0,
                    false => density_of_color([r, g, b].map(|x| x / full)),
                };
                Ok(colors.iter().map(density).collect())
            }
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
