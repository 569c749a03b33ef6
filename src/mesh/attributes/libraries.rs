//! The files of materials, named from another folder.

use std::path::{Component, Path, PathBuf};

use super::SurfaceAttributes;

impl SurfaceAttributes {
    /// Names the files of materials from folder `to` instead of folder `from`, so that a mesh there finds them. Both
    /// folders exist.
    pub fn move_libraries(&mut self, from: &Path, to: &Path) {
        let libraries = std::mem::take(&mut self.libraries);
        let names = libraries.iter().flat_map(|said| names(said, from));
        self.libraries = names.map(|name| moved(&name, from, to)).collect();
    }
}

/// The names that a statement has: its words if all of them are names of such files, unless there is a file of the
/// whole name.
fn names(said: &str, folder: &Path) -> Vec<String> {
    let is_library = |word: &str| {
        let extension = Path::new(word).extension();
        extension.is_some_and(|extension| extension.eq_ignore_ascii_case("mtl"))
    };
    let mut words = said.split_whitespace();
    match !folder.join(said).is_file() && words.all(is_library) {
        true => said.split_whitespace().map(str::to_owned).collect(),
        false => vec![said.to_owned()],
    }
}

fn moved(name: &str, from: &Path, to: &Path) -> String {
    let resolved = |folder: &Path| {
        let folder = match folder == Path::new("") {
            true => Path::new("."),
            false => folder,
        };
        folder.canonicalize().unwrap_or_else(|_| folder.to_owned())
    };
    let (from, to) = (resolved(from), resolved(to));
    if from == to || Path::new(name).is_absolute() {
        return name.to_owned();
    }
    let path = relative(&from, &to).join(name);
    // A backslash would be read as a part of a name by other systems.
    path.to_string_lossy()
        .replace(std::path::MAIN_SEPARATOR, "/")
}

/// The way from folder `to` to folder `from`; `from` itself where there is none, as between two drives.
fn relative(from: &Path, to: &Path) -> PathBuf {
    let is_shared = |(a, b): &(Component, Component)| a == b;
    let shared = from.components().zip(to.components()).take_while(is_shared);
    let shared = shared.count();
    if shared == 0 {
        return from.to_owned();
    }
    let up = to.components().skip(shared).map(|_| Component::ParentDir);
    up.chain(from.components().skip(shared)).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_way_between_folders_goes_up_and_down() {
        for (from, to, way) in [
            ("/a/b", "/a/b/c", ".."),
            ("/a/b", "/a", "b"),
            ("/a/b/c", "/a/d/e", "../../b/c"),
            ("/a", "/a", ""),
        ] {
            assert_eq!(relative(Path::new(from), Path::new(to)), Path::new(way));
        }
    }

    #[test]
    fn libraries_are_found_from_another_folder() {
        let folder = std::env::temp_dir().join(format!("roundel-libraries-{}", std::process::id()));
        let (from, to) = (folder.join("from"), folder.join("to"));
        for folder in [&from, &to] {
            std::fs::create_dir_all(folder).unwrap();
        }
        std::fs::write(from.join("of two words.mtl"), "").unwrap();
        let given = ["of two words.mtl", "a.mtl b.mtl", "/c.mtl"].map(str::to_owned);
        let mut attributes = SurfaceAttributes {
            libraries: given.to_vec(),
            ..SurfaceAttributes::default()
        };
        attributes.move_libraries(&from, &to);
        let moved = [
            "../from/of two words.mtl",
            "../from/a.mtl",
            "../from/b.mtl",
            "/c.mtl",
        ];
        assert_eq!(attributes.libraries, moved);
        assert!(to.join(&attributes.libraries[0]).is_file());
        std::fs::remove_dir_all(folder).unwrap();
    }
}
