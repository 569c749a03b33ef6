//! From quads back to their layout.
//!
//! | idea | file |
//! | --- | --- |
//! | quads, checked, with half-edges | `surface`, `error` |
//! | walls that leave rectangles | `walls`, `rectangle` |
//! | the base complex, and the motorcycle graph | `base`, `motorcycle` |
//! | nodes, arcs and patches | `layout` |
//! | files | `layout_obj`, `spline_files`, `spline_step` |
//! | patches as surfaces | `splines`, `spline` |
//! | fewer patches | `simplified`, `coarse`, `triangulated`, `relax`, `drift` |

mod base;
mod coarse;
mod drift;
mod error;
mod layout;
mod layout_obj;
mod motorcycle;
mod rectangle;
mod relax;
mod simplified;
mod spline;
mod spline_files;
mod spline_step;
mod splines;
mod surface;
#[cfg(test)]
mod tests;
mod triangulated;
mod walls;

pub use drift::Drift;
pub use error::FoundError;
pub use layout::{FoundLayout, LayoutArc, LayoutPatch};
pub(super) use layout_obj::save;
pub use simplified::{Simplified, SimplifyOptions, simplify};
pub use splines::{SplinePatches, SplineSurface};
pub use surface::QuadSurface;
