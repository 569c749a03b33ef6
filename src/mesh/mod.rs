//! Triangle meshes: validated connectivity, measures, files, procedural shapes, curvature.
//!
//! A [`TriangleMesh`] is an oriented 2-manifold with or without boundary, of any genus and any
//! number of components, and does not change once made. Anything else is refused with a
//! [`MeshError`] that names the element at fault. Elements are counted from 0. Local edge `k` of a face
//! runs from its corner `k` to its corner `k + 1`; angles are counter-clockwise about the face
//! normal, from local edge 0, the face's first edge in the file.
//!
//! ```
//! use roundel::mesh::shape;
//!
//! let mesh = shape::by_name("genus-2", 20_000)?;
//! assert_eq!(mesh.euler_characteristic(), -2);
//! let (face, edge) = mesh.neighbor(0, 1).expect("the surface is closed");
//! assert_eq!(mesh.neighbor(face, edge), Some((0, 1)));
//! # Ok::<(), roundel::mesh::MeshError>(())
//! ```

pub mod attributes;
mod barycentric;
mod check;
mod closest;
mod connectivity;
pub mod curvature;
mod error;
pub mod features;
mod from_soup;
#[cfg(feature = "mesh-io")]
pub mod io;
mod jitter;
mod measure;
pub mod mirror;
mod orientation;
#[cfg(feature = "mesh-io")]
mod origin;
mod plane;
pub mod refine;
mod reordered;
mod rings;
pub mod shape;
mod subdivide;
mod topology;
mod triangle_mesh;
pub(crate) mod vertex_values;

pub use crate::linalg::vector;
pub use crate::soup::ZERO_AREA_TOLERANCE;
pub use closest::ClosestPoint;
pub use error::MeshError;
pub use jitter::jitter;
pub use subdivide::subdivide;
pub use topology::Components;
pub use triangle_mesh::{Edge, TriangleMesh};

pub(crate) use barycentric::barycentric;
pub(crate) use closest::{closest, closest_on_segment};
pub(crate) use orientation::orientation;
pub(crate) use plane::{angle_at, angle_between, turned};
pub(crate) use reordered::Reordered;
#[cfg(test)]
pub(crate) use reordered::shuffled;

#[cfg(test)]
mod error_tests;
#[cfg(test)]
mod tests;
