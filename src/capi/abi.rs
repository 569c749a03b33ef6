//! The ABI number, alone in its file because the build script reads it too.

/// Number of the binary interface, and the last part of the shared library's SONAME. It changes
/// only when a program that was linked against an older library could no longer run.
pub const ROUNDEL_ABI_VERSION: i32 = 1;
