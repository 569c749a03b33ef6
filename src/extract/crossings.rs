//! The crossings of integer lines with edges, in order along each edge.
//!
//! One comparison of exact products decides the order of a crossing with `u = i` and one with `v = j` on an
//! edge. In a tie, at an integer point on the edge, `u` comes first, as seen from the side that owns the
//! edge. Both faces see the same order, which suffices for consistency.

use std::cmp::Ordering;

use super::grid_map::ONE;
use super::refined::{NONE, Refined, next};
use crate::error::{Error, Result};
use crate::mesh::turned;
use crate::monitor::may_continue_at;

/// An integer line through an edge, in the coordinates of one of its faces.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct Line {
    /// 0 for `u = level`, 1 for `v = level`.
    pub(super) axis: u8,
    /// The level, as a count of [`ONE`]s.
    pub(super) level: i64,
}

/// The crossings of all edges, one list for each edge. The lower half-edge owns the list.
pub(super) struct Crossings {
    /// For every half-edge, the start of the list of its edge.
    start: Vec<u32>,
    count: Vec<u32>,
    lines: Vec<Line>,
}

impl Crossings {
    pub(super) fn new(mesh: &Refined) -> Result<Self> {
        let halves = mesh.twin.len();
        let mut crossings = Crossings {
            start: vec![0; halves],
            count: vec![0; halves],
            lines: Vec::new(),
        };
        check_size(mesh)?;
        for h in 0..halves {
            may_continue_at(h)?;
            let g = mesh.twin[h];
            if g != NONE && (g as usize) < h {
                continue;
            }
            let start = crossings.lines.len() as u32;
            along(mesh.start(h), mesh.start(next(h)), &mut crossings.lines);
            let count = crossings.lines.len() as u32 - start;
            for side in [h, g as usize].into_iter().filter(|&side| side < halves) {
                crossings.start[side] = start;
                crossings.count[side] = count;
            }
        }
        Ok(crossings)
    }

    pub(super) fn len(&self) -> usize {
        self.lines.len()
    }

    /// The crossings of a half-edge in its direction: number, and line in its face.
    pub(super) fn of<'a>(
        &'a self,
        mesh: &'a Refined,
        h: usize,
    ) -> impl Iterator<Item = (u32, Line)> + 'a {
        let g = mesh.twin[h];
        let is_owner = g == NONE || h < g as usize;
        let (start, count) = (self.start[h], self.count[h]);
        let (quarters, shift) = match is_owner || count == 0 {
            true => (0, [0; 2]),
            false => (mesh.turn[g as usize], mesh.shift(g as usize)),
        };
        (0..count).map(move |i| {
            let c = if is_owner {
                start + i
            } else {
                start + count - 1 - i
            };
            let line = self.lines[c as usize];
            (
                c,
                if is_owner {
                    line
                } else {
                    line.carried(quarters, shift)
                },
            )
        })
    }
}

impl Line {
    /// The same line after a transition.
    fn carried(self, quarters: u8, shift: [i64; 2]) -> Line {
        let axis = self.axis ^ (quarters & 1);
        let mut point = [0; 2];
        point[usize::from(self.axis)] = self.level;
        let level = turned(quarters, point)[usize::from(axis)];
        Line {
            axis,
            level: shift[usize::from(axis)] / ONE + level,
        }
    }
}

/// Rejects maps with more crossings than there are 32-bit numbers.
fn check_size(mesh: &Refined) -> Result<()> {
    let most = i128::from(1u32 << 24);
    let mut total = 0i128;
    for (face, [a, b, c]) in mesh.corners.iter().enumerate() {
        let span = |axis: usize| {
            let x = [a[axis], b[axis], c[axis]];
            let [low, high] = x
                .iter()
                .fold([i64::MAX, i64::MIN], |[l, h], &x| [l.min(x), h.max(x)]);
            i128::from(high / ONE - low / ONE)
        };
        let (u, v) = (span(0), span(1));
        total += u + v + u * v;
        if total > most {
            return Err(Error::Overflow {
                what: format!("up to face {face} the map has more than {most} integer points"),
                index: Some(face),
            });
        }
    }
    Ok(())
}

/// Appends the lines that cross the segment from `p` to `q`, in order.
fn along(p: [i64; 2], q: [i64; 2], out: &mut Vec<Line>) {
    let mut levels = [0, 1].map(|axis| between(p[axis], q[axis]).peekable());
    loop {
        let [u, v] = &mut levels;
        let axis = match (u.peek(), v.peek()) {
            (None, None) => return,
            (Some(_), None) => 0,
            (None, Some(_)) => 1,
            (Some(&i), Some(&j)) => match compare(p, q, i, j) {
                Ordering::Greater => 1,
                _ => 0,
            },
        };
        out.extend(levels[axis].next().map(|level| Line {
            axis: axis as u8,
            level,
        }));
    }
}

/// Whole numbers strictly between two coordinates, from the first towards the second.
fn between(from: i64, to: i64) -> impl Iterator<Item = i64> {
    let (low, high) = (
        from.min(to).div_euclid(ONE) + 1,
        -(-from.max(to)).div_euclid(ONE) - 1,
    );
    let count = (high - low + 1).max(0);
    let is_rising = from < to;
    (0..count).map(move |i| if is_rising { low + i } else { high - i })
}

/// Compares the crossings with `u = i` and with `v = j` by their order on the way from `p` to `q`.
fn compare(p: [i64; 2], q: [i64; 2], i: i64, j: i64) -> Ordering {
    let wide = |x: i64| i128::from(x);
    let reach = [i, j].map(|level| level * ONE);
    let part = [0, 1].map(|axis| wide((reach[axis] - p[axis]).abs()));
    let whole = [0, 1].map(|axis| wide((q[axis] - p[axis]).abs()));
    (part[0] * whole[1]).cmp(&(part[1] * whole[0]))
}
