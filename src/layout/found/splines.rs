//! Each patch as a bicubic B-spline surface, the sides shared by neighbours.
//!
//! Arcs are fitted first, as curves, and each patch between its four curves, so that neighbours meet. Arcs on
//! opposite sides of a patch have the same knots; all that are tied to each other in this way are a class. Where a
//! patch or an arc is farther from its vertices than the tolerance, the classes of its sides get twice the spans.

use super::spline::{self, DEGREE, Fit};
use super::{FoundLayout, LayoutPatch, QuadSurface};
use crate::error::{Error, Result};
use crate::linalg::DisjointSets;
use crate::mesh::vector::{Vec3, norm, sub};

/// Patches of a layout as bicubic B-spline surfaces over [0, 1] x [0, 1].
#[derive(Debug, Clone, PartialEq)]
pub struct SplinePatches {
    /// Control points of all patches. Those on a common side are the same.
    pub points: Vec<Vec3>,
    /// The surfaces, in the order of the patches.
    pub surfaces: Vec<SplineSurface>,
    /// The largest distance between a vertex of the quads and the surface at its parameters.
    pub deviation: f64,
    /// Whether this is within the tolerance.
    pub is_within: bool,
}

/// A bicubic B-spline surface with uniform, clamped knots.
#[derive(Debug, Clone, PartialEq)]
pub struct SplineSurface {
    /// The number of intervals of the knots along the first side, and along the second.
    pub spans: [usize; 2],
    /// Its `spans[0] + 3` times `spans[1] + 3` control points by number, in rows along the first side.
    pub control: Vec<u32>,
}

impl SplineSurface {
    /// The knots in both directions.
    pub fn knots(&self) -> [Vec<f64>; 2] {
        self.spans.map(spline::knots)
    }
}

impl SplinePatches {
    /// Fits the patches of a layout to the vertices of its quads.
    ///
    /// # Errors
    /// [`Error::InvalidArgument`] for a tolerance that is not above zero, and [`Error::NotSupported`] with the patch
    /// for a layout with T-junctions.
    pub fn fit(surface: &QuadSurface, layout: &FoundLayout, tolerance: f64) -> Result<Self> {
        if tolerance.is_nan() || tolerance <= 0.0 {
            return Err(Error::InvalidArgument {
                what: format!("the tolerance is {tolerance}; it must be above zero"),
                index: None,
            });
        }
        let whole = |patch: &LayoutPatch| patch.sides.iter().all(|side| side.len() == 1);
        if let Some(patch) = layout.patches.iter().position(|patch| !whole(patch)) {
            return Err(Error::NotSupported {
                what: format!(
                    "surfaces of a layout with T-junctions: patch {patch} has one on a side"
                ),
                index: Some(patch),
                line: None,
            });
        }
        let mut fitting = Fitting::new(surface, layout);
        loop {
            let (found, missed) = fitting.all(tolerance);
            let grown = missed
                .into_iter()
                .filter(|&class| fitting.refine(class))
                .count();
            if found.is_within || grown == 0 {
                return Ok(found);
            }
        }
    }
}

/// The state of the fits.
struct Fitting<'a> {
    surface: &'a QuadSurface,
    layout: &'a FoundLayout,
    /// The class of every arc.
    class: Vec<usize>,
    /// The steps of the arcs of every class, and its spans.
    steps: Vec<usize>,
    spans: Vec<usize>,
}

impl<'a> Fitting<'a> {
    fn new(surface: &'a QuadSurface, layout: &'a FoundLayout) -> Self {
        let mut sets = DisjointSets::new(layout.arcs.len());
        for patch in &layout.patches {
            for k in 0..2 {
                sets.join(patch.sides[k][0] as usize, patch.sides[k + 2][0] as usize);
            }
        }
        Fitting {
            surface,
            layout,
            class: (0..layout.arcs.len()).map(|arc| sets.root(arc)).collect(),
            steps: layout
                .arcs
                .iter()
                .map(|arc| arc.vertices.len() - 1)
                .collect(),
            spans: vec![1; layout.arcs.len()],
        }
    }

    /// Doubles the spans of a class. More than there are steps between vertices are of no use.
    fn refine(&mut self, class: usize) -> bool {
        let spans = (2 * self.spans[class]).min(self.steps[class]);
        let is_finer = spans > self.spans[class];
        self.spans[class] = spans;
        is_finer
    }

    fn fit(&self, class: usize) -> Fit {
        Fit::new(self.steps[class], self.spans[class])
    }

    fn position(&self, v: u32) -> Vec3 {
        self.surface.positions()[v as usize]
    }

    /// All patches, and the classes that need more spans, in increasing order.
    fn all(&self, tolerance: f64) -> (SplinePatches, Vec<usize>) {
        let mut found = SplinePatches {
            points: self
                .layout
                .nodes
                .iter()
                .map(|&v| self.position(v))
                .collect(),
            surfaces: Vec::new(),
            deviation: 0.0,
            is_within: true,
        };
        let mut missed = Vec::new();
        let curves: Vec<Vec<u32>> = (0..self.layout.arcs.len())
            .map(|arc| {
                let (curve, off) = self.curve(arc, &mut found.points);
                found.deviation = found.deviation.max(off);
                if off > tolerance {
                    missed.push(self.class[arc]);
                }
                curve
            })
            .collect();
        for patch in &self.layout.patches {
            let (surface, off) = self.patch(patch, &curves, &mut found.points);
            found.surfaces.push(surface);
            found.deviation = found.deviation.max(off);
            if off > tolerance {
                missed.extend([0, 1].map(|k| self.class[patch.sides[k][0] as usize]));
            }
        }
        found.is_within = missed.is_empty();
        missed.sort_unstable();
        missed.dedup();
        (found, missed)
    }

    /// The control points of an arc by number, new ones after those of the nodes, and its distance from its vertices.
    fn curve(&self, arc: usize, points: &mut Vec<Vec3>) -> (Vec<u32>, f64) {
        let fit = self.fit(self.class[arc]);
        let arc = &self.layout.arcs[arc];
        let given: Vec<Vec3> = arc.vertices.iter().map(|&v| self.position(v)).collect();
        let control = fit.control(&given, [given[0], given[given.len() - 1]]);
        let distance = |(i, &p): (usize, &Vec3)| norm(sub(fit.point(&control, i), p));
        let off = given.iter().enumerate().map(distance).fold(0.0, f64::max);
        let inner = &control[1..control.len() - 1];
        let first = points.len() as u32;
        points.extend(inner);
        let mut numbers = vec![arc.nodes[0]];
        numbers.extend((0..inner.len() as u32).map(|i| first + i));
        numbers.push(arc.nodes[1]);
        (numbers, off)
    }

    /// The surface of a patch between its curves, and its distance from its vertices.
    ///
    /// Rows of vertices are fitted along the first side, between the curves of the other two, and the columns of the
    /// result between the curves of the first and third.
    fn patch(
        &self,
        patch: &LayoutPatch,
        curves: &[Vec<u32>],
        points: &mut Vec<Vec3>,
    ) -> (SplineSurface, f64) {
        let [m, n] = patch.size;
        let fits = [0, 1].map(|k| self.fit(self.class[patch.sides[k][0] as usize]));
        let sides = [0, 1, 2, 3].map(|k| self.side(patch, k, curves));
        let (columns, rows) = (sides[0].len(), sides[1].len());
        let at = |points: &[Vec3], numbers: &[u32], i: usize| points[numbers[i] as usize];
        let along = |points: &[Vec3], fit: &Fit, numbers: &[u32], step: usize| {
            let control: Vec<Vec3> = (0..numbers.len()).map(|i| at(points, numbers, i)).collect();
            fit.point(&control, step)
        };
        // The third and fourth side run backwards.
        let backwards = |numbers: &[u32]| numbers.iter().rev().copied().collect::<Vec<_>>();
        let [bottom, right] = [sides[0].clone(), sides[1].clone()];
        let [top, left] = [backwards(&sides[2]), backwards(&sides[3])];
        let half: Vec<Vec<Vec3>> = (0..=n)
            .map(|j| {
                let row: Vec<Vec3> = (0..=m).map(|i| self.position(patch.vertex(i, j))).collect();
                let ends = [&left, &right].map(|side| along(points, &fits[1], side, j));
                fits[0].control(&row, ends)
            })
            .collect();
        let mut control = vec![0u32; columns * rows];
        for i in 0..columns {
            control[i] = bottom[i];
            control[(rows - 1) * columns + i] = top[i];
        }
        for j in 0..rows {
            control[j * columns] = left[j];
            control[j * columns + columns - 1] = right[j];
        }
        for i in 1..columns - 1 {
            let column: Vec<Vec3> = half.iter().map(|row| row[i]).collect();
            let ends = [at(points, &bottom, i), at(points, &top, i)];
            let fitted = fits[1].control(&column, ends);
            for j in 1..rows - 1 {
                control[j * columns + i] = points.len() as u32;
                points.push(fitted[j]);
            }
        }
        let mut off = 0.0_f64;
        for j in 0..=n {
            let row: Vec<Vec3> = (0..columns)
                .map(|i| {
                    let column: Vec<u32> = (0..rows).map(|j| control[j * columns + i]).collect();
                    along(points, &fits[1], &column, j)
                })
                .collect();
            for i in 0..=m {
                let given = self.position(patch.vertex(i, j));
                off = off.max(norm(sub(fits[0].point(&row, i), given)));
            }
        }
        let spans = [columns - DEGREE, rows - DEGREE];
        (SplineSurface { spans, control }, off)
    }

    /// The control points of a side, counter-clockwise around the patch.
    fn side(&self, patch: &LayoutPatch, k: usize, curves: &[Vec<u32>]) -> Vec<u32> {
        let arc = patch.sides[k][0] as usize;
        let mut side = curves[arc].clone();
        if !patch.runs_along(k, &self.layout.arcs[arc].vertices) {
            side.reverse();
        }
        side
    }
}
