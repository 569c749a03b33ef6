//! Proofs: those of random problems are accepted and prove the exact optimum, and planted lies are refused.

mod altered;
#[path = "../branch/check.rs"]
#[allow(dead_code)] // The checks of solutions without a proof.
mod check;
#[path = "../branch/instance.rs"]
#[allow(dead_code)] // Disguises.
mod instance;
#[path = "../branch/kinds.rs"]
mod kinds;
#[path = "../branch/lcp.rs"]
mod lcp;
mod lies;
#[path = "../branch/oracle.rs"]
#[allow(dead_code)] // What real unknowns alone allow.
mod oracle;
mod planted;
mod planted_gains;
mod planted_lattices;
mod planted_translations;
#[path = "../common/random.rs"]
#[allow(dead_code)] // Generators of other tests.
mod random;
#[path = "../certificate/rational.rs"]
#[allow(dead_code)] // The search for the least energy, which has no rows.
mod rational;
mod reach;
mod stated;

use instance::Instance;
use kinds::KINDS;
use oracle::{Truth, truth};
use rational::exact;
use roundel::proof::check_of;
use roundel::{Error, Monitor, Options, Problem, Proof, Proved, solve_with_proof};

/// The time for a problem. Other than endless ones take milliseconds.
const SECONDS: f64 = 20.0;

/// A bound is this close to the optimum, as a part of the sizes of the terms.
const CLOSE: f64 = 1e-7;

fn prove(problem: &Problem) -> Result<Proved, Error> {
    let options = Options {
        time_limit: SECONDS,
        ..Options::default()
    };
    solve_with_proof(problem, &options, Monitor::default())
}

/// The proof, which nothing stopped.
fn made(proved: &Proved) -> &Proof {
    proved.proof.as_ref().unwrap()
}

fn text(proof: &Proof) -> Vec<u8> {
    let mut text = Vec::new();
    proof.write(&mut text).unwrap();
    text
}

/// What became of the problems of a kind.
#[derive(Default, Debug)]
struct Tally {
    /// The bound is the optimum, or it is proved that there is no point.
    proved: usize,
    empty: usize,
    /// The bound is true, and below the optimum.
    weak: usize,
    /// There is a typed error in place of a proof.
    unproved: usize,
    /// The energy falls for ever, or curves downwards.
    other: usize,
    /// Integers without bounds have no point, or none that is found, and the search does not end.
    endless: usize,
}

fn has_integer_without_bound(of: &Instance) -> bool {
    let is_open = |j: usize| {
        let (lower, upper) = of.limits(j);
        of.integer[j] && (lower.is_infinite() || upper.is_infinite())
    };
    (0..of.unknowns()).any(is_open)
}

/// Holds the proof of an instance against the exact answer.
fn hold(of: &Instance, tally: &mut Tally) -> Result<(), String> {
    let problem = of.problem();
    let proved = match prove(&problem) {
        Ok(proved) => proved,
        Err(Error::NotSupported { .. }) => {
            tally.unproved += 1;
            return Ok(());
        }
        Err(error) if matches!(error.code(), "unbounded" | "not_convex") => {
            tally.other += 1;
            return Ok(());
        }
        Err(Error::TimeLimit) if has_integer_without_bound(of) => {
            tally.endless += 1;
            return Ok(());
        }
        Err(error) => return Err(error.to_string()),
    };
    let proof = match &proved.proof {
        Ok(proof) => proof,
        Err(_) if has_integer_without_bound(of) => {
            tally.endless += 1;
            return Ok(());
        }
        Err(stopped) => return Err(format!("stopped by {}", stopped.name())),
    };
    let verdict = check_of(&problem, text(proof).as_slice());
    let verdict = verdict.map_err(|fault| format!("refused: {fault}"))?;
    if (verdict.energy, verdict.lower_bound) != (proof.energy(), proof.lower_bound()) {
        return Err(format!("{verdict:?} is not what the proof says"));
    }
    match (verdict.lower_bound, truth(of)) {
        (None, Truth::Infeasible | Truth::NothingNear | Truth::TooLarge) => tally.empty += 1,
        (Some(_), Truth::TooLarge) => tally.proved += 1,
        (Some(bound), Truth::Optimum(optimum)) => {
            if exact(bound) > optimum {
                return Err(format!(
                    "a bound of {bound} above {}",
                    check::float(&optimum)
                ));
            }
            let values = verdict.values.unwrap();
            let size = of.energy_size(&values).max(1.0);
            let is_weak = check::float(&optimum) - bound > CLOSE * size;
            tally.weak += usize::from(is_weak);
            tally.proved += usize::from(!is_weak);
        }
        (bound, truth) => return Err(format!("{bound:?} is proved: {truth:?}")),
    }
    Ok(())
}

fn hold_all(name: &str, seeds: std::ops::Range<u64>) -> Tally {
    let (_, kind) = KINDS.iter().find(|(of, _)| *of == name).unwrap();
    let mut tally = Tally::default();
    for seed in seeds {
        let endless = tally.endless;
        if let Err(fault) = hold(&kind(seed), &mut tally) {
            panic!("{name}, seed {seed}: {fault}");
        }
        if tally.endless > endless {
            eprintln!("{name}, seed {seed}: endless");
        }
    }
    tally
}

/// Two tests for each kind: some problems, with the least number of proofs, and 1,539 more. Each kind
/// can be run alone, and they run side by side: `--ignored many`.
macro_rules! kinds {
    ($($test:ident: $name:literal, $least:literal;)*) => {
        $(
            #[test]
            fn $test() {
                let tally = hold_all($name, 0..150);
                let found = tally.proved + tally.empty;
                assert!(found >= $least, "{tally:?}");
                assert!(tally.weak + tally.unproved + tally.endless <= 1, "{tally:?}");
            }
        )*

        mod many {
            $(
                #[test]
                #[ignore = "1,539 proofs against exact answers: minutes"]
                fn $test() {
                    let tally = super::hold_all($name, 1_000..2_539);
                    eprintln!("{}: {tally:?}", $name);
                    assert!(tally.proved + tally.empty >= 9 * $least, "{tally:?}");
                    assert!(tally.endless <= 10, "{tally:?}");
                }
            )*
        }
    };
}

kinds! {
    bounds_are_proved: "bounds", 150;
    two_sided_rows_are_proved: "ranges", 150;
    constraints_are_proved: "equalities", 150;
    integers_without_bounds_are_proved: "free integers", 150;
    objectives_without_curvature_are_proved: "linear", 120;
    objectives_of_less_than_full_rank_are_proved: "singular", 140;
    contradictions_are_proved: "contradictory", 148;
    gaps_between_integers_are_proved: "integrality", 150;
    unknowns_without_bounds_are_proved: "unbounded", 90;
    degenerate_vertices_are_proved: "degenerate", 135;
    large_coefficients_are_proved: "large", 150;
    pins_are_proved: "pinned", 145;
    what_curves_downwards_between_fixed_integers_is_proved: "not convex", 50;
    flows_are_proved: "flows", 150;
    switches_are_proved: "switches", 150;
    lots_are_proved: "lots", 150;
    lattices_are_proved: "lattices", 145;
    what_may_move_for_ever_is_proved: "translated", 130;
    integers_far_from_zero_are_proved: "far", 130;
    other_units_are_proved: "units", 130;
    sums_that_have_names_are_proved: "defined", 130;
    binaries_are_proved: "binaries", 140;
    problems_side_by_side_are_proved: "pairs", 140;
}

#[test]
fn a_proof_changes_nothing_in_the_solution() {
    for seed in 0..50 {
        let problem = kinds::ranges(seed).problem();
        let plain = roundel::solve(&problem, &Options::default());
        let proved = prove(&problem).unwrap();
        let outcome = proved.outcome.map(|solution| solution.energy());
        let plain = plain.map(|solution| solution.energy());
        match (plain, outcome) {
            (Ok(a), Ok(b)) => assert!((a - b).abs() <= 1e-9 * a.abs().max(1.0), "{seed}: {a} {b}"),
            (a, b) => assert_eq!(a, b),
        }
    }
}

/// The proof of a lattice has no tree, and is as good as one.
#[test]
fn integers_without_rows_and_bounds_are_proved_by_their_closest_point() {
    let mut by_lattice = 0;
    for seed in 0..100 {
        let problem = kinds::lattices(seed).problem();
        let proved = prove(&problem).unwrap();
        if proved.outcome.is_err() {
            continue;
        }
        let proof = text(made(&proved));
        let verdict = check_of(&problem, proof.as_slice()).unwrap();
        let (energy, bound) = (verdict.energy.unwrap(), verdict.lower_bound.unwrap());
        let lines = String::from_utf8(proof).unwrap();
        if lines.contains("\"lattice\"") {
            assert!(!lines.contains("\"node\""));
            assert!(
                energy - bound <= 1e-7 * energy.max(1.0),
                "{seed}: {bound} {energy}"
            );
            by_lattice += 1;
        }
    }
    assert!(by_lattice >= 50, "{by_lattice}");
}

/// The bound is that of the point, which has gone on until all limits hold it.
#[test]
fn what_moves_for_ever_is_held_in_the_proof() {
    let problem = stated::translated();
    let proof = text(made(&prove(&problem).unwrap()));
    let verdict = check_of(&problem, proof.as_slice()).unwrap();
    let (bound, energy) = (verdict.lower_bound.unwrap(), verdict.energy.unwrap());
    assert!(energy - bound <= 1e-8 * energy, "{bound} {energy}");
    let values = verdict.values.unwrap();
    assert!(values[1] >= 7.0 && values[0] + values[3] >= 20.0);
    assert!(String::from_utf8(proof).unwrap().contains("translations"));
}

#[test]
fn each_part_has_cuts_of_its_own() {
    let of = |goods| {
        let problem = stated::lots(goods);
        let proof = text(made(&prove(&problem).unwrap()));
        let lines = String::from_utf8(proof.clone()).unwrap();
        let verdict = check_of(&problem, proof.as_slice()).unwrap();
        let (bound, energy) = (verdict.lower_bound.unwrap(), verdict.energy.unwrap());
        assert!(energy - bound <= 1e-8 * energy, "{bound} {energy}");
        (energy, lines.matches("\"cuts\"").count(), verdict.parts)
    };
    let (one, three) = (of(1), of(3));
    assert!(
        (three.0 - 3.0 * one.0).abs() <= 1e-12 * three.0,
        "{one:?} {three:?}"
    );
    assert_eq!([(one.1, one.2), (three.1, three.2)], [(1, 1), (3, 3)]);
}

/// Of a search that a limit of nodes has ended.
#[test]
fn a_search_that_ended_early_proves_the_bound_that_it_reached() {
    let problem = stated::many_nodes();
    let options = |nodes| Options {
        nodes,
        ..Options::default()
    };
    let bound_after = |nodes| {
        let proved = solve_with_proof(&problem, &options(nodes), Monitor::default()).unwrap();
        let verdict = check_of(&problem, text(made(&proved)).as_slice()).unwrap();
        (verdict.lower_bound.unwrap(), verdict.energy.unwrap())
    };
    let (early, _) = bound_after(3);
    let (late, energy) = bound_after(1_000_000);
    assert!(
        early < late - 1e-3 && late <= energy,
        "{early} {late} {energy}"
    );
    assert!(energy - late <= 1e-8 * energy.abs());
}

#[test]
fn a_strategy_that_proves_nothing_is_refused() {
    let options = Options {
        strategy: roundel::Strategy::Greedy,
        ..Options::default()
    };
    let error = solve_with_proof(&stated::small(), &options, Monitor::default()).unwrap_err();
    assert_eq!(error.code(), "invalid_argument");
}
