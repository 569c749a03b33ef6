//! Binary OFF (Geomview manual, section 4.2.5): 32-bit integers and floats, the most significant byte
//! first, after the line that ends in `BINARY`.
//!
//! A face is its number of corners, their vertices, and the numbers of its colour with their count.

use super::bytes::Bytes;
use super::off::Keyword;
use crate::soup::{PolygonSoup, SoupError};

pub(super) fn parse(bytes: &[u8], mut keyword: Keyword) -> Result<PolygonSoup, SoupError> {
    let word = bytes.windows(6).position(|window| window == b"BINARY");
    let after = word.map_or(0, |at| at + 6);
    let line = bytes[after..].iter().position(|&b| b == b'\n');
    let mut bytes = Bytes::new(bytes, line.map_or(bytes.len(), |end| after + end + 1));
    if keyword.names_dimension() {
        keyword.set_dimension(integer(&mut bytes, "the number of coordinates")?)?;
    }
    let vertices = integer(&mut bytes, "the number of vertices")?;
    let faces = integer(&mut bytes, "the number of faces")?;
    integer(&mut bytes, "the number of edges")?;
    let size = 4 * (keyword.position_numbers() + keyword.other_numbers());
    let mut soup = PolygonSoup::default();
    for _ in 0..bytes.plausible(vertices, size, "vertices")? {
        let mut numbers = [0.0; 4];
        let at = bytes.at();
        for number in &mut numbers[..keyword.position_numbers()] {
            *number = f32::from_be_bytes(bytes.array("a vertex")?).into();
        }
        bytes.take(4 * keyword.other_numbers(), "a vertex")?;
        let position = keyword.position(&numbers);
        soup.add_vertex(position.ok_or_else(|| SoupError::Malformed {
            message: format!("byte {at}: the weight of a vertex is zero"),
        })?);
    }
    for _ in 0..bytes.plausible(faces, 8, "faces")? {
        let count = integer(&mut bytes, "a face")?;
        let count = bytes.plausible(count, 4, "corners of a face")?;
        let corners = bytes.take(4 * count, "a face")?.as_chunks().0;
        soup.add_polygon(
            corners
                .iter()
                .map(|&corner| i32::from_be_bytes(corner).into()),
        );
        let colors = integer(&mut bytes, "the colour of a face")?;
        let colors = bytes.plausible(colors, 4, "numbers of a colour")?;
        bytes.take(4 * colors, "the colour of a face")?;
    }
    Ok(soup)
}

fn integer(bytes: &mut Bytes, what: &str) -> Result<i64, SoupError> {
    Ok(i32::from_be_bytes(bytes.array(what)?).into())
}
