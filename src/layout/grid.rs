//! The map of a layout: every rectangle has a chart, in which it covers as many unit squares as it gets quads.
//!
//! The map starts as a convex combination map of each rectangle (`tutte1963`, `floater1997`), whose boundary is fixed in
//! proportion to length: it has no folds. Then curves are free to slide on the surface: a vertex of a curve has a copy in
//! the chart on each side, and the copies move together. What is held are irregular vertices, corners, vertices of the
//! layout unless they may slide, and curves that are given slide only along themselves.

use std::collections::HashMap;

use super::embed::reached;
use super::embed::surface::{NONE, previous};
use super::rectangles::Rectangles;
use crate::error::Result;
use crate::linalg::{Cholesky, Sparse};
use crate::mesh::vector::{cotangent, scale, sub};
use crate::mesh::{orientation, turned};
use crate::monitor::{Monitor, may_continue_at};
use crate::untangle::Patchwork;

/// The least weight of an edge in a convex combination.
const LEAST_WEIGHT: f64 = 0.02;

/// A map of all rectangles.
pub(super) struct Grid {
    /// The rectangle of each face.
    pub rectangle: Vec<u32>,
    /// The copies at the corners of each face.
    copies: Vec<[u32; 3]>,
    /// The coordinates of each copy.
    values: Vec<f64>,
}

/// Which vertices may move, and how.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Motion {
    Held,
    /// Along the curve through it.
    Along,
    Free,
}

impl Grid {
    /// The convex combination maps of all rectangles.
    pub fn new(all: &Rectangles) -> Result<Self> {
        let faces = all.surface.triangles.len();
        let mut grid = Grid {
            rectangle: vec![NONE; faces],
            copies: vec![[0; 3]; faces],
            values: Vec::new(),
        };
        for number in 0..all.rectangles.len() {
            may_continue_at(number)?;
            grid.add(all, number)?;
        }
        Ok(grid)
    }

    fn add(&mut self, all: &Rectangles, number: usize) -> Result<()> {
        let surface = &all.surface;
        let mut first = self.values.len() as u32 / 2;
        let mut copy_of: HashMap<u32, u32> = HashMap::new();
        let sides = all.rectangles[number].sides;
        let mut corner = [0.0; 2];
        let mut seed = 0;
        for (k, side) in sides.iter().enumerate() {
            let way = [[1.0, 0.0], [0.0, 1.0], [-1.0, 0.0], [0.0, -1.0]][k];
            let vertices = all.vertices(side);
            if k == 0 {
                let half = surface.half_between(vertices[0].0, vertices[1].0);
                seed = half.unwrap_or(0);
            }
            for &(v, place) in &vertices[..vertices.len() - 1] {
                copy_of.insert(v, first);
                first += 1;
                self.values
                    .extend([0, 1].map(|axis| corner[axis] + place * way[axis]));
            }
            corner = [0, 1].map(|axis| corner[axis] + f64::from(side.edges) * way[axis]);
        }
        let fixed = copy_of.len();
        let start = self.values.len() / 2 - fixed;
        let faces = reached(surface, seed);
        for &face in &faces {
            self.rectangle[face as usize] = number as u32;
            self.copies[face as usize] = surface.triangles[face as usize].map(|v| {
                *copy_of.entry(v).or_insert_with(|| {
                    self.values.extend([0.0; 2]);
                    first += 1;
                    first - 1
                })
            });
        }
        self.solve(all, &faces, start, fixed)
    }

    /// Places the copies from `start` on, of which the first `fixed` are placed already.
    fn solve(&mut self, all: &Rectangles, faces: &[u32], start: usize, fixed: usize) -> Result<()> {
        let count = self.values.len() / 2 - start;
        let dim = count - fixed;
        if dim == 0 {
            return Ok(());
        }
        let mut weights: HashMap<[u32; 2], f64> = HashMap::new();
        for &face in faces {
            let corners = all.surface.corners(face);
            for k in 0..3 {
                let [a, b, c] =
                    [k, (k + 1) % 3, (k + 2) % 3].map(|k| self.copies[face as usize][k]);
                let [to_a, to_b] = [k, (k + 1) % 3].map(|i| sub(corners[i], corners[(k + 2) % 3]));
                let half = 0.5 * cotangent(to_a, to_b);
                debug_assert!(c != a);
                *weights.entry([a.min(b), a.max(b)]).or_default() += half;
            }
        }
        let mut entries: Vec<(u32, u32, f64)> = Vec::with_capacity(2 * weights.len());
        let mut sides = [vec![0.0; dim], vec![0.0; dim]];
        let place = |copy: u32| (copy as usize - start).checked_sub(fixed);
        let mut weights: Vec<([u32; 2], f64)> = weights.into_iter().collect();
        weights.sort_unstable_by_key(|&(ends, _)| ends);
        for ([a, b], weight) in weights {
            let weight = match weight.is_finite() {
                true => weight.clamp(LEAST_WEIGHT, 1.0 / LEAST_WEIGHT),
                false => LEAST_WEIGHT,
            };
            for (own, other) in [(a, b), (b, a)] {
                let Some(i) = place(own) else { continue };
                entries.push((i as u32, i as u32, weight));
                match place(other) {
                    Some(j) if j < i => entries.push((i as u32, j as u32, -weight)),
                    Some(_) => {}
                    None => {
                        for (axis, side) in sides.iter_mut().enumerate() {
                            side[i] += weight * self.values[2 * other as usize + axis];
                        }
                    }
                }
            }
        }
        let factor = Cholesky::new(&Sparse::from_triplets(dim, dim, entries.iter().copied())?)?;
        for (axis, side) in sides.iter_mut().enumerate() {
            factor.solve(side)?;
            for (i, &x) in side.iter().enumerate() {
                self.values[2 * (start + fixed + i) + axis] = x;
            }
        }
        Ok(())
    }

    /// The coordinates of the corners of a face.
    pub fn uv(&self, face: usize) -> [[f64; 2]; 3] {
        self.copies[face].map(|c| [self.values[2 * c as usize], self.values[2 * c as usize + 1]])
    }

    /// Faces that the map turns over or collapses.
    pub fn folded(&self) -> usize {
        (0..self.copies.len())
            .filter(|&f| orientation(self.uv(f)) <= 0.0)
            .count()
    }

    /// Lets curves slide until the map is smooth. Edges of quads are about `edge` long.
    pub fn relax(
        &mut self,
        all: &Rectangles,
        motion: &[Motion],
        edge: f64,
        monitor: &mut Monitor,
    ) -> Result<()> {
        let surface = &all.surface;
        let mut entries = Vec::new();
        let mut unknowns = 0;
        for v in 0..surface.positions.len() as u32 {
            unknowns += self.link(all, v, motion[v as usize], unknowns, &mut entries);
        }
        let moves = Sparse::from_triplets(
            self.values.len(),
            unknowns as usize,
            entries.iter().copied(),
        )?;
        let faces = 0..surface.triangles.len() as u32;
        let corners: Vec<_> = faces
            .map(|f| surface.corners(f).map(|p| scale(p, 1.0 / edge)))
            .collect();
        let patchwork = Patchwork::new(
            surface.triangles.clone(),
            self.copies.clone(),
            moves,
            &corners,
        );
        patchwork.relax(&mut self.values, monitor)?;
        Ok(())
    }

    /// Links the copies of a vertex to its own unknowns, the first of which is `first`, and gives their number.
    fn link(
        &self,
        all: &Rectangles,
        v: u32,
        motion: Motion,
        first: u32,
        entries: &mut Vec<(u32, u32, f64)>,
    ) -> u32 {
        if motion == Motion::Held {
            return 0;
        }
        let surface = &all.surface;
        let fan: Vec<u32> = surface.around(v).collect();
        let mut turn = 0;
        let mut seen: Vec<u32> = Vec::new();
        let along = (motion == Motion::Along)
            .then(|| self.way_of_curve(all, &fan))
            .flatten();
        for (k, &half) in fan.iter().enumerate() {
            let copy = self.copies[half as usize / 3][half as usize % 3];
            if !seen.contains(&copy) {
                seen.push(copy);
                let ways: &[[f64; 2]] = match &along {
                    Some(way) => std::slice::from_ref(way),
                    None => &[[1.0, 0.0], [0.0, 1.0]],
                };
                for (unknown, &way) in (first..).zip(ways) {
                    let turned = turned(turn, way);
                    for (axis, x) in (0..).zip(turned) {
                        if x != 0.0 {
                            entries.push((2 * copy + axis, unknown, x));
                        }
                    }
                }
            }
            let back = previous(half);
            if k + 1 < fan.len() && surface.dart[back as usize] != NONE {
                turn = (turn + self.quarters(surface.twin[back as usize], back)) % 4;
            }
        }
        if along.is_some() { 1 } else { 2 }
    }

    /// The direction, in the chart of the first face of a fan, of the curve that runs through its middle.
    fn way_of_curve(&self, all: &Rectangles, fan: &[u32]) -> Option<[f64; 2]> {
        let is_curve = |&half: &u32| all.surface.dart[half as usize] != NONE;
        let way = match fan.iter().position(is_curve)? {
            0 => self.step(fan[0]),
            k => self.step(previous(fan[k - 1])),
        };
        Some(match way[0].abs() > way[1].abs() {
            true => [1.0, 0.0],
            false => [0.0, 1.0],
        })
    }

    /// From the beginning of a half-edge to its end, in the chart of its face.
    fn step(&self, half: u32) -> [f64; 2] {
        let (face, k) = (half as usize / 3, half as usize % 3);
        let uv = self.uv(face);
        [0, 1].map(|axis| uv[(k + 1) % 3][axis] - uv[k][axis])
    }

    /// Quarter turns from the chart on one side of an edge to that on the other: of half-edge `back`, and of its
    /// opposite.
    fn quarters(&self, opposite: u32, back: u32) -> u8 {
        let [ax, ay] = self.step(back);
        let [bx, by] = self.step(opposite).map(|x| -x);
        let angle = (ax * by - ay * bx).atan2(ax * bx + ay * by);
        (angle / std::f64::consts::FRAC_PI_2)
            .round()
            .rem_euclid(4.0) as u8
    }
}
