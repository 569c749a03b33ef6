//! The examples of docs/languages.md compile, run, and print the solution.
//!
//! That in Python is run by the tests of the Python package. Languages that are not installed are
//! left out, and the test says so.
#![cfg(target_os = "linux")]

use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

/// What every example prints.
const SOLUTION: &str = "0.2 0\n";

#[test]
fn the_c_example_runs() {
    let (place, program) = compiled("c", "cc", "-std=c99");
    assert_eq!(output(Command::new(program).current_dir(place)), SOLUTION);
}

#[test]
fn the_cpp_example_runs() {
    let (place, program) = compiled("cpp", "c++", "-std=c++17");
    assert_eq!(output(Command::new(program).current_dir(place)), SOLUTION);
}

#[test]
fn the_julia_example_runs() {
    if !installed("julia") {
        return println!("julia is not installed: skipped");
    }
    let place = place("julia");
    fs::write(place.join("example.jl"), example("julia")).unwrap();
    let mut julia = Command::new("julia");
    julia.env("ROUNDEL_LIBRARY", place.join("libroundel.so"));
    assert_eq!(output(julia.arg("example.jl").current_dir(place)), SOLUTION);
}

#[test]
fn the_csharp_example_runs() {
    if !installed("dotnet") {
        return println!("dotnet is not installed: skipped");
    }
    let place = place("csharp");
    let project = "<Project Sdk=\"Microsoft.NET.Sdk\"><PropertyGroup><OutputType>Exe</OutputType>\
        <TargetFramework>net8.0</TargetFramework></PropertyGroup></Project>";
    fs::write(place.join("example.csproj"), project).unwrap();
    fs::write(place.join("example.cs"), example("csharp")).unwrap();
    let mut dotnet = Command::new("dotnet");
    dotnet.arg("run").env("LD_LIBRARY_PATH", &place);
    assert_eq!(output(dotnet.current_dir(&place)), SOLUTION);
}

/// Mono's compiler knows C# 7, which has no `nuint` yet.
#[test]
fn the_csharp_example_runs_on_mono() {
    if !(installed("mcs") && installed("mono")) {
        return println!("mono is not installed: skipped");
    }
    let place = place("mono");
    let source = format!("using nuint = System.UInt64;\n{}", example("csharp"));
    fs::write(place.join("example.cs"), source).unwrap();
    output(Command::new("mcs").arg("example.cs").current_dir(&place));
    let mut mono = Command::new("mono");
    mono.arg("example.exe").env("LD_LIBRARY_PATH", &place);
    assert_eq!(output(mono.current_dir(&place)), SOLUTION);
}

/// The one block of the page in this language.
fn example(language: &str) -> &'static str {
    let page = include_str!("../docs/languages.md");
    let fence = format!("```{language}\n");
    let mut blocks = page.split(&fence).skip(1);
    let block = blocks.next().unwrap().split("```").next().unwrap();
    assert!(blocks.next().is_none(), "two examples in {language}");
    block
}

fn installed(program: &str) -> bool {
    Command::new(program).arg("--version").output().is_ok()
}

/// An empty folder with the shared library in it, under both of its names.
fn place(name: &str) -> PathBuf {
    let place = Path::new(env!("CARGO_TARGET_TMPDIR")).join(format!("languages-{name}"));
    let _ = fs::remove_dir_all(&place);
    fs::create_dir_all(&place).unwrap();
    let test = std::env::current_exe().unwrap();
    let deps = test.parent().unwrap();
    let library = [deps, deps.parent().unwrap()]
        .map(|dir| dir.join("libroundel.so"))
        .into_iter()
        .find(|path| path.exists())
        .expect("cargo builds the cdylib with the tests");
    let soname = format!("libroundel.so.{}", roundel::capi::ROUNDEL_ABI_VERSION);
    for name in ["libroundel.so", &soname] {
        std::os::unix::fs::symlink(&library, place.join(name)).unwrap();
    }
    place
}

fn compiled(language: &str, compiler: &str, standard: &str) -> (PathBuf, PathBuf) {
    let place = place(language);
    let source = format!("example.{language}");
    fs::write(place.join(&source), example(language)).unwrap();
    let mut command = Command::new(compiler);
    command
        .args([
            standard,
            "-Wall",
            "-Wextra",
            "-Werror",
            "-pedantic",
            &source,
        ])
        .args(["-L.", "-lroundel", "-Wl,-rpath,$ORIGIN", "-o", "example"]);
    let include = Path::new(env!("CARGO_MANIFEST_DIR")).join("include");
    output(command.arg("-I").arg(include).current_dir(&place));
    let program = place.join("example");
    (place, program)
}

fn output(command: &mut Command) -> String {
    let output = command.output().unwrap();
    let errors = String::from_utf8_lossy(&output.stderr);
    assert!(output.status.success(), "{errors}");
    String::from_utf8(output.stdout).unwrap()
}
