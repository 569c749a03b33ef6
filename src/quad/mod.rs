//! From a triangle mesh to quads: the driver of all steps.

mod aim;
mod attempt;
mod compare;
mod fields;
mod missed;
mod options;
mod quadrangulate;

pub use compare::Compared;
pub use options::{QUAD_OPTIONS, QuadOptions};
pub use quadrangulate::{QuadSeconds, Quadrangulation, quadrangulate};
