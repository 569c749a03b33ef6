//! Projection of a mesh onto the zero set of a function, with its points spread evenly.

use super::quads::Quads;
use crate::mesh::vector::{Vec3, add, dot, scale, sub};

/// A function, negative inside, whose gradient has about unit length near its zero set.
pub(super) trait Implicit {
    fn value_and_gradient(&self, p: Vec3) -> (f64, Vec3);

    /// `p` after a Newton step along the gradient, and the value before.
    fn step(&self, p: Vec3) -> (Vec3, f64) {
        let (value, gradient) = self.value_and_gradient(p);
        let length = value / dot(gradient, gradient).max(1e-2);
        (sub(p, scale(gradient, length)), value)
    }

    /// The zero near `p`.
    fn project(&self, mut p: Vec3) -> Vec3 {
        for _ in 0..12 {
            let (next, value) = self.step(p);
            p = next;
            if value.abs() < 1e-13 {
                break;
            }
        }
        p
    }
}

/// Projects all points, then in every round moves each half way to the mean of its neighbours,
/// along the surface.
pub(super) fn relax(mesh: &mut Quads, surface: &impl Implicit, rounds: usize) {
    let (start, neighbors) = neighbors(mesh);
    for p in &mut mesh.points {
        *p = surface.project(*p);
    }
    let mut before = mesh.points.clone();
    for _ in 0..rounds {
        std::mem::swap(&mut before, &mut mesh.points);
        for (v, p) in mesh.points.iter_mut().enumerate() {
            let around = &neighbors[start[v] as usize..start[v + 1] as usize];
            let sum = around
                .iter()
                .fold([0.0; 3], |sum, &w| add(sum, before[w as usize]));
            let mean = scale(sum, 1.0 / around.len() as f64);
            // One step keeps it near the surface, which is all that the next round needs.
            *p = surface.step(scale(add(before[v], mean), 0.5)).0;
        }
    }
    for p in &mut mesh.points {
        *p = surface.project(*p);
    }
}

/// Neighbours along edges, each once: those of `v` are `list[start[v]..start[v + 1]]`.
fn neighbors(mesh: &Quads) -> (Vec<u32>, Vec<u32>) {
    let mut start = vec![0u32; mesh.points.len() + 1];
    for v in mesh.quads.as_flattened() {
        start[*v as usize + 1] += 1;
    }
    for v in 0..mesh.points.len() {
        start[v + 1] += start[v];
    }
    let mut next = start.clone();
    let mut list = vec![0; 4 * mesh.quads.len()];
    for q in &mesh.quads {
        // On a closed surface every neighbour is next to v in exactly one quadrangle.
        for k in 0..4 {
            let slot = &mut next[q[k] as usize];
            list[*slot as usize] = q[(k + 1) % 4];
            *slot += 1;
        }
    }
    (start, list)
}
