//! The statements of an OBJ file that describe a surface and its parts, each on a line of its own or continued over
//! several by a backslash.

use std::borrow::Cow;

use super::lines::{Lines, number, said};

/// A statement, without its keyword and its comment.
pub(crate) enum Statement<'a> {
    /// `v`: the position of a vertex.
    Vertex(Cow<'a, [u8]>),
    /// `vt`: texture coordinates.
    Texture(Cow<'a, [u8]>),
    /// `vn`: a normal.
    Normal(Cow<'a, [u8]>),
    /// `f`, or `fo` as old files have it: the corners of a face.
    Face(Cow<'a, [u8]>),
    /// `l`: the vertices of a polyline.
    Line(Cow<'a, [u8]>),
    /// What the faces that follow have.
    Label(LabelKind, &'a [u8]),
}

/// What a statement may give the faces that follow it.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum LabelKind {
    /// `usemtl`.
    Material,
    /// `g`.
    Group,
    /// `o`.
    Object,
    /// `s`.
    Smoothing,
    /// `mtllib`, which names a file of materials.
    Library,
}

/// The statements of a file, each with the number of its first line, counted from 1.
pub(crate) struct Statements<'a> {
    lines: Lines<'a>,
    /// Whether normals and labels are among them.
    with_attributes: bool,
    /// Whether polylines are among them.
    with_lines: bool,
}

impl<'a> Statements<'a> {
    pub(crate) fn new(bytes: &'a [u8]) -> Self {
        Statements {
            lines: Lines::new(bytes),
            with_attributes: false,
            with_lines: false,
        }
    }

    /// The same with normals and labels, which [`new`](Self::new) passes over.
    pub(super) fn with_attributes(bytes: &'a [u8]) -> Self {
        Statements {
            with_attributes: true,
            ..Statements::new(bytes)
        }
    }

    /// The same with polylines, which [`new`](Self::new) passes over.
    pub(super) fn with_lines(bytes: &'a [u8]) -> Self {
        Statements {
            with_lines: true,
            ..Statements::new(bytes)
        }
    }

    /// What follows the keyword, with the lines that continue it. Only these statements are continued:
    /// in a comment or a name a backslash at the end may be part of a path.
    fn continued(&mut self, first: &'a [u8]) -> Cow<'a, [u8]> {
        let mut text = said(first);
        let mut joined = Vec::new();
        while let Some(start) = text.trim_ascii_end().strip_suffix(b"\\") {
            joined.extend(start);
            joined.push(b' ');
            text = self.lines.next().map_or(&[], |(_, line)| said(line));
        }
        if joined.is_empty() {
            return Cow::Borrowed(text);
        }
        joined.extend(text);
        Cow::Owned(joined)
    }
}

impl<'a> Iterator for Statements<'a> {
    type Item = (usize, Statement<'a>);

    fn next(&mut self) -> Option<Self::Item> {
        loop {
            let (number, line) = self.lines.next()?;
            let line = line.trim_ascii_start();
            let end = line
                .iter()
                .position(|b| b.is_ascii_whitespace() || b"#\\".contains(b));
            let (keyword, rest) = line.split_at(end.unwrap_or(line.len()));
            let statement = match keyword {
                b"v" => Statement::Vertex(self.continued(rest)),
                b"vt" => Statement::Texture(self.continued(rest)),
                b"f" | b"fo" => Statement::Face(self.continued(rest)),
                b"l" if self.with_lines => Statement::Line(self.continued(rest)),
                _ if !self.with_attributes => continue,
                b"vn" => Statement::Normal(self.continued(rest)),
                b"usemtl" => Statement::Label(LabelKind::Material, said(rest)),
                b"g" => Statement::Label(LabelKind::Group, said(rest)),
                b"o" => Statement::Label(LabelKind::Object, said(rest)),
                b"mtllib" => Statement::Label(LabelKind::Library, said(rest)),
                b"s" => Statement::Label(LabelKind::Smoothing, said(rest)),
                _ => continue,
            };
            return Some((number, statement));
        }
    }
}

/// The words of a statement.
pub(super) fn words(said: &[u8]) -> impl Iterator<Item = &[u8]> {
    let words = said.split(u8::is_ascii_whitespace);
    words.filter(|word| !word.is_empty())
}

/// The number, counted from 0, that a word names: it counts from 1 onwards, or backwards from the last of
/// those so far. Nothing is assumed of how many there will be.
pub(crate) fn corner_number(word: &[u8], so_far: i64) -> Option<i64> {
    let given: i64 = number(word)?;
    if given < 0 {
        so_far.checked_add(given)
    } else {
        Some(given - 1)
    }
}
