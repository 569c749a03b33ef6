//! Numbers of corners, on the side of the seams that lies beneath a quad.
//!
//! The triangles near a quad that hang together without a seam are a patch. The patch with most of the quad's samples
//! gives the values of all its corners. Patches are local: a seam may cut a surface so that both of its sides belong to
//! one chart, as that of a cylinder does.

use std::collections::BTreeMap;

use super::labels::heaviest;
use super::nearest::{Nearest, center, radius};
use super::samples::Sample;
use super::vertices::mixed;
use super::{LEAST, all};
use crate::error::Result;
use crate::mesh::vector::{Vec3, add, norm, scale, sub};
use crate::mesh::{TriangleMesh, barycentric, closest};
use crate::monitor::{collect_in_parts, is_wanted, room_for};

/// Triangles are near a quad if their boxes are within so many distances from its center to its farthest corner.
const NEAR: f64 = 1.25;

/// How far a corner is moved towards the center of its quad, of two triangles as close to it to tell the one beneath
/// the quad.
const INWARD: f64 = 0.1;

/// Distances that differ by less than this part of the size of the quad are equal.
const TIE: f64 = 1e-9;

pub(super) fn interpolated(
    nearest: &Nearest,
    samples: &[Vec<Sample>],
    components: usize,
    values: &[f64],
) -> Result<Vec<f64>> {
    let mesh = nearest.mesh;
    room_for("seams of the mesh", mesh.face_count(), 3)?;
    let value = |face: usize, corner: usize| {
        let first = components * (3 * face + corner % 3);
        &values[first..first + components]
    };
    let seams = Seams::of(mesh, value);
    let faces = all(collect_in_parts(nearest.faces.len(), LEAST, |face| {
        is_wanted()?;
        let corners = nearest.corners(face);
        let patch = patch(mesh, &seams, &samples[face], &corners);
        let mut found = Vec::with_capacity(components * corners.len());
        for &p in &corners {
            let (triangle, point) = place(mesh, &patch, p, &corners);
            let weights = barycentric(mesh.corner_positions(triangle), point);
            let of = |k: usize| [0, 1, 2].map(|corner| value(triangle, corner)[k]);
            found.extend((0..components).map(|k| mixed(weights, of(k))));
        }
        Ok(found)
    }))?;
    Ok(faces.concat())
}

/// Whether the two sides of an edge differ.
struct Seams(Vec<[bool; 3]>);

impl Seams {
    fn of<'v>(mesh: &TriangleMesh, value: impl Fn(usize, usize) -> &'v [f64] + Sync) -> Self {
        let has_none = |face: usize| (0..3).any(|k| value(face, k).iter().any(|x| x.is_nan()));
        let is_seam = |face: usize, k: usize| {
            let Some((other, j)) = mesh.neighbor(face, k) else {
                return true;
            };
            match [face, other].map(has_none) {
                [false, false] => {
                    let here = [value(face, k), value(face, k + 1)];
                    here != [value(other, j + 1), value(other, j)]
                }
                [one, two] => one != two,
            }
        };
        let of_face = |face: usize| [0, 1, 2].map(|k| is_seam(face, k));
        Seams(collect_in_parts(mesh.face_count(), 1 << 12, of_face))
    }
}

/// The triangles beneath and near a face of the quads on one side of the seams, in increasing order.
fn patch(mesh: &TriangleMesh, seams: &Seams, samples: &[Sample], corners: &[Vec3]) -> Vec<usize> {
    let (center, reach) = (center(corners), NEAR * radius(corners));
    let is_near = |face: usize| box_distance(mesh.corner_positions(face), center) <= reach;
    // Each triangle that was found, with the lowest triangle beneath a sample from which it was.
    let mut seeds: Vec<usize> = samples.iter().map(|s| s.triangle as usize).collect();
    seeds.sort_unstable();
    seeds.dedup();
    let mut patch_of = BTreeMap::new();
    for &seed in &seeds {
        let mut open = vec![seed];
        while let Some(face) = open.pop() {
            if patch_of.contains_key(&face) {
                continue;
            }
            patch_of.insert(face, seed as u32);
            let across = (0..3).filter(|&k| !seams.0[face][k]);
            let others = across.filter_map(|k| mesh.neighbor(face, k));
            open.extend(
                others
                    .map(|(other, _)| other)
                    .filter(|&other| is_near(other)),
            );
        }
    }
    let areas = samples.iter();
    let best = heaviest(areas.map(|s| (patch_of[&(s.triangle as usize)], s.area)));
    let members = patch_of.into_iter().filter(|&(_, seed)| seed == best);
    members.map(|(face, _)| face).collect()
}

/// The closest triangle of a patch to a corner of a face, and the point. Of triangles as close that towards the center
/// of the face is taken, so that a corner where a seam ends has the value of the face's side.
fn place(mesh: &TriangleMesh, patch: &[usize], p: Vec3, corners: &[Vec3]) -> (usize, Vec3) {
    let inside = add(scale(p, 1.0 - INWARD), scale(center(corners), INWARD));
    let tie = TIE * radius(corners);
    let closest_in = |face: usize, q: Vec3| closest(mesh.corner_positions(face), q);
    let inward = |face: usize| norm(sub(closest_in(face, inside), inside));
    let mut best: Option<(usize, Vec3)> = None;
    let mut least = f64::INFINITY;
    for &face in patch {
        if box_distance(mesh.corner_positions(face), p) > least + tie {
            continue;
        }
        let point = closest_in(face, p);
        let near = norm(sub(point, p));
        let is_better = match best {
            Some(_) if near > least + tie => false,
            Some((other, _)) if near >= least - tie => inward(face) < inward(other),
            _ => true,
        };
        if is_better {
            (best, least) = (Some((face, point)), near);
        }
    }
    // A patch has a triangle.
    best.unwrap_or((0, p))
}

/// The distance of a point from the bounding box of a triangle.
fn box_distance(triangle: [Vec3; 3], p: Vec3) -> f64 {
    let off = |k: usize| {
        let [a, b, c] = triangle.map(|corner| corner[k]);
        let (low, high) = (a.min(b).min(c), a.max(b).max(c));
        (low - p[k]).max(p[k] - high).max(0.0)
    };
    norm([0, 1, 2].map(off))
}
