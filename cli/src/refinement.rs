//! What a refinement did, in one line for people and as JSON.

use std::fmt;

use roundel::mesh::refine::Refined;
use serde::Serialize;

use crate::summary::{counted, thousands};

/// Counts of a refinement.
#[derive(Debug, Clone, Copy, Serialize)]
pub struct Refinement {
    /// Those of the refined mesh.
    faces: usize,
    vertices: usize,
    splits: usize,
    flips: usize,
    /// Faces that still have an angle below 2 degrees.
    small_angles: usize,
    /// False if the bound on the number of faces ended it.
    complete: bool,
}

impl Refinement {
    /// The counts of this refinement.
    pub fn new(refined: &Refined) -> Self {
        Refinement {
            faces: refined.mesh.face_count(),
            vertices: refined.mesh.vertex_count(),
            splits: refined.splits,
            flips: refined.flips,
            small_angles: refined.small_angles,
            complete: refined.is_complete,
        }
    }
}

impl fmt::Display for Refinement {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        write!(f, "to {}", counted(self.faces, "face"))?;
        if self.small_angles > 0 {
            write!(f, ", {} still thin", thousands(self.small_angles))?;
        }
        match self.complete {
            true => Ok(()),
            false => write!(f, ", ended by the bound on their number"),
        }
    }
}
