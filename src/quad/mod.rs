//! From a triangle mesh to quads: the drivers of all steps.
//!
//! | idea | file |
//! | --- | --- |
//! | quads, from a mesh | `quadrangulate`, `rank`, `coverage` |
//! | other options, where quads are not good | `tries`, `final_error` |
//! | pairs of triangles, where no other quads conform | `pairs` |
//! | components whose quads are not good | `apart`, `part`, `by_component` |
//! | quads, by one set of options | `by_options`, `driver` |
//! | a part of a mesh, and its mirror images | `mirrored`, `mirror_images` |
//! | a mesh that is refined first | `refined_input` |
//! | a mesh whose neighbours are far apart in memory | `reordered_input` |
//! | a map without folds, from its problem | `fold_free` |
//! | a field and its current map | `field_map` |
//! | the choice of the field | `fields`, `stated_map`, `aim` |
//! | a number of quads, met | `count` |
//! | density painted as a colour | `painted` |
//! | quads longer than wide | `stretch` |
//! | repeated solves of a map's problem | `map_solver` |
//! | the quads of one map | `attempt`, `missed` |
//! | smaller quads where there are none | `smaller` |
//! | the ordering of results | `outcome` |

mod aim;
mod apart;
mod attempt;
mod by_component;
mod by_options;
mod clearance;
mod compare;
mod count;
mod coverage;
mod driver;
mod field_map;
mod fields;
mod final_error;
mod fold_free;
mod map_solver;
mod mirror_images;
#[cfg(test)]
mod mirror_tests;
mod mirrored;
mod missed;
mod options;
mod outcome;
mod painted;
mod pairs;
mod part;
mod quadrangulate;
mod quadrangulation;
mod rank;
mod refined_input;
mod reordered_input;
mod size_metric;
mod smaller;
mod stage_ends;
mod stated_map;
mod stretch;
mod strips;
mod tries;

pub use compare::Compared;
pub use count::Count;
pub use fold_free::{FoldFreeMap, solve_fold_free};
pub use mirrored::Mirrored;
pub use options::{Near, QUAD_OPTIONS, QuadOptions};
pub use painted::density_of_color;
pub use quadrangulate::quadrangulate;
pub use quadrangulation::{QuadSeconds, Quadrangulation};
pub use refined_input::RefinedInput;
pub use size_metric::SizeMetric;
