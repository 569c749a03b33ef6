//! Small problems of both families (fields and maps), and a dense textbook solver as an oracle.

#![allow(dead_code)]

pub mod archive;
mod random;
pub mod skip;

pub use random::Random;
use roundel::{Options, Problem, Result, Solution, Strategy, solve};

/// A solve with so small a limit on nodes that the search for a proof takes no time.
pub fn solve_briefly(problem: &Problem, strategy: Strategy) -> Result<Solution> {
    let options = Options {
        strategy,
        nodes: 500,
        ..Options::default()
    };
    solve(problem, &options)
}

/// An orientation field on the faces of a `side` by `side` torus of quadrilaterals. There is one angle for
/// each face and one period jump for each dual edge off a spanning tree. The first angle is pinned.
pub fn orientation_field(side: usize, seed: u64) -> Result<Problem> {
    weighted_orientation_field(side, seed, 1.0)
}

/// The same with this weight of every row.
pub fn weighted_orientation_field(side: usize, seed: u64, weight: f64) -> Result<Problem> {
    let mut random = Random::new(seed);
    let faces = side * side;
    let face = |r: usize, c: usize| (r % side) * side + c % side;
    let mut edges = Vec::new();
    for r in 0..side {
        for c in 0..side {
            edges.push((face(r, c), face(r, c + 1), c + 1 < side));
            edges.push((face(r, c), face(r + 1, c), c == 0 && r + 1 < side));
        }
    }
    let jumps = edges.iter().filter(|e| !e.2).count();
    let mut problem = Problem::new(faces + jumps)?;
    let mut jump = faces;
    for (i, j, in_tree) in edges {
        let kappa = std::f64::consts::PI * random.next();
        if in_tree {
            problem.add_least_squares(&[i, j], &[1.0, -1.0], -kappa, weight)?;
        } else {
            let quarter = std::f64::consts::FRAC_PI_2;
            problem.add_least_squares(&[i, j, jump], &[1.0, -1.0, quarter], -kappa, weight)?;
            problem.set_integers(&[jump])?;
            jump += 1;
        }
    }
    problem.pin(0, 0.3)?;
    Ok(problem)
}

/// A seamless parametrization of a `side` by `side` patch of vertices, whose (u, v) follow a random
/// gradient. A quarter turn and an integer translation glue its left side to its right and its top to its
/// bottom. Two vertices are cones on integers.
pub fn parametrization(side: usize, seed: u64) -> Result<Problem> {
    weighted_parametrization(side, seed, 1.0)
}

/// The same with this weight of every row.
pub fn weighted_parametrization(side: usize, seed: u64, weight: f64) -> Result<Problem> {
    let mut random = Random::new(seed);
    let at = |r: usize, c: usize| 2 * (r * side + c);
    let unknowns = 2 * side * side;
    let seams = 2;
    let mut problem = Problem::new(unknowns + 2 * seams)?;
    for r in 0..side {
        for c in 0..side {
            for (r2, c2) in [(r, c + 1), (r + 1, c)] {
                if r2 < side && c2 < side {
                    for k in 0..2 {
                        let wanted = 1.3 * random.next();
                        let ends = [at(r2, c2) + k, at(r, c) + k];
                        problem.add_least_squares(&ends, &[1.0, -1.0], wanted, weight)?;
                    }
                }
            }
        }
    }
    for seam in 0..seams {
        let (s, t) = (unknowns + 2 * seam, unknowns + 2 * seam + 1);
        problem.set_integers(&[s, t])?;
        problem.add_least_squares(&[s], &[1.0], 0.0, 1e-6 * weight)?;
        problem.add_least_squares(&[t], &[1.0], 0.0, 1e-6 * weight)?;
        for k in 0..side {
            let (a, b) = if seam == 0 {
                (at(k, 0), at(k, side - 1))
            } else {
                (at(0, k), at(side - 1, k))
            };
            // b = R a + (s, t) with a quarter turn R: (u, v) -> (-v, u).
            problem.add_constraint(&[b, a + 1, s], &[1.0, 1.0, -1.0], 0.0)?;
            problem.add_constraint(&[b + 1, a, t], &[1.0, -1.0, -1.0], 0.0)?;
        }
    }
    let cones = [at(1, 1), at(side - 2, side / 2)];
    problem.set_integers(&[cones[0], cones[0] + 1, cones[1], cones[1] + 1])?;
    problem.add_constraint(&[cones[0]], &[1.0], 0.0)?;
    problem.add_constraint(&[cones[0] + 1], &[1.0], 0.0)?;
    Ok(problem)
}

/// A chain of integers that are coupled to their neighbours.
pub fn loosely_coupled(size: usize) -> Result<Problem> {
    let mut random = Random::new(5);
    let mut problem = Problem::new(size)?;
    for i in 0..size {
        problem.add_least_squares(&[i], &[1.0], 9.0 * random.next(), 1.0)?;
        if i > 0 {
            let wanted = random.next();
            problem.add_least_squares(&[i - 1, i], &[1.0, -0.7], wanted, 1.0)?;
        }
    }
    problem.set_integers(&Vec::from_iter(0..size))?;
    Ok(problem)
}

/// Solves `a x = b` by Gaussian elimination with row pivoting.
pub fn dense_solve(mut a: Vec<Vec<f64>>, mut b: Vec<f64>) -> Vec<f64> {
    let n = b.len();
    for k in 0..n {
        let best = (k..n)
            .max_by(|&i, &j| a[i][k].abs().total_cmp(&a[j][k].abs()))
            .unwrap();
        a.swap(k, best);
        b.swap(k, best);
        for i in k + 1..n {
            let f = a[i][k] / a[k][k];
            for j in k..n {
                a[i][j] -= f * a[k][j];
            }
            b[i] -= f * b[k];
        }
    }
    for k in (0..n).rev() {
        for j in k + 1..n {
            b[k] -= a[k][j] * b[j];
        }
        b[k] /= a[k][k];
    }
    b
}
