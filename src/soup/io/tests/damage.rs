//! Damaged files: each byte changed, each length, always a soup or an error.

use super::super::{Format, parse};
use super::binary::{off, ply, stl};
use super::gltf::{glb, text};

fn samples() -> Vec<(Vec<u8>, Format)> {
    vec![
        (
            b"# c\nv 0 0 0\nv 1 0 0 1 \\\n0 0\nv 0 1\nvt 0 0\nf 1/1 2/1 3/1\nf -1 -2 -3 9\n"
                .to_vec(),
            Format::Obj,
        ),
        (
            b"4nOFF 3\n3 1 0\n0 0 0 1\n1 0 0 1\n0 1 0 1\n3 0 1 2 9\n".to_vec(),
            Format::Off,
        ),
        (off("COFF", 4), Format::Off),
        (ply(false), Format::Ply),
        (ply(true), Format::Ply),
        (
            b"ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nproperty int y\n\
              property double z\nelement tristrips 1\nproperty list int int vertex_index\n\
              end_header\n0 0 0\n5 0 0 -1 2 1\n"
                .to_vec(),
            Format::Ply,
        ),
        (stl(b"solid", 2), Format::Stl),
        (
            b"solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\n\
              endloop\nendfacet\nendsolid\n"
                .to_vec(),
            Format::Stl,
        ),
        (text().into_bytes(), Format::Gltf),
        (glb(), Format::Glb),
    ]
}

fn check(bytes: &[u8], format: Format) {
    match parse(bytes, format) {
        // A soup stands on what the file holds, not on what it declares.
        Ok(soup) => {
            let corners: usize = soup.polygons().map(<[i64]>::len).sum();
            assert!(soup.positions().len() + soup.polygon_count() + corners <= 4 * bytes.len());
        }
        Err(error) => assert!(!error.to_string().is_empty()),
    }
}

#[test]
fn a_changed_byte_gives_a_soup_or_an_error() {
    for (bytes, format) in samples() {
        check(&bytes, format);
        for place in 0..bytes.len() {
            for value in [
                0,
                1,
                255,
                b'0',
                b'9',
                b' ',
                b'-',
                b'\n',
                bytes[place] ^ 0x80,
            ] {
                let mut changed = bytes.clone();
                changed[place] = value;
                check(&changed, format);
            }
        }
    }
}

#[test]
fn a_file_of_any_length_gives_a_soup_or_an_error() {
    for (bytes, format) in samples() {
        for length in 0..bytes.len() {
            check(&bytes[..length], format);
        }
    }
}

#[test]
fn a_file_of_another_format_gives_a_soup_or_an_error() {
    for (bytes, _) in samples() {
        for format in Format::ALL {
            check(&bytes, format);
        }
    }
}
