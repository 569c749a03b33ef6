//! Every way a solve can end: status word, exit code, and what is told of it.

use serde_json::{Value, json};

use crate::problem::mps;
use crate::run::{Scratch, finish, only_object, solve};

/// Solves the problem `text` with `--json` and `flags`: the exit code and the object printed.
fn solve_json(test: &str, text: &str, flags: &[&str]) -> (i32, Value) {
    let scratch = Scratch::new(test);
    let file = scratch.write("problem.mps", text);
    let (code, output) = finish(solve(&file, &[&["--json"], flags].concat()));
    (code, only_object(&output))
}

/// (A - I)^2 + (I - 0.4)^2 + J^2: rounding I from 0.4 to 0 costs 0.16.
fn fractional() -> String {
    fractional_above(0.0)
}

/// The same, and a constant.
fn fractional_above(constant: f64) -> String {
    mps(
        &[],
        &[("I", "OBJ", -0.8)],
        &[("OBJ", -0.16 - constant)],
        &[
            ("A", "A", 2.0),
            ("I", "A", -2.0),
            ("I", "I", 4.0),
            ("J", "J", 2.0),
        ],
    )
}

/// A^2 + I^2 + J^2 subject to `rows`, the coefficients of I and J and the right side of each.
fn constrained(rows: &[(f64, f64, f64)]) -> String {
    let names: Vec<String> = (0..rows.len()).map(|k| format!("C{k}")).collect();
    let names: Vec<&str> = names.iter().map(String::as_str).collect();
    let mut columns = Vec::new();
    let mut rhs = Vec::new();
    for (name, &(i, j, r)) in names.iter().zip(rows) {
        columns.extend([("I", *name, i), ("J", *name, j)]);
        rhs.push((*name, r));
    }
    let q = [("A", "A", 2.0), ("I", "I", 2.0), ("J", "J", 2.0)];
    mps(&names, &columns, &rhs, &q)
}

/// A failure's status, code and index.
fn told(report: &Value) -> (&str, &str, &Value) {
    let error = &report["error"];
    for key in ["code", "message", "index", "line"] {
        assert!(error.get(key).is_some(), "{key} is missing: {report}");
    }
    let status = report["status"].as_str().unwrap();
    (status, error["code"].as_str().unwrap(), &error["index"])
}

#[test]
fn a_relaxation_is_relaxed() {
    let (code, report) = solve_json("relaxed", &fractional(), &["--strategy", "relax"]);
    assert_eq!((code, &report["status"]), (0, &json!("relaxed")));
    assert!(report["energy"].as_f64().unwrap().abs() < 1e-12, "{report}");
    let off = report["max_integrality_violation"].as_f64().unwrap();
    assert!((off - 0.4).abs() < 1e-12, "{report}");
}

#[test]
fn rounding_that_costs_something_is_feasible() {
    for strategy in ["direct", "greedy"] {
        let test = format!("feasible-{strategy}");
        let text = fractional_above(1.0);
        let (code, report) = solve_json(&test, &text, &["--strategy", strategy]);
        assert_eq!((code, &report["status"]), (0, &json!("feasible")));
        let number = |key: &str| report[key].as_f64().unwrap();
        let (energy, bound) = (number("energy"), number("lower_bound"));
        assert!((energy - 1.16).abs() < 1e-12, "{report}");
        assert!((bound - 1.0).abs() < 1e-6 && bound <= 1.0, "{report}");
        assert_eq!(number("gap"), (energy - bound) / energy);
    }
}

/// A sum of squares is at least 0, which nobody needs to be told.
#[test]
fn a_bound_that_says_nothing_is_not_told() {
    let flags = ["--strategy", "direct"];
    let (code, report) = solve_json("no-bound", &fractional(), &flags);
    assert_eq!((code, &report["status"]), (0, &json!("feasible")));
    let told = ["lower_bound", "gap"].map(|key| report.get(key));
    assert_eq!(told, [Some(&Value::Null); 2], "{report}");
    let scratch = Scratch::new("no-bound-plain");
    let file = scratch.write("problem.mps", fractional());
    let (_, output) = finish(solve(&file, &flags));
    let text = String::from_utf8(output.stdout).unwrap();
    assert!(!text.contains("gap") && !text.contains("bound"), "{text}");
}

#[test]
fn rounding_that_costs_nothing_is_optimal() {
    let (code, report) = solve_json("optimal", &constrained(&[(1.0, 0.0, 3.0)]), &[]);
    assert_eq!((code, &report["status"]), (0, &json!("optimal")));
    assert!((report["energy"].as_f64().unwrap() - 9.0).abs() < 1e-12);
}

#[test]
fn nodes_that_the_caller_set_are_a_limit() {
    let flags = ["--strategy", "exact", "--nodes", "0"];
    let (code, report) = solve_json("nodes", &fractional(), &flags);
    assert_eq!((code, &report["status"]), (0, &json!("limit")));
    assert_eq!(report["stopped_by"], json!("nodes"));
    assert_eq!(report["complete"], json!(false));
    let scratch = Scratch::new("nodes-plain");
    let file = scratch.write("problem.mps", fractional());
    let (_, output) = finish(solve(&file, &flags));
    let text = String::from_utf8(output.stdout).unwrap();
    let words = "limit, stopped by the limit of nodes";
    assert!(text.contains(words), "{text}");
}

/// A chain of 12,000 integers, whose dense lattice takes 1.1 GB where the process may have 0.6.
#[cfg(target_os = "linux")]
#[test]
fn a_lack_of_memory_leaves_the_best_solution_so_far() {
    use std::fmt::Write;
    use std::process::Command;

    const SIZE: usize = 12_000;
    let mut text = String::from("NAME chain\nROWS\n N OBJ\nCOLUMNS\n M1 'MARKER' 'INTORG'\n");
    for i in 0..SIZE {
        writeln!(text, " X{i} OBJ -1.3").unwrap();
    }
    text += " M2 'MARKER' 'INTEND'\nRHS\nBOUNDS\n";
    for i in 0..SIZE {
        writeln!(text, " FR BND X{i}").unwrap();
    }
    text += "QUADOBJ\n X0 X0 2\n";
    for i in 1..SIZE {
        writeln!(text, " X{i} X{i} 2\n X{} X{i} 0.7", i - 1).unwrap();
    }
    let scratch = Scratch::new("no-memory");
    let file = scratch.write("chain.mps", text + "ENDATA\n");
    let solve = solve(
        &file,
        &[
            "--json",
            "--strategy",
            "lattice",
            "--dense-integers",
            "20000",
        ],
    );
    let mut limited = Command::new("sh");
    limited.args(["-c", "ulimit -v 600000; exec \"$0\" \"$@\""]);
    limited.arg(solve.get_program()).args(solve.get_args());
    let (code, output) = finish(limited);
    let report = only_object(&output);
    assert_eq!(
        (code, &report["status"]),
        (0, &json!("feasible")),
        "{report}"
    );
    assert_eq!(report["stopped_by"], json!("memory"));
    assert_eq!(report["complete"], json!(false));
}

#[test]
fn contradictory_constraints_are_infeasible() {
    let text = constrained(&[(1.0, 1.0, 1.0), (1.0, 1.0, 2.0)]);
    let (code, report) = solve_json("infeasible", &text, &[]);
    let (status, error, index) = told(&report);
    assert_eq!((code, status, error), (3, "infeasible", "infeasible"));
    assert!(matches!(index.as_u64(), Some(0 | 1)), "{report}");
}

#[test]
fn constraints_without_an_integer_solution_are_infeasible() {
    let text = constrained(&[(1.0, -1.0, 0.0), (2.0, 4.0, 3.0)]);
    let (code, report) = solve_json("no-integers", &text, &[]);
    let (status, error, index) = told(&report);
    assert_eq!(
        (code, status, error),
        (3, "infeasible", "no_integer_solution")
    );
    assert!(index.is_u64(), "{report}");
}

#[test]
fn an_objective_that_falls_forever_is_unbounded() {
    let q = [("I", "I", 2.0), ("J", "J", 2.0)];
    let text = mps(&[], &[("A", "OBJ", 1.0)], &[], &q);
    let (code, report) = solve_json("unbounded", &text, &[]);
    let told = told(&report);
    assert_eq!((code, told), (4, ("unbounded", "unbounded", &json!(0))));
}

#[test]
fn an_objective_that_curves_downwards_is_an_error_of_its_own() {
    let q = [("A", "A", -2.0), ("I", "I", 2.0), ("J", "J", 2.0)];
    let text = mps(&[], &[], &[], &q);
    let (code, report) = solve_json("not-convex", &text, &[]);
    let found = told(&report);
    assert_eq!((code, found), (4, ("error", "not_convex", &json!(0))));
    let at = text.lines().position(|line| line.contains("-2")).unwrap();
    assert_eq!(report["error"]["line"], json!(at + 1), "{report}");
}

/// Each pair of unknowns is convex, all three together are not: the solver sees it, and the line is that of the
/// unknown which its direction moves most.
#[test]
fn the_line_is_named_of_what_only_the_solver_sees() {
    let text = "min\n f: [ x ^ 2\n + y ^ 2\n + z ^ 2 - 1.8 x * y - 1.8 y * z - 1.8 x * z ] / 2\n\
        st\n c: x + y + z <= 4\nbounds\n x free\n y free\n z free\nend\n";
    let scratch = Scratch::new("bent");
    let file = scratch.write("bent.lp", text);
    for proof in [None, Some("--proof=bent.jsonl")] {
        let flags: Vec<&str> = proof.into_iter().chain(["--json"]).collect();
        let mut command = solve(&file, &flags);
        command.current_dir(scratch.path(""));
        let (code, output) = finish(command);
        let report = only_object(&output);
        let (status, error, index) = told(&report);
        assert_eq!((code, status, error), (4, "error", "not_convex"));
        let line = index.as_u64().unwrap() + 2;
        assert_eq!(report["error"]["line"], json!(line), "{report}");
    }
}

#[test]
fn no_time_at_all_is_a_limit_before_a_first_solution() {
    let (code, report) = solve_json("limit", &fractional(), &["--time-limit", "0"]);
    let told = told(&report);
    assert_eq!((code, told), (5, ("limit", "time_limit", &Value::Null)));
}

#[test]
fn a_file_that_is_not_there_is_an_error_that_names_it() {
    let scratch = Scratch::new("no-file");
    let file = scratch.path("nothing.mps");
    let (code, output) = finish(solve(&file, &["--json"]));
    let report = only_object(&output);
    assert_eq!((code, told(&report)), (1, ("error", "io", &Value::Null)));
    assert_eq!(report["file"], json!(file.to_str().unwrap()));
    let message = report["error"]["message"].as_str().unwrap();
    assert!(message.contains("nothing.mps"), "{message}");
}

#[test]
fn a_broken_file_is_an_error_that_names_the_line() {
    let text = fractional().replace(" J J 2\n", " J K 2\n");
    let line = 1 + text.lines().position(|l| l == " J K 2").unwrap();
    let (code, report) = solve_json("broken", &text, &[]);
    assert_eq!((code, told(&report).1), (1, "parse"));
    assert_eq!(report["error"]["line"], json!(line));
}

#[test]
fn a_quadratic_constraint_is_an_error_that_says_what_is_not_supported() {
    let text = constrained(&[(1.0, 0.0, 3.0)]).replace("ENDATA", "QCMATRIX C0\nENDATA");
    let line = text.lines().position(|line| line.starts_with("QCMATRIX"));
    let (code, report) = solve_json("quadratic", &text, &[]);
    assert_eq!((code, told(&report).1), (1, "not_supported"));
    assert_eq!(report["error"]["line"], json!(line.unwrap() + 1));
}

#[test]
fn an_inequality_is_kept() {
    let text = constrained(&[(1.0, 0.0, 3.0)]).replace(" E C0\n", " G C0\n");
    let (code, report) = solve_json("inequality", &text, &[]);
    assert_eq!((code, &report["status"]), (0, &json!("optimal")));
    assert_eq!(report["energy"], json!(9.0));
}

#[test]
fn without_json_a_failure_is_one_line_on_stderr() {
    let scratch = Scratch::new("plain-failure");
    let file = scratch.write("problem.mps", constrained(&[(2.0, 4.0, 3.0)]));
    let (code, output) = finish(solve(&file, &[]));
    assert_eq!((code, output.stdout.as_slice()), (3, &b""[..]));
    let text = String::from_utf8(output.stderr).unwrap();
    assert!(text.starts_with("roundel: "), "{text}");
    assert!(text.contains("problem.mps: constraint 0: "), "{text}");
    assert_eq!(text.lines().count(), 1, "{text}");
}

#[test]
fn a_wrong_command_line_is_a_usage_error() {
    let scratch = Scratch::new("usage");
    let file = scratch.write("problem.mps", fractional());
    for flags in [
        &["--strategy", "guess"][..],
        &["--colour"],
        &["another.mps"],
    ] {
        let (code, output) = finish(solve(&file, flags));
        assert_eq!((code, output.stdout.as_slice()), (2, &b""[..]), "{flags:?}");
    }
}

/// Ctrl-C is sent while the program waits for its file, a pipe: it is seen before the solve
/// begins, however fast the machine.
#[cfg(unix)]
#[test]
fn ctrl_c_before_a_first_solution_is_cancelled() {
    use std::fs::OpenOptions;
    use std::io::Write;
    use std::process::{Command, Stdio};
    use std::time::Duration;

    let scratch = Scratch::new("cancelled");
    let pipe = scratch.path("problem.mps");
    assert!(
        Command::new("mkfifo")
            .arg(&pipe)
            .status()
            .unwrap()
            .success()
    );
    let mut command = solve(&pipe, &["--json"]);
    let program = command.stdout(Stdio::piped()).stderr(Stdio::piped());
    let program = program.spawn().unwrap();
    // Opens when the program does, which by then has its handler.
    let mut writer = OpenOptions::new().write(true).open(&pipe).unwrap();
    let kill = Command::new("kill")
        .args(["-INT", &program.id().to_string()])
        .status();
    assert!(kill.unwrap().success());
    std::thread::sleep(Duration::from_millis(300));
    writer.write_all(fractional().as_bytes()).unwrap();
    drop(writer);
    let output = program.wait_with_output().unwrap();
    let report = only_object(&output);
    assert_eq!(output.status.code(), Some(5), "{report}");
    assert_eq!(told(&report), ("cancelled", "cancelled", &Value::Null));
}

/// A full disk behind stdout.
#[cfg(target_os = "linux")]
#[test]
fn output_that_cannot_be_written_is_an_error() {
    let scratch = Scratch::new("full");
    let file = scratch.write("problem.mps", fractional());
    for flags in [&["--json"][..], &[]] {
        let full = std::fs::OpenOptions::new().write(true).open("/dev/full");
        let mut command = solve(&file, flags);
        command.stdout(full.unwrap());
        let (code, output) = finish(command);
        let text = String::from_utf8(output.stderr).unwrap();
        assert_eq!(code, 1, "{text}");
        assert!(text.starts_with("roundel: standard output: "), "{text}");
    }
}
