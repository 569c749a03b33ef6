//! The writer: a proof from what a search has done.
//!
//! Each step, contradiction and bound is tried in exact numbers. What does not hold is left out; a leaf that is
//! not empty in exact numbers keeps the bound of the node above.

use super::check::{check_point, has_empty_row};
use super::condensed;
use super::curvature;
use super::derivation::{Derivation, Ending, Multiplied, Searched};
use super::estimate::Floats;
use super::exact::Exact;
use super::fault::Wrong;
use super::format::{
    Certificate, Claim, Cut, End, Line, Multipliers, Node, Number, Part, Root, Statement, Step,
    VERSION,
};
use super::held::Held;
use super::minorant::{Minorant, Open, PartObjective, Split};
use super::numbers::Numbers;
use super::problem::{ExactProblem, Limits, Side};
use super::repair::Place;
use super::steps::take;
use super::switch;
use super::translation;
use crate::error::{Error, Result};

/// Whether to go on, asked at every node and in every long loop. Its error ends the writer.
pub(super) type Ask<'a> = &'a dyn Fn() -> Result<()>;

/// The lines of a proof of this statement. `values` are the best point, if there is one.
///
/// # Errors
/// [`Error::NotSupported`] for what cannot be proved; that of `ask`.
pub(super) fn seal(
    statement: Statement,
    derivation: &Derivation,
    values: Option<&[f64]>,
    ask: Ask,
) -> Result<Vec<Line>> {
    ask()?;
    let (mut problem, mut limits) = ExactProblem::of(&statement).map_err(unproved)?;
    ask()?;
    let energy = values.and_then(|values| {
        let x: Option<Vec<Exact>> = values.iter().map(|&x| Exact::of(x)).collect();
        Some(problem.energy(&x?).above())
    });
    let mut claim = Claim {
        values: values.map(<[f64]>::to_vec),
        energy,
        lower_bound: None,
    };
    ask()?;
    check_point(&problem, &limits, &claim).map_err(unproved)?;
    ask()?;
    let steps = taken(&mut problem, &mut limits, &derivation.steps, ask)?;
    let mut translations = derivation.translations.clone();
    translations.retain(|own| translation::hold(&mut problem, &mut limits, own).is_ok());
    let root = Root {
        steps,
        translations,
        defined: derivation.defined.clone(),
        empty: None,
    };
    for sum in &root.defined {
        problem.define(&mut limits, sum).map_err(unproved)?;
    }
    let mut lines = vec![Line::RoundelProof(VERSION), Line::Statement(statement)];
    if let Some(empty) = contradiction(&problem, &limits, derivation) {
        let empty = Some(empty);
        lines.extend([Line::Claim(claim), Line::Root(Root { empty, ..root })]);
        lines.push(Line::End(lines.len()));
        return Ok(lines);
    }
    let searched = all_free(&problem, &limits, &derivation.parts, values);
    let sealed = seal_parts(&mut problem, &mut limits, searched, ask)?;
    // A point that misses rows by rounding errors may have less energy than all points.
    let most = claim.energy.unwrap_or(f64::INFINITY);
    claim.lower_bound = sealed.bound.map(|bound| bound.below().min(most));
    if claim.lower_bound.is_some_and(f64::is_infinite) {
        return Err(overflow());
    }
    if claim.lower_bound.is_some() && claim.values.is_none() {
        return Err(not_proved("rounding errors hide that there is no point"));
    }
    let Sealed { parts, nodes, .. } = sealed;
    lines.extend([Line::Claim(claim), Line::Root(root), Line::Parts(parts)]);
    lines.extend(nodes.into_iter().map(Line::Node));
    lines.push(Line::End(lines.len()));
    Ok(lines)
}

/// The parts as they are written, and the bound that they prove together.
struct Sealed {
    parts: Vec<Part>,
    nodes: Vec<Node>,
    bound: Option<Exact>,
}

/// Proves the bounds of all parts, or that one of them has no point, which is then the only one.
fn seal_parts(
    problem: &mut ExactProblem,
    limits: &mut Limits,
    searched: Vec<Searched>,
    ask: Ask,
) -> Result<Sealed> {
    let members: Vec<Vec<u32>> = searched.iter().map(|part| part.unknowns.clone()).collect();
    let mut split = Split::of(problem, limits, &members).map_err(unproved)?;
    ask()?;
    let mut all = Sealed {
        parts: Vec::new(),
        nodes: Vec::new(),
        bound: Some(split.constant),
    };
    let mut failed = None;
    let given = problem.rows.len();
    for (mut searched, objective) in searched.into_iter().zip(&mut split.parts) {
        let (numbers, cuts) = Numbers::with_cuts(problem, limits, &searched.cuts, ask)?;
        searched.renumber(|row| numbers.of_row(row));
        let sealed = seal_part(problem, limits, &searched, (objective, cuts), ask);
        problem.rows.truncate(given);
        let (part, mut nodes) = match sealed {
            Ok(sealed) => sealed,
            Err(error) => {
                failed = failed.or(Some(error));
                continue;
            }
        };
        let Some(bound) = part.lower_bound else {
            return Ok(Sealed {
                parts: vec![part],
                nodes,
                bound: None,
            });
        };
        let bound = Exact::of(bound).ok_or_else(overflow)?;
        all.bound = all.bound.map(|sum| &sum + &bound);
        all.parts.push(part);
        all.nodes.append(&mut nodes);
    }
    failed.map_or(Ok(all), Err)
}

fn seal_part(
    problem: &mut ExactProblem,
    limits: &mut Limits,
    searched: &Searched,
    (objective, cuts): (&mut PartObjective, Vec<Cut>),
    ask: Ask,
) -> Result<(Part, Vec<Node>)> {
    let mut switches = searched.switches.clone();
    switches.retain(|added| switch::add(problem, limits, objective, added).is_ok());
    let goes_on = || ask().is_ok();
    if let Some(given) = &searched.condensed {
        let found = condensed::strongest(problem, limits, objective, given, &goes_on);
        ask()?;
        let (lattice, curvature, bound) = found.map_err(unproved)?;
        let part = Part {
            unknowns: searched.unknowns.clone(),
            cuts,
            switches,
            curvature,
            lattice: Some(lattice),
            lower_bound: Some(bound.below()),
        };
        return Ok((part, Vec::new()));
    }
    let curvature = curvature::choose(objective, limits, &goes_on);
    ask()?;
    objective.set_curvature(&curvature).map_err(unproved)?;
    let checked = super::convex::check(objective, &goes_on);
    ask()?;
    checked.map_err(unproved)?;
    let mut sealer = Sealer {
        problem,
        limits,
        objective,
        floats: Floats::of(objective),
        searched,
        nodes: Vec::new(),
        above: Vec::new(),
        least: None,
        ask,
    };
    let root = sealer.limits.mark();
    let sealed = sealer.seal();
    sealer.limits.go_back(root);
    sealed?;
    let part = Part {
        unknowns: searched.unknowns.clone(),
        cuts,
        switches,
        curvature,
        lattice: None,
        lower_bound: sealer.least.map(|least| least.below()),
    };
    Ok((part, sealer.nodes))
}

fn unproved((_, message): Wrong) -> Error {
    not_proved(&message)
}

fn not_proved(what: &str) -> Error {
    Error::NotSupported {
        what: format!("a proof in exact numbers: {what}"),
        index: None,
        line: None,
    }
}

fn overflow() -> Error {
    Error::Overflow {
        what: "the bound of the proof overflows".to_owned(),
        index: None,
    }
}

/// The steps that hold in exact numbers, taken. Bounds of reals may be off by rounding errors, and are then moved
/// outwards.
fn taken(
    problem: &mut ExactProblem,
    limits: &mut Limits,
    steps: &[Step],
    ask: Ask,
) -> Result<Vec<Step>> {
    let mut kept = Vec::new();
    for (at, &step) in steps.iter().enumerate() {
        if at % 64 == 63 {
            ask()?;
        }
        let right = outwards(step).find(|&step| take(problem, limits, step).is_ok());
        kept.extend(right);
        if limits.are_empty() {
            break;
        }
    }
    Ok(kept)
}

/// The step, and further ones with a bound that is less tight.
fn outwards(step: Step) -> impl Iterator<Item = Step> {
    let parts = [0.0, 0.5 * f64::EPSILON, 1e-15, 1e-12];
    parts.into_iter().map(move |part| match step {
        Step::Lower(row, unknown, to) if part > 0.0 => {
            Step::Lower(row, unknown, (to - part * to.abs()).next_down())
        }
        Step::Upper(row, unknown, to) if part > 0.0 => {
            Step::Upper(row, unknown, (to + part * to.abs()).next_up())
        }
        other => other,
    })
}

/// The multipliers that show that the rows contradict each other before any branch.
fn contradiction(
    problem: &ExactProblem,
    limits: &Limits,
    derivation: &Derivation,
) -> Option<Multipliers> {
    if limits.are_empty() || has_empty_row(problem) {
        return Some(Vec::new());
    }
    let ending = derivation.contradiction.as_ref()?;
    let all = PartObjective::all(&problem.integer);
    candidates(ending)
        .into_iter()
        .find_map(|multipliers| contradicting(problem, limits, &all, multipliers))
}

/// The multipliers, or others near them, if they show that no point is within the rows and the limits.
fn contradicting(
    problem: &ExactProblem,
    limits: &Limits,
    part: &PartObjective,
    multipliers: Multipliers,
) -> Option<Multipliers> {
    let rows = Minorant::of_rows(problem, limits, part, &multipliers).ok()?;
    if let Ok(least) = rows.least(limits, part) {
        return least.sign().is_gt().then_some(multipliers);
    }
    let given = Certificate {
        point: Vec::new(),
        multipliers,
    };
    let place = Place {
        problem,
        limits,
        part,
    };
    let (least, mended) = place.mended(&given)?;
    least.sign().is_gt().then_some(mended.multipliers)
}

/// The multipliers that may show a contradiction.
fn candidates(ending: &Ending) -> Vec<Multipliers> {
    match ending {
        Ending::Contradiction(rows) => vec![numbers(rows)],
        Ending::Missed(row) => [1.0, -1.0].map(|by| numbers(&[(*row, by)])).to_vec(),
        Ending::Bounded | Ending::Branched { .. } => Vec::new(),
    }
}

fn numbers(rows: &[(u32, f64)]) -> Multipliers {
    let rows = rows.iter().filter(|(_, by)| *by != 0.0);
    rows.map(|&(row, by)| (row, Number::Float(by))).collect()
}

/// The parts with all unknowns that are free in exact numbers, and no others. An unknown that only floats take for
/// fixed joins the part that the objective couples it with, or is one of its own.
fn all_free(
    problem: &ExactProblem,
    limits: &Limits,
    parts: &[Searched],
    values: Option<&[f64]>,
) -> Vec<Searched> {
    let n = problem.integer.len();
    let mut parts = parts.to_vec();
    let mut part_of = vec![usize::MAX; n];
    for (p, part) in parts.iter_mut().enumerate() {
        let fixed = |&j: &u32| limits.fixed(j as usize).is_some();
        let kept: Vec<bool> = part.unknowns.iter().map(|j| !fixed(j)).collect();
        for node in &mut part.nodes {
            if let Some(certificate) = &mut node.certificate {
                let mut kept = kept.iter();
                certificate.point.retain(|_| kept.next() == Some(&true));
            }
        }
        let mut kept = kept.iter();
        part.unknowns.retain(|_| kept.next() == Some(&true));
        for &j in &part.unknowns {
            part_of[j as usize] = p;
        }
    }
    for j in 0..n {
        if part_of[j] != usize::MAX || limits.fixed(j).is_some() {
            continue;
        }
        let value = match (values, limits.side(j, Side::Lower)) {
            (Some(values), _) if j < values.len() => values[j],
            (_, Some(lower)) => lower.near(),
            (_, None) => 0.0,
        };
        let other = coupled(problem, j).find(|&k| part_of[k] != usize::MAX);
        part_of[j] = other.map_or(parts.len(), |k| part_of[k]);
        match parts.get_mut(part_of[j]) {
            Some(part) => {
                part.unknowns.push(j as u32);
                for node in &mut part.nodes {
                    if let Some(certificate) = &mut node.certificate {
                        certificate.point.push(value);
                    }
                }
            }
            None => parts.push(alone(j, value)),
        }
    }
    parts.retain(|part| !part.unknowns.is_empty());
    parts
}

/// A part of one unknown, bounded at one value.
fn alone(unknown: usize, value: f64) -> Searched {
    let certificate = Multiplied {
        point: vec![value],
        multipliers: Vec::new(),
    };
    Searched {
        unknowns: vec![unknown as u32],
        nodes: vec![super::derivation::Visited {
            certificate: Some(certificate),
            ..Default::default()
        }],
        ..Searched::default()
    }
}

/// The unknowns that share a term of the objective with this one.
fn coupled(problem: &ExactProblem, j: usize) -> impl Iterator<Item = usize> + '_ {
    let of_product = problem.quadratic.iter().filter_map(move |(a, b, _)| {
        if *a == j {
            Some(*b)
        } else {
            (*b == j).then_some(*a)
        }
    });
    let squares = problem.squares.iter();
    let squares = squares.filter(move |square| square.terms.iter().any(|(k, _)| *k == j));
    of_product.chain(squares.flat_map(|square| square.terms.iter().map(|(k, _)| *k)))
}

/// A certificate above the node that is looked at.
struct Above {
    /// The node of the search, and that of the proof.
    searched: usize,
    written: usize,
    known: Option<Held>,
}

/// A node that is still to come.
struct Waiting {
    searched: usize,
    mark: usize,
    branch: Option<(u32, Side, f64)>,
    /// How many of the certificates above are above this node.
    above: usize,
}

struct Sealer<'a> {
    problem: &'a mut ExactProblem,
    limits: &'a mut Limits,
    objective: &'a PartObjective,
    floats: Floats,
    searched: &'a Searched,
    nodes: Vec<Node>,
    above: Vec<Above>,
    /// The least bound of a leaf that is not empty.
    least: Option<Exact>,
    ask: Ask<'a>,
}

impl Sealer<'_> {
    /// Writes the nodes in preorder.
    fn seal(&mut self) -> Result<()> {
        let root = self.limits.mark();
        let mut waiting = vec![Waiting {
            searched: 0,
            mark: root,
            branch: None,
            above: 0,
        }];
        while let Some(next) = waiting.pop() {
            (self.ask)()?;
            self.limits.go_back(next.mark);
            self.above.truncate(next.above);
            if let Some((unknown, side, to)) = next.branch {
                let to = Exact::of(to).ok_or_else(overflow)?;
                self.limits
                    .tighten(self.problem, unknown as usize, side, to);
            }
            let visited = &self.searched.nodes[next.searched];
            let steps = taken(self.problem, self.limits, &visited.steps, self.ask)?;
            self.nodes.push(Node {
                steps,
                ..Node::default()
            });
            if visited.certificate.is_some() {
                self.above.push(Above {
                    searched: next.searched,
                    written: self.nodes.len() - 1,
                    known: None,
                });
            }
            let Ending::Branched {
                unknown,
                at,
                children,
            } = visited.ending
            else {
                self.leaf(&visited.ending)?;
                continue;
            };
            if self.limits.are_empty() {
                self.end(End::Empty(Vec::new()));
                continue;
            }
            self.end(End::Branch(unknown, at));
            let sides = [(Side::Upper, at), (Side::Lower, at + 1.0)];
            for (child, (side, to)) in children.into_iter().zip(sides).rev() {
                waiting.push(Waiting {
                    searched: child,
                    mark: self.limits.mark(),
                    branch: Some((unknown, side, to)),
                    above: self.above.len(),
                });
            }
        }
        Ok(())
    }

    fn end(&mut self, end: End) {
        if let Some(node) = self.nodes.last_mut() {
            node.end = end;
        }
    }

    fn leaf(&mut self, ending: &Ending) -> Result<()> {
        if self.limits.are_empty() {
            self.end(End::Empty(Vec::new()));
            return Ok(());
        }
        for multipliers in candidates(ending) {
            let (problem, limits) = (&*self.problem, &*self.limits);
            if let Some(shown) = contradicting(problem, limits, self.objective, multipliers) {
                self.end(End::Empty(shown));
                return Ok(());
            }
        }
        let Some(bound) = self.best_above()? else {
            return Ok(());
        };
        self.least = match self.least.take() {
            Some(least) if least < bound => Some(least),
            _ => Some(bound),
        };
        Ok(())
    }

    /// The bound of the nearest certificate that gives one, or of one near it. It is written with its node, or, if
    /// others are between, with the leaf. Nothing for a bound that is not below the least so far.
    fn best_above(&mut self) -> Result<Option<Exact>> {
        let mut open = None;
        let (problem, limits, part) = (&*self.problem, &*self.limits, self.objective);
        let place = Place {
            problem,
            limits,
            part,
        };
        let (leaf, ask) = (self.nodes.len() - 1, self.ask);
        for (distance, above) in self.above.iter_mut().rev().enumerate() {
            let known = above.known.get_or_insert_with(|| {
                let certificate = self.searched.nodes[above.searched].certificate.as_ref();
                let given = certificate.map(written).unwrap_or_default();
                Held::of(problem, part, &self.floats, given)
            });
            // Where another certificate is written, which other leaves need, the leaf gets its own.
            let nodes = &mut self.nodes;
            let mut write = |certificate: Certificate| {
                let there = &nodes[above.written].certificate;
                let is_free = there.as_ref().is_none_or(|there| *there == certificate);
                let at = match distance == 0 && is_free {
                    true => above.written,
                    false => leaf,
                };
                nodes[at].certificate = Some(certificate);
            };
            let is_enough = |least| known.reaches(least, limits, part, &self.floats);
            if self.least.as_ref().is_some_and(is_enough) {
                write(known.certificate.clone());
                return Ok(None);
            }
            ask()?;
            let minorant = known.exact(problem, limits, part).map_err(unproved)?;
            let found = match minorant.least(limits, part) {
                Ok(least) => Some((least, known.certificate.clone())),
                Err(Open(unknown)) => {
                    open = Some(unknown);
                    place.mended(&known.certificate)
                }
            };
            if let Some((least, certificate)) = found {
                write(certificate);
                return Ok(Some(least));
            }
        }
        Err(Error::NotSupported {
            what: match open {
                Some(unknown) => format!(
                    "a proof in exact numbers: unknown {unknown} has neither a bound nor curvature of its \
                     own; bounds of it make a proof possible"
                ),
                None => {
                    "a proof in exact numbers: the search ended before its first bound".to_owned()
                }
            },
            index: open,
            line: None,
        })
    }
}

/// A certificate as it is written.
fn written(certificate: &Multiplied) -> Certificate {
    Certificate {
        point: certificate
            .point
            .iter()
            .map(|&x| Number::Float(x))
            .collect(),
        multipliers: numbers(&certificate.multipliers),
    }
}
