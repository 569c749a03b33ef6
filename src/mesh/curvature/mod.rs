//! Principal curvatures and directions of every face, smoothed.
//!
//! The tensor of each face (`rusinkiewicz2004`) is averaged with those of its neighbours, weighted
//! by area, in several rounds. A neighbour's tensor is first turned into the face's frame by
//! unfolding over the common edge, as directions are everywhere in the library; a symmetric tensor
//! is its mean and a deviator that turns by twice the angle.

mod face_tensor;

use super::TriangleMesh;
use face_tensor::{Tensor, face_tensors};

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

    /// All faces, the most reliable direction first; of equals the lower face first.
    pub fn by_reliability(&self) -> Vec<usize> {
        let mut faces: Vec<usize> = (0..self.k1.len()).collect();
        let key = |&f: &usize| self.reliability(f);
        faces.sort_by(|a, b| key(b).total_cmp(&key(a)));
        faces
    }
}

/// Curvatures smoothed by [`SMOOTHING_ROUNDS`].
pub fn curvature(mesh: &TriangleMesh) -> Curvature {
    smoothed_curvature(mesh, SMOOTHING_ROUNDS)
}

/// Curvatures smoothed by this many rounds; with 0 each face stands for itself.
pub fn smoothed_curvature(mesh: &TriangleMesh, rounds: usize) -> Curvature {
    let tensors = smooth(mesh, face_tensors(mesh), rounds);
    let mut found = Curvature {
        k1: Vec::with_capacity(tensors.len()),
        k2: Vec::with_capacity(tensors.len()),
        direction: Vec::with_capacity(tensors.len()),
    };
    for tensor in tensors {
        let [k1, k2, direction] = principal(&tensor);
        found.k1.push(k1);
        found.k2.push(k2);
        found.direction.push(direction);
    }
    found
}

/// A face across an edge, and what its deviator is multiplied by: cosine and sine of twice the turn.
#[derive(Clone, Copy)]
struct Beside {
    face: u32,
    turn: [f64; 2],
}

fn smooth(mesh: &TriangleMesh, mut tensors: Vec<Tensor>, rounds: usize) -> Vec<Tensor> {
    if rounds == 0 {
        return tensors;
    }
    let area: Vec<f64> = (0..mesh.face_count()).map(|f| mesh.area(f)).collect();
    let mut beside: Vec<[Option<Beside>; 3]> = vec![[None; 3]; mesh.face_count()];
    for edge in mesh.edges() {
        let ((f, k), Some((g, l))) = (edge.first, edge.second) else {
            continue;
        };
        let (sin, cos) = (-2.0 * mesh.transport(f, k).unwrap_or(0.0)).sin_cos();
        let across = |face: usize, turn| {
            Some(Beside {
                face: face as u32,
                turn,
            })
        };
        beside[f][k] = across(g, [cos, sin]);
        beside[g][l] = across(f, [cos, -sin]);
    }
    let mut before = tensors.clone();
    for _ in 0..rounds {
        std::mem::swap(&mut before, &mut tensors);
        for (f, smoothed) in tensors.iter_mut().enumerate() {
            let mut total = area[f];
            let mut sum = before[f].scaled(area[f]);
            for Beside { face, turn } in beside[f].iter().flatten() {
                let (other, area) = (before[*face as usize], area[*face as usize]);
                total += area;
                sum = sum.plus(other.turned(*turn).scaled(area));
            }
            *smoothed = sum.scaled(1.0 / total);
        }
    }
    tensors
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
