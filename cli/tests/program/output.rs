//! What the program writes: the JSON object, the summary, the solution file, the help.

use std::fs;
use std::process::Command;

use roundel::search::OPTIONS;
use roundel::solve::replay;
use roundel::{Options, Problem, Strategy};
use serde_json::{Value, json};

use crate::problem::mps;
use crate::run::{Scratch, finish, only_object, solve};

/// (A - I / 3)^2 + (I - 5.2)^2 + J^2 subject to I + J = 5: I = 5, J = 0, A = 5/3.
fn problem() -> String {
    mps(
        &["C0"],
        &[("I", "OBJ", -10.4), ("I", "C0", 1.0), ("J", "C0", 1.0)],
        &[("OBJ", -27.04), ("C0", 5.0)],
        &[
            ("A", "A", 2.0),
            ("I", "A", -2.0 / 3.0),
            ("I", "I", 2.0 + 2.0 / 9.0),
            ("J", "J", 2.0),
        ],
    )
}

fn keys(object: &Value) -> Vec<&str> {
    let object = object.as_object().unwrap();
    let mut keys: Vec<&str> = object.keys().map(String::as_str).collect();
    keys.sort_unstable();
    keys
}

#[test]
fn the_report_has_every_field_with_its_type() {
    let scratch = Scratch::new("fields");
    let file = scratch.write("problem.mps", problem());
    let (code, output) = finish(solve(&file, &["--json", "--strategy", "direct"]));
    assert_eq!(code, 0);
    let report = only_object(&output);
    let mut expected = vec![
        "schema",
        "file",
        "strategy",
        "status",
        "complete",
        "stopped_by",
        "energy",
        "lower_bound",
        "gap",
        "variables",
        "integers",
        "constraints",
        "inequalities",
        "reduced_integers",
        "reduced_continuous",
        "factor_nonzeros",
        "seconds",
        "peak_memory_bytes",
        "max_constraint_violation",
        "max_integrality_violation",
    ];
    expected.sort_unstable();
    assert_eq!(keys(&report), expected);
    assert_eq!(report["file"], json!(file.to_str().unwrap()));
    assert_eq!(report["strategy"], json!("direct"));
    for (key, count) in [
        ("variables", 3),
        ("integers", 2),
        ("constraints", 1),
        ("inequalities", 0),
        ("reduced_integers", 1),
        ("reduced_continuous", 1),
    ] {
        assert_eq!(report[key], json!(count), "{key}");
    }
    assert!((report["energy"].as_f64().unwrap() - 0.04).abs() < 1e-12);
    assert_eq!(report["max_integrality_violation"], json!(0.0));
    assert!(report["max_constraint_violation"].as_f64().unwrap() < 1e-12);
}

#[test]
fn the_total_of_the_seconds_includes_reading_and_every_phase() {
    let scratch = Scratch::new("seconds");
    let file = scratch.write("problem.mps", problem());
    let (_, output) = finish(solve(&file, &["--json"]));
    let seconds = &only_object(&output)["seconds"];
    assert_eq!(
        keys(seconds),
        ["eliminate", "factor", "read", "round", "total"]
    );
    let phases = ["read", "eliminate", "factor", "round"].map(|k| seconds[k].as_f64().unwrap());
    assert!(phases.iter().all(|&s| s >= 0.0), "{seconds}");
    assert!(phases[0] > 0.0, "{seconds}");
    let total = seconds["total"].as_f64().unwrap();
    assert!(total >= phases.iter().sum::<f64>() - 1e-9, "{seconds}");
}

#[cfg(target_os = "linux")]
#[test]
fn peak_memory_is_that_of_a_process_that_holds_a_solver() {
    let scratch = Scratch::new("memory");
    let file = scratch.write("problem.mps", problem());
    let (_, output) = finish(solve(&file, &["--json"]));
    let bytes = only_object(&output)["peak_memory_bytes"].as_u64().unwrap();
    assert!((1 << 20..1 << 30).contains(&bytes), "{bytes}");
}

#[test]
fn the_solution_file_gives_every_value_back_exactly() {
    let scratch = Scratch::new("solution");
    let file = scratch.write("problem.mps", problem());
    let out = scratch.path("values.txt");
    let (code, _) = finish(solve(&file, &["--solution", out.to_str().unwrap()]));
    assert_eq!(code, 0);
    let text = fs::read_to_string(out).unwrap();
    let mut values = Vec::new();
    for (line, name) in text.lines().zip(["A", "I", "J"]) {
        let (written, value) = line.split_once(' ').unwrap();
        assert_eq!(written, name);
        let digits = value.split('e').next().unwrap();
        assert_eq!(
            digits.bytes().filter(u8::is_ascii_digit).count(),
            17,
            "{line}"
        );
        values.push(value.parse::<f64>().unwrap());
    }
    assert_eq!(text.lines().count(), 3);
    assert_eq!(values[1..], [5.0, 0.0]);
    assert!((values[0] - 5.0 / 3.0).abs() < 1e-12, "{values:?}");
}

#[test]
fn a_solution_file_that_cannot_be_written_is_an_error_that_names_it() {
    let scratch = Scratch::new("unwritable");
    let file = scratch.write("problem.mps", problem());
    let out = scratch.path("no-such-folder/values.txt");
    let (code, output) = finish(solve(
        &file,
        &["--json", "--solution", out.to_str().unwrap()],
    ));
    let report = only_object(&output);
    assert_eq!((code, &report["error"]["code"]), (1, &json!("io")));
    let message = report["error"]["message"].as_str().unwrap();
    assert!(message.contains("values.txt"), "{message}");
}

#[test]
fn a_failed_solve_leaves_no_solution_file() {
    let scratch = Scratch::new("no-solution");
    let file = scratch.write("problem.mps", problem());
    let out = scratch.path("values.txt");
    let flags = ["--time-limit", "0", "--solution", out.to_str().unwrap()];
    let (code, _) = finish(solve(&file, &flags));
    assert_eq!(code, 5);
    assert!(!out.exists());
}

/// (x0 - x1)^2 + (x1 - 0.4)^2 with x1 an integer and x0 pinned to 3: x1 = 2.
#[test]
fn a_replay_repeats_a_solve_with_its_pins_and_options_unless_a_flag_says_otherwise() {
    let mut problem = Problem::new(2).unwrap();
    problem
        .add_least_squares(&[0, 1], &[1.0, -1.0], 0.0, 1.0)
        .unwrap();
    problem.add_least_squares(&[1], &[1.0], 0.4, 1.0).unwrap();
    problem.set_integers(&[1]).unwrap();
    problem.pin(0, 3.0).unwrap();
    let options = Options {
        strategy: Strategy::Direct,
        ..Options::default()
    };
    let scratch = Scratch::new("replay");
    let file = scratch.path("problem.mps");
    replay::save(&file, &problem, &options).unwrap();
    let out = scratch.path("values.txt");
    for (flags, strategy, x1) in [
        (&[][..], "direct", 2.0),
        (&["--strategy", "relax"], "relax", 1.7),
    ] {
        let mut command = solve(&file, &["--json", "--replay"]);
        command.args(flags).arg("--solution").arg(&out);
        let (code, output) = finish(command);
        let report = only_object(&output);
        assert_eq!(
            (code, &report["strategy"]),
            (0, &json!(strategy)),
            "{report}"
        );
        let text = fs::read_to_string(&out).unwrap();
        let value = text.lines().find_map(|l| l.strip_prefix("x1 ")).unwrap();
        assert!((value.parse::<f64>().unwrap() - x1).abs() < 1e-12, "{text}");
    }
}

#[cfg(feature = "gzip")]
#[test]
fn a_compressed_file_gives_the_same_solution() {
    use std::io::Write;

    let scratch = Scratch::new("gzip");
    let mut packed = flate2::write::GzEncoder::new(Vec::new(), flate2::Compression::default());
    packed.write_all(problem().as_bytes()).unwrap();
    let files = [
        scratch.write("problem.mps", problem()),
        scratch.write("problem.mps.gz", packed.finish().unwrap()),
    ];
    let energies = files.map(|file| {
        let (code, output) = finish(solve(&file, &["--json"]));
        assert_eq!(code, 0);
        only_object(&output)["energy"].clone()
    });
    assert!(energies[0].is_f64());
    assert_eq!(energies[0], energies[1]);
}

#[test]
fn the_summary_tells_sizes_strategy_energy_and_status() {
    let scratch = Scratch::new("summary");
    let file = scratch.write("problem.mps", problem());
    let (code, output) = finish(solve(&file, &["--strategy", "greedy"]));
    assert_eq!(code, 0);
    assert_eq!(output.stderr, b"", "no progress where nobody watches");
    let text = String::from_utf8(output.stdout).unwrap();
    let lines: Vec<&str> = text.lines().collect();
    assert_eq!(lines.len(), 3, "{text}");
    assert!(lines[0].contains("3 unknowns, 2 of them integer, 1 constraint"));
    assert!(lines[1].contains("1 integer, 1 continuous"), "{text}");
    assert!(lines[2].starts_with("greedy"), "{text}");
    assert!(lines[2].contains("energy 0.04"), "{text}");
    assert!(lines[2].contains("feasible"), "{text}");
}

#[test]
fn the_short_help_leaves_the_flags_of_experts_to_the_long_one() {
    let help = |flag: &str| {
        let mut command = Command::new(env!("CARGO_BIN_EXE_roundel"));
        let output = command.args(["quad", flag]).output().unwrap();
        String::from_utf8(output.stdout).unwrap()
    };
    let (short, long) = (help("--help"), help("--help-all"));
    for flag in [
        "--quads",
        "--strategy",
        "--time-limit",
        "--out",
        "--help-all",
    ] {
        assert!(short.contains(flag), "{flag}");
    }
    for flag in ["--cg-iterations", "--stiffenings", "--preset"] {
        assert!(!short.contains(flag) && long.contains(flag), "{flag}");
    }
    assert!(!short.contains("[default: auto]"), "{short}");
    for text in [short, long] {
        assert!(text.contains("Examples:\n  roundel quad "), "{text}");
    }
}

#[test]
fn the_help_tells_every_option_with_its_default_and_every_exit_code() {
    let help = Command::new(env!("CARGO_BIN_EXE_roundel"))
        .args(["solve", "--help-all"])
        .output()
        .unwrap();
    let text = String::from_utf8(help.stdout).unwrap();
    for info in OPTIONS {
        let flag = format!("--{}", info.name.replace('_', "-"));
        assert!(text.contains(&flag), "{flag}");
        assert!(
            text.contains(&format!("[default: {}]", info.default)),
            "{flag}"
        );
    }
    for code in 0..=7 {
        let line = format!("\n  {code}  ");
        assert!(text.contains(&line), "exit code {code}");
    }
}
