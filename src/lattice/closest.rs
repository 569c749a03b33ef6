//! The closest lattice point of a small dense lattice: reduction, nearest plane and enumeration.

use super::{Basis, Gram, Limits, Target, enumerate, lll, nearest_plane};
use crate::error::Result;

/// The largest number of places by which a deep insertion moves a vector forward.
pub const DEPTH: usize = 20;

/// The best lattice point of the search.
#[derive(Debug, Clone, PartialEq)]
pub struct Closest {
    /// Its integers.
    pub point: Vec<i64>,
    /// `(point - target)' G (point - target)`, in the arithmetic of the reduced basis.
    pub value: f64,
    /// Nodes of the enumeration.
    pub nodes: u64,
    /// Whether it is proved that no point is closer (up to [`NEARER`](super::NEARER)).
    pub complete: bool,
}

/// The reduced basis of the lattice with this Gram matrix.
///
/// # Errors
/// Those of [`lll`].
pub fn reduced(gram: &Gram) -> Result<Basis> {
    let mut basis = Basis::new(gram);
    lll(&mut basis, DEPTH, &mut |_| false)?;
    Ok(basis)
}

/// Minimises `(z - target)' G (z - target)` over integer z, in the [reduced] basis of the lattice with Gram matrix G,
/// with at most `nodes` nodes. The result is never worse than `start`.
///
/// # Errors
/// [`Error::Overflow`](crate::Error::Overflow) for coordinates too large to be exact.
pub fn closest(
    basis: &Basis,
    target: &[f64],
    start: Option<&[i64]>,
    nodes: u64,
) -> Result<Closest> {
    let target = Target::new(basis, target)?;
    let mut z = nearest_plane(basis, &target);
    let mut value = target.distance(basis, &z);
    if let Some(start) = start {
        let other = target.steps(basis, start)?;
        let distance = target.distance(basis, &other);
        // Without an improvement, the caller's point stays.
        if distance <= value * (1.0 + super::NEARER) {
            (z, value) = (other, distance);
        }
    }
    let limits = Limits {
        radius: value * (1.0 - super::NEARER),
        margin: 0.0,
        nodes,
    };
    let found = enumerate(basis, &target, None, limits, &mut |_| false);
    if let Some((better, distance)) = found.near.into_iter().next() {
        (z, value) = (better, distance);
    }
    Ok(Closest {
        point: target.integers(basis, &z)?,
        value,
        nodes: found.nodes,
        complete: found.complete && basis.is_discrete(),
    })
}
