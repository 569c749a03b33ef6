//! Whether a map is an integer-grid map.

mod orientation;

pub use orientation::orientation;
