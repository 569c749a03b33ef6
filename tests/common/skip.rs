//! Tests of what a machine may not have.

use std::io::{Write, stderr};

/// Says that a test does nothing here, and why. The harness keeps to itself what a passing test prints by
/// macros, so this goes to the terminal directly.
pub fn skip(reason: &str) {
    let thread = std::thread::current();
    let test = thread.name().unwrap_or("a test");
    // Where there is no terminal, nobody is there to be told.
    let _ = writeln!(stderr(), "SKIPPED {test}: {reason}");
}

/// The same for what a machine that tests every change has to have: fails where CI is set.
pub fn skip_unless_ci(reason: &str) {
    let ci = std::env::var_os("CI").is_some_and(|ci| !ci.is_empty() && ci != "false");
    assert!(!ci, "not to be skipped where CI is set: {reason}");
    skip(reason);
}
