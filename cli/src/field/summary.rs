//! The readable summary of a field: one line for each phase, with its result and its seconds.

use std::fmt;

use super::Arguments;
use super::solved::Solved;
use crate::summary::{counted, counted_vertices, energy, line, verdict};

/// Lines for the mesh, the problem, the solution and the field.
pub(super) struct FieldSummary<'a> {
    pub(super) arguments: &'a Arguments,
    pub(super) solved: &'a Solved,
}

impl fmt::Display for FieldSummary<'_> {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        let Solved {
            mesh,
            repair: _,
            changes: _,
            curves,
            features,
            field,
            solution,
            before,
            written,
            strategy,
        } = self.solved;
        let (counts, seconds) = (solution.counts(), solution.seconds());
        let given = field.constrained().iter().filter(|&&given| given).count();
        let read = format!(
            "{}, {}, Euler characteristic {}",
            counted(mesh.face_count(), "face"),
            counted_vertices(mesh.vertex_count(), ""),
            mesh.euler_characteristic()
        );
        let mut assemble = format!(
            "{}, {} given",
            counted(counts.integers, "integer"),
            counted(given, "direction")
        );
        if !features.is_empty() {
            assemble += &format!(", {}", counted(features.len(), "feature edge"));
        }
        let found = format!("{}, {}", energy(solution.energy()), verdict(solution));
        line(f, "read", &read, before.read)?;
        if let Some(curves) = curves {
            writeln!(f, "{:<10} {curves}", "curves")?;
        }
        line(f, "assemble", &assemble, before.assemble.unwrap_or(0.0))?;
        line(f, strategy.name(), &found, seconds.total)?;
        let irregular = counted_vertices(field.irregular_vertices(mesh).len(), "irregular ");
        let files: Vec<String> = [&self.arguments.out, &self.arguments.picture.file]
            .into_iter()
            .flatten()
            .map(|path| path.display().to_string())
            .collect();
        if files.is_empty() {
            return writeln!(f, "{:<10} {irregular}", "field");
        }
        let field = format!("{irregular}: {}", files.join(", "));
        line(f, "field", &field, *written)
    }
}
