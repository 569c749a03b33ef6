//! The energy of one region and its Newton steps.
//!
//! The region's coordinates are affine in its unknowns. This affine map carries the slope and Hessian of
//! each face to the unknowns, and sparse Cholesky factors the sum of the Hessians.

use super::energy::{Quadratic, Rest};
use super::freedom::Freedom;
use super::hessian::Hessian;
use super::region::{Moved, Region};
use crate::error::{Error, Result};
use crate::linalg::Sparse;
use crate::mesh::orientation;
use crate::monitor::{allowed_threads, collect_in_parts};

/// The most halvings of a step before it is given up.
const HALVINGS: usize = 24;

/// The fraction of the decrease predicted by the slope that a step must reach (Armijo).
const DECREASE: f64 = 1e-4;

/// The faces whose forms are worth a thread: it takes a quarter of a millisecond for them.
const WORTH_A_THREAD: usize = 1000;

/// One region, ready to be solved.
pub(super) struct System<'a> {
    freedom: &'a Freedom,
    region: &'a Region,
    rests: Vec<Rest>,
    /// The coordinates that the region's unknowns move, increasing.
    coordinates: Vec<u32>,
    /// One row a corner coordinate of a face, one column an unknown of the region.
    corners: Sparse,
    /// One row a coordinate of the region.
    moves: Sparse,
    /// Made in the first step.
    hessian: Option<Hessian>,
}

impl<'a> System<'a> {
    pub fn new(
        freedom: &'a Freedom,
        region: &'a Region,
        rest: impl Fn(usize) -> Rest,
    ) -> Result<Self> {
        let moved = region
            .unknowns
            .iter()
            .flat_map(|&y| freedom.moved.row(y as usize));
        let mut coordinates: Vec<u32> = moved.map(|(i, _)| i as u32).collect();
        coordinates.sort_unstable();
        coordinates.dedup();
        let dim = region.unknowns.len();
        let row = |k: usize, coordinate: u32| {
            let entries = freedom.moves.row(coordinate as usize);
            entries.filter_map(move |(y, v)| {
                let place = region.unknowns.binary_search(&(y as u32)).ok()?;
                Some((k as u32, place as u32, v))
            })
        };
        let of_faces = region
            .faces
            .iter()
            .flat_map(|&f| freedom.copies[f as usize]);
        let of_faces: Vec<u32> = of_faces.flat_map(|c| [2 * c, 2 * c + 1]).collect();
        let matrix = |list: &[u32]| {
            let entries = list.iter().enumerate().flat_map(|(k, &i)| row(k, i));
            Sparse::from_triplets(list.len(), dim, entries)
        };
        Ok(System {
            corners: matrix(&of_faces)?,
            moves: matrix(&coordinates)?,
            rests: region.faces.iter().map(|&f| rest(f as usize)).collect(),
            coordinates,
            hessian: None,
            freedom,
            region,
        })
    }

    /// The energy at coordinates `x`.
    pub fn energy(&self, x: &[f64], eps: f64) -> f64 {
        let energy = |k: usize| self.rests[k].energy(&self.uv(x, k), eps);
        match self.threads_compute() {
            true => self.in_parts(energy).sum(),
            false => (0..self.rests.len()).map(energy).sum(),
        }
    }

    /// The least determinant.
    pub fn least_determinant(&self, x: &[f64]) -> f64 {
        let all = self.shapes(x).map(|(rest, uv)| rest.determinant(&uv));
        all.fold(f64::INFINITY, f64::min)
    }

    /// How many faces are folded or collapsed, by the exact predicate.
    pub fn folded(&self, x: &[f64]) -> usize {
        let all = self.shapes(x);
        all.filter(|(_, uv)| orientation(*uv) <= 0.0).count()
    }

    /// Makes one step of Newton's method with line search and returns the energy after it.
    pub fn step(&mut self, x: &mut [f64], eps: f64) -> Result<f64> {
        let mut hessian = match self.hessian.take() {
            Some(hessian) => hessian,
            None => Hessian::new(&self.corners)?,
        };
        let (before, slope) = self.quadratic(x, eps, &mut hessian);
        let mut step: Vec<f64> = slope.iter().map(|g| -g).collect();
        let factor = hessian.factor();
        self.hessian = Some(hessian);
        match factor {
            Ok(factor) => factor.solve(&mut step)?,
            // Next to a triangle without area the barrier overflows.
            Err(Error::Overflow { .. }) => return Ok(before),
            Err(error) => return Err(error),
        }
        let promised: f64 = slope.iter().zip(&step).map(|(g, s)| g * s).sum();
        let start = self.save(x);
        let change = self.moves.mul(&step);
        let mut length = 1.0;
        for _ in 0..HALVINGS {
            self.place(x, &start, &change, length);
            let after = self.energy(x, eps);
            if after <= before + DECREASE * length * promised {
                return Ok(after);
            }
            length *= 0.5;
        }
        // The step may have no numbers.
        self.restore(x, &start);
        Ok(before)
    }

    /// Moves to the minimum of the sum of the given forms, one for each face, with their slopes at `x`.
    pub fn minimise(&mut self, x: &mut [f64], forms: &[Quadratic]) -> Result<()> {
        let hessian = match &mut self.hessian {
            Some(hessian) => hessian,
            none => none.insert(Hessian::new(&self.corners)?),
        };
        let mut step = vec![0.0; self.region.unknowns.len()];
        for (k, form) in forms.iter().enumerate() {
            for (a, slope) in form.slope.iter().enumerate() {
                for (i, u) in self.corners.row(6 * k + a) {
                    step[i] -= u * slope;
                }
            }
        }
        hessian.sum(&self.corners, forms.iter().map(|form| form.hessian));
        hessian.factor()?.solve(&mut step)?;
        let change = self.moves.mul(&step);
        self.place(x, &self.save(x), &change, 1.0);
        Ok(())
    }

    /// The coordinates of the region, to be put back with [`restore`](Self::restore).
    pub fn save(&self, x: &[f64]) -> Vec<f64> {
        self.coordinates.iter().map(|&i| x[i as usize]).collect()
    }

    /// Puts saved coordinates back.
    pub fn restore(&self, x: &mut [f64], saved: &[f64]) {
        for (&i, value) in self.coordinates.iter().zip(saved) {
            x[i as usize] = *value;
        }
    }

    /// The coordinates of the region as they are now.
    pub fn moved(&self, x: &[f64]) -> Moved {
        Moved {
            coordinates: self.coordinates.clone(),
            to: self.save(x),
        }
    }

    fn place(&self, x: &mut [f64], start: &[f64], change: &[f64], length: f64) {
        for ((&i, start), change) in self.coordinates.iter().zip(start).zip(change) {
            x[i as usize] = start + length * change;
        }
    }

    fn shapes<'b>(&'b self, x: &'b [f64]) -> impl Iterator<Item = (&'b Rest, [[f64; 2]; 3])> + 'b {
        let rests = self.rests.iter().enumerate();
        rests.map(|(k, rest)| (rest, self.uv(x, k)))
    }

    /// The coordinates of face `k` of the region.
    fn uv(&self, x: &[f64], k: usize) -> [[f64; 2]; 3] {
        self.freedom.uv(x, self.region.faces[k] as usize)
    }

    /// Whether several threads compute what belongs to faces.
    fn threads_compute(&self) -> bool {
        allowed_threads() > 1 && self.rests.len() >= 2 * WORTH_A_THREAD
    }

    /// The values of all faces in order, computed by several threads.
    fn in_parts<T: Send>(&self, value: impl Fn(usize) -> T + Sync) -> impl Iterator<Item = T> {
        collect_in_parts(self.rests.len(), WORTH_A_THREAD, value).into_iter()
    }

    /// Energy and slope in the region's unknowns; `hessian` becomes the projected one.
    fn quadratic(&self, x: &[f64], eps: f64, hessian: &mut Hessian) -> (f64, Vec<f64>) {
        let of_face = |k: usize| {
            let (rest, uv) = (&self.rests[k], self.uv(x, k));
            (rest.energy(&uv, eps), rest.quadratic(&uv, eps))
        };
        match self.threads_compute() {
            true => self.summed(self.in_parts(of_face), hessian),
            false => self.summed((0..self.rests.len()).map(of_face), hessian),
        }
    }

    /// The sum of the energies and that of the slopes of all faces; `hessian` becomes that of the Hessians.
    fn summed(
        &self,
        all: impl Iterator<Item = (f64, Quadratic)>,
        hessian: &mut Hessian,
    ) -> (f64, Vec<f64>) {
        let mut slope = vec![0.0; self.region.unknowns.len()];
        let mut energy = 0.0;
        let forms = all.enumerate().map(|(k, (of_face, local))| {
            energy += of_face;
            for a in 0..6 {
                for (i, u) in self.corners.row(6 * k + a) {
                    slope[i] += u * local.slope[a];
                }
            }
            local.hessian
        });
        hessian.sum(&self.corners, forms);
        (energy, slope)
    }
}
