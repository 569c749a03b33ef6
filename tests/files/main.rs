//! Problem files: a written file reads back unchanged, and a broken one is refused with its line.

#[path = "../common/mod.rs"]
mod common;

mod broken;
#[cfg(feature = "gzip")]
mod corpus;
mod curvature;
mod dialects;
mod limits;
mod lp;
mod qplib;
mod random;
mod reading;
mod replay;
mod round_trip;
#[cfg(feature = "gzip")]
mod shared_miqp;

use std::path::PathBuf;

/// A directory for the files of one test, removed at its end.
struct Scratch(PathBuf);

impl Scratch {
    fn new(test: &str) -> Self {
        let name = format!("roundel-{test}-{}", std::process::id());
        let dir = std::env::temp_dir().join(name);
        std::fs::create_dir_all(&dir).unwrap();
        Scratch(dir)
    }

    fn file(&self, name: &str) -> PathBuf {
        self.0.join(name)
    }
}

impl Drop for Scratch {
    fn drop(&mut self) {
        let _ = std::fs::remove_dir_all(&self.0);
    }
}
