//! Binary STL: a header of 80 bytes, the number of triangles, and 50 bytes for each.

use super::super::bytes::Bytes;
use crate::soup::{PolygonSoup, SoupError};

/// Bytes before the triangles.
pub(super) const HEADER: usize = 84;

/// Bytes of a triangle: a normal, three corners, and an attribute of two bytes.
const TRIANGLE: usize = 50;

/// How long the file is by its own word. `None` without a whole header.
pub(super) fn declared_length(bytes: &[u8]) -> Option<u64> {
    let count = bytes.get(HEADER - 4..)?.first_chunk()?;
    Some(HEADER as u64 + TRIANGLE as u64 * u64::from(u32::from_le_bytes(*count)))
}

pub(super) fn parse(bytes: &[u8]) -> Result<PolygonSoup, SoupError> {
    let mut data = Bytes::new(bytes, 0);
    data.take(HEADER - 4, "its header")?;
    let declared = u32::from_le_bytes(data.array("its header")?);
    let count = data.plausible(declared.into(), TRIANGLE, "triangles")?;
    // Less than a triangle may follow: some programs fill up their last block.
    let room = data.left() / TRIANGLE;
    if count < room {
        return Err(SoupError::Malformed {
            message: format!(
                "byte {}: the file declares {count} triangles, and has {room}",
                HEADER - 4
            ),
        });
    }
    let mut soup = PolygonSoup::default();
    for _ in 0..count {
        let triangle: [u8; TRIANGLE] = data.array("a triangle")?;
        let numbers = triangle[12..48].as_chunks().0;
        let mut numbers = numbers
            .iter()
            .map(|&number| f64::from(f32::from_le_bytes(number)));
        let corners = [(); 3].map(|()| {
            let mut number = || numbers.next().unwrap_or_default();
            let position = [number(), number(), number()];
            soup.add_vertex(position) as i64
        });
        soup.add_polygon(corners);
    }
    Ok(soup)
}
