//! The second fundamental form of a face from the normals at its corners.
//!
//! `rusinkiewicz2004`, section 3.1: along every edge e of the face the form times e should be the
//! difference of the normals at its ends. Three edges give two equations each for three unknowns, which
//! are solved in the least-squares sense. Normals at vertices are those of `max1999`, which are exact
//! where the neighbours lie on a sphere.

use super::LEAST;
use crate::mesh::TriangleMesh;
use crate::mesh::vector::{Vec3, add, cross, dot, normalize, scale, sub};
use crate::monitor::collect_in_parts;

/// A symmetric tensor in a face's frame: k(t) = mean + deviator . (cos 2t, sin 2t).
#[derive(Debug, Clone, Copy)]
pub(super) struct Tensor {
    pub(super) mean: f64,
    pub(super) deviator: [f64; 2],
}

impl Tensor {
    pub(super) fn plus(self, other: Tensor) -> Tensor {
        Tensor {
            mean: self.mean + other.mean,
            deviator: [0, 1].map(|i| self.deviator[i] + other.deviator[i]),
        }
    }

    pub(super) fn scaled(self, s: f64) -> Tensor {
        Tensor {
            mean: s * self.mean,
            deviator: self.deviator.map(|x| s * x),
        }
    }

    /// The deviator turned by the angle whose cosine and sine these are.
    pub(super) fn turned(self, [cos, sin]: [f64; 2]) -> Tensor {
        let [x, y] = self.deviator;
        Tensor {
            mean: self.mean,
            deviator: [cos * x - sin * y, sin * x + cos * y],
        }
    }
}

/// The tensors of all faces from the normals at vertices.
pub(super) fn face_tensors(mesh: &TriangleMesh, normals: &[Vec3]) -> Vec<Tensor> {
    collect_in_parts(mesh.face_count(), LEAST, |face| {
        let [x, y] = mesh.frame(face);
        let (p, n) = (
            mesh.corner_positions(face),
            mesh.corners(face).map(|v| normals[v]),
        );
        let edges = [0, 1, 2].map(|k| {
            let (edge, change) = (sub(p[(k + 1) % 3], p[k]), sub(n[(k + 1) % 3], n[k]));
            [dot(edge, x), dot(edge, y), dot(change, x), dot(change, y)]
        });
        fit(&edges)
    })
}

/// Least squares of [a b; b c] (s, t) = (ds, dt) over rows [s, t, ds, dt].
///
/// With A = sum s^2, B = sum s t, C = sum t^2 the normal equations are
/// (A, B, 0; B, A + C, B; 0, B, C); their determinant is (A + C)(A C - B^2), positive for a face
/// with an area.
fn fit(rows: &[[f64; 4]; 3]) -> Tensor {
    let sum = |term: fn(&[f64; 4]) -> f64| rows.iter().map(term).sum::<f64>();
    let (ss, st, tt) = (
        sum(|r| r[0] * r[0]),
        sum(|r| r[0] * r[1]),
        sum(|r| r[1] * r[1]),
    );
    let right = [
        sum(|r| r[0] * r[2]),
        sum(|r| r[1] * r[2] + r[0] * r[3]),
        sum(|r| r[1] * r[3]),
    ];
    let trace = ss + tt;
    let area = ss * tt - st * st;
    if area <= 0.0 {
        return Tensor {
            mean: 0.0,
            deviator: [0.0; 2],
        };
    }
    let det = trace * area;
    let a = ((trace * tt - st * st) * right[0] - st * tt * right[1] + st * st * right[2]) / det;
    let b = (-st * tt * right[0] + ss * tt * right[1] - ss * st * right[2]) / det;
    let c = (st * st * right[0] - ss * st * right[1] + (ss * trace - st * st) * right[2]) / det;
    Tensor {
        mean: 0.5 * (a + c),
        deviator: [0.5 * (a - c), b],
    }
}

/// The normals at vertices, as long as `go_on` does not end it.
pub(super) fn vertex_normals<E>(
    mesh: &TriangleMesh,
    go_on: impl Fn() -> Result<(), E>,
) -> Result<Vec<Vec3>, E> {
    let at_corners = collect_in_parts(mesh.face_count(), LEAST, |face| {
        let p = mesh.corner_positions(face);
        [0, 1, 2].map(|k| {
            let (to_next, to_last) = (sub(p[(k + 1) % 3], p[k]), sub(p[(k + 2) % 3], p[k]));
            let weight = 1.0 / (dot(to_next, to_next) * dot(to_last, to_last));
            scale(cross(to_next, to_last), weight)
        })
    });
    go_on()?;
    let mut normals = vec![[0.0; 3]; mesh.vertex_count()];
    for (face, at_corners) in at_corners.into_iter().enumerate() {
        for (v, normal) in mesh.corners(face).into_iter().zip(at_corners) {
            normals[v] = add(normals[v], normal);
        }
    }
    go_on()?;
    Ok(collect_in_parts(normals.len(), LEAST, |v| {
        normalize(normals[v])
    }))
}
