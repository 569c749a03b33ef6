//! The colours of vertices and faces, and all other numbers of vertices.

use super::super::attributes::{Attribute, Attributes, Color, Values, labels_of};
use super::super::bytes::plausible;
use super::header::{Element, Scalar};
use super::{Header, data_of};
use crate::soup::SoupError;

const CHANNELS: [&[u8]; 4] = [b"red", b"green", b"blue", b"alpha"];

/// What is no attribute of a vertex. Quads have other normals.
const GEOMETRY: [&[u8]; 6] = [b"x", b"y", b"z", b"nx", b"ny", b"nz"];

/// The properties of an element that are read.
#[derive(Default)]
struct Columns {
    /// The places of red, green, blue and alpha, if there are the first three.
    color: Option<[Option<usize>; 4]>,
    /// Those of other numbers, of vertices alone.
    scalars: Vec<usize>,
}

impl Columns {
    fn of(element: &Element) -> Self {
        let is_vertex = element.name == b"vertex";
        if !is_vertex && element.name != b"face" {
            return Columns::default();
        }
        let number = |place: &usize| element.properties[*place].length.is_none();
        let channels = CHANNELS.map(|name| element.place(name).filter(number));
        let is_color = channels[..3].iter().all(Option::is_some);
        let color = is_color.then_some(channels);
        let is_scalar = |place: &usize| {
            let name = &*element.properties[*place].name;
            let is_first = element.place(name) == Some(*place);
            let is_channel = color.is_some_and(|channels| channels.contains(&Some(*place)));
            is_first && number(place) && !is_channel && !GEOMETRY.contains(&name)
        };
        let all = 0..if is_vertex {
            element.properties.len()
        } else {
            0
        };
        Columns {
            color,
            scalars: all.filter(is_scalar).collect(),
        }
    }

    fn are_none(&self) -> bool {
        self.color.is_none() && self.scalars.is_empty()
    }
}

/// Whether a file has attributes, by its header.
pub(in super::super) fn has_attributes(bytes: &[u8]) -> Result<bool, SoupError> {
    let header = Header::parse(bytes)?;
    let mut elements = header.elements.iter();
    Ok(elements.any(|element| !Columns::of(element).are_none()))
}

/// The attributes of a file.
pub(in super::super) fn attributes(bytes: &[u8]) -> Result<Attributes, SoupError> {
    let header = Header::parse(bytes)?;
    let (mut data, start) = data_of(bytes, &header);
    let mut values = Values::default();
    let mut of_faces = None;
    for element in &header.elements {
        if element.properties.is_empty() {
            continue;
        }
        let columns = Columns::of(element);
        let size = element.size(header.encoding);
        let count = plausible(element.count, size, bytes.len() - start, start, "elements")?;
        let mut colors = Vec::new();
        let mut scalars = vec![Vec::new(); columns.scalars.len()];
        for _ in 0..count {
            data.start_element("an element")?;
            let mut color = [1.0; 4];
            for (place, property) in element.properties.iter().enumerate() {
                let channel = columns.color.and_then(|channels| {
                    channels.iter().position(|&channel| channel == Some(place))
                });
                let scalar = columns.scalars.iter().position(|&scalar| scalar == place);
                match (channel, scalar) {
                    (Some(channel), _) => {
                        color[channel] = data.float(property.scalar)? / full(property.scalar);
                    }
                    (None, Some(scalar)) => scalars[scalar].push(data.float(property.scalar)?),
                    (None, None) => data.skip(property)?,
                }
            }
            if columns.color.is_some() {
                colors.push(color);
            }
        }
        let colors: Option<Vec<Color>> = columns.color.map(|_| colors);
        match &*element.name {
            b"vertex" => {
                let names = columns.scalars.iter().map(|&place| {
                    String::from_utf8_lossy(&element.properties[place].name).into_owned()
                });
                values.scalars = names.zip(scalars).collect();
                values.vertex_colors = colors;
            }
            b"face" => of_faces = colors,
            _ => {}
        }
    }
    let labels = of_faces.as_deref().map(labels_of);
    values.face_colors = of_faces.unwrap_or_default();
    Ok(Attributes::of(values).with(Attribute::Colors, labels))
}

/// The number that stands for a full channel.
fn full(scalar: Scalar) -> f64 {
    match scalar {
        Scalar::F32 | Scalar::F64 => 1.0,
        Scalar::U16 => f64::from(u16::MAX),
        _ => f64::from(u8::MAX),
    }
}
