//! Rows, bounds and integers against exact rational arithmetic: the status, the energy and the bound are
//! right, and rows and bounds that are named as contradictory are so.
//!
//! Each kind of problem is tried a hundred times or more here, and 35,000 problems in a test that is ignored by
//! default.

mod check;
mod instance;
mod kinds;
mod lazy;
mod lcp;
mod oracle;
#[path = "../common/random.rs"]
#[allow(dead_code)] // Generators of other tests.
mod random;
#[path = "../certificate/rational.rs"]
#[allow(dead_code)] // The search for the least energy, which has no rows.
mod rational;
mod shared;
#[path = "../common/skip.rs"]
#[allow(dead_code)] // What a machine with CI has to have.
mod skip;

use check::{Tally, check, check_disguised, check_not_convex};
use kinds::KINDS;
use roundel::{Error, Options, Problem, Strategy, solve};

/// Panics after all seeds, with the first faults.
fn check_all(name: &str, seeds: std::ops::Range<u64>) -> Tally {
    let (_, kind) = KINDS.iter().find(|(of, _)| *of == name).unwrap();
    let mut tally = Tally::default();
    let mut faults = Vec::new();
    for seed in seeds.clone() {
        let of = kind(seed);
        let right = match name {
            "not convex" => check_not_convex(&of, &mut tally),
            _ => check(&of, &mut tally).and_then(|()| check_disguised(&of, seed)),
        };
        if let Err(fault) = right {
            faults.push(format!("{name}, seed {seed}: {fault}"));
        }
    }
    let first = faults.iter().take(12).cloned().collect::<Vec<_>>();
    let (count, first) = (faults.len(), first.join("\n"));
    assert!(
        faults.is_empty(),
        "{count} of {seeds:?}, {tally:?}\n{first}"
    );
    tally
}

/// The number of problems of a kind. Exact arithmetic takes half a second to see that one has no point.
fn seeds(name: &str) -> u64 {
    match name {
        "contradictory" | "integrality" | "defined" => 120,
        _ => 400,
    }
}

/// A test for each kind. The oracle decides nearly all problems, except where integers have no bound and the
/// objective does not hold them, and the kind is what its name says.
macro_rules! kinds {
    ($($test:ident: $name:literal, $holds:expr;)*) => {
        $(
            #[test]
            fn $test() {
                let tally = check_all($name, 0..seeds($name));
                let few = if $name == "unbounded" { 200 } else { 4 };
                assert!(tally.undecided <= few, "{tally:?}");
                let holds: fn(&Tally) -> bool = $holds;
                assert!(holds(&tally), "{tally:?}");
            }
        )*

        /// 35,000 problems, with a test for each kind, so that a fault in one does not hide the others.
        mod many {
            $(
                #[test]
                #[ignore = "1,539 problems in exact arithmetic: minutes"]
                fn $test() {
                    let tally = super::check_all($name, 1_000..2_539);
                    eprintln!("{}: {tally:?}", $name);
                }
            )*
        }
    };
}

kinds! {
    bounds_are_kept: "bounds", |t| t.optimal == 400;
    two_sided_rows_are_kept: "ranges", |t| t.optimal > 350;
    constraints_are_kept: "equalities", |t| t.optimal > 300;
    integers_without_bounds_are_decided: "free integers", |t| t.optimal > 300;
    objectives_without_curvature_are_decided: "linear", |t| t.optimal > 200;
    objectives_of_less_than_full_rank_are_decided: "singular", |t| t.optimal > 200;
    contradictions_are_found_and_named: "contradictory", |t| t.infeasible > 50 && t.minimal > 40;
    gaps_between_integers_are_found_and_named: "integrality", |t| t.infeasible > 50;
    energies_that_fall_for_ever_are_found: "unbounded", |t| t.unbounded > 50;
    degenerate_vertices_are_decided: "degenerate", |t| t.optimal > 200;
    large_coefficients_are_decided: "large", |t| t.optimal > 200;
    pins_are_kept: "pinned", |t| t.optimal > 150;
    what_curves_downwards_is_refused: "not convex", |t| t.not_convex > 200;
    flows_are_decided: "flows", |t| t.optimal > 300;
    switches_are_decided: "switches", |t| t.optimal > 300;
    lots_are_decided: "lots", |t| t.optimal > 300;
    lattices_are_decided: "lattices", |t| t.optimal > 300;
    what_may_move_for_ever_is_decided: "translated", |t| t.optimal > 200 && t.infeasible > 20;
    integers_far_from_zero_are_decided: "far", |t| t.optimal > 200;
    units_do_not_matter: "units", |t| t.optimal > 200;
    sums_that_have_names_are_decided: "defined", |t| t.optimal > 60 && t.infeasible > 20;
    binaries_are_decided: "binaries", |t| t.optimal > 200;
    problems_side_by_side_are_decided: "pairs", |t| t.optimal > 200;
}

/// `2 x0 - 2 x1 + 4 x2` is even, and a real number between 1/2 and 3/2 is to be the same.
#[test]
fn a_search_that_finds_no_point_ends_at_the_limit_of_nodes() {
    let mut problem = Problem::new(4).unwrap();
    let row = [2.0, -2.0, 4.0, -1.0];
    problem
        .add_inequality(&[0, 1, 2, 3], &row, 0.0, 0.0)
        .unwrap();
    problem.set_bounds(&[3], &[0.5], &[1.5]).unwrap();
    problem.set_integers(&[0, 1, 2]).unwrap();
    for j in 0..4 {
        problem.add_least_squares(&[j], &[1.0], 0.3, 1.0).unwrap();
    }
    for strategy in [Strategy::Auto, Strategy::Exact, Strategy::Direct] {
        let options = Options {
            strategy,
            nodes: 50,
            ..Options::default()
        };
        let error = solve(&problem, &options).unwrap_err();
        assert_eq!(error, Error::SearchLimit { what: "nodes" });
    }
}

/// Customers with squares of their shares, each share switched on by its place.
fn places(customers: usize, places: usize) -> Problem {
    let mut problem = Problem::new((customers + 1) * places).unwrap();
    let open = |j: usize| customers * places + j;
    for i in 0..customers {
        let shares: Vec<usize> = (0..places).map(|j| i * places + j).collect();
        let ones = vec![1.0; places];
        problem.add_inequality(&shares, &ones, 1.0, 1.0).unwrap();
        for (j, &x) in shares.iter().enumerate() {
            let cost = 1.0 + (1.7 * (i * places + j) as f64).sin().abs();
            problem.add_least_squares(&[x], &[1.0], 0.0, cost).unwrap();
            problem
                .add_inequality(&[x, open(j)], &[1.0, -1.0], f64::NEG_INFINITY, 0.0)
                .unwrap();
            problem.set_bounds(&[x], &[0.0], &[1.0]).unwrap();
        }
    }
    for j in 0..places {
        problem.add_linear_term(open(j), 1.0).unwrap();
    }
    problem
}

#[test]
fn squares_that_are_switched_on_have_the_bound_of_their_perspective() {
    let (customers, count) = (6, 6);
    let binaries: Vec<usize> = (customers * count..(customers + 1) * count).collect();
    let mut real = places(customers, count);
    real.set_bounds(&binaries, &vec![0.0; count], &vec![1.0; count])
        .unwrap();
    let relaxed = solve(&real, &Options::default()).unwrap().energy();
    let mut problem = places(customers, count);
    problem.set_binaries(&binaries).unwrap();
    let exact = |nodes| Options {
        strategy: Strategy::Exact,
        nodes,
        ..Options::default()
    };
    let least = solve(&problem, &exact(usize::MAX)).unwrap().energy();
    let first = solve(&problem, &exact(1)).unwrap();
    let bound = first.lower_bound().unwrap();
    let gaps = [least - relaxed, least - bound];
    assert!(gaps[1] > -1e-9 && gaps[1] < 0.5 * gaps[0], "{gaps:?}");
}

#[test]
fn sides_that_are_integers_but_for_rounding_errors_hold_these_integers() {
    // Capacities that are on are to be a tenth more than 900: in floating-point numbers, a little more than 990.
    let demand = 1.1 * 900.0;
    assert!(demand > 990.0);
    let capacities = [455.0, 455.0, 80.0, 85.0];
    let mut problem = Problem::new(5).unwrap();
    problem.set_binaries(&[0, 1, 2, 3]).unwrap();
    problem.add_linear(&[10.0, 10.0, 2.0, 3.0, 0.0]).unwrap();
    let all = f64::INFINITY;
    problem
        .add_inequality(&[0, 1, 2, 3], &capacities, demand, all)
        .unwrap();
    // `0.1 x = 0.3` for an integer: the quotient is 2.9999999999999996.
    problem.set_integers(&[4]).unwrap();
    problem.add_inequality(&[4], &[0.1], 0.3, 0.3).unwrap();
    let options = Options {
        strategy: Strategy::Exact,
        ..Options::default()
    };
    let solution = solve(&problem, &options).unwrap();
    assert_eq!(solution.values(), [1.0, 1.0, 1.0, 0.0, 3.0]);
}

#[test]
fn rows_that_come_during_the_search_count_like_those_before_it() {
    let (mut solved, mut without, mut relaxed) = (0, 0, 0);
    // What may move for ever does so until rows hold it, and which ones come is not known.
    let is_tried = |name: &str| !matches!(name, "unbounded" | "not convex" | "translated");
    for (name, kind) in KINDS.iter().filter(|(name, _)| is_tried(name)) {
        for seed in 0..60 {
            let checked = lazy::check(&kind(seed), seed);
            let (found, shown) =
                checked.unwrap_or_else(|fault| panic!("{name}, seed {seed}: {fault}"));
            solved += usize::from(found == Some(true));
            without += usize::from(found == Some(false));
            relaxed += shown;
        }
    }
    assert!(solved > 300 && without > 30, "{solved}, {without}");
    assert!(relaxed > 100, "{relaxed}");
    lazy::check_late_row();
}
