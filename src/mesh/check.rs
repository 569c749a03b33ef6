//! The checks of vertices and faces that need no adjacency.
//!
//! Order of the checks of a mesh, each over all elements before the next: size, faces at all,
//! coordinates, vertex numbers, repeated vertices, areas (this file); edges with more than two
//! faces, orientation ([`super::connectivity`]); isolated vertices, fans of faces
//! ([`super::rings`]). Within a check the lowest element is named. Areas come before edges
//! because a collapsed sliver is the cause, and the edge that it spoils is the consequence.

use super::MeshError;
use super::vector::Vec3;
use crate::monitor::in_parts;
use crate::soup::has_no_area;

/// The least number of faces that are worth a thread.
const LEAST: usize = 1 << 13;

/// Checks sizes, coordinates and faces one by one.
pub(super) fn check(vertices: &[Vec3], triangles: &[[u32; 3]]) -> Result<(), MeshError> {
    if vertices.len() >= u32::MAX as usize || triangles.len() >= u32::MAX as usize / 3 {
        return Err(MeshError::TooLarge {
            vertices: vertices.len(),
            faces: triangles.len(),
        });
    }
    if triangles.is_empty() {
        return Err(MeshError::NoFaces);
    }
    let infinite = |p: &Vec3| p.iter().any(|x| !x.is_finite());
    if let Some(vertex) = vertices.iter().position(infinite) {
        return Err(MeshError::NotFinite { vertex });
    }
    for (face, corners) in triangles.iter().enumerate() {
        if let Some(&vertex) = corners.iter().find(|&&v| v as usize >= vertices.len()) {
            return Err(MeshError::IndexOutOfRange {
                face,
                vertex: vertex.into(),
                vertices: vertices.len(),
            });
        }
    }
    for (face, &[a, b, c]) in triangles.iter().enumerate() {
        if a == b || b == c || c == a {
            let vertex = if b == c { b } else { a } as usize;
            return Err(MeshError::RepeatedVertex { face, vertex });
        }
    }
    let is_flat = |&f: &usize| has_no_area(triangles[f].map(|v| vertices[v as usize]));
    let flat = in_parts(triangles.len(), LEAST, |mut part| part.find(is_flat));
    match flat.into_iter().flatten().next() {
        Some(face) => Err(MeshError::ZeroArea { face }),
        None => Ok(()),
    }
}
