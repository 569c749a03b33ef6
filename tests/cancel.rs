//! Cancelling a solve from another thread, at any moment of any phase.

use std::time::{Duration, Instant};

use roundel::field::{FieldProblem, curvature_constraints};
use roundel::mesh::{jitter, shape};
use roundel::monitor::EventKind;
use roundel::{
    CancelToken, Error, Event, Flow, Monitor, Options, Problem, SolveStatus, Solver, Strategy,
    WarmStart, solve, solve_with,
};

fn field(triangles: usize) -> Problem {
    let mesh = shape::by_name("torus", triangles).unwrap();
    let mesh = jitter(&mesh, 1e-3, 3).unwrap();
    let constraints = curvature_constraints(&mesh, 0.02).unwrap();
    let field = FieldProblem::new(&mesh, &constraints).unwrap();
    field.problem().clone()
}

/// How a cancelled solve ended, and how long after the request.
struct Ended {
    requested: Duration,
    latency: Duration,
    solved: bool,
}

/// Solves, cancels after `delay`, and checks the properties of a cancelled result.
fn cancelled_after(problem: &Problem, options: &Options, delay: Duration) -> Ended {
    let token = CancelToken::new();
    let from_outside = token.clone();
    let canceller = std::thread::spawn(move || {
        std::thread::sleep(delay);
        from_outside.cancel();
        Instant::now()
    });
    let result = solve_with(problem, options, Monitor::default().cancel_token(token));
    let ended = Instant::now();
    let requested = canceller.join().unwrap();
    match &result {
        Ok(solution) => {
            assert!(solution.max_integrality_violation() == 0.0);
            assert!(solution.max_constraint_violation() < 1e-9);
            assert!(solution.energy().is_finite());
            let cut_short = solution.status() == SolveStatus::Cancelled;
            assert!(cut_short || ended <= requested || solution.status() != SolveStatus::Limit);
        }
        Err(error) => assert!(matches!(error, Error::Cancelled), "{error}"),
    }
    Ended {
        requested: delay,
        latency: ended.saturating_duration_since(requested),
        solved: result.is_ok(),
    }
}

fn strategies() -> impl Iterator<Item = Options> {
    let searching = Strategy::ALL.into_iter().filter(|s| *s != Strategy::Relax);
    searching.map(|strategy| Options {
        strategy,
        exact_integers: 0,
        ..Options::default()
    })
}

#[test]
fn a_cancelled_solve_is_a_valid_solution_or_a_typed_error() {
    let problem = field(4_000);
    for options in strategies() {
        let started = Instant::now();
        solve(&problem, &options).unwrap();
        let whole = started.elapsed();
        let mut early = 0;
        for step in 0..12 {
            let ended = cancelled_after(&problem, &options, whole.mul_f64(f64::from(step) / 12.0));
            early += usize::from(!ended.solved);
        }
        assert!(
            early > 0,
            "no solve was cancelled before its first solution"
        );
    }
}

/// The first improvement that a warm start reports is the earlier solution, before the search begins.
#[test]
fn a_cancelled_warm_start_returns_the_earlier_solution() {
    let problem = field(1_000);
    for options in strategies() {
        let options = Options {
            nodes: 10_000,
            ..options
        };
        let mut solver = Solver::new(&problem).unwrap();
        let earlier = solver.solve(&options).unwrap();
        let again = Options {
            warm_start: WarmStart::Offer,
            ..options
        };
        let stop = |event: &Event| match event.kind {
            EventKind::Improved => Flow::Cancel,
            _ => Flow::Continue,
        };
        let solution = solver.solve_with(&again, Monitor::default().on_event(stop));
        let kept = solution.unwrap();
        assert_eq!(kept.values(), earlier.values());
        assert_eq!(kept.status(), SolveStatus::Cancelled);
    }
}

/// The promised latency, at a size where cancelling is not trivial. Run it alone on a quiet machine:
/// `cargo test --release --test cancel -- --ignored --nocapture`.
#[test]
#[ignore = "takes a minute and a quiet machine"]
fn at_200_000_triangles_cancelling_takes_at_most_100_milliseconds() {
    let problem = field(200_000);
    let mut late = Vec::new();
    for options in strategies() {
        let started = Instant::now();
        // Exact greedy takes minutes to decide 100,000 integers. Only its first seconds are tested.
        let horizon = Options {
            time_limit: 8.0,
            ..options.clone()
        };
        let factoring = solve(&problem, &horizon).unwrap().seconds().factor;
        let whole = started.elapsed();
        println!("{:9} factors for {factoring:.2} s", options.strategy.name());
        for step in 0..16 {
            let delay = whole.mul_f64((f64::from(step) + 0.5) / 16.0);
            let ended = cancelled_after(&problem, &options, delay);
            // Factorizations come before the first solution and cannot be interrupted.
            let factoring = if ended.solved { 0.0 } else { factoring };
            if ended.latency.as_secs_f64() > 0.1 + factoring {
                late.push((options.strategy.name(), ended.requested, ended.latency));
            }
            println!(
                "{:9} of {whole:.2?} cancelled at {:.2?}: {:.0?} later, {}",
                options.strategy.name(),
                ended.requested,
                ended.latency,
                if ended.solved { "a solution" } else { "none" },
            );
        }
    }
    assert!(late.is_empty(), "{late:?}");
}
