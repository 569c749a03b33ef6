//! Properties of the cycle method from a problem to its charges and back, on small random graphs.

use super::basis::cycle_basis;
use super::block::Growth;
use super::cycles::Cycles;
use super::detect::AngleSystem;
use super::graph::{Edge, Graph, NONE};
use super::hint::hinted_cycles;
use super::improve::{Effort, Improvement};
use super::space::CycleSpace;
use crate::eliminate::{ReducedModel, eliminate};
use crate::monitor::Monitor;
use crate::problem::{Model, Problem};
use crate::search::{Options, SolveStatus, Strategy};
use crate::solve::solve;
use crate::test_random::Random;

/// Rows `(i, j, has an integer)`; unknown `n` stands for a pinned one.
pub(super) struct Sketch {
    nodes: usize,
    rows: Vec<(usize, usize, bool)>,
    pinned: Vec<usize>,
}

impl Sketch {
    /// A grid on a torus. The rows without integers form a spanning forest.
    pub fn torus(side: usize, pinned: &[usize]) -> Self {
        let at = |r: usize, c: usize| (r % side) * side + c % side;
        let mut links = Vec::new();
        for r in 0..side {
            for c in 0..side {
                links.push((at(r, c), at(r, c + 1)));
                links.push((at(r, c), at(r + 1, c)));
            }
        }
        Sketch::of(side * side, links, pinned, true)
    }

    /// Edges between random nodes, parallel edges included, in several components.
    pub fn random(random: &mut Random, fixed_forest: bool) -> Self {
        let nodes = 3 + random.below(10);
        let links = (0..nodes + random.below(8))
            .map(|_| (random.below(nodes), random.below(nodes)))
            .filter(|(i, j)| i != j)
            .collect();
        let pinned: Vec<usize> = (0..nodes).filter(|_| random.unit() < 0.2).collect();
        Sketch::of(nodes, links, &pinned, fixed_forest)
    }

    pub fn of(
        nodes: usize,
        links: Vec<(usize, usize)>,
        pinned: &[usize],
        fixed_forest: bool,
    ) -> Self {
        let mut root: Vec<usize> = (0..nodes).collect();
        let find = |root: &[usize], mut i: usize| {
            while root[i] != i {
                i = root[i];
            }
            i
        };
        // All pinned nodes are one node.
        for pair in pinned.windows(2) {
            root[pair[1]] = root[pair[0]];
        }
        let rows = links
            .into_iter()
            .map(|(i, j)| {
                let (a, b) = (find(&root, i), find(&root, j));
                root[b] = a;
                (i, j, a == b || !fixed_forest)
            })
            .collect();
        Sketch {
            nodes,
            rows,
            pinned: pinned.to_vec(),
        }
    }

    pub fn problem(&self, random: &mut Random) -> Problem {
        let integers = self.rows.iter().filter(|r| r.2).count();
        let mut problem = Problem::new(self.nodes + integers).unwrap();
        let step = 0.5 + random.unit();
        let mut p = self.nodes;
        for &(i, j, integer) in &self.rows {
            let (rhs, weight) = (20.0 * random.unit(), 0.5 + random.unit());
            if integer {
                let turn = if random.unit() < 0.5 { step } else { -step };
                problem.set_integers(&[p]).unwrap();
                problem
                    .add_least_squares(&[i, j, p], &[1.0, -1.0, turn], rhs, weight)
                    .unwrap();
                p += 1;
            } else {
                problem
                    .add_least_squares(&[i, j], &[1.0, -1.0], rhs, weight)
                    .unwrap();
            }
        }
        for &i in &self.pinned {
            problem.pin(i, random.unit()).unwrap();
        }
        problem
    }
}

pub(super) fn reduced(problem: &Problem) -> (Model, ReducedModel) {
    let model = Model::new(problem).unwrap();
    let reduced = eliminate(&model, &mut Monitor::default()).unwrap();
    (model, reduced)
}

fn options(strategy: Strategy) -> Options {
    Options {
        strategy,
        ..Options::default()
    }
}

/// The cycle space of a problem, with its hints.
pub(super) fn space(problem: &Problem) -> Option<(ReducedModel, CycleSpace)> {
    let (model, reduced) = reduced(problem);
    let system = AngleSystem::detect(&reduced)?;
    let relaxed = solve(problem, &options(Strategy::Relax)).unwrap();
    // The elimination replaces no integer in these problems, so the reduced integers are the caller's.
    let integers = model.integer().iter().zip(relaxed.values());
    let relaxed: Vec<f64> = integers.filter(|(i, _)| **i).map(|(_, &x)| x).collect();
    assert_eq!(relaxed.len(), reduced.integers().len());
    let hinted = hinted_cycles(&model, &reduced, &system);
    let space = CycleSpace::new(system, &relaxed, hinted).unwrap();
    Some((reduced, space))
}

/// The energy with these integers, by a separate solve with all of them pinned.
pub(super) fn energy(problem: &Problem, integers: &[f64]) -> f64 {
    let mut problem = problem.clone();
    let (model, _) = reduced(&problem);
    let at = (0..model.variables()).filter(|&i| model.integer()[i]);
    for (i, &z) in at.zip(integers) {
        problem.pin(i, z).unwrap();
    }
    solve(&problem, &options(Strategy::Relax)).unwrap().energy()
}

/// The exact determinant of an integer matrix (`bareiss1968`).
fn determinant(mut a: Vec<Vec<i128>>) -> i128 {
    let n = a.len();
    let (mut sign, mut previous) = (1, 1);
    for k in 0..n {
        let Some(pivot) = (k..n).find(|&i| a[i][k] != 0) else {
            return 0;
        };
        if pivot != k {
            a.swap(pivot, k);
            sign = -sign;
        }
        for i in k + 1..n {
            for j in k + 1..n {
                a[i][j] = (a[i][j] * a[k][k] - a[i][k] * a[k][j]) / previous;
            }
        }
        previous = a[k][k];
    }
    sign * previous
}

#[test]
fn the_basis_is_unimodular_in_the_integers() {
    let mut random = Random::new(1);
    let mut bases = 0;
    for round in 0..200 {
        let sketch = match round % 4 {
            0 => Sketch::torus(3 + round % 3, &[0, 4][..round / 4 % 3]),
            _ => Sketch::random(&mut random, true),
        };
        let Some((_, space)) = space(&sketch.problem(&mut random)) else {
            continue;
        };
        // The rows without integers form a spanning forest. So the integers belong to the chords, except
        // those between known angles.
        let chords: Vec<usize> = (0..space.system.graph.edges.len())
            .filter(|&e| space.system.graph.edges[e].integer != NONE)
            .collect();
        assert_eq!(space.basis.len(), chords.len());
        let row = |k: usize| -> Vec<i128> {
            let cycle = space.basis.get(k);
            let entry = |&e: &usize| {
                let found = cycle.iter().filter(|c| c.0 as usize == e);
                found.map(|c| i128::from(c.1)).sum()
            };
            chords.iter().map(entry).collect()
        };
        let matrix: Vec<Vec<i128>> = (0..chords.len()).map(row).collect();
        bases += usize::from(!matrix.is_empty());
        assert_eq!(determinant(matrix).abs(), 1, "round {round}");
    }
    assert!(bases > 100, "{bases}");
}

#[test]
fn cycles_close() {
    let mut random = Random::new(2);
    let mut cycles = 0;
    for _ in 0..100 {
        let sketch = Sketch::random(&mut random, false);
        let Some((_, space)) = space(&sketch.problem(&mut random)) else {
            continue;
        };
        for k in 0..space.basis.len() {
            let mut sum = vec![0i32; space.system.graph.nodes()];
            for &(e, sign) in space.basis.get(k) {
                let edge = &space.system.graph.edges[e as usize];
                sum[edge.tail as usize] += i32::from(sign);
                sum[edge.head as usize] -= i32::from(sign);
            }
            assert!(sum.iter().all(|&s| s == 0));
            assert!(!space.basis.get(k).is_empty());
            cycles += 1;
        }
    }
    assert!(cycles > 100, "{cycles}");
}

#[test]
fn energies_of_charges_are_those_of_their_integers() {
    let mut random = Random::new(3);
    let mut checked = 0;
    for round in 0..200 {
        let sketch = Sketch::random(&mut random, round % 2 == 0);
        let problem = sketch.problem(&mut random);
        let Some((_, space)) = space(&problem) else {
            continue;
        };
        let random = |_| random.below(9) as f64 - 4.0;
        let some: Vec<f64> = (0..space.basis.len()).map(random).collect();
        let [plane, some] = [space.nearest_plane(), some].map(|charges| {
            let (_, expected) = space.potentials(&charges);
            let integers = space.integers(&charges).expect("every charge is reached");
            assert_eq!(space.charges(&integers), charges);
            (expected, energy(&problem, &integers))
        });
        // Integers between known angles add the same energy to both.
        let (expected, actual) = (some.0 - plane.0, some.1 - plane.1);
        assert!(
            (actual - expected).abs() < 1e-8 * (1.0 + some.1),
            "round {round}: {actual} {expected}"
        );
        checked += 1;
    }
    assert!(checked > 100, "{checked}");
}

#[test]
fn improvement_is_never_worse_and_finds_the_optimum_of_what_fits_into_a_block() {
    let mut random = Random::new(4);
    let mut proved = 0;
    for _ in 0..60 {
        let sketch = Sketch::random(&mut random, true);
        let problem = sketch.problem(&mut random);
        let Some((_, space)) = space(&problem) else {
            continue;
        };
        let m = space.basis.len();
        let start: Vec<f64> = (0..m).map(|_| random.below(5) as f64 - 2.0).collect();
        let (_, before) = space.potentials(&start);
        let mut improvement = Improvement::new(&space, start).unwrap();
        let effort = Effort {
            growth: Growth::Near,
            size: 32,
            residual: 0.0,
        };
        let mut monitor = Monitor::default();
        improvement.run(effort, usize::MAX, &mut monitor).unwrap();
        assert!(improvement.energy <= before);
        let integers = space.integers(&improvement.charges).unwrap();
        let exact = solve(&problem, &options(Strategy::Exact)).unwrap();
        // The components are far apart, so each of them is a block.
        let actual = energy(&problem, &integers);
        let least = exact.energy();
        let tolerance = 1e-7 * (1.0 + actual);
        assert!(actual <= least + tolerance, "{actual} {least}");
        if exact.status() == SolveStatus::Optimal && m > 0 {
            assert!(actual >= least - tolerance, "{actual} {least}");
            proved += 1;
        }
    }
    assert!(proved > 30, "{proved}");
}

#[test]
fn strategies_in_cycle_space_beat_direct_rounding_on_a_torus() {
    let mut random = Random::new(5);
    for pinned in [&[][..], &[0], &[0, 1, 20, 33]] {
        let problem = Sketch::torus(8, pinned).problem(&mut random);
        let of = |strategy| solve(&problem, &options(strategy)).unwrap().energy();
        let [direct, adaptive] = [of(Strategy::Direct), of(Strategy::Adaptive)];
        assert!(of(Strategy::Lattice) < direct);
        assert!(of(Strategy::Auto) <= adaptive.min(direct) * (1.0 + 1e-9));
    }
}

#[test]
fn integers_between_known_angles_are_rounded() {
    let mut problem = Problem::new(5).unwrap();
    problem.set_integers(&[3, 4]).unwrap();
    problem.pin(0, 0.0).unwrap();
    problem.pin(1, 0.9).unwrap();
    let turn = [1.0, -1.0, 1.0];
    problem
        .add_least_squares(&[0, 1, 3], &turn, 1.3, 1.0)
        .unwrap();
    problem
        .add_least_squares(&[1, 2, 4], &turn, 0.2, 2.0)
        .unwrap();
    let solution = solve(&problem, &options(Strategy::Lattice)).unwrap();
    assert_eq!(solution.values()[3], 2.0);
    assert!((solution.energy() - 0.04).abs() < 1e-12);
}

#[test]
fn what_is_not_quite_an_angle_difference_system_is_refused() {
    let detected = |change: &dyn Fn(&mut Problem)| {
        let mut problem = Problem::new(6).unwrap();
        problem.set_integers(&[3, 4]).unwrap();
        for (row, turn) in [([0, 1, 3], 2.0), ([1, 2, 4], -2.0)] {
            let row = problem.add_least_squares(&row, &[1.0, -1.0, turn], 0.3, 1.0);
            row.unwrap();
        }
        let plain = problem.add_least_squares(&[0, 2], &[1.0, -1.0], 0.1, 3.0);
        plain.unwrap();
        change(&mut problem);
        AngleSystem::detect(&reduced(&problem).1).is_some()
    };
    let with = |row: &[usize], values: &[f64], integer: bool| {
        detected(&|p| {
            if integer {
                p.set_integers(&[5]).unwrap();
            }
            p.add_least_squares(row, values, 0.5, 1.0).unwrap();
        })
    };
    assert!(detected(&|_| {}));
    assert!(with(&[0, 1, 5], &[1.0, -1.0, 2.0], true), "a parallel edge");
    assert!(
        with(&[5], &[1.0], true),
        "an integer that couples to nothing"
    );
    assert!(!with(&[0, 1, 5], &[1.0, -1.0, 3.0], true), "another step");
    assert!(!with(&[0, 1, 5], &[1.0, -1.1, 2.0], true), "no difference");
    assert!(!with(&[0, 1, 5], &[1.0, 1.0, 2.0], true), "a sum");
    assert!(
        !with(&[0, 1], &[1.0, 1.0], false),
        "a sum without an integer"
    );
    assert!(!with(&[0, 5], &[1.0, 2.0], false) || with(&[5], &[1.0], true));
    assert!(
        !with(&[3, 4], &[1.0, -1.0], false),
        "integers that see each other"
    );
    assert!(
        !detected(&|p| {
            p.add_least_squares(&[0], &[1.0], 0.0, 1.0).unwrap();
            p.add_least_squares(&[2], &[1.0], 1.0, 1.0).unwrap();
        }),
        "a cycle of rows without integers, through the ground"
    );
}

#[test]
fn a_hinted_cycle_is_taken_and_a_wrong_one_is_not() {
    let mut random = Random::new(6);
    let side = 5;
    let sketch = Sketch::torus(side, &[]);
    let mut problem = sketch.problem(&mut random);
    // A detour around two squares. It is as short as a cycle around the torus, but it is not a ring.
    let at = |r: usize, c: usize| (r % side) * side + c % side;
    let row = |i: usize, j: usize| {
        let found = sketch.rows.iter().position(|r| (r.0, r.1) == (i, j));
        found.unwrap()
    };
    let rows = [
        row(at(0, 0), at(0, 1)),
        row(at(0, 1), at(0, 2)),
        row(at(0, 2), at(1, 2)),
        row(at(1, 1), at(1, 2)),
        row(at(1, 0), at(1, 1)),
        row(at(0, 0), at(1, 0)),
    ];
    let signs = [1, 1, 1, -1, -1, -1];
    problem.hint_cycles(&[0, 6], &rows, &signs).unwrap();
    let (model, reduced) = reduced(&problem);
    let system = AngleSystem::detect(&reduced).unwrap();
    let cycles = hinted_cycles(&model, &reduced, &system);
    assert_eq!(cycles.len(), 1);
    assert_eq!(cycles.get(0).len(), 6);
    let (_, hinted) = space(&problem).unwrap();
    problem.hint_cycles(&[0, 2], &rows[..2], &[1, 1]).unwrap();
    let (_, unhinted) = space(&problem).unwrap();
    // All squares but one are shorter, so the detour does not change the result.
    let lengths = |s: &CycleSpace| {
        (0..s.basis.len())
            .map(|k| s.basis.get(k).len())
            .sum::<usize>()
    };
    assert_eq!(lengths(&hinted), lengths(&unhinted));
}

#[test]
fn a_long_hinted_cycle_saves_a_longer_one() {
    // A ring of 20 nodes is too long for the search. A chord splits it into rings of 14 and 8 nodes.
    let edge = |tail: u32, head: u32, integer: u32| Edge {
        tail,
        head,
        weight: 1.0,
        integer,
    };
    let mut edges: Vec<Edge> = (0..20).map(|i| edge(i, (i + 1) % 20, i)).collect();
    edges.push(edge(0, 13, 20));
    let graph = Graph::new(21, edges);
    let lengths = |hinted: Cycles| {
        let basis = cycle_basis(&graph, hinted).unwrap();
        (0..basis.len())
            .map(|k| basis.get(k).len())
            .collect::<Vec<_>>()
    };
    let mut hinted = Cycles::new();
    hinted.push((0..13).map(|e| (e, 1)).chain([(20, -1)]));
    assert_eq!(lengths(hinted), [8, 14]);
    let unhinted = lengths(Cycles::new());
    assert!(unhinted == [8, 14] || unhinted == [8, 20], "{unhinted:?}");
}
