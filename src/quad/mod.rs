//! From a triangle mesh towards quads: the orientation field and the seamless parametrization that
//! follows it, each as a mixed-integer problem.
//!
//! A client of the solver: it builds a [`Problem`](crate::Problem) and reads a
//! [`Solution`](crate::Solution).

mod align;
mod charges;
pub mod check;
mod comb;
mod compatible;
mod constrain;
mod cut;
mod cut_paths;
mod detail;
mod directions;
mod dirichlet;
mod extract;
mod field;
mod field_file;
mod field_options;
mod forest;
mod guidance;
mod guide_file;
mod index;
mod isolines;
mod map;
mod orientation;
mod quadrangulate;
mod seamless;
mod seams;
mod sectors;
mod sizing;
mod smooth;
mod spread;
mod strips;
mod trace;
pub mod untangle;
mod uv_obj;

pub use align::feature_constraints;
pub use comb::Combing;
pub use constrain::{curvature_constraints, curvature_guides};
pub use cut::CutGraph;
pub use extract::{
    IntegerGridMap, Origin, QuadFaults, QuadFigures, QuadMesh, RANGE, SEAM_TOLERANCE, extract,
};
pub use field::OrientationField;
pub use field_options::{Constraint, FieldOptions, Guide, PrescribedIndex};
pub use guidance::Guidance;
pub use map::{SeamlessMap, Transition};
pub use orientation::FieldProblem;
pub use quadrangulate::{Compared, QuadOptions, QuadSeconds, Quadrangulation, quadrangulate};
pub use seamless::{SeamlessOptions, SeamlessProblem, TRANSLATION_WEIGHT};
pub use sizing::Sizing;
pub use smooth::{QuadQuality, SmoothOptions, smooth};
pub use spread::{smoothest_field, solve_field};
