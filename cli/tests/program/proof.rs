//! Proofs, written by `solve --proof` and confirmed by `check-proof`.

use std::fs;
use std::path::Path;

use serde_json::{Value, json};

use crate::run::{Scratch, finish, only_object, program, solve};

/// `(I - 1.4)^2 + (J - 2.3)^2 + A^2` with a row.
const BOUNDED: &str = "\
minimize
 obj: - 2.8 I - 4.6 J + [ 2 I ^2 + 2 J ^2 + 2 A ^2 ] / 2
subject to
 row: 3 I + 2 J + A <= 6.5
bounds
 0 <= I <= 5
 0 <= J <= 5
 A free
general
 I J
end
";

/// An even number is 3.
const EMPTY: &str = "\
minimize
 obj: I + J
subject to
 row: 2 I + 4 J = 3
bounds
 0 <= I <= 5
 0 <= J <= 5
general
 I J
end
";

fn check_proof(proof: &Path, flags: &[&str]) -> (i32, Value) {
    let mut command = program(&["check-proof"]);
    command.arg(proof).args(flags).arg("--json");
    let (code, output) = finish(command);
    (code, only_object(&output))
}

#[test]
fn a_proof_is_confirmed_and_an_altered_one_is_refused() {
    let scratch = Scratch::new("proof");
    let model = scratch.write("problem.lp", BOUNDED);
    let proof = scratch.path("proof.jsonl");
    let (code, output) = finish(solve(&model, &["--proof", proof.to_str().unwrap()]));
    let summary = String::from_utf8(output.stdout).unwrap();
    assert_eq!(code, 0, "{summary}");
    assert!(summary.contains("\nproof      bound "), "{summary}");

    let of_model = ["--problem", model.to_str().unwrap()];
    let (code, report) = check_proof(&proof, &of_model);
    assert_eq!((code, &report["valid"]), (0, &json!(true)), "{report}");
    let [energy, bound] = ["energy", "lower_bound"].map(|name| report[name].as_f64().unwrap());
    assert!(bound <= energy && energy - bound < 1e-8, "{report}");

    // The bound is raised, and the fault is told with its line.
    let text = fs::read_to_string(&proof).unwrap();
    let mut lines: Vec<Value> = text
        .lines()
        .map(|line| serde_json::from_str(line).unwrap())
        .collect();
    lines[2]["claim"]["lower_bound"] = json!(energy);
    lines[4]["parts"][0]["lower_bound"] = json!(energy + 1e-6);
    let altered: String = lines.iter().map(|line| format!("{line}\n")).collect();
    let altered = scratch.write("altered.jsonl", altered);
    let (code, report) = check_proof(&altered, &[]);
    assert_eq!((code, &report["valid"]), (6, &json!(false)), "{report}");
    assert_eq!(report["fault"], "bound", "{report}");
    assert!(report["line"].as_u64().unwrap() > 5, "{report}");

    let other = scratch.write("other.lp", BOUNDED.replace("6.5", "6.75"));
    let (code, report) = check_proof(&proof, &["--problem", other.to_str().unwrap()]);
    assert_eq!((code, &report["fault"]), (6, &json!("other_problem")));
}

#[test]
fn a_problem_without_a_solution_gets_a_proof_of_that() {
    let scratch = Scratch::new("proof-empty");
    let model = scratch.write("problem.lp", EMPTY);
    let proof = scratch.path("proof.jsonl");
    let (code, _) = finish(solve(&model, &["--proof", proof.to_str().unwrap()]));
    assert_eq!(code, 3);
    let (code, report) = check_proof(&proof, &[]);
    assert_eq!((code, &report["valid"]), (0, &json!(true)), "{report}");
    assert_eq!(report["lower_bound"], Value::Null);
    let mut command = program(&["check-proof"]);
    command.arg(&proof);
    let (_, output) = finish(command);
    let told = String::from_utf8(output.stdout).unwrap();
    assert!(told.contains("no point is within all rows"), "{told}");
}

#[test]
fn what_is_no_proof_or_is_not_there_is_told() {
    let scratch = Scratch::new("proof-none");
    let model = scratch.write("problem.lp", BOUNDED);
    let (code, report) = check_proof(&model, &[]);
    assert_eq!((code, &report["fault"]), (6, &json!("format")));
    let (code, report) = check_proof(&scratch.path("none.jsonl"), &[]);
    assert_eq!(code, 1, "{report}");
    let flags = ["--strategy", "greedy", "--proof", "p.jsonl", "--json"];
    let mut command = solve(&model, &flags);
    command.current_dir(scratch.path(""));
    let (code, output) = finish(command);
    assert_eq!(code, 1, "{output:?}");
}
