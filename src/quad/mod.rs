//! From a triangle mesh towards quads: the orientation field as a mixed-integer problem.
//!
//! A client of the solver: it builds a [`Problem`](crate::Problem) and reads a
//! [`Solution`](crate::Solution).

mod constrain;
mod field;
mod forest;
mod index;
mod orientation;
mod trace;

pub use constrain::curvature_constraints;
pub use field::OrientationField;
pub use orientation::{Constraint, FieldProblem};
