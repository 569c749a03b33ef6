//! A panic inside the library becomes a status, prints nothing, and makes the handle unusable.
//!
//! This needs the feature `test-panic`, which adds the one function that panics. The tests are in this
//! layer because calls of C functions need `unsafe`.

use std::ffi::c_char;
use std::process::Command;
use std::ptr;

use super::roundel_status::*;
use super::*;

/// This module, as the test runner names its tests.
const HERE: &str = "capi::panic_tests::";

fn message() -> String {
    let mut buffer = [0u8; 256];
    // SAFETY: the buffer has the length given.
    unsafe { roundel_last_error_message(buffer.as_mut_ptr().cast::<c_char>(), buffer.len()) };
    let end = buffer.iter().position(|&b| b == 0).unwrap();
    String::from_utf8(buffer[..end].to_vec()).unwrap()
}

fn problem(variables: usize) -> *mut roundel_problem {
    let mut problem = ptr::null_mut();
    // SAFETY: there is a place for the handle.
    let status = unsafe { roundel_problem_new(variables, &raw mut problem) };
    assert_eq!(status, ROUNDEL_OK);
    problem
}

#[test]
fn a_panic_gives_up_the_handle_and_no_other() {
    let (bad, good) = (problem(2), problem(2));
    let mut count = 7;
    // SAFETY: live handles, freed once at the end.
    unsafe {
        assert_eq!(roundel_test_panic(bad), ROUNDEL_ERROR_PANIC);
        assert!(message().contains("asked to panic"), "{}", message());
        assert_eq!(
            roundel_problem_variable_count(bad, &raw mut count),
            ROUNDEL_ERROR_UNUSABLE
        );
        assert_eq!(
            roundel_problem_add_constant(bad, 1.0),
            ROUNDEL_ERROR_UNUSABLE
        );
        let mut solution = ptr::null_mut();
        let solved = roundel_problem_solve(bad, ptr::null(), ptr::null(), &raw mut solution);
        assert_eq!(solved, ROUNDEL_ERROR_UNUSABLE);
        assert!(solution.is_null());
        assert!(message().contains("can only be freed"), "{}", message());
        assert_eq!(count, 7);
        assert_eq!(
            roundel_problem_variable_count(good, &raw mut count),
            ROUNDEL_OK
        );
        assert_eq!(count, 2);
        assert_eq!(roundel_problem_free(bad), ROUNDEL_OK);
        assert_eq!(roundel_problem_free(good), ROUNDEL_OK);
    }
}

/// Runs the test above alone in a process of its own, whose output nobody captures.
#[test]
fn a_panic_inside_prints_nothing() {
    let output = Command::new(std::env::current_exe().unwrap())
        .args([
            "--exact",
            "--nocapture",
            &format!("{HERE}a_panic_gives_up_the_handle_and_no_other"),
        ])
        .output()
        .unwrap();
    assert!(output.status.success());
    let told = String::from_utf8_lossy(&output.stdout);
    assert!(told.contains("1 passed"), "{told}");
    let text = [output.stdout, output.stderr].concat();
    let text = String::from_utf8_lossy(&text);
    assert!(!text.contains("asked to panic"), "{text}");
    assert!(!text.contains("panicked"), "{text}");
}

/// A Rust program that uses the interface keeps the messages of its own panics.
#[test]
fn a_panic_outside_still_prints() {
    if std::env::var_os("ROUNDEL_TEST_OUTSIDE").is_some() {
        // SAFETY: a live handle, given up.
        unsafe { roundel_problem_free(problem(1)) };
        panic!("from outside");
    }
    let output = Command::new(std::env::current_exe().unwrap())
        .args(["--exact", "--nocapture"])
        .arg(format!("{HERE}a_panic_outside_still_prints"))
        .env("ROUNDEL_TEST_OUTSIDE", "1")
        .output()
        .unwrap();
    assert!(!output.status.success());
    let text = [output.stdout, output.stderr].concat();
    assert!(String::from_utf8_lossy(&text).contains("from outside"));
}
