//! The vertices at which irregular vertices would lie too close to features.
//!
//! Along a feature quads run straight, and an irregular vertex nearer to it than an edge of the quads squeezes or
//! skews those between them. Distances are exact, along the surface (`bommes2007`), and do not depend on how fine
//! the triangles are.
//!
//! Between two features less than two edges apart no vertex is an edge away from both. There an irregular vertex
//! has to keep to the middle: where no vertex within an edge is an edge away from features, the one farthest away is
//! at half of the gap, and [`OF_HALF_GAP`] of its distance is enough.

use std::cmp::Reverse;
use std::collections::BinaryHeap;

use crate::error::Result;
use crate::geodesic::{GeodesicOptions, Source, geodesic_distance};
use crate::mesh::TriangleMesh;
use crate::mesh::features::FeatureGraph;
use crate::mesh::vertex_values::check_positive;
use crate::monitor::{Monitor, may_continue_at};

/// The part of half a gap that is far enough from both sides: vertices of the mesh seldom lie in the middle.
const OF_HALF_GAP: f64 = 0.75;

/// How far a vertex looks for one that is an edge away from features, in edges, along edges of the mesh: from
/// beside a feature it is one edge, and ways along edges are longer than straight ones.
const REACH: f64 = 2.0;

/// The vertices of the interior, in increasing order, that lie nearer to features, but not on them, than `lengths` at
/// them say, in units of the mesh. Where features are less than two lengths apart, they are those that lie nearer than
/// the middle of the gap.
///
/// # Errors
/// [`LengthMismatch`](crate::Error::LengthMismatch) for features of another mesh or another number of lengths; with
/// the vertex, [`NotFinite`](crate::Error::NotFinite) and [`InvalidArgument`](crate::Error::InvalidArgument) for a
/// length that is not above 0; otherwise those of [`geodesic_distance`].
pub fn near_features(
    mesh: &TriangleMesh,
    features: &FeatureGraph,
    lengths: &[f64],
    monitor: &Monitor,
) -> Result<Vec<usize>> {
    features.check_mesh(mesh)?;
    check_positive(
        mesh,
        "lengths that irregular vertices keep from features",
        lengths,
    )?;
    if features.edges().next().is_none() {
        return Ok(Vec::new());
    }
    let limit = lengths.iter().copied().fold(0.0, f64::max);
    let options = GeodesicOptions {
        limit,
        ..GeodesicOptions::default()
    };
    let sources = Source::features(features);
    let found = geodesic_distance(mesh, &sources, &options, monitor)?;
    let distance = found.vertices();
    let is_free = |v: usize| distance[v] > 0.0 && !mesh.is_boundary_vertex(v);
    let is_wide = |v: usize| distance[v] >= lengths[v];

    // The distance that is enough at every vertex, once it is known.
    let mut enough = vec![f64::INFINITY; distance.len()];
    let wide = (0..distance.len()).filter(|&v| is_free(v) && is_wide(v));
    let from: Vec<(usize, f64)> = wide.map(|v| (v, REACH * lengths[v])).collect();
    let mut is_reached = vec![false; distance.len()];
    reach(mesh, &from, &is_free, |v| is_reached[v] = true)?;
    let mut narrow: Vec<usize> = (0..distance.len())
        .filter(|&v| is_free(v) && !is_reached[v])
        .collect();
    narrow.sort_by(|&a, &b| distance[b].total_cmp(&distance[a]).then(a.cmp(&b)));
    for peak in narrow {
        if is_reached[peak] {
            continue;
        }
        let half_gap = OF_HALF_GAP * distance[peak];
        reach(mesh, &[(peak, lengths[peak])], &is_free, |v| {
            if !is_reached[v] {
                is_reached[v] = true;
                enough[v] = half_gap;
            }
        })?;
    }
    let is_near = |v: &usize| is_free(*v) && distance[*v] < lengths[*v].min(enough[*v]);
    Ok((0..distance.len()).filter(is_near).collect())
}

/// Tells all vertices that can be reached along edges from others through free ones, each with the length of the way
/// that it may go.
fn reach(
    mesh: &TriangleMesh,
    from: &[(usize, f64)],
    is_free: &impl Fn(usize) -> bool,
    mut tell: impl FnMut(usize),
) -> Result<()> {
    // What is left of the way at every vertex. It is positive: its bits are in its order.
    let mut left = std::collections::BTreeMap::new();
    let mut queue = BinaryHeap::new();
    for &(v, way) in from {
        left.insert(v, way);
        queue.push((way.to_bits(), Reverse(v)));
    }
    let mut visited = 0;
    while let Some((bits, Reverse(v))) = queue.pop() {
        let here = left[&v];
        if here.to_bits() != bits {
            continue;
        }
        may_continue_at(visited)?;
        visited += 1;
        tell(v);
        for (face, k) in mesh.ring(v) {
            let corners = mesh.corners(face);
            for (other, side) in [((k + 1) % 3, k), ((k + 2) % 3, (k + 2) % 3)] {
                let (to, way) = (corners[other], here - mesh.edge_length(face, side));
                if way > 0.0 && is_free(to) && left.get(&to).is_none_or(|&best| way > best) {
                    left.insert(to, way);
                    queue.push((way.to_bits(), Reverse(to)));
                }
            }
        }
    }
    Ok(())
}
