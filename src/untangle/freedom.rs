//! The degrees of freedom that remain when the integers of a map are fixed.
//!
//! The constraints of the parametrization are eliminated with every integer unknown pinned. This leaves
//! `x = T y + t` with `y` free and continuous. Only `T` is needed, because Newton steps start from a
//! solution: if x satisfies the constraints, so does `x + T dy`.

use std::ops::Range;

use crate::eliminate::eliminate;
use crate::error::Result;
use crate::linalg::Sparse;
use crate::map::SeamlessProblem;
use crate::map::constraints_of;
use crate::monitor::Monitor;
use crate::problem::Model;

/// The coordinates and the faces that each free unknown moves.
pub(super) struct Freedom {
    /// `T`: one row a coordinate (u of copy c is 2 c, v is 2 c + 1).
    pub moves: Sparse,
    /// The transpose: one row a free unknown.
    pub moved: Sparse,
    /// The first entry of `faces` of each copy, and their number.
    start: Vec<u32>,
    faces: Vec<u32>,
    /// Copies at the corners of every face.
    pub copies: Vec<[u32; 3]>,
}

impl Freedom {
    /// The freedom of the map with these values of the problem's unknowns.
    ///
    /// # Errors [`Infeasible`](crate::Error::Infeasible) for integers that contradict the constraints,
    /// and the errors by which `monitor` ends the work.
    pub fn new(
        map: &SeamlessProblem,
        copies: &[[u32; 3]],
        values: &[f64],
        monitor: &mut Monitor,
    ) -> Result<Self> {
        let stated = map.problem();
        let mut held = constraints_of(stated)?;
        for (i, &value) in values.iter().enumerate() {
            if let Some(pin) = stated.pins()[i] {
                held.pin(i, pin)?;
            } else if stated.integers()[i] {
                held.pin(i, value.round())?;
            }
        }
        let reduced = eliminate(&Model::new(&held)?, monitor)?;
        let all = reduced.expansion().matrix();
        let count = copies.iter().flatten().max().map_or(0, |&c| c as usize + 1);
        let coordinates = all.entries().filter(|&(i, _, _)| (i as usize) < 2 * count);
        let moves = Sparse::from_triplets(2 * count, all.cols(), coordinates)?;
        Ok(Self::of_moves(moves, copies.to_vec()))
    }

    /// The freedom of copies whose coordinates these unknowns move.
    pub fn of_moves(moves: Sparse, copies: Vec<[u32; 3]>) -> Self {
        let (start, faces) = faces_around(&copies, moves.rows() / 2);
        Freedom {
            moved: moves.transpose(),
            moves,
            start,
            faces,
            copies,
        }
    }

    /// The corners of a face, with these values of all coordinates.
    pub fn uv(&self, values: &[f64], face: usize) -> [[f64; 2]; 3] {
        self.copies[face].map(|c| [values[2 * c as usize], values[2 * c as usize + 1]])
    }

    /// Number of free unknowns.
    pub fn dim(&self) -> usize {
        self.moved.rows()
    }

    /// The free unknowns that move a face; some are repeated.
    pub fn of_face(&self, face: usize) -> impl Iterator<Item = usize> + '_ {
        let copies = self.copies[face].iter();
        let coordinates = copies.flat_map(|&c| [2 * c as usize, 2 * c as usize + 1]);
        coordinates.flat_map(|i| self.moves.row(i).map(|(y, _)| y))
    }

    /// The faces that a free unknown moves; some are repeated.
    pub fn faces_of(&self, unknown: usize) -> impl Iterator<Item = usize> + '_ {
        let copies = self.moved.row(unknown).map(|(i, _)| i / 2);
        copies.flat_map(|c| self.around(c))
    }

    /// The faces around a copy.
    fn around(&self, copy: usize) -> impl Iterator<Item = usize> + '_ {
        let range = self.start[copy] as usize..self.start[copy + 1] as usize;
        self.faces[range].iter().map(|&f| f as usize)
    }

    /// The two free unknowns that move the copies of one vertex and no other vertex; `None` if their
    /// number is not two.
    pub fn of_copies(&self, copies: Range<u32>) -> Option<[usize; 2]> {
        let rows = 2 * copies.start as usize..2 * copies.end as usize;
        let mut unknowns: Vec<usize> = rows
            .clone()
            .flat_map(|i| self.moves.row(i).map(|(y, _)| y))
            .collect();
        unknowns.sort_unstable();
        unknowns.dedup();
        let is_own = |&y: &usize| self.moved.row(y).all(|(i, _)| rows.contains(&i));
        let unknowns: [usize; 2] = unknowns.try_into().ok()?;
        unknowns.iter().all(is_own).then_some(unknowns)
    }

    /// Moves a copy of a vertex to a point by its free unknowns, and the other copies with it.
    pub fn put(&self, copy: u32, [p, q]: [usize; 2], to: [f64; 2], x: &mut [f64]) {
        let entry = |row: usize, y: usize| {
            let of = self.moves.row(row).find(|&(z, _)| z == y);
            of.map_or(0.0, |(_, v)| v)
        };
        let rows = [2 * copy as usize, 2 * copy as usize + 1];
        let by = [0, 1].map(|axis| to[axis] - x[rows[axis]]);
        let [[a, b], [c, d]] = rows.map(|row| [entry(row, p), entry(row, q)]);
        let determinant = a * d - b * c;
        let steps = [
            (p, (d * by[0] - b * by[1]) / determinant),
            (q, (a * by[1] - c * by[0]) / determinant),
        ];
        for (y, step) in steps {
            for (i, v) in self.moved.row(y) {
                x[i] += v * step;
            }
        }
    }

    /// Which coordinates of every copy cannot move.
    pub fn held(&self) -> Vec<[bool; 2]> {
        let is_held = |coordinate: usize| self.moves.row(coordinate).len() == 0;
        let copies = 0..self.moves.rows() / 2;
        copies
            .map(|c| [is_held(2 * c), is_held(2 * c + 1)])
            .collect()
    }

    /// Whether neither coordinate of a copy can move.
    pub fn is_held(&self, copy: u32) -> bool {
        let u = 2 * copy as usize;
        self.moves.row(u).len() == 0 && self.moves.row(u + 1).len() == 0
    }
}

fn faces_around(copies: &[[u32; 3]], count: usize) -> (Vec<u32>, Vec<u32>) {
    let mut start = vec![0u32; count + 1];
    for &copy in copies.iter().flatten() {
        start[copy as usize + 1] += 1;
    }
    for c in 0..count {
        start[c + 1] += start[c];
    }
    let mut next = start.clone();
    let mut faces = vec![0; 3 * copies.len()];
    for (face, corners) in copies.iter().enumerate() {
        for &copy in corners {
            faces[next[copy as usize] as usize] = face as u32;
            next[copy as usize] += 1;
        }
    }
    (start, faces)
}
