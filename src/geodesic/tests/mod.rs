//! Geodesic distances against closed forms, an exhaustive search, and each other.

mod anywhere;
mod bad_input;
mod brute;
mod closed_forms;
mod drawn;
mod exact;
mod invariance;
mod polylines;
