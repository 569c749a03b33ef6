//! Wavefront OBJ, parsed by `tobj`.
//!
//! `tobj` serves renderers: it numbers vertices anew in the order of their first use, drops unused
//! ones, starts over at every group, and reports errors without a line. Here elements keep the file's
//! numbers. The feeder therefore hands `tobj` one polyline through all vertices, which makes it number
//! them as in the file, and then the `v` and `f` lines alone. It also remembers the line that it
//! handed out last, for errors.

use std::io::{BufRead, Cursor, Read, Write};

use tobj::{LoadError, LoadOptions};

use super::{Drawing, Soup, triangle};
use crate::mesh::MeshError;

pub(super) fn parse(bytes: &[u8]) -> Result<Soup, MeshError> {
    let vertices = bytes
        .split(|&b| b == b'\n')
        .filter(|line| keyword(line) == b"v")
        .count();
    if vertices == 0 {
        return Err(MeshError::NoFaces);
    }
    let options = LoadOptions {
        single_index: false,
        ..LoadOptions::default()
    };
    let mut feeder = Feeder::new(bytes);
    let mut source = Cursor::new(polyline(vertices)).chain(&mut feeder);
    let loaded = tobj::load_obj_buf(&mut source, &options, |_| Ok(Default::default()));
    let (models, _) = loaded.map_err(|error| explain(&error, bytes, feeder.line, vertices))?;
    let mesh = &models.first().ok_or(MeshError::NoFaces)?.mesh;
    let positions = mesh.positions.as_chunks().0.to_vec();
    let mut indices = &mesh.indices[vertices..];
    let Some((_, arities)) = mesh.face_arities.split_first() else {
        // No arities: everything has three corners, the polyline through three vertices too.
        return Ok((positions, indices.as_chunks().0.to_vec()));
    };
    let mut triangles = Vec::with_capacity(arities.len());
    for (face, &corners) in arities.iter().enumerate() {
        let (these, rest) = indices.split_at(corners as usize);
        let these = these.iter().map(|&v| i64::from(v)).collect::<Vec<_>>();
        triangles.push(triangle(face, &these, vertices)?);
        indices = rest;
    }
    Ok((positions, triangles))
}

pub(super) fn encode(drawing: &Drawing) -> Vec<u8> {
    let mut out = Vec::with_capacity(60 * drawing.vertices.len() + 25 * drawing.triangles.len());
    for (v, [x, y, z]) in drawing.vertices.iter().enumerate() {
        let _ = write!(out, "v {x} {y} {z}");
        if let Some(colors) = drawing.vertex_colors {
            for channel in colors[v] {
                let _ = write!(out, " {:.4}", f64::from(channel) / 255.0);
            }
        }
        out.push(b'\n');
    }
    for [a, b, c] in drawing
        .triangles
        .iter()
        .map(|t| t.map(|v| u64::from(v) + 1))
    {
        let _ = writeln!(out, "f {a} {b} {c}");
    }
    out
}

pub(super) fn keyword(line: &[u8]) -> &[u8] {
    let line = line.trim_ascii_start();
    let end = line.iter().position(u8::is_ascii_whitespace);
    &line[..end.unwrap_or(line.len())]
}

/// `l 1 2 3 ...`
fn polyline(vertices: usize) -> Vec<u8> {
    let mut line = Vec::with_capacity(7 * vertices + 2);
    line.push(b'l');
    for v in 1..=vertices {
        let _ = write!(line, " {v}");
    }
    line.push(b'\n');
    line
}

/// Hands out the lines that matter, one at a time.
struct Feeder<'a> {
    rest: &'a [u8],
    /// What is left of the line being handed out, and what follows it.
    current: &'a [u8],
    ending: &'a [u8],
    /// The line last handed out, counted from 1.
    line: usize,
}

impl<'a> Feeder<'a> {
    fn new(bytes: &'a [u8]) -> Self {
        Feeder {
            rest: bytes,
            current: &[],
            ending: &[],
            line: 0,
        }
    }

    fn advance(&mut self) {
        while self.current.is_empty() && !self.rest.is_empty() {
            let end = self.rest.iter().position(|&b| b == b'\n');
            let (line, rest) = self.rest.split_at(end.unwrap_or(self.rest.len()));
            self.rest = rest.get(1..).unwrap_or_default();
            self.line += 1;
            match keyword(line) {
                b"v" => self.current = without_color(line),
                b"f" => self.current = line,
                _ => continue,
            }
            self.ending = b"\n";
        }
    }
}

impl Read for Feeder<'_> {
    fn read(&mut self, buffer: &mut [u8]) -> std::io::Result<usize> {
        let count = self.fill_buf()?.read(buffer)?;
        self.consume(count);
        Ok(count)
    }
}

impl BufRead for Feeder<'_> {
    fn fill_buf(&mut self) -> std::io::Result<&[u8]> {
        if self.current.is_empty() {
            self.current = std::mem::take(&mut self.ending);
            self.advance();
        }
        Ok(self.current)
    }

    fn consume(&mut self, count: usize) {
        self.current = &self.current[count..];
    }
}

/// A vertex line without the colour that some programs add. A weight (one number more) stays.
///
/// `tobj` refuses files where only some vertices have a colour.
fn without_color(line: &[u8]) -> &[u8] {
    let mut words = line
        .split(u8::is_ascii_whitespace)
        .filter(|word| !word.is_empty());
    let third = words.nth(3);
    match (third, words.nth(1)) {
        (Some(third), Some(_)) => {
            let end = third.as_ptr_range().end as usize - line.as_ptr() as usize;
            &line[..end]
        }
        _ => line,
    }
}

/// The error of `tobj` with what it leaves out: the line, or the face and the vertex.
fn explain(error: &LoadError, bytes: &[u8], line: usize, vertices: usize) -> MeshError {
    if matches!(error, LoadError::FaceVertexOutOfBounds)
        && let Some(found) = out_of_range(bytes, vertices)
    {
        return found;
    }
    let message = match error {
        LoadError::PositionParseError => "a vertex needs three numbers",
        LoadError::ScalingByZeroError => "the weight of a vertex is zero",
        LoadError::FaceParseError => "a corner must be a vertex number, or numbers separated by /",
        _ => "the line is not readable text",
    };
    MeshError::Parse {
        line,
        message: message.to_owned(),
    }
}

fn out_of_range(bytes: &[u8], vertices: usize) -> Option<MeshError> {
    let (mut seen, mut face) = (0, 0);
    for line in bytes.split(|&b| b == b'\n') {
        match keyword(line) {
            b"v" => seen += 1,
            b"f" => {
                let line = std::str::from_utf8(line).ok()?;
                for corner in line.split_ascii_whitespace().skip(1) {
                    let number: i64 = corner.split('/').next()?.parse().ok()?;
                    let vertex = if number < 0 {
                        seen + number
                    } else {
                        number - 1
                    };
                    if vertex < 0 || vertex >= vertices as i64 {
                        return Some(MeshError::IndexOutOfRange {
                            face,
                            vertex,
                            vertices,
                        });
                    }
                }
                face += 1;
            }
            _ => {}
        }
    }
    None
}
