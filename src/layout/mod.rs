//! Layouts: coarse meshes of patches, and the quads that belong to them.

pub mod found;
