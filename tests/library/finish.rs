//! A run that the caller wants finished: whatever the moment, there is a result from the first integers on.

use std::cell::Cell;
use std::time::{Duration, Instant};

use roundel::field::{FieldOptions, FieldProblem, solve_field};
use roundel::map::{SeamlessOptions, SeamlessProblem};
use roundel::mesh::{TriangleMesh, jitter, shape};
use roundel::monitor::{EventKind, Phase};
use roundel::quad::{QuadOptions, Quadrangulation, quadrangulate, solve_fold_free};
use roundel::untangle::UntangleOptions;
use roundel::{
    CancelToken, Error, Flow, Monitor, Options, Result, SolveStatus, StoppedBy, Strategy,
    solve_with,
};

/// A shape that is tried several times: with features, folds, and other fields.
fn gear() -> TriangleMesh {
    shape::by_name("gear", 2_000).unwrap()
}

/// What the callback of a run has seen.
#[derive(Default)]
struct Seen {
    events: Cell<usize>,
    solved: Cell<bool>,
}

/// Quads of a run whose callback gives this answer from the event `at` on.
fn quads_ended_at(mesh: &TriangleMesh, at: usize, flow: Flow) -> (Result<Quadrangulation>, Seen) {
    let seen = Seen::default();
    let monitor = || {
        Monitor::default().on_event(|event| {
            let before = seen.events.replace(seen.events.get() + 1);
            if before < at && event.kind == EventKind::Improved {
                seen.solved.set(true);
            }
            if before >= at {
                return flow;
            }
            Flow::Continue
        })
    };
    let made = quadrangulate(mesh, &QuadOptions::default(), monitor);
    (made, seen)
}

#[test]
fn quads_are_finished_at_any_moment_after_the_first_integers() {
    let mesh = gear();
    let (whole, seen) = quads_ended_at(&mesh, usize::MAX, Flow::Finish);
    let (whole, count) = (whole.unwrap(), seen.events.get());
    assert!(whole.quads.is_conforming() && count > 20, "{count}");
    let mut finished = 0;
    for moment in 0..10 {
        let (made, seen) = quads_ended_at(&mesh, moment * count / 10, Flow::Finish);
        match made {
            Ok(made) => {
                assert!(made.quads.faces().next().is_some());
                finished += 1;
            }
            // There was nothing to finish.
            Err(error) => {
                assert_eq!(error, Error::Cancelled);
                assert!(!seen.solved.get(), "lost at moment {moment}");
            }
        }
    }
    assert!(finished >= 8, "{finished}");
}

#[test]
fn a_run_that_is_cancelled_instead_has_no_result() {
    let mesh = gear();
    let (_, seen) = quads_ended_at(&mesh, usize::MAX, Flow::Continue);
    let (made, _) = quads_ended_at(&mesh, seen.events.get() / 2, Flow::Cancel);
    assert_eq!(made.err(), Some(Error::Cancelled));
}

#[test]
fn a_token_that_is_set_before_the_start_leaves_nothing_to_finish() {
    let token = CancelToken::new();
    token.finish();
    let monitor = || Monitor::default().cancel_token(token.clone());
    let made = quadrangulate(&gear(), &QuadOptions::default(), monitor);
    assert_eq!(made.err(), Some(Error::Cancelled));
    token.reset();
    assert!(!token.is_finishing());
}

#[test]
fn a_time_at_which_to_finish_is_a_time_limit() {
    let mesh = gear();
    let first = Cell::new(None);
    let monitor = || {
        let monitor = Monitor::default().on_event(|event| {
            if event.kind == EventKind::Improved && first.get().is_none() {
                first.set(Some(Instant::now()));
            }
            Flow::Continue
        });
        match first.get() {
            Some(time) => monitor.finish_at(time),
            None => monitor.finish_at(Instant::now() + Duration::from_secs(3_600)),
        }
    };
    let made = quadrangulate(&mesh, &QuadOptions::default(), monitor).unwrap();
    assert!(made.quads.faces().next().is_some());
    assert_eq!(made.solution.status(), SolveStatus::Limit);
    assert_eq!(made.solution.stopped_by(), StoppedBy::Time);
    let late = || Monitor::default().finish_at(Instant::now());
    let made = quadrangulate(&mesh, &QuadOptions::default(), late);
    assert_eq!(made.err(), Some(Error::TimeLimit));
}

#[test]
fn a_map_without_folds_is_finished_with_the_integers_of_its_first_solve() {
    let mesh = shape::by_name("rounded-cube", 2_000).unwrap();
    let options = Options::default();
    let (field, _) =
        solve_field(&mesh, &FieldOptions::default(), &options, Monitor::default).unwrap();
    let problem = SeamlessProblem::new(&mesh, &field, &SeamlessOptions::default()).unwrap();
    let monitor = || {
        Monitor::default().on_event(|event| match event.kind {
            EventKind::Improved => Flow::Finish,
            _ => Flow::Continue,
        })
    };
    let effort = UntangleOptions::default();
    let made = solve_fold_free(&mesh, &problem, &options, &effort, monitor).unwrap();
    assert_eq!(made.solution.status(), SolveStatus::Cancelled);
    assert_eq!((made.rounds, made.refinements, made.gradings), (0, 0, 0));
    assert_eq!(made.untangled.flipped_before, made.untangled.flipped_after);
}

#[test]
fn a_single_solve_that_is_finished_keeps_its_best_solution() {
    let mesh = shape::by_name("torus", 800).unwrap();
    let field = FieldProblem::with_options(&mesh, &FieldOptions::default()).unwrap();
    let monitor = Monitor::default().on_event(|event| match event.kind {
        EventKind::Improved => Flow::Finish,
        _ => Flow::Continue,
    });
    let solution = solve_with(field.problem(), &Options::default(), monitor).unwrap();
    assert_eq!(solution.status(), SolveStatus::Cancelled);
    assert_eq!(solution.max_integrality_violation(), 0.0);
}

#[test]
fn a_field_that_is_finished_at_once_loses_less_than_half_of_what_direct_rounding_loses() {
    let mesh = shape::by_name("genus-2", 10_000).unwrap();
    let mesh = jitter(&mesh, 0.1, 5).unwrap();
    let field = FieldProblem::with_options(&mesh, &FieldOptions::default()).unwrap();
    let energy = |strategy, flow| {
        let options = Options {
            strategy,
            ..Options::default()
        };
        let monitor = Monitor::default().on_event(|event| match event.kind {
            EventKind::Progress {
                phase: Phase::Round,
                ..
            } => flow,
            _ => Flow::Continue,
        });
        let solution = solve_with(field.problem(), &options, monitor).unwrap();
        assert_eq!(solution.max_integrality_violation(), 0.0);
        solution.energy()
    };
    let whole = energy(Strategy::Adaptive, Flow::Continue);
    let finished = energy(Strategy::Adaptive, Flow::Finish);
    let direct = energy(Strategy::Direct, Flow::Continue);
    assert!(
        finished - whole < 0.5 * (direct - whole),
        "{whole} {finished} {direct}"
    );
}
