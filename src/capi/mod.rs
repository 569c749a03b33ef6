//! The C interface: the only place where `unsafe` is allowed.
