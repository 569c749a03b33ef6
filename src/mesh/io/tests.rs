//! Properties of the readers and writers.

use proptest::prelude::*;

use super::{Drawing, Format, Polygons, encode, encode_polygons, parse, read, write};
use crate::mesh::{MeshError, TriangleMesh, jitter, shape};

const FORMATS: [Format; 3] = [Format::Obj, Format::Off, Format::Ply];

fn sample() -> TriangleMesh {
    let mesh = shape::by_name("plate-with-holes", 500).expect("a shape");
    jitter(&mesh, 0.1, 3).expect("valid")
}

fn refused(text: &str, format: Format) -> MeshError {
    parse(text.as_bytes(), format).expect_err("not a mesh file")
}

fn corners(text: &str, format: Format) -> Vec<[u32; 3]> {
    parse(text.as_bytes(), format)
        .expect("a mesh")
        .triangles()
        .to_vec()
}

#[test]
fn what_is_written_is_read_back_bit_for_bit() {
    let mesh = sample();
    let vertex_colors = vec![[1, 128, 255]; mesh.vertex_count()];
    let triangle_colors = vec![[9, 8, 7]; mesh.face_count()];
    let plain = Drawing::from(&mesh);
    let colored = Drawing {
        vertex_colors: Some(&vertex_colors),
        triangle_colors: Some(&triangle_colors),
        ..plain
    };
    for format in FORMATS {
        for drawing in [&plain, &colored] {
            let back = parse(&encode(drawing, format).expect("valid"), format).expect("as written");
            assert_eq!(back.vertices(), mesh.vertices(), "{format:?}");
            assert_eq!(back.triangles(), mesh.triangles(), "{format:?}");
        }
    }
}

/// Coordinates that single precision holds.
fn coarse() -> TriangleMesh {
    let mesh = shape::by_name("torus", 300).expect("a shape");
    let rounded = |p: &[f64; 3]| p.map(|x| f64::from(x as f32));
    let vertices = mesh.vertices().iter().map(rounded).collect();
    TriangleMesh::new(vertices, mesh.triangles().to_vec()).expect("hardly moved")
}

#[test]
fn gltf_keeps_numbers_of_single_precision_and_stl_the_triangles() {
    let mesh = coarse();
    for format in [Format::Gltf, Format::Glb] {
        let back = parse(&encode(&(&mesh).into(), format).expect("valid"), format).expect("read");
        assert_eq!(back.vertices(), mesh.vertices(), "{format:?}");
        assert_eq!(back.triangles(), mesh.triangles(), "{format:?}");
    }
    let bytes = encode(&(&mesh).into(), Format::Stl).expect("valid");
    assert_eq!(bytes.len(), 84 + 50 * mesh.face_count());
    let back = parse(&bytes, Format::Stl).expect("read");
    assert_eq!(back.vertex_count(), mesh.vertex_count());
    assert_eq!(back.euler_characteristic(), 0);
    for (f, corners) in mesh.triangles().iter().enumerate() {
        let place = |v: u32| mesh.position(v as usize);
        let again = back.triangles()[f].map(|v| back.position(v as usize));
        assert_eq!(again, corners.map(place), "{f}");
    }
    let far = [[0.0; 3], [1e300, 0.0, 0.0], [0.0, 1.0, 0.0]];
    let drawing = Drawing {
        vertices: &far,
        triangles: &[[0, 1, 2]],
        ..Drawing::default()
    };
    for format in [Format::Stl, Format::Gltf, Format::Glb] {
        let error = encode(&drawing, format).expect_err("too large");
        assert_eq!(error.code(), "invalid_argument", "{format:?}");
    }
}

const PENTAGON: [[f64; 3]; 7] = [
    [0.0, 0.0, 0.0],
    [2.0, 0.0, 0.0],
    [3.0, 1.0, 0.0],
    [0.0, 1.0, 0.0],
    [-1.0, 2.5, 0.0],
    [1.0, 4.0, 0.0],
    [4.0, 2.0, 0.0],
];

fn polygons() -> Polygons<'static> {
    Polygons {
        vertices: &PENTAGON,
        faces: vec![&[0, 1, 2, 3], &[3, 2, 6, 5, 4]],
        attributes: None,
    }
}

#[test]
fn polygons_are_read_back_as_they_were_written() {
    for format in FORMATS {
        let bytes = encode_polygons(&polygons(), format).expect("valid");
        let soup = crate::soup::io::parse(&bytes, format).expect("as written");
        assert_eq!(soup.positions(), PENTAGON);
        let faces: Vec<_> = soup.polygons().collect();
        assert_eq!(faces, [&[0, 1, 2, 3][..], &[3, 2, 6, 5, 4]], "{format:?}");
    }
    let bad = Polygons {
        faces: vec![&[0, 7, 1]],
        ..polygons()
    };
    let error = encode_polygons(&bad, Format::Usda).expect_err("no vertex 7");
    assert_eq!(error.code(), "vertex_out_of_range");
}

#[test]
fn where_there_are_no_quads_they_are_split_along_the_shorter_diagonal() {
    let bytes = encode_polygons(&polygons(), Format::Glb).expect("valid");
    let mesh = parse(&bytes, Format::Glb).expect("as written");
    // 1-3 is shorter than 0-2.
    let expected = [[1, 2, 3], [1, 3, 0], [3, 2, 6], [3, 6, 5], [3, 5, 4]];
    assert_eq!(mesh.triangles(), expected);
    let square = [
        [0.0, 0.0, 0.0],
        [1.0, 0.0, 0.0],
        [1.0, 1.0, 0.0],
        [0.0, 1.0, 0.0],
    ];
    let square = Polygons {
        vertices: &square,
        faces: vec![&[0, 1, 2, 3]],
        attributes: None,
    };
    let bytes = encode_polygons(&square, Format::Stl).expect("valid");
    let mesh = parse(&bytes, Format::Stl).expect("as written");
    assert_eq!(mesh.triangles(), [[0, 1, 2], [0, 2, 3]]);
    assert_eq!(mesh.position(2), [1.0, 1.0, 0.0]);
}

#[test]
fn usd_text_lists_counts_corners_and_points() {
    let text = encode_polygons(&polygons(), Format::Usda).expect("valid");
    let text = String::from_utf8(text).expect("text");
    assert!(text.starts_with("#usda 1.0\n"));
    for line in [
        "float3[] extent = [(-1, 0, 0), (4, 4, 0)]",
        "int[] faceVertexCounts = [4, 5]",
        "int[] faceVertexIndices = [0, 1, 2, 3, 3, 2, 6, 5, 4]",
        "point3f[] points = [(0, 0, 0), (2, 0, 0), (3, 1, 0), (0, 1, 0), (-1, 2.5, 0), (1, 4, 0), (4, 2, 0)]",
        "uniform token subdivisionScheme = \"none\"",
    ] {
        assert!(text.contains(&format!("    {line}\n")), "{line}");
    }
    assert_eq!(
        text.matches(['{', '(']).count(),
        text.matches(['}', ')']).count()
    );
}

#[test]
fn files_are_told_apart_by_extension_in_any_case() {
    let mesh = sample();
    let folder = std::env::temp_dir().join(format!("roundel-mesh-{}", std::process::id()));
    std::fs::create_dir_all(&folder).expect("a folder");
    for name in ["m.obj", "m.OFF", "m.Ply", "m.ply.gz", "m.Obj.GZ"] {
        write(folder.join(name), &mesh).expect("writable");
        assert_eq!(
            read(folder.join(name)).expect("as written").vertices(),
            mesh.vertices()
        );
    }
    for name in ["m.step", "m", "obj", "m.gz"] {
        let error = write(folder.join(name), &mesh).expect_err("no format");
        assert_eq!(error.code(), "unknown_format");
        let error = read(folder.join(name)).expect_err("no format");
        assert_eq!(error.code(), "unknown_format");
    }
    let error = read(folder.join("none.obj")).expect_err("no file");
    assert_eq!(error.code(), "io");
    assert!(error.to_string().contains("none.obj"));
    assert_eq!(
        write(folder.join("none/m.obj"), &mesh)
            .expect_err("no folder")
            .code(),
        "io"
    );
    std::fs::remove_dir_all(folder).expect("removable");
}

#[test]
fn colors_must_fit_the_elements() {
    let mesh = sample();
    let short = [[0, 0, 0]];
    let drawing = Drawing {
        vertex_colors: Some(&short),
        ..Drawing::from(&mesh)
    };
    assert_eq!(
        write("unused.ply", drawing).expect_err("too few").code(),
        "invalid_argument"
    );
    let drawing = Drawing {
        vertices: &mesh.vertices()[..2],
        ..Drawing::from(&mesh)
    };
    assert_eq!(
        write("unused.ply", drawing).expect_err("too few").code(),
        "vertex_out_of_range"
    );
}

#[test]
fn obj_keeps_the_numbers_of_the_file_through_groups_and_all_kinds_of_corners() {
    let text = "# c\nmtllib none.mtl\no one\nv 9 9 9\nv 0 0 0 1 0 0\nv 1 0 0\nvt 0 0\nvn 0 0 1\n\
                usemtl m\nf 4/1/1 2/1/1 3/1/1\ng two\nv 0 1 0 1\ns off\nf -4//1 -1//1 -2//1\r\n\
                v 2 2 2\nf 5 -2 1\nl 1 2\np 1";
    let mesh = parse(text.as_bytes(), Format::Obj).expect("a mesh");
    assert_eq!(mesh.triangles(), [[3, 1, 2], [0, 3, 2], [4, 3, 0]]);
    assert_eq!(mesh.position(0), [9.0; 3]);
    assert_eq!(mesh.position(4), [2.0; 3]);
}

#[test]
fn obj_of_few_vertices_is_read() {
    let three = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";
    assert_eq!(
        corners(&format!("{three}f 3 1 2"), Format::Obj),
        [[2, 0, 1]]
    );
    let four = format!("{three}v 1 1 0\nf 1 2 3\nf 3 2 4\n");
    assert_eq!(corners(&four, Format::Obj), [[0, 1, 2], [2, 1, 3]]);
    assert_eq!(
        refused("v 0 0 0\nf 1 1 1\n", Format::Obj).code(),
        "repeated_vertex"
    );
    assert_eq!(
        refused("v 0 0 0\nv 1 0 0\nf 1 2 1\n", Format::Obj).code(),
        "repeated_vertex"
    );
    assert_eq!(refused(three, Format::Obj), MeshError::NoFaces);
    assert_eq!(refused("", Format::Obj), MeshError::NoFaces);
    assert_eq!(refused("f 1 2 3\n", Format::Obj).code(), "no_faces");
}

#[test]
fn obj_errors_name_the_line_or_the_face() {
    let head = "v 0 0 0\n# \u{e4}\n\nv 1 0 0\nv 0 1 0\n";
    let lines = [
        "v 1\n",
        "v 1 x 2\n",
        "f 1 2 a\n",
        "f 1/2/3/4 2 3\n",
        "v 1 2 3 0\n",
    ];
    for bad in lines {
        let error = refused(&format!("{head}{bad}f 1 2 3\n"), Format::Obj);
        assert_eq!((error.code(), error.line()), ("parse", Some(6)), "{bad}");
    }
    for (bad, vertex) in [
        ("f 1 2 4", 3),
        ("f 1 2 0", -1),
        ("f 1 2 -4", -1),
        ("f 1 99999999999 2", 99_999_999_998),
    ] {
        let error = refused(&format!("{head}f 1 2 3\n{bad}\n"), Format::Obj);
        let expected = MeshError::IndexOutOfRange {
            face: 1,
            vertex,
            vertices: 3,
        };
        assert_eq!(error, expected, "{bad}");
    }
    for (bad, corners) in [
        ("f 1 2 3 1", 4),
        ("f 1 2", 2),
        ("f", 0),
        ("f 1", 1),
        ("f 1 2 3 1 2", 5),
    ] {
        let error = refused(&format!("{head}f 1 2 3\n{bad}\n"), Format::Obj);
        assert_eq!(error, MeshError::NotATriangle { face: 1, corners }, "{bad}");
    }
    assert_eq!(
        refused(&format!("{head}v nan 0 0\nf 1 2 4\n"), Format::Obj).index(),
        Some(3)
    );
    let mut bytes = head.as_bytes().to_vec();
    bytes.extend(b"v \xff 1 2\nf 1 2 3\n");
    assert_eq!(
        parse(&bytes, Format::Obj).expect_err("not text").line(),
        Some(6)
    );
}

#[test]
fn off_variants_are_read_for_their_positions() {
    let body = |extra: &str| format!("0 0 0{extra}\n1 0 0{extra} # c\n\n0 1 0{extra}\n");
    let face = "3 0 1 2 0.5 0.5 0.5\n";
    let files = [
        format!("OFF\n3 1 0\n{}{face}", body("")),
        format!("# c\nOFF 3 1 0\n{}{face}", body("")),
        format!("OFF\n# c\n3 1\n{}3 0 1 2", body("")),
        format!("COFF\n3 1 3\n{}{face}", body(" 255 0 0 255")),
        format!(
            "NOFF\r\n3 1 0\r\n{}{face}",
            body(" 0 0 1").replace('\n', "\r\n")
        ),
        format!("STOFF\n3 1 0\n{}{face}", body(" 0.5 0.5")),
    ];
    for file in &files {
        assert_eq!(corners(file, Format::Off), [[0, 1, 2]], "{file}");
    }
}

#[test]
fn off_errors_name_the_line_or_the_face() {
    let head = "OFF\n3 2 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n";
    let cases = [
        ("", 1),
        ("PLY\n", 1),
        ("4OFF\n1 1 1\n", 2),
        ("5OFF\n1 1 1\n", 1),
        ("OFF\n", 1),
        ("OFF\n3\n", 2),
        ("OFF\n-3 1 0\n", 2),
        ("OFF\n3 1 0\n0 0\n", 3),
        ("OFF\n3 1 0\n0 0 z\n", 3),
        ("OFF\n3 1 0\n0 0 0\n", 3),
        ("OFF\n99999999999999 1 0\n0 0 0\n", 3),
        (head, 6),
        (&format!("{head}3 0 1\n"), 7),
        (&format!("{head}3 0 1 x\n"), 7),
        (&format!("{head}x\n"), 7),
    ];
    for (text, line) in cases {
        let error = refused(text, Format::Off);
        assert_eq!(
            (error.code(), error.line()),
            ("parse", Some(line)),
            "{text}"
        );
    }
    let error = refused(&format!("{head}4 0 1 2 0\n"), Format::Off);
    assert_eq!(
        error,
        MeshError::NotATriangle {
            face: 1,
            corners: 4
        }
    );
    for vertex in [3, -1] {
        let error = refused(&format!("{head}3 0 1 {vertex}\n"), Format::Off);
        assert_eq!(
            error,
            MeshError::IndexOutOfRange {
                face: 1,
                vertex,
                vertices: 3
            }
        );
    }
    assert_eq!(refused("OFF\n0 0 0\n", Format::Off), MeshError::NoFaces);
}

const PLY: &str = "ply\nformat ascii 1.0\ncomment c\nelement vertex 3\nproperty float x\n\
                   property double y\nproperty uchar z\nproperty uchar red\nelement extra 1\n\
                   property list uchar int ints\nelement face 1\n\
                   property list uchar int vertex_indices\nproperty uchar red\nend_header\n";

#[test]
fn ply_is_read_in_all_three_encodings() {
    let ascii = format!("{PLY}0 0 0 1\n1 0 0 1\n0 1 0 1\n2 5 6\n3 0 1 2 9\n");
    assert_eq!(corners(&ascii, Format::Ply), [[0, 1, 2]]);
    for (name, big) in [("binary_big_endian", true), ("binary_little_endian", false)] {
        let mut bytes = PLY.replace("ascii", name).into_bytes();
        let int = |v: i32| {
            if big {
                v.to_be_bytes()
            } else {
                v.to_le_bytes()
            }
        };
        for [x, y] in [[0.0f32, 0.0], [1.0, 0.0], [0.0, 1.0]] {
            bytes.extend(if big {
                x.to_be_bytes()
            } else {
                x.to_le_bytes()
            });
            let y = f64::from(y);
            bytes.extend(if big {
                y.to_be_bytes()
            } else {
                y.to_le_bytes()
            });
            bytes.extend([0, 1]);
        }
        bytes.push(1);
        bytes.extend(int(7));
        bytes.push(3);
        bytes.extend([0, 1, 2].into_iter().flat_map(int));
        bytes.push(9);
        let mesh = parse(&bytes, Format::Ply).expect("a mesh");
        assert_eq!(mesh.triangles(), [[0, 1, 2]]);
        assert_eq!(mesh.position(2), [0.0, 1.0, 0.0]);
        let error = parse(&bytes[..bytes.len() - 2], Format::Ply).expect_err("cut short");
        assert_eq!((error.code(), error.line()), ("malformed", None));
    }
}

#[test]
fn ply_errors_name_the_line_or_the_face() {
    let vertices = "0 0 0 1\n1 0 0 1\n0 1 0 1\n2 5 6\n";
    let error = refused(&format!("{PLY}{vertices}4 0 1 2 0 9\n"), Format::Ply);
    assert_eq!(
        error,
        MeshError::NotATriangle {
            face: 0,
            corners: 4
        }
    );
    let error = refused(&format!("{PLY}{vertices}3 0 1 -2 9\n"), Format::Ply);
    assert_eq!(
        error,
        MeshError::IndexOutOfRange {
            face: 0,
            vertex: -2,
            vertices: 3
        }
    );
    let error = refused(&format!("{PLY}0 0 0 1\n1 zero 0 1\n"), Format::Ply);
    assert_eq!((error.code(), error.line()), ("parse", Some(16)));
    let error = refused(&format!("{PLY}{vertices}3 0 1\n"), Format::Ply);
    assert_eq!((error.code(), error.line()), ("parse", Some(19)));
    assert_eq!(refused("plx\n", Format::Ply).code(), "parse");
    let lies = PLY.replace("vertex 3", "vertex 99999999999");
    assert_eq!(refused(&lies, Format::Ply).code(), "malformed");
    let flat = PLY.replace("property uchar z\n", "");
    assert_eq!(refused(&flat, Format::Ply).code(), "malformed");
}

proptest! {
    #[test]
    fn a_damaged_file_is_read_or_refused_but_never_a_panic(
        damage in proptest::collection::vec((any::<prop::sample::Index>(), any::<u8>()), 1..6),
        cut in any::<prop::sample::Index>(),
    ) {
        let mesh = shape::by_name("disk", 24).expect("a shape");
        let ascii = format!("{PLY}0 0 0 1\n1 0 0 1\n0 1 0 1\n2 5 6\n3 0 1 2 9\n").into_bytes();
        let mut files: Vec<_> = FORMATS.iter().map(|&f| (encode(&(&mesh).into(), f).expect("valid"), f)).collect();
        files.push((ascii, Format::Ply));
        for (mut bytes, format) in files {
            for (place, value) in &damage {
                let place = place.index(bytes.len());
                bytes[place] = *value;
            }
            for bytes in [&bytes[..], &bytes[..cut.index(bytes.len())]] {
                if let Err(error) = parse(bytes, format) {
                    prop_assert!(!error.to_string().is_empty());
                }
            }
        }
    }
}
