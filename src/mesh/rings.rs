//! The corners around every vertex, in counter-clockwise order.
//!
//! Corner k of face f and half-edge 3 f + k, which leaves that corner, share a number. Around a
//! vertex the corner after (f, k) is where the half-edge that enters it, (f, k + 2), has its
//! opposite.

use std::ops::Range;

use super::MeshError;
use super::connectivity::NONE;
use crate::monitor::{in_parts, joined};

/// The least number of vertices that are worth a thread.
const LEAST: usize = 1 << 14;

/// Corners by vertex: those of `v` are `corner[start[v]..start[v + 1]]`.
pub(super) struct Rings {
    pub(super) start: Vec<u32>,
    pub(super) corner: Vec<u32>,
}

/// Walks around every vertex; fails at an isolated vertex, then at one with several fans.
///
/// The fan of a boundary vertex starts at the corner whose half-edge lies on the boundary, the
/// ring of an interior vertex at its corner in the lowest face.
pub(super) fn rings(
    vertex_count: usize,
    triangles: &[[u32; 3]],
    twin: &[u32],
) -> Result<Rings, MeshError> {
    let mut start = vec![0u32; vertex_count + 1];
    let mut first = vec![NONE; vertex_count];
    for (h, &v) in triangles.as_flattened().iter().enumerate().rev() {
        start[v as usize + 1] += 1;
        let lies_on_boundary = twin[h] == NONE;
        let keep = &mut first[v as usize];
        if lies_on_boundary || *keep == NONE || twin[*keep as usize] != NONE {
            *keep = h as u32;
        }
    }
    if let Some(vertex) = first.iter().position(|&h| h == NONE) {
        return Err(MeshError::IsolatedVertex { vertex });
    }
    for v in 0..vertex_count {
        start[v + 1] += start[v];
    }
    let of_part = |part: Range<usize>| {
        let mut corner = Vec::with_capacity((start[part.end] - start[part.start]) as usize);
        for vertex in part {
            let mut h = first[vertex];
            for i in start[vertex]..start[vertex + 1] {
                if h == NONE || (i > start[vertex] && h == first[vertex]) {
                    return Err(MeshError::NonManifoldVertex { vertex });
                }
                corner.push(h);
                h = twin[previous(h) as usize];
            }
        }
        Ok(corner)
    };
    let corner: Result<Vec<Vec<u32>>, _> =
        in_parts(vertex_count, LEAST, of_part).into_iter().collect();
    Ok(Rings {
        corner: joined(corner?),
        start,
    })
}

/// The half-edge before `h` in its face.
fn previous(h: u32) -> u32 {
    if h.is_multiple_of(3) { h + 2 } else { h - 1 }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mesh::shape::by_name;
    use crate::monitor::{spawned, with_threads};

    #[test]
    fn threads_walk_around_parts_of_the_vertices_and_the_first_at_fault_is_named() {
        let mesh = by_name("torus", 100_000).unwrap();
        let count = mesh.vertex_count();
        let of = |threads, count, triangles: &[[u32; 3]]| {
            with_threads(threads, || rings(count, triangles, &mesh.twin))
        };
        let one = of(1, count, mesh.triangles()).unwrap();
        let three = || {
            let three = of(3, count, mesh.triangles()).unwrap();
            assert_eq!((&one.start, &one.corner), (&three.start, &three.corner));
        };
        assert!(spawned(three) > 0);
        // Of the last vertices each becomes one with a vertex in another part.
        let mut triangles = mesh.triangles().to_vec();
        for (dropped, vertex) in [(count - 1, count / 2), (count - 2, 3)] {
            let corners = triangles.iter_mut().flatten();
            let moved = corners.filter(|v| **v == dropped as u32);
            moved.for_each(|v| *v = vertex as u32);
            for threads in [1, 3] {
                let found = of(threads, dropped, &triangles).err();
                assert_eq!(found, Some(MeshError::NonManifoldVertex { vertex }));
            }
        }
    }
}
