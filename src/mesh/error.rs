//! Why a mesh is refused: one variant a reason, each naming the element at fault.

use crate::error::InputError;

/// Why a mesh cannot be made, read, written or drawn up by name.
///
/// Faces, vertices and corners are counted from 0, lines of a file from 1.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum MeshError {
    /// A mesh without faces.
    #[error("the mesh has no faces")]
    NoFaces,
    /// More half-edges or vertices than 32-bit numbers can name.
    #[error("the mesh is too large: {vertices} vertices, {faces} faces")]
    TooLarge {
        /// Number of vertices given.
        vertices: usize,
        /// Number of faces given.
        faces: usize,
    },
    /// NaN or infinity as a coordinate.
    #[error("vertex {vertex}: a coordinate is not a finite number")]
    NotFinite {
        /// The vertex.
        vertex: usize,
    },
    /// A face with a corner count other than three. Nothing is triangulated silently.
    #[error("face {face} has {corners} corners, not 3")]
    NotATriangle {
        /// The face.
        face: usize,
        /// Its number of corners.
        corners: usize,
    },
    /// A face that names a vertex that there is not.
    #[error("face {face}: vertex {vertex} is outside 0..{vertices}")]
    IndexOutOfRange {
        /// The face.
        face: usize,
        /// The number given.
        vertex: i64,
        /// Number of vertices.
        vertices: usize,
    },
    /// A face that visits a vertex twice.
    #[error("face {face} visits vertex {vertex} twice")]
    RepeatedVertex {
        /// The face.
        face: usize,
        /// The vertex.
        vertex: usize,
    },
    /// A face without area, and so without a normal.
    #[error("face {face} has no area")]
    ZeroArea {
        /// The face.
        face: usize,
    },
    /// An edge with more than two faces.
    #[error("edge {}-{} has {} faces ({faces:?}), not 1 or 2", vertices[0], vertices[1], faces.len())]
    NonManifoldEdge {
        /// Its end points, the lower first.
        vertices: [usize; 2],
        /// Its faces, in increasing order.
        faces: Vec<usize>,
    },
    /// Two faces that run along their common edge in the same direction.
    #[error(
        "faces {} and {} both run from vertex {} to vertex {}: their orientations differ",
        faces[0], faces[1], vertices[0], vertices[1]
    )]
    InconsistentOrientation {
        /// The edge, in the direction of both.
        vertices: [usize; 2],
        /// The two faces, the lower first.
        faces: [usize; 2],
    },
    /// A vertex that no face uses.
    #[error("vertex {vertex} belongs to no face")]
    IsolatedVertex {
        /// The vertex.
        vertex: usize,
    },
    /// A vertex whose faces form more than one fan.
    #[error("the faces of vertex {vertex} form more than one fan")]
    NonManifoldVertex {
        /// The vertex.
        vertex: usize,
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
        /// What is wrong.
        message: String,
    },
    /// A file that cannot be opened, read or written.
    #[error("{message}")]
    Io {
        /// The system's reason, with the file's name.
        message: String,
    },
    /// A file name whose extension is no known format.
    #[error("'{extension}' is not a mesh format: obj, off and ply are")]
    UnknownFormat {
        /// The extension, empty where there is none.
        extension: String,
    },
    /// A shape that there is not.
    #[error("there is no shape '{name}'")]
    UnknownShape {
        /// The name given.
        name: String,
    },
    /// A number of triangles, an amplitude or another number that cannot be served.
    #[error("{what}")]
    InvalidArgument {
        /// What is wrong, in words.
        what: String,
    },
}

impl MeshError {
    /// The element at fault: the face or vertex of the message. For an edge the lowest of its
    /// faces.
    pub fn index(&self) -> Option<usize> {
        match self {
            MeshError::NotATriangle { face, .. }
            | MeshError::IndexOutOfRange { face, .. }
            | MeshError::RepeatedVertex { face, .. }
            | MeshError::ZeroArea { face } => Some(*face),
            MeshError::NotFinite { vertex }
            | MeshError::IsolatedVertex { vertex }
            | MeshError::NonManifoldVertex { vertex } => Some(*vertex),
            MeshError::NonManifoldEdge { faces, .. } => faces.first().copied(),
            MeshError::InconsistentOrientation { faces, .. } => Some(faces[0]),
            _ => None,
        }
    }

    /// The line of the file at fault, counted from 1.
    pub fn line(&self) -> Option<usize> {
        match self {
            MeshError::Parse { line, .. } => Some(*line),
            _ => None,
        }
    }

    /// A word for the kind of error that does not change between versions.
    pub fn code(&self) -> &'static str {
        match self {
            MeshError::NoFaces => "no_faces",
            MeshError::TooLarge { .. } => "mesh_too_large",
            MeshError::NotFinite { .. } => "vertex_not_finite",
            MeshError::NotATriangle { .. } => "not_a_triangle",
            MeshError::IndexOutOfRange { .. } => "vertex_out_of_range",
            MeshError::RepeatedVertex { .. } => "repeated_vertex",
            MeshError::ZeroArea { .. } => "zero_area",
            MeshError::NonManifoldEdge { .. } => "non_manifold_edge",
            MeshError::InconsistentOrientation { .. } => "inconsistent_orientation",
            MeshError::IsolatedVertex { .. } => "isolated_vertex",
            MeshError::NonManifoldVertex { .. } => "non_manifold_vertex",
            MeshError::Parse { .. } => "parse",
            MeshError::Malformed { .. } => "malformed",
            MeshError::Io { .. } => "io",
            MeshError::UnknownFormat { .. } => "unknown_format",
            MeshError::UnknownShape { .. } => "unknown_shape",
            MeshError::InvalidArgument { .. } => "invalid_argument",
        }
    }
}

impl From<MeshError> for crate::Error {
    fn from(error: MeshError) -> Self {
        match error {
            MeshError::Parse { line, message } => crate::Error::Parse { line, message },
            MeshError::Io { message } => crate::Error::Io { message },
            other => crate::Error::Input(InputError {
                code: other.code(),
                message: other.to_string(),
                index: other.index(),
            }),
        }
    }
}
