//! Strips between features that rounding may put on one line.
//!
//! Two feature curves side by side, closer than a quad is wide, round to the same integer more often
//! than not: the strip between them is collapsed, and one of the curves is lost to the quads. Such
//! curves are to be held one unit apart, across as the strip is.

use std::collections::{BTreeSet, VecDeque};

use super::SeamlessProblem;
use super::separation::SeparationConstraint;
use crate::linalg::DisjointSets;
use crate::mesh::TriangleMesh;
use crate::mesh::vector::{dot, sub};

/// Strips narrower than this part of a quad are left collapsed: quads in them would be slivers.
const NARROWEST: f64 = 0.2;

/// Curves farther apart than this, in quads, are not looked at: they do not round to one line.
const WIDEST: f64 = 1.5;

/// Across a strip must be at least this part of along it: at the corner of a curve the field turns on
/// the way to the next, and the shortest way goes along as much as across.
const LEVEL: f64 = 0.5;

impl SeamlessProblem {
    /// What holds curves side by side apart, each pair once a chart.
    pub(crate) fn feature_strips(&self, mesh: &TriangleMesh) -> Vec<SeparationConstraint> {
        let lines = Lines::new(self);
        let mut found = Vec::new();
        let mut known = BTreeSet::new();
        for v in 0..mesh.vertex_count() {
            for copy in self.sectors.first[v]..self.sectors.first[v + 1] {
                for axis in 0..2 {
                    if lines.of(copy, axis).is_some() {
                        self.strips_from(mesh, &lines, (v, copy, axis), |strip, curves| {
                            if known.insert(curves) {
                                found.push(strip);
                            }
                        });
                    }
                }
            }
        }
        found
    }

    /// Breadth-first from a vertex on a curve across to other curves of the same coordinate.
    fn strips_from(
        &self,
        mesh: &TriangleMesh,
        lines: &Lines,
        (vertex, copy, axis): (usize, u32, usize),
        mut tell: impl FnMut(SeparationConstraint, [u32; 2]),
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
                        tell(SeparationConstraint::new(copies, axis, 1.0), curves);
                    }
                }
            }
        }
    }
}

/// Which unknowns the isolines make equal.
struct Lines {
    /// For each unknown the least of those that equal it.
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

    /// The curve on which a copy's coordinate is held, if it is.
    fn of(&self, copy: u32, axis: usize) -> Option<u32> {
        let unknown = 2 * copy as usize + axis;
        self.is_on_line[unknown].then(|| self.root[unknown])
    }
}
