//! The numbers that follow a PLY header, as text or binary.

use super::super::bytes::Bytes;
use super::super::lines::Words;
use super::header::{Property, Scalar};
use crate::soup::SoupError;

/// Where the numbers come from.
pub(super) enum Data<'a> {
    /// Each element starts on a line of its own. What a line has beyond it is passed over, as the first
    /// reader of the format did.
    Text(Words<'a>),
    /// The numbers one after the other.
    Binary { bytes: Bytes<'a>, big: bool },
}

impl Data<'_> {
    pub(super) fn start_element(&mut self, what: &str) -> Result<(), SoupError> {
        match self {
            Data::Text(words) => words.next_line(what),
            Data::Binary { .. } => Ok(()),
        }
    }

    pub(super) fn float(&mut self, scalar: Scalar) -> Result<f64, SoupError> {
        if scalar.is_integer() {
            return Ok(self.integer(scalar)? as f64);
        }
        match self {
            // A number of single precision is the nearest one to what is written.
            Data::Text(words) if scalar == Scalar::F32 => {
                words.number::<f32>("a number").map(f64::from)
            }
            Data::Text(words) => words.number("a number"),
            Data::Binary { bytes, big } if scalar == Scalar::F32 => {
                Ok(f32::from_le_bytes(raw(bytes, *big)?).into())
            }
            Data::Binary { bytes, big } => Ok(f64::from_le_bytes(raw(bytes, *big)?)),
        }
    }

    pub(super) fn integer(&mut self, scalar: Scalar) -> Result<i64, SoupError> {
        let (bytes, big) = match self {
            Data::Text(words) => return words.number("an integer"),
            Data::Binary { bytes, big } => (bytes, *big),
        };
        Ok(match scalar {
            Scalar::I8 => i8::from_le_bytes(raw(bytes, big)?).into(),
            Scalar::U8 => u8::from_le_bytes(raw(bytes, big)?).into(),
            Scalar::I16 => i16::from_le_bytes(raw(bytes, big)?).into(),
            Scalar::U16 => u16::from_le_bytes(raw(bytes, big)?).into(),
            Scalar::I32 => i32::from_le_bytes(raw(bytes, big)?).into(),
            Scalar::U32 => u32::from_le_bytes(raw(bytes, big)?).into(),
            Scalar::F32 | Scalar::F64 => return Err(self.wrong("an integer is declared a float")),
        })
    }

    /// The length of a list.
    pub(super) fn length(&mut self, length: Scalar, scalar: Scalar) -> Result<usize, SoupError> {
        let count = self.integer(length)?;
        match self {
            Data::Text(words) => {
                usize::try_from(count).map_err(|_| words.wrong("the length of a list is negative"))
            }
            Data::Binary { bytes, .. } => {
                bytes.plausible(count, scalar.size(), "numbers in a list")
            }
        }
    }

    pub(super) fn skip(&mut self, property: &Property) -> Result<(), SoupError> {
        let count = match property.length {
            Some(length) => self.length(length, property.scalar)?,
            None => 1,
        };
        match self {
            Data::Text(words) => {
                for _ in 0..count {
                    words.word("a number")?;
                }
            }
            Data::Binary { bytes, .. } => {
                bytes.take(count * property.scalar.size(), "a property")?;
            }
        }
        Ok(())
    }

    /// An error at this line or byte.
    pub(super) fn wrong(&self, message: &str) -> SoupError {
        match self {
            Data::Text(words) => words.wrong(message),
            Data::Binary { bytes, .. } => SoupError::Malformed {
                message: format!("byte {}: {message}", bytes.at()),
            },
        }
    }
}

/// The bytes of a number, the least significant first.
fn raw<const N: usize>(bytes: &mut Bytes, big: bool) -> Result<[u8; N], SoupError> {
    let mut raw = bytes.array("its data")?;
    if big {
        raw.reverse();
    }
    Ok(raw)
}
