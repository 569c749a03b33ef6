//! The readable summary of a solution: one line for each phase, with its result and its seconds.

use std::fmt;

use roundel::{Proof, Solution, StoppedBy};

/// Three lines: the problem that was read, the problem after elimination, the solution.
pub struct Summary<'a> {
    /// The strategy's name.
    pub strategy: &'a str,
    /// Seconds that reading took.
    pub read: f64,
    /// Whether the file maximises, so that its objective is minus the energy.
    pub maximise: bool,
    /// What was found.
    pub solution: &'a Solution,
    /// Its proof, if one is wanted, or what stopped it.
    pub proof: Option<&'a Result<Proof, StoppedBy>>,
}

impl fmt::Display for Summary<'_> {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        let counts = self.solution.counts();
        let seconds = self.solution.seconds();
        let read = format!(
            "{}, {} of them integer, {}{}",
            counted(counts.variables, "unknown"),
            thousands(counts.integers),
            counted(counts.constraints, "constraint"),
            counted_inequalities(counts.inequalities)
        );
        let reduced = format!(
            "{}, {} continuous left",
            counted(counts.reduced_integers, "integer"),
            thousands(counts.reduced_continuous)
        );
        let value = self.solution.energy();
        let found = format!(
            "{}, {}",
            energy(if self.maximise { -value } else { value }),
            verdict(self.solution)
        );
        line(f, "read", &read, self.read)?;
        line(f, "eliminate", &reduced, seconds.eliminate)?;
        line(f, self.strategy, &found, seconds.factor + seconds.round)?;
        let proof = match self.proof {
            Some(Ok(proof)) => proof,
            Some(Err(stopped)) => {
                return writeln!(f, "{:<10} none, stopped by {}", "proof", stopped.name());
            }
            None => return Ok(()),
        };
        let Some(bound) = proof.lower_bound() else {
            return Ok(());
        };
        let bound = if self.maximise { -bound } else { bound };
        let nodes = counted(proof.nodes(), "node");
        writeln!(f, "{:<10} bound {bound:.9}, {nodes}", "proof")
    }
}

/// A line for the sharp edges that are no features as they are too short for quads, if there are any.
pub fn left_out(f: &mut fmt::Formatter, too_short: usize) -> fmt::Result {
    if too_short == 0 {
        return Ok(());
    }
    let short = counted(too_short, "sharp edge");
    writeln!(
        f,
        "{:<10} {short} left out: too short for quads",
        "features"
    )
}

/// The status of a solve, the gap between energy and bound, and what stopped the search.
pub fn verdict(solution: &Solution) -> String {
    let status = solution.status();
    let bound = match telling_gap(solution.gap()) {
        Some(gap) => format!(", gap {:.2} %", 100.0 * gap),
        None => String::new(),
    };
    format!("{}{bound}{}", status.name(), stopped(solution.stopped_by()))
}

/// The status of a solve, and what stopped the search.
pub fn outcome(solution: &Solution) -> String {
    format!(
        "{}{}",
        solution.status().name(),
        stopped(solution.stopped_by())
    )
}

/// What stopped a search, unless the status says it already.
fn stopped(by: StoppedBy) -> &'static str {
    match by {
        StoppedBy::Nodes => ", stopped by the limit of nodes",
        StoppedBy::Time => ", stopped by the time limit",
        StoppedBy::Memory => ", stopped by a lack of memory",
        StoppedBy::Budget => ", stopped by its budget",
        _ => "",
    }
}

/// The lower bound of a solution, if it says something.
pub fn telling_bound(solution: &Solution) -> Option<f64> {
    let bound = solution.lower_bound().filter(|bound| bound.is_finite());
    bound.filter(|_| telling_gap(solution.gap()).is_some())
}

/// The gap, if its bound says something. An energy that is a sum of squares has a gap of 100 % before
/// anything is proved.
pub fn telling_gap(gap: Option<f64>) -> Option<f64> {
    gap.filter(|&gap| gap < 1.0)
}

/// Nine decimals; rounding noise below them has no sign.
pub fn energy(value: f64) -> String {
    let shown = if value.abs() < 5e-10 { 0.0 } else { value };
    format!("energy {shown:.9}")
}

/// One line: phase, what came out, seconds.
pub fn line(f: &mut fmt::Formatter, phase: &str, text: &str, seconds: f64) -> fmt::Result {
    writeln!(f, "{phase:<10} {text:<56} {seconds:8.3} s")
}

/// A count and its noun, in the plural unless it is one.
pub fn counted(count: usize, noun: &str) -> String {
    let plural = if count == 1 { "" } else { "s" };
    format!("{} {noun}{plural}", thousands(count))
}

/// A count of vertices of some kind: `"irregular "`, or `""`.
pub fn counted_vertices(count: usize, kind: &str) -> String {
    let noun = if count == 1 { "vertex" } else { "vertices" };
    format!("{} {kind}{noun}", thousands(count))
}

/// The count of inequalities after another count; nothing where there is none.
fn counted_inequalities(count: usize) -> String {
    match count {
        0 => String::new(),
        1 => ", 1 inequality".into(),
        _ => format!(", {} inequalities", thousands(count)),
    }
}

/// A count with commas: 20,088.
pub fn thousands(count: usize) -> String {
    let digits = count.to_string();
    let mut text = String::with_capacity(digits.len() + digits.len() / 3);
    for (i, digit) in digits.chars().enumerate() {
        if i > 0 && (digits.len() - i).is_multiple_of(3) {
            text.push(',');
        }
        text.push(digit);
    }
    text
}

#[cfg(test)]
mod tests {
    use super::{counted_inequalities, energy, telling_gap, thousands};

    #[test]
    fn inequalities_are_told_where_there_are_some() {
        let written = [0, 1, 2000].map(counted_inequalities);
        assert_eq!(written, ["", ", 1 inequality", ", 2,000 inequalities"]);
    }

    #[test]
    fn rounding_noise_of_an_energy_has_no_sign() {
        let written = [-1e-14, -6e-10, -25.5].map(energy);
        let expected = ["0.000000000", "-0.000000001", "-25.500000000"];
        assert_eq!(written, expected.map(|e| format!("energy {e}")));
    }

    #[test]
    fn a_bound_of_zero_below_a_sum_of_squares_says_nothing() {
        assert_eq!(telling_gap(Some(1.0)), None);
        assert_eq!(telling_gap(Some(f64::INFINITY)), None);
        assert_eq!(telling_gap(Some(0.99)), Some(0.99));
    }

    #[test]
    fn counts_have_a_comma_every_three_digits_from_the_right() {
        let written = [0, 999, 1_000, 20_088, 1_234_567].map(thousands);
        assert_eq!(written, ["0", "999", "1,000", "20,088", "1,234,567"]);
    }
}
