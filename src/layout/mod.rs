//! Layouts: from a base layout that a user gives to quads, and from quads back to their layout.
//!
//! A layout is a coarse mesh of polygons. Its vertices mark points of a surface, its edges are arcs between them, its
//! polygons are patches. It fixes the irregular vertices of the quads; left to decide are where arcs run, how many
//! edges of quads each gets, and where the quads lie (`bommes2012`, chapter 7).
//!
//! | step | file |
//! | --- | --- |
//! | the layout | `base_layout`, `drawn_layout`, `file` |
//! | arcs that are given | `given` |
//! | arcs on the surface | `embed` |
//! | edges of quads along each arc | `subdivide` |
//! | patches of other than four sides | `rectangles` |
//! | the map of all patches | `grid` |
//! | which quads fill which patch | `correspondence` |
//! | all steps | `layout_quads` |
//! | the way back, from quads to their layout | [`found`] |

mod base_layout;
mod correspondence;
mod drawn_layout;
mod embed;
#[cfg(feature = "mesh-io")]
mod file;
pub mod found;
mod given;
mod grid;
mod layout_quads;
mod rectangles;
mod subdivide;

pub use base_layout::BaseLayout;
pub use drawn_layout::DrawnLayout;
#[cfg(feature = "mesh-io")]
pub use file::{parse_layout, read_layout};
pub use layout_quads::{LayoutOptions, LayoutQuads, layout_quads};
pub use subdivide::{LayoutSizing, Subdivisions};
