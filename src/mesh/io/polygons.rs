//! Polygons to be written, such as quads.

use crate::mesh::attributes::SurfaceAttributes;
use crate::mesh::vector::Vec3;

/// Polygons of any number of corners, to be written by [`write_polygons`](super::write_polygons).
#[derive(Debug, Clone, Default)]
pub struct Polygons<'a> {
    /// Positions.
    pub vertices: &'a [Vec3],
    /// Corners of each polygon.
    pub faces: Vec<&'a [u32]>,
    /// Materials, colours and other values. OBJ, PLY and USD hold them; other formats leave them out.
    pub attributes: Option<&'a SurfaceAttributes>,
}
