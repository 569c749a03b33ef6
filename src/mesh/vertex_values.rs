//! Values that a caller gives for all vertices.

use super::TriangleMesh;
use crate::error::{Error, Result};

/// Whether there is a finite number above 0 for every vertex.
///
/// # Errors
/// [`Error::LengthMismatch`]; with the vertex, [`Error::NotFinite`] and [`Error::InvalidArgument`].
pub(crate) fn check_positive(
    mesh: &TriangleMesh,
    what: &'static str,
    values: &[f64],
) -> Result<()> {
    if values.len() != mesh.vertex_count() {
        return Err(Error::LengthMismatch {
            what,
            expected: mesh.vertex_count(),
            actual: values.len(),
        });
    }
    for (position, &value) in values.iter().enumerate() {
        if !value.is_finite() {
            return Err(Error::NotFinite { what, position });
        }
        if value <= 0.0 {
            return Err(Error::InvalidArgument {
                what: format!("{what}: {value}, of vertex {position}, is not above 0"),
                index: Some(position),
            });
        }
    }
    Ok(())
}
