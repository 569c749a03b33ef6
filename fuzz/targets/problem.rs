//! Small problems of any make, solved by every strategy: never a panic, and what is called a
//! solution is one.
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
    // Of numbers that are tame, everything is promised; of all others, only that nothing breaks.
    let tame = u.ratio(3u8, 4u8)?;
    let n = u.int_in_range(1..=6)?;
    let mut problem = Problem::new(n).expect("a few variables");
    while !u.is_empty() {
        let _ = part(u, &mut problem, n, tame)?;
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
    if tame {
        assert!(solution.max_constraint_violation() < 1e-6);
        let scale = solution.energy().abs().max(1e3);
        let bound = solution.lower_bound().unwrap_or(f64::NEG_INFINITY);
        assert!(solution.energy() >= bound - 1e-6 * scale, "below its bound");
        let proved = solution.status() == SolveStatus::Optimal;
        assert!(!proved || solution.energy() <= bound + 1e-6 * scale, "proved, above its bound");
    }
    Ok(())
}

/// Adds a part; one that is refused changes nothing.
fn part(u: &mut Unstructured, p: &mut Problem, n: usize, tame: bool) -> Result<roundel::Result<()>> {
    Ok(match u.int_in_range(0..=6)? {
        0 => {
            let (i, j) = (u.int_in_range(0..=n)?, u.int_in_range(0..=n)?);
            p.add_quadratic_triplets(Triangle::Lower, &[i.max(j)], &[i.min(j)], &[number(u, tame)?])
        }
        1 => p.add_linear_term(u.int_in_range(0..=n)?, number(u, tame)?),
        2 | 3 => {
            let (indices, values) = row(u, n, tame)?;
            let rhs = number(u, tame)?;
            p.add_least_squares(&indices, &values, rhs, number(u, tame)?.abs())
                .map(drop)
        }
        4 => {
            let (indices, values) = row(u, n, tame)?;
            p.add_constraint(&indices, &values, number(u, tame)?).map(drop)
        }
        5 => p.set_integers(&[u.int_in_range(0..=n)?]),
        _ => p.pin(u.int_in_range(0..=n)?, number(u, tame)?),
    })
}

fn row(u: &mut Unstructured, n: usize, tame: bool) -> Result<(Vec<usize>, Vec<f64>)> {
    let count = u.int_in_range(0..=4)?;
    let mut entries = (Vec::new(), Vec::new());
    for _ in 0..count {
        entries.0.push(u.int_in_range(0..=n)?);
        entries.1.push(number(u, tame)?);
    }
    Ok(entries)
}

/// Halves from -8 to 8, or any 64 bits.
fn number(u: &mut Unstructured, tame: bool) -> Result<f64> {
    if tame || u.arbitrary()? {
        Ok(f64::from(u.int_in_range(-16i8..=16)?) / 2.0)
    } else {
        u.arbitrary()
    }
}
