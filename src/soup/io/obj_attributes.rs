//! The attributes of the faces, corners and vertices of an OBJ file.

use std::collections::HashMap;

use super::attributes::{Attribute, Attributes, Color, Labels, NO_LABEL, Values, labels_of};
use super::lines::{Lines, number};
use super::statements::{LabelKind, Statement, Statements, corner_number, words};
use crate::soup::SoupError;

/// Whether a line names a material, a group, an object or a texture, or the first vertex has a colour.
pub(super) fn are_in(bytes: &[u8]) -> bool {
    let mut before_vertices = true;
    Lines::new(bytes).any(|(_, line)| {
        let line = line.trim_ascii_start();
        let is_first = line.starts_with(b"v ") && std::mem::take(&mut before_vertices);
        is_first && color(line[2..].trim_ascii_end()).is_some()
            || [&b"vt"[..], b"usemtl", b"g ", b"o "]
                .iter()
                .any(|keyword| line.starts_with(keyword))
    })
}

/// The colour after the three coordinates of a vertex.
fn color(said: &[u8]) -> Option<Color> {
    let mut channels = words(said).skip(3).map(number::<f64>);
    let mut next = || channels.next().flatten();
    Some([next()?, next()?, next()?, 1.0])
}

pub(super) fn parse(bytes: &[u8]) -> Result<Attributes, SoupError> {
    let mut materials = Named::default();
    let mut groups = Named::default();
    let mut smoothing = Named::default();
    let (mut object, mut group): (&[u8], &[u8]) = (b"", b"");
    let mut textures = OfCorners::new("texture coordinates");
    let mut normals = OfCorners::new("normal");
    let mut libraries = Vec::new();
    let mut colors = Vec::new();
    let mut is_colored = false;
    for (line, statement) in Statements::with_attributes(bytes) {
        match statement {
            Statement::Vertex(said) => {
                let color = color(&said);
                is_colored |= color.is_some();
                colors.push(color.unwrap_or([f64::NAN; 4]));
            }
            Statement::Label(LabelKind::Library, name) => libraries.push(text(name)),
            Statement::Texture(said) => textures.add(line, &said, 2)?,
            Statement::Normal(said) => normals.add(line, &said, 3)?,
            Statement::Label(LabelKind::Material, name) => materials.set(vec![name]),
            Statement::Label(LabelKind::Smoothing, name) => match name.trim_ascii() {
                b"off" => smoothing.set(vec![b"0"]),
                number => smoothing.set(vec![number]),
            },
            Statement::Label(LabelKind::Group, name) => {
                group = name.trim_ascii();
                groups.set(vec![object, group]);
            }
            Statement::Label(LabelKind::Object, name) => {
                object = name.trim_ascii();
                groups.set(vec![object, group]);
            }
            // Not asked for.
            Statement::Line(_) => {}
            Statement::Face(said) => {
                materials.add_face();
                groups.add_face();
                smoothing.add_face();
                for word in words(&said) {
                    let mut parts = word.split(|&b| b == b'/').skip(1);
                    textures.add_corner(line, parts.next())?;
                    normals.add_corner(line, parts.next())?;
                }
            }
        }
    }
    let textures = textures.labels()?;
    let values = Values {
        libraries,
        materials: materials.names(),
        groups: groups.names(),
        textures: textures.1,
        vertex_colors: is_colored.then_some(colors),
        ..Values::default()
    };
    Ok(Attributes::of(values)
        .with(Attribute::Materials, materials.labels())
        .with(Attribute::Groups, groups.labels())
        .with(Attribute::Smoothing, smoothing.labels())
        .with(Attribute::Seams, textures.0)
        .with(Attribute::Normals, normals.labels()?.0))
}

/// The labels of faces by names that hold until the next one.
#[derive(Default)]
struct Named<'a> {
    numbers: HashMap<Vec<&'a [u8]>, u32>,
    current: Option<u32>,
    faces: Labels,
}

impl<'a> Named<'a> {
    fn set(&mut self, name: Vec<&'a [u8]>) {
        let name = name.into_iter().map(<[u8]>::trim_ascii).collect();
        let next = self.numbers.len() as u32;
        self.current = Some(*self.numbers.entry(name).or_insert(next));
    }

    fn add_face(&mut self) {
        self.faces.push(self.current.unwrap_or(NO_LABEL));
    }

    /// The names by their numbers, each of several words with spaces between them.
    fn names(&self) -> Vec<String> {
        let mut names = vec![String::new(); self.numbers.len()];
        for (words, &number) in &self.numbers {
            let words = words.iter().filter(|word| !word.is_empty());
            let words: Vec<_> = words.map(|word| text(word)).collect();
            names[number as usize] = words.join(" ");
        }
        names
    }

    /// None if no face has a name.
    fn labels(self) -> Option<Labels> {
        let is_named = self.faces.iter().any(|&label| label != NO_LABEL);
        is_named.then_some(self.faces)
    }
}

/// The values that corners name by number.
struct OfCorners {
    what: &'static str,
    values: Vec<[f64; 3]>,
    /// For each corner the number of its value, counted from 0.
    corners: Vec<Option<usize>>,
    /// The first line that names the highest value so far, and its number.
    highest: Option<(usize, usize)>,
}

impl OfCorners {
    fn new(what: &'static str) -> Self {
        OfCorners {
            what,
            values: Vec::new(),
            corners: Vec::new(),
            highest: None,
        }
    }

    /// Adds a value. Texture coordinates may lack the second number, and a third one is passed over.
    fn add(&mut self, line: usize, said: &[u8], size: usize) -> Result<(), SoupError> {
        let mut value = [0.0; 3];
        let mut count = 0;
        for (x, word) in value[..size].iter_mut().zip(words(said)) {
            *x = number(word).ok_or_else(|| self.wrong(line, "not a number in a"))?;
            count += 1;
        }
        if count == 0 || (size == 3 && count < 3) {
            return Err(self.wrong(line, "too few numbers for a"));
        }
        self.values.push(value);
        Ok(())
    }

    fn add_corner(&mut self, line: usize, word: Option<&[u8]>) -> Result<(), SoupError> {
        let word = word.filter(|word| !word.is_empty());
        let value = match word {
            None => None,
            Some(word) => {
                let number = corner_number(word, self.values.len() as i64);
                let number = number.and_then(|number| usize::try_from(number).ok());
                Some(number.ok_or_else(|| self.wrong(line, "a corner names no"))?)
            }
        };
        if let Some(value) = value
            && self.highest.is_none_or(|(highest, _)| value > highest)
        {
            self.highest = Some((value, line));
        }
        self.corners.push(value);
        Ok(())
    }

    /// The labels of the corners, none if no corner has a value; and the first two numbers of each value by its
    /// label. Values may follow the corners that name them.
    fn labels(self) -> Result<(Option<Labels>, Vec<[f64; 2]>), SoupError> {
        let Some((highest, line)) = self.highest else {
            return Ok((None, Vec::new()));
        };
        if highest >= self.values.len() {
            return Err(self.wrong(line, "a corner names no"));
        }
        let of_values = labels_of(&self.values);
        let label = |value: &Option<usize>| value.map_or(NO_LABEL, |value| of_values[value]);
        let labels = self.corners.iter().map(label).collect();
        let values = self.values.iter().map(|&[u, v, _]| [u, v]).collect();
        Ok((Some(labels), values))
    }

    fn wrong(&self, line: usize, how: &str) -> SoupError {
        SoupError::Parse {
            line,
            message: format!("{how} {}", self.what),
        }
    }
}

fn text(name: &[u8]) -> String {
    String::from_utf8_lossy(name.trim_ascii()).into_owned()
}
