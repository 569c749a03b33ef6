//! The threads of a run, and its trace.

use std::collections::BTreeSet;
use std::fs;

use serde_json::Value;

use crate::run::{Scratch, finish, program};

/// Runs a command of four real or simulated threads. Returns its trace.
fn traced(scratch: &Scratch, words: &[&str], flags: &[&str]) -> Value {
    let file = scratch.path("trace.json");
    let trace = ["--json", "--trace", file.to_str().unwrap()];
    let (code, output) = finish(program(&[words, &trace, flags].concat()));
    let errors = String::from_utf8(output.stderr).unwrap();
    assert_eq!((code, &errors[..]), (0, ""), "{words:?}");
    serde_json::from_str(&fs::read_to_string(file).unwrap()).unwrap()
}

fn number(event: &Value, key: &str) -> f64 {
    event[key].as_f64().unwrap()
}

#[test]
fn a_trace_has_the_steps_of_all_threads() {
    let scratch = Scratch::new("trace");
    let quads = scratch.path("quads.obj");
    let quad = ["quad", "shape:torus:3000", "-o", quads.to_str().unwrap()];
    let all = [
        &["field", "shape:torus:3000"][..],
        &["parametrize", "shape:torus:3000"],
        &quad,
    ];
    for words in all {
        for flags in [["--threads", "4"], ["--simulate", "4"]] {
            let trace = traced(&scratch, words, &flags);
            let events = trace["traceEvents"].as_array().unwrap();
            let names: BTreeSet<&str> = events.iter().filter_map(|e| e["name"].as_str()).collect();
            for name in [
                "half-edges",
                "assemble field",
                "eliminate",
                "relax",
                "factor",
            ] {
                assert!(names.contains(name), "{words:?} {flags:?}: {names:?}");
            }
            let seconds = number(&trace["otherData"], "seconds");
            for event in events {
                let end = number(event, "ts") + number(event, "dur");
                assert!(number(event, "ts") >= 0.0 && end <= 1e6 * seconds + 1.0);
            }
            let threads: BTreeSet<u64> = events.iter().filter_map(|e| e["tid"].as_u64()).collect();
            assert!(threads.contains(&0) && threads.iter().all(|&t| t < 4));
            // The fields that are tried for quads of a small mesh need several threads.
            assert!(threads.len() > 1 || words[0] != "quad", "{flags:?}");
        }
    }
}

#[test]
fn only_a_trace_can_be_simulated() {
    let (code, _) = finish(program(&["field", "shape:torus", "--simulate", "4"]));
    assert_eq!(code, 2);
    let words = ["field", "nothing", "--trace", "x.txt"];
    let (code, output) = finish(program(&words));
    let text = String::from_utf8(output.stderr).unwrap();
    assert!(code == 1 && text.contains("must end in .json"), "{text}");
}
