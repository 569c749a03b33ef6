//! The distortion energy of a triangle, and its convex quadratic form for Newton's method.
//!
//! `garanzha2021`, equations (2) to (4), in the plane:
//!
//! ```text
//! psi(J) = (tr J'J + lambda (det^2 + 1)) / chi(det),    chi(d) = (d + sqrt(eps^2 + d^2)) / 2
//! ```
//!
//! chi is positive everywhere, so that a folded triangle has a finite energy. As eps goes to 0, chi
//! tends to max(d, 0), so that a triangle that is not folded can never fold. The Hessian is
//! projected to a positive definite one by its eigensystem in closed form (`smith2019`, section 4):
//! the conformal part p and the anticonformal part q of J have `tr J'J = |p|^2 + |q|^2` and
//! `2 det = |p|^2 - |q|^2`, so that psi is a function of these two squares alone.

use std::f64::consts::FRAC_1_SQRT_2;

use crate::mesh::turned;

/// lambda, the weight of the area relative to the angles. The paper's examples have 1/128 to 1.
const AREA_WEIGHT: f64 = 1.0;

/// The least eigenvalue of a projected Hessian: every direction has a cost.
const LEAST_CURVATURE: f64 = 1e-6;

/// The triangle in the plane that is the target of a face.
#[derive(Debug, Clone, Copy)]
pub(super) struct Rest {
    /// Gradients of the three hat functions.
    pub gradients: [[f64; 2]; 3],
    /// The weight of the triangle: the square root of its area. With the area as weight, small triangles
    /// would stay folded until eps is small. With equal weights, fine parts of a mesh would dominate.
    pub weight: f64,
}

/// The conformal (first two entries) and the anticonformal part of a linear map.
type Parts = [f64; 4];

/// Value, slope and projected Hessian in the six coordinates of a face: u and v of each corner.
pub(super) struct Quadratic {
    pub slope: [f64; 6],
    pub hessian: [[f64; 6]; 6],
}

impl Quadratic {
    pub const ZERO: Quadratic = Quadratic {
        slope: [0.0; 6],
        hessian: [[0.0; 6]; 6],
    };
}

impl Rest {
    /// From the corners of the triangle, counter-clockwise, in the plane.
    pub fn new([a, b, c]: [[f64; 2]; 3]) -> Self {
        let doubled = (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
        let gradient =
            |p: [f64; 2], q: [f64; 2]| [(p[1] - q[1]) / doubled, (q[0] - p[0]) / doubled];
        Rest {
            gradients: [gradient(b, c), gradient(c, a), gradient(a, b)],
            weight: (0.5 * doubled).sqrt(),
        }
    }

    fn parts(&self, uv: &[[f64; 2]; 3]) -> Parts {
        let mut parts = [0.0; 4];
        for ([gx, gy], [u, v]) in self.gradients.iter().zip(uv) {
            parts[0] += gx * u + gy * v;
            parts[1] += gx * v - gy * u;
            parts[2] += gx * u - gy * v;
            parts[3] += gx * v + gy * u;
        }
        parts.map(|x| FRAC_1_SQRT_2 * x)
    }

    /// The signed area of the triangle in the map, relative to its area at rest; negative where it is
    /// folded.
    pub fn determinant(&self, uv: &[[f64; 2]; 3]) -> f64 {
        determinant(&self.parts(uv))
    }

    /// The energy.
    pub fn energy(&self, uv: &[[f64; 2]; 3], eps: f64) -> f64 {
        let parts = self.parts(uv);
        let d = determinant(&parts);
        let norm: f64 = parts.iter().map(|x| x * x).sum();
        self.weight * (norm + AREA_WEIGHT * (d * d + 1.0)) / chi(d, eps)
    }

    /// The energy to second order, convex.
    pub fn quadratic(&self, uv: &[[f64; 2]; 3], eps: f64) -> Quadratic {
        let parts = self.parts(uv);
        let (slope, hessian) = in_parts(&parts, eps);
        // Each part is a linear function of the six coordinates.
        let rows: [[f64; 6]; 4] = self.rows();
        let mut sum = Quadratic::ZERO;
        for i in 0..6 {
            sum.slope[i] = (0..4).map(|a| self.weight * rows[a][i] * slope[a]).sum();
            let column: [f64; 4] =
                std::array::from_fn(|a| (0..4).map(|b| hessian[a][b] * rows[b][i]).sum());
            for j in 0..6 {
                let product: f64 = (0..4).map(|a| rows[a][j] * column[a]).sum();
                sum.hessian[j][i] = self.weight * product;
            }
        }
        sum
    }

    fn rows(&self) -> [[f64; 6]; 4] {
        let mut rows = [[0.0; 6]; 4];
        for (k, &[gx, gy]) in self.gradients.iter().enumerate() {
            let (u, v) = (2 * k, 2 * k + 1);
            (rows[0][u], rows[0][v]) = (gx, gy);
            (rows[1][u], rows[1][v]) = (-gy, gx);
            (rows[2][u], rows[2][v]) = (gx, -gy);
            (rows[3][u], rows[3][v]) = (gy, gx);
        }
        rows.map(|row| row.map(|x| FRAC_1_SQRT_2 * x))
    }
}

fn determinant(parts: &Parts) -> f64 {
    let [a, b, c, d] = parts.map(|x| x * x);
    0.5 * ((a + b) - (c + d))
}

/// chi(d), without the cancellation of its formula for negative d.
fn chi(d: f64, eps: f64) -> f64 {
    let root = eps.hypot(d);
    match d >= 0.0 {
        true => 0.5 * (root + d),
        false => 0.5 * eps * eps / (root - d),
    }
}

/// Slope and projected Hessian in the parts.
fn in_parts(parts: &Parts, eps: f64) -> ([f64; 4], [[f64; 4]; 4]) {
    let d = determinant(parts);
    let norm: f64 = parts.iter().map(|x| x * x).sum();
    // s = 1/chi with its derivatives: chi' = chi / root, as chi grows by (1 + d / root) / 2.
    let root = eps.hypot(d);
    let s = 1.0 / chi(d, eps);
    let s1 = -s / root;
    let s2 = s / (root * root) * (1.0 + d / root);
    let area = d * d + 1.0;
    let (r1, r2) = (2.0 * d * s + area * s1, 2.0 * s + 4.0 * d * s1 + area * s2);
    let bend = 0.5 * (norm * s1 + AREA_WEIGHT * r1);
    let twist = 0.25 * (norm * s2 + AREA_WEIGHT * r2);
    // First and second derivatives by the squares P and Q.
    let (by_p, by_q) = (s + bend, s - bend);
    let (by_pp, by_pq, by_qq) = (s1 + twist, -twist, twist - s1);

    let slope = [0, 1, 2, 3].map(|i| 2.0 * if i < 2 { by_p } else { by_q } * parts[i]);
    let (p, p_hat) = direction([parts[0], parts[1]]);
    let (q, q_hat) = direction([parts[2], parts[3]]);
    let mut hessian = [[0.0; 4]; 4];
    let mut add = |value: f64, v: [f64; 4]| {
        let value = value.max(LEAST_CURVATURE);
        for i in 0..4 {
            for j in 0..4 {
                hessian[i][j] += value * v[i] * v[j];
            }
        }
    };
    add(2.0 * by_p, [-p_hat[1], p_hat[0], 0.0, 0.0]);
    add(2.0 * by_q, [0.0, 0.0, -q_hat[1], q_hat[0]]);
    let a = 2.0 * by_p + 4.0 * p * p * by_pp;
    let b = 4.0 * p * q * by_pq;
    let c = 2.0 * by_q + 4.0 * q * q * by_qq;
    for (value, [x, y]) in eigen(a, b, c) {
        add(
            value,
            [x * p_hat[0], x * p_hat[1], y * q_hat[0], y * q_hat[1]],
        );
    }
    (slope, hessian)
}

/// Length and direction; any direction for the null vector.
fn direction(v: [f64; 2]) -> (f64, [f64; 2]) {
    let length = v[0].hypot(v[1]);
    match length > 0.0 {
        true => (length, [v[0] / length, v[1] / length]),
        false => (0.0, [1.0, 0.0]),
    }
}

/// Eigenvalues and unit eigenvectors of the matrix with rows (a, b) and (b, c).
fn eigen(a: f64, b: f64, c: f64) -> [(f64, [f64; 2]); 2] {
    let angle = 0.5 * (2.0 * b).atan2(a - c);
    let (y, x) = angle.sin_cos();
    let (mean, half) = (0.5 * (a + c), b.hypot(0.5 * (a - c)));
    [(mean + half, [x, y]), (mean - half, turned(1, [x, y]))]
}

#[cfg(test)]
mod tests {
    use super::*;

    const REST: [[f64; 2]; 3] = [[0.1, 0.0], [1.3, 0.2], [0.4, 0.9]];
    const SHAPES: [[[f64; 2]; 3]; 4] = [
        REST,
        [[0.0, 0.0], [2.0, 0.3], [0.1, 0.4]],
        [[0.0, 0.0], [0.3, 2.0], [1.4, 0.1]],
        [[0.0, 0.0], [1.0, 1.0], [2.0, 2.0]],
    ];

    #[test]
    fn the_slope_is_that_of_the_energy() {
        for uv in SHAPES {
            for eps in [1.0, 0.1] {
                let rest = Rest::new(REST);
                let slope = rest.quadratic(&uv, eps).slope;
                for i in 0..6 {
                    let at = |step: f64| {
                        let mut moved = uv;
                        moved[i / 2][i % 2] += step;
                        rest.energy(&moved, eps)
                    };
                    let difference = (at(1e-6) - at(-1e-6)) / 2e-6;
                    let error = (difference - slope[i]).abs();
                    assert!(error < 1e-6 * (1.0 + slope[i].abs()), "{i}: {error:e}");
                }
            }
        }
    }

    #[test]
    fn the_hessian_is_that_of_the_energy_where_it_is_convex() {
        // Larger than at rest in all directions: turning costs too, and nothing is cut off.
        let rest = Rest::new(REST);
        for (uv, eps) in [(1.2, 1e-3), (1.3, 0.1), (1.5, 1.0)].map(|(scale, eps)| {
            let bent = |i: usize, x: f64| scale * x + 0.01 * i as f64;
            let uv = [0, 1, 2].map(|i| REST[i].map(|x| bent(i, x)));
            (uv, eps)
        }) {
            let hessian = rest.quadratic(&uv, eps).hessian;
            for j in 0..6 {
                let slope = |step: f64| {
                    let mut moved = uv;
                    moved[j / 2][j % 2] += step;
                    rest.quadratic(&moved, eps).slope
                };
                let (up, down) = (slope(1e-5), slope(-1e-5));
                for i in 0..6 {
                    let difference = (up[i] - down[i]) / 2e-5;
                    let error = (difference - hessian[i][j]).abs();
                    assert!(error < 1e-7, "{i} {j}: {error:e}");
                }
            }
        }
    }

    /// The Hessian by differences of the slope, its eigenvalues by rotations (Jacobi 1846) made no
    /// smaller than the least that is kept; and how many of them were.
    fn projected_differences(parts: &Parts, eps: f64) -> ([[f64; 4]; 4], usize) {
        let slope = |k: usize, step: f64| {
            let mut moved = *parts;
            moved[k] += step;
            in_parts(&moved, eps).0
        };
        let step = 1e-4 * eps.min(1.0);
        let columns = [0, 1, 2, 3].map(|k| {
            let at = [-2.0, -1.0, 1.0, 2.0].map(|n| slope(k, n * step));
            [0, 1, 2, 3]
                .map(|i| (at[0][i] - 8.0 * at[1][i] + 8.0 * at[2][i] - at[3][i]) / (12.0 * step))
        });
        let mut a =
            [0, 1, 2, 3].map(|i| [0, 1, 2, 3].map(|j| 0.5 * (columns[i][j] + columns[j][i])));
        let mut vectors = [0, 1, 2, 3].map(|i| [0, 1, 2, 3].map(|j| f64::from(u8::from(i == j))));
        for _ in 0..20 {
            for (p, q) in [(0, 1), (0, 2), (0, 3), (1, 2), (1, 3), (2, 3)] {
                let angle = 0.5 * (2.0 * a[p][q]).atan2(a[q][q] - a[p][p]);
                let (s, c) = angle.sin_cos();
                for row in a.iter_mut().chain(vectors.iter_mut()) {
                    (row[p], row[q]) = (c * row[p] - s * row[q], s * row[p] + c * row[q]);
                }
                for j in 0..4 {
                    (a[p][j], a[q][j]) = (c * a[p][j] - s * a[q][j], s * a[p][j] + c * a[q][j]);
                }
            }
        }
        let value = |k: usize| a[k][k].max(LEAST_CURVATURE);
        let entry = |i: usize, j: usize| {
            let term = |k: usize| value(k) * vectors[i][k] * vectors[j][k];
            (0..4).map(term).sum()
        };
        let is_raised = |&k: &usize| a[k][k] < LEAST_CURVATURE;
        let raised = (0..4).filter(is_raised).count();
        let projected = [0, 1, 2, 3].map(|i| [0, 1, 2, 3].map(|j| entry(i, j)));
        (projected, raised)
    }

    #[test]
    fn the_hessian_is_that_of_the_energy_without_what_curves_downwards() {
        let mut raised_of = Vec::new();
        for uv in SHAPES {
            for eps in [1.0, 0.1, 1e-2] {
                let parts = Rest::new(REST).parts(&uv);
                let found = in_parts(&parts, eps).1;
                let (expected, raised) = projected_differences(&parts, eps);
                let size = (0..4).map(|i| expected[i][i]).fold(0.0, f64::max);
                for i in 0..4 {
                    for j in 0..4 {
                        let error = (found[i][j] - expected[i][j]).abs();
                        assert!(error < 1e-7 * size, "{uv:?} {eps} {i} {j}: {error:e}");
                    }
                }
                raised_of.push(raised);
            }
        }
        assert!(
            raised_of.contains(&0) && raised_of.contains(&2),
            "{raised_of:?}"
        );
    }

    #[test]
    fn the_hessian_never_curves_downwards() {
        for uv in SHAPES {
            for eps in [1.0, 1e-2, 1e-4] {
                let hessian = Rest::new(REST).quadratic(&uv, eps).hessian;
                for seed in 0..40 {
                    let v: [f64; 6] = std::array::from_fn(|i| f64::from(seed * 7 + i as i32).sin());
                    let product = |i: usize| (0..6).map(|j| hessian[i][j] * v[j]).sum::<f64>();
                    let (mut curvature, mut size) = (0.0, 0.0);
                    for i in 0..6 {
                        curvature += v[i] * product(i);
                        size += hessian[i][i];
                    }
                    assert!(curvature > -1e-12 * size, "{curvature:e}");
                }
            }
        }
    }

    #[test]
    fn a_triangle_at_rest_is_at_the_least_energy() {
        let rest = Rest::new(REST);
        let at_rest = rest.energy(&REST, 1e-9);
        assert!((rest.determinant(&REST) - 1.0).abs() < 1e-14);
        for uv in &SHAPES[1..] {
            assert!(rest.energy(uv, 1e-9) > at_rest);
        }
    }
}
