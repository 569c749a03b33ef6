//! Exact geodesic distance on triangle meshes: from vertices, points, polylines and edges.
//!
//! [`geodesic_distance`] computes, for every vertex, the length of the shortest path on the polyhedral surface to
//! the nearest [`Source`]. [`GeodesicDistance`] answers further questions: the path, the nearest source and, with
//! the option [`everywhere`](GeodesicOptions::everywhere), distances and gradients at any
//! [point of the surface](SurfacePoint).
//!
//! ```
//! use roundel::Monitor;
//! use roundel::geodesic::{GeodesicOptions, Source, geodesic_distance};
//! use roundel::mesh::shape;
//!
//! let mesh = shape::by_name("plane", 200)?;
//! let sources = Source::boundary(&mesh);
//! let options = GeodesicOptions::default();
//! let distance = geodesic_distance(&mesh, &sources, &options, &Monitor::default())?;
//! // The middle of a square of side 2.
//! assert!((distance.farthest().1 - 1.0).abs() < 1e-15);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

mod bisector;
mod cross;
mod cut;
mod distance;
mod draw;
mod envelope;
mod frame;
mod leave;
mod nearest;
mod path;
mod pieces;
mod place;
mod queue;
mod roots;
mod seed;
mod source;
mod wavefront;
mod window;

pub use cut::cut_along;
pub use distance::{GeodesicDistance, GeodesicOptions, geodesic_distance};
pub use draw::{FAR_FROM_SURFACE, draw_curve, draw_polyline};
pub(crate) use pieces::pieces;
pub use source::{BARYCENTRIC_TOLERANCE, Source, SurfacePoint};

#[cfg(test)]
mod tests;
