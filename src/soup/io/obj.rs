//! Wavefront OBJ (appendix B of the Advanced Visualizer manual): plain files by [`plain_obj`], all others by
//! `tobj`.
//!
//! `tobj` serves renderers: it numbers vertices anew in the order of their first use, drops unused
//! ones, starts over at every group, joins no continued lines, ends lines at LF only, wants three
//! coordinates, and refuses colours that only some vertices have, comments after numbers, text that is
//! not UTF-8, and files where one corner names no vertex. Here elements keep the file's numbers. The
//! feeder therefore hands `tobj` one polyline through all vertices, which makes it number them as in the
//! file, and then the statements `v` and `f` alone, in the form that it reads. It also remembers the
//! line that it handed out last, for errors. Where a corner names no vertex, the faces are read by
//! [`statements`] instead.

use std::io::{BufRead, Cursor, Read, Write};

use tobj::{LoadError, LoadOptions, Mesh};

use super::plain_obj;
use super::statements::{Statement, Statements, corner_number, words};
use crate::soup::{PolygonSoup, SoupError};

pub(super) fn parse(bytes: &[u8]) -> Result<PolygonSoup, SoupError> {
    match plain_obj::parse(bytes) {
        Some(soup) => Ok(soup),
        None => parse_by_tobj(bytes),
    }
}

pub(super) fn parse_by_tobj(bytes: &[u8]) -> Result<PolygonSoup, SoupError> {
    let is_vertex = |read: &(usize, Statement)| matches!(read.1, Statement::Vertex(_));
    let vertices = Statements::new(bytes).filter(is_vertex).count();
    if vertices == 0 {
        return faces(bytes, PolygonSoup::default());
    }
    let mut feeder = Feeder::new(bytes, true);
    match load(vertices, &mut feeder) {
        Ok(mesh) => Ok(of_mesh(&mesh, vertices)),
        Err(LoadError::FaceVertexOutOfBounds) => {
            let mut feeder = Feeder::new(bytes, false);
            let mesh = load(vertices, &mut feeder).map_err(|error| explain(&error, feeder.line))?;
            faces(bytes, PolygonSoup::new(positions(&mesh)))
        }
        Err(error) => Err(explain(&error, feeder.line)),
    }
}

fn load(vertices: usize, feeder: &mut Feeder) -> Result<Mesh, LoadError> {
    let options = LoadOptions {
        single_index: false,
        ..LoadOptions::default()
    };
    let mut source = Cursor::new(polyline(vertices)).chain(feeder);
    let (models, _) = tobj::load_obj_buf(&mut source, &options, |_| Ok(Default::default()))?;
    let first = models.into_iter().next();
    Ok(first.map_or_else(Mesh::default, |model| model.mesh))
}

fn positions(mesh: &Mesh) -> Vec<[f64; 3]> {
    mesh.positions.as_chunks().0.to_vec()
}

fn of_mesh(mesh: &Mesh, vertices: usize) -> PolygonSoup {
    let mut soup = PolygonSoup::new(positions(mesh));
    let mut corners = mesh.indices[vertices..].iter().map(|&v| i64::from(v));
    // No arities: everything has three corners, the polyline through three vertices too.
    let alike = vec![3; (mesh.indices.len() - vertices) / 3];
    let arities = mesh.face_arities.get(1..).unwrap_or(&alike);
    for &count in arities {
        soup.add_polygon(corners.by_ref().take(count as usize));
    }
    soup
}

/// The faces of a file whose vertices are in the soup already.
fn faces(bytes: &[u8], mut soup: PolygonSoup) -> Result<PolygonSoup, SoupError> {
    let mut vertices = 0;
    let mut corners = Vec::new();
    for (line, statement) in Statements::new(bytes) {
        match statement {
            Statement::Vertex(_) => vertices += 1,
            Statement::Face(said) => {
                corners.clear();
                for word in words(&said) {
                    let first = word.split(|&b| b == b'/').next();
                    let corner = first.and_then(|number| corner_number(number, vertices));
                    corners.push(corner.ok_or_else(|| wrong_corner(line))?);
                }
                soup.add_polygon(corners.iter().copied());
            }
            _ => {}
        }
    }
    Ok(soup)
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

/// Hands out the statements that matter, one at a time.
struct Feeder<'a> {
    statements: Statements<'a>,
    faces: bool,
    /// The line being handed out, and how much of it is gone.
    current: Vec<u8>,
    gone: usize,
    /// The number of that line, counted from 1.
    line: usize,
}

impl<'a> Feeder<'a> {
    fn new(bytes: &'a [u8], faces: bool) -> Self {
        Feeder {
            statements: Statements::new(bytes),
            faces,
            current: Vec::new(),
            gone: 0,
            line: 0,
        }
    }

    fn advance(&mut self) {
        self.gone = 0;
        self.current.clear();
        while self.current.is_empty()
            && let Some((line, statement)) = self.statements.next()
        {
            match statement {
                Statement::Vertex(words) => feed_vertex(&words, &mut self.current),
                Statement::Face(words) if self.faces => {
                    self.current.extend(b"f ");
                    self.current.extend(&*words);
                }
                _ => continue,
            }
            self.current.push(b'\n');
            self.line = line;
        }
    }
}

/// A vertex of two coordinates lies in the plane z = 0. A fourth number is a weight. With more, three
/// are the position, and the others are the colour that some programs add.
fn feed_vertex(said: &[u8], out: &mut Vec<u8>) {
    let words: Vec<_> = words(said).take(5).collect();
    let said = match words.len() {
        5.. => &words[..3],
        _ => &words[..],
    };
    out.push(b'v');
    for word in said {
        out.push(b' ');
        out.extend(*word);
    }
    if said.len() == 2 {
        out.extend(b" 0");
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
        if self.gone == self.current.len() {
            self.advance();
        }
        Ok(&self.current[self.gone..])
    }

    fn consume(&mut self, count: usize) {
        self.gone += count;
    }
}

/// The error of `tobj` with the line, which it leaves out.
fn explain(error: &LoadError, line: usize) -> SoupError {
    let message = match error {
        LoadError::PositionParseError => "a vertex needs two or three numbers",
        LoadError::ScalingByZeroError => "the weight of a vertex is zero",
        LoadError::FaceParseError => return wrong_corner(line),
        _ => "the line is not readable text",
    };
    SoupError::Parse {
        line,
        message: message.to_owned(),
    }
}

fn wrong_corner(line: usize) -> SoupError {
    SoupError::Parse {
        line,
        message: "a corner must be a vertex number, or numbers separated by /".to_owned(),
    }
}
