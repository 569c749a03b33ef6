//! Shared mixed-integer quadratic programs, where they are present: the optima that other solvers have proved.

use std::path::Path;

use roundel::problem::mps;
use roundel::{Options, SolveStatus, Strategy, solve};

use crate::skip::skip;

/// Programs that take no more than a moment, and their optima. Where unknowns of `watercontamination0202r` have no
/// curvature, points without corrections miss active rows by so much that no point seems to be within all limits.
const OPTIMA: [(&str, f64); 5] = [
    ("hybriddynamic_fixed", 1.473_777_777_778),
    ("meanvarx", 14.369_232_114_8),
    ("mpc_valve_n10", 44.733_092_741_8),
    ("slay05m", 22_664.678_654_68),
    ("watercontamination0202r", 97.904_436_770_4),
];

#[test]
fn optima_are_those_of_other_solvers() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../shared/miqp");
    if !folder.exists() {
        return skip("the shared programs are not there");
    }
    for (name, energy) in OPTIMA {
        let program = mps::read(&folder.join(format!("{name}.mps.gz"))).unwrap();
        let options = Options {
            strategy: Strategy::Exact,
            ..Options::default()
        };
        let found = solve(program.problem(), &options).unwrap();
        assert_eq!(found.status(), SolveStatus::Optimal, "{name}");
        let error = (found.energy() - energy).abs() / energy;
        assert!(error < 1e-9, "{name}: {}", found.energy());
    }
}
