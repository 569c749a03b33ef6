//! The readable summary of quads: one line for each phase.

use std::fmt;

use super::mirrored::mirror_words;
use super::report::Distance;
use super::steps::Solved;
use super::{Arguments, words};
use crate::refinement::Refinement;
use crate::summary::{counted, counted_vertices, energy, left_out, line, verdict};

/// Lines for the field, the map and the quads.
pub(super) struct QuadSummary<'a> {
    pub(super) arguments: &'a Arguments,
    pub(super) solved: &'a Solved,
}

impl fmt::Display for QuadSummary<'_> {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        let solved = self.solved;
        let (made, seconds) = (&solved.made, solved.made.seconds);
        let read = counted(solved.mesh.face_count(), "face");
        line(f, "read", &read, solved.read_seconds)?;
        if let Some(curves) = &solved.curves {
            writeln!(f, "{:<10} {curves}", "curves")?;
        }
        left_out(f, solved.too_short)?;
        if let Some(mirrored) = &made.mirrored {
            writeln!(f, "{:<10} {}", "mirror", mirror_words(mirrored))?;
        }
        if let Some(refined) = &made.refined {
            let seconds = seconds.refine;
            line(f, "refine", &Refinement::new(refined).to_string(), seconds)?;
        }
        let mut irregular = counted_vertices(made.untangled.map.cones().len(), "irregular ");
        if made.near_features > 0 {
            irregular += &format!(", {} near features", made.near_features);
        }
        line(f, "field", &irregular, seconds.field)?;
        let map = format!(
            "{}, {}, {} flipped",
            counted(made.solution.counts().reduced_integers, "integer"),
            verdict(&made.solution),
            made.untangled.flipped_after
        );
        line(f, "map", &map, seconds.map)?;
        line(
            f,
            "quads",
            &words(&made.quads),
            seconds.extract + seconds.smooth,
        )?;
        if !made.paired.is_empty() {
            let pairs = format!(
                "of {}: no map fits there",
                counted(made.paired.len(), "triangle")
            );
            writeln!(f, "{:<10} {pairs}", "pairs")?;
        }
        if let Some(kept) = solved.kept.words() {
            line(f, "kept", &kept, solved.kept.seconds)?;
        }
        if let Some(distance) = Distance::new(solved) {
            writeln!(f, "{:<10} {distance}", "distance")?;
        }
        for one in &made.compared {
            for (problem, solution) in [("field", &one.field), ("map", &one.map)] {
                let found = format!(
                    "{problem}: {}, {}",
                    energy(solution.energy()),
                    verdict(solution)
                );
                line(f, one.strategy.name(), &found, solution.seconds().total)?;
            }
        }
        match &self.arguments.out {
            Some(path) => writeln!(f, "{:<10} {}", "written", path.display()),
            None => Ok(()),
        }
    }
}
