//! Writing a problem and reading it again changes nothing.

use proptest::prelude::*;
use roundel::problem::files::NamedProblem;
use roundel::problem::{lp, mps};
use roundel::{Error, Model, Problem};

use crate::Scratch;
use crate::random::{fingerprint, fingerprint_without_zeros, problem};

fn text(problem: &NamedProblem) -> String {
    let mut bytes = Vec::new();
    mps::write_to(&mut bytes, problem).unwrap();
    String::from_utf8(bytes).unwrap()
}

/// A place, a byte and what to do with it there.
type Edit = (prop::sample::Index, u8, i32);

fn edits() -> impl Strategy<Value = Vec<Edit>> {
    prop::collection::vec((any::<prop::sample::Index>(), any::<u8>(), 0..4), 1..4)
}

/// Changes some bytes, and returns the number of lines.
fn damage(bytes: &mut Vec<u8>, edits: Vec<Edit>) -> usize {
    for (at, byte, edit) in edits {
        if bytes.is_empty() {
            break;
        }
        let at = at.index(bytes.len());
        match edit {
            0 => bytes[at] = byte,
            1 => bytes.insert(at, byte),
            2 => drop(bytes.remove(at)),
            _ => bytes.truncate(at + 1),
        }
    }
    bytes.split(|&b| b == b'\n').count()
}

proptest! {
    #[test]
    fn a_problem_written_and_read_is_the_same_model_bit_for_bit(problem in problem()) {
        let written = text(&NamedProblem::new(problem.clone()));
        let read = mps::parse(written.as_bytes()).unwrap();
        prop_assert_eq!(fingerprint(read.problem()), fingerprint(&problem), "{}", written);
        prop_assert_eq!(text(&read), written);
    }

    #[test]
    fn a_problem_written_as_lp_and_read_is_the_same_bit_for_bit(
        problem in problem(),
        maximise in any::<bool>(),
    ) {
        let named = NamedProblem::new(problem).maximising(maximise);
        let mut written = Vec::new();
        lp::write_to(&mut written, &named).unwrap();
        let text = String::from_utf8_lossy(&written).into_owned();
        let read = lp::parse(written.as_slice());
        prop_assert!(read.is_ok(), "{:?}\n{}", read.err(), text);
        let read = read.unwrap();
        let bits = fingerprint_without_zeros;
        prop_assert_eq!(bits(read.problem()), bits(named.problem()), "{}", text);
        prop_assert_eq!(read.maximises(), maximise);
        prop_assert_eq!(read.variables(), named.variables());
        prop_assert_eq!(read.constraints(), named.constraints());
        prop_assert_eq!(read.inequalities(), named.inequalities());
    }

    #[test]
    fn a_maximised_objective_is_written_and_read_as_mps(problem in problem()) {
        let named = NamedProblem::new(problem).maximising(true);
        let written = text(&named);
        let read = mps::parse(written.as_bytes()).unwrap();
        prop_assert!(read.maximises());
        prop_assert_eq!(fingerprint(read.problem()), fingerprint(named.problem()), "{}", written);
    }

    #[test]
    fn a_damaged_lp_file_is_read_or_refused_with_a_line_of_the_file(
        problem in problem(),
        edits in edits(),
    ) {
        let mut bytes = Vec::new();
        lp::write_to(&mut bytes, &NamedProblem::new(problem)).unwrap();
        let lines = damage(&mut bytes, edits);
        match lp::parse(bytes.as_slice()) {
            Ok(_) | Err(Error::Empty) => {}
            Err(error) => {
                prop_assert!((1..=lines).contains(&error.line().unwrap()), "{}", error);
            }
        }
    }

    #[test]
    fn a_damaged_file_is_read_or_refused_with_a_line_of_the_file(
        problem in problem(),
        edits in edits(),
    ) {
        let mut bytes = text(&NamedProblem::new(problem)).into_bytes();
        let lines = damage(&mut bytes, edits);
        if let Err(error) = mps::parse(bytes.as_slice()) {
            let fault = matches!(error, Error::Parse { .. } | Error::NotSupported { .. });
            prop_assert!(fault, "{}", error);
            prop_assert!((1..=lines).contains(&error.line().unwrap()), "{}", error);
        }
    }
}

fn named() -> NamedProblem {
    let mut p = Problem::new(3).unwrap();
    p.add_constraint(&[2, 0], &[2.0, -1.0], 0.5).unwrap();
    p.add_constraint(&[1], &[1.0], 0.0).unwrap();
    p.set_integers(&[1]).unwrap();
    let variables = ["*x", "ENDATA", "größe"].map(String::from).to_vec();
    let rows = ["RHS", "'INTORG'"].map(String::from).to_vec();
    NamedProblem::with_names(p, "two words", "$cost", variables, rows, vec![]).unwrap()
}

#[test]
fn names_that_look_like_keywords_or_numbers_survive() {
    let problem = named();
    let read = mps::parse(text(&problem).as_bytes()).unwrap();
    assert_eq!(read.title(), "two words");
    assert_eq!(read.objective(), "$cost");
    assert_eq!(read.variables(), problem.variables());
    assert_eq!(read.constraints(), problem.constraints());
    assert_eq!(fingerprint(read.problem()), fingerprint(problem.problem()));
}

#[test]
fn a_pin_is_written_as_a_constraint_with_an_unused_name() {
    let mut p = Problem::new(2).unwrap();
    p.add_constraint(&[0, 1], &[1.0, 1.0], 3.0).unwrap();
    p.pin(1, 0.25).unwrap();
    let variables = vec!["a".into(), "b".into()];
    let p = NamedProblem::with_names(p, "", "f", variables, vec!["PIN_1".into()], vec![]).unwrap();
    let read = mps::parse(text(&p).as_bytes()).unwrap();
    assert_eq!(read.constraints(), ["PIN_1", "PIN_1_"]);
    let model = Model::new(read.problem()).unwrap();
    assert_eq!(model.constraint_rhs(), [3.0, 0.25]);
    assert_eq!(model.constraints().row(1).collect::<Vec<_>>(), [(1, 1.0)]);
}

#[test]
fn compressed_and_plain_files_hold_the_same() {
    let scratch = Scratch::new("compressed");
    let problem = named();
    let plain = scratch.file("p.mps");
    mps::write(&plain, &problem).unwrap();
    let expected = fingerprint(problem.problem());
    assert_eq!(fingerprint(mps::read(&plain).unwrap().problem()), expected);

    let packed = scratch.file("p.mps.gz");
    let written = mps::write(&packed, &problem);
    if cfg!(not(feature = "gzip")) {
        assert!(matches!(written, Err(Error::NotSupported { .. })));
        return;
    }
    written.unwrap();
    assert_eq!(std::fs::read(&packed).unwrap()[..2], [0x1f, 0x8b]);
    assert_eq!(fingerprint(mps::read(&packed).unwrap().problem()), expected);
    // Compression is recognised by content, not by name.
    let renamed = scratch.file("renamed.mps");
    std::fs::rename(&packed, &renamed).unwrap();
    assert_eq!(
        fingerprint(mps::read(&renamed).unwrap().problem()),
        expected
    );
}

#[test]
fn an_error_names_the_file_that_cannot_be_written() {
    let scratch = Scratch::new("unwritable");
    let path = scratch.file("none/p.mps");
    let error = mps::write(&path, &named()).unwrap_err();
    assert!(matches!(error, Error::Io { .. }));
    assert!(error.to_string().contains("p.mps"), "{error}");
}
