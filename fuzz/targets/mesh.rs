//! Mesh files: any bytes give a soup or an error, and of the strict reader a valid mesh or an error. Their attributes are
//! those of the soup and of the mesh, or an error.
#![no_main]

use libfuzzer_sys::fuzz_target;
use roundel::mesh::TriangleMesh;
use roundel::mesh::attributes::SurfaceAttributes;
use roundel::mesh::features::FeatureGraph;
use roundel::mesh::io::{self, Format};
use roundel::soup::io::Attributes;
use roundel::soup::{self, PolygonSoup};

fuzz_target!(|input: (u8, &[u8])| {
    let (format, bytes) = input;
    match Format::ALL.get(usize::from(format) % (Format::ALL.len() + 1)) {
        Some(&format) => {
            let soup = soup::io::parse(bytes, format);
            let mesh = io::parse(bytes, format);
            assert!(soup.is_ok() || mesh.is_err());
            mesh.iter().for_each(check);
            if let Ok(soup) = &soup
                && let Ok(attributes) = Attributes::parse(bytes, format, soup)
            {
                check_attributes(&attributes, soup, mesh.as_ref().ok());
            }
        }
        None => drop(io::parse_textured(bytes)),
    }
});

/// Checks that a mesh with the numbers of the soup has its attributes.
fn check_attributes(attributes: &Attributes, soup: &PolygonSoup, mesh: Option<&TriangleMesh>) {
    let Some(mesh) = mesh.filter(|mesh| mesh.vertex_count() == soup.positions().len()) else {
        return;
    };
    if let Ok(found) = SurfaceAttributes::of_file(mesh, (soup, None), attributes) {
        let (vertices, faces) = (mesh.vertex_count(), mesh.face_count());
        found.check(vertices, faces, 3 * faces).expect("attributes of this mesh");
    }
    for attribute in attributes.present() {
        drop(FeatureGraph::by_attribute(mesh, (soup, None), attributes, attribute));
    }
}

/// Checks that the sizes agree, and that the mesh can be built again from its own arrays.
fn check(mesh: &TriangleMesh) {
    assert!(mesh.face_count() > 0 && mesh.vertex_count() >= 3);
    assert!(2 * mesh.edge_count() >= 3 * mesh.face_count());
    let corners: Vec<_> = mesh.triangles().to_vec();
    assert!(corners.iter().flatten().all(|&v| (v as usize) < mesh.vertex_count()));
    let again = TriangleMesh::new(mesh.vertices().to_vec(), corners).expect("a mesh is a mesh");
    assert_eq!(again.euler_characteristic(), mesh.euler_characteristic());
}
