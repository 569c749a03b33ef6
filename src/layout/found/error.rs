//! Why quads have no layout: one variant for each reason, which names the element at fault.

use crate::error::{Error, InputError};
use crate::mesh::MeshError;

/// Why no layout is found of quads.
///
/// Faces, vertices and corners are counted from 0.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum FoundError {
    /// The quads are no oriented manifold with or without boundary.
    #[error(transparent)]
    Mesh(#[from] MeshError),
    /// A face with a corner count other than four.
    #[error("face {face} has {corners} corners, not 4")]
    NotAQuad {
        /// The face.
        face: usize,
        /// Its number of corners.
        corners: usize,
    },
}

impl From<FoundError> for Error {
    fn from(error: FoundError) -> Self {
        match error {
            FoundError::Mesh(error) => error.into(),
            FoundError::NotAQuad { face, .. } => Error::Input(InputError {
                code: "not_a_quad",
                message: error.to_string(),
                index: Some(face),
            }),
        }
    }
}
