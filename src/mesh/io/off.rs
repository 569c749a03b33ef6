//! Geomview's object file format (Geomview manual, section 4.2.5), the ascii variants.
//!
//! No crate reads OFF with its variants and reports lines. The format is the counts, then one line
//! for each vertex, then one line for each face. In COFF, NOFF and STOFF the numbers after a position
//! are ignored, as are colours after a face.

use std::io::Write;

use super::{Drawing, Soup, triangle};
use crate::mesh::MeshError;
use crate::mesh::vector::Vec3;

pub(super) fn parse(bytes: &[u8]) -> Result<Soup, MeshError> {
    let text = String::from_utf8_lossy(bytes);
    let mut lines = Lines {
        lines: text.lines(),
        line: 0,
    };
    let (vertex_count, face_count) = header(&mut lines)?;
    // A count that lies must not be believed before the lines are there.
    let plausible = |count: usize| count.min(bytes.len() / 2);
    let mut vertices = Vec::with_capacity(plausible(vertex_count));
    for vertex in 0..vertex_count {
        let words = lines.next_words(&|| format!("vertex {vertex}"))?;
        vertices.push(position(words).ok_or_else(|| lines.wrong("a vertex needs three numbers"))?);
    }
    let mut triangles = Vec::with_capacity(plausible(face_count));
    let mut corners = Vec::new();
    for face in 0..face_count {
        let mut words = lines.next_words(&|| format!("face {face}"))?;
        let count: Option<usize> = words.next().and_then(|word| word.parse().ok());
        let count = count.ok_or_else(|| lines.wrong("a face starts with its number of corners"))?;
        corners.clear();
        corners.extend(words.map_while(|word| word.parse::<i64>().ok()).take(count));
        if corners.len() < count {
            return Err(lines.wrong("a face needs as many vertex numbers as it has corners"));
        }
        triangles.push(triangle(face, &corners, vertex_count)?);
    }
    Ok((vertices, triangles))
}

pub(super) fn encode(drawing: &Drawing) -> Vec<u8> {
    let (vertices, triangles) = (drawing.vertices, drawing.triangles);
    let mut out = Vec::with_capacity(60 * vertices.len() + 25 * triangles.len());
    let prefix = drawing.vertex_colors.map_or("", |_| "C");
    let _ = writeln!(out, "{prefix}OFF\n{} {} 0", vertices.len(), triangles.len());
    for (v, [x, y, z]) in vertices.iter().enumerate() {
        let _ = write!(out, "{x} {y} {z}");
        if let Some([r, g, b]) = drawing.vertex_colors.map(|colors| colors[v]) {
            let _ = write!(out, " {r} {g} {b} 255");
        }
        out.push(b'\n');
    }
    for (f, [a, b, c]) in triangles.iter().enumerate() {
        let _ = write!(out, "3 {a} {b} {c}");
        if let Some([r, g, b]) = drawing.triangle_colors.map(|colors| colors[f]) {
            let _ = write!(out, " {r} {g} {b}");
        }
        out.push(b'\n');
    }
    out
}

/// The numbers of vertices and faces, which may stand on the keyword's line or the next.
fn header(lines: &mut Lines) -> Result<(usize, usize), MeshError> {
    let mut words = lines.next_words(&|| "the word OFF".to_owned())?.peekable();
    let keyword = words.next().unwrap_or_default();
    let variant = keyword.strip_suffix("OFF");
    if !variant
        .is_some_and(|prefix| ["", "C", "N", "CN", "ST", "STC", "STN", "STCN"].contains(&prefix))
    {
        return Err(lines.wrong("the file does not start with OFF, COFF, NOFF or STOFF"));
    }
    if words.peek() == Some(&"BINARY") {
        return Err(lines.wrong("binary OFF is not read"));
    }
    let on_this_line = words.peek().is_some();
    let mut words: Box<dyn Iterator<Item = &str>> = if on_this_line {
        Box::new(words)
    } else {
        Box::new(lines.next_words(&|| "the numbers of vertices and faces".to_owned())?)
    };
    let mut count = || words.next().and_then(|word| word.parse().ok());
    match (count(), count()) {
        (Some(vertices), Some(faces)) => Ok((vertices, faces)),
        _ => Err(lines.wrong("the numbers of vertices and faces are missing")),
    }
}

fn position<'a>(words: impl Iterator<Item = &'a str>) -> Option<Vec3> {
    let mut numbers = words.map(str::parse::<f64>);
    let mut next = || numbers.next()?.ok();
    Some([next()?, next()?, next()?])
}

/// The lines that say something, counted.
struct Lines<'a> {
    lines: std::str::Lines<'a>,
    line: usize,
}

impl<'a> Lines<'a> {
    fn next_words(
        &mut self,
        expected: &dyn Fn() -> String,
    ) -> Result<std::str::SplitAsciiWhitespace<'a>, MeshError> {
        for line in self.lines.by_ref() {
            self.line += 1;
            let said = line.split('#').next().unwrap_or_default();
            if !said.trim_ascii().is_empty() {
                return Ok(said.split_ascii_whitespace());
            }
        }
        Err(self.wrong(&format!("the file ends before {}", expected())))
    }

    fn wrong(&self, message: &str) -> MeshError {
        MeshError::Parse {
            line: self.line.max(1),
            message: message.to_owned(),
        }
    }
}
