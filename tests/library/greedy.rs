//! Direct and exact greedy rounding, compared with dense textbook versions on the same reduced model.

use crate::common::dense_solve;
use roundel::internals::eliminate::{ReducedModel, eliminate};
use roundel::{Model, Monitor, Options, Problem, Strategy, solve};

const TIE: f64 = 1e-9;

/// Minimises the reduced objective with some unknowns held at given values, from scratch.
fn minimise(model: &ReducedModel, held: &[Option<f64>]) -> Vec<f64> {
    let n = model.dim();
    let mut hessian = vec![vec![0.0; n]; n];
    for i in 0..n {
        for (j, v) in model.hessian().row(i) {
            hessian[i][j] = v;
            hessian[j][i] = v;
        }
    }
    let free: Vec<usize> = (0..n).filter(|&i| held[i].is_none()).collect();
    let a = free
        .iter()
        .map(|&i| free.iter().map(|&j| hessian[i][j]).collect());
    let b = free.iter().map(|&i| {
        let pull: f64 = (0..n)
            .filter_map(|j| held[j].map(|x| hessian[i][j] * x))
            .sum();
        -model.gradient()[i] - pull
    });
    let solved = dense_solve(a.collect(), b.collect());
    let mut x: Vec<f64> = held.iter().map(|h| h.unwrap_or(0.0)).collect();
    for (&i, v) in free.iter().zip(solved) {
        x[i] = v;
    }
    x
}

fn textbook_greedy(model: &ReducedModel) -> Vec<f64> {
    let mut held = vec![None; model.dim()];
    loop {
        let x = minimise(model, &held);
        let free = || model.integers().iter().map(|&i| i as usize);
        let free = || free().filter(|&i| held[i].is_none());
        let deviation = |i: usize| (x[i] - x[i].round()).abs();
        let least = free().map(deviation).fold(f64::INFINITY, f64::min);
        let next = free().find(|&i| deviation(i) <= least + TIE);
        match next {
            Some(i) => held[i] = Some(x[i].round()),
            None => return x,
        }
    }
}

fn textbook_direct(model: &ReducedModel) -> Vec<f64> {
    let mut held = vec![None; model.dim()];
    let x = minimise(model, &held);
    for &i in model.integers() {
        held[i as usize] = Some(x[i as usize].round());
    }
    minimise(model, &held)
}

fn same_decisions(problem: &Problem, strategy: Strategy) {
    let model = Model::new(problem).unwrap();
    let reduced = eliminate(&model, &mut Monitor::default()).unwrap();
    let expected = match strategy {
        Strategy::Greedy => textbook_greedy(&reduced),
        _ => textbook_direct(&reduced),
    };
    let expected = reduced.expansion().expand(&expected);
    let options = Options {
        strategy,
        ..Options::default()
    };
    let solution = solve(problem, &options).unwrap();
    for (i, (x, e)) in solution.values().iter().zip(&expected).enumerate() {
        if model.integer()[i] {
            assert_eq!(*x, e.round(), "{strategy:?}: integer {i}");
        } else {
            assert!((x - e).abs() < 1e-8, "{strategy:?}: unknown {i}: {x} {e}");
        }
    }
    assert!(solution.lower_bound().unwrap() <= solution.energy());
}

#[test]
fn greedy_decides_orientation_fields_like_the_textbook() {
    for seed in 1..20 {
        let problem = crate::common::orientation_field(3 + seed as usize % 4, seed).unwrap();
        same_decisions(&problem, Strategy::Greedy);
    }
}

#[test]
fn greedy_decides_parametrizations_like_the_textbook() {
    for seed in 1..20 {
        let problem = crate::common::parametrization(4 + seed as usize % 3, seed).unwrap();
        same_decisions(&problem, Strategy::Greedy);
    }
}

#[test]
fn direct_rounds_the_relaxation_once() {
    for seed in 1..20 {
        same_decisions(
            &crate::common::orientation_field(5, seed).unwrap(),
            Strategy::Direct,
        );
        same_decisions(
            &crate::common::parametrization(5, seed).unwrap(),
            Strategy::Direct,
        );
    }
}

#[test]
fn a_field_without_a_fixed_angle_is_decided_like_one_with_a_fixed_angle() {
    // The energy does not change when all angles turn together, so the free angle decides nothing.
    for seed in 1..10 {
        let fixed = crate::common::orientation_field(4, seed).unwrap();
        let mut free = fixed.clone();
        free.unpin(0).unwrap();
        for strategy in [Strategy::Direct, Strategy::Greedy] {
            let options = Options {
                strategy,
                ..Options::default()
            };
            let (fixed, free) = (
                solve(&fixed, &options).unwrap(),
                solve(&free, &options).unwrap(),
            );
            assert!(free.energy() > 0.1, "the field must not be smooth");
            assert!((fixed.energy() - free.energy()).abs() < 1e-9 * fixed.energy());
        }
    }
}

#[test]
fn a_larger_problem_gives_the_same_bits_every_run() {
    let problem = crate::common::parametrization(24, 7).unwrap();
    let first = solve(&problem, &Options::default()).unwrap();
    for threads in [1, 2, 4] {
        let options = Options {
            threads,
            ..Options::default()
        };
        let again = solve(&problem, &options).unwrap();
        let bits = |s: &roundel::Solution| s.values().iter().map(|x| x.to_bits()).collect();
        let (a, b): (Vec<u64>, Vec<u64>) = (bits(&first), bits(&again));
        assert_eq!(a, b);
    }
}
