//! Rows between cones and corners, and between them and isolines, that lie within a few quads of each other.
//!
//! Integers must keep such elements in the order in which they lie on the surface, or the faces between them
//! have no area wherever the other vertices move. `bommes2013` states this as linear inequalities. Here the
//! difference of two elements that a map should have is the sum of its target gradients along a shortest path,
//! which may cross the cut: there coordinates turn by quarters.

use std::cmp::Reverse;
use std::collections::{BTreeSet, BinaryHeap};
use std::f64::consts::FRAC_PI_4;
use std::sync::OnceLock;

use crate::error::Result;
use crate::map::{SeamlessProblem, row};
use crate::mesh::{TriangleMesh, turned};
use crate::monitor::{collect_in_turn, is_wanted};
use crate::solve::SoftRow;

/// How far paths go at first, in quads: the order of elements nearer than this is decided wrongly most often.
pub(crate) const NEAR: f64 = 3.0;

/// How far paths go where faults remain. Elements farther apart than [`NEAR`] need only keep their order along
/// one direction.
pub(crate) const FAR: f64 = 6.0;

/// Isolines nearer than this, in quads, are not kept apart from a cone: quads between them would be slivers.
const NARROWEST: f64 = 0.2;

/// The least ratio of the distance across to an isoline to that along it.
const LEVEL: f64 = 0.5;

/// A path asks whether it may go on once in so many vertices.
const ASKS: usize = 1024;

/// A copy of a vertex that a path has reached.
#[derive(Debug, Clone, Copy)]
struct Reached {
    vertex: usize,
    copy: u32,
    /// The quarter turns from coordinates in the copy's chart to those where the path began.
    quarters: u8,
    /// The difference to the path's begin that a map should have.
    aim: [f64; 2],
    /// The copy at which the path entered the chart.
    entry: u32,
    /// The number of the charts before, in `Search::charts`.
    before: Option<usize>,
}

/// A chart that a path has crossed.
#[derive(Debug, Clone, Copy)]
struct Chart {
    entry: u32,
    exit: u32,
    quarters: u8,
    before: Option<usize>,
}

impl SeamlessProblem {
    /// The pairs and the rows of all elements within `reach` quads of each other. `held` says which coordinates of
    /// every copy integers decide.
    ///
    /// # Errors
    /// The reason to end the current step.
    pub(super) fn near(&self, mesh: &TriangleMesh, held: &[[bool; 2]], reach: f64) -> Result<Near> {
        let first = &self.sectors.first;
        let is_point = |&v: &usize| {
            let mut copies = first[v]..first[v + 1];
            copies.any(|copy| held[copy as usize] == [true; 2])
        };
        let points: Vec<usize> = (0..mesh.vertex_count()).filter(is_point).collect();
        if points.is_empty() {
            return Ok(Near::default());
        }
        let surface = Surface {
            problem: self,
            mesh,
            held,
            lines: self.lines(),
            sides: (0..mesh.face_count()).map(|_| OnceLock::new()).collect(),
        };
        let found = collect_in_turn(points.len(), |k| {
            Search::new(&surface, points[k], reach).near()
        });
        let mut all = Near::default();
        for near in found {
            let near = near?;
            all.rows.extend(near.rows);
            all.pairs.extend(near.pairs);
        }
        Ok(all)
    }
}

/// The surface on which all searches go.
struct Surface<'a> {
    problem: &'a SeamlessProblem,
    mesh: &'a TriangleMesh,
    held: &'a [[bool; 2]],
    lines: Vec<u32>,
    /// The difference that each side of a face should have, once a search has come there.
    sides: Vec<OnceLock<[[f64; 2]; 3]>>,
}

impl Surface<'_> {
    /// The differences that the coordinates of the two other corners of a face should have to those of this one.
    fn steps(&self, face: usize, corner: usize) -> [(usize, [f64; 2]); 2] {
        let aim = |k: usize| self.problem.aim(self.mesh, face, k, (k + 1) % 3);
        let sides = self.sides[face].get_or_init(|| [0, 1, 2].map(aim));
        let [next, last] = [(corner + 1) % 3, (corner + 2) % 3];
        [(next, sides[corner]), (last, sides[last].map(|x| -x))]
    }
}

/// The search from one cone or corner.
struct Search<'a> {
    surface: &'a Surface<'a>,
    start: usize,
    /// The length of the longest path, in quads.
    reach: f64,
    charts: Vec<Chart>,
    /// By the bits of the length, then by number.
    heap: BinaryHeap<Reverse<(u64, usize)>>,
    states: Vec<Reached>,
    found: Near,
}

/// The elements near each other.
#[derive(Debug, Default)]
pub(super) struct Near {
    pub(super) rows: Vec<SoftRow>,
    pub(super) pairs: Vec<NearPair>,
}

/// Two cones or corners near each other.
#[derive(Debug)]
pub(super) struct NearPair {
    pub(super) vertices: [usize; 2],
    /// The difference between them, u and v, that a map should have.
    pub(super) aim: [f64; 2],
    /// The terms of the difference that a map has.
    terms: [Vec<(usize, f64)>; 2],
}

impl NearPair {
    /// By how much the difference that a map should have is larger than the one that it has.
    pub(super) fn deviation(&self, axis: usize, values: &[f64]) -> f64 {
        self.aim[axis] - value(&self.terms[axis], values)
    }

    /// The row that brings the difference of a map one nearer to the one that it should have.
    pub(super) fn step(&self, axis: usize, values: &[f64]) -> SoftRow {
        let by = 1f64.copysign(self.deviation(axis, values));
        let terms: Vec<_> = self.terms[axis].iter().map(|&(i, c)| (i, by * c)).collect();
        let least = value(&terms, values).round() + 1.0;
        row(terms, least, self.aim[0].hypot(self.aim[1]))
    }
}

fn value(terms: &[(usize, f64)], values: &[f64]) -> f64 {
    terms.iter().map(|&(i, c)| c * values[i]).sum()
}

impl<'a> Search<'a> {
    fn new(surface: &'a Surface, start: usize, reach: f64) -> Self {
        Search {
            surface,
            start,
            reach,
            charts: Vec::new(),
            heap: BinaryHeap::new(),
            states: Vec::new(),
            found: Near::default(),
        }
    }

    fn push(&mut self, length: f64, state: Reached) {
        if length <= self.reach {
            self.heap
                .push(Reverse((length.to_bits(), self.states.len())));
            self.states.push(state);
        }
    }

    /// The pairs and the rows between the vertex, with all its copies, and what is found around it. A path ends at
    /// the first cone or corner.
    fn near(mut self) -> Result<Near> {
        let (surface, start) = (self.surface, self.start);
        let first = &surface.problem.sectors.first;
        for copy in first[start]..first[start + 1] {
            let state = Reached {
                vertex: start,
                copy,
                quarters: 0,
                aim: [0.0; 2],
                entry: copy,
                before: None,
            };
            self.push(0.0, state);
        }
        let mut is_settled = vec![false; surface.held.len()];
        let mut settled = 0;
        // The isolines through the vertex itself.
        let unknowns = 2 * first[start] as usize..2 * first[start + 1] as usize;
        let mut known: BTreeSet<u32> = surface.lines[unknowns].iter().copied().collect();
        while let Some(Reverse((bits, number))) = self.heap.pop() {
            let state = self.states[number];
            if std::mem::replace(&mut is_settled[state.copy as usize], true) {
                continue;
            }
            if settled % ASKS == 0 {
                is_wanted()?;
            }
            settled += 1;
            if state.vertex != start {
                match surface.held[state.copy as usize] {
                    [true, true] => {
                        if start < state.vertex {
                            self.separate_points(&state);
                        }
                        continue;
                    }
                    [false, false] => {}
                    [is_u, _] => {
                        let axis = usize::from(!is_u);
                        let line = surface.lines[2 * state.copy as usize + axis];
                        if self.is_across(&state, axis) && known.insert(line) {
                            self.separate_line(&state, axis);
                        }
                    }
                }
            }
            self.go_on(f64::from_bits(bits), &state);
        }
        Ok(self.found)
    }

    fn go_on(&mut self, length: f64, state: &Reached) {
        let surface = self.surface;
        let (mesh, problem) = (surface.mesh, surface.problem);
        for (face, corner) in mesh.ring(state.vertex) {
            if problem.sectors.copy[face][corner] != state.copy {
                continue;
            }
            for (end, step) in surface.steps(face, corner) {
                let step = turned(state.quarters, step);
                let next = Reached {
                    vertex: mesh.corners(face)[end],
                    copy: problem.sectors.copy[face][end],
                    aim: [state.aim[0] + step[0], state.aim[1] + step[1]],
                    ..*state
                };
                self.push(length + step[0].hypot(step[1]), next);
            }
            for k in [corner, (corner + 2) % 3] {
                if state.vertex != self.start && problem.cut().contains(mesh.edge_of(face, k)) {
                    self.cross(length, state, face, k);
                }
            }
        }
    }

    /// Goes on at the same vertex in the chart beyond local edge `k` of a face.
    fn cross(&mut self, length: f64, state: &Reached, face: usize, k: usize) {
        let (mesh, problem) = (self.surface.mesh, self.surface.problem);
        let Some((across, _)) = mesh.neighbor(face, k) else {
            return;
        };
        let corners = mesh.corners(across);
        let Some(corner) = corners.iter().position(|&w| w == state.vertex) else {
            return;
        };
        let turn = problem.combing().transition_from(mesh, face, k);
        let copy = problem.sectors.copy[across][corner];
        self.charts.push(Chart {
            entry: state.entry,
            exit: state.copy,
            quarters: state.quarters,
            before: state.before,
        });
        let next = Reached {
            copy,
            entry: copy,
            quarters: (state.quarters + 4 - turn) % 4,
            before: Some(self.charts.len() - 1),
            ..*state
        };
        self.push(length, next);
    }

    /// Whether an isoline with this constant coordinate, in the chart of its copy, lies across the path.
    fn is_across(&self, state: &Reached, axis: usize) -> bool {
        let aim = turned((4 - state.quarters) % 4, state.aim).map(f64::abs);
        let (across, along) = (aim[axis], aim[1 - axis]);
        across >= NARROWEST && across >= LEVEL * along
    }

    fn separate_line(&mut self, state: &Reached, axis: usize) {
        let axis = if state.quarters.is_multiple_of(2) {
            axis
        } else {
            1 - axis
        };
        let mut by = [0.0; 2];
        by[axis] = 1f64.copysign(state.aim[axis]);
        let row = row(self.terms(state, by), 1.0, state.aim[axis]);
        self.found.rows.push(row);
    }

    /// The rows for the direction of one cone from another, to the nearest eighth of a turn: along an axis it
    /// deviates by an eighth at most, and along a diagonal it stays in the quadrant. Far apart, it need only have a
    /// part in this direction.
    fn separate_points(&mut self, state: &Reached) {
        self.found.pairs.push(NearPair {
            vertices: [self.start, state.vertex],
            aim: state.aim,
            terms: [[1.0, 0.0], [0.0, 1.0]].map(|by| self.terms(state, by)),
        });
        let [u, v] = state.aim;
        let distance = u.hypot(v);
        let eighths = (v.atan2(u) / FRAC_PI_4).round() as i32;
        let signs = [1f64.copysign(u), 1f64.copysign(v)];
        let axis = usize::from(v.abs() > u.abs());
        let mut along = [0.0; 2];
        along[axis] = signs[axis];
        let (direction, limits) = match eighths % 2 == 0 {
            true => {
                let beside = [1.0, -1.0].map(|side| {
                    let mut beside = along;
                    beside[1 - axis] = side;
                    beside
                });
                (along, beside)
            }
            false => (signs, [[signs[0], 0.0], [0.0, signs[1]]]),
        };
        let row_along = row(self.terms(state, direction), 1.0, distance);
        self.found.rows.push(row_along);
        if distance <= NEAR {
            let limits = limits.map(|by| row(self.terms(state, by), 0.0, distance));
            self.found.rows.extend(limits);
        }
    }

    /// The terms of `by . difference` along the path to a copy.
    fn terms(&self, state: &Reached, by: [f64; 2]) -> Vec<(usize, f64)> {
        let mut terms = Vec::new();
        let mut chart = Chart {
            entry: state.entry,
            exit: state.copy,
            quarters: state.quarters,
            before: state.before,
        };
        loop {
            let by = turned((4 - chart.quarters) % 4, by);
            for (axis, by) in by.into_iter().enumerate().filter(|(_, by)| *by != 0.0) {
                terms.push((2 * chart.exit as usize + axis, by));
                terms.push((2 * chart.entry as usize + axis, -by));
            }
            match chart.before {
                Some(before) => chart = self.charts[before],
                None => return terms,
            }
        }
    }
}

#[cfg(test)]
#[path = "near_cones_tests.rs"]
mod tests;
