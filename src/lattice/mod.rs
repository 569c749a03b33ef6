//! Closest lattice points: reduction, nearest plane, enumeration with proof.
//!
//! The Gram matrix of the lattice is the Schur complement of the integers. Its factor is the trailing block
//! of [`SchurFactor`](crate::linalg::SchurFactor).

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
mod semidefinite;
mod split_tree;
mod splits;
mod strategy;
mod target;
mod transform;
mod tree;

pub(crate) use affine_lattice::AffineLattice;
pub(crate) use basis::Basis;
pub(crate) use beam::beam;
pub(crate) use blocks::{Blocks, improve_blocks};
pub(crate) use closest::{DEPTH, closest, reduced};
pub(crate) use diagonal::Diagonals;
pub(crate) use enumerate::{Limits, enumerate};
pub(crate) use gram::Gram;
pub(crate) use lll::lll;
pub(crate) use near_points::NEARER;
pub(crate) use nearest_plane::nearest_plane;
pub(crate) use pieces::{Piece, assemble, pieces};
pub(crate) use prove::{predicted_nodes, radius_for};
pub(crate) use split_tree::enumerate_split;
pub(crate) use splits::Splits;
pub(crate) use strategy::{exact, lattice};
pub(crate) use target::Target;
pub(crate) use transform::Transform;

#[cfg(test)]
mod tests;
