//! The readable summary of a map: one line for each phase, with its result and its seconds.

use std::fmt;

use super::{Arguments, Solved};
use crate::summary::{counted, counted_vertices, energy, left_out, line, thousands, verdict};

/// Lines for the mesh, the field, the problem and the map.
pub(super) struct MapSummary<'a> {
    pub(super) arguments: &'a Arguments,
    pub(super) solved: &'a Solved,
}

impl fmt::Display for MapSummary<'_> {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        let Solved {
            options,
            given_faces,
            mesh: _,
            repair: _,
            changes: _,
            curves,
            refined,
            field,
            sizing: _,
            features,
            too_short,
            untangled,
            untangle_seconds,
            rounds,
            refinements,
            gradings,
            solution,
            before,
        } = self.solved;
        let map = &untangled.map;
        let (counts, seconds) = (solution.counts(), solution.seconds());
        let read = counted(*given_faces, "face");
        line(f, "read", &read, before.read)?;
        if let Some(curves) = curves {
            writeln!(f, "{:<10} {curves}", "curves")?;
        }
        left_out(f, *too_short)?;
        if let Some(refined) = refined {
            writeln!(
                f,
                "{:<10} {refined}: the map is on the refined mesh",
                "refine"
            )?;
        }
        let irregular = counted_vertices(map.cones().len(), "irregular ");
        line(f, "field", &irregular, field.seconds)?;
        let mut assemble = format!(
            "{}, {}",
            counted(counts.variables, "unknown"),
            counted(map.transitions().len(), "cut edge")
        );
        if !features.is_empty() {
            assemble += &format!(", {}", counted(features.len(), "feature edge"));
        }
        line(f, "assemble", &assemble, before.assemble.unwrap_or(0.0))?;
        let reduced = format!(
            "{}, {} continuous left",
            counted(counts.reduced_integers, "integer"),
            thousands(counts.reduced_continuous)
        );
        line(f, "eliminate", &reduced, seconds.eliminate)?;
        let found = format!("{}, {}", energy(solution.energy()), verdict(solution));
        let search = seconds.factor + seconds.round;
        line(f, options.strategy.name(), &found, search)?;
        let mut told = format!(
            "{} flipped, {} stiffened, {}, {}, {}",
            counted(untangled.flipped_before, "face"),
            thousands(untangled.flipped_stiffened),
            counted(*rounds, "round"),
            counted(*refinements, "refinement"),
            counted(untangled.steps, "step")
        );
        if *gradings > 0 {
            told += &format!(", {} around faults", counted(*gradings, "grading"));
        }
        line(f, "untangle", &told, *untangle_seconds)?;
        let mut flipped = format!("{} flipped", counted(map.flipped().len(), "face"));
        if !untangled.winding_defects.is_empty() {
            flipped += &format!(
                ", {} covered twice",
                counted_vertices(untangled.winding_defects.len(), "")
            );
        }
        match &self.arguments.out {
            Some(path) => writeln!(f, "{:<10} {flipped}: {}", "map", path.display()),
            None => writeln!(f, "{:<10} {flipped}", "map"),
        }
    }
}
