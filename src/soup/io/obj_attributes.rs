//! The attributes of the faces of an OBJ file and of their corners.

use std::collections::HashMap;

use super::attributes::{Attribute, Attributes, Labels, NO_LABEL, labels_of};
use super::lines::number;
use super::statements::{LabelKind, Statement, Statements, corner_number, words};
use crate::soup::SoupError;

pub(super) fn parse(bytes: &[u8]) -> Result<Attributes, SoupError> {
    let mut materials = Named::default();
    let mut groups = Named::default();
    let mut smoothing = Named::default();
    let (mut object, mut group): (&[u8], &[u8]) = (b"", b"");
    let mut textures = OfCorners::new("texture coordinates");
    let mut normals = OfCorners::new("normal");
    for (line, statement) in Statements::with_attributes(bytes) {
        match statement {
            Statement::Vertex(_) => {}
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
    Ok(Attributes::default()
        .with(Attribute::Materials, materials.labels())
        .with(Attribute::Groups, groups.labels())
        .with(Attribute::Smoothing, smoothing.labels())
        .with(Attribute::Seams, textures.labels()?)
        .with(Attribute::Normals, normals.labels()?))
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

    /// None if no corner has a value. Values may follow the corners that name them.
    fn labels(self) -> Result<Option<Labels>, SoupError> {
        let Some((highest, line)) = self.highest else {
            return Ok(None);
        };
        if highest >= self.values.len() {
            return Err(self.wrong(line, "a corner names no"));
        }
        let of_values = labels_of(&self.values);
        let label = |value: &Option<usize>| value.map_or(NO_LABEL, |value| of_values[value]);
        Ok(Some(self.corners.iter().map(label).collect()))
    }

    fn wrong(&self, line: usize, how: &str) -> SoupError {
        SoupError::Parse {
            line,
            message: format!("{how} {}", self.what),
        }
    }
}
