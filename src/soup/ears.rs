//! Ear clipping in the plane that fits a polygon best (`meisters1975`).
//!
//! The plane is that of Newell's normal (`sutherland1974`). The polygon is projected along the axis nearest
//! to it, which keeps its coordinates as they are, and the sign of an area is exact (`shewchuk1997`, the
//! crate `robust`). Every polygon of n corners gives n - 2 triangles and no vertex is left out, not even one
//! on a straight line between others: a neighbor may need it. The crates at hand leave such vertices out
//! (`earcut`) or round the coordinates (`i_triangle`), which opens T-junctions.

use robust::{Coord, orient2d};

use super::surface::area;
use crate::linalg::vector::{Vec3, dot, sub};

/// Polygons of up to so many corners are clipped at the best ear, larger ones at the next.
const BEST: usize = 64;

/// Triangulates a polygon of at least four corners; triangles are triples of its corners' numbers.
pub(super) fn triangulate(points: &[Vec3]) -> Vec<[usize; 3]> {
    let flat = project(points);
    let n = points.len();
    let mut ring = Ring {
        points,
        flat: &flat,
        next: (0..n).map(|i| (i + 1) % n).collect(),
        previous: (0..n).map(|i| (i + n - 1) % n).collect(),
    };
    let mut reflex: Vec<usize> = (0..n).filter(|&i| !ring.is_convex(i)).collect();
    let mut triangles = Vec::with_capacity(n - 2);
    let (mut at, mut left) = (0, n);
    while left > 3 {
        let ear = ring.ear(at, left, &reflex);
        let [a, _, c] = ring.triangle(ear);
        triangles.push([a, ear, c]);
        ring.next[a] = c;
        ring.previous[c] = a;
        left -= 1;
        reflex.retain(|&i| i != ear && !((i == a || i == c) && ring.is_convex(i)));
        // Clipping every second corner gives better triangles than a fan.
        at = ring.next[c];
    }
    triangles.push(ring.triangle(at));
    triangles
}

/// The polygon in the coordinate plane nearest to its own, counter-clockwise.
fn project(points: &[Vec3]) -> Vec<Coord<f64>> {
    let normal = newell(points);
    let size = normal.map(f64::abs);
    let axis = match () {
        () if size[0] > size[1] && size[0] > size[2] => 0,
        () if size[1] > size[2] => 1,
        () => 2,
    };
    let (x, y) = match normal[axis] < 0.0 {
        false => ((axis + 1) % 3, (axis + 2) % 3),
        true => ((axis + 2) % 3, (axis + 1) % 3),
    };
    points.iter().map(|p| Coord { x: p[x], y: p[y] }).collect()
}

/// Newell's normal, of twice the polygon's area.
pub(super) fn newell(points: &[Vec3]) -> Vec3 {
    let mut normal = [0.0; 3];
    for i in 0..points.len() {
        let p = sub(points[i], points[0]);
        let q = sub(points[(i + 1) % points.len()], points[0]);
        for k in 0..3 {
            let (l, m) = ((k + 1) % 3, (k + 2) % 3);
            normal[k] += (p[l] - q[l]) * (p[m] + q[m]);
        }
    }
    normal
}

/// Twice the area over the square of the longest edge: 0 for a triangle without area.
pub(super) fn quality([a, b, c]: [Vec3; 3]) -> f64 {
    let longest = [sub(b, a), sub(c, b), sub(a, c)].map(|e| dot(e, e));
    let longest = longest.into_iter().fold(0.0, f64::max);
    if longest > 0.0 {
        2.0 * area([a, b, c]) / longest
    } else {
        0.0
    }
}

/// The corners that are left, in a ring.
struct Ring<'a> {
    points: &'a [Vec3],
    flat: &'a [Coord<f64>],
    next: Vec<usize>,
    previous: Vec<usize>,
}

impl Ring<'_> {
    fn triangle(&self, corner: usize) -> [usize; 3] {
        [self.previous[corner], corner, self.next[corner]]
    }

    fn is_convex(&self, corner: usize) -> bool {
        let [a, b, c] = self.triangle(corner).map(|i| self.flat[i]);
        orient2d(a, b, c) > 0.0
    }

    /// The ear to clip. Where a polygon that intersects itself has none, the best convex corner; where it
    /// has no convex corner, the best of all.
    fn ear(&self, at: usize, left: usize, reflex: &[usize]) -> usize {
        let mut best = (-1, f64::NEG_INFINITY, at);
        let mut corner = at;
        for _ in 0..left {
            let convex = self.is_convex(corner);
            let quality = quality(self.triangle(corner).map(|i| self.points[i]));
            let rank = i32::from(convex);
            if (best.0, best.1) < (2, quality) && convex && self.is_empty(corner, reflex) {
                best = (2, quality, corner);
                if left > BEST {
                    break;
                }
            } else if (best.0, best.1) < (rank, quality) {
                best = (rank, quality, corner);
            }
            corner = self.next[corner];
        }
        best.2
    }

    /// Whether no reflex corner lies in or on the triangle of a convex one, other than where its corners are.
    fn is_empty(&self, corner: usize, reflex: &[usize]) -> bool {
        let [a, b, c] = self.triangle(corner).map(|i| self.flat[i]);
        reflex.iter().all(|&i| {
            let p = self.flat[i];
            p == a
                || p == b
                || p == c
                || orient2d(a, b, p) < 0.0
                || orient2d(b, c, p) < 0.0
                || orient2d(c, a, p) < 0.0
        })
    }
}
