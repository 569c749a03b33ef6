//! The independent parts of the closest-vector problem, each with its own reduced basis.
//!
//! Integers that the Schur complement does not couple, directly or through others, belong to different
//! pieces. The squared distances of the pieces add up, so each piece is solved separately.

use super::enumerate::Enumerated;
use super::{
    Basis, DEPTH, Diagonals, Limits, Splits, Target, enumerate, enumerate_split, lll,
    nearest_plane, predicted_nodes,
};
use crate::error::Result;
use crate::linalg::DisjointSets;

/// One piece: its best point so far, and the bound that is proved for all of its points.
#[derive(Debug, Clone)]
pub struct Piece {
    /// The places of its integers among all integers.
    pub places: Vec<usize>,
    /// The reduced basis.
    pub basis: Basis,
    /// Diagonal matrices below the Gram matrix of the basis. They are computed only if a proof needs many
    /// nodes.
    pub diagonals: Option<Diagonals>,
    /// The splits of its bound. They are computed only if a proof needs very many nodes.
    pub splits: Option<Splits>,
    /// The relaxation's integers.
    pub target: Target,
    /// The steps from the target's whole part to the best point so far.
    pub z: Vec<i64>,
    /// The squared distance of the best point.
    pub value: f64,
    /// Every point that was not evaluated has at least this squared distance.
    pub bound: f64,
    /// Whether every point that may be better than the best one has been evaluated.
    pub proved: bool,
}

impl Piece {
    /// The predicted number of nodes in an enumeration of the ball of the best point.
    pub fn predicted_nodes(&self) -> f64 {
        predicted_nodes(&self.basis, self.diagonals.as_ref(), self.value)
    }

    /// Searches a ball around its target, with the best of the bounds that it has.
    pub fn search(&self, limits: Limits, stop: &mut dyn FnMut(u64) -> bool) -> Enumerated {
        let (basis, target) = (&self.basis, &self.target);
        let by_splits = self.splits.as_ref();
        by_splits
            .and_then(|splits| enumerate_split(basis, target, splits, limits, stop))
            .unwrap_or_else(|| enumerate(basis, target, self.diagonals.as_ref(), limits, stop))
    }

    /// Whether its vectors are independent.
    pub fn is_regular(&self) -> bool {
        self.basis.is_discrete() && self.basis.rank() == self.basis.dim()
    }

    /// Replaces the best point by `z` if `z` is closer to the target.
    pub fn take(&mut self, z: Vec<i64>) -> bool {
        let value = self.target.distance(&self.basis, &z);
        let better = value < self.value * (1.0 - super::NEARER);
        if better {
            (self.z, self.value) = (z, value);
        }
        better
    }
}

/// Splits the lattice with the upper triangular factor `r` of `m` columns into pieces (`full`: no diagonal
/// entry is zero). It reduces each piece and finds its nearest-plane point from `point`. If `stop` ends a
/// reduction, the points are still valid but farther away.
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
            splits: None,
            target,
            z,
        })
    };
    components(m, r).into_iter().map(make).collect()
}

/// The groups of columns that share rows, directly or through others. The groups and the columns in them
/// are in increasing order.
fn components(m: usize, r: &[f64]) -> Vec<Vec<usize>> {
    let mut sets = DisjointSets::new(m);
    for j in 0..m {
        for i in (0..j).filter(|i| r[j * m + i] != 0.0) {
            sets.join(i, j);
        }
    }
    sets.sets()
}

/// The integers of the best points of all pieces.
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
        // Columns 0 and 2 are coupled; column 1 is not.
        let r = [2.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.5, 0.0, 3.0];
        let parts = pieces(3, &r, true, &[0.2, 1.7, -4.1], &mut |_| false).unwrap();
        let places: Vec<_> = parts.iter().map(|p| p.places.clone()).collect();
        assert_eq!(places, [vec![0, 2], vec![1]]);
        assert_eq!(assemble(&parts, 3).unwrap(), [0.0, 2.0, -4.0]);
    }
}
