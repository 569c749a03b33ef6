//! Rows between cones near each other: on flat meshes, where coordinates are positions and the tests name the
//! cones, because a flat field has none; and over the cut of curved ones.

use super::NearPair;
use crate::error::Error;
use crate::field::{Constraint, FieldProblem, solve_field};
use crate::map::{SeamlessMap, SeamlessOptions, SeamlessProblem, Sizing};
use crate::mesh::features::FeatureGraph;
use crate::mesh::{TriangleMesh, shape};
use crate::monitor::{CancelToken, Monitor, spawned, with_threads};
use crate::search::{Options, Strategy};
use crate::solve::{SoftRow, solve};
use crate::untangle::{FAR, NEAR, Structure};

/// A grid of unit squares, two triangles each, and the problem of its map along x and y.
struct Grid {
    mesh: TriangleMesh,
    problem: SeamlessProblem,
}

impl Grid {
    /// Six columns along x and six rows along y; vertex (i, j) is 7 i + j. Feature edges are `lines`.
    fn new(lines: &[[usize; 2]]) -> Self {
        let at = |i: usize, j: usize| (i * 7 + j) as u32;
        let points = (0..=6).flat_map(|i| (0..=6).map(move |j| [f64::from(i), f64::from(j), 0.0]));
        let squares = (0..6).flat_map(|i| (0..6).map(move |j| (i, j)));
        let faces = squares.flat_map(|(i, j)| {
            let [a, b, c, d] = [at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)];
            [[a, b, c], [a, c, d]]
        });
        let mesh = TriangleMesh::new(points.collect(), faces.collect()).unwrap();
        let (face, angle) = (0, 0.0);
        let field = FieldProblem::new(&mesh, &[Constraint { face, angle }]).unwrap();
        let solution = solve(field.problem(), &Options::default()).unwrap();
        let field = field.field(&mesh, &solution).unwrap();
        let features = FeatureGraph::from_lines(&mesh, lines).unwrap();
        let sizing = Sizing::EdgeLength(1.0);
        let problem = SeamlessProblem::with_features(&mesh, &field, &sizing, &features).unwrap();
        // One copy of every vertex, and u along x.
        assert_eq!(problem.sectors.count(), mesh.vertex_count());
        assert!((problem.aim(&mesh, 0, 0, 1)[0] - 1.0).abs() < 1e-9);
        Grid { mesh, problem }
    }

    /// The rows if integers decide both coordinates of these vertices and one of the vertices on lines.
    fn rows(&self, cones: &[[usize; 2]]) -> Vec<SoftRow> {
        self.rows_within(NEAR, cones)
    }

    fn rows_within(&self, reach: f64, cones: &[[usize; 2]]) -> Vec<SoftRow> {
        let mut held = vec![[false; 2]; self.mesh.vertex_count()];
        for isoline in &self.problem.isolines {
            isoline
                .ends
                .iter()
                .for_each(|&end| held[end as usize][isoline.axis] = true);
        }
        cones.iter().for_each(|&[i, j]| held[7 * i + j] = [true; 2]);
        self.problem.near(&self.mesh, &held, reach).unwrap().rows
    }

    /// How many of the rows a map of the positions misses.
    fn missed(&self, rows: &[SoftRow], map: impl Fn([f64; 2]) -> [f64; 2]) -> usize {
        let points = self.mesh.vertices().iter();
        let mut values: Vec<f64> = points.flat_map(|&[x, y, _]| map([x, y])).collect();
        values.resize(self.problem.problem().variables(), 0.0);
        rows.iter().filter(|row| row.is_missed(&values)).count()
    }
}

#[test]
fn cones_keep_their_order_and_direction() {
    let grid = Grid::new(&[]);
    // Along x, along y downwards, and along a diagonal.
    for [from, to] in [
        [[1, 1], [3, 1]],
        [[2, 4], [2, 2]],
        [[1, 1], [3, 3]],
        [[2, 3], [3, 2]],
    ] {
        let rows = grid.rows(&[from, to]);
        assert_eq!(rows.len(), 3, "{from:?} {to:?}");
        assert_eq!(grid.missed(&rows, |p| p), 0);
        assert_eq!(grid.missed(&rows, |[x, y]| [3.0 * x, 2.0 * y]), 0);
        assert_ne!(grid.missed(&rows, |[x, y]| [-x, -y]), 0);
        assert_ne!(grid.missed(&rows, |_| [2.0, 2.0]), 0);
        assert_ne!(grid.missed(&rows, |[x, y]| [-y, x]), 0, "{from:?} {to:?}");
    }
}

#[test]
fn cones_far_apart_or_behind_another_have_no_rows() {
    let grid = Grid::new(&[]);
    assert!(grid.rows(&[[1, 1], [5, 1]]).is_empty());
    let line = grid.rows(&[[1, 1], [2, 1], [3, 1]]);
    let ends = grid.rows(&[[1, 1], [3, 1]]);
    let behind = ends
        .iter()
        .filter(|row| line.iter().any(|other| other.terms == row.terms));
    // A path around the middle one is longer, and reaches the far one over the diagonals.
    assert!(line.len() >= 6 && behind.count() <= 3);
    assert_eq!(grid.missed(&line, |p| p), 0);
}

#[test]
fn cones_far_apart_keep_their_order_alone() {
    let grid = Grid::new(&[]);
    for [from, to] in [[[1, 1], [5, 1]], [[1, 1], [4, 4]]] {
        let rows = grid.rows_within(FAR, &[from, to]);
        assert_eq!(rows.len(), 1, "{from:?} {to:?}");
        assert_eq!(grid.missed(&rows, |p| p), 0);
        assert_eq!(grid.missed(&rows, |_| [2.0, 2.0]), 1);
        assert_eq!(grid.missed(&rows, |[x, y]| [-x, -y]), 1);
    }
}

#[test]
fn a_cone_stays_on_its_side_of_an_isoline() {
    let lines: Vec<[usize; 2]> = (0..6).map(|j| [7 * 3 + j, 7 * 3 + j + 1]).collect();
    let grid = Grid::new(&lines);
    let rows = grid.rows(&[[1, 3]]);
    assert_eq!(rows.len(), 1);
    assert_eq!(grid.missed(&rows, |p| p), 0);
    assert_eq!(
        grid.missed(&rows, |[x, y]| [if x == 3.0 { 1.0 } else { x }, y]),
        1
    );
    assert_eq!(grid.missed(&rows, |[x, y]| [6.0 - x, y]), 1);
    // Its own isoline is no obstacle.
    assert!(grid.rows(&[[3, 2]]).is_empty());
}

#[test]
fn searches_are_made_at_once_and_can_be_cancelled() {
    let grid = Grid::new(&[]);
    let rows = || grid.rows(&[[1, 1], [3, 1], [2, 4], [4, 4]]);
    let one = with_threads(1, rows);
    assert!(!one.is_empty());
    let started = spawned(|| assert_eq!(with_threads(3, rows), one));
    assert_eq!(started, 2);
    let token = CancelToken::new();
    token.cancel();
    let _watch = Monitor::default().cancel_token(token).watch();
    let held = vec![[true; 2]; grid.mesh.vertex_count()];
    let near = grid.problem.near(&grid.mesh, &held, NEAR);
    assert_eq!(near.map(|near| near.rows), Err(Error::Cancelled));
}

#[test]
fn integers_decide_rows_over_the_cut() {
    let mut crossing = 0;
    for name in ["genus-2", "sphere", "rounded-cube"] {
        let mesh = shape::by_name(name, 1_500).unwrap();
        let options = Options {
            strategy: Strategy::Lattice,
            ..Options::default()
        };
        let field = Default::default();
        let (field, _) = solve_field(&mesh, &field, &options, Monitor::default).unwrap();
        let quads = SeamlessOptions { quads: 60 };
        let problem = SeamlessProblem::new(&mesh, &field, &quads).unwrap();
        let solution = solve(problem.problem(), &options).unwrap();
        let map: SeamlessMap = problem.map(&mesh, &solution).unwrap();
        let mut monitor = Monitor::default();
        let structure = Structure::new(&mesh, &problem, &map, &mut monitor).unwrap();
        let held = structure.freedom.held();
        for row in problem.near(&mesh, &held, NEAR).unwrap().rows {
            let value: f64 = row.terms.iter().map(|&(i, c)| c * map.values()[i]).sum();
            assert!(
                (value - value.round()).abs() < 1e-6,
                "{name} {row:?}: {value}"
            );
            crossing += usize::from(row.terms.len() > 4);
        }
    }
    assert!(crossing > 10, "{crossing}");
}

#[test]
fn steps_bring_a_difference_one_nearer_to_its_aim() {
    let pair = NearPair {
        vertices: [0, 1],
        aim: [2.3, -0.4],
        terms: [vec![(2, 1.0), (0, -1.0)], vec![(3, 1.0), (1, -1.0)]],
    };
    let values = [1.0, 1.0, 2.0, 2.0];
    for (axis, deviation) in [(0, 1.3), (1, -1.4)] {
        assert!((pair.deviation(axis, &values) - deviation).abs() < 1e-12);
        let step = pair.step(axis, &values);
        assert!(step.is_missed(&values));
        let mut moved = values;
        moved[2 + axis] += f64::signum(deviation);
        assert!(!step.is_missed(&moved), "one step is enough");
        moved[2 + axis] = values[2 + axis] - f64::signum(deviation);
        assert!(step.is_missed(&moved));
    }
}
