//! Polygon file format (Turk, 1994): ascii, and binary of both byte orders.
//!
//! Read are `x y z` of the element `vertex`, the list `vertex_indices` or `vertex_index` of the element
//! `face`, and the lists of that name of the element `tristrips`, in any order; everything else is passed
//! over. `ply-rs-bw` was looked at: it refuses numbers such as `1.`, `.5` and `nan` in text, comments that
//! are not UTF-8, and lines that end in CR; it forgets one of two properties of the same name, and so
//! misreads what follows; and its errors in binary files name no byte.

mod attributes;
mod data;
mod header;

use super::bytes::{Bytes, plausible};
use super::lines::Words;
use super::strips;
use crate::soup::{PolygonSoup, SoupError};
pub(super) use attributes::{attributes, has_attributes};
use data::Data;
use header::{Element, Encoding, Header};

const CORNERS: [&[u8]; 2] = [b"vertex_indices", b"vertex_index"];

pub(super) fn parse(bytes: &[u8]) -> Result<PolygonSoup, SoupError> {
    let header = Header::parse(bytes)?;
    let (mut data, start) = data_of(bytes, &header);
    let mut soup = PolygonSoup::default();
    for element in &header.elements {
        if element.properties.is_empty() {
            continue;
        }
        let name = String::from_utf8_lossy(&element.name);
        let what = format!("elements '{name}'");
        let size = element.size(header.encoding);
        let count = plausible(element.count, size, bytes.len() - start, start, &what)?;
        match &*element.name {
            b"vertex" => vertices(element, count, &mut data, &mut soup)?,
            b"face" => faces(element, count, &mut data, |corners| {
                soup.add_polygon(corners.iter().copied());
            })?,
            b"tristrips" => faces(element, count, &mut data, |corners| {
                for strip in corners.split(|&corner| corner == -1) {
                    strips::strip(strip, |triangle| {
                        soup.add_polygon(triangle);
                    });
                }
            })?,
            _ => {
                for _ in 0..count {
                    data.start_element("an element")?;
                    for property in &element.properties {
                        data.skip(property)?;
                    }
                }
            }
        }
    }
    Ok(soup)
}

/// The numbers after the header, and the byte at which they start.
fn data_of<'a>(bytes: &'a [u8], header: &Header<'a>) -> (Data<'a>, usize) {
    let start = bytes.len() - header.data.rest().len();
    let data = match header.encoding {
        Encoding::Ascii => Data::Text(Words::of(header.data.clone())),
        encoding => Data::Binary {
            bytes: Bytes::new(bytes, start),
            big: encoding == Encoding::BigEndian,
        },
    };
    (data, start)
}

fn vertices(
    element: &Element,
    count: usize,
    data: &mut Data,
    soup: &mut PolygonSoup,
) -> Result<(), SoupError> {
    let scalar = |axis: &&[u8]| {
        let place = element.place(axis)?;
        element.properties[place].length.is_none().then_some(place)
    };
    let axes = [&b"x"[..], b"y", b"z"].map(|axis| scalar(&axis));
    if axes.contains(&None) {
        return Err(SoupError::Malformed {
            message: "the vertices have no x, y and z".to_owned(),
        });
    }
    for _ in 0..count {
        data.start_element("a vertex")?;
        let mut position = [0.0; 3];
        for (place, property) in element.properties.iter().enumerate() {
            match axes.iter().position(|&axis| axis == Some(place)) {
                Some(axis) => position[axis] = data.float(property.scalar)?,
                None => data.skip(property)?,
            }
        }
        soup.add_vertex(position);
    }
    Ok(())
}

/// The lists of corners of faces or strips.
fn faces(
    element: &Element,
    count: usize,
    data: &mut Data,
    mut add: impl FnMut(&[i64]),
) -> Result<(), SoupError> {
    let place = CORNERS.iter().find_map(|name| element.place(name));
    let length = place.and_then(|place| element.properties[place].length);
    let (Some(place), Some(length)) = (place, length) else {
        return Err(SoupError::Malformed {
            message: format!(
                "the elements '{}' have no list vertex_indices",
                String::from_utf8_lossy(&element.name)
            ),
        });
    };
    if !element.properties[place].scalar.is_integer() {
        return Err(SoupError::Malformed {
            message: "the vertex numbers of faces must be integers".to_owned(),
        });
    }
    let mut corners = Vec::new();
    for _ in 0..count {
        data.start_element("a face")?;
        corners.clear();
        for (at, property) in element.properties.iter().enumerate() {
            if at != place {
                data.skip(property)?;
                continue;
            }
            for _ in 0..data.length(length, property.scalar)? {
                corners.push(data.integer(property.scalar)?);
            }
        }
        add(&corners);
    }
    Ok(())
}
