//! Scalar properties of the element `vertex`, by name.

use super::super::bytes::plausible;
use super::header::{Element, Scalar};
use super::{Header, data_of};
use crate::soup::SoupError;

/// The names of the scalar properties of vertices, and the largest number of each if it is of an integer type.
pub(in super::super) fn vertex_properties(
    bytes: &[u8],
) -> Result<Vec<(String, Option<f64>)>, SoupError> {
    let header = Header::parse(bytes)?;
    let vertex = header.elements.iter().find(|e| e.name == b"vertex");
    let properties = vertex.map_or(&[][..], |vertex| &vertex.properties);
    let scalars = properties.iter().filter(|p| p.length.is_none());
    let known = scalars.map(|p| {
        let name = String::from_utf8_lossy(&p.name).into_owned();
        (name, largest(p.scalar))
    });
    Ok(known.collect())
}

fn largest(scalar: Scalar) -> Option<f64> {
    match scalar {
        Scalar::I8 => Some(f64::from(i8::MAX)),
        Scalar::U8 => Some(f64::from(u8::MAX)),
        Scalar::I16 => Some(f64::from(i16::MAX)),
        Scalar::U16 => Some(f64::from(u16::MAX)),
        Scalar::I32 => Some(f64::from(i32::MAX)),
        Scalar::U32 => Some(f64::from(u32::MAX)),
        Scalar::F32 | Scalar::F64 => None,
    }
}

/// The values of scalar properties of every vertex.
pub(in super::super) fn vertex_scalars<const N: usize>(
    bytes: &[u8],
    names: [&str; N],
) -> Result<Vec<[f64; N]>, SoupError> {
    let header = Header::parse(bytes)?;
    let (mut data, start) = data_of(bytes, &header);
    let mut values = Vec::new();
    for element in &header.elements {
        if element.properties.is_empty() {
            continue;
        }
        let is_vertex = element.name == b"vertex";
        let places = names.map(|name| scalar_place(element, name).filter(|_| is_vertex));
        let size = element.size(header.encoding);
        let count = plausible(element.count, size, bytes.len() - start, start, "elements")?;
        for _ in 0..count {
            data.start_element("an element")?;
            let mut value = [0.0; N];
            for (place, property) in element.properties.iter().enumerate() {
                match places.iter().position(|&p| p == Some(place)) {
                    Some(i) => value[i] = data.float(property.scalar)?,
                    None => data.skip(property)?,
                }
            }
            if is_vertex {
                values.push(value);
            }
        }
        if is_vertex {
            break;
        }
    }
    Ok(values)
}

fn scalar_place(element: &Element, name: &str) -> Option<usize> {
    let mut properties = element.properties.iter();
    properties.position(|p| p.name == name.as_bytes() && p.length.is_none())
}
