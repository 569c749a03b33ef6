//! Local stiffening: triangles that a map distorts count more in the next one.
//!
//! Bommes, Zimmer, Kobbelt 2009, section 5.4. With the singular values of the map of a triangle,
//! relative to what they should be, and the sign t of its determinant,
//!
//! ```text
//! lambda = |t sigma1 - 1| + |t sigma2 - 1|,    w += min(c |lap lambda|, d),    c = 1, d = 5
//! ```
//!
//! where lap is the uniform Laplacian over neighbouring triangles. Weights are smoothed afterwards,
//! as a triangle alone resists little.

use super::map::gradient;
use super::{SeamlessMap, SeamlessProblem};
use crate::Result;
use crate::mesh::TriangleMesh;
use crate::mesh::vector::{dot, norm};

/// `c`.
const BY_LAPLACIAN: f64 = 1.0;

/// `d`.
const MOST: f64 = 5.0;

/// Rounds of averaging with the neighbours.
const SMOOTHING: usize = 3;

impl SeamlessProblem {
    /// The same problem with the triangles stiffer that `map` distorts, which is one of it.
    ///
    /// Its solutions have the energy of the weighted sum; that of a [`SeamlessMap`] stays unweighted.
    ///
    /// # Errors
    /// [`LengthMismatch`](crate::Error::LengthMismatch) for the map of another problem or mesh, and
    /// [`OutOfMemory`](crate::Error::OutOfMemory).
    pub fn stiffened(&self, mesh: &TriangleMesh, map: &SeamlessMap) -> Result<Self> {
        self.check_map(mesh, map)?;
        let faces = 0..mesh.face_count();
        let distortion: Vec<f64> = faces
            .clone()
            .map(|face| self.distortion(mesh, map, face))
            .collect();
        let mean = |values: &[f64], face: usize| {
            let beside = (0..3).filter_map(|k| Some(values[mesh.neighbor(face, k)?.0]));
            let (sum, count) = beside.fold((0.0, 0.0), |(s, n), x| (s + x, n + 1.0));
            if count > 0.0 {
                sum / count
            } else {
                values[face]
            }
        };
        let weight = |face: usize| {
            let laplacian = distortion[face] - mean(&distortion, face);
            (BY_LAPLACIAN * laplacian.abs()).min(MOST) + self.stiffness_of(face)
        };
        let mut stiffness: Vec<f64> = faces.clone().map(weight).collect();
        for _ in 0..SMOOTHING {
            let smooth = |face: usize| 0.5 * (stiffness[face] + mean(&stiffness, face));
            stiffness = faces.clone().map(smooth).collect();
        }
        self.with_stiffness(mesh, stiffness)
    }

    /// How far the map of a face is from an isometry to what it should be: 0, if it is one.
    fn distortion(&self, mesh: &TriangleMesh, map: &SeamlessMap, face: usize) -> f64 {
        let uv = map.uv(face);
        let targets = self.targets(mesh, face);
        // The columns of the Jacobian: along each target, by the square of its length.
        let along = |axis: usize| {
            let slope = gradient(mesh, face, uv.map(|corner| corner[axis]));
            targets.map(|target| dot(slope, target) / norm(target).powi(2))
        };
        let [[a, b], [c, d]] = [along(0), along(1)];
        let conformal = (a + d).hypot(c - b);
        let anticonformal = (a - d).hypot(c + b);
        let largest = 0.5 * (conformal + anticonformal);
        let least = 0.5 * (conformal - anticonformal).abs();
        let sign = if conformal < anticonformal { -1.0 } else { 1.0 };
        (sign * largest - 1.0).abs() + (sign * least - 1.0).abs()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mesh::vector::sub;
    use crate::mesh::{jitter, shape};
    use crate::quad::{FieldOptions, SeamlessOptions, solve_field};
    use crate::{Monitor, Options, solve};

    /// The problem of a shape, and its map.
    fn mapped(name: &str, quads: usize) -> (TriangleMesh, SeamlessProblem, SeamlessMap) {
        let mesh = jitter(&shape::by_name(name, 2000).unwrap(), 1e-3, 7).unwrap();
        let (options, field) = (Options::default(), FieldOptions::default());
        let (field, _) = solve_field(&mesh, &field, &options, Monitor::default).unwrap();
        let problem = SeamlessProblem::new(&mesh, &field, &SeamlessOptions { quads }).unwrap();
        let solution = solve(problem.problem(), &options).unwrap();
        let map = problem.map(&mesh, &solution).unwrap();
        (mesh, problem, map)
    }

    #[test]
    fn a_map_that_distorts_nothing_stiffens_nothing() {
        let (mesh, problem, map) = mapped("plane", 100);
        let stiffer = problem.stiffened(&mesh, &map).unwrap();
        for face in 0..mesh.face_count() {
            let weight = stiffer.stiffness_of(face);
            assert!((1.0..1.01).contains(&weight), "{face}: {weight}");
        }
    }

    #[test]
    fn the_energy_is_the_weighted_sum_and_stiffness_adds_up() {
        let (mesh, problem, map) = mapped("genus-2", 80);
        let once = problem.stiffened(&mesh, &map).unwrap();
        let solution = solve(once.problem(), &Options::default()).unwrap();
        let found = once.map(&mesh, &solution).unwrap();
        let error = |face: usize, axis: usize| {
            let values = found.uv(face).map(|corner| corner[axis]);
            let by = sub(
                gradient(&mesh, face, values),
                once.targets(&mesh, face)[axis],
            );
            mesh.area(face) * dot(by, by)
        };
        let of_face = |face: usize| once.stiffness_of(face) * (error(face, 0) + error(face, 1));
        let weighted: f64 = (0..mesh.face_count()).map(of_face).sum();
        // Translations count a millionth.
        let difference = (solution.energy() - weighted) / weighted;
        assert!((0.0..1e-2).contains(&difference), "{difference}");

        let twice = once.stiffened(&mesh, &found).unwrap();
        let sum = |p: &SeamlessProblem| {
            let faces = 0..mesh.face_count();
            faces.map(|face| p.stiffness_of(face)).sum::<f64>()
        };
        assert!(sum(&twice) > sum(&once) && sum(&once) > 1.01 * mesh.face_count() as f64);
    }
}
