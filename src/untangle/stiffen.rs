//! Local stiffening: around folds, triangles that the map distorts get a larger weight.
//!
//! `bommes2009`, section 5.4. With the singular values of the map of a triangle, relative to its
//! targets, and the sign t of its determinant,
//!
//! ```text
//! lambda = |t sigma1 - 1| + |t sigma2 - 1|,    w += min(c |lap lambda|, d),    c = 1, d = 5
//! ```
//!
//! where lap is the uniform Laplacian over neighbouring triangles. Weights are smoothed afterwards,
//! because a single triangle resists little. The paper solves for the whole surface and the integers each
//! time. Here the integers and everything far from a fold stay fixed: a step costs one linear solve of a
//! small region, and the barrier removes the remaining folds.

use super::Untangling;
use super::energy::Quadratic;
use super::region::{Moved, Region, at_once, regions};
use crate::error::{Error, Result};
use crate::map::gradient;
use crate::mesh::vector::{dot, norm, sub};
use crate::monitor::Monitor;
use crate::monitor::Phase;

/// The rings of faces around a fold whose weights grow and whose vertices move.
const RINGS: usize = 6;

/// `c`.
const BY_LAPLACIAN: f64 = 1.0;

/// `d`.
const MOST: f64 = 5.0;

/// Rounds of averaging with the neighbouring faces.
const SMOOTHING: usize = 3;

impl Untangling<'_> {
    /// Stiffens the surroundings of each fold until it is gone, at most `times` times, and keeps
    /// the state with the fewest folds.
    pub(super) fn stiffen(&mut self, times: usize, monitor: &mut Monitor) -> Result<()> {
        let regions = regions(self.freedom, &self.folded(), RINGS);
        let stiffened = at_once(&self.values, &regions, monitor, |k, values, monitor| {
            monitor.progress(Phase::Untangle, 0.0)?;
            monitor.watching(|| self.stiffened(&regions[k], times, values))
        })?;
        let all = stiffened.iter();
        all.for_each(|moved| moved.put(&mut self.values));
        Ok(())
    }

    /// The best state of a region. Leaves `values` as they were.
    fn stiffened(&self, region: &Region, times: usize, values: &mut [f64]) -> Result<Moved> {
        let mut system = self.system(region)?;
        let mut least = system.folded(values);
        let mut best = system.moved(values);
        let before = system.save(values);
        let neighbors = self.neighbors_in(region);
        let mut weights = vec![1.0; region.faces.len()];
        for _ in 0..times {
            if least == 0 {
                break;
            }
            self.stiffen_distorted(region, values, &neighbors, &mut weights);
            let faces = region.faces.iter().zip(&weights);
            let forms = faces.map(|(&f, &w)| self.misfit(f as usize, values, w));
            match system.minimise(values, &forms.collect::<Vec<_>>()) {
                // Next to a triangle without area the weights overflow.
                Err(Error::Overflow { .. }) => break,
                other => other?,
            }
            let folded = system.folded(values);
            if folded < least {
                least = folded;
                best = system.moved(values);
            }
        }
        system.restore(values, &before);
        Ok(best)
    }

    /// For each face of a region, the places of its neighbours in the region.
    fn neighbors_in(&self, region: &Region) -> Vec<[Option<usize>; 3]> {
        let place = |face: usize| region.faces.binary_search(&(face as u32)).ok();
        let across = |f: u32| [0, 1, 2].map(|k| place(self.mesh.neighbor(f as usize, k)?.0));
        region.faces.iter().map(|&f| across(f)).collect()
    }

    /// Increases the weights by the Laplacian of the distortion.
    fn stiffen_distorted(
        &self,
        region: &Region,
        values: &[f64],
        neighbors: &[[Option<usize>; 3]],
        weights: &mut [f64],
    ) {
        let mean = |values: &[f64], k: usize| {
            let near = neighbors[k].iter().flatten();
            let (sum, count) = near.fold((0.0, 0.0), |(s, n), &j| (s + values[j], n + 1.0));
            if count > 0.0 { sum / count } else { values[k] }
        };
        let faces = region.faces.iter();
        let distortion: Vec<f64> = faces
            .map(|&f| self.distortion(f as usize, values))
            .collect();
        for (k, weight) in weights.iter_mut().enumerate() {
            let laplacian = distortion[k] - mean(&distortion, k);
            *weight += (BY_LAPLACIAN * laplacian.abs()).min(MOST);
        }
        for _ in 0..SMOOTHING {
            let smooth = |k: usize| 0.5 * (weights[k] + mean(weights, k));
            let smoothed: Vec<f64> = (0..weights.len()).map(smooth).collect();
            weights.copy_from_slice(&smoothed);
        }
    }

    /// The distortion of the map of a face relative to its targets: 0 for an isometry.
    fn distortion(&self, face: usize, values: &[f64]) -> f64 {
        let uv = self.freedom.uv(values, face);
        let targets = self.problem.targets(self.mesh, face);
        // The columns of the Jacobian: along each target, by the square of its length.
        let along = |axis: usize| {
            let slope = gradient(self.mesh, face, uv.map(|corner| corner[axis]));
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

    /// Half of `weight area (|grad u - h X|^2 + |grad v - h Y|^2)`, from the coordinates as they are.
    fn misfit(&self, face: usize, values: &[f64], weight: f64) -> Quadratic {
        let area = weight * self.mesh.area(face);
        let hats = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
        let hats = hats.map(|values| gradient(self.mesh, face, values));
        let uv = self.freedom.uv(values, face);
        let targets = self.problem.targets(self.mesh, face);
        let mut form = Quadratic::ZERO;
        for (axis, target) in targets.into_iter().enumerate() {
            let found = gradient(self.mesh, face, uv.map(|corner| corner[axis]));
            for a in 0..3 {
                form.slope[2 * a + axis] = area * dot(hats[a], sub(found, target));
                for b in 0..3 {
                    form.hessian[2 * a + axis][2 * b + axis] = area * dot(hats[a], hats[b]);
                }
            }
        }
        form
    }
}

#[cfg(test)]
pub(super) mod tests {
    use super::super::{Structure, UntangleOptions};
    use super::*;
    use crate::field::{FieldOptions, solve_field};
    use crate::map::{SeamlessOptions, SeamlessProblem};
    use crate::mesh::{TriangleMesh, jitter, shape};
    use crate::search::{Options, Strategy};
    use crate::solve::solve;

    /// Calls `look` with the untangling of a shape's map at its start, and with the energy of the map.
    pub(in crate::untangle) fn with_work(
        name: &str,
        quads: usize,
        look: impl FnOnce(&mut Untangling, f64),
    ) {
        let mesh: TriangleMesh = jitter(&shape::by_name(name, 2000).unwrap(), 1e-3, 7).unwrap();
        let (options, field) = (Options::default(), FieldOptions::default());
        let (field, _) = solve_field(&mesh, &field, &options, Monitor::default).unwrap();
        let problem = SeamlessProblem::new(&mesh, &field, &SeamlessOptions { quads }).unwrap();
        let direct = Options {
            strategy: Strategy::Direct,
            ..options
        };
        let solution = solve(problem.problem(), &direct).unwrap();
        let map = problem.map(&mesh, &solution).unwrap();
        let structure = Structure::new(&mesh, &problem, &map, &mut Monitor::default()).unwrap();
        let effort = UntangleOptions::default();
        let mut work = Untangling::new(&structure, &mesh, &problem, &map, &effort);
        look(&mut work, map.energy());
    }

    fn everything(work: &Untangling) -> Region {
        Region {
            unknowns: (0..work.freedom.dim() as u32).collect(),
            faces: (0..work.mesh.face_count() as u32).collect(),
        }
    }

    #[test]
    fn a_map_that_distorts_nothing_stiffens_nothing() {
        with_work("plane", 100, |work, _| {
            let region = everything(work);
            let mut weights = vec![1.0; region.faces.len()];
            let neighbors = work.neighbors_in(&region);
            work.stiffen_distorted(&region, &work.values, &neighbors, &mut weights);
            assert!(weights.iter().all(|w| (1.0..1.01).contains(w)));
        });
    }

    #[test]
    fn without_stiffness_the_least_misfit_is_that_of_the_solve() {
        with_work("genus-2", 80, |work, energy| {
            let region = everything(work);
            let forms: Vec<_> = (0..work.mesh.face_count())
                .map(|f| work.misfit(f, &work.values, 1.0))
                .collect();
            let slope = |form: &Quadratic| form.slope.iter().map(|s| s.abs()).sum::<f64>();
            let before = work.values.clone();
            let mut system = work.system(&region).unwrap();
            system.minimise(&mut work.values, &forms).unwrap();
            let moved = before.iter().zip(&work.values).map(|(a, b)| (a - b).abs());
            let size = forms.iter().map(slope).sum::<f64>();
            assert!(energy > 0.0 && size > 1e-3, "nothing to see");
            assert!(moved.fold(0.0, f64::max) < 1e-6);
        });
    }

    #[test]
    fn folds_get_fewer_and_nothing_far_from_them_moves() {
        with_work("genus-2", 80, |work, _| {
            let (folded, before) = (work.folded(), work.values.clone());
            assert!(!folded.is_empty());
            let near = regions(work.freedom, &folded, RINGS);
            let near = near.iter().flat_map(|region| &region.faces);
            let near: std::collections::BTreeSet<u32> = near.copied().collect();
            work.stiffen(5, &mut Monitor::default()).unwrap();
            assert!(work.folded().len() < folded.len());
            let after = std::mem::replace(&mut work.values, before);
            let moved = |face: usize| {
                let old = work.uv(face);
                let copies = work.freedom.copies[face].map(|c| 2 * c as usize);
                old != copies.map(|u| [after[u], after[u + 1]])
            };
            let faces = 0..work.mesh.face_count();
            let moved: Vec<usize> = faces.filter(|&face| moved(face)).collect();
            assert!(!moved.is_empty() && moved.len() < work.mesh.face_count());
            assert!(moved.iter().all(|&face| near.contains(&(face as u32))));
        });
    }
}
