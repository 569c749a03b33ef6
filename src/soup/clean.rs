//! Soups that need no repair.
//!
//! A soup that the strict mesh accepts stays as it is, unless its boundary edges lie on each other, as
//! they do along the seams of a texture: those are worth welding. Sheets that touch at vertices, or
//! along edges where neither of them ends, stay apart.

use super::PolygonSoup;
use super::edges::{Edges, manifold_twins};
use super::lists::NONE;
use super::surface::{fans, flat};

/// The triangles of a soup that the strict mesh accepts, and their twins.
pub(super) struct Clean {
    pub(super) triangles: Vec<[u32; 3]>,
    pub(super) twin: Vec<u32>,
}

impl Clean {
    /// The soup's triangles, if the strict mesh accepts them as they are.
    pub(super) fn of(soup: &PolygonSoup) -> Option<Clean> {
        let positions = soup.positions();
        if positions.iter().flatten().any(|x| !x.is_finite()) {
            return None;
        }
        let mut used = vec![false; positions.len()];
        let mut triangles = Vec::with_capacity(soup.polygon_count());
        for polygon in soup.polygons() {
            let corners = <[i64; 3]>::try_from(polygon).ok()?;
            if corners
                .iter()
                .any(|&v| v < 0 || v >= positions.len() as i64)
            {
                return None;
            }
            let [a, b, c] = corners.map(|v| v as u32);
            if a == b || b == c || c == a || flat([a, b, c].map(|v| positions[v as usize])) {
                return None;
            }
            triangles.push([a, b, c]);
            for v in [a, b, c] {
                used[v as usize] = true;
            }
        }
        if triangles.is_empty() || used.contains(&false) {
            return None;
        }
        let twin = manifold_twins(positions.len(), &triangles)?;
        let (_, fans) = fans(&twin);
        (fans as usize == positions.len()).then_some(Clean { triangles, twin })
    }

    pub(super) fn boundary_edges(&self) -> usize {
        self.twin.iter().filter(|&&t| t == NONE).count()
    }

    /// Whether two boundary edges lie on each other once vertices are welded.
    pub(super) fn has_seam(&self, stands_for: &[u32]) -> bool {
        let welded: Vec<_> = self
            .triangles
            .iter()
            .map(|t| t.map(|v| stands_for[v as usize]))
            .collect();
        let mut seam = false;
        Edges::of(stands_for.len(), &welded).each(|halves| {
            let open = |&&h: &&u32| self.twin[h as usize] == NONE;
            seam |= halves.len() > 1 && halves.iter().filter(open).count() > 1;
        });
        seam
    }
}
