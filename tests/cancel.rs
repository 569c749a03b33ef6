//! Cancelling a solve from another thread, at any moment of any phase.

#![cfg(feature = "mesh-io")]

use std::cell::Cell;
use std::time::{Duration, Instant};

use roundel::extract::{IntegerGridMap, extract};
use roundel::field::{FieldOptions, FieldProblem, curvature_constraints, solve_field};
use roundel::map::{SeamlessOptions, SeamlessProblem};
use roundel::mesh::features::FeatureGraph;
use roundel::mesh::refine::{RefineOptions, refine};
use roundel::mesh::{io, jitter, shape};
use roundel::monitor::{EventKind, Run};
use roundel::quad::{QuadOptions, quadrangulate};
use roundel::smooth::{SmoothOptions, smooth};
use roundel::{
    CancelToken, Error, Event, Flow, Model, Monitor, Options, Problem, SolveStatus, Solver,
    Strategy, Triangle, WarmStart, solve, solve_with,
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

/// Between the first solution and the search for others there are steps that notice a request by themselves.
#[test]
fn a_proof_cancelled_near_its_first_solution_says_so() {
    let problem = field(2_000);
    let options = Options {
        strategy: Strategy::Exact,
        ..Options::default()
    };
    let first = Cell::new(None);
    let started = Instant::now();
    let stop_at_first = |event: &Event| match event.kind {
        EventKind::Improved => {
            first.set(Some(started.elapsed()));
            Flow::Cancel
        }
        _ => Flow::Continue,
    };
    let monitor = Monitor::default().on_event(stop_at_first);
    assert_eq!(
        solve_with(&problem, &options, monitor).unwrap().status(),
        SolveStatus::Cancelled
    );
    let first = first.get().unwrap();
    for step in 0..100 {
        let token = CancelToken::new();
        let from_outside = token.clone();
        let delay = first.mul_f64(0.5 + f64::from(step) / 100.0);
        let canceller = std::thread::spawn(move || {
            std::thread::sleep(delay);
            from_outside.cancel();
        });
        let result = solve_with(&problem, &options, Monitor::default().cancel_token(token));
        canceller.join().unwrap();
        match result {
            Ok(solution) => assert_eq!(solution.status(), SolveStatus::Cancelled),
            Err(error) => assert_eq!(error, Error::Cancelled),
        }
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

/// Two components that nothing couples: three integers, and `count` that are all coupled with each other.
fn two_components(count: usize) -> Problem {
    let mut problem = Problem::new(3 + count).unwrap();
    for (first, len) in [(0, 3), (3, count)] {
        let pairs = (0..len).flat_map(|i| (0..=i).map(move |j| (first + i, first + j)));
        let (rows, columns): (Vec<usize>, Vec<usize>) = pairs.unzip();
        let value = |(i, j): (&usize, &usize)| if i == j { 3.0 } else { 0.01 };
        let values: Vec<f64> = rows.iter().zip(&columns).map(value).collect();
        problem
            .add_quadratic_triplets(Triangle::Lower, &rows, &columns, &values)
            .unwrap();
    }
    let linear: Vec<f64> = (0..3 + count).map(|i| (i as f64).sin()).collect();
    problem.add_linear(&linear).unwrap();
    problem
        .set_integers(&(0..3 + count).collect::<Vec<_>>())
        .unwrap();
    problem
}

/// After the first component has its integers, the others get theirs only if that takes no time.
#[test]
fn a_cancelled_solve_does_not_round_large_components_that_are_left() {
    let options = Options {
        strategy: Strategy::Direct,
        ..Options::default()
    };
    let cancelled = |count: usize| {
        let token = CancelToken::new();
        let cancel = token.clone();
        let at_first = move |event: &Event| {
            if matches!(event.kind, EventKind::Improved) {
                cancel.cancel();
            }
            Flow::Continue
        };
        let monitor = Monitor::default().cancel_token(token).on_event(at_first);
        solve_with(&two_components(count), &options, monitor)
    };
    assert_eq!(cancelled(20).unwrap().status(), SolveStatus::Cancelled);
    assert_eq!(cancelled(700).unwrap_err(), Error::Cancelled);
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
        let made = solve(&problem, &horizon);
        assert!(matches!(made, Ok(_) | Err(Error::TimeLimit)));
        let whole = started.elapsed();
        for step in 0..16 {
            let delay = whole.mul_f64((f64::from(step) + 0.5) / 16.0);
            let ended = cancelled_after(&problem, &options, delay);
            if ended.latency > Duration::from_millis(100) {
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

/// A step that ends by itself or by the limits of the call.
type Step<'a> = Box<dyn FnMut() -> Result<(), Error> + 'a>;

/// What has no monitor ends with the call that it is a part of.
#[test]
fn steps_without_a_monitor_end_with_their_call() {
    let mesh = shape::by_name("torus", 2_000).unwrap();
    let (field, _) = solve_field(
        &mesh,
        &FieldOptions::default(),
        &Options::default(),
        Monitor::default,
    )
    .unwrap();
    let sizing = SeamlessOptions { quads: 60 };
    let map = SeamlessProblem::new(&mesh, &field, &sizing).unwrap();
    let solution = solve(map.problem(), &Options::default()).unwrap();
    let seamless = map.map(&mesh, &solution).unwrap();
    let grid = IntegerGridMap::from_seamless(&mesh, &seamless).unwrap();
    let mut quads = extract(&mesh, &grid, &mut Monitor::default()).unwrap();
    let features = FeatureGraph::none(&mesh);
    let finer = RefineOptions::new(&mesh, 0.5 * mesh.mean_edge_length(), 10_000);
    let mut steps: Vec<(&str, Step)> = vec![
        (
            "the problem of a field",
            Box::new(|| FieldProblem::new(&mesh, &[]).map(drop)),
        ),
        (
            "the problem of a map",
            Box::new(|| SeamlessProblem::new(&mesh, &field, &sizing).map(drop)),
        ),
        ("a map", Box::new(|| map.map(&mesh, &solution).map(drop))),
        (
            "defects",
            Box::new(|| map.winding_defects(&mesh, &seamless).map(drop)),
        ),
        (
            "a grid map",
            Box::new(|| IntegerGridMap::from_seamless(&mesh, &seamless).map(drop)),
        ),
        (
            "extraction",
            Box::new(|| extract(&mesh, &grid, &mut Monitor::default()).map(drop)),
        ),
        (
            "smoothing",
            Box::new(|| {
                let options = SmoothOptions::default();
                smooth(&mut quads, &mesh, &options, &mut Monitor::default())
            }),
        ),
        (
            "refinement",
            Box::new(|| refine(&mesh, &features, &finer).map(drop)),
        ),
        ("a model", Box::new(|| Model::new(map.problem()).map(drop))),
    ];
    let token = CancelToken::new();
    for (name, step) in &mut steps {
        let watch = Monitor::default().cancel_token(token.clone()).watch();
        assert_eq!(step(), Ok(()), "{name}");
        token.cancel();
        assert_eq!(step(), Err(Error::Cancelled), "{name}");
        token.reset();
        drop(watch);
    }
}

/// A generator of numbers in [0, 1), for moments that nobody chose (`steele2014`).
struct Moments(u64);

impl Moments {
    fn next(&mut self) -> f64 {
        self.0 = self.0.wrapping_add(0x9E37_79B9_7F4A_7C15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
        ((z ^ (z >> 31)) >> 11) as f64 / (1u64 << 53) as f64
    }
}

/// Cancels runs from a mesh to quads at random moments, for as many minutes as `ROUNDEL_MINUTES` says, ten if
/// it says nothing, and tells by stage how long they go on. The mesh is that of `ROUNDEL_MESH`, or a torus of
/// 800,000 triangles. Run it alone on a quiet machine:
/// `cargo test --release --test cancel -- --ignored --nocapture random_moments`.
#[test]
#[ignore = "takes ten minutes and a quiet machine"]
fn at_random_moments_cancelling_takes_at_most_100_milliseconds() {
    let given = |name: &str| std::env::var(name).ok();
    let minutes: f64 = given("ROUNDEL_MINUTES").map_or(10.0, |text| text.parse().unwrap());
    let mesh = match given("ROUNDEL_MESH") {
        Some(path) => io::read(path).unwrap(),
        None => shape::by_name("torus", 800_000).unwrap(),
    };
    let options = QuadOptions::default();
    let started = Instant::now();
    quadrangulate(&mesh, &options, Monitor::default).unwrap();
    let whole = started.elapsed();
    println!("{} triangles, {whole:.2?}", mesh.face_count());
    let (mut moments, mut late) = (Moments(2009), Vec::new());
    let started = Instant::now();
    while started.elapsed().as_secs_f64() < 60.0 * minutes {
        let delay = whole.mul_f64(moments.next());
        let (token, run) = (CancelToken::new(), Run::new());
        let from_outside = token.clone();
        let canceller = std::thread::spawn(move || {
            std::thread::sleep(delay);
            from_outside.cancel();
            Instant::now()
        });
        let last = Cell::new(None);
        let monitor = || {
            let watched = Monitor::default().of_run(&run).cancel_token(token.clone());
            watched.on_event(|event| {
                last.set(Some((event.stage, event.share)));
                Flow::Continue
            })
        };
        let made = quadrangulate(&mesh, &options, monitor);
        let ended = Instant::now();
        let latency = ended.saturating_duration_since(canceller.join().unwrap());
        assert!(matches!(made, Ok(_) | Err(Error::Cancelled)));
        println!("{delay:.2?}: {latency:.0?} later, after {:?}", last.get());
        if latency > Duration::from_millis(100) {
            late.push((delay, latency, last.get()));
        }
    }
    assert!(late.is_empty(), "{late:?}");
}
