//! What the library promises, one promise a file. All are one program: it is linked once.

#[path = "../common/mod.rs"]
mod common;

mod adaptive;
mod attributes;
mod bounded;
mod clearance;
mod determinism;
mod extract;
mod extremes;
mod field;
mod finish;
mod greedy;
mod grid_map;
mod guidance;
#[cfg(feature = "mesh-io")]
mod guide_curves;
mod integer_chains;
mod invariance;
mod isolines;
mod layout;
#[cfg(feature = "mesh-io")]
mod layout_found;
#[cfg(feature = "mesh-io")]
mod mesh_archive;
mod multiple;
mod progress;
mod quad_count;
mod quadrangulate;
mod quads_of_odd_meshes;
mod refine;
mod resolve;
mod scale;
mod seamless;
mod singular;
mod tried_again;
mod varying_sizes;
