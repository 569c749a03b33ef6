//! Polygon soups: positions and polygons of any size, of which nothing is assumed.
//!
//! A soup is what a file holds. [`TriangleMesh`](crate::mesh::TriangleMesh) is strict; what lies between
//! the two is repair, which says exactly what it did.

mod area;
mod error;
#[cfg(feature = "mesh-io")]
pub mod io;
mod polygon_soup;

pub use area::ZERO_AREA_TOLERANCE;
pub use error::SoupError;
pub use polygon_soup::PolygonSoup;

pub(crate) use area::has_no_area;
