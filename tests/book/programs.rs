//! The programs of the book in C, C++, Julia and C# compile, run and print what the page says.
//!
//! What a machine does not have, a language or a library, is left out, and the test says so.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

use crate::page::{Block, blocks, root};

/// A library that examples include, and how a program is linked with it.
struct Library {
    header: &'static str,
    link: &'static [&'static str],
}

/// The libraries that may be missing.
const LIBRARIES: [Library; 2] = [
    Library {
        header: "OpenMesh/Core/IO/MeshIO.hh",
        link: &["-lOpenMeshCore"],
    },
    Library {
        header: "Eigen/SparseCore",
        link: &[],
    },
];

/// Where Debian has the headers of Eigen.
const EIGEN: &str = "/usr/include/eigen3";

#[test]
fn c_programs_run() {
    assert!(run_all("c", |block, place| compiled(block, place, "cc", "-std=c99")) > 3);
}

#[test]
fn cpp_programs_run() {
    let run = |block: &Block, place: &Path| compiled(block, place, "c++", "-std=c++17");
    assert!(run_all("cpp", run) > 3);
}

#[test]
fn julia_programs_run() {
    if !installed("julia") {
        return crate::common::skip::skip("julia is not installed");
    }
    let run = |block: &Block, place: &Path| {
        fs::write(place.join("example.jl"), &block.text).unwrap();
        let mut julia = Command::new("julia");
        julia.env("ROUNDEL_LIBRARY", place.join("libroundel.so"));
        julia.arg("example.jl");
        Some(julia)
    };
    assert_eq!(run_all("julia", run), 1);
}

#[test]
fn csharp_programs_run() {
    if !installed("dotnet") {
        return crate::common::skip::skip("dotnet is not installed");
    }
    let run = |block: &Block, place: &Path| {
        let project = "<Project Sdk=\"Microsoft.NET.Sdk\"><PropertyGroup>\
            <OutputType>Exe</OutputType><TargetFramework>net8.0</TargetFramework>\
            </PropertyGroup></Project>";
        fs::write(place.join("example.csproj"), project).unwrap();
        fs::write(place.join("example.cs"), &block.text).unwrap();
        let mut dotnet = Command::new("dotnet");
        dotnet.arg("run");
        Some(dotnet)
    };
    assert_eq!(run_all("csharp", run), 1);
}

/// Mono's compiler knows C# 7, which has no `nuint` yet.
#[test]
fn csharp_programs_run_on_mono() {
    if !(installed("mcs") && installed("mono")) {
        return crate::common::skip::skip("mono is not installed");
    }
    let run = |block: &Block, place: &Path| {
        let source = format!("using nuint = System.UInt64;\n{}", block.text);
        fs::write(place.join("example.cs"), source).unwrap();
        output(Command::new("mcs").arg("example.cs").current_dir(place));
        let mut mono = Command::new("mono");
        mono.arg("example.exe");
        Some(mono)
    };
    assert_eq!(run_all("csharp", run), 1);
}

/// Runs every block of a language, each in a folder of its own, and tells how many.
fn run_all(language: &str, prepare: impl Fn(&Block, &Path) -> Option<Command>) -> usize {
    let all = blocks();
    let mut count = 0;
    for block in all.iter().filter(|b| b.language == language) {
        let place = place(&format!("{language}-{count}"));
        count += 1;
        let Some(mut command) = prepare(block, &place) else {
            crate::common::skip::skip(&format!("{}: a library is missing", block.place()));
            continue;
        };
        let printed = output(command.current_dir(&place).env("LD_LIBRARY_PATH", &place));
        if let Some(wanted) = &block.prints {
            assert_eq!(&printed, wanted, "{}", block.place());
        }
    }
    count
}

/// The program of a block, with all warnings as errors, if there is all that it includes.
fn compiled(block: &Block, place: &Path, compiler: &str, standard: &str) -> Option<Command> {
    let source = format!("example.{}", block.language);
    fs::write(place.join(&source), &block.text).unwrap();
    let include = root().join("include");
    let compat = root().join("compat");
    let mut command = Command::new(compiler);
    let warnings = ["-Wall", "-Wextra", "-Werror", "-pedantic"];
    command.arg(standard).args(warnings).arg(&source);
    command.arg("-I").arg(include);
    for folder in ["include", "shim"] {
        command.arg("-I").arg(compat.join(folder));
    }
    command.args(["-isystem", EIGEN, "-L.", "-lroundel", "-o", "example"]);
    for library in &LIBRARIES {
        if block.text.contains(library.header) || block.text.contains("<roundel/eigen.hpp>") {
            if !has_header(library.header) {
                return None;
            }
            command.args(library.link);
        }
    }
    output(command.current_dir(place));
    Some(Command::new(place.join("example")))
}

fn has_header(header: &str) -> bool {
    ["/usr/include", "/usr/local/include", EIGEN]
        .iter()
        .any(|folder| Path::new(folder).join(header).exists())
}

fn installed(program: &str) -> bool {
    Command::new(program).arg("--version").output().is_ok()
}

/// An empty folder with the shared library in it, under both of its names.
fn place(name: &str) -> PathBuf {
    let place = Path::new(env!("CARGO_TARGET_TMPDIR")).join(format!("book-{name}"));
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

fn output(command: &mut Command) -> String {
    let output = command.output().unwrap();
    let errors = String::from_utf8_lossy(&output.stderr);
    assert!(output.status.success(), "{command:?}\n{errors}");
    String::from_utf8(output.stdout).unwrap()
}
