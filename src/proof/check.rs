//! The checker: reads a proof line by line, and believes none of it.

use std::io::BufRead;

use super::convex;
use super::cut;
use super::exact::Exact;
use super::fault::{Checked, Fault, FaultKind, Wrong, wrong};
use super::format::{Claim, Line, Part, Root, Statement, VERSION};
use super::lattice;
use super::minorant::{Minorant, PartObjective, Split};
use super::problem::{ExactProblem, ExactRow, Limits, Side, product};
use super::steps::take;
use super::switch;
use super::translation;
use super::tree::Tree;

/// The point of a proof may miss rows and bounds by this, relative to the sizes of the terms.
pub const TOLERANCE: f64 = 1e-9;

/// What a proof that was accepted proves.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub struct Verdict {
    /// The point, one value for each unknown, if there is one.
    pub values: Option<Vec<f64>>,
    /// The energy of the point, rounded to the next float above.
    pub energy: Option<f64>,
    /// No point within all rows, bounds and integers has less energy. Nothing if there is no such point.
    pub lower_bound: Option<f64>,
    /// The largest violation of a row or bound by the point, relative to the sizes of its terms. It is at most
    /// [`TOLERANCE`].
    pub violation: f64,
    /// The independent parts of the problem.
    pub parts: usize,
    /// The nodes of all trees.
    pub nodes: usize,
}

/// The lines of a file, with their numbers.
struct Lines<R> {
    reader: R,
    number: usize,
    text: String,
}

impl<R: BufRead> Lines<R> {
    fn next(&mut self, wanted: &str) -> Result<Line, Fault> {
        self.number += 1;
        self.text.clear();
        let read = self.reader.read_line(&mut self.text);
        let fault = |message: String| self.fault((FaultKind::Format, message));
        match read {
            Err(reason) => Err(fault(reason.to_string())),
            Ok(0) => Err(fault(format!("the file ends where {wanted} is wanted"))),
            Ok(_) => serde_json::from_str(&self.text)
                .map_err(|reason| fault(format!("{wanted} is wanted: {reason}"))),
        }
    }

    fn fault(&self, (kind, message): Wrong) -> Fault {
        Fault {
            line: self.number,
            kind,
            message,
        }
    }

    fn unexpected(&self, wanted: &str) -> Fault {
        self.fault((FaultKind::Format, format!("{wanted} is wanted")))
    }

    /// The result of a step of the checker, at this line.
    fn at<T>(&self, checked: Checked<T>) -> Result<T, Fault> {
        checked.map_err(|wrong| self.fault(wrong))
    }
}

/// Checks the proof in a text, which must be of this problem, if there is one.
///
/// # Errors
/// The first fault.
pub(super) fn check_lines(
    reader: impl BufRead,
    statement: Option<&Statement>,
) -> Result<Verdict, Fault> {
    let mut lines = Lines {
        reader,
        number: 0,
        text: String::new(),
    };
    let first = format!("{{\"roundel_proof\":{VERSION}}}");
    match lines.next(&first)? {
        Line::RoundelProof(VERSION) => {}
        _ => return Err(lines.unexpected(&first)),
    }
    let Line::Statement(stated) = lines.next("the statement")? else {
        return Err(lines.unexpected("the statement"));
    };
    if statement.is_some_and(|statement| *statement != stated) {
        let text = "the proof is that of another problem".to_owned();
        return Err(lines.fault((FaultKind::OtherProblem, text)));
    }
    let (mut problem, mut limits) = lines.at(ExactProblem::of(&stated))?;
    let Line::Claim(claim) = lines.next("the claim")? else {
        return Err(lines.unexpected("the claim"));
    };
    let violation = lines.at(check_point(&problem, &limits, &claim))?;
    let Line::Root(root) = lines.next("the root")? else {
        return Err(lines.unexpected("the root"));
    };
    let mut verdict = Verdict {
        values: claim.values,
        energy: claim.energy,
        lower_bound: claim.lower_bound,
        violation,
        parts: 0,
        nodes: 0,
    };
    let proved = if lines.at(check_root(&mut problem, &mut limits, &root))? {
        check_parts(&mut lines, &mut problem, &mut limits, &mut verdict)?
    } else {
        None
    };
    match lines.next("the end")? {
        Line::End(before) if before == lines.number - 1 => {}
        Line::End(before) => {
            let text = format!("{before} lines are said to come before this one");
            return Err(lines.fault((FaultKind::Format, text)));
        }
        _ => return Err(lines.unexpected("the end")),
    }
    lines.at(check_claim(verdict.lower_bound, proved))?;
    Ok(verdict)
}

/// Holds the claim against what was proved. Without a point, all bounds are true.
fn check_claim(claimed: Option<f64>, proved: Option<Exact>) -> Checked<()> {
    match (claimed, proved) {
        (_, None) => Ok(()),
        (None, Some(_)) => wrong(
            FaultKind::Claim,
            "the parts do not prove that there is no point",
        ),
        (Some(bound), Some(proved)) if Exact::of(bound).is_some_and(|b| b <= proved) => Ok(()),
        (Some(bound), Some(proved)) => {
            let text = format!(
                "a bound of {bound} is claimed, and {} proved",
                proved.below()
            );
            wrong(FaultKind::Claim, text)
        }
    }
}

/// Checks that the point is within rows, bounds and integers, and its energy. Returns its largest violation.
pub(super) fn check_point(problem: &ExactProblem, limits: &Limits, claim: &Claim) -> Checked<f64> {
    let (values, energy) = match (&claim.values, claim.energy) {
        (Some(values), Some(energy)) => (values, energy),
        (None, None) if claim.lower_bound.is_none() => return Ok(0.0),
        _ => return wrong(FaultKind::Point, "a bound needs a point and its energy"),
    };
    let n = problem.integer.len();
    if values.len() != n {
        let text = format!("{} values for {n} unknowns", values.len());
        return wrong(FaultKind::Point, text);
    }
    let x: Option<Vec<Exact>> = values.iter().map(|&x| Exact::of(x)).collect();
    let Some(x) = x else {
        return wrong(FaultKind::Point, "a value that is no finite number");
    };
    let whole = problem.integer.iter().zip(&x);
    if let Some(j) = whole.clone().position(|(is, x)| *is && !x.is_integer()) {
        return wrong(
            FaultKind::Point,
            format!("x{j} is {}, no integer", values[j]),
        );
    }
    let mut worst = 0.0_f64;
    let mut hold = |what: String, value: &Exact, sides: [&Option<Exact>; 2], size: f64| {
        let missed = missed(value, sides) / size.max(1.0);
        worst = worst.max(missed);
        if missed <= TOLERANCE {
            return Ok(());
        }
        wrong(FaultKind::Point, format!("{what} is missed by {missed}"))
    };
    for (j, value) in x.iter().enumerate() {
        let sides = [Side::Lower, Side::Upper].map(|side| limits.side(j, side));
        hold(
            format!("the bounds of x{j}"),
            value,
            sides,
            value.abs().above(),
        )?;
    }
    for (i, row) in problem.rows.iter().enumerate() {
        let sizes = row.terms.iter().map(|(j, a)| (a * &x[*j]).abs());
        let size = sizes.fold(Exact::zero(), |sum, size| &sum + &size);
        let value = product(&row.terms, &x);
        hold(
            format!("row {i}"),
            &value,
            [&row.lower, &row.upper],
            size.above(),
        )?;
    }
    let there = problem.energy(&x).above();
    if there != energy {
        let text = format!("an energy of {energy} is claimed, and that of the point is {there}");
        return wrong(FaultKind::Energy, text);
    }
    Ok(worst)
}

/// How far a value is outside of two sides, rounded upwards.
fn missed(value: &Exact, [lower, upper]: [&Option<Exact>; 2]) -> f64 {
    let below = lower.as_ref().map_or(0.0, |side| (side - value).above());
    let above = upper.as_ref().map_or(0.0, |side| (value - side).above());
    below.max(above).max(0.0)
}

/// Takes the steps before any branch. Returns whether points may be left.
fn check_root(problem: &mut ExactProblem, limits: &mut Limits, root: &Root) -> Checked<bool> {
    for &step in &root.steps {
        take(problem, limits, step)?;
    }
    for translation in &root.translations {
        translation::hold(problem, limits, translation)?;
    }
    for sum in &root.defined {
        problem.define(limits, sum)?;
    }
    let is_empty = limits.are_empty() || has_empty_row(problem);
    let Some(multipliers) = &root.empty else {
        if is_empty {
            let text = "no point is left, and the root is not called empty";
            return wrong(FaultKind::Format, text);
        }
        return Ok(true);
    };
    if is_empty {
        return Ok(false);
    }
    let rows = Minorant::of_rows_alone(problem, limits, multipliers)?;
    if rows.is_some_and(|least| least.sign().is_gt()) {
        return Ok(false);
    }
    let text = "the rows are not shown to contradict each other";
    wrong(FaultKind::NotEmpty, text)
}

/// Whether a row's lower side is above its upper side.
pub(super) fn has_empty_row(problem: &ExactProblem) -> bool {
    let is_empty = |row: &ExactRow| match (&row.lower, &row.upper) {
        (Some(lower), Some(upper)) => lower > upper,
        _ => false,
    };
    problem.rows.iter().any(is_empty)
}

/// Checks what a part says of its objective. Returns its bound if a lattice shows it.
fn shown_at_once(
    problem: &ExactProblem,
    limits: &Limits,
    objective: &mut PartObjective,
    part: &Part,
) -> Checked<Option<Exact>> {
    let Some(of) = &part.lattice else {
        objective.set_curvature(&part.curvature)?;
        convex::check(objective, &|| true)?;
        return Ok(None);
    };
    let shown = lattice::bound(problem, limits, objective, (of, &part.curvature))?;
    match part.lower_bound.and_then(Exact::of) {
        Some(bound) if bound <= shown => Ok(Some(bound)),
        _ => {
            let text = format!("the lattice of the part proves {} alone", shown.below());
            wrong(FaultKind::Bound, text)
        }
    }
}

/// Checks the parts and their trees. Returns the bound that they prove together, or nothing if there is no
/// point.
fn check_parts<R: BufRead>(
    lines: &mut Lines<R>,
    problem: &mut ExactProblem,
    limits: &mut Limits,
    verdict: &mut Verdict,
) -> Result<Option<Exact>, Fault> {
    let Line::Parts(parts) = lines.next("the parts")? else {
        return Err(lines.unexpected("the parts"));
    };
    let members: Vec<Vec<u32>> = parts.iter().map(|part| part.unknowns.clone()).collect();
    let mut split = lines.at(Split::of(problem, limits, &members))?;
    // A part without a point needs no others beside it.
    let is_bounded = parts.iter().all(|part| part.lower_bound.is_some());
    if let (true, Some(j)) = (is_bounded, split.left_out) {
        let text = format!("x{j} is not fixed, and in no part");
        return Err(lines.fault((FaultKind::Parts, text)));
    }
    let given = problem.rows.len();
    let mut cuts = Vec::with_capacity(parts.len());
    let mut of_lattice = Vec::with_capacity(parts.len());
    for (part, objective) in parts.iter().zip(&mut split.parts) {
        for added in &part.cuts {
            lines.at(cut::add(problem, limits, added))?;
        }
        cuts.push(problem.rows.split_off(given));
        for added in &part.switches {
            lines.at(switch::add(problem, limits, objective, added))?;
        }
        let shown = lines.at(shown_at_once(problem, limits, objective, part))?;
        of_lattice.push(shown);
    }
    let mut proved = Some(split.constant);
    let of_parts = parts.iter().zip(&split.parts).zip(cuts).zip(of_lattice);
    for (((part, objective), cuts), shown) in of_parts {
        problem.rows.truncate(given);
        problem.rows.extend(cuts);
        let bound = part.lower_bound.and_then(Exact::of);
        verdict.parts += 1;
        if let Some(shown) = shown {
            verdict.nodes += part.enumerated();
            proved = proved.map(|sum| &sum + &shown);
            continue;
        }
        let mut tree = Tree::new(objective, bound.clone(), limits);
        while tree.wanted() > 0 {
            let Line::Node(node) = lines.next("a node")? else {
                return Err(lines.unexpected("a node"));
            };
            lines.at(tree.visit(problem, limits, &node))?;
            verdict.nodes += 1;
        }
        proved = proved.zip(bound).map(|(sum, bound)| &sum + &bound);
    }
    Ok(proved)
}
