//! The meshes of the tables: from files, or procedural ones of about their size.

use std::fs;
use std::path::{Path, PathBuf};

use roundel::Result;
use roundel::mesh::{TriangleMesh, io, shape, subdivide};

use super::experiments::Subject;
use crate::output;

/// Larger procedural shapes are made by subdivision.
const DRAWN: usize = 200_000;

/// A folder for intermediate meshes and fields. It is deleted when this is dropped.
pub struct Scratch(PathBuf);

impl Scratch {
    /// A folder inside `out`.
    pub fn new(out: &Path) -> Result<Self> {
        let folder = out.join(format!("scratch-{}", std::process::id()));
        fs::create_dir(&folder)
            .map_err(|reason| output::io_error(&folder.to_string_lossy(), &reason))?;
        Ok(Scratch(folder))
    }

    /// A file in the folder.
    pub fn path(&self, name: &str) -> PathBuf {
        self.0.join(name)
    }
}

impl Drop for Scratch {
    fn drop(&mut self) {
        // What cannot be taken away stays; the tables are written all the same.
        let _ = fs::remove_dir_all(&self.0);
    }
}

/// A mesh that was found or made.
#[derive(Debug, Clone, PartialEq)]
pub struct Found {
    /// What to give the program: a file, or `shape:NAME:TRIANGLES`.
    pub mesh: PathBuf,
    /// What it is, if not the mesh itself.
    pub stand_in: Option<String>,
    /// What was done to get it, if not just reading it.
    pub made: Option<String>,
}

/// The mesh of a subject: its file, its coarser file subdivided, or a procedural stand-in.
pub fn find(subject: &Subject, folder: Option<&Path>, scratch: &Scratch) -> Result<Found> {
    if let Some(mesh) = file(folder, &subject.name) {
        return Ok(Found {
            mesh,
            stand_in: None,
            made: None,
        });
    }
    if let Some(name) = subject.coarse
        && let Some(coarse) = file(folder, name)
    {
        let mesh = scratch.path(&format!("{}.ply", subject.name));
        write_subdivided(io::read(coarse)?, subject.triangles, &mesh)?;
        return Ok(Found {
            mesh,
            stand_in: None,
            made: Some(format!("{name} subdivided")),
        });
    }
    let drawn = subject.triangles.min(DRAWN);
    let spec = format!("shape:{}:{drawn}", subject.stand_in);
    if drawn == subject.triangles {
        return Ok(Found {
            mesh: spec.clone().into(),
            stand_in: Some(spec),
            made: None,
        });
    }
    let mesh = scratch.path(&format!("{}.ply", subject.name));
    let coarse = shape::by_name(subject.stand_in, drawn)?;
    write_subdivided(coarse, subject.triangles, &mesh)?;
    Ok(Found {
        mesh,
        stand_in: Some(format!("{spec} subdivided")),
        made: None,
    })
}

fn file(folder: Option<&Path>, name: &str) -> Option<PathBuf> {
    let candidates = ["obj", "off", "ply"].map(|e| format!("{name}.{e}"));
    let mut paths = candidates.iter().map(|name| folder.map(|f| f.join(name)));
    paths.find_map(|path| path.filter(|path| path.is_file()))
}

/// Subdivides until about `triangles` are reached.
fn write_subdivided(mut mesh: TriangleMesh, triangles: usize, path: &Path) -> Result<()> {
    while 2 * mesh.face_count() < triangles {
        mesh = subdivide(&mesh)?;
    }
    Ok(io::write(path, &mesh)?)
}
