//! A lower bound on the energy from a distance in the reduced lattice, rounding errors included.
//!
//! Let S be the exact Schur complement and z* the integers of the exact relaxation. Every solution has
//! `E(z) = E* + (z - z*)' S (z - z*) / 2`. The computed numbers differ from the exact ones in three ways:
//!
//! 1. E*: the relaxation's bound already lies below it.
//! 2. S: the factor R in which distances are measured is that of another matrix. In coordinates
//!    where R is the identity, let the true S be `I + F`; then squared distances are off by at
//!    most the norm of F, relatively. F is not a guess but *measured end to end*: its product with
//!    a random vector needs one exact minimisation over the continuous unknowns, which goes
//!    through the model's own numbers and none of the reduction's. For Gaussian vectors
//!    g_1 .. g_8, `|F| <= 10 sqrt(2/pi) max |F g_i|` except with probability 1e-8
//!    (`halko2011`, lemma 4.1).
//!    In up to 24 dimensions the product is measured with every unit vector, and F is bounded
//!    without a probability.
//!    The model itself differs from the caller's problem by its [rounding](crate::eliminate::Rounding), a
//!    diagonal matrix D. The trace of D in the same coordinates is added to the norm of F.
//! 3. z*: the target is off by the gradient that is left there, which is measured too, and by the rounding
//!    of the model's linear term.
//! 4. d: a distance is the length of `R (z - z*)` in floating point. Its rounding error is bounded from R
//!    and its inverse.
//!
//! So every solution that was not evaluated and lies beyond the computed distance d has at least the energy
//! `E* + (d (1 - |F|) - shift)^2 / 2`.

use super::Piece;
use crate::eliminate::ReducedModel;
use crate::error::Result;
use crate::linalg::sum_below;
use crate::search::{Factors, Search};

/// The number of random vectors in the measurement of the factor's error.
const PROBES: usize = 8;

/// The errors of a reduced lattice.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Certificate {
    relaxation: f64,
    /// The relative error of distances.
    relative: f64,
    /// The error of the target, as a distance.
    shift: f64,
    /// Whether distances prove a bound.
    valid: bool,
}

impl Certificate {
    /// Measures the errors of `pieces`, the lattice of `model` around the minimiser of its relaxation. The
    /// bound of `search` must still be the relaxation's.
    ///
    /// # Errors
    /// For lack of memory.
    pub fn measure(
        model: &ReducedModel,
        factors: &mut Factors,
        pieces: &[Piece],
        search: &Search,
    ) -> Result<Self> {
        let (relaxed, relaxation) = (search.relaxed(), search.lower_bound());
        let ranks: Vec<usize> = pieces.iter().map(|p| p.basis.rank()).collect();
        let probes = Probes::new(ranks.iter().sum());
        let rounding = model.rounding();
        let (mut factor, mut curvature, mut slope) = (0.0f64, 0.0f64, 0.0f64);
        for probe in 0..probes.count() {
            let g = probes.vector(probe);
            let mut all = vec![0.0; model.dim()];
            for (piece, g) in split(pieces, &g) {
                let image = piece.basis.orthonormal_to_callers(g);
                for (&place, x) in piece.places.iter().zip(image) {
                    all[model.integers()[place] as usize] = x;
                }
            }
            let mut force = model.hessian().mul_symmetric(&all);
            condense(model, factors, &mut force, &mut all)?;
            let force = of_integers(model, &force);
            let mut error = 0.0;
            for (piece, g) in split(pieces, &g) {
                for (h, g) in piece.dual(&force).iter().zip(g) {
                    error += (h - g).powi(2);
                }
            }
            let at = |errors: &[f64], power: i32| -> f64 {
                let terms = errors.iter().zip(&all);
                terms.map(|(e, x)| e.powi(power) * x * x).sum()
            };
            probes.join(&mut factor, error);
            probes.join(&mut curvature, at(&rounding.curvature, 1));
            probes.join(&mut slope, at(&rounding.slope, 2));
        }
        let mut gradient = model.hessian().mul_symmetric(relaxed);
        for (r, g) in gradient.iter_mut().zip(model.gradient()) {
            *r += g;
        }
        condense(model, factors, &mut gradient, &mut vec![0.0; model.dim()])?;
        let left = of_integers(model, &gradient);
        let shift = pieces
            .iter()
            .flat_map(|p| p.dual(&left))
            .map(|h| h * h)
            .sum::<f64>()
            .sqrt();
        let evaluation = pieces.iter().map(|p| p.basis.evaluation_error());
        let relative =
            probes.norm(factor) + probes.trace(curvature) + evaluation.fold(0.0, f64::max);
        let slope = (model.dim() as f64 * probes.trace(slope)).sqrt();
        Ok(Certificate {
            relaxation,
            relative,
            shift: shift * (1.0 + relative) + slope,
            valid: relative < 0.5
                && relaxation.is_finite()
                && pieces.iter().all(|p| p.basis.is_discrete()),
        })
    }

    /// Whether distances prove anything.
    pub fn is_valid(&self) -> bool {
        self.valid
    }

    /// A lower bound on the energy of all solutions at squared distance `square` or beyond.
    pub fn energy_bound(&self, square: f64) -> f64 {
        if !self.valid {
            return self.relaxation;
        }
        let distance = square.sqrt() * (1.0 - self.relative) - self.shift;
        sum_below(&[self.relaxation, 0.5 * distance.max(0.0).powi(2)])
    }

    /// The least squared distance for which `energy_bound` is at least `energy`.
    pub fn square_for(&self, energy: f64) -> f64 {
        let distance = (2.0 * (energy - self.relaxation).max(0.0)).sqrt();
        ((distance + self.shift) / (1.0 - self.relative)).powi(2)
    }
}

impl Piece {
    /// The derivative with respect to the orthonormal coordinates, computed from the derivative with
    /// respect to all integers: `R^-T U' force`.
    fn dual(&self, force: &[f64]) -> Vec<f64> {
        let own: Vec<f64> = self.places.iter().map(|&i| force[i]).collect();
        self.basis.to_orthonormal(&own)
    }
}

/// Moves the continuous unknowns of the direction `all` to the minimum under `force`, the product of the
/// Hessian with `all`, and corrects `force`. The solve has one step of refinement.
fn condense(
    model: &ReducedModel,
    factors: &mut Factors,
    force: &mut [f64],
    all: &mut [f64],
) -> Result<()> {
    if model.continuous().is_empty() {
        return Ok(());
    }
    for _ in 0..2 {
        let mut step = force.to_vec();
        model
            .integers()
            .iter()
            .for_each(|&i| step[i as usize] = 0.0);
        factors.solve_continuous(model, &mut step)?;
        for (f, p) in force.iter_mut().zip(model.hessian().mul_symmetric(&step)) {
            *f -= p;
        }
        for (a, s) in all.iter_mut().zip(&step) {
            *a -= s;
        }
    }
    Ok(())
}

fn of_integers(model: &ReducedModel, v: &[f64]) -> Vec<f64> {
    model.integers().iter().map(|&i| v[i as usize]).collect()
}

/// The parts of a vector in orthonormal coordinates that belong to the pieces.
fn split<'a>(
    pieces: &'a [Piece],
    mut g: &'a [f64],
) -> impl Iterator<Item = (&'a Piece, &'a [f64])> {
    pieces.iter().map(move |piece| {
        let (own, rest) = g.split_at(piece.basis.rank());
        g = rest;
        (piece, own)
    })
}

/// The vectors on which errors are measured: all unit vectors in few dimensions, otherwise Gaussian ones.
enum Probes {
    Units(usize),
    Gaussian(Vec<Vec<f64>>),
}

/// In more dimensions errors are measured on random vectors.
const FEW: usize = 24;

impl Probes {
    fn new(dim: usize) -> Self {
        if dim <= FEW {
            return Probes::Units(dim);
        }
        let mut gaussian = Gaussian(0x2545_F491_4F6C_DD1D);
        let mut vector = || (0..dim).map(|_| gaussian.next()).collect();
        Probes::Gaussian((0..PROBES).map(|_| vector()).collect())
    }

    fn count(&self) -> usize {
        match self {
            Probes::Units(dim) => *dim,
            Probes::Gaussian(vectors) => vectors.len(),
        }
    }

    fn vector(&self, k: usize) -> Vec<f64> {
        match self {
            Probes::Units(dim) => (0..*dim).map(|i| f64::from(u8::from(i == k))).collect(),
            Probes::Gaussian(vectors) => vectors[k].clone(),
        }
    }

    /// Adds the measurement on one vector to those before.
    fn join(&self, before: &mut f64, measured: f64) {
        *before = match self {
            Probes::Units(_) => *before + measured,
            Probes::Gaussian(_) => before.max(measured),
        };
    }

    /// A bound on the norm of a matrix from the squared norms of its products.
    fn norm(&self, squares: f64) -> f64 {
        match self {
            Probes::Units(_) => squares.sqrt(),
            Probes::Gaussian(_) => 10.0 * std::f64::consts::FRAC_2_PI.sqrt() * squares.sqrt(),
        }
    }

    /// A bound on the trace of a positive matrix from the values of its quadratic form.
    fn trace(&self, values: f64) -> f64 {
        match self {
            Probes::Units(_) => values,
            Probes::Gaussian(_) => TRACE * values,
        }
    }
}

/// The trace of a positive matrix exceeds the largest of its eight values at Gaussian vectors by this factor
/// with a probability below 2e-9: the value is at least that of one eigenvector, a chi-squared number of one
/// degree of freedom, where the matrix has one eigenvalue, and nearer to the trace where it has more.
const TRACE: f64 = 100.0;

/// Normally distributed numbers (`box1958`), made from the uniform numbers of xorshift (`marsaglia2003`).
struct Gaussian(u64);

impl Gaussian {
    fn uniform(&mut self) -> f64 {
        self.0 ^= self.0 << 13;
        self.0 ^= self.0 >> 7;
        self.0 ^= self.0 << 17;
        ((self.0 >> 11) as f64 + 0.5) / (1u64 << 53) as f64
    }

    fn next(&mut self) -> f64 {
        let radius = (-2.0 * self.uniform().ln()).sqrt();
        radius * (std::f64::consts::TAU * self.uniform()).cos()
    }
}
