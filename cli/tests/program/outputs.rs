//! What a run is to write is checked before it reads its input.

use std::fs;

use roundel::mesh::{io, shape};

use crate::run::{Scratch, finish, only_object, program};

/// A command line that cannot be run: exit code 1, and one line that says why. The input is not there, so that
/// reading it would be told instead.
#[track_caller]
fn refused(words: &[&str], says: &str) {
    let (code, output) = finish(program(words));
    let text = String::from_utf8(output.stderr).unwrap();
    assert_eq!((code, text.lines().count()), (1, 1), "{words:?}: {text}");
    assert!(text.contains(says), "{words:?}: {text}");
    let name = words.iter().rev().find(|word| word.contains('.')).unwrap();
    assert_eq!(text.matches(name).count(), 1, "{text}");
}

#[test]
fn a_format_that_cannot_be_written_is_told_before_reading() {
    let formats = "'doc' is not a mesh format";
    for command in ["quad", "field", "extract", "repair"] {
        refused(&[command, "nothing", "-o", "x.doc"], formats);
    }
    refused(
        &["parametrize", "nothing", "-o", "x.doc"],
        "must end in .obj",
    );
    let words = ["field", "nothing", "--write-problem", "p.doc"];
    refused(&words, "must end in .mps or .mps.gz or .lp or .lp.gz");
    refused(
        &["field", "nothing", "--picture", "p.doc"],
        "must end in .png",
    );
    refused(
        &["quad", "nothing", "--report", "p.doc"],
        "must end in .html",
    );
}

#[test]
fn a_folder_that_is_not_there_is_told_before_reading() {
    let scratch = Scratch::new("no-folder");
    let file = scratch.path("missing").join("x.obj");
    let file = file.to_str().unwrap();
    for command in ["quad", "parametrize", "field", "extract", "repair"] {
        refused(&[command, "nothing", "-o", file], "there is no folder");
    }
    refused(
        &["solve", "nothing", "--solution", file],
        "there is no folder",
    );
    let folder = scratch.path("x.obj");
    fs::create_dir(&folder).unwrap();
    refused(
        &["quad", "nothing", "-o", folder.to_str().unwrap()],
        "directory",
    );
    assert_eq!(fs::read_dir(scratch.path("")).unwrap().count(), 1);
}

#[test]
fn what_is_read_is_overwritten_with_force_alone() {
    let scratch = Scratch::new("overwritten");
    let file = scratch.path("torus.obj");
    io::write(&file, &shape::by_name("torus", 200).unwrap()).unwrap();
    let before = fs::read(&file).unwrap();
    let detour = scratch.path("").join(".").join("torus.obj");
    let (file, detour) = (file.to_str().unwrap(), detour.to_str().unwrap());
    for command in ["quad", "parametrize", "field", "repair"] {
        refused(&[command, file, "-o", detour], "--force allows that");
    }
    refused(&["extract", file, "-o", file], "--force allows that");
    assert_eq!(fs::read(file).unwrap(), before);
    let words = ["quad", file, "--quads", "60", "-o", file, "--force"];
    let (code, _) = finish(program(&words));
    assert_eq!(code, 0);
    assert_ne!(fs::read(file).unwrap(), before);
}

#[test]
fn two_outputs_are_two_files() {
    let words = ["repair", "nothing", "-o", "x.obj", "--edits", "./x.obj"];
    refused(&words, "written twice");
}

#[test]
fn a_refused_output_is_an_object_with_json() {
    let (code, output) = finish(program(&["quad", "nothing", "-o", "x.doc", "--json"]));
    let report = only_object(&output);
    assert_eq!((code, &report["error"]["code"]), (1, &"io".into()));
}

#[test]
fn a_run_that_writes_nothing_says_so_first() {
    let told = |words: &[&str]| {
        let (code, output) = finish(program(words));
        assert_eq!(code, 0, "{words:?}");
        String::from_utf8(output.stderr).unwrap()
    };
    let shape = "shape:torus:200";
    for command in ["quad", "parametrize", "field"] {
        let text = told(&[command, shape]);
        assert_eq!(text.lines().count(), 1, "{text}");
        assert!(text.contains("no file will be written"), "{text}");
        assert_eq!(told(&[command, shape, "--json"]), "");
        assert_eq!(told(&[command, shape, "--quiet"]), "");
    }
    let scratch = Scratch::new("something");
    let picture = scratch.path("field.png");
    let words = ["field", shape, "--picture", picture.to_str().unwrap()];
    assert_eq!(told(&words), "");
}
