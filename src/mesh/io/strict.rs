//! From the soup of a file to a mesh, where nothing is repaired.

use std::collections::HashMap;

use crate::mesh::{MeshError, TriangleMesh};
use crate::soup::PolygonSoup;
use crate::soup::io::Format;

/// The mesh that a soup is, if it is one.
pub(super) fn mesh(soup: &PolygonSoup, format: Format) -> Result<TriangleMesh, MeshError> {
    let triangles = triangles(soup)?;
    if format == Format::Stl {
        let (vertices, triangles) = shared(soup.positions(), &triangles);
        return TriangleMesh::new(vertices, triangles);
    }
    TriangleMesh::new(soup.positions().to_vec(), triangles)
}

pub(super) fn triangles(soup: &PolygonSoup) -> Result<Vec<[u32; 3]>, MeshError> {
    let vertices = soup.positions().len();
    if vertices == 0 {
        return Err(MeshError::NoFaces);
    }
    let of = |(face, corners): (usize, &[i64])| {
        let &[a, b, c] = corners else {
            return Err(MeshError::NotATriangle {
                face,
                corners: corners.len(),
            });
        };
        let number = |vertex: i64| {
            u32::try_from(vertex)
                .ok()
                .filter(|&v| (v as usize) < vertices)
                .ok_or(MeshError::IndexOutOfRange {
                    face,
                    vertex,
                    vertices,
                })
        };
        Ok([number(a)?, number(b)?, number(c)?])
    };
    soup.polygons().enumerate().map(of).collect()
}

/// Vertices of equal position made one, numbered in the order of their first use: STL has no other way
/// to say that triangles share a vertex.
fn shared(positions: &[[f64; 3]], triangles: &[[u32; 3]]) -> (Vec<[f64; 3]>, Vec<[u32; 3]>) {
    let mut numbers = HashMap::new();
    let mut vertices = Vec::new();
    let mut number = |v: u32| {
        let position = positions[v as usize];
        // Zero and minus zero are equal.
        *numbers
            .entry(position.map(|x| (x + 0.0).to_bits()))
            .or_insert_with(|| {
                vertices.push(position);
                vertices.len() as u32 - 1
            })
    };
    let triangles = triangles.iter().map(|t| t.map(&mut number)).collect();
    (vertices, triangles)
}
