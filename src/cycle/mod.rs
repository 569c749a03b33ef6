//! Angle-difference systems in the space of their cycles: orientation fields, phase unwrapping,
//! angular synchronisation, with any number of integers.
//!
//! A problem whose terms are `w (x_i - x_j + step p + r)^2`, each with an integer p of its own,
//! lives on a graph. Around its cycles the angles cancel, and what is left is a closest-vector
//! problem in the integer *charges* of a basis of cycles, whose matrix is the inverse of a sparse
//! Laplacian ([`space`]). The way through this module:
//!
//! ```text
//! ReducedModel --detect--> AngleSystem --short, fundamental, basis--> CycleSpace (laplacian)
//!     --plane--> charges --block, decide, improve--> charges --lift--> integers
//! ```
//!
//! Known angles are merged into one node, the *ground*. Measured on orientation fields with a
//! tenth of the faces known: the basis stays as short as that of rings (5 to 6 edges on average),
//! since most of what it adds are arcs through the ground, and sparse with it.

mod basis;
mod block;
mod closest;
mod cycles;
mod detect;
mod forest;
mod fundamental;
mod graph;
mod hint;
mod improve;
mod laplacian;
mod lift;
mod plane;
mod short;
mod space;
mod strategy;

pub(crate) use strategy::{auto, lattice};

#[cfg(test)]
mod tests;
