//! Names of files, compression, and contents that are not what the name says.

use std::path::Path;

use super::super::{Format, parse, parse_in, read, read_as};
use super::binary::stl;
use super::refusal;
use crate::soup::SoupError;

const OFF: &str = "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n";

#[test]
fn formats_are_told_by_extension_in_any_case() {
    for format in Format::ALL {
        let name = format.name();
        for name in [
            format!("a.{name}"),
            format!("a.b.{}", name.to_uppercase()),
            format!("dir.x/a.{name}.gz"),
            format!("a.{name}.GZ"),
        ] {
            assert_eq!(Format::of(Path::new(&name)), Ok(format), "{name}");
        }
        assert_eq!(Format::by_name(name), Ok(format));
    }
    for (name, extension) in [
        ("a", ""),
        ("obj", ""),
        ("a.3mf", "3mf"),
        ("a.gz", ""),
        ("a.obj.xz", "xz"),
    ] {
        let unknown = SoupError::UnknownFormat {
            extension: extension.into(),
            known: Format::READ,
        };
        assert_eq!(Format::of(Path::new(name)), Err(unknown), "{name}");
    }
    let read_formats = Format::ALL.iter().filter(|&&format| format != Format::Usda);
    for format in read_formats {
        assert!(Format::READ.contains(format.name()) && Format::WRITTEN.contains(format.name()));
    }
    assert!(matches!(
        parse(b"", Format::Usda),
        Err(SoupError::UnknownFormat { .. })
    ));
}

#[test]
fn contents_of_another_format_are_told_and_not_read() {
    let contents: [(&[u8], &str, &[Format]); 7] = [
        (b"glTF\x02\0\0\0", "glTF", &[Format::Gltf, Format::Glb]),
        (b" {\"asset\": 1}", "glTF", &[Format::Gltf, Format::Glb]),
        (b"ply\nformat ascii 1.0\n", "PLY", &[Format::Ply]),
        (OFF.as_bytes(), "OFF", &[Format::Off]),
        (b"solid a\nendsolid a\n", "STL", &[Format::Stl]),
        (b"PK\x03\x04", "zip", &[]),
        (b"#usda 1.0\n", "USD", &[]),
    ];
    for (bytes, looks, right) in contents {
        for format in [
            Format::Obj,
            Format::Off,
            Format::Ply,
            Format::Stl,
            Format::Gltf,
            Format::Glb,
        ] {
            if !right.contains(&format) {
                assert!(refusal(bytes, format).contains(looks), "{looks} {format:?}");
            }
        }
    }
    for format in [Format::Obj, Format::Off, Format::Ply, Format::Glb] {
        let word = if format == Format::Obj {
            "ply\n"
        } else {
            "solid "
        };
        assert!(refusal(stl(word.as_bytes(), 3), format).contains("looks like"));
    }
}

#[cfg(feature = "gzip")]
fn packed(contents: &[u8]) -> Vec<u8> {
    use std::io::Write;

    let mut packed = flate2::write::GzEncoder::new(Vec::new(), flate2::Compression::best());
    packed.write_all(contents).expect("memory");
    packed.finish().expect("memory")
}

#[test]
#[cfg(feature = "gzip")]
fn compressed_contents_are_read_and_bounded() {
    let plain = parse(OFF.as_bytes(), Format::Off).expect("a mesh");
    let (start, end) = OFF.as_bytes().split_at(20);
    let members = [packed(start), packed(end)].concat();
    for bytes in [packed(OFF.as_bytes()), members] {
        assert_eq!(parse(&bytes, Format::Off).as_ref(), Ok(&plain));
        for cut in 2..bytes.len() - 1 {
            // What is left may be a whole member.
            let error = parse(&bytes[..cut], Format::Off).expect_err("cut short");
            assert!(!error.to_string().is_empty());
        }
    }
    assert!(refusal(packed(&packed(OFF.as_bytes())), Format::Off).contains("twice"));
    let bomb = packed(&vec![b' '; 40 << 20]);
    assert!(refusal(&bomb, Format::Obj).contains("decompress it first"));
}

#[test]
fn files_are_read_by_their_name_or_as_said() {
    let folder = std::env::temp_dir().join(format!("roundel-soup-{}", std::process::id()));
    std::fs::create_dir_all(&folder).expect("a folder");
    let plain = parse(OFF.as_bytes(), Format::Off).expect("a mesh");
    for name in ["a.off", "b.OFF", "c.dat"] {
        std::fs::write(folder.join(name), OFF).expect("writable");
        assert_eq!(read_as(folder.join(name), Format::Off).as_ref(), Ok(&plain));
    }
    assert_eq!(read(folder.join("b.OFF")).as_ref(), Ok(&plain));
    #[cfg(feature = "gzip")]
    {
        std::fs::write(folder.join("d.off.gz"), packed(OFF.as_bytes())).expect("writable");
        assert_eq!(read(folder.join("d.off.gz")).as_ref(), Ok(&plain));
    }
    assert!(matches!(
        read(folder.join("c.dat")),
        Err(SoupError::UnknownFormat { .. })
    ));
    let missing = read(folder.join("none.stl")).expect_err("no file");
    assert!(matches!(&missing, SoupError::Io { message } if message.contains("none.stl")));
    assert_eq!(
        parse_in(OFF.as_bytes(), Format::Off, Some(&folder)).as_ref(),
        Ok(&plain)
    );
    std::fs::remove_dir_all(folder).expect("removable");
}
