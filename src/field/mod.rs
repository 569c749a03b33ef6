//! The orientation field of a mesh as a mixed-integer problem: one angle for each face, one period jump
//! for each edge.
//!
//! `bommes2009`, section 4; `bommes2012`, section 8.2. A client of the solver: it builds a
//! [`Problem`](crate::Problem) and reads a [`Solution`](crate::Solution).

mod clearance;
mod curvature_guidance;
mod curve_guides;
mod detail;
mod directions;
mod feasible_indices;
mod feature_alignment;
mod file;
mod graded_flow;
mod guidance;
mod guidance_file;
mod in_order;
mod index;
mod options;
mod orientation_field;
mod prescribed_indices;
mod problem;
mod regular_vertices;
mod solve_field;
mod spanning_forest;
mod traced_index;

pub use clearance::near_features;
pub use curvature_guidance::{curvature_constraints, curvature_guides};
pub use curve_guides::guides_along;
pub use feature_alignment::feature_constraints;
pub use guidance::{GUIDANCE_OPTIONS, Guidance};
pub use options::{Constraint, FieldOptions, Guide, PrescribedIndex};
pub use orientation_field::OrientationField;
pub use problem::FieldProblem;
pub use solve_field::{smoothest_field, solve_field};

pub(crate) use solve_field::{DirectionProblem, JumpsDecided, decide_jumps};
