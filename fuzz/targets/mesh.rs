//! Mesh files: any bytes give a valid mesh or an error.
#![no_main]

use libfuzzer_sys::fuzz_target;
use roundel::mesh::TriangleMesh;
use roundel::mesh::io::{self, Format};

fuzz_target!(|input: (u8, &[u8])| {
    let (format, bytes) = input;
    match format % 4 {
        0 => io::parse(bytes, Format::Obj).iter().for_each(check),
        1 => io::parse(bytes, Format::Off).iter().for_each(check),
        2 => io::parse(bytes, Format::Ply).iter().for_each(check),
        _ => drop(io::parse_textured(bytes)),
    }
});

/// Checks that the sizes agree, and that the mesh can be built again from its own arrays.
fn check(mesh: &TriangleMesh) {
    assert!(mesh.face_count() > 0 && mesh.vertex_count() >= 3);
    assert!(2 * mesh.edge_count() >= 3 * mesh.face_count());
    let corners: Vec<_> = mesh.triangles().to_vec();
    assert!(corners.iter().flatten().all(|&v| (v as usize) < mesh.vertex_count()));
    let again = TriangleMesh::new(mesh.vertices().to_vec(), corners).expect("a mesh is a mesh");
    assert_eq!(again.euler_characteristic(), mesh.euler_characteristic());
}
