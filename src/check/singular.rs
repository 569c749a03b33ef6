//! Singular vertices (`bommes2012`, equation (6.2)): the angles of the map around them do not sum to one
//! turn.
//!
//! The composed quarter turns around a vertex give its index up to whole turns. The angles of the map give
//! the whole turns. The angles are used if all triangles around the vertex are positively oriented.

use std::f64::consts::FRAC_PI_2;

use super::orientation::orientation;
use crate::mesh::TriangleMesh;

/// A vertex around which the angles of a map do not sum to one turn.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Singularity {
    /// The vertex.
    pub vertex: usize,
    /// Its index in quarters: 1 where three quads meet, -1 where five do.
    pub quarters: i32,
}

/// The singular vertices, in increasing order.
///
/// `quarters` holds the turn of each edge from its first to its second face. A boundary vertex is
/// singular if its angle is not half a turn, and is checked only if `on_boundary`.
pub(super) fn singularities(
    mesh: &TriangleMesh,
    uv: &[[[f64; 2]; 3]],
    quarters: &[u8],
    on_boundary: bool,
) -> Vec<Singularity> {
    let index = |v: usize| match mesh.is_boundary_vertex(v) {
        true if on_boundary => turns_around(mesh, |f| uv[f], v).map_or(0, |angle| 2 - angle),
        true => 0,
        false => interior_index(mesh, uv, quarters, v),
    };
    let all = (0..mesh.vertex_count()).map(|vertex| Singularity {
        vertex,
        quarters: index(vertex),
    });
    all.filter(|singularity| singularity.quarters != 0)
        .collect()
}

fn interior_index(mesh: &TriangleMesh, uv: &[[[f64; 2]; 3]], quarters: &[u8], v: usize) -> i32 {
    let mut holonomy = 0;
    for (face, corner) in mesh.ring(v) {
        let k = (corner + 2) % 3;
        let forth = i32::from(quarters[mesh.edge_of(face, k)]);
        holonomy += mesh.out_of(face, k, forth);
    }
    let holonomy = holonomy.rem_euclid(4);
    match turns_around(mesh, |f| uv[f], v).map(|angle| 4 - angle) {
        Some(index) if (index - holonomy).rem_euclid(4) == 0 => index,
        // Quarter turns do not distinguish +3/4 from -1/4. Cones of -1/4 are the common ones.
        _ if holonomy == 3 => -1,
        _ => holonomy,
    }
}

/// The sum of the map's angles around a vertex, in quarter turns, or `None` if a triangle there is folded.
pub(super) fn turns_around(
    mesh: &TriangleMesh,
    uv: impl Fn(usize) -> [[f64; 2]; 3],
    v: usize,
) -> Option<i32> {
    let mut sum = 0.0;
    for (face, corner) in mesh.ring(v) {
        let uv = uv(face);
        if orientation(uv) <= 0.0 {
            return None;
        }
        let at = |k: usize| uv[(corner + k) % 3];
        let [a, b] = [at(1), at(2)].map(|p| [p[0] - at(0)[0], p[1] - at(0)[1]]);
        sum += (a[0] * b[1] - a[1] * b[0]).atan2(a[0] * b[0] + a[1] * b[1]);
    }
    Some((sum / FRAC_PI_2).round() as i32)
}
