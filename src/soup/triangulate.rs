//! Step 3: polygons become triangles.
//!
//! Corners that repeat the one before are removed, as are spikes, which run out to a vertex and back, and
//! further rounds of a polygon that runs several times round the same corners.
//! A quad is cut along the diagonal with the better worst triangle, a larger polygon by ear
//! clipping. Which triangles come out does not depend on the corner with which a polygon begins, nor on its
//! direction, so that equal polygons become equal triangles.

use robust::{Coord, orient2d};

use super::ears::{self, newell, quality};
use super::edits::EditKind;
use super::surface::Surface;
use super::{PolygonSoup, finite};
use crate::linalg::vector::Vec3;

/// The triangles of all polygons, their vertices welded.
pub(super) fn triangulate(soup: &PolygonSoup, stands_for: &[u32], surface: &mut Surface) {
    let keep = finite::usable(soup, stands_for, &mut surface.edits);
    surface.triangles.reserve(soup.polygon_count());
    surface.before.reserve(soup.polygon_count());
    surface.polygon.reserve(soup.polygon_count());
    let mut corners: Vec<[u32; 2]> = Vec::new();
    for (polygon, given) in soup.polygons().enumerate() {
        if !keep[polygon] {
            continue;
        }
        let number = polygon as u32;
        corners.clear();
        for &v in given {
            push(&mut corners, [stands_for[v as usize], v as u32]);
        }
        close(&mut corners);
        once_round(&mut corners);
        if corners.len() < 3 {
            surface.edits.add(EditKind::PolygonDegenerate, number, None);
            continue;
        }
        if corners.len() < given.len() {
            let removed = (given.len() - corners.len()) as u32;
            surface.edits.add(EditKind::CornersRemoved, number, removed);
        }
        if let [a, b, c] = corners[..] {
            surface.push([a[0], b[0], c[0]], [a[1], b[1], c[1]], number);
            continue;
        }
        let before = surface.triangles.len();
        for triangle in split(&surface.positions, &corners) {
            let [a, b, c] = triangle.map(|i| corners[i]);
            if a[0] != b[0] && b[0] != c[0] && c[0] != a[0] {
                surface.push([a[0], b[0], c[0]], [a[1], b[1], c[1]], number);
            }
        }
        match surface.triangles.len() - before {
            0 => surface.edits.add(EditKind::PolygonDegenerate, number, None),
            made => surface
                .edits
                .add(EditKind::PolygonTriangulated, number, made as u32),
        }
    }
}

/// Adds a corner unless it repeats the last; where it runs back to the last but one, the spike goes.
fn push(corners: &mut Vec<[u32; 2]>, corner: [u32; 2]) {
    match corners[..] {
        [.., last] if last[0] == corner[0] => {}
        [.., back, _] if back[0] == corner[0] => {
            corners.pop();
        }
        _ => corners.push(corner),
    }
}

/// Removes repeated corners and spikes where the end meets the beginning.
fn close(corners: &mut Vec<[u32; 2]>) {
    let mut first = 0;
    while corners.len() - first > 1 {
        let (n, begin) = (corners.len(), corners[first][0]);
        if corners[n - 1][0] == begin {
            corners.pop();
        } else if n - first > 2 && corners[n - 2][0] == begin {
            corners.truncate(n - 2);
        } else if n - first > 2 && corners[n - 1][0] == corners[first + 1][0] {
            first += 1;
            corners.pop();
        } else {
            break;
        }
    }
    corners.drain(..first);
}

/// Of a polygon that runs several times round the same corners, once.
fn once_round(corners: &mut Vec<[u32; 2]>) {
    let n = corners.len();
    let repeats =
        |p: usize| n.is_multiple_of(p) && (p..n).all(|i| corners[i][0] == corners[i - p][0]);
    if let Some(period) = (3..=n / 2).find(|&p| repeats(p)) {
        corners.truncate(period);
    }
}

/// Triangles as triples of corners, in the polygon's direction.
fn split(positions: &[Vec3], corners: &[[u32; 2]]) -> Vec<[usize; 3]> {
    let n = corners.len();
    let first = (0..n).min_by_key(|&i| corners[i][0]).unwrap_or(0);
    let (after, before) = (corners[(first + 1) % n][0], corners[(first + n - 1) % n][0]);
    let forwards = after < before;
    let corner = |i: usize| match forwards {
        true => (first + i) % n,
        false => (first + n - i) % n,
    };
    let points: Vec<Vec3> = (0..n)
        .map(|i| positions[corners[corner(i)][0] as usize])
        .collect();
    let triangles = match n {
        4 => quad(&points).to_vec(),
        _ => ears::triangulate(&points),
    };
    let back = |[a, b, c]: [usize; 3]| match forwards {
        true => [a, b, c].map(corner),
        false => [c, b, a].map(corner),
    };
    triangles.into_iter().map(back).collect()
}

/// A quad along the diagonal that lies in it and has the better worst triangle; the first if both are
/// as good.
fn quad(points: &[Vec3]) -> [[usize; 3]; 2] {
    let both = [[[0, 1, 2], [0, 2, 3]], [[1, 2, 3], [1, 3, 0]]];
    let normal = newell(points);
    let rank = |triangles: [[usize; 3]; 2]| {
        let corners = triangles.map(|t| t.map(|i| points[i]));
        let inside = corners.iter().all(|t| along(t, normal));
        (inside, quality(corners[0]).min(quality(corners[1])))
    };
    // Rounding may not decide between diagonals that are as good, or equal quads would differ.
    let (first, second) = (rank(both[0]), rank(both[1]));
    match (second.0, second.1 * (1.0 - 1e-9)) > first {
        true => both[1],
        false => both[0],
    }
}

/// Whether a triangle runs the way of a normal, seen along the axis nearest to it.
fn along(triangle: &[Vec3; 3], normal: Vec3) -> bool {
    let axis = (0..3).fold(0, |best, k| {
        if normal[k].abs() > normal[best].abs() {
            k
        } else {
            best
        }
    });
    let [a, b, c] = triangle.map(|p| Coord {
        x: p[(axis + 1) % 3],
        y: p[(axis + 2) % 3],
    });
    orient2d(a, b, c) * normal[axis] > 0.0
}
