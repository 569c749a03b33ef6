//! Subdivisions: how many edges of quads every arc gets.
//!
//! With l the length of arc e, h that of an edge of quads and n the number of edges, all integer and at least 1:
//!
//! ```text
//! minimise   sum w_e (n_e - l_e / h)^2        (w_e: l_e over their mean, at least 1/2)
//! subject to n of opposite sides of a patch with four sides are equal
//!            n of side i of any other patch is the sum of its spokes i - 1 and i + 1
//! ```
//!
//! A patch of other than four sides has an irregular vertex in its middle, from where a spoke leads to each side. Spoke
//! i ends on side i, and divides it: the part next to side i - 1 is as long as spoke i - 1, the other as spoke i + 1.
//! A spoke counts as an arc with half of the weight, half as long as the two sides beside the one where it ends are
//! on average.

use super::base_layout::BaseLayout;
use crate::error::{Conflicting, Error, Result};
use crate::linalg::DisjointSets;
use crate::monitor::Monitor;
use crate::problem::Problem;
use crate::search::{Options, SolveStatus, Strategy};
use crate::solve::{Solution, solve_with};

/// The least weight. Where weights differ more, the method for networks looks at steps that are far too long, and
/// a search takes its place.
const LEAST_WEIGHT: f64 = 0.5;

/// The weight of a spoke over that of an arc as long: a power of two.
const SPOKE: f64 = 0.5;

/// Lengths are rounded to this part of their mean, and of an edge: costs are then exact in few bits, and the
/// polynomial method for networks can sum them.
const QUANTUM: f64 = 1.0 / 4096.0;

/// The most scales that are tried to meet a number of quads.
const SCALES: usize = 8;

/// The part of a number of quads by which it may be missed.
const TOLERANCE: f64 = 0.01;

/// The nodes of a search after which the best numbers so far are taken.
const NODES: usize = 20_000;

/// The largest number of edges that may be asked for.
const MOST: u32 = 1 << 20;

/// How finely a layout is divided.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum LayoutSizing {
    /// As few quads as the layout allows.
    Fewest,
    /// About as many quads as this.
    Quads(usize),
    /// Edges of about this length.
    EdgeLength(f64),
}

/// The numbers of edges of quads along arcs and spokes.
#[derive(Debug, Clone, PartialEq)]
pub struct Subdivisions {
    /// For every arc.
    pub arcs: Vec<u32>,
    /// For the spoke to every side of each patch of other than four sides; empty for those of four.
    pub spokes: Vec<Vec<u32>>,
    /// The number of quads.
    pub quads: usize,
    /// The length of an edge that arcs are compared with; 0 for [`LayoutSizing::Fewest`].
    pub edge_length: f64,
    /// The energy that is minimised.
    pub energy: f64,
    /// A proved lower bound on it.
    pub lower_bound: f64,
    /// Whether the energy is proved to be the least.
    pub is_optimal: bool,
}

/// The problem of a layout with arcs of these lengths.
pub(crate) struct Subdividing<'a> {
    layout: &'a BaseLayout,
    lengths: &'a [f64],
    /// Arcs with a number that the caller fixed.
    fixed: &'a [(usize, u32)],
    /// The first unknown for the spokes of each patch; none for patches of four sides.
    spokes: Vec<Option<usize>>,
    unknowns: usize,
}

impl<'a> Subdividing<'a> {
    /// # Errors
    /// For arcs that are not there, are fixed twice, or to numbers that are not from 1 to 2^20.
    pub fn new(
        layout: &'a BaseLayout,
        lengths: &'a [f64],
        fixed: &'a [(usize, u32)],
    ) -> Result<Self> {
        for (position, &(arc, number)) in fixed.iter().enumerate() {
            if arc >= layout.arc_count() {
                return Err(Error::IndexOutOfRange {
                    what: "arcs with fixed subdivisions",
                    position,
                    value: i64::try_from(arc).unwrap_or(i64::MAX),
                    len: layout.arc_count(),
                });
            }
            let is_twice = fixed[..position].iter().any(|other| other.0 == arc);
            let what = match number {
                1..=MOST if !is_twice => continue,
                1..=MOST => format!("the subdivision of arc {arc} is fixed twice"),
                _ => format!("arc {arc} is fixed to {number} edges; it must have 1 to {MOST}"),
            };
            return Err(Error::InvalidArgument {
                what,
                index: Some(arc),
            });
        }
        let mut unknowns = layout.arc_count();
        let spokes = layout.polygons().iter().map(|polygon| {
            (polygon.len() != 4).then(|| {
                unknowns += polygon.len();
                unknowns - polygon.len()
            })
        });
        Ok(Subdividing {
            spokes: spokes.collect(),
            unknowns,
            layout,
            lengths,
            fixed,
        })
    }

    /// The subdivisions of least energy, proved.
    ///
    /// # Errors
    /// [`Error::Contradiction`] with a smallest set of patches and fixed arcs that contradict each other.
    pub fn solve<'m>(
        &self,
        sizing: LayoutSizing,
        area: f64,
        monitor: &impl Fn() -> Monitor<'m>,
    ) -> Result<Subdivisions> {
        match sizing {
            LayoutSizing::Fewest => self.at(0.0, monitor),
            LayoutSizing::EdgeLength(length) => self.at(length, monitor),
            LayoutSizing::Quads(quads) => self.for_quads(quads, area, monitor),
        }
    }

    /// Those that come nearest to a number of quads, among a few scales.
    fn for_quads<'m>(
        &self,
        quads: usize,
        area: f64,
        monitor: &impl Fn() -> Monitor<'m>,
    ) -> Result<Subdivisions> {
        let asked = quads as f64;
        // Of the logarithm of the number over the one asked for.
        let excess = |found: &Subdivisions| (found.quads as f64 / asked).ln();
        // Logarithms of edge lengths: with the first there are too many quads, with the second too few.
        let (mut fine, mut coarse) = (None, None);
        let mut place = 0.5 * (area / asked).ln();
        let mut best = self.at(place.exp(), monitor)?;
        let mut last = excess(&best);
        for _ in 1..SCALES {
            *(if last >= 0.0 { &mut fine } else { &mut coarse }) = Some(place);
            // No scale gives fewer quads than a coarse one.
            let is_least = last >= 0.0 && best.arcs.iter().all(|&n| n == 1);
            if excess(&best).abs() <= TOLERANCE || is_least {
                break;
            }
            // The number goes with the square of the scale.
            let next = place + 0.5 * last;
            place = match (fine, coarse) {
                (Some(fine), Some(coarse)) if next <= fine || next >= coarse => {
                    0.5 * (fine + coarse)
                }
                _ => next,
            };
            let found = self.at(place.exp(), monitor)?;
            last = excess(&found);
            if last.abs() < excess(&best).abs() {
                best = found;
            }
        }
        Ok(best)
    }

    /// The subdivisions for edges of this length; for 0, the fewest.
    fn at<'m>(&self, edge: f64, monitor: &impl Fn() -> Monitor<'m>) -> Result<Subdivisions> {
        let every = vec![true; self.demands()];
        let solution =
            self.attempt(edge, &every, monitor).map_err(|error| {
                match is_contradiction(&error) {
                    true => self.smallest_conflict(error, monitor),
                    false => error,
                }
            })?;
        Ok(self.read(edge, &solution))
    }

    fn attempt<'m>(
        &self,
        edge: f64,
        holds: &[bool],
        monitor: &impl Fn() -> Monitor<'m>,
    ) -> Result<Solution> {
        let options = Options {
            strategy: Strategy::Exact,
            nodes: NODES,
            ..Options::default()
        };
        let problem = self.problem(edge, &self.strips(holds), holds)?;
        solve_with(&problem, &options, monitor())
    }

    /// The weight of an arc of this length: that of the mean is 1.
    fn weight(&self, length: f64) -> f64 {
        let mean = self.lengths.iter().sum::<f64>() / self.lengths.len() as f64;
        rounded(length / mean).max(LEAST_WEIGHT)
    }

    /// The demands that may contradict each other: of patches first, then of fixed arcs.
    fn demands(&self) -> usize {
        self.layout.polygons().len() + self.fixed.len()
    }

    /// The strip of each arc: arcs on opposite sides of patches with four sides have one number. Only patches that are
    /// to hold count.
    fn strips(&self, holds: &[bool]) -> Vec<usize> {
        let arcs = self.layout.arc_count();
        let mut sets = DisjointSets::new(arcs);
        for (p, sides) in self.layout.sides().iter().enumerate() {
            if let (None, true, [a, b, c, d]) = (self.spokes[p], holds[p], sides.as_slice()) {
                sets.join(*a as usize / 2, *c as usize / 2);
                sets.join(*b as usize / 2, *d as usize / 2);
            }
        }
        (0..arcs).map(|arc| sets.root(arc)).collect()
    }

    /// The problem with those demands that are to hold. The number of an arc is the unknown of its strip; other arcs of
    /// the strip have none. A strip ends at patches of other than four sides, so that each unknown is in two rows at
    /// most, and the polynomial method for networks solves this.
    fn problem(&self, edge: f64, strips: &[usize], holds: &[bool]) -> Result<Problem> {
        let mut problem = Problem::new(self.unknowns)?;
        let all: Vec<usize> = (0..self.unknowns).collect();
        problem.set_integers(&all)?;
        for (arc, &length) in self.lengths.iter().enumerate() {
            let weight = self.weight(length);
            problem.add_least_squares(&[strips[arc]], &[1.0], wanted(length, edge), weight)?;
        }
        let mut lower = vec![1.0; self.unknowns];
        let mut upper = vec![f64::INFINITY; self.unknowns];
        for (p, sides) in self.layout.sides().iter().enumerate() {
            let Some(first) = self.spokes[p] else {
                continue;
            };
            let arcs: Vec<usize> = sides.iter().map(|&dart| dart as usize / 2).collect();
            let n = arcs.len();
            for (i, &arc) in arcs.iter().enumerate() {
                let [before, after] = [(i + n - 1) % n, (i + 1) % n];
                let beside = 0.25 * (self.lengths[arcs[before]] + self.lengths[arcs[after]]);
                let weight = SPOKE * self.weight(beside);
                problem.add_least_squares(&[first + i], &[1.0], wanted(beside, edge), weight)?;
                if holds[p] {
                    let of = [strips[arc], first + before, first + after];
                    problem.add_constraint(&of, &[1.0, -1.0, -1.0], 0.0)?;
                }
            }
        }
        for (k, &(arc, number)) in self.fixed.iter().enumerate() {
            if holds[self.layout.polygons().len() + k] {
                let (strip, number) = (strips[arc], f64::from(number));
                lower[strip] = number.max(lower[strip]);
                upper[strip] = number.min(upper[strip]);
                if lower[strip] > upper[strip] {
                    return Err(Error::Contradiction {
                        what: format!("arc {arc} is in a strip with another fixed number"),
                        index: Some(arc),
                        elements: Vec::new(),
                    });
                }
            }
        }
        problem.set_bounds(&all, &lower, &upper)?;
        Ok(problem)
    }

    fn read(&self, edge: f64, solution: &Solution) -> Subdivisions {
        let values = solution.values();
        let strips = self.strips(&vec![true; self.demands()]);
        let arcs: Vec<u32> = strips
            .into_iter()
            .map(|strip| values[strip] as u32)
            .collect();
        let sides = self.layout.sides();
        let spokes: Vec<Vec<u32>> = sides
            .iter()
            .zip(&self.spokes)
            .map(|(sides, &first)| match first {
                Some(first) => (0..sides.len()).map(|i| values[first + i] as u32).collect(),
                None => Vec::new(),
            })
            .collect();
        let quads = sides.iter().zip(&spokes).map(|(sides, spokes)| {
            let along = |i: usize| arcs[sides[i] as usize / 2] as usize;
            match spokes.len() {
                0 => along(0) * along(1),
                n => (0..n)
                    .map(|i| spokes[i] as usize * spokes[(i + 1) % n] as usize)
                    .sum(),
            }
        });
        Subdivisions {
            quads: quads.sum(),
            spokes,
            edge_length: edge,
            energy: solution.energy(),
            lower_bound: solution.lower_bound().unwrap_or(f64::NEG_INFINITY),
            is_optimal: solution.status() == SolveStatus::Optimal,
            arcs,
        }
    }

    /// The error that names a set of demands that contradict each other, none of which can be left out.
    fn smallest_conflict<'m>(&self, found: Error, monitor: &impl Fn() -> Monitor<'m>) -> Error {
        let mut holds = vec![true; self.demands()];
        let mut size = holds.len().div_ceil(2);
        loop {
            let mut start = 0;
            while start < holds.len() {
                let end = (start + size).min(holds.len());
                if holds[start..end].contains(&true) {
                    let mut fewer = holds.clone();
                    fewer[start..end].fill(false);
                    match self.attempt(0.0, &fewer, monitor) {
                        Err(error) if is_contradiction(&error) => holds = fewer,
                        Err(Error::Cancelled) => return found,
                        _ => {}
                    }
                }
                start = end;
            }
            if size == 1 {
                break;
            }
            size = size.div_ceil(2);
        }
        let patches = self.layout.polygons().len();
        let of_patches: Vec<String> = (0..patches)
            .filter(|&p| holds[p])
            .map(|p| p.to_string())
            .collect();
        let of_arcs = (0..self.fixed.len()).filter(|&k| holds[patches + k]);
        let fixed: Vec<(usize, u32)> = of_arcs.map(|k| self.fixed[k]).collect();
        let names: Vec<String> = fixed
            .iter()
            .map(|&(arc, number)| {
                let [a, b] = self.layout.arcs()[arc];
                format!("{arc} (between vertices {a} and {b}, {number} edges)")
            })
            .collect();
        Error::Contradiction {
            what: format!(
                "the fixed subdivisions of arcs {} contradict each other in patches {}",
                names.join(", "),
                of_patches.join(", ")
            ),
            index: fixed.first().map(|&(arc, _)| arc),
            elements: fixed
                .iter()
                .map(|&(arc, _)| Conflicting::Bounds(arc))
                .collect(),
        }
    }
}

/// How many edges an arc of this length is to have. None for edges of length 0: the fewest are asked for.
fn wanted(length: f64, edge: f64) -> f64 {
    if edge > 0.0 {
        rounded(length / edge)
    } else {
        0.0
    }
}

fn rounded(x: f64) -> f64 {
    (x / QUANTUM).round() * QUANTUM
}

fn is_contradiction(error: &Error) -> bool {
    matches!(
        error,
        Error::Infeasible { .. } | Error::Contradiction { .. } | Error::NoIntegerSolution { .. }
    )
}

#[cfg(test)]
#[path = "subdivide_tests.rs"]
mod tests;
