//! Soups that need no repair.
//!
//! A soup that the strict mesh accepts stays as it is, unless it has seams, as textures leave them: boundary
//! edges that lie on each other and run against each other are worth welding. If such edges run the
//! same way, they are welded where that and turning is all that it takes: else they are where a Moebius band
//! was cut. Sheets that touch at vertices, or along edges where neither of them ends, stay apart.

use super::PolygonSoup;
use super::edges::{Edges, manifold_twins};
use super::lists::NONE;
use super::surface::{fans, flat, tail, tip};
use crate::monitor::in_parts;

/// The least number of triangles that are worth a thread.
const LEAST: usize = 1 << 13;

/// Of so many half-edges at an edge the seam is sought; more are repaired anyway.
const LOOKED_AT: usize = 64;

/// The soup's triangles, if the strict mesh accepts them as they are.
pub(super) fn clean(soup: &PolygonSoup) -> Option<Vec<[u32; 3]>> {
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
        if a == b || b == c || c == a {
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
    let is_flat = |t: usize| flat(triangles[t].map(|v| positions[v as usize]));
    let flat = in_parts(triangles.len(), LEAST, |mut part| part.any(is_flat));
    if flat.contains(&true) {
        return None;
    }
    let twin = manifold_twins(positions.len(), &triangles)?;
    let (_, fans) = fans(&twin);
    (fans as usize == positions.len()).then_some(triangles)
}

/// How boundary edges lie on each other once vertices are welded.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub(super) enum Seam {
    /// They do not, or there are other polygons than triangles.
    None,
    /// Some do, and all that do run the same way.
    Alike,
    /// Some run against each other.
    Against,
}

/// The seams of a soup of triangles.
pub(super) fn seam(soup: &PolygonSoup, stands_for: &[u32]) -> Seam {
    let number = |v: i64| usize::try_from(v).ok().filter(|&v| v < stands_for.len());
    let mut given = Vec::with_capacity(soup.polygon_count());
    let mut welded = Vec::with_capacity(soup.polygon_count());
    for polygon in soup.polygons() {
        let &[a, b, c] = polygon else {
            return Seam::None;
        };
        let [Some(a), Some(b), Some(c)] = [a, b, c].map(number) else {
            return Seam::None;
        };
        given.push([a, b, c].map(|v| v as u32));
        welded.push([a, b, c].map(|v| stands_for[v]));
        if welded[welded.len() - 1].contains(&NONE) {
            return Seam::None;
        }
    }
    let mut worst = Seam::None;
    let mut open: Vec<u32> = Vec::new();
    Edges::of(stands_for.len(), &welded).any(|halves| {
        let ends = |h: u32| [tail(&given, h), tip(&given, h)];
        let same = |h: u32, g: u32| {
            let [a, b] = ends(g);
            ends(h) == [a, b] || ends(h) == [b, a]
        };
        if halves.len() > 1 {
            let alone = |&&h: &&u32| halves.iter().all(|&g| g == h || !same(h, g));
            open.clear();
            open.extend(halves.iter().take(LOOKED_AT).filter(alone));
            if open.len() > 1 {
                let up = |&h: &u32| tail(&welded, h) < tip(&welded, h);
                let alike = open.iter().all(|h| up(h) == up(&open[0]));
                worst = worst.max(if alike { Seam::Alike } else { Seam::Against });
            }
        }
        worst == Seam::Against
    });
    worst
}
