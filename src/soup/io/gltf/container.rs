//! The two containers of glTF 2.0: JSON alone, and the binary file of section 4, told by their first
//! bytes.

use super::document::{Document, Versioned};
use super::malformed;
use crate::soup::SoupError;
use crate::soup::io::bytes::Bytes;

pub(in crate::soup::io) const MAGIC: &[u8] = b"glTF";

/// The document, and the buffer that a binary file has.
pub(super) fn open(bytes: &[u8]) -> Result<(Document, Option<&[u8]>), SoupError> {
    if bytes.starts_with(MAGIC) {
        return open_binary(bytes);
    }
    let text = bytes.strip_prefix(b"\xef\xbb\xbf").unwrap_or(bytes);
    let place = |error: serde_json::Error| SoupError::Parse {
        line: error.line().max(1),
        message: without_place(&error),
    };
    Ok((document(text, &place)?, None))
}

fn open_binary(bytes: &[u8]) -> Result<(Document, Option<&[u8]>), SoupError> {
    let mut data = Bytes::new(bytes, MAGIC.len());
    let mut integer = |what: &str| Ok::<_, SoupError>(u32::from_le_bytes(data.array(what)?));
    let version = integer("its header")?;
    if version != 2 {
        return Err(not_supported(&version.to_string()));
    }
    let length = integer("its header")? as usize;
    let whole = bytes.get(..length).ok_or_else(|| {
        malformed(format!(
            "byte 8: the file declares {length} bytes, and has {}",
            bytes.len()
        ))
    })?;
    let mut data = Bytes::new(whole, 12);
    let (mut json, mut buffer) = (None, None);
    while data.left() > 0 {
        let start = data.at();
        let length = u32::from_le_bytes(data.array("the header of a chunk")?);
        let kind: [u8; 4] = data.array("the header of a chunk")?;
        let chunk = data.take(length as usize, &format!("the chunk at byte {start}"))?;
        match &kind {
            b"JSON" if json.is_none() => json = Some(chunk),
            b"BIN\0" if buffer.is_none() => buffer = Some(chunk),
            _ => {}
        }
    }
    let json = json.ok_or_else(|| malformed("byte 12: the file has no chunk of JSON".into()))?;
    let place = |error: serde_json::Error| {
        malformed(format!(
            "line {} of its JSON: {}",
            error.line(),
            without_place(&error)
        ))
    };
    Ok((document(json, &place)?, buffer))
}

fn document(
    json: &[u8],
    place: &dyn Fn(serde_json::Error) -> SoupError,
) -> Result<Document, SoupError> {
    let versioned: Versioned = serde_json::from_slice(json).map_err(place)?;
    let version = versioned.asset.version;
    let version = version.as_str().map_or(version.to_string(), str::to_owned);
    if version != "2" && !version.starts_with("2.") {
        return Err(not_supported(&version));
    }
    serde_json::from_slice(json).map_err(place)
}

fn not_supported(version: &str) -> SoupError {
    malformed(format!(
        "the file is glTF {version}; only version 2 is read, so export it as glTF 2"
    ))
}

/// The message of an error in JSON, without the place that `serde_json` adds.
fn without_place(error: &serde_json::Error) -> String {
    let message = error.to_string();
    let end = message.rfind(" at line ").unwrap_or(message.len());
    message[..end].to_owned()
}
