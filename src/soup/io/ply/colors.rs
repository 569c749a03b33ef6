//! The colours of faces: the properties `red`, `green` and `blue` of the element `face`.

use super::super::bytes::plausible;
use super::{Header, data_of};
use crate::soup::SoupError;

/// The colour of every face; none if the faces of the file have no colours.
pub(in super::super) fn face_colors(bytes: &[u8]) -> Result<Option<Vec<[f64; 3]>>, SoupError> {
    let header = Header::parse(bytes)?;
    let (mut data, start) = data_of(bytes, &header);
    for element in &header.elements {
        let is_face = element.name == b"face";
        let channels = [&b"red"[..], b"green", b"blue"].map(|name| {
            let place = element.place(name).filter(|_| is_face)?;
            element.properties[place].length.is_none().then_some(place)
        });
        if is_face && channels.contains(&None) {
            return Ok(None);
        }
        if element.properties.is_empty() {
            continue;
        }
        let size = element.size(header.encoding);
        let count = plausible(element.count, size, bytes.len() - start, start, "elements")?;
        let mut colors = Vec::new();
        for _ in 0..count {
            data.start_element("an element")?;
            let mut color = [0.0; 3];
            for (place, property) in element.properties.iter().enumerate() {
                match channels.iter().position(|&channel| channel == Some(place)) {
                    Some(channel) => color[channel] = data.float(property.scalar)?,
                    None => data.skip(property)?,
                }
            }
            if is_face {
                colors.push(color);
            }
        }
        if is_face {
            return Ok(Some(colors));
        }
    }
    Ok(None)
}
