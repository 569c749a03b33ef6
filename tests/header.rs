//! The committed C header agrees with the Rust code of the C interface, and every C and C++ compiler
//! accepts it. The flags of the compilers are those of Unix.
#![cfg(unix)]

use std::ffi::OsString;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

/// The files of the C interface, in the order in which the header shows them.
const SOURCES: &[&str] = &[
    "abi",
    "version",
    "status",
    "error",
    "problem",
    "objective",
    "least_squares",
    "constraints",
    "inequalities",
    "unknowns",
    "hints",
    "options",
    "presets",
    "option_list",
    "cancel",
    "event",
    "solution",
    "solve",
    "layout",
    "lazy_rows",
    "proof",
    "solver",
    "files",
    "mesh",
    "mesh_files",
    "mirror",
    "soup",
    "edit_kind",
    "repair_options",
    "repair",
    "attribute_edges",
    "attributes",
    "geodesic_sources",
    "geodesic",
    "curves",
    "cut",
    "guidance",
    "curvature",
    "field",
    "field_problem",
    "map",
    "map_fold_free",
    "map_results",
    "quad_options",
    "quads",
    "quads_results",
    "transfer",
];

/// Files that declare nothing for C.
const INTERNAL: &[&str] = &[
    "mod",
    "failure",
    "guard",
    "guidance_files",
    "input",
    "matrix",
    "memory",
    "output",
    "panic_tests",
    "test_panic",
];

fn root() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR"))
}

fn header() -> PathBuf {
    root().join("include/roundel/roundel.h")
}

/// The compiler that the environment variable names, or the usual one.
fn compiler(variable: &str, usual: &str) -> OsString {
    std::env::var_os(variable).unwrap_or_else(|| usual.into())
}

fn generated() -> String {
    let config = cbindgen::Config::from_file(root().join("cbindgen.toml")).unwrap();
    let mut builder = cbindgen::Builder::new().with_config(config);
    for name in SOURCES {
        builder = builder.with_src(root().join(format!("src/capi/{name}.rs")));
    }
    let mut text = Vec::new();
    builder.generate().unwrap().write(&mut text);
    String::from_utf8(text).unwrap()
}

#[test]
fn the_committed_header_is_the_generated_one() {
    let text = generated();
    if std::env::var_os("ROUNDEL_BLESS").is_some_and(|v| v == "1") {
        // Replace the header in one step, because other tests read it at the same time.
        let fresh = header().with_extension("h.new");
        fs::write(&fresh, &text).unwrap();
        fs::rename(fresh, header()).unwrap();
    }
    let committed = fs::read_to_string(header()).unwrap();
    assert!(
        committed == text,
        "include/roundel/roundel.h has drifted: ROUNDEL_BLESS=1 cargo test --test header"
    );
}

#[test]
fn every_file_of_the_c_interface_is_known_to_the_generator() {
    for entry in fs::read_dir(root().join("src/capi")).unwrap() {
        let path = entry.unwrap().path();
        let name = path.file_stem().unwrap().to_str().unwrap();
        let known = SOURCES.contains(&name) || INTERNAL.contains(&name);
        assert!(
            known,
            "src/capi/{name}.rs is in neither list of tests/header.rs"
        );
        let entries = fs::read_to_string(&path).unwrap().contains("no_mangle");
        assert!(
            !entries || SOURCES.contains(&name) || name == "test_panic",
            "src/capi/{name}.rs has entries that the header lacks"
        );
    }
}

/// Tools that know only C declarations must be able to read the preprocessed header. gcc's preprocessor
/// and Python's pycparser stand for such tools. Where one is missing, the test says so and passes.
#[test]
fn a_plain_ffi_parser_reads_the_preprocessed_header() {
    let script = r"
import sys
try:
    import pycparser
except ImportError:
    sys.exit(77)
pycparser.CParser().parse(sys.stdin.read(), 'roundel.h')
";
    // Empty system headers: the parser needs three type names, not a C library.
    let shims = std::env::temp_dir().join(format!("roundel-shims-{}", std::process::id()));
    fs::create_dir_all(&shims).unwrap();
    fs::write(shims.join("stddef.h"), "typedef unsigned long size_t;\n").unwrap();
    let ints = "typedef signed char int8_t; typedef int int32_t; typedef long int64_t;\n";
    fs::write(shims.join("stdint.h"), ints).unwrap();
    let preprocessed = Command::new(compiler("CC", "cc"))
        .args(["-E", "-P", "-nostdinc", "-I"])
        .arg(&shims)
        .arg(header())
        .output()
        .unwrap();
    fs::remove_dir_all(&shims).unwrap();
    assert!(preprocessed.status.success());
    let input = std::env::temp_dir().join(format!("roundel-{}.i", std::process::id()));
    fs::write(&input, preprocessed.stdout).unwrap();
    let parsed = Command::new("python3")
        .args(["-c", script])
        .stdin(fs::File::open(&input).unwrap())
        .output();
    fs::remove_file(&input).unwrap();
    match parsed {
        Ok(out) if out.status.code() == Some(77) => println!("pycparser is not installed: skipped"),
        Ok(out) => {
            assert!(
                out.status.success(),
                "{}",
                String::from_utf8_lossy(&out.stderr)
            );
        }
        Err(_) => println!("python3 is not installed: skipped"),
    }
}

/// Compiles the header in two units and links them, so that a definition in the header would clash.
fn compiles_from_two_units(compiler: &OsString, standard: &str, extension: &str) {
    let dir = std::env::temp_dir().join(format!("roundel-{standard}-{}", std::process::id()));
    fs::create_dir_all(&dir).unwrap();
    let (one, two) = (format!("one.{extension}"), format!("two.{extension}"));
    // One unit includes the header once, the other twice.
    let include = "#include <roundel/roundel.h>\n";
    let other = "int other(const roundel_event *event);\n";
    let main = "int main(void) { return other((const roundel_event *)0); }\n";
    fs::write(dir.join(&one), format!("{include}{other}{main}")).unwrap();
    let body =
        "int other(const roundel_event *event) { return event ? ROUNDEL_ERROR_IO : ROUNDEL_OK; }\n";
    fs::write(dir.join(&two), format!("{include}{include}{other}{body}")).unwrap();
    let output = Command::new(compiler)
        .current_dir(&dir)
        .arg(format!("-std={standard}"))
        .args([
            "-Wall",
            "-Wextra",
            "-Wpedantic",
            "-Wconversion",
            "-Werror",
            "-I",
        ])
        .arg(root().join("include"))
        .args([&one, &two, "-o", "both"])
        .output()
        .unwrap();
    fs::remove_dir_all(&dir).unwrap();
    assert!(
        output.status.success(),
        "{standard}: {}",
        String::from_utf8_lossy(&output.stderr)
    );
}

#[test]
fn the_header_compiles_alone_as_every_c() {
    for standard in ["c99", "c11", "c17"] {
        compiles_from_two_units(&compiler("CC", "cc"), standard, "c");
    }
}

#[test]
fn the_header_compiles_alone_as_every_cpp() {
    for standard in ["c++11", "c++14", "c++17", "c++20"] {
        compiles_from_two_units(&compiler("CXX", "c++"), standard, "cpp");
    }
}
