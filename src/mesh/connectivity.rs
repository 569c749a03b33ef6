//! Which half-edge runs opposite to which, and the undirected edges, in linear time.
//!
//! A half-edge is named by 3 f + k, local edge k of face f. Half-edges are bucketed by their
//! lower end point with a counting sort; within a bucket, about six long, those with the same
//! upper end point are one edge. There is no hash map, and the order depends on nothing but the
//! faces.

use super::MeshError;

/// No half-edge: the other side of a boundary edge.
pub(super) const NONE: u32 = u32::MAX;

/// The opposite of every half-edge, and the first half-edge of every edge.
pub(super) struct Connectivity {
    /// Opposite half-edge, or [`NONE`].
    pub(super) twin: Vec<u32>,
    /// For each edge its lower half-edge; edges in increasing order of it.
    pub(super) edge_half: Vec<u32>,
    /// The edge of every half-edge.
    pub(super) half_edge: Vec<u32>,
}

/// Pairs the half-edges; fails at an edge with more than two faces, then at a pair that runs
/// the same way.
pub(super) fn connect(
    vertex_count: usize,
    triangles: &[[u32; 3]],
) -> Result<Connectivity, MeshError> {
    let (start, halves) = bucket_by_lower_end(vertex_count, triangles);
    let mut twin = vec![NONE; 3 * triangles.len()];
    let mut misoriented: Option<[u32; 2]> = None;
    let mut crowded: Option<(u32, usize)> = None;
    for low in 0..vertex_count {
        let bucket = &halves[start[low] as usize..start[low + 1] as usize];
        for (i, &h) in bucket.iter().enumerate() {
            let upper = upper_end(triangles, h);
            let mut same = bucket[i + 1..]
                .iter()
                .copied()
                .filter(|&g| upper_end(triangles, g) == upper);
            let Some(g) = same.next() else { continue };
            if same.next().is_some() {
                if crowded.is_none_or(|(first, _)| h < first) {
                    crowded = Some((h, low));
                }
                continue;
            }
            if origin(triangles, h) == origin(triangles, g) {
                if misoriented.is_none_or(|[first, _]| h < first) {
                    misoriented = Some([h, g]);
                }
                continue;
            }
            twin[h as usize] = g;
            twin[g as usize] = h;
        }
    }
    if let Some((h, low)) = crowded {
        return Err(non_manifold(
            triangles,
            h,
            &halves[start[low] as usize..start[low + 1] as usize],
        ));
    }
    if let Some([h, g]) = misoriented {
        return Err(MeshError::InconsistentOrientation {
            vertices: [origin(triangles, h), target(triangles, h)].map(|v| v as usize),
            faces: [h / 3, g / 3].map(|f| f as usize),
        });
    }
    Ok(number_edges(twin))
}

/// Half-edges sorted by lower end point, within one in increasing order, and where each vertex
/// starts.
fn bucket_by_lower_end(vertex_count: usize, triangles: &[[u32; 3]]) -> (Vec<u32>, Vec<u32>) {
    let mut start = vec![0u32; vertex_count + 2];
    let lower = |t: &[u32; 3], k: usize| t[k].min(t[(k + 1) % 3]) as usize;
    for t in triangles {
        for k in 0..3 {
            start[lower(t, k) + 2] += 1;
        }
    }
    for v in 2..start.len() {
        start[v] += start[v - 1];
    }
    let mut halves = vec![0u32; 3 * triangles.len()];
    let mut h = 0;
    for t in triangles {
        for k in 0..3 {
            let slot = &mut start[lower(t, k) + 1];
            halves[*slot as usize] = h;
            *slot += 1;
            h += 1;
        }
    }
    start.pop();
    (start, halves)
}

/// The edges of half-edges with these opposites.
pub(super) fn number_edges(twin: Vec<u32>) -> Connectivity {
    let mut edge_half = Vec::with_capacity(twin.len() / 2);
    let mut half_edge = vec![0u32; twin.len()];
    for (h, &t) in twin.iter().enumerate() {
        if t != NONE && (t as usize) < h {
            half_edge[h] = half_edge[t as usize];
        } else {
            half_edge[h] = edge_half.len() as u32;
            edge_half.push(h as u32);
        }
    }
    Connectivity {
        twin,
        edge_half,
        half_edge,
    }
}

fn non_manifold(triangles: &[[u32; 3]], h: u32, bucket: &[u32]) -> MeshError {
    let ends = [origin(triangles, h), target(triangles, h)];
    let upper = upper_end(triangles, h);
    let faces = bucket
        .iter()
        .filter(|&&g| upper_end(triangles, g) == upper)
        .map(|g| *g as usize / 3)
        .collect();
    MeshError::NonManifoldEdge {
        vertices: [ends[0].min(ends[1]) as usize, upper as usize],
        faces,
    }
}

fn origin(triangles: &[[u32; 3]], h: u32) -> u32 {
    triangles[h as usize / 3][h as usize % 3]
}

fn target(triangles: &[[u32; 3]], h: u32) -> u32 {
    triangles[h as usize / 3][(h as usize % 3 + 1) % 3]
}

fn upper_end(triangles: &[[u32; 3]], h: u32) -> u32 {
    origin(triangles, h).max(target(triangles, h))
}
