//! The readable summary of a check: for each rule how many elements break it, and the worst of them.

use std::fmt;

use roundel::check::Defect;

use super::checked::Checked;
use crate::summary::{counted, counted_vertices, line, thousands};

/// Lines for the mesh, for each rule, and the verdict.
pub(super) struct CheckSummary<'a>(pub(super) &'a Checked);

impl fmt::Display for CheckSummary<'_> {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        let Checked {
            mesh,
            check,
            read,
            seconds,
        } = self.0;
        line(f, "read", &counted(mesh.face_count(), "face"), *read)?;
        let singular = counted_vertices(check.singularities.len(), "singular ");
        line(f, "check", &singular, *seconds)?;
        rule(f, "edges without a quarter turn", "edge", &check.rotations)?;
        rule(
            f,
            "edges without an integer translation",
            "edge",
            &check.translations,
        )?;
        rule(
            f,
            "singular vertices off the grid",
            "vertex",
            &check.off_grid,
        )?;
        rule(f, "flipped faces", "face", &check.flipped)?;
        if let Some(first) = check.degenerate.first() {
            let count = thousands(check.degenerate.len());
            writeln!(
                f,
                "{:<10} degenerate faces: {count}, the first is face {first}",
                ""
            )?;
        }
        rule(
            f,
            "boundary edges off the isolines",
            "edge",
            &check.boundary,
        )?;
        rule(f, "feature edges off the isolines", "edge", &check.features)?;
        let verdict = match (check.is_valid(), check.is_integer(), check.is_seamless()) {
            (true, ..) => "valid",
            (_, true, _) => "not valid",
            (_, _, true) => "not valid: seamless, but not integer",
            _ => "not valid: not seamless",
        };
        writeln!(f, "{:<10} {verdict}", "map")
    }
}

/// A line for a rule, if elements break it: their number, and the worst.
fn rule(f: &mut fmt::Formatter, what: &str, noun: &str, defects: &[Defect]) -> fmt::Result {
    let by_amount = |a: &&Defect, b: &&Defect| a.amount.abs().total_cmp(&b.amount.abs());
    let Some(worst) = defects.iter().max_by(by_amount) else {
        return Ok(());
    };
    let (count, element) = (thousands(defects.len()), worst.element);
    let amount = worst.amount;
    writeln!(
        f,
        "{:<10} {what}: {count}, the worst is {noun} {element} ({amount:.3e})",
        ""
    )
}
