//! The buffers of glTF (section 3.6.1): in the binary file, in the text, or in files next to it. Each is
//! opened when it is first needed.

use std::borrow::Cow;
use std::io::Read;
use std::path::{Component, Path, PathBuf};

use base64::Engine;
use base64::alphabet::STANDARD;
use base64::engine::{DecodePaddingMode, GeneralPurpose, GeneralPurposeConfig};

use super::document::{Buffer, Document};
use super::malformed;
use crate::soup::SoupError;

pub(super) struct Buffers<'a> {
    declared: &'a [Buffer],
    /// The buffer of a binary file.
    own: Option<&'a [u8]>,
    folder: Option<&'a Path>,
    open: Vec<Option<Cow<'a, [u8]>>>,
}

impl<'a> Buffers<'a> {
    pub(super) fn new(
        document: &'a Document,
        own: Option<&'a [u8]>,
        folder: Option<&'a Path>,
    ) -> Self {
        Buffers {
            declared: &document.buffers,
            own,
            folder,
            open: document.buffers.iter().map(|_| None).collect(),
        }
    }

    /// Bytes of all buffers that are open.
    pub(super) fn size(&self) -> usize {
        self.open.iter().flatten().map(|buffer| buffer.len()).sum()
    }

    pub(super) fn get(&mut self, number: usize) -> Result<&[u8], SoupError> {
        let declared = self.declared.get(number);
        let declared = declared.ok_or_else(|| malformed(format!("there is no buffer {number}")))?;
        if self.open[number].is_none() {
            let contents = self.contents(number, declared)?;
            if contents.len() < declared.byte_length {
                return Err(malformed(format!(
                    "buffer {number} declares {} bytes, and has {}",
                    declared.byte_length,
                    contents.len()
                )));
            }
            self.open[number] = Some(contents);
        }
        Ok(self.open[number].as_deref().unwrap_or_default())
    }

    fn contents(&self, number: usize, buffer: &Buffer) -> Result<Cow<'a, [u8]>, SoupError> {
        let Some(uri) = &buffer.uri else {
            let own = self.own.filter(|_| number == 0).map(Cow::Borrowed);
            return own.ok_or_else(|| malformed(format!("buffer {number} has no data")));
        };
        if let Some(data) = uri.strip_prefix("data:") {
            let encoded = data.split_once(";base64,").map(|(_, encoded)| encoded);
            let decoded = encoded.and_then(|encoded| base64().decode(encoded).ok());
            return decoded
                .map(Cow::Owned)
                .ok_or_else(|| malformed(format!("the data of buffer {number} are not base64")));
        }
        let path = self.path(uri)?;
        let open = || -> std::io::Result<Vec<u8>> {
            let file = std::fs::File::open(&path)?;
            if !file.metadata()?.is_file() {
                return Err(std::io::Error::other("it is not a file"));
            }
            let mut contents = Vec::new();
            file.take(buffer.byte_length as u64)
                .read_to_end(&mut contents)?;
            Ok(contents)
        };
        let contents = open().map_err(|reason| SoupError::Io {
            message: format!("buffer {number}: {}: {reason}", path.display()),
        })?;
        Ok(Cow::Owned(contents))
    }

    /// A file next to the mesh, or in a folder below it.
    fn path(&self, uri: &str) -> Result<PathBuf, SoupError> {
        let folder = self.folder.ok_or_else(|| {
            malformed(format!(
                "a buffer is in the file '{uri}', and the contents were given without a folder; \
                 read the mesh from its file, or convert it to GLB"
            ))
        })?;
        let name = percent_decoded(uri);
        let inside = Path::new(&name)
            .components()
            .all(|part| matches!(part, Component::Normal(_) | Component::CurDir));
        if !inside || name.contains("://") {
            return Err(malformed(format!(
                "the buffer '{uri}' is not in the folder of the file"
            )));
        }
        Ok(folder.join(name))
    }
}

fn base64() -> GeneralPurpose {
    let config =
        GeneralPurposeConfig::new().with_decode_padding_mode(DecodePaddingMode::Indifferent);
    GeneralPurpose::new(&STANDARD, config)
}

/// A name whose bytes may be written as `%` and two hexadecimal digits.
fn percent_decoded(uri: &str) -> String {
    let mut name = Vec::with_capacity(uri.len());
    let mut rest = uri.as_bytes();
    while let Some((&first, after)) = rest.split_first() {
        let digits = after.get(..2).and_then(|two| std::str::from_utf8(two).ok());
        let byte = digits.and_then(|two| u8::from_str_radix(two, 16).ok());
        match byte.filter(|_| first == b'%') {
            Some(byte) => {
                name.push(byte);
                rest = &after[2..];
            }
            None => {
                name.push(first);
                rest = after;
            }
        }
    }
    String::from_utf8_lossy(&name).into_owned()
}
