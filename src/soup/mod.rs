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
