//! Ctrl-C loses nothing, and progress never falls.

#![cfg(unix)]

use std::process::{Command, Stdio};
use std::time::{Duration, Instant};

use crate::run::{Scratch, only_object, program};
#[cfg(target_os = "linux")]
use crate::skip::skip_unless_ci;

/// A mesh whose quads take some seconds.
const MESH: &str = "shape:rounded-cube:60000";

/// A mesh whose map has too many integers for a proof.
#[cfg(target_os = "linux")]
const PROVED: &str = "shape:gear:6000";

fn interrupt(id: u32) {
    let kill = Command::new("kill")
        .args(["-INT", &id.to_string()])
        .status();
    assert!(kill.unwrap().success());
}

/// A run takes as long as the machine lets it, so several moments are tried, until one is late enough for
/// integers and early enough for the run to be at work.
#[test]
fn ctrl_c_has_quads_written_from_the_best_integers_so_far() {
    let scratch = Scratch::new("interrupted");
    let out = scratch.path("quads.obj");
    let words = ["quad", MESH, "--json", "-o", out.to_str().unwrap()];
    let started = Instant::now();
    assert!(program(&words).output().unwrap().status.success());
    let whole = started.elapsed();
    for part in [0.7, 0.8, 0.6, 0.5, 0.85, 0.4] {
        std::fs::remove_file(&out).unwrap();
        let mut command = program(&words);
        let run = command.stdout(Stdio::piped()).stderr(Stdio::piped());
        let run = run.spawn().unwrap();
        std::thread::sleep(whole.mul_f64(part));
        interrupt(run.id());
        let output = run.wait_with_output().unwrap();
        let report = only_object(&output);
        match output.status.code() {
            Some(7) => {
                let lines = std::fs::read_to_string(&out).unwrap();
                let quads = lines.lines().filter(|l| l.starts_with("f ")).count();
                let told = ["quads", "other_faces"].map(|k| report[k].as_u64().unwrap());
                assert_eq!(quads as u64, told[0] + told[1]);
                let is_told = report["conforming"] == true || !report["faults"].is_null();
                assert!(is_told, "{report}");
                return;
            }
            // It ended before the signal came.
            Some(0) => {}
            Some(5) => {
                assert!(!out.exists());
                std::fs::write(&out, "").unwrap();
            }
            other => panic!("{other:?}: {report}"),
        }
    }
    panic!("no moment was right");
}

#[test]
fn a_second_ctrl_c_ends_at_once() {
    let run = program(&["quad", "shape:rounded-cube:400000", "--json"])
        .stdout(Stdio::null())
        .spawn();
    let mut run = run.unwrap();
    std::thread::sleep(Duration::from_millis(500));
    // Factorizations and reading do not look for the first one.
    let started = Instant::now();
    while run.try_wait().unwrap().is_none() {
        assert!(started.elapsed() < Duration::from_secs(5));
        interrupt(run.id());
        std::thread::sleep(Duration::from_millis(100));
    }
    let code = run.wait().unwrap().code();
    assert!(matches!(code, Some(130 | 5 | 7)), "{code:?}");
}

/// What a run draws on a terminal, which `script` makes, and the percentages in it; none without `script`.
#[cfg(target_os = "linux")]
fn drawn(words: &str) -> Option<(String, Vec<u32>)> {
    let command = format!("stty cols 150; {} {words}", env!("CARGO_BIN_EXE_roundel"));
    let output = Command::new("script")
        .args(["-qec", &command, "/dev/null"])
        // A machine that builds may have no terminal at all.
        .env("TERM", "xterm")
        .stdin(Stdio::null())
        .output();
    let Ok(output) = output else {
        skip_unless_ci("script is not installed: no terminal to draw the progress on");
        return None;
    };
    let text = String::from_utf8(output.stdout).unwrap();
    assert!(output.status.success(), "{text}");
    let numbers = text.split(" %").filter_map(|before| {
        let number = before.rsplit(' ').next()?;
        number.parse().ok()
    });
    let numbers = numbers.collect();
    Some((text, numbers))
}

#[cfg(target_os = "linux")]
#[test]
fn the_line_on_a_terminal_never_falls_and_names_every_stage() {
    // The JSON object has no percentages.
    let Some((text, shares)) = drawn(&format!("quad {MESH} --json")) else {
        return;
    };
    assert!(shares.len() > 10, "{text}");
    assert!(shares.is_sorted(), "{shares:?}");
    for stage in ["repair", "field", "map"] {
        assert!(text.contains(stage), "{stage}: {text}");
    }
}

/// Draws the line of a run whose field, map and proof take this long, and holds it to growing to the end.
#[cfg(target_os = "linux")]
fn grows_for(seconds: u64) {
    let started = Instant::now();
    let words = format!("quad {PROVED} --strategy exact --time-limit {seconds} --json");
    let Some((_, shares)) = drawn(&words) else {
        return;
    };
    let took = started.elapsed();
    assert!(took >= Duration::from_secs(seconds), "{took:?}");
    // Ten times a second, as long as it takes.
    assert!(shares.len() as u64 > 4 * seconds, "{}", shares.len());
    assert!(shares.is_sorted(), "{shares:?}");
    let (first, last) = (shares[0], shares[shares.len() - 1]);
    assert!(first <= 5 && last >= 80, "{first} to {last}");
}

#[cfg(target_os = "linux")]
#[test]
fn the_line_grows_through_field_map_and_an_unfinished_proof() {
    grows_for(6);
}

#[cfg(target_os = "linux")]
#[test]
#[ignore = "takes a minute"]
fn the_line_grows_for_a_minute() {
    grows_for(60);
}

#[cfg(target_os = "linux")]
#[test]
fn quiet_draws_nothing() {
    let Some((text, shares)) = drawn("quad shape:rounded-cube:20000 --quiet --json") else {
        return;
    };
    assert!(shares.is_empty(), "{text}");
    assert!(text.trim_start().starts_with('{'), "{text}");
}
