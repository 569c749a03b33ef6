//! OBJ files as most programs write them, read by several threads: vertices of three coordinates or with colours,
//! faces whose corners are numbers from 1 on, each on a line of its own. All other files are read by
//! [`obj`](super::obj), which also finds the errors.

use std::borrow::Cow;
use std::ops::Range;

use super::lines::number;
use super::statements::{Statement, Statements, words};
use crate::monitor::in_parts;
use crate::soup::PolygonSoup;

/// The least number of bytes that are worth a thread.
const LEAST: usize = 1 << 16;

/// A number of a vertex has at most so many digits here.
const DIGITS: usize = 9;

/// What some lines of the file say.
#[derive(Default)]
struct Lists {
    positions: Vec<[f64; 3]>,
    corners: Vec<i64>,
    /// Where the corners of each face end.
    ends: Vec<usize>,
}

/// The soup of a file; none of a file that is not as above.
pub(super) fn parse(bytes: &[u8]) -> Option<PolygonSoup> {
    let mut parts = in_parts(bytes.len(), LEAST, |part| lists(lines_from(bytes, part)));
    let mut all = parts.remove(0)?;
    for part in parts {
        let part = part?;
        let before = all.corners.len();
        all.positions.extend(part.positions);
        all.corners.extend(part.corners);
        all.ends.extend(part.ends.iter().map(|end| before + end));
    }
    let is_known = |&v: &i64| 0 <= v && v < all.positions.len() as i64;
    if all.positions.is_empty() || !all.corners.iter().all(is_known) {
        return None;
    }
    let mut starts = all.ends;
    starts.insert(0, 0);
    Some(PolygonSoup::of_lists(all.positions, all.corners, starts))
}

/// The lines that begin in this part of the text, after the end of the line before: what looks like a byte order mark
/// there is none.
fn lines_from(text: &[u8], part: Range<usize>) -> &[u8] {
    let start = |at: usize| match at {
        0 => 0,
        _ => {
            let before = text[at - 1..].iter().position(|&b| b == b'\n');
            before.map_or(text.len(), |k| at - 1 + k)
        }
    };
    &text[start(part.start)..start(part.end)]
}

fn lists(text: &[u8]) -> Option<Lists> {
    let mut all = Lists::default();
    for (_, statement) in Statements::new(text) {
        match statement {
            Statement::Vertex(Cow::Borrowed(said)) => {
                let mut words = words(said);
                let mut next = || number::<f64>(words.next()?);
                all.positions.push([next()?, next()?, next()?]);
                // A fourth number alone is a weight.
                if words.count() == 1 {
                    return None;
                }
            }
            Statement::Face(Cow::Borrowed(said)) => {
                let before = all.corners.len();
                for word in words(said) {
                    all.corners.push(corner(word)?);
                }
                if all.corners.len() < before + 3 {
                    return None;
                }
                all.ends.push(all.corners.len());
            }
            Statement::Texture(Cow::Borrowed(_)) => {}
            // What is continued on the next line may go on in the next part.
            _ => return None,
        }
    }
    Some(all)
}

/// The vertex of a corner `v`, `v/t`, `v//n` or `v/t/n`, counted from 0.
fn corner(word: &[u8]) -> Option<i64> {
    let is_number = |part: &[u8]| {
        let is_short = (1..=DIGITS).contains(&part.len());
        is_short && part.iter().all(u8::is_ascii_digit)
    };
    let mut parts = word.split(|&b| b == b'/');
    let vertex = parts.next().filter(|part| is_number(part))?;
    let fits = match [parts.next(), parts.next(), parts.next()] {
        [None, ..] => true,
        [Some(texture), None, _] => is_number(texture),
        [Some(texture), Some(normal), None] => {
            (texture.is_empty() || is_number(texture)) && is_number(normal)
        }
        _ => false,
    };
    let digit = |sum: i64, &b: &u8| 10 * sum + i64::from(b - b'0');
    fits.then(|| vertex.iter().fold(0, digit) - 1)
}

#[cfg(test)]
mod tests {
    use super::super::obj::parse_by_tobj;
    use super::*;
    use crate::linalg::Random;
    use crate::mesh::shape::by_name;
    use crate::monitor::{spawned, with_threads};

    #[test]
    fn plain_files_are_read_as_by_tobj() {
        let corners = "v 0 0 0\nv 1e0 -0.5 +2\nv 3 .5 1.\n";
        let texts = [
            "f 1 2 3\n",
            "f 1 2 3",
            "# a comment\r\nf 1/7 2/8 3/9 # and one more\r\n",
            "vn 0 0 1\nvt 0 1\n  f\t1/1/1 2//4  3/1/1\ng v\nv 1 2 3 0.1 0.2 0.3\nf 4 3 2 1\n",
            "f 1 2 3\rf 1 3 2\n",
            "s off\nusemtl a\\\nfo 3 2 1\n\n\nv 9 8 7 0.5 0.5\n",
        ];
        for text in texts {
            let text = [corners, text].concat();
            let soup = parse(text.as_bytes());
            assert_eq!(soup, parse_by_tobj(text.as_bytes()).ok(), "{text}");
            assert!(soup.is_some(), "{text}");
        }
    }

    #[test]
    fn other_files_are_left_to_tobj() {
        let corners = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";
        let others = [
            "f 1 2 -1\n",
            "f 1 2 4\n",
            "f 0 1 2\n",
            "f 1 2\n",
            "f 1 2 \\\n3\n",
            "f 1 2 3/\n",
            "f 1/2/3/4 2 3\n",
            "f 1 2 3x\n",
            "f 1 2 12345678901\n",
            "v 1 2\n",
            "v 1 2 3 4\n",
            "v 1 2 x\n",
        ];
        for other in others {
            assert_eq!(parse([corners, other].concat().as_bytes()), None, "{other}");
        }
        assert_eq!(parse(b"f 1 2 3\n"), None);
        assert_eq!(parse(b""), None);
    }

    #[test]
    fn what_is_read_here_is_what_tobj_reads() {
        let pieces = [
            "v 0 0 1\n",
            "v 1 2 3 4\n",
            "v 1 2 3 .1 .2 .3\n",
            "v 1 2 3 a b\n",
            "v nan 1 2\n",
            "v 1 -inf 2\n",
            "v 1e999 0 0\n",
            "v +1 .5 2.\r",
            "v 1 2\n",
            "v ",
            "vt 0 1\n",
            "vt 1\n",
            "vn 0 0 1\n",
            "f 1 2 3\n",
            "f 1 1 1\n",
            "f 3 2 1 1\r\n",
            "f 1/1 2/2 3/1\n",
            "f 1//1 2//1 3//1\n",
            "f 01 +2 3\n",
            "f 1 2 -1\n",
            "f 1 2\n",
            "f 1 2 9\n",
            "f 1 2 3 # \\\n",
            "f 1 2 \\\n",
            "3 3\n",
            "fo 2 1 3\n",
            "f",
            " 1 2 3\n",
            "l 1 2\n",
            "g a\n",
            "o b\n",
            "usemtl c\\\n",
            "# d\n",
            "\n",
            "\\\n",
            "\t",
            "\u{feff}",
            "p 1\n",
        ];
        let mut random = Random::new(7);
        let (mut here, mut elsewhere) = (0, 0);
        for _ in 0..20_000 {
            let mut text = String::from("v 0 0 0\nv 1 0 0\nv 0 1 0\n");
            for _ in 0..1 + random.next() % 6 {
                text += pieces[random.next() as usize % pieces.len()];
            }
            match parse(text.as_bytes()) {
                None => elsewhere += 1,
                Some(soup) => {
                    here += 1;
                    let other = parse_by_tobj(text.as_bytes()).map_err(|error| error.to_string());
                    // Not equal by value where there are NaNs.
                    assert_eq!(
                        format!("{:?}", Ok::<_, String>(soup)),
                        format!("{other:?}"),
                        "{text:?}"
                    );
                }
            }
        }
        assert!(here > 1_000 && elsewhere > 1_000, "{here} {elsewhere}");
    }

    #[test]
    fn any_number_of_threads_reads_the_same() {
        let mesh = by_name("torus", 8_000).unwrap();
        let mut text = String::new();
        for [x, y, z] in mesh.vertices() {
            text += &format!("v {x} {y} {z}\n");
        }
        for [a, b, c] in mesh.triangles() {
            text += &format!("f {} {} {}\n", a + 1, b + 1, c + 1);
        }
        // Words that are no keyword, wherever a part begins.
        text += &"\u{feff}v 7 7 7\r\n".repeat(50_000);
        let one = with_threads(1, || parse(text.as_bytes()));
        assert_eq!(one, parse_by_tobj(text.as_bytes()).ok());
        let started = spawned(|| {
            for threads in [2, 3, 5] {
                assert_eq!(with_threads(threads, || parse(text.as_bytes())), one);
            }
        });
        assert!(started >= 5, "{started}");
    }
}
