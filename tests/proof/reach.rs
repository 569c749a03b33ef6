//! Proofs of problems that are too large for brute force reach the optimum, in the few nodes that their kind allows.

use roundel::proof::{FaultKind, Verdict, check, check_of};
use roundel::{Monitor, Options, Problem, SolveStatus, solve_with_proof};

use crate::random::Random;
use crate::{made, prove, text};

const NONE: f64 = f64::INFINITY;

/// What the proof of a problem proves, and its text.
fn proved(problem: &Problem) -> (Verdict, String) {
    let proof = text(made(&prove(problem).unwrap()));
    let verdict = check_of(problem, proof.as_slice()).unwrap();
    (verdict, String::from_utf8(proof).unwrap())
}

/// The part of the energy that is missing to the bound.
fn gap(verdict: &Verdict) -> f64 {
    let energy = verdict.energy.unwrap();
    (energy - verdict.lower_bound.unwrap()) / energy.abs()
}

/// The multipliers of a flow are a proof without a tree. Those of the relaxation over reals leave a gap.
#[test]
fn the_flow_of_a_grid_is_proved_without_a_branch() {
    const SIDE: usize = 12;
    let random = &mut Random::new(5);
    let at = |row: usize, column: usize| SIDE * row + column;
    let right = (0..SIDE).flat_map(|i| (1..SIDE).map(move |j| [at(i, j - 1), at(i, j)]));
    let down = (1..SIDE).flat_map(|i| (0..SIDE).map(move |j| [at(i - 1, j), at(i, j)]));
    let edges: Vec<[usize; 2]> = right.chain(down).collect();
    let all: Vec<usize> = (0..edges.len()).collect();
    let mut problem = Problem::new(edges.len()).unwrap();
    let mut rows = vec![(Vec::new(), Vec::new(), 0.0); SIDE * SIDE];
    for (edge, ends) in edges.iter().enumerate() {
        let (target, weight) = (
            9.0 * random.below(1000) as f64 / 1000.0,
            0.1 + random.below(9) as f64 / 7.0,
        );
        problem
            .add_least_squares(&[edge], &[1.0], target, weight)
            .unwrap();
        let flow = random.below(10) as f64;
        for (end, sign) in ends.iter().zip([-1.0, 1.0]) {
            let (unknowns, signs, demand) = &mut rows[*end];
            unknowns.push(edge);
            signs.push(sign);
            *demand += sign * flow;
        }
    }
    for (unknowns, signs, demand) in &rows {
        problem.add_constraint(unknowns, signs, *demand).unwrap();
    }
    let (lower, upper) = (vec![0.0; edges.len()], vec![9.0; edges.len()]);
    problem.set_bounds(&all, &lower, &upper).unwrap();
    problem.set_integers(&all).unwrap();
    let (verdict, _) = proved(&problem);
    assert_eq!(verdict.nodes, 1);
    assert!(gap(&verdict) <= 1e-12, "{verdict:?}");
}

/// Facility location with squares, of as many rows as are left to the interior-point method.
#[test]
fn places_for_customers_are_proved_in_a_few_nodes() {
    const CUSTOMERS: usize = 45;
    const PLACES: usize = 12;
    let random = &mut Random::new(6);
    let n = CUSTOMERS * PLACES;
    let mut problem = Problem::new(n + PLACES).unwrap();
    for customer in 0..CUSTOMERS {
        let shares: Vec<usize> = (0..PLACES).map(|place| PLACES * customer + place).collect();
        for (place, &share) in shares.iter().enumerate() {
            let weight = 0.5 + random.below(400) as f64 / 100.0;
            problem
                .add_least_squares(&[share], &[1.0], 0.0, weight)
                .unwrap();
            problem
                .add_inequality(&[share, n + place], &[1.0, -1.0], -NONE, 0.0)
                .unwrap();
        }
        problem
            .add_constraint(&shares, &[1.0; PLACES], 1.0)
            .unwrap();
        problem
            .set_bounds(&shares, &[0.0; PLACES], &[1.0; PLACES])
            .unwrap();
    }
    let places: Vec<usize> = (n..n + PLACES).collect();
    problem.set_binaries(&places).unwrap();
    let costs = (0..n + PLACES).map(|j| {
        if j < n {
            0.0
        } else {
            2.0 + random.below(30) as f64 / 10.0
        }
    });
    problem.add_linear(&costs.collect::<Vec<f64>>()).unwrap();
    let (verdict, lines) = proved(&problem);
    assert!(lines.contains("\"switches\""));
    assert!(
        gap(&verdict) <= 1e-8 && verdict.nodes < 200,
        "{} {}",
        gap(&verdict),
        verdict.nodes
    );
}

/// More unknowns than a dense factor takes: a path of reals, on which integers have a place and a wish.
#[test]
fn integers_of_many_reals_are_proved_by_their_closest_point() {
    const INTEGERS: usize = 12;
    const EACH: usize = 400;
    let random = &mut Random::new(7);
    let n = INTEGERS * EACH;
    let mut problem = Problem::new(n + INTEGERS).unwrap();
    let mut square = |unknowns: &[usize], terms: &[f64], rhs: f64, weight: f64| {
        problem
            .add_least_squares(unknowns, terms, rhs, weight)
            .unwrap();
    };
    let mut wish = |most: usize| random.below(1000) as f64 / 1000.0 * most as f64;
    for i in 1..n {
        square(&[i - 1, i], &[1.0, -1.0], wish(1), 1.0);
    }
    for k in 0..INTEGERS {
        square(&[k * EACH, n + k], &[1.0, -0.8], wish(3), 0.1);
        square(&[n + k], &[1.0], wish(9), 0.01);
    }
    let integers: Vec<usize> = (n..n + INTEGERS).collect();
    problem.set_integers(&integers).unwrap();
    let (verdict, lines) = proved(&problem);
    assert!(lines.contains("\"lattice\"") && !lines.contains("\"node\""));
    assert!(gap(&verdict) <= 1e-8, "{} {}", gap(&verdict), verdict.nodes);
}

/// Integers on a grid, each to be near its neighbours and a wish: too many for an enumeration.
#[test]
fn many_integers_are_proved_by_splits() {
    const SIDE: usize = 11;
    let random = &mut Random::new(8);
    let mut problem = Problem::new(SIDE * SIDE).unwrap();
    let mut wish = || random.below(1000) as f64 / 1000.0;
    for at in 0..SIDE * SIDE {
        problem
            .add_least_squares(&[at], &[1.0], 3.0 * wish(), 0.3)
            .unwrap();
        let right = (at % SIDE + 1 < SIDE).then_some(at + 1);
        let below = (at + SIDE < SIDE * SIDE).then_some(at + SIDE);
        for other in right.into_iter().chain(below) {
            problem
                .add_least_squares(&[at, other], &[1.0, -1.0], wish(), 1.0)
                .unwrap();
        }
    }
    let all: Vec<usize> = (0..SIDE * SIDE).collect();
    problem.set_integers(&all).unwrap();
    let relaxed = roundel::solve(
        &problem,
        &Options {
            strategy: roundel::Strategy::Relax,
            ..Options::default()
        },
    );
    let found = solve_with_proof(&problem, &Options::default(), Monitor::default()).unwrap();
    let lines = String::from_utf8(text(made(&found))).unwrap();
    let verdict = check_of(&problem, lines.as_bytes()).unwrap();
    assert!(lines.contains("\"splits\""));
    // Splits that are left out, and more than they show.
    let lies = [
        (
            r#""splits":["#,
            r#""splits":[],"left":["#,
            FaultKind::Format,
        ),
        (r#""square":"#, r#""square":9"#, FaultKind::Bound),
        (r#""level":"#, r#""level":-"#, FaultKind::Lattice),
    ];
    for (word, lie, kind) in lies {
        assert!(lines.contains(word), "{word}");
        let fault = check(lines.replacen(word, lie, 1).as_bytes()).unwrap_err();
        assert_eq!(fault.kind, kind, "{fault}");
    }
    let whole = verdict.energy.unwrap() - relaxed.unwrap().energy();
    let shown = gap(&verdict) * verdict.energy.unwrap();
    assert!(shown <= 0.2 * whole, "{shown} of {whole}");
}

/// Machines are alike, which the search uses and a proof cannot tell: the solution is optimal all the same.
#[test]
fn what_only_the_search_proves_is_solved() {
    const MACHINES: usize = 4;
    let sizes = [7.0, 6.0, 5.5, 5.0, 4.0, 3.5, 3.0, 2.0, 1.5];
    let n = sizes.len() * MACHINES;
    let all: Vec<usize> = (0..n).collect();
    let mut problem = Problem::new(n).unwrap();
    for machine in 0..MACHINES {
        let own: Vec<usize> = (0..sizes.len())
            .map(|thing| MACHINES * thing + machine)
            .collect();
        problem.add_least_squares(&own, &sizes, 0.0, 1.0).unwrap();
    }
    for thing in 0..sizes.len() {
        let own = &all[MACHINES * thing..][..MACHINES];
        problem.add_constraint(own, &[1.0; MACHINES], 1.0).unwrap();
    }
    problem.set_binaries(&all).unwrap();
    let plain = roundel::solve(&problem, &Options::default()).unwrap();
    assert_eq!(plain.status(), SolveStatus::Optimal);
    let found = prove(&problem).unwrap();
    let verdict = check_of(&problem, text(made(&found)).as_slice()).unwrap();
    let outcome = found.outcome.unwrap();
    assert_eq!(outcome.status(), SolveStatus::Optimal);
    assert!((outcome.energy() - plain.energy()).abs() <= 1e-9 * plain.energy());
    assert!(verdict.lower_bound.unwrap() <= plain.energy());
}
