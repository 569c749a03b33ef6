//! Files compressed by gzip (`deutsch1996`), told by their first bytes.

use std::borrow::Cow;

use crate::soup::SoupError;

/// The first bytes of every such file (section 2.3.1).
pub(super) const MAGIC: &[u8] = b"\x1f\x8b";

/// How many bytes one compressed byte may stand for. Meshes as text come to less than 20; a thousand is
/// what the method can do, with zeros.
#[cfg(feature = "gzip")]
const RATIO: u64 = 200;

/// How many bytes there may be in all, and how many of any file, however small.
#[cfg(feature = "gzip")]
const MOST: u64 = 8 << 30;
#[cfg(feature = "gzip")]
const ANY: u64 = 16 << 20;

/// The contents of a file, which may be compressed.
#[cfg(feature = "gzip")]
pub(super) fn inflated(bytes: &[u8]) -> Result<Cow<'_, [u8]>, SoupError> {
    use std::io::Read;

    if !bytes.starts_with(MAGIC) {
        return Ok(Cow::Borrowed(bytes));
    }
    let malformed = |message: String| SoupError::Malformed { message };
    let bound = (bytes.len() as u64).saturating_mul(RATIO).clamp(ANY, MOST);
    let mut contents = Vec::new();
    // A gzip file may consist of several members.
    let inflated = flate2::read::MultiGzDecoder::new(bytes);
    let read = inflated.take(bound + 1).read_to_end(&mut contents);
    read.map_err(|reason| malformed(format!("the compressed file is damaged: {reason}")))?;
    if contents.len() as u64 > bound {
        return Err(malformed(format!(
            "the compressed file of {} bytes holds more than {bound}; decompress it first",
            bytes.len()
        )));
    }
    Ok(Cow::Owned(contents))
}

#[cfg(not(feature = "gzip"))]
pub(super) fn inflated(bytes: &[u8]) -> Result<Cow<'_, [u8]>, SoupError> {
    if bytes.starts_with(MAGIC) {
        return Err(SoupError::Malformed {
            message: "the file is compressed, and this build is without the feature `gzip`".into(),
        });
    }
    Ok(Cow::Borrowed(bytes))
}
