//! The share of a run that is done never falls, and comes to its end.

use std::cell::RefCell;

use roundel::field::{FieldOptions, FieldProblem, solve_field};
use roundel::map::{SeamlessOptions, SeamlessProblem};
use roundel::mesh::{jitter, shape};
use roundel::monitor::{Event, EventKind, Phase, Run, Stage};
use roundel::quad::{QuadOptions, quadrangulate, solve_fold_free};
use roundel::untangle::UntangleOptions;
use roundel::{Flow, Monitor, Options, Strategy, solve, solve_with};

/// The stages and shares that a callback was told.
#[derive(Default)]
struct Told(RefCell<Vec<(Stage, f64)>>);

impl Told {
    fn take(&self, event: &Event) -> Flow {
        self.0.borrow_mut().push((event.stage, event.share));
        Flow::Continue
    }

    fn check(&self, what: &str) -> Vec<(Stage, f64)> {
        let told = self.0.take();
        assert!(told.len() > 5, "{what}: {}", told.len());
        assert!(told[0].1 < 0.2, "{what} starts at {}", told[0].1);
        for pair in told.windows(2) {
            assert!(pair[0].1 <= pair[1].1, "{what} falls: {pair:?}");
        }
        assert!(told.iter().all(|&(_, share)| share <= 1.0), "{what}");
        told
    }
}

#[test]
fn quads_go_through_their_stages_and_the_share_never_falls() {
    // One mesh of many fields, one with features, one that is refined first, one that is tried again.
    for (name, triangles) in [
        ("rounded-cube", 1_000),
        ("gear", 4_000),
        ("rounded-cube", 48),
        ("plate-with-holes", 600),
    ] {
        let mesh = shape::by_name(name, triangles).unwrap();
        let told = Told::default();
        let monitor = || Monitor::default().on_event(|event| told.take(event));
        quadrangulate(&mesh, &QuadOptions::default(), monitor).unwrap();
        let told = told.check(name);
        assert_eq!(told.last().unwrap().1, 1.0, "{name}");
        let mut stages: Vec<Stage> = told.iter().map(|t| t.0).collect();
        stages.dedup();
        let expected = [Stage::Field, Stage::Map, Stage::Quads, Stage::Smooth];
        assert!(stages.starts_with(&expected[..3]), "{name}: {stages:?}");
        assert_eq!(stages.last(), Some(&Stage::Smooth), "{name}: {stages:?}");
    }
}

#[test]
fn several_calls_of_one_run_share_its_progress() {
    let mesh = shape::by_name("torus", 2_000).unwrap();
    let (told, run) = (Told::default(), Run::new());
    let monitor = || {
        let monitor = Monitor::default().of_run(&run);
        monitor.on_event(|event| told.take(event))
    };
    let options = Options::default();
    run.next_call(0.1, 0.5);
    let (field, _) = solve_field(&mesh, &FieldOptions::default(), &options, monitor).unwrap();
    assert!((0.1..=0.5).contains(&run.share()), "{}", run.share());
    let problem = SeamlessProblem::new(&mesh, &field, &SeamlessOptions::default()).unwrap();
    run.next_call(0.5, 1.0);
    let effort = UntangleOptions::default();
    solve_fold_free(&mesh, &problem, &options, &effort, monitor).unwrap();
    let told = told.check("torus");
    assert_eq!(told.last().unwrap().1, 1.0);
    let at = told.iter().position(|t| t.0 == Stage::Map).unwrap();
    assert!(told[..at].iter().all(|t| t.0 == Stage::Field && t.1 <= 0.5));
    assert!(told[at..].iter().all(|t| t.0 == Stage::Map && t.1 >= 0.5));
}

#[test]
fn the_first_answer_of_auto_is_the_relaxation_rounded_before_anything_else_is_tried() {
    let mesh = jitter(&shape::by_name("genus-2", 4_000).unwrap(), 0.1, 5).unwrap();
    let field = FieldProblem::with_options(&mesh, &FieldOptions::default()).unwrap();
    let direct = Options {
        strategy: Strategy::Direct,
        ..Options::default()
    };
    let direct = solve(field.problem(), &direct).unwrap().energy();
    let (mut first, mut is_rounding) = (None, false);
    let monitor = Monitor::default().on_event(|event| {
        match event.kind {
            EventKind::Improved if first.is_none() => first = Some((event.energy, is_rounding)),
            EventKind::Progress { phase, .. } => is_rounding |= phase == Phase::Round,
            _ => {}
        }
        Flow::Continue
    });
    let auto = solve_with(field.problem(), &Options::default(), monitor).unwrap();
    let (energy, was_rounding) = first.unwrap();
    assert!(!was_rounding);
    assert!(auto.energy() < 0.9 * direct);
    assert!((energy - direct).abs() < 1e-9 * direct, "{energy} {direct}");
}
