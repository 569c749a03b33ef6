//! Closest lattice points: reduction, nearest plane, enumeration with proof.
//!
//! The lattice is that of the Schur complement of the integers, whose factor is the trailing block of
//! [`SchurFactor`](crate::linalg::SchurFactor).

mod affine_lattice;
mod basis;
mod beam;
mod blocks;
mod certificate;
mod closest;
mod diagonal;
mod enumerate;
mod gram;
mod lll;
mod near_points;
mod nearest_plane;
mod pieces;
mod prove;
mod strategy;
mod target;
mod transform;
mod tree;

pub use affine_lattice::AffineLattice;
pub use basis::Basis;
pub use beam::beam;
pub use blocks::improve_blocks;
pub use closest::{Closest, DEPTH, closest};
pub use diagonal::Diagonals;
pub use enumerate::{Enumerated, Limits, enumerate};
pub use gram::{Gram, RANK_TOLERANCE};
pub use lll::{LOVASZ, is_reduced, lll};
pub use near_points::{MOST, NEARER};
pub use nearest_plane::nearest_plane;
pub use pieces::{Piece, assemble, pieces};
pub use prove::{predicted_nodes, radius_for};
pub(crate) use strategy::{exact, lattice};
pub use target::Target;
pub use transform::Transform;

#[cfg(test)]
mod tests;
