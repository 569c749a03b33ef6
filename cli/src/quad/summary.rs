//! The readable summary of quads: one line a phase.

use std::fmt;

use super::steps::Solved;
use super::{Arguments, words};
use crate::summary::{counted, counted_vertices, line, verdict};

/// Lines for the field, the map and the quads.
pub(super) struct QuadSummary<'a> {
    pub(super) arguments: &'a Arguments,
    pub(super) solved: &'a Solved,
}

impl fmt::Display for QuadSummary<'_> {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        let solved = self.solved;
        let seconds = solved.seconds;
        let read = counted(solved.mesh.face_count(), "face");
        line(f, "read", &read, seconds.read)?;
        let irregular = counted_vertices(solved.untangled.map.cones().len(), "irregular ");
        line(f, "field", &irregular, seconds.field)?;
        let map = format!(
            "{}, {}, {} flipped",
            counted(solved.solution.counts().reduced_integers, "integer"),
            verdict(&solved.solution),
            solved.untangled.flipped_after
        );
        line(f, "map", &map, seconds.map)?;
        line(
            f,
            "quads",
            &words(&solved.quads),
            seconds.quads + seconds.smooth,
        )?;
        match &self.arguments.out {
            Some(path) => writeln!(f, "{:<10} {}", "written", path.display()),
            None => Ok(()),
        }
    }
}
