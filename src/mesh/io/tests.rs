//! Properties of the readers and writers.
