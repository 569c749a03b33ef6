//! The files that a run is to write, checked before it reads anything.
//!
//! A format that cannot be written, a folder that is not there and a file that may not be written are told
//! before hours of work, and no file that is read is overwritten by chance.

use std::fs::{self, File, OpenOptions};
use std::io::{self, ErrorKind};
use std::path::{Path, PathBuf};

use roundel::mesh::io::format_of;
use roundel::{Error, Result};

use crate::output::{self, io_error};

/// Flags of what a command writes beside its files.
#[derive(Debug, Clone, clap::Args)]
pub struct OutputFlags {
    /// Overwrite a file that is read
    #[arg(long, help_heading = "Output")]
    pub force: bool,

    /// Draw no progress
    #[arg(short, long, help_heading = "Output")]
    pub quiet: bool,
}

/// What a file is to hold.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Content {
    /// A mesh in one of the formats that can be written.
    Mesh,
    /// A field: text, or a mesh that shows it.
    Field,
    /// A file with one of these extensions.
    Only(&'static [&'static str]),
    /// Text, whatever the name.
    Text,
}

/// A mesh with texture coordinates.
pub const MAP: Content = Content::Only(&["obj"]);
/// A problem.
pub const PROBLEM: Content = Content::Only(&["mps", "mps.gz", "lp", "lp.gz"]);
/// A trace.
pub const TRACE: Content = Content::Only(&["json"]);
/// A picture.
pub const PICTURE: Content = Content::Only(&["png"]);
/// A page for a browser.
pub const PAGE: Content = Content::Only(&["html", "htm"]);

/// The files that a run reads and writes.
pub struct Outputs<'a> {
    read: Vec<&'a Path>,
    written: Vec<&'a Path>,
    force: bool,
}

impl<'a> Outputs<'a> {
    /// A run that reads these files, of which the first is its input.
    pub fn of(read: &[Option<&'a Path>], force: bool) -> Self {
        Outputs {
            read: read.iter().flatten().copied().collect(),
            written: Vec::new(),
            force,
        }
    }

    /// Checks a file that is to be written, if there is one.
    ///
    /// # Errors
    /// For a format that cannot be written, a folder that is not there, a file that may not be written, one
    /// that is read as well, and one that is written twice.
    pub fn write(mut self, file: Option<&'a PathBuf>, content: Content) -> Result<Self> {
        let Some(file) = file else {
            return Ok(self);
        };
        content.check(file)?;
        check_place(file)?;
        let is_same = |other: &&&Path| same(other, file);
        if self.written.iter().any(|other| is_same(&other)) {
            return Err(refused(format!("{}: written twice", file.display())));
        }
        if !self.force && self.read.iter().any(|other| is_same(&other)) {
            return Err(refused(format!(
                "{}: the run reads this file, and would overwrite it; --force allows that",
                file.display()
            )));
        }
        self.written.push(file);
        Ok(self)
    }

    /// Tells people before the run starts if it writes no file, unless they want to hear nothing.
    pub fn tell(self, silent: bool) {
        if self.written.is_empty() && !silent {
            let input = self.read.first().copied().unwrap_or(Path::new("-"));
            output::note(input, "no file will be written: there is no -o");
        }
    }
}

impl Content {
    fn check(self, file: &Path) -> Result<()> {
        match self {
            Content::Text => Ok(()),
            Content::Field if has_extension(file, "txt") => Ok(()),
            Content::Mesh | Content::Field => match format_of(file) {
                Ok(_) => Ok(()),
                Err(error) => Err(refused(format!("{}: {error}", file.display()))),
            },
            Content::Only(known) if known.iter().any(|known| has_extension(file, known)) => Ok(()),
            Content::Only(known) => Err(refused(format!(
                "{}: cannot be written in this format; the name must end in .{}",
                file.display(),
                known.join(" or .")
            ))),
        }
    }
}

fn has_extension(file: &Path, extension: &str) -> bool {
    let name = file.to_string_lossy().to_lowercase();
    name.ends_with(&format!(".{extension}"))
}

/// Whether a file can be written in its folder.
fn check_place(file: &Path) -> Result<()> {
    let written = match fs::metadata(file) {
        Ok(found) if found.is_dir() => Err(ErrorKind::IsADirectory.into()),
        // It is opened, and not truncated.
        Ok(_) => OpenOptions::new().write(true).open(file).map(drop),
        Err(_) => check_folder(folder_of(file)),
    };
    written.map_err(|reason| io_error(&file.to_string_lossy(), &reason))
}

/// Whether a file can be made in this folder: one is made, and removed again.
fn check_folder(folder: &Path) -> io::Result<()> {
    if !folder.is_dir() {
        let text = format!("there is no folder {}", folder.display());
        return Err(io::Error::new(ErrorKind::NotFound, text));
    }
    let trial = folder.join(format!(".roundel-{}", std::process::id()));
    File::create_new(&trial)?;
    fs::remove_file(&trial)
}

/// The folder of a file.
pub fn folder_of(file: &Path) -> &Path {
    match file.parent() {
        Some(folder) if folder != Path::new("") => folder,
        _ => Path::new("."),
    }
}

/// Whether two names are those of one file.
fn same(a: &Path, b: &Path) -> bool {
    let resolved = |file: &Path| -> Option<PathBuf> {
        if let Ok(found) = fs::canonicalize(file) {
            return Some(found);
        }
        Some(
            fs::canonicalize(folder_of(file))
                .ok()?
                .join(file.file_name()?),
        )
    };
    match (resolved(a), resolved(b)) {
        (Some(a), Some(b)) => a == b,
        _ => false,
    }
}

/// The error of a file that is not written. Its text names the file.
fn refused(message: String) -> Error {
    Error::Io { message }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_name_has_its_extension_in_any_case() {
        assert!(PROBLEM.check(Path::new("a/P.MPS.gz")).is_ok());
        assert!(MAP.check(Path::new("uv.OBJ")).is_ok());
        assert!(Content::Field.check(Path::new("field.TXT")).is_ok());
        for (content, name) in [
            (MAP, "uv.stl"),
            (PROBLEM, "p.gz"),
            (PICTURE, "picture"),
            (Content::Mesh, "x.doc"),
            (Content::Field, "x.doc"),
        ] {
            assert!(content.check(Path::new(name)).is_err(), "{name}");
        }
    }

    #[test]
    fn a_name_with_a_detour_is_the_same_file() {
        let folder = std::env::temp_dir();
        let plain = folder.join("not-there.obj");
        assert!(same(&plain, &folder.join(".").join("not-there.obj")));
        assert!(!same(&plain, &folder.join("other.obj")));
    }
}
