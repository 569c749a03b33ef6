//! Pictures of orientation fields: a shaded view for paper and page, a model for mesh viewers.
//!
//! A small software renderer, since a field is looked at far more often than it is computed and a
//! graphics library would be the largest dependency of all. [`draw_field`] gives an [`Image`]:
//! streamlines of the field, evenly spaced, on a softly lit surface, and irregular vertices as
//! balls. [`draw_bands`] draws a number at every vertex, in bands. [`draw_quads`] draws quads. [`FieldModel`] is what MeshLab and Blender open: the mesh, a cross in every face and
//! the same balls. Everything is the same on every run.
//!
//! Irregular vertices of index 1/4 are red, as at the corner of a cube, those of index -1/4 blue,
//! all others amber.

#![deny(unsafe_code)]
#![deny(missing_docs)]

mod ambient;
mod balls;
mod bands;
mod camera;
mod draw;
mod model;
mod normals;
mod png;
mod quads;
mod raster;
mod ribbons;
mod scene;
mod shading;
mod streamlines;

pub use bands::draw_bands;
pub use draw::{View, draw_field};
pub use model::FieldModel;
pub use png::Image;
pub use quads::draw_quads;

#[cfg(test)]
mod tests;
