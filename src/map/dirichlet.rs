//! The deviation of gradients from their targets, as a quadratic form in the vertices.
//!
//! On a triangle, area |g|^2 is the sum over its edges of w_k (g . e_k)^2 with w_k half the
//! cotangent of the opposite angle (`pinkall1993`), and a gradient times an edge is a difference of
//! two values. With the target X of the gradient,
//!
//! ```text
//! area |grad u - X|^2 = sum over edges (a, b) of w_k (u_b - u_a - X . e_k)^2
//! ```
//!
//! A triangle with hardly any height would have weights beyond what rounding allows next to those of
//! the others: the form would lose its definiteness. Such a triangle counts with a smaller area.
//!
//! The sums are formed here, with one entry for each edge and each vertex: least-squares rows for every
//! triangle would need three times the memory to form the matrix.

use super::CutGraph;
use super::sectors::Sectors;
use crate::error::Result;
use crate::mesh::TriangleMesh;
use crate::mesh::vector::{Vec3, cotangent, cross, dot, norm, sub};
use crate::monitor::{both, collect_if_wanted, may_continue, may_continue_at};
use crate::problem::{Problem, Triangle};

/// The least number of faces that are worth a thread.
const LEAST: usize = 1 << 12;

/// The least height of a triangle, over its longest edge, that counts in full: weights stay below a
/// million times those of a right angle, which leaves half of the digits of the others.
const THINNEST: f64 = 1e-6;

/// The factor of the weights of a triangle: 1, and less only for one with hardly any height.
fn relief(corners: [Vec3; 3]) -> f64 {
    let sides = [0, 1, 2].map(|k| sub(corners[(k + 1) % 3], corners[k]));
    let longest = sides.iter().map(|s| dot(*s, *s)).fold(0.0, f64::max);
    let doubled_area = norm(cross(sides[0], sides[1]));
    (doubled_area / (THINNEST * longest)).min(1.0)
}

/// Matrix, linear term and constant for the two coordinates of all copies.
pub(super) struct Dirichlet {
    /// Sum of weights around every copy.
    diagonal: Vec<f64>,
    /// Two copies and the weight between them.
    pairs: Vec<([u32; 2], f64)>,
    pub(super) linear: Vec<f64>,
    pub(super) constant: f64,
}

impl Dirichlet {
    /// The energy whose gradients aim at `targets` of every face, as a form in `unknowns` values.
    pub(super) fn new(
        mesh: &TriangleMesh,
        sectors: &Sectors,
        cut: &CutGraph,
        unknowns: usize,
        targets: impl Fn(usize) -> [Vec3; 2] + Sync,
    ) -> Result<Self> {
        // By local edge, the weight and how far its ends are to be apart.
        let edges: Vec<OfEdges> = collect_if_wanted(mesh.face_count(), LEAST, |face| {
            let targets = targets(face);
            let corners = mesh.corner_positions(face);
            let relief = relief(corners);
            [0, 1, 2].map(|k| {
                let [a, b, c] = [0, 1, 2].map(|i| corners[(k + i) % 3]);
                let weight = relief * 0.5 * cotangent(sub(a, c), sub(b, c));
                (weight, targets.map(|target| dot(target, sub(b, a))))
            })
        })?;
        let (sums, pairs) = both(
            mesh.face_count() >= LEAST,
            || Sums::new(sectors, unknowns, &edges),
            || pairs(mesh, sectors, cut, &edges),
        );
        let Sums {
            diagonal,
            linear,
            constant,
        } = sums?;
        Ok(Dirichlet {
            diagonal,
            pairs: pairs?,
            linear,
            constant,
        })
    }

    pub(super) fn add_to(&self, problem: &mut Problem) -> Result<()> {
        let count = 2 * (self.diagonal.len() + self.pairs.len());
        let mut rows = Vec::with_capacity(count);
        let mut cols = Vec::with_capacity(count);
        let mut values = Vec::with_capacity(count);
        let mut add = |i: usize, j: usize, value: f64| {
            for axis in 0..2 {
                rows.push(2 * i.max(j) + axis);
                cols.push(2 * i.min(j) + axis);
                values.push(2.0 * value);
            }
        };
        may_continue()?;
        for (i, &weight) in self.diagonal.iter().enumerate() {
            add(i, i, weight);
        }
        for &([a, b], weight) in &self.pairs {
            add(a as usize, b as usize, -weight);
        }
        may_continue()?;
        problem.add_quadratic_triplets(Triangle::Lower, &rows, &cols, &values)?;
        problem.add_linear(&self.linear)?;
        problem.add_constant(self.constant)
    }
}

/// What each local edge of a face adds: its weight, and how far its ends are to be apart.
type OfEdges = [(f64, [f64; 2]); 3];

/// What is summed over the edges of all faces, in their order.
struct Sums {
    diagonal: Vec<f64>,
    linear: Vec<f64>,
    constant: f64,
}

impl Sums {
    fn new(sectors: &Sectors, unknowns: usize, edges: &[OfEdges]) -> Result<Self> {
        let mut sum = Sums {
            diagonal: vec![0.0; sectors.count()],
            linear: vec![0.0; unknowns],
            constant: 0.0,
        };
        for (face, edges) in edges.iter().enumerate() {
            may_continue_at(face)?;
            let copy = sectors.copy[face];
            for (k, &(weight, aims)) in edges.iter().enumerate() {
                sum.add_edge([copy[k], copy[(k + 1) % 3]], weight, aims);
            }
        }
        Ok(sum)
    }

    fn add_edge(&mut self, [a, b]: [u32; 2], weight: f64, aims: [f64; 2]) {
        let [a, b] = [a as usize, b as usize];
        self.diagonal[a] += weight;
        self.diagonal[b] += weight;
        for (axis, aim) in aims.into_iter().enumerate() {
            self.linear[2 * a + axis] += 2.0 * weight * aim;
            self.linear[2 * b + axis] -= 2.0 * weight * aim;
            self.constant += weight * aim * aim;
        }
    }
}

/// The pairs of copies, and the weight between them.
fn pairs(
    mesh: &TriangleMesh,
    sectors: &Sectors,
    cut: &CutGraph,
    edges: &[OfEdges],
) -> Result<Vec<([u32; 2], f64)>> {
    let mut pairs = Vec::with_capacity(mesh.edge_count() + 1000);
    // The weight of an edge that is not cut waits here for its second face.
    let mut pending = vec![0.0; mesh.edge_count()];
    for (face, edges) in edges.iter().enumerate() {
        may_continue_at(face)?;
        let copy = sectors.copy[face];
        for (k, &(weight, _)) in edges.iter().enumerate() {
            let ends = [copy[k], copy[(k + 1) % 3]];
            let e = mesh.edge_of(face, k);
            let waits = mesh.is_first_side(face, k) && mesh.neighbor(face, k).is_some();
            if cut.contains(e) {
                pairs.push((ends, weight));
            } else if waits {
                pending[e] = weight;
            } else {
                pairs.push((ends, weight + pending[e]));
            }
        }
    }
    Ok(pairs)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_triangles_with_hardly_any_height_weigh_less() {
        let of_height = |h: f64| relief([[0.0; 3], [1.0, 0.0, 0.0], [0.4, h, 0.0]]);
        assert_eq!([1.0, 1e-3, 2e-6].map(of_height), [1.0; 3]);
        let weight = |h: f64| of_height(h) * 0.5 * cotangent([1.0, 0.0, 0.0], [0.4, h, 0.0]);
        assert!(of_height(1e-9) < 2e-3);
        assert!(
            [1e-6, 1e-9, 1e-11]
                .map(weight)
                .iter()
                .all(|w| w.abs() < 1e6)
        );
    }
}
