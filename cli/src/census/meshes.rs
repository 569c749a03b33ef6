//! The meshes of a folder.

use std::fs;
use std::path::{Path, PathBuf};
use std::time::UNIX_EPOCH;

use roundel::Result;

use crate::output::io_error;

/// Extensions of files that are read.
const KNOWN: [&str; 6] = ["obj", "off", "ply", "stl", "gltf", "glb"];

/// A file of the folder.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) struct MeshFile {
    /// Its path from the folder on, with `/`.
    pub name: String,
    pub path: PathBuf,
    pub bytes: u64,
    /// Seconds since 1970.
    pub modified: u64,
}

/// The meshes in a folder and its folders, by name.
///
/// # Errors
/// For a folder that cannot be read.
pub(super) fn find(folder: &Path) -> Result<Vec<MeshFile>> {
    let mut found = Vec::new();
    let mut folders = vec![(folder.to_owned(), String::new())];
    while let Some((folder, prefix)) = folders.pop() {
        let failed = |reason| io_error(&folder.to_string_lossy(), &reason);
        for entry in fs::read_dir(&folder).map_err(failed)? {
            let entry = entry.map_err(failed)?;
            let name = format!("{prefix}{}", entry.file_name().to_string_lossy());
            // Links are followed, except to folders, which might be around this one.
            let Ok(about) = fs::metadata(entry.path()) else {
                continue;
            };
            if about.is_dir() {
                if entry.file_type().is_ok_and(|kind| kind.is_dir()) {
                    folders.push((entry.path(), name + "/"));
                }
                continue;
            }
            if is_mesh(&name) {
                let modified = about.modified().ok();
                let modified = modified.and_then(|time| time.duration_since(UNIX_EPOCH).ok());
                found.push(MeshFile {
                    name,
                    path: entry.path(),
                    bytes: about.len(),
                    modified: modified.map_or(0, |time| time.as_secs()),
                });
            }
        }
    }
    found.sort_by(|a, b| a.name.cmp(&b.name));
    Ok(found)
}

fn is_mesh(name: &str) -> bool {
    let name = name.to_lowercase();
    let name = name.strip_suffix(".gz").unwrap_or(&name);
    KNOWN.iter().any(|known| {
        name.strip_suffix(known)
            .is_some_and(|stem| stem.ends_with('.'))
    })
}

#[cfg(test)]
mod tests {
    use super::is_mesh;

    #[test]
    fn meshes_are_known_by_their_extension() {
        assert!(
            ["a.obj", "b.OFF", "c.ply.gz"]
                .iter()
                .all(|name| is_mesh(name))
        );
        assert!(
            !["a.txt", "obj", "b.obj.zip", "c.mtl"]
                .iter()
                .any(|name| is_mesh(name))
        );
    }
}
