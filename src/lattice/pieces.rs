//! The independent parts of the closest-vector problem, each with its own reduced basis.
//!
//! Integers that the Schur complement does not couple, not even through others, are decided
//! apart: the squared distances of the parts add up.

use super::{Basis, DEPTH, Diagonals, Target, lll, nearest_plane, predicted_nodes};
use crate::error::Result;
use crate::linalg::DisjointSets;

/// One part: the best point so far, and what is proved about all points.
#[derive(Debug, Clone)]
pub struct Piece {
    /// Its integers, by their places among all.
    pub places: Vec<usize>,
    /// The reduced basis.
    pub basis: Basis,
    /// Below the scalar products of the basis; only made where a proof needs many nodes.
    pub diagonals: Option<Diagonals>,
    /// The relaxation's integers.
    pub target: Target,
    /// Steps from the target's whole part to the best point so far.
    pub z: Vec<i64>,
    /// The squared distance there.
    pub value: f64,
    /// No point that was not evaluated has a smaller squared distance.
    pub bound: f64,
    /// Whether every point that may be better than the best one was evaluated.
    pub proved: bool,
}

impl Piece {
    /// The nodes to expect of an enumeration of all that is closer than the best point.
    pub fn predicted_nodes(&self) -> f64 {
        predicted_nodes(&self.basis, self.diagonals.as_ref(), self.value)
    }

    /// Whether its vectors are independent.
    pub fn is_regular(&self) -> bool {
        self.basis.is_discrete() && self.basis.rank() == self.basis.dim()
    }

    /// Takes `z` if it is closer to the target.
    pub fn take(&mut self, z: Vec<i64>) -> bool {
        let value = self.target.distance(&self.basis, &z);
        let better = value < self.value * (1.0 - super::NEARER);
        if better {
            (self.z, self.value) = (z, value);
        }
        better
    }
}

/// Splits the lattice with upper triangular factor `r` of `m` columns (`full`: no zero on the
/// diagonal), reduces each part, and decides it by nearest plane from `point`. Where `stop` ends a
/// reduction the parts are worse, and right all the same.
///
/// # Errors
/// [`Error::Overflow`](crate::Error::Overflow) for integers too large to be exact.
pub fn pieces(
    m: usize,
    r: &[f64],
    full: bool,
    point: &[f64],
    stop: &mut dyn FnMut(u64) -> bool,
) -> Result<Vec<Piece>> {
    let make = |places: Vec<usize>| {
        let k = places.len();
        let mut own = vec![0.0; k * k];
        for (b, &j) in places.iter().enumerate() {
            for (a, &i) in places[..=b].iter().enumerate() {
                own[b * k + a] = r[j * m + i];
            }
        }
        let mut basis = Basis::from_factor(k, own, full);
        lll(&mut basis, DEPTH, stop)?;
        let point: Vec<f64> = places.iter().map(|&i| point[i]).collect();
        let target = Target::new(&basis, &point)?;
        let z = nearest_plane(&basis, &target);
        Ok(Piece {
            value: target.distance(&basis, &z),
            bound: 0.0,
            proved: false,
            places,
            basis,
            diagonals: None,
            target,
            z,
        })
    };
    components(m, r).into_iter().map(make).collect()
}

/// The columns that share rows, directly or through others; both orders increase.
fn components(m: usize, r: &[f64]) -> Vec<Vec<usize>> {
    let mut sets = DisjointSets::new(m);
    for j in 0..m {
        for i in (0..j).filter(|i| r[j * m + i] != 0.0) {
            sets.join(i, j);
        }
    }
    sets.sets()
}

/// The integers of all pieces in their best points.
///
/// # Errors
/// [`Error::Overflow`](crate::Error::Overflow) beyond 64 bits.
pub fn assemble(pieces: &[Piece], m: usize) -> Result<Vec<f64>> {
    let mut all = vec![0.0; m];
    for piece in pieces {
        let integers = piece.target.integers(&piece.basis, &piece.z)?;
        for (&place, z) in piece.places.iter().zip(integers) {
            all[place] = z as f64;
        }
    }
    Ok(all)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn uncoupled_integers_are_decided_apart() {
        // 0 and 2 are coupled, 1 stands alone.
        let r = [2.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.5, 0.0, 3.0];
        let parts = pieces(3, &r, true, &[0.2, 1.7, -4.1], &mut |_| false).unwrap();
        let places: Vec<_> = parts.iter().map(|p| p.places.clone()).collect();
        assert_eq!(places, [vec![0, 2], vec![1]]);
        assert_eq!(assemble(&parts, 3).unwrap(), [0.0, 2.0, -4.0]);
    }
}
