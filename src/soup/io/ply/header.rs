//! The header of a PLY file: its encoding, and the elements in the order of the file.

use super::super::lines::{Lines, number};
use crate::soup::SoupError;

/// How the data are encoded.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Encoding {
    Ascii,
    LittleEndian,
    BigEndian,
}

/// The type of a number.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Scalar {
    I8,
    U8,
    I16,
    U16,
    I32,
    U32,
    F32,
    F64,
}

impl Scalar {
    fn of(word: &[u8]) -> Option<Scalar> {
        Some(match word {
            b"char" | b"int8" => Scalar::I8,
            b"uchar" | b"uint8" => Scalar::U8,
            b"short" | b"int16" => Scalar::I16,
            b"ushort" | b"uint16" => Scalar::U16,
            b"int" | b"int32" => Scalar::I32,
            b"uint" | b"uint32" => Scalar::U32,
            b"float" | b"float32" => Scalar::F32,
            b"double" | b"float64" => Scalar::F64,
            _ => return None,
        })
    }

    /// Its size in bytes.
    pub(super) fn size(self) -> usize {
        match self {
            Scalar::I8 | Scalar::U8 => 1,
            Scalar::I16 | Scalar::U16 => 2,
            Scalar::I32 | Scalar::U32 | Scalar::F32 => 4,
            Scalar::F64 => 8,
        }
    }

    pub(super) fn is_integer(self) -> bool {
        !matches!(self, Scalar::F32 | Scalar::F64)
    }
}

/// A property of every element of a kind.
pub(super) struct Property {
    pub(super) name: Vec<u8>,
    /// The type of the length, for a list.
    pub(super) length: Option<Scalar>,
    pub(super) scalar: Scalar,
}

impl Property {
    /// The fewest bytes that it takes in a binary file.
    fn size(&self) -> usize {
        self.length.unwrap_or(self.scalar).size()
    }
}

/// A kind of element.
pub(super) struct Element {
    pub(super) name: Vec<u8>,
    pub(super) count: i64,
    pub(super) properties: Vec<Property>,
}

impl Element {
    /// The fewest bytes that one takes: in text a line, of which the last may lack its end.
    pub(super) fn size(&self, encoding: Encoding) -> usize {
        match encoding {
            Encoding::Ascii => 1,
            _ => self.properties.iter().map(Property::size).sum(),
        }
    }

    /// The place of the property of this name.
    pub(super) fn place(&self, name: &[u8]) -> Option<usize> {
        self.properties.iter().position(|p| p.name == name)
    }
}

pub(super) struct Header<'a> {
    pub(super) encoding: Encoding,
    pub(super) elements: Vec<Element>,
    /// What follows the header.
    pub(super) data: Lines<'a>,
}

impl<'a> Header<'a> {
    pub(super) fn parse(bytes: &'a [u8]) -> Result<Self, SoupError> {
        let mut lines = Lines::new(bytes);
        let mut encoding = None;
        let mut elements: Vec<Element> = Vec::new();
        let mut last = 0;
        while let Some((line, text)) = lines.next() {
            last = line;
            let wrong = |message: &str| SoupError::Parse {
                line,
                message: message.to_owned(),
            };
            let words: Vec<_> = text
                .split(u8::is_ascii_whitespace)
                .filter(|word| !word.is_empty())
                .collect();
            match *words.as_slice() {
                [b"ply"] if line == 1 => {}
                _ if line == 1 => return Err(wrong("the file does not start with 'ply'")),
                [] | [b"comment" | b"obj_info", ..] => {}
                [b"format", name, _version] if encoding.is_none() => {
                    encoding = Some(match name {
                        b"ascii" => Encoding::Ascii,
                        b"binary_little_endian" => Encoding::LittleEndian,
                        b"binary_big_endian" => Encoding::BigEndian,
                        _ => return Err(wrong("the encoding is not known")),
                    });
                }
                [b"element", name, count] => elements.push(Element {
                    name: name.to_vec(),
                    count: number(count).ok_or_else(|| wrong("the count is not a number"))?,
                    properties: Vec::new(),
                }),
                [b"property", ref of @ .., name] => {
                    let known =
                        |word| Scalar::of(word).ok_or_else(|| wrong("the type is not known"));
                    let (length, scalar) = match *of {
                        [scalar] => (None, known(scalar)?),
                        [b"list", length, scalar] => (Some(known(length)?), known(scalar)?),
                        _ => return Err(wrong("a property is a type and a name")),
                    };
                    if length.is_some_and(|length| !length.is_integer()) {
                        return Err(wrong("the length of a list must be an integer"));
                    }
                    let element = elements.last_mut();
                    let element = element.ok_or_else(|| wrong("a property of no element"))?;
                    element.properties.push(Property {
                        name: name.to_vec(),
                        length,
                        scalar,
                    });
                }
                [b"end_header"] => {
                    return Ok(Header {
                        encoding: encoding.ok_or_else(|| wrong("the header names no format"))?,
                        elements,
                        data: lines,
                    });
                }
                _ => return Err(wrong("the line does not belong into a header")),
            }
        }
        Err(SoupError::Parse {
            line: last.max(1),
            message: "the file ends within its header".to_owned(),
        })
    }
}
