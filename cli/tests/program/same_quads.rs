//! The quads that are made when nothing is said are the same, to the byte, from the program and
//! from Rust. Those of C and C++ are held against the program's by `cpp_tests`, those of Python by
//! the tests of its package, on the same meshes.

use std::fs;

use roundel::Monitor;
use roundel::mesh::io;
use roundel::quad::{QuadOptions, quadrangulate};

use crate::run::{Scratch, finish, program};

/// With features and fields that are compared, without either, and with a map that is untangled.
const SHAPES: [(&str, &str); 3] = [
    ("gear", "4000"),
    ("rounded-cube", "2000"),
    ("plate-with-holes", "1200"),
];

#[test]
fn quads_of_a_mesh_are_the_same_from_the_program_and_from_rust() {
    let scratch = Scratch::new("same-quads");
    for (shape, triangles) in SHAPES {
        let [mesh, quads, ours] = ["mesh.obj", "quads.obj", "ours.obj"].map(|f| scratch.path(f));
        let mut draw = program(&["shape", shape, "--triangles", triangles, "-o"]);
        draw.arg(&mesh);
        let mut quad = program(&["quad"]);
        quad.arg(&mesh).arg("-o").arg(&quads);
        for command in [draw, quad] {
            let (code, output) = finish(command);
            let told = String::from_utf8_lossy(&output.stderr);
            assert_eq!(code, 0, "{shape}: {told}");
        }
        let mesh = io::read(&mesh).unwrap();
        let made = quadrangulate(&mesh, &QuadOptions::default(), Monitor::default).unwrap();
        assert!(made.quads.is_conforming(), "{shape}");
        made.quads.write_obj(&ours).unwrap();
        assert!(
            fs::read(quads).unwrap() == fs::read(ours).unwrap(),
            "{shape}"
        );
    }
}
