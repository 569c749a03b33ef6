//! The half-edges of each edge, sorted in linear time.
//!
//! Half-edges are bucketed by their lower end with a counting sort, and each bucket, about six long, is
//! sorted by the upper end. There is no hash map, and the order depends on nothing but the triangles.

use super::lists::NONE;
use super::surface::{tail, tip};

/// The half-edges of all edges, edge by edge.
pub(super) struct Edges {
    /// The upper end in the upper half of the word, the half-edge in the lower.
    words: Vec<u64>,
    /// Where the half-edges of each lower end start.
    start: Vec<u32>,
}

impl Edges {
    pub(super) fn of(vertices: usize, triangles: &[[u32; 3]]) -> Edges {
        let mut start = vec![0u32; vertices + 2];
        for t in triangles {
            for k in 0..3 {
                start[t[k].min(t[(k + 1) % 3]) as usize + 2] += 1;
            }
        }
        for v in 2..start.len() {
            start[v] += start[v - 1];
        }
        let mut words = vec![0u64; 3 * triangles.len()];
        for (f, t) in triangles.iter().enumerate() {
            for k in 0..3 {
                let (a, b) = (t[k], t[(k + 1) % 3]);
                let slot = &mut start[a.min(b) as usize + 1];
                words[*slot as usize] = u64::from(a.max(b)) << 32 | (3 * f + k) as u64;
                *slot += 1;
            }
        }
        start.pop();
        Edges { words, start }
    }

    /// Calls `visit` with the half-edges of every edge, in increasing order.
    pub(super) fn each(self, mut visit: impl FnMut(&[u32])) {
        self.any(|halves| {
            visit(halves);
            false
        });
    }

    /// Whether `found` holds for the half-edges of an edge; the first one ends the search.
    pub(super) fn any(mut self, mut found: impl FnMut(&[u32]) -> bool) -> bool {
        let mut halves = Vec::new();
        for bucket in self.start.windows(2) {
            let bucket = &mut self.words[bucket[0] as usize..bucket[1] as usize];
            bucket.sort_unstable();
            for edge in bucket.chunk_by(|a, b| a >> 32 == b >> 32) {
                halves.clear();
                halves.extend(edge.iter().map(|&word| word as u32));
                if found(&halves) {
                    return true;
                }
            }
        }
        false
    }
}

/// The twin of every half-edge, [`NONE`] at the boundary, if every edge has two half-edges that run against
/// each other, or one.
pub(super) fn manifold_twins(vertices: usize, triangles: &[[u32; 3]]) -> Option<Vec<u32>> {
    let mut twin = vec![NONE; 3 * triangles.len()];
    let mut manifold = true;
    Edges::of(vertices, triangles).each(|halves| match *halves {
        [_] => {}
        [h, g] if tail(triangles, h) == tip(triangles, g) => {
            twin[h as usize] = g;
            twin[g as usize] = h;
        }
        _ => manifold = false,
    });
    manifold.then_some(twin)
}
