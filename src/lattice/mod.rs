//! Closest lattice points: reduction, nearest plane, enumeration with proof.

mod basis;
mod closest;
mod enumerate;
mod gram;
mod lll;
mod nearest_plane;
mod schur;
mod target;
mod transform;

pub use basis::Basis;
pub use closest::{Closest, DEPTH, closest};
pub use enumerate::{Enumerated, Limits, NEARER, enumerate};
pub use gram::{Gram, RANK_TOLERANCE};
pub use lll::{LOVASZ, is_reduced, lll};
pub use nearest_plane::nearest_plane;
pub use schur::schur_factor;
pub use target::Target;
pub use transform::Transform;

#[cfg(test)]
mod tests;
