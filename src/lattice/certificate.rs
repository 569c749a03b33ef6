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
//! 3. z*: the target is off by the gradient that is left there, which is measured too.
//!
//! So every solution that was not evaluated and lies beyond the computed distance d has at least the energy
//! `E* + (d (1 - |F|) - shift)^2 / 2`. The rounding error of d itself is smaller than
//! [`NEARER`](super::NEARER), which the bound of the enumeration already subtracts.

use super::Piece;
use crate::eliminate::ReducedModel;
use crate::error::Result;
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
        let mut gaussian = Gaussian(0x2545_F491_4F6C_DD1D);
        let mut largest: f64 = 0.0;
        for _ in 0..PROBES {
            let g: Vec<Vec<f64>> = pieces
                .iter()
                .map(|p| (0..p.basis.rank()).map(|_| gaussian.next()).collect())
                .collect();
            let mut v = vec![0.0; model.integers().len()];
            for (piece, g) in pieces.iter().zip(&g) {
                let image = piece.basis.orthonormal_to_callers(g);
                for (&place, x) in piece.places.iter().zip(image) {
                    v[place] = x;
                }
            }
            let mut all = vec![0.0; model.dim()];
            for (&i, v) in model.integers().iter().zip(&v) {
                all[i as usize] = *v;
            }
            let force = condensed(model, factors, model.hessian().mul_symmetric(&all))?;
            let mut error = 0.0;
            for (piece, g) in pieces.iter().zip(&g) {
                for (h, g) in piece.dual(&force).iter().zip(g) {
                    error += (h - g).powi(2);
                }
            }
            largest = largest.max(error.sqrt());
        }
        let mut gradient = model.hessian().mul_symmetric(relaxed);
        for (r, g) in gradient.iter_mut().zip(model.gradient()) {
            *r += g;
        }
        let left = condensed(model, factors, gradient)?;
        let shift = pieces
            .iter()
            .flat_map(|p| p.dual(&left))
            .map(|h| h * h)
            .sum::<f64>()
            .sqrt();
        let relative = 10.0 * std::f64::consts::FRAC_2_PI.sqrt() * largest;
        Ok(Certificate {
            relaxation,
            relative,
            shift: shift * (1.0 + relative),
            valid: relative < 1.0 && pieces.iter().all(|p| p.basis.is_discrete()),
        })
    }

    /// A lower bound on the energy of all solutions at squared distance `square` or beyond.
    pub fn energy_bound(&self, square: f64) -> f64 {
        if !self.valid {
            return self.relaxation;
        }
        let distance = square.sqrt() * (1.0 - self.relative) - self.shift;
        self.relaxation + 0.5 * distance.max(0.0).powi(2)
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

/// The force on the integers that a force on all unknowns causes, when the continuous unknowns are at their
/// minimum. The solve has one step of refinement.
fn condensed(model: &ReducedModel, factors: &mut Factors, mut force: Vec<f64>) -> Result<Vec<f64>> {
    if !model.continuous().is_empty() {
        for _ in 0..2 {
            let mut all = force.clone();
            model.integers().iter().for_each(|&i| all[i as usize] = 0.0);
            factors.solve_continuous(model, &mut all)?;
            for (f, p) in force.iter_mut().zip(model.hessian().mul_symmetric(&all)) {
                *f -= p;
            }
        }
    }
    Ok(model
        .integers()
        .iter()
        .map(|&i| force[i as usize])
        .collect())
}

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
