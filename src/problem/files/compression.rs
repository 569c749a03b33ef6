//! Compression by gzip (feature `gzip`, format of `deutsch1996`).

use std::fs::File;
use std::io::{BufRead, BufReader, BufWriter, Read, Write};
use std::path::Path;

use super::io_error;
use crate::error::{Error, Result};

/// The first bytes of every gzip file (`deutsch1996`, section 2.3.1).
const MAGIC: [u8; 2] = [0x1f, 0x8b];

/// Opens the file at `path`, which may be compressed, and reads its text by `parse`.
pub(in crate::problem) fn read_by<T>(
    path: &Path,
    parse: impl FnOnce(&mut dyn BufRead) -> Result<T>,
) -> Result<T> {
    let file = File::open(path).map_err(|e| io_error(path, e))?;
    match parse_by(BufReader::with_capacity(1 << 16, file), parse) {
        Err(Error::Io { message }) => Err(io_error(path, message)),
        other => other,
    }
}

/// Reads the text of `reader`, which may be compressed, by `parse`.
pub(in crate::problem) fn parse_by<T>(
    mut reader: impl BufRead,
    parse: impl FnOnce(&mut dyn BufRead) -> Result<T>,
) -> Result<T> {
    let mut head = Vec::with_capacity(MAGIC.len());
    let peeked = reader
        .by_ref()
        .take(MAGIC.len() as u64)
        .read_to_end(&mut head);
    peeked.map_err(|e| Error::Io {
        message: e.to_string(),
    })?;
    let compressed = head == MAGIC;
    let mut reader = head.chain(reader);
    if compressed {
        inflate(reader, parse)
    } else {
        parse(&mut reader)
    }
}

#[cfg(feature = "gzip")]
fn inflate<T>(
    reader: impl BufRead,
    parse: impl FnOnce(&mut dyn BufRead) -> Result<T>,
) -> Result<T> {
    // A gzip file may consist of several members.
    let inflated = flate2::bufread::MultiGzDecoder::new(reader);
    parse(&mut BufReader::with_capacity(1 << 16, inflated))
}

#[cfg(not(feature = "gzip"))]
fn inflate<T>(_: impl BufRead, _: impl FnOnce(&mut dyn BufRead) -> Result<T>) -> Result<T> {
    Err(no_gzip())
}

/// Creates the file at `path`, lets `content` write it, and closes it. The file is compressed if its name
/// ends in `.gz`.
pub(in crate::problem) fn create(
    path: &Path,
    content: impl FnOnce(&mut dyn Write) -> std::io::Result<()>,
) -> Result<()> {
    let compressed = path
        .extension()
        .is_some_and(|e| e.eq_ignore_ascii_case("gz"));
    if compressed && cfg!(not(feature = "gzip")) {
        return Err(no_gzip());
    }
    let fill = || {
        let mut file = BufWriter::with_capacity(1 << 16, File::create(path)?);
        if compressed {
            deflate(&mut file, content)?;
        } else {
            content(&mut file)?;
        }
        file.flush()
    };
    fill().map_err(|e| io_error(path, e))
}

#[cfg(feature = "gzip")]
fn deflate(
    file: &mut impl Write,
    content: impl FnOnce(&mut dyn Write) -> std::io::Result<()>,
) -> std::io::Result<()> {
    let encoder = flate2::write::GzEncoder::new(file, flate2::Compression::default());
    let mut buffered = BufWriter::with_capacity(1 << 16, encoder);
    content(&mut buffered)?;
    let encoder = buffered.into_inner().map_err(|e| e.into_error())?;
    encoder.finish().map(|_| ())
}

#[cfg(not(feature = "gzip"))]
fn deflate(
    _: &mut impl Write,
    _: impl FnOnce(&mut dyn Write) -> std::io::Result<()>,
) -> std::io::Result<()> {
    Err(std::io::ErrorKind::Unsupported.into())
}

fn no_gzip() -> Error {
    Error::NotSupported {
        what: "files compressed by gzip (this build is without the feature `gzip`)".into(),
        index: None,
        line: None,
    }
}
