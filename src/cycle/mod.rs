//! Angle-difference systems in the space of their cycles: orientation fields, phase unwrapping,
//! angular synchronisation, with any number of integers.
//!
//! Each term `w (x_i - x_j + step p + r)^2` of such a problem has an integer p of its own and is an edge of
//! a graph. Around the cycles of the graph the angles cancel. The remaining unknowns are the integer
//! *charges* of a basis of cycles. They are the solution of a closest-vector problem whose matrix is the
//! inverse of a sparse Laplacian ([`space`]). The steps are:
//!
//! ```text
//! ReducedModel --detect--> AngleSystem --short, fundamental, basis--> CycleSpace (laplacian)
//!     --plane--> charges --block, decide, improve--> charges --lift--> integers
//!     --patches--> lower bound, and the optimum where the proof ends
//! ```
//!
//! All known angles are one node, the *ground*. On orientation fields with a tenth of the faces known, the
//! basis cycles have 5 to 6 edges on average, as many as without known faces. Most of the additional cycles
//! are arcs through the ground, so the Laplacian stays sparse.

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
mod offset_error;
mod patches;
mod plane;
mod short;
mod space;
mod strategy;

pub(crate) use strategy::{auto, exact, lattice};

#[cfg(test)]
mod tests;
