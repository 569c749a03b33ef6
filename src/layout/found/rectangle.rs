//! Rectangles of quads between walls.

use super::walls::Walls;

const NONE: u32 = u32::MAX;

/// A rectangle of quads.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) struct Rectangle {
    /// The number of quads along the first side, and along the second.
    pub(super) size: [usize; 2],
    /// The half-edges along each side, counter-clockwise around the rectangle.
    pub(super) sides: [Vec<u32>; 4],
    /// For every quad, the half-edge on the side of the first one; rows along the first side.
    pub(super) bottoms: Vec<u32>,
}

impl Rectangle {
    /// All rectangles between walls, by their lowest corner, and the rectangle of every quad; none where a region
    /// has no corners.
    pub(super) fn all(walls: &Walls) -> (Vec<Rectangle>, Vec<u32>) {
        let faces = walls.surface.quads().len();
        let mut rectangle_of = vec![NONE; faces];
        let mut found = Vec::new();
        for h in 0..4 * faces {
            let is_corner = walls.contains(h) && walls.contains(walls.surface.before(h));
            if !is_corner || rectangle_of[h / 4] != NONE {
                continue;
            }
            let rectangle = Rectangle::at(walls, h);
            for &bottom in &rectangle.bottoms {
                rectangle_of[bottom as usize / 4] = found.len() as u32;
            }
            found.push(rectangle);
        }
        (found, rectangle_of)
    }

    /// The rectangle whose first side begins with a half-edge.
    fn at(walls: &Walls, corner: usize) -> Rectangle {
        let surface = walls.surface;
        let right = |h: usize| surface.next(h);
        let left = |h: usize| surface.before(h);
        let top = |h: usize| surface.next(surface.next(h));
        let mut bottoms: Vec<u32> = Vec::new();
        let mut columns = 0;
        let mut row = corner;
        loop {
            let mut h = row;
            bottoms.push(h as u32);
            while !walls.contains(right(h)) {
                h = surface.next(surface.twin(right(h)));
                bottoms.push(h as u32);
            }
            if columns == 0 {
                columns = bottoms.len();
            }
            if walls.contains(top(row)) {
                break;
            }
            row = surface.twin(top(row));
        }
        let rows = bottoms.len() / columns;
        let of = |i: usize, j: usize| bottoms[j * columns + i] as usize;
        let sides = [
            (0..columns).map(|i| of(i, 0) as u32).collect(),
            (0..rows)
                .map(|j| right(of(columns - 1, j)) as u32)
                .collect(),
            (0..columns)
                .rev()
                .map(|i| top(of(i, rows - 1)) as u32)
                .collect(),
            (0..rows).rev().map(|j| left(of(0, j)) as u32).collect(),
        ];
        debug_assert_eq!(bottoms.len(), rows * columns);
        Rectangle {
            size: [columns, rows],
            sides,
            bottoms,
        }
    }
}
