//! The plane about which a mesh is most symmetric.
//!
//! Planes through the centroid of the surface, with normals spread over all directions, are compared by the
//! distances of mirrored points from the surface. The best ones are improved by the steps of Gauss and
//! Newton: the distances of mirrored points from the tangent planes at their closest points are linear in
//! small changes of the plane. A plane through the centre of the bounding box and perpendicular to an axis
//! is preferred where it is as good.

use super::{LEAST, MirrorPlane, diagonal};
use crate::error::Result;
use crate::mesh::vector::{Vec3, add, cross, dot, norm, normalize, scale, sub};
use crate::mesh::{ClosestPoint, TriangleMesh};
use crate::monitor::{collect_in_parts, may_continue};

/// The directions that are compared, and the points that each is compared by.
const DIRECTIONS: usize = 400;
const POINTS: usize = 400;

/// The directions that are improved, and the points for that.
const IMPROVED: usize = 10;
const MORE_POINTS: usize = 3_000;

/// The most steps of an improvement.
const STEPS: usize = 60;

/// How much a plane perpendicular to an axis may be worse, as a factor of the mean square, and in squares of
/// the diagonal.
const AS_GOOD: f64 = 1.05;
const AS_GOOD_SQUARE: f64 = 1e-12;

/// The best plane that is perpendicular to the planes given.
pub(super) fn find(
    mesh: &TriangleMesh,
    tree: &ClosestPoint,
    known: &[MirrorPlane],
) -> Result<MirrorPlane> {
    let center = mesh.centroid();
    let search = Search {
        mesh,
        tree,
        center,
        axes: free_axes(known),
    };
    let few = search.samples(POINTS);
    let mut candidates: Vec<(f64, MirrorPlane)> = Vec::new();
    for normal in search.directions() {
        let plane = plane(normal, dot(normal, center));
        candidates.push((search.score(&few, &plane), plane));
        may_continue()?;
    }
    candidates.sort_by(|a, b| a.0.total_cmp(&b.0));
    candidates.truncate(IMPROVED);
    let many = search.samples(MORE_POINTS);
    let mut best: Option<(f64, MirrorPlane)> = None;
    for (_, start) in candidates {
        let found = search.improved(&many, start)?;
        if best.is_none_or(|best| found.0 < best.0) {
            best = Some(found);
        }
    }
    let (score, mut best) = best.unwrap_or((0.0, plane([1.0, 0.0, 0.0], center[0])));
    // The largest share of the normal is positive.
    let largest = (0..3).fold(0, |k, i| {
        match best.normal[i].abs() > best.normal[k].abs() {
            true => i,
            false => k,
        }
    });
    if best.normal[largest] < 0.0 {
        best.normal = scale(best.normal, -1.0);
        best.offset = -best.offset;
    }
    let [low, high] = mesh.bounding_box();
    let middle = 0.5 * low[largest] + 0.5 * high[largest];
    let straight = MirrorPlane::of_axis(largest, false, middle);
    let is_free = known
        .iter()
        .all(|other| dot(other.normal, straight.normal) == 0.0);
    let allowed = AS_GOOD * score + AS_GOOD_SQUARE * diagonal(mesh).powi(2);
    let is_as_good = is_free && search.score(&many, &straight) <= allowed;
    Ok(if is_as_good { straight } else { best })
}

struct Search<'a> {
    mesh: &'a TriangleMesh,
    tree: &'a ClosestPoint,
    center: Vec3,
    /// An orthonormal basis of the directions that are allowed.
    axes: Vec<Vec3>,
}

impl Search<'_> {
    /// Directions spread over those allowed: a spiral over half a sphere, or half a circle.
    fn directions(&self) -> Vec<Vec3> {
        let golden = std::f64::consts::PI * (3.0 - 5f64.sqrt());
        match self.axes[..] {
            [x, y, z] => {
                let mut all = vec![x, y, z];
                all.extend((0..DIRECTIONS).map(|i| {
                    let up = (i as f64 + 0.5) / DIRECTIONS as f64;
                    let (out, angle) = ((1.0 - up * up).sqrt(), golden * i as f64);
                    let flat = add(scale(x, out * angle.cos()), scale(y, out * angle.sin()));
                    add(flat, scale(z, up))
                }));
                all
            }
            [x, y] => (0..DIRECTIONS / 4)
                .map(|i| {
                    let angle = std::f64::consts::PI * i as f64 / (DIRECTIONS / 4) as f64;
                    add(scale(x, angle.cos()), scale(y, angle.sin()))
                })
                .collect(),
            _ => self.axes.clone(),
        }
    }

    /// Points spread evenly over the surface.
    fn samples(&self, count: usize) -> Vec<Vec3> {
        let whole = self.mesh.surface_area();
        let (mut points, mut passed) = (Vec::with_capacity(count), 0.0);
        for face in 0..self.mesh.face_count() {
            passed += self.mesh.area(face);
            while points.len() < count
                && (points.len() as f64 + 0.5) * whole <= passed * count as f64
            {
                // Weights of a sequence that fills the triangle.
                let i = points.len() as f64;
                let [mut u, mut v] = [0.754_877_666_246_692_7, 0.569_840_290_998_053_2]
                    .map(|step| (step * (i + 1.0)).fract());
                if u + v > 1.0 {
                    (u, v) = (1.0 - u, 1.0 - v);
                }
                let [a, b, c] = self.mesh.corner_positions(face);
                points.push(add(a, add(scale(sub(b, a), u), scale(sub(c, a), v))));
            }
        }
        points
    }

    /// The mean square of the distances of mirrored points from the surface.
    fn score(&self, points: &[Vec3], plane: &MirrorPlane) -> f64 {
        let squares = collect_in_parts(points.len(), LEAST, |i| {
            let image = plane.reflect(points[i]);
            let found = self.tree.find(image, None);
            found.map_or(0.0, |(_, q)| dot(sub(q, image), sub(q, image)))
        });
        squares.iter().sum::<f64>() / points.len().max(1) as f64
    }

    /// A plane after steps that lower the score, and its score.
    fn improved(&self, points: &[Vec3], start: MirrorPlane) -> Result<(f64, MirrorPlane)> {
        let (mut best, mut score) = (start, self.score(points, &start));
        let mut damping = 1e-6;
        for _ in 0..STEPS {
            may_continue()?;
            let next = self.step(points, &best, damping);
            let found = self.score(points, &next);
            if found < score {
                let is_small = found > 0.999_999 * score;
                (best, score) = (next, found);
                damping *= 0.1;
                if is_small {
                    break;
                }
            } else {
                damping *= 10.0;
                if damping > 1.0 {
                    break;
                }
            }
        }
        Ok((score, best))
    }

    /// One step. Unknowns are the offset and the turns of the normal towards the directions allowed.
    fn step(&self, points: &[Vec3], at: &MirrorPlane, damping: f64) -> MirrorPlane {
        let n = at.normal;
        let tangents = self.tangents(n);
        let offset = at.offset - dot(n, self.center);
        let size = diagonal(self.mesh);
        let rows = collect_in_parts(points.len(), LEAST, |i| {
            let image = at.reflect(points[i]);
            let (face, q) = self.tree.find(image, None)?;
            let across = self.mesh.normal(face);
            let p = sub(points[i], self.center);
            let (of_normal, height) = (dot(across, n), dot(n, p) - offset);
            let mut row = [2.0 * of_normal * size, 0.0, 0.0];
            for (k, &u) in tangents.iter().enumerate() {
                row[k + 1] = -2.0 * (dot(u, p) * of_normal + height * dot(across, u));
            }
            Some((row, dot(across, sub(image, q))))
        });
        let (mut matrix, mut right) = ([[0.0; 3]; 3], [0.0; 3]);
        for (row, residual) in rows.into_iter().flatten() {
            for i in 0..3 {
                right[i] -= row[i] * residual;
                for j in 0..3 {
                    matrix[i][j] += row[i] * row[j];
                }
            }
        }
        let trace: f64 = (0..3).map(|i| matrix[i][i]).sum();
        for (i, row) in matrix.iter_mut().enumerate() {
            // An unknown that is not there stays 0.
            let is_there = i <= tangents.len();
            row[i] += if is_there { damping * trace } else { trace };
        }
        let [move_by, turns @ ..] = solve(matrix, right);
        let turned = tangents
            .iter()
            .zip(turns)
            .fold(n, |n, (&u, t)| add(n, scale(u, t)));
        let normal = normalize(turned);
        plane(normal, offset + move_by * size + dot(normal, self.center))
    }

    /// The directions allowed that are perpendicular to a normal.
    fn tangents(&self, n: Vec3) -> Vec<Vec3> {
        let mut found: Vec<Vec3> = Vec::new();
        for _ in 1..self.axes.len() {
            // The axis that has most left is the safest.
            let mut best = [0.0; 3];
            for &axis in &self.axes {
                let one = std::iter::once(&n).chain(&found);
                let rest = one.fold(axis, |rest, &other| {
                    sub(rest, scale(other, dot(other, rest)))
                });
                if norm(rest) > norm(best) {
                    best = rest;
                }
            }
            found.push(normalize(best));
        }
        found
    }
}

fn plane(normal: Vec3, offset: f64) -> MirrorPlane {
    MirrorPlane {
        normal,
        offset,
        deviation: 0.0,
    }
}

/// An orthonormal basis of what is perpendicular to all normals.
fn free_axes(known: &[MirrorPlane]) -> Vec<Vec3> {
    let unit = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
    match known {
        [] => unit.to_vec(),
        [one] => {
            let n = one.normal;
            let least = (0..3).fold(0, |k, i| if n[i].abs() < n[k].abs() { i } else { k });
            let first = normalize(cross(n, unit[least]));
            vec![first, cross(n, first)]
        }
        [one, two, ..] => vec![normalize(cross(one.normal, two.normal))],
    }
}

/// The solution of a positive definite system, by Cramer's rule.
fn solve(m: [[f64; 3]; 3], b: [f64; 3]) -> [f64; 3] {
    let whole = dot(m[0], cross(m[1], m[2]));
    // Symmetric: rows are columns.
    let of = [
        dot(b, cross(m[1], m[2])),
        dot(m[0], cross(b, m[2])),
        dot(m[0], cross(m[1], b)),
    ];
    match whole > 0.0 {
        true => of.map(|x| x / whole),
        false => [0.0; 3],
    }
}
