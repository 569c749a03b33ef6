//! The seamless parametrization that follows a field, as a mixed-integer problem: coordinates on the
//! surface cut open, integer translations over the cut.
//!
//! `bommes2009`, section 5; `bommes2012`, section 8.4. A client of the solver: it builds a
//! [`Problem`](crate::Problem) and reads a [`Solution`](crate::Solution).

mod combing;
mod cone_paths;
mod cut_graph;
mod dirichlet;
mod feature_strips;
mod from_values;
mod in_order;
mod isolines;
mod problem;
mod seamless_map;
mod seams;
mod sectors;
mod separation;
mod sizing;
mod uv_obj;
mod winding_defects;

pub use combing::Combing;
pub use cut_graph::CutGraph;
pub use problem::{SeamlessOptions, SeamlessProblem, TRANSLATION_WEIGHT};
pub use seamless_map::{SeamlessMap, Transition};
pub use sizing::Sizing;

pub(crate) use from_values::gradient;
pub(crate) use in_order::ReorderedProblem;
pub(crate) use separation::{apart, constraints_of, row};
pub(crate) use winding_defects::{has_winding_defect, winding_defects};
