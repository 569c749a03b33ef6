//! Random small problems, solved by every strategy: no solve panics, and every solution satisfies its
//! guarantees.
#![no_main]

use libfuzzer_sys::arbitrary::{Result, Unstructured};
use libfuzzer_sys::fuzz_target;
use roundel::{Options, Problem, SolveStatus, Solver, Strategy, Triangle};

fuzz_target!(|bytes: &[u8]| {
    let _ = run(&mut Unstructured::new(bytes));
});

fn run(u: &mut Unstructured) -> Result<()> {
    let options = Options {
        strategy: *u.choose(&Strategy::ALL)?,
        nodes: 500,
        beam_width: 4,
        exact_integers: u.int_in_range(0..=4)?,
        dense_integers: u.int_in_range(0..=4)?,
        ..Options::default()
    };
    // All guarantees are checked if every number is a multiple of 1/2, otherwise only the basic ones.
    let halves = u.ratio(3u8, 4u8)?;
    let n = u.int_in_range(1..=6)?;
    let mut problem = Problem::new(n).expect("a few variables");
    while !u.is_empty() {
        let _ = part(u, &mut problem, n, halves)?;
    }
    let mut solver = match Solver::new(&problem) {
        Ok(solver) => solver,
        Err(_) => return Ok(()),
    };
    let first = solver.solve(&options);
    let again = solver.solve(&options);
    assert_eq!(first.is_ok(), again.is_ok(), "a solve changes whether there is a solution");
    let Ok(solution) = first else { return Ok(()) };
    assert_eq!(solution.values().len(), n);
    assert!(solution.values().iter().all(|x| x.is_finite()));
    if solution.status() != SolveStatus::Relaxed {
        assert_eq!(solution.max_integrality_violation(), 0.0);
    }
    if halves {
        assert!(solution.max_constraint_violation() < 1e-6);
        let scale = solution.energy().abs().max(1e3);
        let bound = solution.lower_bound().unwrap_or(f64::NEG_INFINITY);
        assert!(solution.energy() >= bound - 1e-6 * scale, "below its bound");
        let proved = solution.status() == SolveStatus::Optimal;
        assert!(!proved || solution.energy() <= bound + 1e-6 * scale, "proved, above its bound");
    }
    Ok(())
}

/// Adds a part to the problem. A part that is refused changes nothing.
fn part(u: &mut Unstructured, p: &mut Problem, n: usize, halves: bool) -> Result<roundel::Result<()>> {
    Ok(match u.int_in_range(0..=6)? {
        0 => {
            let (i, j) = (u.int_in_range(0..=n)?, u.int_in_range(0..=n)?);
            p.add_quadratic_triplets(Triangle::Lower, &[i.max(j)], &[i.min(j)], &[number(u, halves)?])
        }
        1 => p.add_linear_term(u.int_in_range(0..=n)?, number(u, halves)?),
        2 | 3 => {
            let (indices, values) = row(u, n, halves)?;
            let rhs = number(u, halves)?;
            p.add_least_squares(&indices, &values, rhs, number(u, halves)?.abs())
                .map(drop)
        }
        4 => {
            let (indices, values) = row(u, n, halves)?;
            p.add_constraint(&indices, &values, number(u, halves)?).map(drop)
        }
        5 => p.set_integers(&[u.int_in_range(0..=n)?]),
        _ => p.pin(u.int_in_range(0..=n)?, number(u, halves)?),
    })
}

fn row(u: &mut Unstructured, n: usize, halves: bool) -> Result<(Vec<usize>, Vec<f64>)> {
    let count = u.int_in_range(0..=4)?;
    let mut entries = (Vec::new(), Vec::new());
    for _ in 0..count {
        entries.0.push(u.int_in_range(0..=n)?);
        entries.1.push(number(u, halves)?);
    }
    Ok(entries)
}

/// A multiple of 1/2 from -8 to 8, or any 64 bits.
fn number(u: &mut Unstructured, halves: bool) -> Result<f64> {
    if halves || u.arbitrary()? {
        Ok(f64::from(u.int_in_range(-16i8..=16)?) / 2.0)
    } else {
        u.arbitrary()
    }
}
