//! Curvature.
