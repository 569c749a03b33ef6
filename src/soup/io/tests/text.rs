//! OBJ, OFF, PLY and STL as text.

use super::super::Format;
use super::{faces, line_of, read, refusal};

const SQUARE: &str = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n";

#[test]
fn obj_holds_polygons_of_any_size_and_numbers_of_no_vertex() {
    let soup = read(
        format!(
            "{SQUARE}f 1 2 3 4\nf 1\nf\nf 2 1\nf 1 2 5\nf 0 1 2\nf -5 -1 -2\nf 1 2 99999999999\n"
        ),
        Format::Obj,
    );
    assert_eq!(soup.positions().len(), 4);
    let expected: [&[i64]; 8] = [
        &[0, 1, 2, 3],
        &[0],
        &[],
        &[1, 0],
        &[0, 1, 4],
        &[-1, 0, 1],
        &[-1, 3, 2],
        &[0, 1, 99_999_999_998],
    ];
    assert_eq!(faces(&soup), expected);
    // The same without a wrong number, which another reader reads.
    let soup = read(format!("{SQUARE}f 1 2 3 4\nf 1\nf\nf 2 1\n"), Format::Obj);
    assert_eq!(faces(&soup), expected[..4]);
    let soup = read("f 1 2 3\n", Format::Obj);
    assert_eq!(faces(&soup), [[0, 1, 2]]);
    assert!(soup.positions().is_empty());
}

#[test]
fn obj_is_read_as_it_is_found() {
    let plain = read(format!("{SQUARE}f 1 2 3\nf 1 3 4\n"), Format::Obj);
    let files: [&[u8]; 8] = [
        b"v 0 0 0\rv 1 0 0\rv 1 1 0\rv 0 1 0\rf 1 2 3\rf 1 3 4\r",
        b"v 0 0 0\r\nv 1 0 0\r\nv 1 1 0\r\nv 0 1 0\r\nf 1 2 3\r\nf 1 3 4",
        b"\xef\xbb\xbfv 0 0\nv 1 0\nv 1 1\nv 0 1\nf 1 2 3\nf 1 3 4\n",
        b"# C:\\folder\\\nv 0 0 0 # origin\nv 1 0 0 1 0 0\n v\t1 1 0 0.5 0.5 0.5 1\nv 0 1 0 1.0\n\
          o \xe4\\\ng a b\nusemtl c\\\nf 1/1/1 2//1 3/3 # face\ns 1\nf -4 -2 -1\nl 1 2\np 3\n",
        b"v 0 0 \\\n0\nv 1 0 0\nv 1 \\\n 1 \\\n 0\nv 0 1 0\nf 1 \\\n2\\\r\n 3\nf 1 3 4\n",
        b"v 0 0 0\nv 2 0 0 2\nv 2 2 0 2\nv 0 1 0 1\nf 1 2 3\nfo 1 3 4\n",
        b"vt 0 0\nvn 0 0 1\nf 1 2 3\nv 0 0 0\nv 1 0 0\nv 1 1 0\nf 1 3 4\nv 0 1 0\n",
        b"v 0 0 0\nv 1e0 0 0\nv 1. +1 .0\nv -0 1 0\nf +1 2 3\nf 1 3 4\\",
    ];
    for file in files {
        let soup = read(file, Format::Obj);
        assert_eq!(soup, plain, "{}", String::from_utf8_lossy(file));
    }
}

#[test]
fn obj_of_points_and_lines_has_no_polygons() {
    for file in [
        "",
        "v 1 2 3\n",
        "v 0 0 0\nv 1 0 0\nl 1 2\np 1 2\n",
        "no mesh at all\n",
    ] {
        assert_eq!(read(file, Format::Obj).polygon_count(), 0, "{file}");
    }
}

#[test]
fn obj_errors_name_the_line() {
    for bad in [
        "v 1",
        "v 1 x 2",
        "v 1 2 3 0",
        "f 1 2 a",
        "f 1/2/3/4 2 3",
        "f 1 2 \u{e4}",
    ] {
        assert_eq!(
            line_of(format!("\n{SQUARE}{bad}\nf 1 2 9\n"), Format::Obj),
            6,
            "{bad}"
        );
    }
    assert_eq!(
        line_of(format!("{SQUARE}v 1 \\\n2 \\\nx\n"), Format::Obj),
        5
    );
    assert_eq!(line_of("f 1 2 a\n", Format::Obj), 1);
}

#[test]
fn off_is_read_in_all_its_variants() {
    let plain = read("OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n", Format::Off);
    let files = [
        "3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n",
        "OFF 3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2",
        "OFF3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2",
        "# a\n\n off # b\n3 # vertices\n1 0\n# c\n0 0 0 # d\n1 0 0\n\n0 1 0\n3 0 1 2 # e\n",
        "OFF\r3 1\r0 0\r0\r1 0 0\r0 1 0\r3 0\r1 2\r",
        "COFF\n3 1 3\n0 0 0 255 0 0 255\n1 0 0 1 1 1\n0 1 0\n3 0 1 2 0.5 0.5 0.5\n",
        "NOFF\n3 1 0\n0 0 0 0 0 1\n1 0 0 0 0 1\n0 1 0 0 0 1\n3 0 1 2 200\n",
        "STCNOFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n",
        "4OFF\n3 1 0\n0 0 0 1\n2 0 0 2\n0 -1 0 -1\n3 0 1 2\n",
        "nOFF 2\n3 1 0\n0 0\n1 0\n0 1\n3 0 1 2\n",
        "nOFF\n3\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n",
        "4nOFF\n2\n3 1 0\n0 0 1\n2 0 2\n0 1 1\n3 0 1 2\n",
    ];
    for file in files {
        assert_eq!(read(file, Format::Off), plain, "{file}");
    }
    let soup = read(
        "OFF 2 4 0\n0 0 0\n1 0 0\n4 0 1 -7 9\n2 0 1\n1 0\n0\n",
        Format::Off,
    );
    let expected: [&[i64]; 4] = [&[0, 1, -7, 9], &[0, 1], &[0], &[]];
    assert_eq!(faces(&soup), expected);
}

#[test]
fn off_errors_name_the_line() {
    for (file, line) in [
        ("", 1),
        ("mesh", 1),
        ("XOFF 1 1 1", 1),
        ("OFF\n3 -1 0\n", 2),
        ("OFF 1 1 0\n0 0 x\n", 2),
        ("OFF 1 1 0\n0 0 0\n-3 0 0 0\n", 3),
        ("OFF 1 1 0\n0 0 0\n3 0 0\n", 3),
        ("OFF 1 1 0\n0 0 0\n3 0 0 0.5\n", 3),
        ("4OFF 1 1 0\n0 0 0 0\n", 2),
        ("OFF 1 99999999999999999999 0\n", 1),
        ("OFF 9999999999999 1 0\n0 0 0\n", 2),
        ("OFF 1 1 0\n0 0 0\n9999999999999 0\n", 3),
    ] {
        assert_eq!(line_of(file, Format::Off), line, "{file}");
    }
    assert!(refusal("nOFF 4\n1 1 0\n", Format::Off).contains("4 coordinates"));
}

const PLY: &str = "ply\nformat ascii 1.0\ncomment \u{e4}\nobj_info x\n";

#[test]
fn ply_takes_elements_and_properties_in_any_order() {
    let plain = read(
        format!(
            "{PLY}element vertex 3\nproperty float x\nproperty float y\nproperty float z\n\
             element face 1\nproperty list uchar int vertex_indices\nend_header\n\
             0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n"
        ),
        Format::Ply,
    );
    let files = [
        format!(
            "{PLY}element face 1\nproperty uchar red\nproperty list uint16 uint vertex_index\n\
             property list uchar float texcoord\nelement nothing 9\nelement edge 1\n\
             property int a\nelement vertex 3\nproperty int8 z\nproperty list uchar int l\n\
             property double y\nproperty uchar red\nproperty uchar red\nproperty int x\n\
             end_header\n7 3 0 1 2 2 0.5 0.5\n5\n0 1 4 0 1 1 0\n0 0 0. 1 1 1\n0 2 8 8 1e0 1 1 0\n"
        ),
        format!(
            "{PLY}element vertex 3\nproperty float x\nproperty float y\nproperty float z\n\
             element face 1\nproperty list uchar int vertex_indices\nend_header\n\
             0 0 0 9\n1 0\n\n.0\n0 1. -0 \n3 0 1 2 8 8\n"
        )
        .replace('\n', "\r"),
    ];
    for file in files {
        assert_eq!(read(&file, Format::Ply), plain, "{file}");
    }
}

#[test]
fn ply_strips_are_triangles_that_run_alike() {
    let soup = read(
        format!(
            "{PLY}element vertex 4\nproperty float x\nproperty float y\nproperty float z\n\
             element tristrips 1\nproperty list int int vertex_indices\nend_header\n\
             0 0 0\n1 0 0\n0 1 0\n1 1 0\n11 0 1 2 3 -1 3 2 2 1 0 -1\n"
        ),
        Format::Ply,
    );
    assert_eq!(faces(&soup), [[0, 1, 2], [2, 1, 3], [2, 1, 0]]);
}

#[test]
fn ply_keeps_what_is_not_finite_and_rounds_as_declared() {
    let soup = read(
        format!(
            "{PLY}element vertex 1\nproperty float x\nproperty double y\nproperty float z\n\
             end_header\n0.1 0.1 nan\n"
        ),
        Format::Ply,
    );
    let [x, y, z] = soup.positions()[0];
    assert_eq!((x, y), (f64::from(0.1_f32), 0.1));
    assert!(z.is_nan());
    assert_eq!(soup.polygon_count(), 0);
}

#[test]
fn ply_errors_name_the_line() {
    let vertices = "element vertex 1\nproperty float x\nproperty float y\nproperty float z\n";
    let list = "element face 1\nproperty list uchar int vertex_indices\n";
    for (file, line) in [
        ("ply\n".to_owned(), 1),
        ("plx\n".to_owned(), 1),
        (format!("{PLY}element vertex x\n"), 5),
        (format!("{PLY}property int x\n"), 5),
        (format!("{PLY}element vertex 1\nproperty number x\n"), 6),
        (
            format!("{PLY}element vertex 1\nproperty list float int x\n"),
            6,
        ),
        (format!("{PLY}format ascii 1.0\n"), 5),
        (format!("{PLY}{vertices}vertices\n"), 9),
        ("ply\nelement vertex 1\nend_header\n".to_owned(), 3),
        ("ply\nformat text 1.0\nend_header\n".to_owned(), 2),
        (format!("{PLY}{vertices}end_header\n0 zero 0\n"), 10),
        (format!("{PLY}{list}end_header\n-3 0 1 2\n"), 8),
        (format!("{PLY}{list}end_header\n3 0 1 2.5\n"), 8),
        (format!("{PLY}{list}end_header\n3 0 1\n"), 8),
    ] {
        assert_eq!(line_of(&file, Format::Ply), line, "{file}");
    }
    for (file, part) in [
        (
            format!(
                "{PLY}element vertex 99999999999\nproperty int x\nproperty int y\nproperty int z\nend_header\n"
            ),
            "99999999999",
        ),
        (
            format!(
                "{PLY}element vertex -1\nproperty int x\nproperty int y\nproperty int z\nend_header\n"
            ),
            "-1",
        ),
        (
            format!("{PLY}element vertex 1\nproperty int x\nproperty int y\nend_header\n0 0\n"),
            "x, y and z",
        ),
        (
            format!("{PLY}element face 1\nproperty list uchar int corners\nend_header\n0\n"),
            "vertex_indices",
        ),
        (
            format!(
                "{PLY}element face 1\nproperty list uchar float vertex_indices\nend_header\n1 0\n"
            ),
            "integers",
        ),
    ] {
        assert!(refusal(&file, Format::Ply).contains(part), "{file}");
    }
}

#[test]
fn stl_text_has_solids_of_facets_in_any_case() {
    let facet = |z: &str| {
        format!(
            "facet normal 0 0 1\n outer loop\n vertex 0 0 {z}\n vertex 1 0 {z}\n vertex 0 1 {z}\n endloop\nendfacet\n"
        )
    };
    let one = format!("solid a part\n{}endsolid a part\n", facet("0"));
    let two = format!("{one}\n{}", one.replace('0', "1").to_uppercase());
    let soup = read(&two, Format::Stl);
    assert_eq!(faces(&soup), [[0, 1, 2], [3, 4, 5]]);
    assert_eq!(soup.positions()[3], [1.0, 1.0, 1.0]);
    let plain = read(&one, Format::Stl);
    for file in [
        one.replace('\n', "\r\n"),
        one.replace('\n', "\r"),
        one.replace("normal 0 0 1", "normal nan -nan(ind) x"),
        one.replace("normal 0 0 1", ""),
        one.replace("endsolid a part\n", "endsolid"),
        one.replace("outer loop\n", "outer loop "),
        format!("\n  {one}"),
    ] {
        assert_eq!(read(&file, Format::Stl), plain, "{file}");
    }
    assert!(read(one.replace("1 0 0", "inf 0 0"), Format::Stl).positions()[1][0].is_infinite());
    assert_eq!(read("solid\nendsolid\n", Format::Stl).polygon_count(), 0);
    for (file, line) in [
        (one.replace("vertex 1", "vertex x"), 5),
        (one.replace("vertex 0 1", "vortex 0 1"), 6),
        (one.replace("endfacet\n", ""), 8),
        (one.replace("endsolid a part\n", ""), 8),
        (format!("{one}facet\n"), 10),
        ("solid".to_owned(), 1),
    ] {
        assert_eq!(line_of(&file, Format::Stl), line, "{file}");
    }
}
