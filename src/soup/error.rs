//! Why a file holds no soup that can be read, or a soup no surface.

#[cfg(feature = "mesh-io")]
use std::{io, path::Path};

/// Why a soup cannot be read or repaired.
///
/// Lines of a file are counted from 1, bytes, vertices and polygons from 0.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum SoupError {
    /// Nothing to make a surface of: no polygon, or none with area.
    #[error("there is no surface: {reason}")]
    NoSurface {
        /// What there is instead.
        reason: String,
    },
    /// More vertices or corners than 32-bit numbers can name.
    #[error("the soup is too large: {vertices} vertices, {polygons} polygons")]
    TooLarge {
        /// Number of vertices given.
        vertices: usize,
        /// Number of polygons given.
        polygons: usize,
    },
    /// A file that does not follow its format.
    #[error("line {line}: {message}")]
    Parse {
        /// The line, counted from 1.
        line: usize,
        /// What is wrong with it.
        message: String,
    },
    /// A binary file, or a part without lines, that does not follow its format.
    #[error("{message}")]
    Malformed {
        /// What is wrong, and at which byte.
        message: String,
    },
    /// A file that cannot be opened or read.
    #[error("{message}")]
    Io {
        /// The system's reason, with the file's name.
        message: String,
    },
    /// A file name whose extension is no known format.
    #[error("'{extension}' is not a mesh format; the formats are {known}")]
    UnknownFormat {
        /// The extension, empty where there is none.
        extension: String,
        /// The extensions of the known formats, as a list for people.
        known: &'static str,
    },
}

#[cfg(feature = "mesh-io")]
impl SoupError {
    /// A file that the system refuses to open or read.
    pub(crate) fn of_file(path: &Path, reason: &io::Error) -> Self {
        SoupError::Io {
            message: format!("{}: {reason}", path.display()),
        }
    }
}
