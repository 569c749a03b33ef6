//! A solve that was saved and loaded is the same solve.

use std::path::Path;

use proptest::collection::vec;
use proptest::prelude::*;
use roundel::solve::replay;
use roundel::{Error, Options, Problem, Strategy as Rounding};

use crate::Scratch;
use crate::random::{fingerprint, number, problem};

const SAVED: &str = r#"{
  "format": 1,
  "library": "0.1.0",
  "variables": 2,
  "constraints": 0,
  "options": {
    "strategy": "direct",
    "time_limit": "inf",
    "threads": 1
  },
  "pins": {
    "1": 0.5
  },
  "guess": {
    "0": -0.25
  }
}
"#;

/// Loads a problem of two unknowns with `text` as its replay file.
fn load(test: &str, text: impl AsRef<[u8]>) -> roundel::Result<(Problem, Options)> {
    let scratch = Scratch::new(test);
    let path = scratch.file("p.mps");
    replay::save(&path, &Problem::new(2).unwrap(), &Options::default()).unwrap();
    std::fs::write(scratch.file("p.replay.json"), text).unwrap();
    replay::load(&path)
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(64))]
    #[test]
    fn a_solve_saved_and_loaded_is_the_same_bit_for_bit(
        mut problem in problem(),
        values in vec(number(), 9),
        pinned in vec(any::<bool>(), 9),
        seconds in prop_oneof![Just(f64::INFINITY), 0.0..1e9f64],
    ) {
        let n = problem.variables();
        problem.set_guess(&values[..n]).unwrap();
        for i in (0..n).filter(|&i| pinned[i]) {
            // An integer can be pinned only to an integer. The value does not matter here.
            problem.pin(i, values[i].round()).unwrap();
        }
        let options = Options {
            time_limit: seconds,
            threads: 3,
            strategy: Rounding::Direct,
            ..Options::default()
        };
        let scratch = Scratch::new("same-solve");
        let path = scratch.file("p.mps");
        replay::save(&path, &problem, &options).unwrap();
        let (loaded, loaded_options) = replay::load(&path).unwrap();
        prop_assert_eq!(fingerprint(&loaded), fingerprint(&problem));
        prop_assert_eq!(loaded_options, options);
    }
}

#[test]
fn a_loaded_solve_has_the_same_values_bit_for_bit() {
    let mut problem = Problem::new(4).unwrap();
    for i in 0..3 {
        let rhs = 0.3 + 0.4 * i as f64;
        problem
            .add_least_squares(&[i, i + 1], &[1.0, -1.7], rhs, 1.3)
            .unwrap();
    }
    problem.set_integers(&[1, 2]).unwrap();
    problem.set_guess(&[0.7, 0.0, 0.0, 0.0]).unwrap();
    let options = Options {
        strategy: Rounding::Greedy,
        ..Options::default()
    };
    let scratch = Scratch::new("values");
    let path = scratch.file("p.mps");
    replay::save(&path, &problem, &options).unwrap();
    let (loaded, loaded_options) = replay::load(&path).unwrap();
    let first = roundel::solve(&problem, &options).unwrap();
    let second = roundel::solve(&loaded, &loaded_options).unwrap();
    let bits = |values: &[f64]| values.iter().map(|v| v.to_bits()).collect::<Vec<_>>();
    assert_eq!(bits(first.values()), bits(second.values()));
    assert!((first.energy() - second.energy()).abs() <= 1e-14 * first.energy().abs().max(1.0));
}

#[test]
fn the_options_in_the_file_are_used() {
    let (problem, options) = load("taken", SAVED).unwrap();
    let mut expected = Problem::new(2).unwrap();
    expected.pin(1, 0.5).unwrap();
    expected.set_guess(&[-0.25, 0.0]).unwrap();
    assert_eq!(fingerprint(&problem), fingerprint(&expected));
    assert_eq!(options.strategy, Rounding::Direct);
    assert_eq!(options.time_limit, f64::INFINITY);
}

#[test]
fn a_broken_replay_file_is_refused_with_its_line() {
    let cases = [
        ("", "", 1),
        ("\"format\": 1", "\"format\": true", 2),
        ("\"variables\": 2,", "\"variables\": 2", 5),
        ("\"constraints\": 0", "\"constraints\": -1", 5),
        ("\"strategy\": \"direct\"", "\"strategy\": \"guess\"", 7),
        ("\"strategy\"", "\"stratagem\"", 7),
        ("\"inf\"", "\"never\"", 8),
        ("\"inf\"", "-1", 8),
        ("\"threads\": 1", "\"threads\": 1.5", 9),
        ("\"threads\": 1", "\"threads\": 2000", 9),
        ("\"threads\": 1", "\"threads\": [1]", 9),
        ("\"threads\": 1", "\"strategy\": \"greedy\"", 9),
        ("\"1\": 0.5", "\"1\": \"inf\"", 12),
        ("\"1\": 0.5", "\"1\": 0.5,\n    \"1\": 0.75", 13),
        ("\"1\": 0.5", "\"1\": 1e999", 12),
        ("\"1\": 0.5", "\"one\": 0.5", 12),
        ("\"guess\"", "\"hint\"", 14),
        ("0.25\n  }\n}\n", "0.25\n  }\n", 17),
        ("}\n}\n", "}\n}\n7", 18),
    ];
    for (old, new, line) in cases {
        let text = if old.is_empty() {
            new.into()
        } else {
            SAVED.replace(old, new)
        };
        let error = load("broken", text).unwrap_err();
        assert!(matches!(error, Error::Parse { .. }), "{new}: {error}");
        assert_eq!(error.line(), Some(line), "{new}: {error}");
        assert_eq!(error.to_string().matches("line").count(), 1, "{error}");
    }
}

#[test]
fn bytes_that_are_not_text_are_refused_with_their_line() {
    let mut bytes = SAVED.as_bytes().to_vec();
    let at = SAVED.find("direct").unwrap();
    bytes[at] = 0xff;
    assert_eq!(load("bytes", bytes).unwrap_err().line(), Some(7));
}

#[test]
fn another_format_version_is_not_supported_whatever_the_file_holds() {
    let text = SAVED.replace("\"format\": 1", "\"novelty\": [1],\n  \"format\": 2");
    let error = load("format", text).unwrap_err();
    assert!(
        matches!(error, Error::NotSupported { line: Some(3), .. }),
        "{error}"
    );
}

#[test]
fn variables_that_the_problem_does_not_have_are_refused() {
    for (old, new) in [("\"1\"", "\"2\""), ("\"0\"", "\"2\"")] {
        let error = load("range", SAVED.replace(old, new)).unwrap_err();
        let expected = matches!(
            error,
            Error::IndexOutOfRange {
                value: 2,
                len: 2,
                ..
            }
        );
        assert!(expected, "{error}");
    }
}

#[test]
fn a_file_of_another_problem_is_refused() {
    let text = SAVED.replace("\"constraints\": 0", "\"constraints\": 4");
    let error = load("other", text).unwrap_err();
    assert!(matches!(error, Error::InvalidArgument { .. }), "{error}");
}

#[test]
fn the_replay_file_is_beside_its_problem() {
    let beside = |path: &str| replay::replay_path(Path::new(path));
    for path in ["a/b.c.mps", "a/b.c.mps.gz"] {
        assert_eq!(beside(path).unwrap(), Path::new("a/b.c.replay.json"));
    }
    for path in ["a/b.gz", "a/b.txt", "mps", ""] {
        assert!(
            matches!(beside(path), Err(Error::InvalidArgument { .. })),
            "{path}"
        );
    }
}

#[test]
fn inequalities_and_bounds_come_back_and_give_the_same_solution() {
    let scratch = Scratch::new("limited");
    let path = scratch.file("p.mps");
    let mut problem = Problem::new(2).unwrap();
    problem.add_least_squares(&[0], &[1.0], 0.3, 1.0).unwrap();
    problem.add_least_squares(&[1], &[1.0], 2.7, 1.0).unwrap();
    problem.set_integers(&[0]).unwrap();
    let none = f64::INFINITY;
    problem
        .add_inequality(&[0, 1], &[1.0, -0.1], 0.75, none)
        .unwrap();
    problem.set_bounds(&[1], &[0.0], &[2.5]).unwrap();
    replay::save(&path, &problem, &Options::default()).unwrap();
    let (read, options) = replay::load(&path).unwrap();
    assert_eq!(read.bounds(1).unwrap(), (0.0, 2.5));
    let solutions = [&problem, &read].map(|problem| roundel::solve(problem, &options).unwrap());
    assert_eq!(solutions[0].values(), [1.0, 2.5]);
    assert_eq!(solutions[1].values(), solutions[0].values());
}

#[test]
fn a_missing_file_is_named() {
    let scratch = Scratch::new("missing");
    let error = replay::load(&scratch.file("p.mps")).unwrap_err();
    assert!(matches!(error, Error::Io { .. }));
    assert!(error.to_string().contains("p.replay.json"), "{error}");
}
