//! STL as text: solids of facets, the words in any case.

use super::super::lines::Words;
use crate::soup::{PolygonSoup, SoupError};

pub(super) fn parse(bytes: &[u8]) -> Result<PolygonSoup, SoupError> {
    let mut words = Words::new(bytes);
    let mut soup = PolygonSoup::default();
    while words.has_more() {
        expect(&mut words, "solid")?;
        // Its name, in any words.
        words.end_line();
        while facet(&mut words, &mut soup)? {}
        words.end_line();
    }
    Ok(soup)
}

/// Reads a facet, or else the end of the solid.
fn facet(words: &mut Words, soup: &mut PolygonSoup) -> Result<bool, SoupError> {
    let word = words.word("'facet' or 'endsolid'")?;
    if word.eq_ignore_ascii_case(b"endsolid") {
        return Ok(false);
    }
    if !word.eq_ignore_ascii_case(b"facet") {
        return Err(words.unexpected(word, "'facet' or 'endsolid'"));
    }
    // The normal follows, in any words; 'nan' is among them.
    while !words.word("'outer loop'")?.eq_ignore_ascii_case(b"outer") {}
    expect(words, "loop")?;
    let mut corners = Vec::with_capacity(3);
    loop {
        let word = words.word("'vertex' or 'endloop'")?;
        if word.eq_ignore_ascii_case(b"endloop") {
            break;
        }
        if !word.eq_ignore_ascii_case(b"vertex") {
            return Err(words.unexpected(word, "'vertex' or 'endloop'"));
        }
        let mut position = [0.0; 3];
        for coordinate in &mut position {
            *coordinate = words.number("a coordinate")?;
        }
        corners.push(soup.add_vertex(position) as i64);
    }
    soup.add_polygon(corners);
    expect(words, "endfacet")?;
    Ok(true)
}

fn expect(words: &mut Words, expected: &str) -> Result<(), SoupError> {
    let quoted = format!("'{expected}'");
    let word = words.word(&quoted)?;
    if word.eq_ignore_ascii_case(expected.as_bytes()) {
        Ok(())
    } else {
        Err(words.unexpected(word, &quoted))
    }
}
