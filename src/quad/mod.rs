//! From a triangle mesh to quads: the drivers of all steps.
//!
//! | what | file |
//! | --- | --- |
//! | quads, from the mesh on | `driver` |
//! | a map without folds, from its problem on | `fold_free` |
//! | a field and the map at hand | `field_map` |
//! | which field is followed | `fields`, `aim` |
//! | a map's problem solved again and again | `map_solver` |
//! | quads of one map | `attempt`, `missed` |
//! | what is better | `outcome` |

mod aim;
mod attempt;
mod compare;
mod driver;
mod field_map;
mod fields;
mod fold_free;
mod map_solver;
mod missed;
mod options;
mod outcome;
mod quadrangulation;

pub use compare::Compared;
pub use driver::quadrangulate;
pub use fold_free::{FoldFreeMap, solve_fold_free};
pub use options::{QUAD_OPTIONS, QuadOptions};
pub use quadrangulation::{QuadSeconds, Quadrangulation};
