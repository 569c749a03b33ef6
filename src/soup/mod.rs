//! Polygon soups: positions and polygons of any size, of which nothing is assumed.
//!
//! A soup is what a file holds. [`TriangleMesh`](crate::mesh::TriangleMesh) is strict; what lies between
//! the two is [`repair()`], which says exactly what it did.

mod area;
mod clean;
mod components;
mod cut;
mod duplicates;
mod ears;
mod edges;
mod edits;
mod error;
mod fill;
mod finite;
#[cfg(feature = "mesh-io")]
pub mod io;
mod lists;
mod near;
mod options;
mod orient;
mod pair;
mod polygon_soup;
mod repair;
mod repaired;
mod slivers;
mod surface;
mod triangulate;
mod weld;

pub use area::ZERO_AREA_TOLERANCE;
pub use edits::{Edit, EditKind, Edits};
pub use error::SoupError;
pub use options::{REPAIR_OPTIONS, RepairOptions};
pub use polygon_soup::PolygonSoup;
pub use repair::repair;
pub use repaired::Repaired;

pub(crate) use area::has_no_area;

#[cfg(test)]
mod tests;
