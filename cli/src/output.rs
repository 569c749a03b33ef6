//! Output to files and to standard output, with the file's name in every error.

use std::fs::File;
use std::io::{self, BufWriter, Write};
use std::path::Path;

use roundel::extract::QuadMesh;
use roundel::mesh;
use roundel::mesh::attributes::SurfaceAttributes;
use roundel::{Error, Proof, Result};
use serde::Serialize;

use crate::exit::Exit;
use crate::interrupt;
use crate::report::Failure;

/// Writes one line `NAME VALUE` for each variable, with the 17 significant digits that give every
/// double back exactly.
pub fn write_values(path: &Path, names: &[String], values: &[f64]) -> Result<()> {
    let write = || -> io::Result<()> {
        let mut file = BufWriter::new(File::create(path)?);
        for (name, value) in names.iter().zip(values) {
            writeln!(file, "{name} {value:.16e}")?;
        }
        file.flush()
    };
    write().map_err(|reason| io_error(&path.to_string_lossy(), &reason))
}

/// Writes a proof.
pub fn write_proof(path: &Path, proof: &Proof) -> Result<()> {
    let write = || -> io::Result<()> { proof.write(BufWriter::new(File::create(path)?)) };
    write().map_err(|reason| io_error(&path.to_string_lossy(), &reason))
}

/// The version of `docs/program.schema.json`, which describes every object that is printed.
const SCHEMA: u32 = 1;

/// An object with the version of its schema.
#[derive(Serialize)]
struct Versioned<'a, T> {
    schema: u32,
    #[serde(flatten)]
    object: &'a T,
}

/// Prints one JSON object, with the version of its schema, and a line end.
pub fn print_json(object: &impl Serialize) -> Result<()> {
    let versioned = Versioned {
        schema: SCHEMA,
        object,
    };
    let text = serde_json::to_string_pretty(&versioned).map_err(|reason| Error::Io {
        message: reason.to_string(),
    })?;
    print(&format!("{text}\n"))
}

/// Prints `text`. Unlike `print!`, it does not panic if the output is closed.
pub fn print(text: &str) -> Result<()> {
    let mut stdout = io::stdout().lock();
    stdout
        .write_all(text.as_bytes())
        .and_then(|()| stdout.flush())
        .map_err(|reason| io_error("standard output", &reason))
}

/// Ends a command on `file`, which has printed its result if there is one. An error is printed here: on
/// stdout as JSON if `json`, else on stderr.
pub fn conclude(file: &Path, json: bool, told: Result<()>) -> Exit {
    let Err(error) = told else {
        return match interrupt::was_asked() {
            true => Exit::Finished,
            false => Exit::Solved,
        };
    };
    if !json || print_json(&Failure::new(file, &error)).is_err() {
        complain(file, &error);
    }
    Exit::of(&error)
}

/// Prints an error on stderr, for people.
pub fn complain(file: &Path, error: &Error) {
    let text = named_once(file, error);
    // If stderr is closed, nobody reads the error.
    let _ = writeln!(io::stderr(), "roundel: {text}");
}

/// The text of an error, with the name of the file that it is about, once.
fn named_once(file: &Path, error: &Error) -> String {
    let (text, file) = (error.to_string(), file.to_string_lossy());
    match error {
        // The message names the file that could not be read or written.
        Error::Io { message } => message.clone(),
        _ if text.contains(&*file) => text,
        _ => format!("{file}: {text}"),
    }
}

/// Prints what a person should know about a file on stderr.
pub fn note(file: &Path, text: &str) {
    // If stderr is closed, nobody reads the note.
    let _ = writeln!(io::stderr(), "roundel: {}: {text}", file.display());
}

/// Writes one JSON object and a line end to a file.
pub fn write_json(path: &Path, object: &impl Serialize) -> Result<()> {
    let write = || -> io::Result<()> {
        let mut file = BufWriter::new(File::create(path)?);
        serde_json::to_writer(&mut file, object)?;
        file.write_all(b"\n")?;
        file.flush()
    };
    write().map_err(|reason| io_error(&path.to_string_lossy(), &reason))
}

/// The error of a file or stream that cannot be read or written.
pub fn io_error(name: &str, reason: &io::Error) -> Error {
    Error::Io {
        message: format!("{name}: {reason}"),
    }
}

/// Writes quads with their attributes, and says on stderr where the format holds triangles only.
pub fn write_quads(quads: &QuadMesh, attributes: &SurfaceAttributes, file: &Path) -> Result<()> {
    let format = mesh::io::format_of(file)?;
    quads.write_with(file, attributes)?;
    if !format.holds_polygons() {
        let _ = writeln!(
            io::stderr(),
            "{}: {} holds no quads; each is written as two triangles",
            file.display(),
            format.name()
        );
    }
    Ok(())
}
