//! A closed smooth surface of any genus: a chain of rings that have grown together.
//!
//! The connectivity is that of a plate with square holes, cut from the integer grid, so that its
//! quadrangles have only valences 3, 4 and 5. The surface is the smoothed union of tori through the
//! middle of the plate, onto which its points are projected.

use super::divide;
use super::implicit::{Implicit, relax};
use super::quads::{Quads, weld};
use crate::mesh::vector::Vec3;
use crate::mesh::{MeshError, TriangleMesh};

/// Radius of the tube; the rings have radius 1, their centres are 2 apart.
const TUBE: f64 = 0.42;
/// Width of the zone over which two rings grow together.
const BLEND: f64 = 0.15;
/// Rounds of smoothing: enough for the few rows around the points of valence 3 and 5.
const ROUNDS: usize = 20;

/// A chain of `holes` rings along the x axis.
pub(super) fn chain_of_rings(holes: usize, target: usize) -> Result<TriangleMesh, MeshError> {
    // Lengths on the surface of the top of a bar, a side of a hole, and a wall. They differ slightly,
    // so that the three counts do not all jump at once.
    let triangles = |[bar, hole, layers]: [usize; 3]| {
        let (width, depth) = ((holes + 1) * bar + holes * hole, 2 * bar + hole);
        let flat = width * depth - holes * hole * hole;
        let border = 2 * (width + depth) + 4 * holes * hole;
        2 * (2 * flat + border * layers)
    };
    let [bar, hole, layers] = divide([0.68, 0.8, 0.66], 2, target, triangles);
    let mut plate = plate(holes, bar, hole).extrude(TUBE, layers);
    for p in &mut plate.points {
        p[2] = TUBE * evened(p[2] / TUBE);
    }
    relax(&mut plate, &Rings { holes }, ROUNDS);
    plate.triangulate()
}

/// The grid of bars and holes in the plane, `bar` and `hole` divisions wide.
fn plate(holes: usize, bar: usize, hole: usize) -> Quads {
    let columns = lines(holes, bar, hole, -((holes - 1) as f64));
    let rows = lines(1, bar, hole, 0.0);
    let is_hole = |cell: usize| cell % (bar + hole) >= bar;
    let mut quads = Quads::default();
    for j in 0..rows.len() - 1 {
        for i in 0..columns.len() - 1 {
            if is_hole(i) && is_hole(j) {
                continue;
            }
            let base = quads.points.len() as u32;
            for (x, y) in [(i, j), (i + 1, j), (i + 1, j + 1), (i, j + 1)] {
                quads.points.push([columns[x], rows[y], 0.0]);
            }
            quads.quads.push([base, base + 1, base + 2, base + 3]);
        }
    }
    let (points, number) = weld(&quads.points);
    let renumber = |q: [u32; 4]| q.map(|v| number[v as usize]);
    Quads {
        points,
        quads: quads.quads.into_iter().map(renumber).collect(),
    }
}

/// Coordinates of the grid lines: bars about every ring, holes between, the first hole's centre
/// at `first`.
fn lines(holes: usize, bar: usize, hole: usize, first: f64) -> Vec<f64> {
    let mut lines = Vec::new();
    for part in 0..=2 * holes {
        let centre = first - 1.0 + part as f64;
        let (half, count) = match part % 2 {
            0 => (TUBE, bar),
            _ => (1.0 - TUBE, hole),
        };
        let step = |i: usize| centre + half * evened(2.0 * i as f64 / count as f64 - 1.0);
        lines.extend((0..count).map(step));
    }
    lines.push(first + 2.0 * holes as f64 - 1.0 + TUBE);
    lines
}

/// Where a square's side must be cut so that the cuts are even seen from its centre.
fn evened(t: f64) -> f64 {
    (std::f64::consts::FRAC_PI_4 * t).tan()
}

/// Smoothed least distance to the circles that the rings follow, minus the tube's radius.
struct Rings {
    holes: usize,
}

impl Implicit for Rings {
    /// -b log sum exp(-d_i / b) over the rings and its gradient.
    fn value_and_gradient(&self, p: Vec3) -> (f64, Vec3) {
        // Rings far away are below the last digit.
        let nearest = (p[0] + self.holes as f64).div_euclid(2.0);
        let from = (nearest - 1.0).max(0.0) as usize;
        let to = (nearest + 2.0).clamp(1.0, self.holes as f64) as usize;
        let (mut sum, mut gradient) = (0.0, [0.0; 3]);
        for ring in from.min(to - 1)..to {
            let x = p[0] - (2.0 * ring as f64 + 1.0 - self.holes as f64);
            let radius = x.hypot(p[1]).max(1e-9);
            let off = radius - 1.0;
            let distance = off.hypot(p[2]).max(1e-9);
            let weight = ((TUBE - distance) / BLEND).exp();
            let toward = off / (radius * distance);
            sum += weight;
            gradient[0] += weight * toward * x;
            gradient[1] += weight * toward * p[1];
            gradient[2] += weight * p[2] / distance;
        }
        (-BLEND * sum.ln(), gradient.map(|g| g / sum))
    }
}
