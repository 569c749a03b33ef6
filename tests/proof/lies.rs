//! Planted lies: each alters a proof that was accepted, and makes it false or no proof. The checker must refuse
//! every one, and for the right fault.

use std::io::{BufRead, Cursor};

use roundel::Problem;
use roundel::proof::{FaultKind, check, check_of};
use serde_json::{Value, json};

use crate::altered::{Lines, add, statement};
use crate::planted::{LIES, Of};
use crate::stated::{empty, lattice, lots, odd_cycle, small, switched, translated};
use crate::{planted_gains, planted_lattices, planted_translations};
use crate::{prove, text};

/// The lines of the proof of a problem.
fn lines_of(problem: &Problem) -> Lines {
    let proof = text(crate::made(&prove(problem).unwrap()));
    let lines = Cursor::new(proof).lines();
    lines
        .map(|line| serde_json::from_str(&line.unwrap()).unwrap())
        .collect()
}

fn joined(lines: &Lines) -> String {
    lines.iter().map(|line| format!("{line}\n")).collect()
}

#[test]
fn every_planted_lie_is_refused_for_its_fault() {
    let proofs = [
        (Of::Small, lines_of(&small())),
        (Of::Empty, lines_of(&empty())),
        (Of::Switched, lines_of(&switched())),
        (Of::OddCycle, lines_of(&odd_cycle())),
        (Of::Lots, lines_of(&lots(1))),
        (Of::Lattice, lines_of(&lattice())),
        (Of::Translated, lines_of(&translated())),
    ];
    for (_, lines) in &proofs {
        check(joined(lines).as_bytes()).unwrap();
    }
    let mut missed = Vec::new();
    let lies = LIES.into_iter().chain(planted_gains::LIES);
    let lies = lies.chain(planted_lattices::LIES);
    for (name, of, kind, alter) in lies.chain(planted_translations::LIES) {
        let (_, lines) = proofs.iter().find(|(which, _)| *which == of).unwrap();
        let mut altered = lines.clone();
        alter(&mut altered);
        assert!(altered != *lines, "{name} alters nothing");
        match check(joined(&altered).as_bytes()) {
            Ok(verdict) => missed.push(format!("{name}: accepted, {verdict:?}")),
            Err(fault) if fault.kind != kind => missed.push(format!("{name}: {fault:?}")),
            Err(fault) => assert!(fault.line > 0 && !fault.message.is_empty()),
        }
    }
    assert!(missed.is_empty(), "{}", missed.join("\n"));
}

/// Lies that are no JSON.
#[test]
fn a_text_that_cannot_be_read_is_refused() {
    let proof = joined(&lines_of(&small()));
    let half = proof.len() / 2;
    let altered = [
        String::new(),
        proof[..half].to_owned(),
        proof.replacen("2.4", "NaN", 1),
        proof.replacen("2.4", "1e999", 1),
        proof.replacen('[', "{", 1),
    ];
    for text in altered {
        let fault = check(text.as_bytes()).unwrap_err();
        assert_eq!(fault.kind, FaultKind::Format, "{fault}");
    }
}

/// A proof of a problem whose data differ is no proof of the caller's.
#[test]
fn the_proof_of_another_problem_is_refused() {
    let problem = small();
    let lines = lines_of(&problem);
    check_of(&problem, joined(&lines).as_bytes()).unwrap();
    let alterations: [fn(&mut Value); 5] = [
        |s| add(&mut s["inequalities"][0]["terms"][0][1], 1e-9),
        |s| add(&mut s["constraints"][0]["rhs"], 1.0),
        |s| s["inequalities"][1]["upper"] = Value::Null,
        |s| s["integers"] = json!([0, 1, 3, 4]),
        |s| add(&mut s["least_squares"][0]["weight"], 1.0),
    ];
    for alter in alterations {
        let mut altered = lines.clone();
        alter(statement(&mut altered));
        let fault = check_of(&problem, joined(&altered).as_bytes()).unwrap_err();
        assert_eq!(fault.kind, FaultKind::OtherProblem, "{fault}");
    }
}

/// A proof of another problem that has no point: the sides of a row are wider, so that there is one.
#[test]
fn no_alteration_of_a_side_leaves_an_empty_tree_empty() {
    let mut lines = lines_of(&empty());
    let sides = &mut statement(&mut lines)["inequalities"][0];
    (sides["lower"], sides["upper"]) = (json!(-1.0), json!(9.0));
    let fault = check(joined(&lines).as_bytes()).unwrap_err();
    assert!(
        matches!(fault.kind, FaultKind::NotEmpty | FaultKind::Step),
        "{fault}"
    );
}
