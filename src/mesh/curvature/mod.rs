//! Principal curvatures and directions of every face, smoothed.
//!
//! The tensor of each face (`rusinkiewicz2004`) is averaged with those of its neighbours, weighted
//! by area, in several rounds. A neighbour's tensor is first turned into the face's frame by
//! unfolding over the common edge, as directions are everywhere in the library; a symmetric tensor
//! is its mean and a deviator that turns by twice the angle.

mod face_tensor;

use std::convert::Infallible;

use super::TriangleMesh;
use crate::monitor::{Stop, collect_in_parts, may_continue, span};
use face_tensor::{Tensor, face_tensors, vertex_normals};

/// The least number of faces or edges that are worth a thread.
const LEAST: usize = 1 << 12;

/// Rounds of averaging that [`curvature`] does: a radius of about two edge lengths.
pub const SMOOTHING_ROUNDS: usize = 4;

/// Curvatures of the faces of a mesh. Positive where the surface bends away from its normal, as
/// a sphere seen from outside does.
#[derive(Debug, Clone, PartialEq)]
pub struct Curvature {
    /// For each face the principal curvature of larger magnitude.
    pub k1: Vec<f64>,
    /// For each face the principal curvature of smaller magnitude.
    pub k2: Vec<f64>,
    /// For each face the direction of `k2`, the least |curvature|: its angle from the face's
    /// first edge, counter-clockwise, in (-pi/2, pi/2].
    pub direction: Vec<f64>,
}

impl Curvature {
    /// How well the direction of a face is determined: | |k1| - |k2| |.
    pub fn reliability(&self, face: usize) -> f64 {
        self.k1[face].abs() - self.k2[face].abs()
    }

    /// The `count` faces with the most reliable directions, or all if there are fewer; of equals the lower ones. In
    /// increasing order.
    pub fn most_reliable(&self, count: usize) -> Vec<usize> {
        let all = 0..self.k1.len();
        if count >= all.len() {
            return all.collect();
        }
        let mut faces: Vec<(f64, usize)> = all.map(|face| (self.reliability(face), face)).collect();
        faces.select_nth_unstable_by(count, |a, b| b.0.total_cmp(&a.0).then(a.1.cmp(&b.1)));
        let mut faces: Vec<usize> = faces[..count].iter().map(|&(_, face)| face).collect();
        faces.sort_unstable();
        faces
    }
}

/// Curvatures smoothed by [`SMOOTHING_ROUNDS`].
pub fn curvature(mesh: &TriangleMesh) -> Curvature {
    smoothed_curvature(mesh, SMOOTHING_ROUNDS)
}

/// Curvatures smoothed by this many rounds; with 0 each face stands for itself.
pub fn smoothed_curvature(mesh: &TriangleMesh, rounds: usize) -> Curvature {
    let Ok(found) = smoothed(mesh, rounds, || Ok::<(), Infallible>(()));
    found
}

/// As [`smoothed_curvature`].
///
/// # Errors
/// The end of the call.
pub(crate) fn watched_curvature(mesh: &TriangleMesh, rounds: usize) -> Result<Curvature, Stop> {
    smoothed(mesh, rounds, may_continue)
}

/// [`smoothed_curvature`], as long as `go_on` does not end it.
fn smoothed<E>(
    mesh: &TriangleMesh,
    rounds: usize,
    go_on: impl Fn() -> Result<(), E>,
) -> Result<Curvature, E> {
    let _span = span("curvature");
    go_on()?;
    let normals = vertex_normals(mesh, &go_on)?;
    let tensors = face_tensors(mesh, &normals);
    go_on()?;
    let tensors = smooth(mesh, tensors, rounds, &go_on)?;
    let mut found = Curvature {
        k1: Vec::with_capacity(tensors.len()),
        k2: Vec::with_capacity(tensors.len()),
        direction: Vec::with_capacity(tensors.len()),
    };
    let all = collect_in_parts(tensors.len(), LEAST, |face| principal(&tensors[face]));
    for [k1, k2, direction] in all {
        found.k1.push(k1);
        found.k2.push(k2);
        found.direction.push(direction);
    }
    Ok(found)
}

fn smooth<E>(
    mesh: &TriangleMesh,
    mut tensors: Vec<Tensor>,
    rounds: usize,
    go_on: impl Fn() -> Result<(), E>,
) -> Result<Vec<Tensor>, E> {
    if rounds == 0 {
        return Ok(tensors);
    }
    let area = collect_in_parts(mesh.face_count(), LEAST, |face| mesh.area(face));
    // What a deviator is multiplied by over an edge: cosine and sine of twice the turn.
    go_on()?;
    let transports = mesh.transports();
    go_on()?;
    let turn = collect_in_parts(mesh.edge_count(), LEAST, |e| {
        let (sin, cos) = (-2.0 * transports[e]).sin_cos();
        [cos, sin]
    });
    let smoothed = |tensors: &[Tensor], face: usize| {
        let mut total = area[face];
        let mut sum = tensors[face].scaled(area[face]);
        for k in 0..3 {
            let Some((across, _)) = mesh.neighbor(face, k) else {
                continue;
            };
            let [cos, sin] = turn[mesh.edge_of(face, k)];
            let turn = [cos, mesh.out_of(face, k, sin)];
            total += area[across];
            sum = sum.plus(tensors[across].turned(turn).scaled(area[across]));
        }
        sum.scaled(1.0 / total)
    };
    for _ in 0..rounds {
        go_on()?;
        tensors = collect_in_parts(tensors.len(), LEAST, |face| smoothed(&tensors, face));
    }
    Ok(tensors)
}

/// k1, k2 and the direction of k2.
fn principal(tensor: &Tensor) -> [f64; 3] {
    use std::f64::consts::{FRAC_PI_2, PI};
    let [cos, sin] = tensor.deviator;
    let spread = cos.hypot(sin);
    let largest = 0.5 * sin.atan2(cos);
    if tensor.mean < 0.0 {
        return [tensor.mean - spread, tensor.mean + spread, largest];
    }
    let across = largest + FRAC_PI_2;
    let across = if across > FRAC_PI_2 {
        across - PI
    } else {
        across
    };
    [tensor.mean + spread, tensor.mean - spread, across]
}

#[cfg(test)]
mod tests;
