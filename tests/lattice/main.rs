//! The lattice strategies: their optima and bounds, compared with enumeration in exact arithmetic.

#[path = "../common/mod.rs"]
mod common;

mod checker;
mod instance;
mod strategies;

use checker::{Exact, holds};
use instance::{Instance, Kind};
use roundel::{Options, SolveStatus, Strategy, solve};

/// Solves instances of `kind` and returns how many were proved optimal.
fn check(kind: Kind, count: usize) -> usize {
    let options = Options {
        strategy: Strategy::Exact,
        ..Options::default()
    };
    let mut proved = 0;
    let mut seed = 0;
    for _ in 0..count {
        let (instance, least) = loop {
            seed += 1;
            let instance = Instance::random(kind, seed);
            if let Some(least) = checker::least_energy(&instance) {
                break (instance, least);
            }
        };
        let solution = solve(&instance.problem().unwrap(), &options).unwrap();
        let at = instance.energy_at(solution.values());
        assert!(
            at.close_to(least, 1e-9),
            "{kind:?} {seed}: {} instead of {}",
            at.value(),
            least.value()
        );
        assert!(at.close_to(Exact::whole(solution.energy()), 1e-9));
        let bound = solution.lower_bound().unwrap();
        assert!(holds(bound, least), "{kind:?} {seed}: {bound} {least:?}");
        let raised = bound.max(least.value()) + 1e-6 * least.value().max(1.0);
        assert!(!holds(raised, least));
        let gap = solution.gap().unwrap();
        let honest = kind == Kind::IllConditioned || gap < 1e-6;
        assert!(honest, "{kind:?} {seed}: {gap}");
        proved += usize::from(solution.status() == SolveStatus::Optimal);
    }
    proved
}

#[test]
fn definite_instances_are_solved_and_proved() {
    assert_eq!(check(Kind::Definite, 400), 400);
}

#[test]
fn ill_conditioned_instances_are_solved_and_most_are_proved() {
    // Where the model's own rounding exceeds the tolerance of a proof, a gap remains.
    let proved = check(Kind::IllConditioned, 400);
    assert!(proved >= 200, "{proved}");
}

#[test]
fn semi_definite_instances_are_solved_and_nearly_all_are_proved() {
    let proved = check(Kind::SemiDefinite, 500);
    assert!(proved >= 490, "{proved}");
}

#[test]
fn constrained_instances_are_solved_and_proved() {
    assert_eq!(check(Kind::Constrained, 500), 500);
}

#[test]
fn instances_with_equal_optima_are_solved_and_proved() {
    assert_eq!(check(Kind::EqualOptima, 200), 200);
}
