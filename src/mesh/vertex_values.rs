//! Values that a caller gives for all vertices.

use super::TriangleMesh;
use crate::error::{Error, Result, check_length};

/// Whether there is a finite number above 0 for every vertex.
///
/// # Errors
/// [`Error::LengthMismatch`]; with the vertex, [`Error::NotFinite`] and [`Error::InvalidArgument`].
pub(crate) fn check_positive(
    mesh: &TriangleMesh,
    what: &'static str,
    values: &[f64],
) -> Result<()> {
    check_length(what, values.len(), mesh.vertex_count())?;
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
