//! Geomview's object file format (Geomview manual, sections 4.1 and 4.2.5).
//!
//! No crate reads OFF with its variants and reports lines. The file is a keyword, the counts, the
//! vertices and the faces. Letters before `OFF` say what a vertex has beyond its position: `ST` texture
//! coordinates, `C` a colour, `N` a normal; `4` adds a weight to the position, and `n` says that the
//! number of coordinates stands before the counts. The keyword may be missing. The manual lets elements
//! break lines anywhere; here each starts on a line of its own, so that colours may follow a position or a
//! face in numbers other than declared, as they do in many files.

use super::lines::{Words, number};
use super::off_binary;
use crate::linalg::vector::Vec3;
use crate::soup::{PolygonSoup, SoupError};

/// What the keyword says of a vertex.
pub(super) struct Keyword {
    /// Numbers of its position, the weight excluded.
    dimension: usize,
    weight: bool,
    /// Numbers after its position.
    others: usize,
    named_dimension: bool,
}

pub(super) fn parse(bytes: &[u8]) -> Result<PolygonSoup, SoupError> {
    let mut words = Words::new(bytes);
    words.next_line("the word OFF")?;
    let first = words.clone().on_this_line().unwrap_or_default();
    let mut keyword = match Keyword::at_start_of(first) {
        Some((keyword, length)) => {
            // The first count may stand next to it without a space.
            words.take_here(length);
            keyword
        }
        // The first of the counts.
        None if number::<i64>(first).is_some() => Keyword::plain(),
        None => return Err(words.wrong("the file does not start with OFF, COFF, NOFF or STOFF")),
    };
    if words.clone().on_this_line() == Some(b"BINARY") {
        return off_binary::parse(bytes, keyword);
    }
    if keyword.names_dimension() {
        let given = words.number::<i64>("the number of coordinates of a vertex")?;
        keyword.set_dimension(given)?;
    }
    let vertices = words.number::<usize>("the number of vertices")?;
    let faces = words.number::<usize>("the number of faces")?;
    let mut soup = PolygonSoup::default();
    for vertex in 0..vertices {
        let line = words.next_line("a vertex");
        line.map_err(|_| words.wrong(&format!("the file ends before vertex {vertex}")))?;
        soup.add_vertex(position(&mut words, &keyword)?);
    }
    let mut corners = Vec::new();
    for face in 0..faces {
        let line = words.next_line("a face");
        line.map_err(|_| words.wrong(&format!("the file ends before face {face}")))?;
        corners.clear();
        for _ in 0..words.number::<usize>("the number of corners of a face")? {
            corners.push(words.number::<i64>("the vertex number of a corner")?);
        }
        soup.add_polygon(corners.iter().copied());
    }
    Ok(soup)
}

impl Keyword {
    fn plain() -> Keyword {
        Keyword {
            dimension: 3,
            weight: false,
            others: 0,
            named_dimension: false,
        }
    }

    /// `[ST][C][N][4][n]OFF`, and its length.
    fn at_start_of(word: &[u8]) -> Option<(Keyword, usize)> {
        let place = word
            .windows(3)
            .position(|letters| letters.eq_ignore_ascii_case(b"OFF"))?;
        let (mut prefix, ending) = word.split_at(place);
        if !ending[3..].iter().all(u8::is_ascii_digit) {
            return None;
        }
        let mut has = |letters: &[u8]| {
            let rest = prefix.strip_prefix(letters);
            prefix = rest.unwrap_or(prefix);
            rest.is_some()
        };
        let others = [(&b"ST"[..], 2), (b"C", 4), (b"N", 3)]
            .map(|(letters, numbers)| if has(letters) { numbers } else { 0 });
        let keyword = Keyword {
            others: others.iter().sum(),
            weight: has(b"4"),
            named_dimension: has(b"n"),
            ..Keyword::plain()
        };
        prefix.is_empty().then_some((keyword, place + 3))
    }

    /// Numbers of a position, the weight included.
    pub(super) fn position_numbers(&self) -> usize {
        self.dimension + usize::from(self.weight)
    }

    /// Numbers that follow the position.
    pub(super) fn other_numbers(&self) -> usize {
        self.others
    }

    pub(super) fn names_dimension(&self) -> bool {
        self.named_dimension
    }

    pub(super) fn set_dimension(&mut self, dimension: i64) -> Result<(), SoupError> {
        if !(2..=3).contains(&dimension) {
            return Err(SoupError::Malformed {
                message: format!("vertices of {dimension} coordinates form no surface in space"),
            });
        }
        self.dimension = dimension as usize;
        Ok(())
    }

    /// The position that these numbers give: in the plane z = 0 where there are two. `None` for a weight
    /// of zero.
    pub(super) fn position(&self, numbers: &[f64]) -> Option<Vec3> {
        let mut position = [0.0; 3];
        position[..self.dimension].copy_from_slice(&numbers[..self.dimension]);
        if self.weight {
            let weight = numbers[self.dimension];
            if weight == 0.0 {
                return None;
            }
            position = position.map(|x| x / weight);
        }
        Some(position)
    }
}

fn position(words: &mut Words, keyword: &Keyword) -> Result<Vec3, SoupError> {
    let mut numbers = [0.0; 4];
    for number in &mut numbers[..keyword.position_numbers()] {
        *number = words.number("the coordinate of a vertex")?;
    }
    let position = keyword.position(&numbers);
    position.ok_or_else(|| words.wrong("the weight of a vertex is zero"))
}
