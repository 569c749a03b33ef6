//! The meshes that Debian ships with CGAL's demos.
//!
//! `ROUNDEL_CGAL_DATA` names the archive or the folder that it was unpacked to. Without it, they are looked for where
//! Debian's `libcgal-demo` puts the archive.

use std::path::{Path, PathBuf};
use std::process::Command;
use std::sync::OnceLock;

const DEBIAN: &str = "/usr/share/doc/libcgal-dev/data.tar.gz";

/// Why tests are skipped where there are none.
pub const MISSING: &str = "libcgal-demo is not installed, and ROUNDEL_CGAL_DATA is not set";

/// The folder of the meshes. Tests run in parallel, so the first that asks unpacks the archive.
pub fn archive() -> Option<PathBuf> {
    static FOLDER: OnceLock<Option<PathBuf>> = OnceLock::new();
    FOLDER.get_or_init(unpacked).clone()
}

fn unpacked() -> Option<PathBuf> {
    let given = std::env::var_os("ROUNDEL_CGAL_DATA").map(PathBuf::from);
    let place = given.clone().unwrap_or_else(|| PathBuf::from(DEBIAN));
    if place.is_dir() {
        let inner = place.join("data/meshes");
        return Some(if inner.is_dir() { inner } else { place });
    }
    if !place.is_file() {
        assert!(
            given.is_none(),
            "ROUNDEL_CGAL_DATA names nothing: {}",
            place.display()
        );
        return None;
    }
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("cgal-data");
    std::fs::create_dir_all(&folder).expect("a folder");
    let tar = Command::new("tar")
        .args([Path::new("-xzf"), &place, Path::new("-C"), &folder])
        .status()
        .expect("tar");
    assert!(tar.success());
    Some(folder.join("data/meshes"))
}
