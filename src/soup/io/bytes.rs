//! Binary contents read from front to back, with errors that name the byte.

use crate::soup::SoupError;

/// What is left of a file, and where it starts.
pub(super) struct Bytes<'a> {
    all: &'a [u8],
    at: usize,
}

impl<'a> Bytes<'a> {
    /// The bytes of a file from this one onwards.
    pub(super) fn new(all: &'a [u8], at: usize) -> Self {
        Bytes {
            all,
            at: at.min(all.len()),
        }
    }

    pub(super) fn at(&self) -> usize {
        self.at
    }

    pub(super) fn left(&self) -> usize {
        self.all.len() - self.at
    }

    /// The next bytes; `what` says what they are a part of.
    pub(super) fn take(&mut self, count: usize, what: &str) -> Result<&'a [u8], SoupError> {
        let taken = self.all[self.at..].get(..count);
        let taken = taken.ok_or_else(|| too_short(self.all.len(), what))?;
        self.at += count;
        Ok(taken)
    }

    /// The next bytes, of which there are as many as the array has.
    pub(super) fn array<const N: usize>(&mut self, what: &str) -> Result<[u8; N], SoupError> {
        let taken = self.all[self.at..].first_chunk();
        let taken = taken.ok_or_else(|| too_short(self.all.len(), what))?;
        self.at += N;
        Ok(*taken)
    }

    /// A number of elements, each of at least so many bytes, which the file has room for.
    pub(super) fn plausible(
        &self,
        count: i64,
        size: usize,
        what: &str,
    ) -> Result<usize, SoupError> {
        plausible(count, size, self.left(), self.at, what)
    }
}

/// A number of elements, each of at least so many bytes, which what is left from a byte onwards has room
/// for.
pub(super) fn plausible(
    count: i64,
    size: usize,
    left: usize,
    at: usize,
    what: &str,
) -> Result<usize, SoupError> {
    let room = left / size.max(1);
    let fits = usize::try_from(count).ok().filter(|&count| count <= room);
    fits.ok_or_else(|| SoupError::Malformed {
        message: format!("byte {at}: the file declares {count} {what}, and has room for {room}"),
    })
}

fn too_short(length: usize, what: &str) -> SoupError {
    SoupError::Malformed {
        message: format!("the file ends at byte {length}, within {what}"),
    }
}
