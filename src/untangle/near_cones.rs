//! Rows between cones and corners, and between them and isolines, that lie within a few quads of each other.
//!
//! Integers must keep such elements in the order in which they lie on the surface, or the faces between them
//! have no area wherever the other vertices move. `bommes2013` states this as linear inequalities. Here the
//! difference of two elements that a map should have is the sum of its target gradients along a shortest path,
//! which may cross the cut: there coordinates turn by quarters.

use std::cmp::Reverse;
use std::collections::{BTreeSet, BinaryHeap};
use std::f64::consts::FRAC_PI_4;

use crate::map::{SeamlessProblem, row};
use crate::mesh::{TriangleMesh, turned};
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
    /// The rows of all elements within `reach` quads of each other. `held` says which coordinates of every copy
    /// integers decide.
    pub(super) fn near_rows(
        &self,
        mesh: &TriangleMesh,
        held: &[[bool; 2]],
        reach: f64,
    ) -> Vec<SoftRow> {
        let lines = self.lines();
        let mut found = Vec::new();
        for v in 0..mesh.vertex_count() {
            let mut copies = self.sectors.first[v]..self.sectors.first[v + 1];
            if copies.any(|copy| held[copy as usize] == [true; 2]) {
                Search::new(self, mesh, held, &lines, reach).from(v, &mut found);
            }
        }
        found
    }
}

/// The search from one cone or corner.
struct Search<'a> {
    problem: &'a SeamlessProblem,
    mesh: &'a TriangleMesh,
    held: &'a [[bool; 2]],
    lines: &'a [u32],
    /// The length of the longest path, in quads.
    reach: f64,
    charts: Vec<Chart>,
    /// By the bits of the length, then by number.
    heap: BinaryHeap<Reverse<(u64, usize)>>,
    states: Vec<Reached>,
}

impl<'a> Search<'a> {
    fn new(
        problem: &'a SeamlessProblem,
        mesh: &'a TriangleMesh,
        held: &'a [[bool; 2]],
        lines: &'a [u32],
        reach: f64,
    ) -> Self {
        Search {
            problem,
            mesh,
            held,
            lines,
            reach,
            charts: Vec::new(),
            heap: BinaryHeap::new(),
            states: Vec::new(),
        }
    }

    fn push(&mut self, length: f64, state: Reached) {
        if length <= self.reach {
            self.heap
                .push(Reverse((length.to_bits(), self.states.len())));
            self.states.push(state);
        }
    }

    /// Searches from all copies of a vertex. A path ends at the first cone or corner.
    fn from(&mut self, start: usize, found: &mut Vec<SoftRow>) {
        let first = &self.problem.sectors.first;
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
        let mut settled = BTreeSet::new();
        // The isolines through the vertex itself.
        let unknowns = 2 * first[start] as usize..2 * first[start + 1] as usize;
        let mut known: BTreeSet<u32> = self.lines[unknowns].iter().copied().collect();
        while let Some(Reverse((bits, number))) = self.heap.pop() {
            let state = self.states[number];
            if !settled.insert(state.copy) {
                continue;
            }
            if state.vertex != start {
                match self.held[state.copy as usize] {
                    [true, true] => {
                        if start < state.vertex {
                            self.separate_points(&state, found);
                        }
                        continue;
                    }
                    [false, false] => {}
                    [is_u, _] => {
                        let axis = usize::from(!is_u);
                        let line = self.lines[2 * state.copy as usize + axis];
                        if self.is_across(&state, axis) && known.insert(line) {
                            self.separate_line(&state, axis, found);
                        }
                    }
                }
            }
            self.go_on(f64::from_bits(bits), &state, state.vertex != start);
        }
    }

    fn go_on(&mut self, length: f64, state: &Reached, may_cross: bool) {
        let (mesh, problem) = (self.mesh, self.problem);
        for (face, corner) in mesh.ring(state.vertex) {
            if problem.sectors.copy[face][corner] != state.copy {
                continue;
            }
            for end in [(corner + 1) % 3, (corner + 2) % 3] {
                let step = turned(state.quarters, problem.aim(mesh, face, corner, end));
                let next = Reached {
                    vertex: mesh.corners(face)[end],
                    copy: problem.sectors.copy[face][end],
                    aim: [state.aim[0] + step[0], state.aim[1] + step[1]],
                    ..*state
                };
                self.push(length + step[0].hypot(step[1]), next);
            }
            for k in [corner, (corner + 2) % 3] {
                if may_cross && problem.cut().contains(mesh.edge_of(face, k)) {
                    self.cross(length, state, face, k);
                }
            }
        }
    }

    /// Goes on at the same vertex in the chart beyond local edge `k` of a face.
    fn cross(&mut self, length: f64, state: &Reached, face: usize, k: usize) {
        let Some((across, _)) = self.mesh.neighbor(face, k) else {
            return;
        };
        let corners = self.mesh.corners(across);
        let Some(corner) = corners.iter().position(|&w| w == state.vertex) else {
            return;
        };
        let turn = self.problem.combing().transition_from(self.mesh, face, k);
        let copy = self.problem.sectors.copy[across][corner];
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

    fn separate_line(&self, state: &Reached, axis: usize, found: &mut Vec<SoftRow>) {
        let axis = if state.quarters.is_multiple_of(2) {
            axis
        } else {
            1 - axis
        };
        let mut by = [0.0; 2];
        by[axis] = 1f64.copysign(state.aim[axis]);
        found.push(row(self.terms(state, by), 1.0, state.aim[axis]));
    }

    /// The rows for the direction of one cone from another, to the nearest eighth of a turn: along an axis it
    /// deviates by an eighth at most, and along a diagonal it stays in the quadrant. Far apart, it need only have a
    /// part in this direction.
    fn separate_points(&self, state: &Reached, found: &mut Vec<SoftRow>) {
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
        found.push(row(self.terms(state, direction), 1.0, distance));
        if distance <= NEAR {
            let limits = limits.map(|by| row(self.terms(state, by), 0.0, distance));
            found.extend(limits);
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
