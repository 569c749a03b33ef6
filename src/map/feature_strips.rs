//! Strips between features that rounding may collapse to one line.
//!
//! Two feature curves that are closer together than the width of a quad often round to the same integer.
//! The strip between them then collapses, and the quads lose one of the curves. The rows found
//! here keep such curves one unit apart, across the strip.

use std::collections::{BTreeSet, VecDeque};

use super::SeamlessProblem;
use super::separation::apart;
use crate::error::Result;
use crate::linalg::DisjointSets;
use crate::mesh::TriangleMesh;
use crate::mesh::vector::{dot, sub};
use crate::monitor::may_continue;
use crate::solve::SoftRow;

/// Strips narrower than this part of a quad stay collapsed: quads in them would be slivers.
const NARROWEST: f64 = 0.2;

/// Curves farther apart than this, in quads, are not considered: they do not round to one line.
const WIDEST: f64 = 1.5;

/// The least ratio of the distance across a strip to that along it. At the corner of a curve the field
/// turns on the way to the next curve, and the shortest path goes along the strip as far as across it.
const LEVEL: f64 = 0.5;

impl SeamlessProblem {
    /// The rows that keep neighbouring curves apart, one for each pair and chart.
    ///
    /// # Errors
    /// The end of the call.
    pub(crate) fn feature_strips(&self, mesh: &TriangleMesh) -> Result<Vec<SoftRow>> {
        let lines = Lines::new(self);
        let mut found = Vec::new();
        let mut known = BTreeSet::new();
        for v in 0..mesh.vertex_count() {
            for copy in self.sectors.first[v]..self.sectors.first[v + 1] {
                for axis in 0..2 {
                    if lines.of(copy, axis).is_some() {
                        may_continue()?;
                        self.strips_from(mesh, &lines, (v, copy, axis), |strip, curves| {
                            if known.insert(curves) {
                                found.push(strip);
                            }
                        });
                    }
                }
            }
        }
        Ok(found)
    }

    /// Searches breadth-first from a vertex on a curve across to other curves of the same coordinate.
    fn strips_from(
        &self,
        mesh: &TriangleMesh,
        lines: &Lines,
        (vertex, copy, axis): (usize, u32, usize),
        mut tell: impl FnMut(SoftRow, [u32; 2]),
    ) {
        let here = lines.of(copy, axis);
        let mut reached = BTreeSet::from([copy]);
        let mut queue = VecDeque::from([(vertex, copy, [0.0; 2])]);
        while let Some((v, at, from)) = queue.pop_front() {
            for (face, corner) in mesh.ring(v) {
                if self.sectors.copy[face][corner] != at {
                    continue;
                }
                let positions = mesh.corner_positions(face);
                let targets = self.targets(mesh, face);
                for end in [(corner + 1) % 3, (corner + 2) % 3] {
                    let next = self.sectors.copy[face][end];
                    let step = sub(positions[end], positions[corner]);
                    let width = [0, 1].map(|i| from[i] + dot(targets[i], step));
                    let [across, along] = [width[axis], width[1 - axis]].map(f64::abs);
                    if across > WIDEST || along > WIDEST || !reached.insert(next) {
                        continue;
                    }
                    let there = lines.of(next, axis);
                    if there.is_none() {
                        queue.push_back((mesh.corners(face)[end], next, width));
                    } else if there != here && across >= NARROWEST && across >= LEVEL * along {
                        let mut copies = [copy, next];
                        let mut curves = [here, there].map(|line| line.unwrap_or(0));
                        if width[axis] < 0.0 {
                            copies.reverse();
                            curves.reverse();
                        }
                        tell(apart(copies, axis, 1.0, across), curves);
                    }
                }
            }
        }
    }
}

impl SeamlessProblem {
    /// For each unknown, the least unknown that isolines make equal to it.
    pub(crate) fn lines(&self) -> Vec<u32> {
        Lines::new(self).root
    }
}

/// The unknowns that isolines make equal.
struct Lines {
    /// For each unknown, the least unknown that is equal to it.
    root: Vec<u32>,
    is_on_line: Vec<bool>,
}

impl Lines {
    fn new(problem: &SeamlessProblem) -> Self {
        let count = 2 * problem.sectors.count();
        let mut is_on_line = vec![false; count];
        let mut equal = DisjointSets::new(count);
        for isoline in &problem.isolines {
            let [a, b] = isoline.unknowns();
            equal.join(a, b);
            is_on_line[a] = true;
            is_on_line[b] = true;
        }
        Lines {
            root: (0..count)
                .map(|unknown| equal.root(unknown) as u32)
                .collect(),
            is_on_line,
        }
    }

    /// The curve that fixes a copy's coordinate, if there is one.
    fn of(&self, copy: u32, axis: usize) -> Option<u32> {
        let unknown = 2 * copy as usize + axis;
        self.is_on_line[unknown].then(|| self.root[unknown])
    }
}
