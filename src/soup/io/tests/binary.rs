//! STL, OFF and PLY in binary.

use super::super::Format;
use super::{faces, read, refusal};

pub(super) fn stl(header: &[u8], triangles: u32) -> Vec<u8> {
    let mut bytes = header.to_vec();
    bytes.resize(80, 0);
    bytes.extend(triangles.to_le_bytes());
    for t in 0..triangles {
        for number in 0..12 {
            bytes.extend((number as f32 + 0.5 * t as f32).to_le_bytes());
        }
        bytes.extend([7; 2]);
    }
    bytes
}

#[test]
fn binary_stl_is_told_by_its_length_whatever_its_header_says() {
    let headers: [&[u8]; 6] = [b"", b"solid part", b"ply", b"OFF", b"glTF", &[b' '; 80]];
    for header in headers {
        let soup = read(stl(header, 2), Format::Stl);
        assert_eq!(faces(&soup), [[0, 1, 2], [3, 4, 5]]);
        assert_eq!(soup.positions()[0], [3.0, 4.0, 5.0]);
        assert_eq!(soup.positions()[5], [9.5, 10.5, 11.5]);
    }
    let mut padded = stl(b"solid", 2);
    padded.extend([0; 49]);
    assert_eq!(read(&padded, Format::Stl).polygon_count(), 2);
    padded.push(0);
    assert!(refusal(&padded, Format::Stl).contains("declares 2 triangles, and has 3"));
    let short = &stl(b"solid", 3)[..200];
    assert!(refusal(short, Format::Stl).contains("declares 3 triangles, and has room for 2"));
    let mut lies = stl(b"", 1);
    lies[80..84].fill(255);
    assert!(refusal(&lies, Format::Stl).contains("4294967295"));
    assert!(refusal([], Format::Stl).contains("byte 0"));
    assert_eq!(read(stl(b"", 0), Format::Stl).polygon_count(), 0);
}

pub(super) fn off(keyword: &str, others: usize) -> Vec<u8> {
    let mut bytes = format!("{keyword} BINARY\n").into_bytes();
    let mut integers = |numbers: &[i32]| {
        bytes.extend(numbers.iter().flat_map(|number| number.to_be_bytes()));
    };
    integers(&[3, 2, 0]);
    for position in [[0.0_f32, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]] {
        integers(&position.map(|x| x.to_bits() as i32));
        integers(&vec![9; others]);
    }
    integers(&[3, 0, 1, 2, 0]);
    integers(&[2, -1, 8, 3, 0, 0, 0]);
    bytes
}

#[test]
fn binary_off_is_read_with_colors_and_normals() {
    for (keyword, others) in [("OFF", 0), ("COFF", 4), ("NOFF", 3), ("STCNOFF", 9)] {
        let soup = read(off(keyword, others), Format::Off);
        assert_eq!(faces(&soup), [&[0, 1, 2][..], &[-1, 8]], "{keyword}");
        assert_eq!(soup.positions()[1], [1.0, 0.0, 0.0]);
    }
    let whole = off("OFF", 0);
    assert!(refusal(&whole[..whole.len() - 1], Format::Off).contains("byte"));
    for (place, what) in [(11, "vertices"), (15, "faces"), (59, "corners")] {
        for number in [i32::MAX, -1] {
            let mut lies = whole.clone();
            lies[place..place + 4].copy_from_slice(&number.to_be_bytes());
            let refusal = refusal(&lies, Format::Off);
            assert!(refusal.contains(&format!("{number} {what}")), "{refusal}");
        }
    }
}

/// Four vertices and a face of each kind, in either order of bytes.
pub(super) fn ply(big: bool) -> Vec<u8> {
    let name = if big { "big" } else { "little" };
    let mut bytes = format!(
        "ply\nformat binary_{name}_endian 1.0\nelement vertex 4\nproperty double x\nproperty short y\n\
         property uint8 red\nproperty float z\nelement face 2\nproperty list ushort uint vertex_indices\n\
         property list uchar double texcoord\nelement tristrips 1\n\
         property list int int vertex_indices\nend_header\n"
    )
    .into_bytes();
    let mut add = |raw: &[u8]| {
        if big {
            bytes.extend(raw.iter().rev());
        } else {
            bytes.extend(raw);
        }
    };
    for vertex in 0..4_i16 {
        add(&(0.1 * f64::from(vertex)).to_le_bytes());
        add(&(-vertex).to_le_bytes());
        add(&[255]);
        add(&(0.25 * f32::from(vertex)).to_le_bytes());
    }
    for face in [&[0_u32, 1, 2, 3][..], &[2, 1, 7]] {
        add(&(face.len() as u16).to_le_bytes());
        face.iter().for_each(|corner| add(&corner.to_le_bytes()));
        add(&[1]);
        add(&0.5_f64.to_le_bytes());
    }
    for number in [7_i32, 0, 1, 2, 3, -1, 0, 1] {
        add(&number.to_le_bytes());
    }
    bytes
}

#[test]
fn binary_ply_is_read_in_both_orders_of_bytes() {
    for big in [false, true] {
        let soup = read(ply(big), Format::Ply);
        let expected: [&[i64]; 4] = [&[0, 1, 2, 3], &[2, 1, 7], &[0, 1, 2], &[2, 1, 3]];
        assert_eq!(faces(&soup), expected);
        assert_eq!(soup.positions()[3], [0.1 * 3.0, -3.0, 0.75]);
        let whole = ply(big);
        let refusal = refusal(&whole[..whole.len() - 3], Format::Ply);
        assert!(refusal.contains("has room for 6"), "{refusal}");
    }
}
