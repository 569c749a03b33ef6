//! Maps of patches: charts with fixed transitions, whose seams slide over the surface.
//!
//! Every patch has a chart of its own, and the transitions between charts are known. A vertex on a seam has a copy in
//! each chart around it, which move together. The map is first the harmonic one (`tong2006`): the minimum of the
//! Dirichlet energy, by one linear system. Where it folds, it is untangled region by region. If folds are left, the map
//! that was given takes its place, which has none. Steps on the distortion energy of the whole map follow.

use std::f64::consts::FRAC_PI_2;

use super::energy::{Quadratic, Rest};
use super::freedom::Freedom;
use super::region::{Region, at_once, regions};
use super::schedule::{FIRST_EPS, undo_folds};
use super::system::System;
use crate::error::Result;
use crate::linalg::Sparse;
use crate::mesh::vector::{Vec3, cross, dot, norm, sub};
use crate::mesh::{angle_at, orientation};
use crate::monitor::{Monitor, Phase};

/// The most Newton steps on the energy of the whole map.
const STEPS: usize = 12;

/// They end when one gains less than this part of the energy.
const CONVERGED: f64 = 2e-3;

/// The most Newton steps on a region with folds.
const STEPS_OF_REGION: usize = 40;

/// The rings around folds that may move. Where that does not suffice, the map that was given is the better start.
const RINGS: [usize; 3] = [3, 8, 20];

/// One in so many faces may be folded for that.
const FEW: usize = 20;

/// The barrier of maps without folds.
const CLOSED: f64 = 1e-9;

/// A map of patches.
pub(crate) struct Patchwork {
    freedom: Freedom,
    rests: Vec<Rest>,
    /// The vertices at the corners of each face.
    vertices: Vec<[u32; 3]>,
}

/// The result of [`Patchwork::relax`].
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub(crate) struct Relaxed {
    /// Faces that the harmonic map folds.
    pub folded_at_first: usize,
    /// Newton steps.
    pub steps: usize,
}

impl Patchwork {
    /// A map with these vertices, and their copies, at the corners of each face. `moves` has a row for each coordinate (u of copy c is
    /// 2 c) and a column for each unknown that may move. `corners` are the faces in space, in units in which an edge of
    /// quads is 1 long.
    pub fn new(
        vertices: Vec<[u32; 3]>,
        copies: Vec<[u32; 3]>,
        moves: Sparse,
        corners: &[[Vec3; 3]],
    ) -> Self {
        Patchwork {
            vertices,
            freedom: Freedom::of_moves(moves, copies),
            rests: corners.iter().map(|&corners| flat(corners)).collect(),
        }
    }

    /// Improves a map without folds. `values` has the coordinates of all copies.
    ///
    /// # Errors
    /// Those of factorizations, and [`Error::Cancelled`](crate::Error::Cancelled).
    pub fn relax(&self, values: &mut [f64], monitor: &mut Monitor) -> Result<Relaxed> {
        let mut done = Relaxed::default();
        if self.freedom.dim() == 0 {
            return Ok(done);
        }
        let whole = Region {
            unknowns: (0..self.freedom.dim() as u32).collect(),
            faces: (0..self.rests.len() as u32).collect(),
        };
        let mut system = self.system(&whole)?;
        let valid = values.to_vec();
        let forms: Vec<Quadratic> = self.dirichlet(values);
        system.minimise(values, &forms)?;
        let folded = self.folded(values);
        done.folded_at_first = folded.len();
        if !folded.is_empty() && folded.len() <= self.rests.len() / FEW {
            done.steps += self.unfold(values, monitor)?;
        }
        // A map without folds may still wind around a vertex more than once.
        if !self.folded(values).is_empty() || self.quarters(values) != self.quarters(&valid) {
            values.copy_from_slice(&valid);
        }
        let mut energy = system.energy(values, CLOSED);
        for step in 0..STEPS {
            monitor.progress(Phase::Untangle, step as f64 / STEPS as f64)?;
            let saved = system.save(values);
            let after = monitor.watching(|| system.step(values, CLOSED))?;
            done.steps += 1;
            if system.folded(values) > 0 {
                system.restore(values, &saved);
                break;
            }
            if after >= energy * (1.0 - CONVERGED) {
                break;
            }
            energy = after;
        }
        Ok(done)
    }

    /// Faces with a negative or no area, decided exactly.
    pub fn folded(&self, values: &[f64]) -> Vec<usize> {
        let faces = 0..self.rests.len();
        faces
            .filter(|&f| orientation(self.freedom.uv(values, f)) <= 0.0)
            .collect()
    }

    /// The quarter turns around each vertex.
    fn quarters(&self, values: &[f64]) -> Vec<i32> {
        let count = self
            .vertices
            .iter()
            .flatten()
            .max()
            .map_or(0, |&v| v as usize + 1);
        let mut angles = vec![0.0; count];
        for (face, vertices) in self.vertices.iter().enumerate() {
            let uv = self.freedom.uv(values, face);
            for k in 0..3 {
                angles[vertices[k] as usize] += angle_at(uv, k);
            }
        }
        let quarters = angles.iter().map(|a: &f64| (a / FRAC_PI_2).round() as i32);
        quarters.collect()
    }

    fn unfold(&self, values: &mut [f64], monitor: &mut Monitor) -> Result<usize> {
        let mut steps = 0;
        for rings in RINGS {
            let folded = self.folded(values);
            if folded.is_empty() {
                break;
            }
            let regions = regions(&self.freedom, &folded, rings);
            let done = at_once(values, &regions, monitor, |k, values, monitor| {
                let mut system = self.system(&regions[k])?;
                undo_folds(&mut system, values, STEPS_OF_REGION, FIRST_EPS, monitor)
            })?;
            for outcome in done {
                steps += outcome.steps;
                outcome.better.iter().for_each(|moved| moved.put(values));
            }
        }
        Ok(steps)
    }

    fn system<'r>(&'r self, region: &'r Region) -> Result<System<'r>> {
        System::new(&self.freedom, region, |face| self.rests[face])
    }

    /// The Dirichlet energy of every face, to second order.
    fn dirichlet(&self, values: &[f64]) -> Vec<Quadratic> {
        let of_face = |(face, rest): (usize, &Rest)| {
            let uv = self.freedom.uv(values, face);
            let area = rest.weight * rest.weight;
            let mut form = Quadratic::ZERO;
            for (i, g) in rest.gradients.iter().enumerate() {
                for (j, h) in rest.gradients.iter().enumerate() {
                    let product = area * (g[0] * h[0] + g[1] * h[1]);
                    for axis in 0..2 {
                        form.hessian[2 * i + axis][2 * j + axis] = product;
                        form.slope[2 * i + axis] += product * uv[j][axis];
                    }
                }
            }
            form
        };
        self.rests.iter().enumerate().map(of_face).collect()
    }
}

/// The least height of a face at rest, over its longest side: what is thinner is made as thick.
const THIN: f64 = 1e-4;

/// A face laid into the plane.
fn flat([a, b, c]: [Vec3; 3]) -> Rest {
    let [ab, ac] = [sub(b, a), sub(c, a)];
    let longest = norm(ab)
        .max(norm(ac))
        .max(norm(sub(c, b)))
        .max(f64::MIN_POSITIVE);
    let width = norm(ab).max(THIN * longest);
    let along = dot(ac, ab) / width;
    let height = (norm(cross(ab, ac)) / width).max(THIN * longest);
    Rest::new([[0.0; 2], [width, 0.0], [along, height]])
}
