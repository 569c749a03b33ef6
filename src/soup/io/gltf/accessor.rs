//! Accessors of glTF (section 3.6.2): arrays of numbers in a buffer, tight or interleaved, whole or
//! sparse, of every component type. Every place is checked before it is read.

use super::document::{Accessor, SparsePart};
use super::{Source, malformed};
use crate::soup::SoupError;

/// Where elements lie.
struct Place {
    view: usize,
    offset: usize,
    count: usize,
}

/// The type of a number.
#[derive(Clone, Copy)]
struct Component {
    code: u32,
    size: usize,
    /// What stands for one where the numbers are normalised. Zero for floats.
    one: f64,
}

impl Component {
    fn of(code: u32) -> Result<Component, SoupError> {
        let (size, one) = match code {
            5120 => (1, 127.0),
            5121 => (1, 255.0),
            5122 => (2, 32_767.0),
            5123 => (2, 65_535.0),
            5125 => (4, 4_294_967_295.0),
            5126 => (4, 0.0),
            _ => return Err(malformed(format!("there is no component type {code}"))),
        };
        Ok(Component { code, size, one })
    }

    /// The number in its bytes, of which there are as many as its size.
    fn read(self, bytes: &[u8]) -> f64 {
        let mut raw = [0; 4];
        raw[..self.size].copy_from_slice(bytes);
        let low = [raw[0], raw[1]];
        match self.code {
            5120 => i8::from_le_bytes([raw[0]]).into(),
            5121 => raw[0].into(),
            5122 => i16::from_le_bytes(low).into(),
            5123 => u16::from_le_bytes(low).into(),
            5125 => u32::from_le_bytes(raw).into(),
            _ => f32::from_le_bytes(raw).into(),
        }
    }
}

impl Source<'_> {
    /// The positions that an accessor gives.
    pub(super) fn positions(&mut self, number: usize) -> Result<Vec<[f64; 3]>, SoupError> {
        let numbers = self.numbers(number, "VEC3", 3)?;
        Ok(numbers.as_chunks().0.to_vec())
    }

    /// The vertex numbers that an accessor gives.
    pub(super) fn indices(&mut self, number: usize) -> Result<Vec<i64>, SoupError> {
        let numbers = self.numbers(number, "SCALAR", 1)?;
        let code = self.accessor(number)?.component_type;
        if ![5121, 5123, 5125].contains(&code) {
            return Err(malformed(format!(
                "the indices of accessor {number} are not unsigned integers"
            )));
        }
        Ok(numbers.into_iter().map(|index| index as i64).collect())
    }

    /// The values of an attribute that an accessor gives to so many vertices.
    pub(super) fn of_vertices<const N: usize>(
        &mut self,
        number: usize,
        (name, shape): (&str, &str),
        vertices: usize,
    ) -> Result<Vec<[f64; N]>, SoupError> {
        let numbers = self.numbers(number, shape, N)?;
        let values = numbers.as_chunks().0.to_vec();
        self.spend(values.len())?;
        match values.len() == vertices {
            true => Ok(values),
            false => Err(malformed(format!(
                "accessor {number}: {name} of {} vertices, where there are {vertices}",
                values.len()
            ))),
        }
    }

    /// The type of the elements of an accessor.
    pub(super) fn shape(&self, number: usize) -> Result<&str, SoupError> {
        Ok(&self.accessor(number)?.shape)
    }

    fn accessor(&self, number: usize) -> Result<&Accessor, SoupError> {
        let accessor = self.document.accessors.get(number);
        accessor.ok_or_else(|| malformed(format!("there is no accessor {number}")))
    }

    fn numbers(&mut self, number: usize, shape: &str, width: usize) -> Result<Vec<f64>, SoupError> {
        let accessor = self.accessor(number)?;
        if accessor.shape != shape {
            return Err(malformed(format!(
                "accessor {number} is of type {}, not {shape}",
                accessor.shape
            )));
        }
        let component = Component::of(accessor.component_type)?;
        let (count, normalized) = (accessor.count, accessor.normalized);
        let sparse = accessor.sparse.as_ref().map(|sparse| {
            let part = |part: &SparsePart| Place {
                view: part.buffer_view,
                offset: part.byte_offset,
                count: sparse.count,
            };
            let code = sparse.indices.component_type;
            (part(&sparse.indices), code, part(&sparse.values))
        });
        let base = accessor.buffer_view.map(|view| Place {
            view,
            offset: accessor.byte_offset,
            count,
        });
        let mut numbers = match base {
            Some(place) => self.elements(&place, component, width)?,
            // Zeros, which nothing in the file stands for.
            None => {
                self.spend(count)?;
                vec![0.0; count * width]
            }
        };
        if let Some((places, code, values)) = sparse {
            let code = code.filter(|code| [5121, 5123, 5125].contains(code));
            let code = code.ok_or_else(|| {
                malformed(format!(
                    "accessor {number}: sparse indices are unsigned integers"
                ))
            })?;
            let places = self.elements(&places, Component::of(code)?, 1)?;
            let values = self.elements(&values, component, width)?;
            for (place, value) in places.into_iter().zip(values.chunks_exact(width)) {
                let place = place as usize;
                if place >= count {
                    return Err(malformed(format!(
                        "accessor {number}: the sparse index {place} is outside 0..{count}"
                    )));
                }
                numbers[place * width..][..width].copy_from_slice(value);
            }
        }
        if normalized && component.one > 0.0 {
            for number in &mut numbers {
                *number = (*number / component.one).max(-1.0);
            }
        }
        Ok(numbers)
    }

    /// The numbers of elements, each of so many.
    fn elements(
        &mut self,
        place: &Place,
        component: Component,
        width: usize,
    ) -> Result<Vec<f64>, SoupError> {
        let view = self.document.buffer_views.get(place.view);
        let view =
            view.ok_or_else(|| malformed(format!("there is no buffer view {}", place.view)))?;
        if let Some(name) = view.extensions.keys().find(|name| name.contains("meshopt")) {
            return Err(super::not_supported(name));
        }
        let size = component.size * width;
        let stride = view.byte_stride.unwrap_or(size);
        if stride < size {
            return Err(malformed(format!(
                "buffer view {}: a stride of {stride} bytes, for elements of {size}",
                place.view
            )));
        }
        if place.count == 0 {
            return Ok(Vec::new());
        }
        let buffer = self.buffers.get(view.buffer)?;
        let within = |start: usize, length: usize, bytes: &'_ [u8]| {
            let end = start.checked_add(length)?;
            (end <= bytes.len()).then_some(start..end)
        };
        let bytes = within(view.byte_offset, view.byte_length, buffer).map(|range| &buffer[range]);
        let bytes = bytes.and_then(|bytes| {
            let length = (place.count - 1).checked_mul(stride)?.checked_add(size)?;
            within(place.offset, length, bytes).map(|range| &bytes[range])
        });
        let bytes = bytes.ok_or_else(|| {
            malformed(format!(
                "buffer view {}: {} elements of {stride} bytes do not lie within buffer {} of {} bytes",
                place.view,
                place.count,
                view.buffer,
                buffer.len()
            ))
        })?;
        let elements = bytes.chunks(stride).map(|element| &element[..size]);
        let numbers = elements.flat_map(|element| element.chunks_exact(component.size));
        Ok(numbers.map(|number| component.read(number)).collect())
    }
}
