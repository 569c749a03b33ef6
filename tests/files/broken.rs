//! Broken files: each is refused with its line and the word at fault.

use roundel::Error;
use roundel::problem::mps;

use crate::Scratch;

const GOOD: &str = "\
NAME p
ROWS
 N f
 E c
COLUMNS
 x f 1 c 2
 M 'MARKER' 'INTORG'
 y c 1
 M 'MARKER' 'INTEND'
RHS
 R c 3
BOUNDS
 FR B x
 FR B y
QUADOBJ
 x x 2
 y x 1
ENDATA
";

#[derive(Debug, PartialEq)]
enum Kind {
    Parse,
    Unsupported,
}

use Kind::{Parse, Unsupported};

fn error(text: &str) -> Error {
    mps::parse(text.as_bytes())
        .err()
        .unwrap_or_else(|| panic!("accepted:\n{text}"))
}

fn check(error: &Error, kind: &Kind, line: usize, word: &str) {
    let found = match error {
        Error::Parse { .. } => Parse,
        Error::NotSupported { .. } => Unsupported,
        other => panic!("{other}"),
    };
    assert_eq!(found, *kind, "{error}");
    assert_eq!(error.line(), Some(line), "{error}");
    let text = error.to_string();
    assert!(text.contains(&format!("line {line}")), "{text}");
    assert!(text.contains(word), "'{word}' is not in: {text}");
}

#[test]
fn the_file_from_which_the_broken_ones_are_made_is_good() {
    assert!(mps::parse(GOOD.as_bytes()).is_ok());
}

#[test]
fn each_fault_is_reported_with_its_line_and_word() {
    // The text to replace, its replacement, the kind of error, its line, a word of its message.
    let cases = [
        // Sections.
        ("NAME p\n", "NAME p\nNAME q\n", Parse, 2, "NAME"),
        ("NAME p\n", " stray\n", Parse, 1, "stray"),
        ("NAME p\n", "NAME p\n stray\n", Parse, 2, "stray"),
        ("COLUMNS\n", "COLUMNZ\n", Parse, 5, "COLUMNZ"),
        ("COLUMNS\n", "columns\n", Parse, 5, "columns"),
        ("ROWS\n", "COLUMNS\n", Parse, 2, "before ROWS"),
        ("COLUMNS\n", "BOUNDS\n", Parse, 5, "before COLUMNS"),
        ("BOUNDS\n", "ROWS\n", Parse, 12, "ROWS may not follow RHS"),
        ("RHS\n", "RHS\nRHS\n", Parse, 11, "already open"),
        ("ENDATA\n", "QMATRIX\n", Parse, 18, "QMATRIX"),
        (
            "QUADOBJ\n",
            "QSECTION c\n",
            Unsupported,
            15,
            "quadratic constraint",
        ),
        ("QUADOBJ\n", "QMATRIX d\n", Parse, 15, "no row 'd'"),
        (
            "QUADOBJ\n",
            "QCMATRIX c\n",
            Unsupported,
            15,
            "quadratic constraint",
        ),
        ("QUADOBJ\n", "INDICATORS\n", Unsupported, 15, "INDICATORS"),
        ("RHS\n", "RHS of p\n", Parse, 10, "of"),
        ("RHS\n", "RANGES\n R f 1\nRHS\n", Parse, 11, "type N"),
        ("QUADOBJ\n", "SOS\n", Unsupported, 15, "SOS"),
        ("ENDATA\n", "", Parse, 17, "ENDATA"),
        ("ENDATA\n", "ENDATA\nmore\n", Parse, 19, "more"),
        ("ENDATA\n", "ENDATA\n\n x y 1\n", Parse, 20, "behind ENDATA"),
        // The sense.
        ("ROWS\n", "OBJSENSE MAX\n MAX\nROWS\n", Parse, 3, "MAX"),
        ("ROWS\n", "OBJSENSE\nROWS\n", Parse, 3, "OBJSENSE"),
        ("ROWS\n", "OBJSENSE up\nROWS\n", Parse, 2, "up"),
        ("ROWS\n", "OBJSENSE MIN\n MIN\nROWS\n", Parse, 3, "MIN"),
        // Rows.
        (" E c\n", " Q c\n", Parse, 4, "'Q'"),
        (" E c\n", " E f\n", Parse, 4, "row 'f' is already on line 3"),
        (" E c\n", " E\n", Parse, 4, "'E'"),
        (" E c\n", " E c d\n", Parse, 4, "3 fields"),
        (" N f\n", " E f\n", Parse, 5, "objective"),
        (" E c\n", " E 'MARKER'\n", Parse, 4, "'MARKER\\'"),
        // Columns.
        (" y c 1\n", " y d 1\n", Parse, 8, "no row 'd'"),
        (
            " y c 1\n",
            " x c 1\n",
            Parse,
            8,
            "column 'x' is already on line 6",
        ),
        (" y c 1\n", " y c 1 c 2\n", Parse, 8, "entry in row 'c'"),
        (" y c 1\n", " y c 1\n y c 2\n", Parse, 9, "entry in row 'c'"),
        (" y c 1\n", " y c one\n", Parse, 8, "'one' is not a number"),
        (" y c 1\n", " y c 1D0\n", Parse, 8, "'1D0' is not a number"),
        (" y c 1\n", " y c nan\n", Parse, 8, "'nan' is not a finite"),
        (
            " y c 1\n",
            " y c -1e999\n",
            Parse,
            8,
            "'-1e999' is not a finite",
        ),
        (" y c 1\n", " y c\n", Parse, 8, "2 fields"),
        (" y c 1\n", " y c 1 f\n", Parse, 8, "4 fields"),
        (" y c 1\n", " y c 1 f 1 c 1\n", Parse, 8, "more than 5"),
        (
            " x f 1 c 2\n M 'MARKER' 'INTORG'\n y c 1\n M 'MARKER' 'INTEND'\n",
            "",
            Parse,
            6,
            "COLUMNS",
        ),
        // Markers.
        (
            " y c 1\n",
            " M 'MARKER' 'INTORG'\n y c 1\n",
            Parse,
            8,
            "line 7",
        ),
        (" M 'MARKER' 'INTORG'\n", "", Parse, 8, "'INTEND'"),
        (" M 'MARKER' 'INTEND'\n", "", Parse, 9, "'INTORG' of line 7"),
        (
            " M 'MARKER' 'INTEND'\n",
            " M 'MARKER'\n",
            Parse,
            9,
            "'INTEND'",
        ),
        (
            " M 'MARKER' 'INTEND'\n",
            " M 'MARKER' 'SOSEND'\n",
            Unsupported,
            9,
            "SOSEND",
        ),
        // Right sides.
        (" R c 3\n", " R d 3\n", Parse, 11, "no row 'd'"),
        (" R c 3\n", " R c 3\n R c 4\n", Parse, 12, "'c' already"),
        (" R c 3\n", " R c 3\n S f 4\n", Unsupported, 12, "'S'"),
        (" R c 3\n", " R c inf\n", Parse, 11, "'inf'"),
        (" R c 3\n", " c\n", Parse, 11, "'c'"),
        (" R c 3\n", " R c 1e20\n R f inf\n", Parse, 12, "'inf'"),
        // Ranges.
        (
            "BOUNDS\n",
            "RANGES\n R d 1\nBOUNDS\n",
            Parse,
            13,
            "no row 'd'",
        ),
        (
            "BOUNDS\n",
            "RANGES\n R c 1 c 2\nBOUNDS\n",
            Parse,
            13,
            "row 'c' already has a range",
        ),
        (
            "BOUNDS\n",
            "RANGES\n R c nan\nBOUNDS\n",
            Parse,
            13,
            "'nan' is not a finite",
        ),
        ("BOUNDS\n", "RANGES\n c 1\n S c 1\n", Unsupported, 14, "'S'"),
        // Bounds.
        (
            " FR B y\n",
            " SC B y 4\n",
            Unsupported,
            14,
            "semi-continuous",
        ),
        (" FR B y\n", " SI B y 4\n", Unsupported, 14, "type SI"),
        (" FR B y\n", " XX B y\n", Parse, 14, "'XX'"),
        (" FR B y\n", " FR B z\n", Parse, 14, "no column 'z'"),
        (
            " FR B y\n",
            " FR B x\n",
            Parse,
            14,
            "lower bound, on line 13",
        ),
        (
            " FR B y\n",
            " UP B x 1\n",
            Parse,
            14,
            "upper bound, on line 13",
        ),
        (" FR B y\n", " FR C y\n", Unsupported, 14, "'C'"),
        (" FR B y\n", " FR\n", Parse, 14, "'FR'"),
        (" FR B y\n", " FR B y 0 0\n", Parse, 14, "5 fields"),
        (" FR B y\n", " UP y 4\n", Unsupported, 14, "'' beside 'B'"),
        (" FR B y\n", " UP y\n", Parse, 14, "2 fields"),
        (" FR B y\n", " FX B y 1e20x\n", Parse, 14, "'1e20x'"),
        (" FR B y\n", " FX B y inf\n", Parse, 14, "not a finite"),
        (" FR B y\n", " LO B y 1e20\n", Parse, 14, "no number meets"),
        (" FR B y\n", " UP B y -inf\n", Parse, 14, "no number meets"),
        (
            " FR B y\n",
            " UP B y 2\n LO B y 3\n",
            Parse,
            15,
            "lower bound 3 above the upper bound 2",
        ),
        // Quadratic terms.
        (" y x 1\n", " y z 1\n", Parse, 17, "no column 'z'"),
        (" y x 1\n", " y x 1\n y x 1\n", Parse, 18, "on line 17"),
        (
            " y x 1\n",
            " y x 1\n x y 1\n",
            Parse,
            18,
            "on line 17 (the section is one triangle)",
        ),
        (" y x 1\n", " y x 1 x 1\n", Parse, 17, "on line 17"),
        (" y x 1\n", " y x 1e400\n", Parse, 17, "'1e400'"),
        (" y x 1\n", " y x\n", Parse, 17, "2 fields"),
        ("QUADOBJ\n", "QMATRIX\n", Parse, 17, "not symmetric"),
        (
            "QUADOBJ\n x x 2\n",
            "QMATRIX\n x x 2\n x y 1.5\n",
            Parse,
            17,
            "not symmetric: 1.5 here, 1 mirrored",
        ),
        (
            "QUADOBJ\n",
            "QMATRIX\n x y 1\n y x 1\n",
            Parse,
            19,
            "on line 17",
        ),
        // Bytes.
        (" y c 1\n", " y\u{1} c 1\n", Parse, 8, "0x01"),
        ("NAME p\n", "NAME p\rROWS\r", Parse, 1, "0x0d"),
    ];
    for (old, new, kind, line, word) in cases {
        assert!(GOOD.contains(old), "{old}");
        check(&error(&GOOD.replacen(old, new, 1)), &kind, line, word);
    }
}

#[test]
fn an_empty_file_is_refused() {
    check(&error(""), &Parse, 1, "empty");
    check(&error("\n\n* nothing\n"), &Parse, 3, "empty");
}

#[test]
fn bytes_that_are_not_text_are_refused() {
    let mut bytes = GOOD.as_bytes().to_vec();
    bytes[GOOD.find(" y c 1").unwrap() + 1] = 0xe9;
    let error = mps::parse(bytes.as_slice()).unwrap_err();
    check(&error, &Parse, 8, "UTF-8");
}

#[test]
fn an_image_is_not_a_problem() {
    let image = b"\x89PNG\r\n\x1a\n\0\0\0\rIHDR\0\0\x04\0";
    check(&mps::parse(&image[..]).unwrap_err(), &Parse, 1, "UTF-8");
}

#[test]
fn endless_lines_and_long_names_are_refused() {
    let long = "x".repeat(5000);
    check(
        &error(&GOOD.replace(" E c\n", &format!(" E {long}\n"))),
        &Parse,
        4,
        "too long",
    );
    let endless = std::io::Read::take(std::io::repeat(b'x'), 1 << 40);
    let endless = std::io::BufReader::new(endless);
    check(
        &mps::parse(endless).unwrap_err(),
        &Parse,
        1,
        "longer than 65536",
    );
}

#[test]
fn a_missing_file_is_named() {
    let scratch = Scratch::new("missing-mps");
    let error = mps::read(&scratch.file("none.mps")).unwrap_err();
    assert!(matches!(error, Error::Io { .. }));
    assert!(error.to_string().contains("none.mps"), "{error}");
}

#[cfg(feature = "gzip")]
mod gzip {
    use std::io::Write;

    use super::*;

    fn packed(text: &[u8]) -> Vec<u8> {
        let mut encoder = flate2::write::GzEncoder::new(Vec::new(), Default::default());
        encoder.write_all(text).unwrap();
        encoder.finish().unwrap()
    }

    #[test]
    fn faults_in_a_compressed_file_have_the_lines_of_the_text() {
        let bytes = packed(GOOD.replace(" y c 1\n", " y c one\n").as_bytes());
        check(&mps::parse(bytes.as_slice()).unwrap_err(), &Parse, 8, "one");
    }

    #[test]
    fn an_archive_cut_short_anywhere_is_refused() {
        let scratch = Scratch::new("cut");
        let bytes = packed(GOOD.as_bytes());
        let path = scratch.file("p.mps.gz");
        for len in 2..bytes.len() {
            std::fs::write(&path, &bytes[..len]).unwrap();
            let error = mps::read(&path).unwrap_err();
            assert!(matches!(error, Error::Io { .. }), "{len}: {error}");
            assert!(error.to_string().contains("p.mps.gz"), "{error}");
        }
    }

    #[test]
    fn an_archive_with_a_flipped_bit_in_its_checksum_is_refused() {
        let mut bytes = packed(GOOD.as_bytes());
        let at = bytes.len() - 8;
        bytes[at] ^= 1;
        let error = mps::parse(bytes.as_slice()).unwrap_err();
        assert!(matches!(error, Error::Io { .. }), "{error}");
    }

    #[test]
    fn a_small_archive_of_one_endless_line_is_refused() {
        let bytes = packed(&vec![b'x'; 1 << 24]);
        check(
            &mps::parse(bytes.as_slice()).unwrap_err(),
            &Parse,
            1,
            "longer than",
        );
    }
}

#[cfg(not(feature = "gzip"))]
#[test]
fn a_compressed_file_is_not_supported_without_the_feature() {
    let error = mps::parse(&[0x1f, 0x8b, 8, 0][..]).unwrap_err();
    assert!(
        matches!(error, Error::NotSupported { line: None, .. }),
        "{error}"
    );
}
