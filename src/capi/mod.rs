//! The C interface: the only place where `unsafe` is allowed.
//!
//! One file an object; the header `include/roundel/roundel.h` is generated from these files by
//! cbindgen, comments included, and `tests/header.rs` holds the two together. Every entry goes
//! through `guard`, which keeps panics in, and every array through `input`, which checks
//! pointers, lengths and indices before a slice is made of them.
//!
//! What callers owe, for every function: a pointer that is not NULL points to live memory of the
//! type and length given, a handle comes from this library and has not been freed, and nobody
//! writes to either during the call.

#![allow(unsafe_code)]
#![allow(non_camel_case_types, reason = "the types carry their C names")]
#![allow(
    clippy::missing_safety_doc,
    reason = "what callers owe is the same everywhere and said above and in the header"
)]
#![allow(
    rustdoc::broken_intra_doc_links,
    reason = "the comments are C's, where x[k] is an entry and no link"
)]

mod abi;
mod attribute_edges;
mod attributes;
mod cancel;
mod constraints;
mod curvature;
mod curves;
mod cut;
mod edit_kind;
mod error;
mod event;
mod failure;
mod field;
mod field_problem;
mod files;
mod geodesic;
mod geodesic_sources;
mod guard;
mod guidance;
mod guidance_files;
mod hints;
mod inequalities;
mod input;
mod layout;
mod lazy_rows;
mod least_squares;
mod map;
mod map_fold_free;
mod map_results;
mod matrix;
mod memory;
mod mesh;
mod mesh_files;
mod mirror;
mod objective;
mod option_list;
mod options;
mod output;
#[cfg(all(test, feature = "test-panic"))]
mod panic_tests;
mod presets;
mod problem;
mod proof;
mod quad_options;
mod quads;
mod quads_results;
mod repair;
mod repair_options;
mod solution;
mod solve;
mod solver;
mod soup;
mod status;
#[cfg(feature = "test-panic")]
mod test_panic;
mod transfer;
mod unknowns;
mod version;

pub use abi::*;
pub use attribute_edges::*;
pub use attributes::*;
pub use cancel::*;
pub use constraints::*;
pub use curvature::*;
pub use curves::*;
pub use cut::*;
pub use edit_kind::*;
pub use error::*;
pub use event::*;
pub use field::*;
pub use field_problem::*;
pub use files::*;
pub use geodesic::*;
pub use geodesic_sources::*;
pub use guidance::*;
pub use hints::*;
pub use inequalities::*;
pub use layout::*;
pub use lazy_rows::*;
pub use least_squares::*;
pub use map::*;
pub use map_fold_free::*;
pub use map_results::*;
pub use memory::{peak_memory, release_free_memory};
pub use mesh::*;
pub use mesh_files::*;
pub use objective::*;
pub use option_list::*;
pub use options::*;
pub use presets::*;
pub use problem::*;
pub use proof::*;
pub use quad_options::*;
pub use quads::*;
pub use quads_results::*;
pub use repair::*;
pub use repair_options::*;
pub use solution::*;
pub use solve::*;
pub use solver::*;
pub use soup::*;
pub use status::*;
#[cfg(feature = "test-panic")]
pub use test_panic::*;
pub use transfer::*;
pub use unknowns::*;
pub use version::*;
