//! The smallest orientation field: a smooth cross field on a coarse torus.
//!
//! The unknowns are one angle for each face and one period jump for each dual edge. The energy is
//! E = sum (theta_i + kappa_ij + pi/2 p_ij - theta_j)^2 (`bommes2009`, section 4).
//! Jumps on a spanning forest of the dual graph are zero without loss of generality. One angle is
//! constrained, since only differences count.
//!
//! ```text
//! cargo run --release --example torus_field [OUT.mps]
//! ```
//!
//! With a file name, the problem is also written to that file. `examples/torus_field.mps` was made so.

use std::collections::BTreeMap;
use std::error::Error;
use std::f64::consts::{FRAC_PI_2, PI, TAU};
use std::path::Path;

use roundel::problem::files::NamedProblem;
use roundel::problem::mps;
use roundel::{Options, Problem, Strategy};

/// The numbers of vertices around the hole and around the tube. They give 24 triangles.
const AROUND: [usize; 2] = [4, 3];
/// The radius of the circle along which the centre of the tube runs, and the radius of the tube.
const RADII: [f64; 2] = [2.0, 1.0];

type Point = [f64; 3];

/// An edge that the faces `i` and `j` share.
struct DualEdge {
    i: usize,
    j: usize,
    /// The angle of frame i's axis in frame j, in (-pi, pi].
    kappa: f64,
}

fn main() -> Result<(), Box<dyn Error>> {
    let (points, faces) = torus();
    let edges = dual_edges(&points, &faces);
    let cut = off_a_spanning_tree(faces.len(), &edges);
    let jumps = cut.iter().filter(|&&c| c).count();

    let mut problem = Problem::new(faces.len() + jumps)?;
    let mut names: Vec<String> = (0..faces.len()).map(|i| format!("theta{i}")).collect();
    for (DualEdge { i, j, kappa }, cut) in edges.iter().zip(cut) {
        if cut {
            let jump = names.len();
            names.push(format!("p{i}_{j}"));
            problem.set_integers(&[jump])?;
            problem.add_least_squares(&[*i, *j, jump], &[1.0, -1.0, FRAC_PI_2], -kappa, 1.0)?;
        } else {
            problem.add_least_squares(&[*i, *j], &[1.0, -1.0], -kappa, 1.0)?;
        }
    }
    problem.add_constraint(&[0], &[1.0], 0.0)?;

    if let Some(out) = std::env::args().nth(1) {
        let rows = vec!["first_angle".into()];
        let copy = problem.clone();
        let named = NamedProblem::with_names(copy, "torus_field", "energy", names, rows, vec![])?;
        mps::write(Path::new(&out), &named)?;
    }
    for strategy in Strategy::ALL {
        let options = Options {
            strategy,
            ..Options::default()
        };
        let solution = roundel::solve(&problem, &options)?;
        println!("{:<8} energy {:.6}", strategy.name(), solution.energy());
    }
    Ok(())
}

/// A grid of quads, each split into two triangles, all counter-clockwise seen from outside.
fn torus() -> (Vec<Point>, Vec<[usize; 3]>) {
    let [m, n] = AROUND;
    let mut points = Vec::new();
    let mut faces = Vec::new();
    for a in 0..m {
        for b in 0..n {
            let u = TAU * a as f64 / m as f64;
            let v = TAU * b as f64 / n as f64;
            let r = RADII[0] + RADII[1] * v.cos();
            points.push([r * u.cos(), r * u.sin(), RADII[1] * v.sin()]);
            let at = |a: usize, b: usize| (a % m) * n + b % n;
            let [p, q, r, s] = [at(a, b), at(a + 1, b), at(a + 1, b + 1), at(a, b + 1)];
            faces.extend([[p, q, r], [p, r, s]]);
        }
    }
    (points, faces)
}

/// The dual edges in the order of their vertices, each with the angle between its two frames.
fn dual_edges(points: &[Point], faces: &[[usize; 3]]) -> Vec<DualEdge> {
    let mut sides: BTreeMap<[usize; 2], Vec<(usize, f64)>> = BTreeMap::new();
    for (f, face) in faces.iter().enumerate() {
        for (k, angle) in edge_angles(face.map(|v| points[v])).into_iter().enumerate() {
            let (from, to) = (face[k], face[(k + 1) % 3]);
            // Both faces must measure the angle to the same direction of the edge.
            let turn = if from < to { 0.0 } else { PI };
            let side = sides.entry([from.min(to), from.max(to)]).or_default();
            side.push((f, angle + turn));
        }
    }
    let dual = sides.into_values().map(|side| {
        let [(i, in_i), (j, in_j)] = side[..] else {
            unreachable!("a torus has no boundary")
        };
        let kappa = principal(in_j - in_i);
        DualEdge { i, j, kappa }
    });
    dual.collect()
}

/// The angles of a triangle's edges, counter-clockwise from the first.
fn edge_angles([a, b, c]: [Point; 3]) -> [f64; 3] {
    [0.0, PI - corner(b, c, a), PI + corner(a, b, c)]
}

/// The angle at `o` between the directions to `p` and `q`.
fn corner(o: Point, p: Point, q: Point) -> f64 {
    let towards = |x: Point| [x[0] - o[0], x[1] - o[1], x[2] - o[2]];
    let dot = |x: Point, y: Point| x[0] * y[0] + x[1] * y[1] + x[2] * y[2];
    let (u, v) = (towards(p), towards(q));
    (dot(u, v) / (dot(u, u) * dot(v, v)).sqrt()).acos()
}

/// The same angle in (-pi, pi].
fn principal(angle: f64) -> f64 {
    let turned = angle.rem_euclid(TAU);
    if turned > PI { turned - TAU } else { turned }
}

/// For each dual edge, whether it closes a cycle with the ones before it.
fn off_a_spanning_tree(faces: usize, edges: &[DualEdge]) -> Vec<bool> {
    let mut component: Vec<usize> = (0..faces).collect();
    let mut closes = Vec::new();
    for edge in edges {
        let (kept, joined) = (component[edge.i], component[edge.j]);
        closes.push(kept == joined);
        for c in component.iter_mut().filter(|c| **c == joined) {
            *c = kept;
        }
    }
    closes
}
