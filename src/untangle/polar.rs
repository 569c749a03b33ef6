//! A disk around a cone, laid out anew in polar coordinates.
//!
//! Around a cone of q quarter turns a map looks like `z^(q/4)`: the angle and the logarithm of the
//! distance from the cone are both harmonic. Both are solved for with the boundary of the disk fixed and
//! the angle growing by q quarter turns around the cone. The new map covers the disk as often as the cone
//! requires, whatever the old map did.

use std::collections::{BTreeMap, VecDeque};
use std::f64::consts::FRAC_PI_2;

use super::disk::Disk;
use crate::error::Result;
use crate::linalg::{Cholesky, Sparse};
use crate::mesh::vector::{norm, sub};
use crate::mesh::{TriangleMesh, angle_between, turned};

/// Corner coordinates of a face.
type Shape = [[f64; 2]; 3];

/// The new places of the vertices inside a disk: the coordinates of each at one of its corners.
pub(super) struct Layout {
    /// Vertex, face, corner, coordinates.
    pub places: Vec<(usize, usize, usize, [f64; 2])>,
}

/// The disk in the charts of its faces.
struct Charts {
    /// The center in the chart of each face.
    center: BTreeMap<usize, [f64; 2]>,
    /// The angle added to that of each corner to get its direction in the chart of the face.
    turn: BTreeMap<usize, [f64; 3]>,
}

impl Layout {
    /// The layout with `quarters` around the center; `None` if the boundary makes another number of
    /// turns.
    ///
    /// # Errors
    /// [`OutOfMemory`](crate::Error::OutOfMemory).
    pub fn new(
        mesh: &TriangleMesh,
        disk: &Disk,
        quarters: i32,
        uv: &impl Fn(usize) -> Shape,
    ) -> Result<Option<Self>> {
        let around = f64::from(quarters) * FRAC_PI_2;
        let centers = centers(mesh, disk, uv);
        // Angle and logarithm of the distance on the boundary.
        let mut polar: BTreeMap<usize, [f64; 2]> = BTreeMap::new();
        let mut angle = 0.0;
        let mut seed = None;
        for &(face, k) in &disk.boundary {
            let at = uv(face);
            let [a, b] = [k, (k + 1) % 3].map(|k| minus(at[k], centers[&face]));
            polar.insert(mesh.corners(face)[k], [angle, a[0].hypot(a[1]).ln()]);
            seed.get_or_insert((face, k, a[1].atan2(a[0])));
            angle += angle_between(a, b);
        }
        let is_around = (angle - around).abs() < 1e-6;
        let Some((face, corner, direction)) = seed.filter(|_| is_around) else {
            return Ok(None);
        };
        let jump = |from: usize, to: usize| {
            let is_crossed = |ends: [usize; 2]| f64::from(disk.path.contains(&ends));
            around * (is_crossed([from, to]) - is_crossed([to, from]))
        };
        harmonic(mesh, disk, &jump, f64::from(quarters) / 4.0, &mut polar)?;
        let charts = Charts {
            turn: turns(mesh, disk, &jump, uv, (face, corner, direction)),
            center: centers,
        };
        let place = |&v: &usize| {
            let (face, corner) = mesh.ring(v).next()?;
            let [angle, distance] = polar[&v];
            let (sin, cos) = (angle + charts.turn[&face][corner]).sin_cos();
            let center = charts.center[&face];
            let r = distance.exp();
            let to = [center[0] + r * cos, center[1] + r * sin];
            Some((v, face, corner, to))
        };
        let places: Vec<_> = disk.inside.iter().filter_map(place).collect();
        let is_finite = |p: &(usize, usize, usize, [f64; 2])| p.3.iter().all(|x| x.is_finite());
        Ok(places.iter().all(is_finite).then_some(Layout { places }))
    }
}

/// The faces that reach within `radius` of a vertex, and the vertex's place in the chart of each,
/// starting from its own faces.
pub(super) fn faces_within(
    mesh: &TriangleMesh,
    center: usize,
    radius: f64,
    uv: &impl Fn(usize) -> Shape,
) -> BTreeMap<usize, [f64; 2]> {
    let mut found: BTreeMap<usize, [f64; 2]> = BTreeMap::new();
    let mut queue = VecDeque::new();
    for (face, corner) in mesh.ring(center) {
        found.insert(face, uv(face)[corner]);
        queue.push_back(face);
    }
    while let Some(face) = queue.pop_front() {
        for k in 0..3 {
            let Some((next, l)) = mesh.neighbor(face, k) else {
                continue;
            };
            if found.contains_key(&next) {
                continue;
            }
            let (from, to) = (uv(face), uv(next));
            let around = rotated(minus(found[&face], from[k]), quarter(from, k, to, l));
            let at = plus(to[(l + 1) % 3], around);
            let far = |p: [f64; 2]| (p[0] - at[0]).hypot(p[1] - at[1]);
            if to.into_iter().all(|p| far(p) < radius) {
                found.insert(next, at);
                queue.push_back(next);
            }
        }
    }
    found
}

/// The center's place in the chart of every face, starting from its own faces.
fn centers(
    mesh: &TriangleMesh,
    disk: &Disk,
    uv: &impl Fn(usize) -> Shape,
) -> BTreeMap<usize, [f64; 2]> {
    let mut found: BTreeMap<usize, [f64; 2]> = BTreeMap::new();
    for (face, corner) in mesh.ring(disk.center) {
        found.insert(face, uv(face)[corner]);
    }
    spread(mesh, disk, |face, k, next, l| {
        let (from, Some(&center)) = (uv(face), found.get(&face)) else {
            return false;
        };
        if found.contains_key(&next) {
            return false;
        }
        let to = uv(next);
        let around = rotated(minus(center, from[k]), quarter(from, k, to, l));
        found.insert(next, plus(to[(l + 1) % 3], around));
        true
    });
    found
}

/// The angle that turns each corner's angle into its direction, starting from the direction of one
/// corner.
fn turns(
    mesh: &TriangleMesh,
    disk: &Disk,
    jump: &impl Fn(usize, usize) -> f64,
    uv: &impl Fn(usize) -> Shape,
    (face, corner, direction): (usize, usize, f64),
) -> BTreeMap<usize, [f64; 3]> {
    let whole = |face: usize, corner: usize, turn: f64| {
        let corners = mesh.corners(face);
        [0, 1, 2].map(|k| turn + jump(corners[corner], corners[k]))
    };
    let mut found = BTreeMap::from([(face, whole(face, corner, direction))]);
    spread(mesh, disk, |face, k, next, l| {
        let Some(turn) = found.get(&face) else {
            return false;
        };
        if found.contains_key(&next) {
            return false;
        }
        // The end of the shared edge that is not the center, which has no angle.
        let (mine, other) = match mesh.corners(face)[k] == disk.center {
            false => (k, (l + 1) % 3),
            true => ((k + 1) % 3, l),
        };
        let there = turn[mine] + FRAC_PI_2 * f64::from(quarter(uv(face), k, uv(next), l));
        found.insert(next, whole(next, other, there));
        true
    });
    found
}

/// Steps across edges inside the disk until no face is left to reach.
fn spread(
    mesh: &TriangleMesh,
    disk: &Disk,
    mut step: impl FnMut(usize, usize, usize, usize) -> bool,
) {
    let is_in: std::collections::BTreeSet<usize> = disk.faces.iter().copied().collect();
    loop {
        let mut is_done = true;
        for &face in &disk.faces {
            for k in 0..3 {
                let next = mesh
                    .neighbor(face, k)
                    .filter(|(next, _)| is_in.contains(next));
                if let Some((next, l)) = next {
                    is_done &= !step(face, k, next, l);
                }
            }
        }
        if is_done {
            return;
        }
    }
}

/// Solves for the angle and the logarithm of the distance inside, given their values on the boundary.
fn harmonic(
    mesh: &TriangleMesh,
    disk: &Disk,
    jump: &impl Fn(usize, usize) -> f64,
    exponent: f64,
    polar: &mut BTreeMap<usize, [f64; 2]>,
) -> Result<()> {
    let place: BTreeMap<usize, u32> = (0..).zip(&disk.inside).map(|(k, &v)| (v, k)).collect();
    let far = |v: usize| norm(sub(mesh.position(v), mesh.position(disk.center)));
    let mean = |values: &[f64]| values.iter().sum::<f64>() / values.len() as f64;
    let first: Vec<usize> = (mesh.ring(disk.center))
        .map(|(face, corner)| mesh.corners(face)[(corner + 1) % 3])
        .collect();
    let outer: Vec<f64> = polar.keys().map(|&v| far(v)).collect();
    let inner: Vec<f64> = first.iter().map(|&v| far(v)).collect();
    let outer_log: Vec<f64> = polar.values().map(|p| p[1]).collect();
    let near = mean(&outer_log) - exponent * (mean(&outer) / mean(&inner)).ln();

    let dim = disk.inside.len();
    let solve = |is_distance: bool| -> Result<Vec<f64>> {
        let mut entries: Vec<(u32, u32, f64)> = Vec::new();
        let mut rhs = vec![0.0; dim];
        let known = |v: usize| match polar.get(&v) {
            Some(p) => Some(p[usize::from(is_distance)]),
            None => (is_distance && first.contains(&v)).then_some(near),
        };
        for &v in &disk.inside {
            let i = place[&v];
            if let Some(value) = known(v) {
                entries.push((i, i, 1.0));
                rhs[i as usize] = value;
                continue;
            }
            for (face, corner) in mesh.ring(v) {
                let w = mesh.corners(face)[(corner + 1) % 3];
                if w == disk.center {
                    continue;
                }
                entries.push((i, i, 1.0));
                // The angle of v is that of w minus its growth from v to w.
                let grows = if is_distance { 0.0 } else { jump(v, w) };
                rhs[i as usize] += grows;
                match known(w) {
                    Some(value) => rhs[i as usize] += value,
                    None if place[&w] < i => entries.push((i, place[&w], -1.0)),
                    None => {}
                }
            }
        }
        let matrix = Sparse::from_triplets(dim, dim, entries.into_iter())?;
        Cholesky::new(&matrix)?.solve(&mut rhs)?;
        Ok(rhs)
    };
    let (angle, distance) = (solve(false)?, solve(true)?);
    for (&v, (angle, distance)) in disk.inside.iter().zip(angle.into_iter().zip(distance)) {
        polar.insert(v, [angle, distance]);
    }
    Ok(())
}

/// The quarter turns from the chart of one face to that of another, by their common edge: local
/// edge `k` of the one, `l` of the other.
fn quarter(from: Shape, k: usize, to: Shape, l: usize) -> i32 {
    let a = minus(from[(k + 1) % 3], from[k]);
    let b = minus(to[l], to[(l + 1) % 3]);
    (angle_between(a, b) / FRAC_PI_2).round() as i32
}

fn rotated(p: [f64; 2], quarters: i32) -> [f64; 2] {
    turned(quarters.rem_euclid(4) as u8, p)
}

fn minus(a: [f64; 2], b: [f64; 2]) -> [f64; 2] {
    [a[0] - b[0], a[1] - b[1]]
}

fn plus(a: [f64; 2], b: [f64; 2]) -> [f64; 2] {
    [a[0] + b[0], a[1] + b[1]]
}
