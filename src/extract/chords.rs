//! Integer lines within one triangle, and where they cross.
//!
//! A line is a chord of the triangle. It starts and ends on the border; one end may be a corner that is an
//! irregular vertex. Two chords cross exactly if their ends alternate along the border. The counter-clockwise
//! order of the ends is the order around the crossing. Only the order of crossings along edges is used, so
//! the triangle may be folded or have no area.

use super::crossings::{Crossings, Line};
use super::grid_map::ONE;
use super::refined::{NONE, Refined};

/// A line in a triangle, from its first to its second end counter-clockwise along the border.
#[derive(Debug, Clone, Copy)]
pub(super) struct Chord {
    pub(super) line: Line,
    /// The places of its ends on the border.
    pub(super) at: [usize; 2],
}

/// The border of one triangle and its chords, loaded for one triangle after the other.
#[derive(Default)]
pub(super) struct Triangle {
    corners: [[i64; 2]; 3],
    corner_at: [usize; 3],
    /// For every place of the border, the crossing c and the side from which it is seen, as 2 c + side;
    /// `NONE` at corners.
    pub(super) border: Vec<u32>,
    /// Lines u, lines v.
    pub(super) chords: [Vec<Chord>; 2],
    found: Vec<(Line, usize)>,
}

impl Triangle {
    /// Loads a triangle.
    pub(super) fn load(&mut self, mesh: &Refined, crossings: &Crossings, face: usize) {
        self.corners = mesh.corners[face];
        self.border.clear();
        self.found.clear();
        for k in 0..3 {
            let h = 3 * face + k;
            self.corner_at[k] = self.border.len();
            self.border.push(NONE);
            let side = u32::from(mesh.twin[h] < h as u32);
            for (crossing, line) in crossings.of(mesh, h) {
                self.found.push((line, self.border.len()));
                self.border.push(2 * crossing + side);
            }
        }
        self.pair();
    }

    /// The corner at a place of the border, if there is one.
    pub(super) fn corner(&self, at: usize) -> Option<usize> {
        self.corner_at.iter().position(|&corner| corner == at)
    }

    /// Finds the two ends of every line.
    fn pair(&mut self) {
        self.chords.iter_mut().for_each(Vec::clear);
        let key = |&(line, at): &(Line, usize)| (line.axis, line.level, at);
        self.found.sort_unstable_by_key(key);
        let mut rest = self.found.iter().copied().peekable();
        while let Some((line, at)) = rest.next() {
            let second = rest.next_if(|next| next.0 == line).map(|next| next.1);
            // A line that crosses only one edge ends at a corner on the line.
            let axis = usize::from(line.axis);
            let on_line = |k: &usize| self.corners[*k][axis] == line.level * ONE;
            let corner = || (0..3).find(on_line).map(|k| self.corner_at[k]);
            if let Some(other) = second.or_else(corner) {
                let at = [at.min(other), at.max(other)];
                self.chords[axis].push(Chord { line, at });
            }
        }
    }

    /// Whether the place `at` is on the side of the chord where the coordinate is above its level.
    pub(super) fn is_above(&self, chord: &Chord, at: usize) -> bool {
        let [c, d] = chord.at;
        let inside = |place: usize| c < place && place < d;
        let axis = usize::from(chord.line.axis);
        (0..3)
            .filter(|&k| !chord.at.contains(&self.corner_at[k]))
            .find(|&k| inside(self.corner_at[k]) == inside(at))
            .is_some_and(|k| self.corners[k][axis] > chord.line.level * ONE)
    }

    /// Whether the coordinate of this axis at a place on the edge opposite to corner `k` is above that of the
    /// corner.
    pub(super) fn is_above_corner(&self, k: usize, axis: usize, at: usize) -> bool {
        let level = self.corners[k][axis];
        let from_here = |chord: &&Chord| chord.at.contains(&self.corner_at[k]);
        if let Some(chord) = self.chords[axis].iter().find(from_here) {
            return self.is_above(chord, at);
        }
        self.corners[(k + 1) % 3][axis] > level
    }
}

impl Chord {
    /// Whether two chords cross. Chords that start at the same corner do not.
    pub(super) fn crosses(&self, other: &Chord) -> bool {
        let [a, b] = self.at;
        let inside = |place: usize| a < place && place < b;
        let shares = self.at.iter().any(|place| other.at.contains(place));
        !shares && inside(other.at[0]) != inside(other.at[1])
    }

    /// The end of a crossing chord that lies between the ends of this chord.
    pub(super) fn between(&self, other: &Chord) -> usize {
        let [a, b] = self.at;
        let first = other.at[0];
        if a < first && first < b {
            first
        } else {
            other.at[1]
        }
    }
}
