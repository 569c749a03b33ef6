//! Free-format MPS, reading and writing.
