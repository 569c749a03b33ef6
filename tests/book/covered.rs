//! No example of the book is left to rot: each language has a test that runs its blocks, and a block
//! that none runs fails here.

use std::fs;

use crate::page::{Block, blocks, root};

/// A command that takes long or installs, the file that runs the same, and words of it there.
struct Elsewhere {
    command: &'static str,
    file: &'static str,
    words: &'static str,
}

const fn elsewhere(command: &'static str, file: &'static str, words: &'static str) -> Elsewhere {
    Elsewhere {
        command,
        file,
        words,
    }
}

/// Commands that are run by something else than the tests of the program, which run `roundel ...`
/// and `cargo run --release -p roundel-cli -- ...`, and those of the installed package, which run
/// whatever pages beside a CMakeLists.txt or with pkg-config say.
const ELSEWHERE: [Elsewhere; 22] = [
    elsewhere("scripts/test", ".ci/run", "scripts/test"),
    elsewhere(
        "roundel evaluate --tables tables --max-triangles 2000 --time-limit 10",
        "cli/tests/program/evaluate.rs",
        "--max-triangles",
    ),
    elsewhere(
        "roundel evaluate --tables OUT --other-solvers others.csv --max-triangles 2000",
        "cli/tests/program/evaluate.rs",
        "--other-solvers",
    ),
    elsewhere(
        "cargo install --path cli",
        "scripts/test",
        "cargo install --locked --path cli",
    ),
    elsewhere(
        "cmake -S . -B build && cmake --build build && cmake --install build --prefix ~/roundel",
        "cpp_tests/package/install.cmake",
        "--install \"${BUILD}\" --prefix",
    ),
    elsewhere(
        "pip wheel --no-deps -w dist bindings/python && pip install dist/roundel-*.whl",
        "scripts/test-python",
        "wheel --quiet --no-deps --no-build-isolation --wheel-dir \"$place/dist\" bindings/python",
    ),
    elsewhere(
        "pip wheel --no-deps -w dist bindings/python    # needs cargo; ROUNDEL_LIBRARY=... takes a library that is built",
        "scripts/test-python",
        "bindings/python",
    ),
    elsewhere(
        "pip install dist/roundel-*.whl                 # needs NumPy and cffi, and no compiler",
        "scripts/test-python",
        "/dist/roundel-*.whl",
    ),
    elsewhere(
        "python3 -m venv ~/env && . ~/env/bin/activate",
        "scripts/test-python",
        "python3 -m venv",
    ),
    elsewhere(
        "cmake -S . -B build -DCMAKE_PREFIX_PATH=$HOME/roundel && cmake --build build && build/rounding",
        "cpp_tests/package/CMakeLists.txt",
        "page_test(cpp",
    ),
    elsewhere(
        "ROUNDEL_COMISO_STRATEGY=auto build/rounding",
        "cpp_tests/package/CMakeLists.txt",
        "page_test(comiso",
    ),
    elsewhere(
        "export PKG_CONFIG_PATH=~/roundel/lib/pkgconfig",
        "cpp_tests/package/CMakeLists.txt",
        "page_test(c ",
    ),
    elsewhere(
        "cc rounding.c $(pkg-config --cflags --libs roundel) -Wl,-rpath,$HOME/roundel/lib -o rounding && ./rounding",
        "cpp_tests/package/CMakeLists.txt",
        "page_test(c ",
    ),
    elsewhere(
        "python3 -m venv solvers",
        "scripts/test-python",
        "python3 -m venv",
    ),
    // Other solvers have licences of their own, and no test installs them.
    elsewhere(
        "solvers/bin/pip install pyscipopt highspy gurobipy cplex xpress coptpy",
        "scripts/other-solvers",
        "from pyscipopt import",
    ),
    elsewhere(
        "cargo build --release -p roundel-cli",
        "scripts/test-meshlab",
        "--package roundel-cli",
    ),
    elsewhere(
        "solvers/bin/python scripts/other-solvers --time-limit 60 -o others.csv examples/torus_field.mps",
        "scripts/other-solvers",
        "--time-limit",
    ),
    elsewhere(
        "xvfb-run -a meshlabserver -i fandisk.off -s quads.mlx -o quads.off -m mp",
        "plugins/meshlab/tests/server.py",
        "xvfb-run",
    ),
    elsewhere(
        "apt install meshlab qtbase5-dev libqt5opengl5-dev libglew-dev libeigen3-dev",
        "scripts/test",
        "meshlab qtbase5-dev libqt5opengl5-dev libglew-dev",
    ),
    elsewhere(
        "cmake -S plugins/meshlab -B build/meshlab -DMESHLAB_SOURCES=\"$(scripts/meshlab-sources)\"",
        "scripts/test-meshlab",
        "cmake -S plugins/meshlab",
    ),
    elsewhere(
        "cmake --build build/meshlab",
        "scripts/test-meshlab",
        "cmake --build",
    ),
    elsewhere(
        "sudo cp build/meshlab/libfilter_roundel.so /usr/lib/x86_64-linux-gnu/meshlab/plugins/",
        "plugins/meshlab/tests/server.py",
        "plugin",
    ),
];

#[test]
fn every_block_is_run_by_a_test() {
    for block in blocks() {
        let place = block.place();
        match block.language.as_str() {
            // What programs print, and formats of files.
            "text" => {}
            "rust" => assert!(
                is_in(
                    "src/lib.rs",
                    &format!("include_str!(\"../{}\")", block.page)
                ),
                "{place}: no doctest"
            ),
            // By `programs`.
            "c" | "cpp" | "julia" | "csharp" => {}
            // By bindings/python/tests, which takes all pages that this test takes.
            "python" => assert!(
                is_in(
                    "bindings/python/tests/test_documentation.py",
                    "docs\").glob"
                ),
                "{place}: no Python test"
            ),
            "cmake" => assert!(
                is_in("cpp_tests/package/CMakeLists.txt", &block.page),
                "{place}: no test of the installed package"
            ),
            "sh" => every_command_is_run(&block),
            "xml" => the_script_names_what_the_plugin_has(&block),
            other => panic!("{place}: no test runs '{other}'"),
        }
    }
}

fn every_command_is_run(block: &Block) {
    for command in block.text.lines() {
        let found = ELSEWHERE.iter().find(|e| e.command == command);
        let by_the_program = ["roundel ", "cargo run --release -p roundel-cli -- "];
        let is_its = |start: &&str| command.starts_with(*start);
        if found.is_none() && by_the_program.iter().any(is_its) {
            continue;
        }
        let by = found.unwrap_or_else(|| panic!("{}: no test runs {command}", block.place()));
        assert!(
            is_in(by.file, by.words),
            "{} no longer runs {command}",
            by.file
        );
    }
}

#[test]
fn every_command_that_is_run_elsewhere_is_in_the_book() {
    let all = blocks();
    for by in &ELSEWHERE {
        let shown = all.iter().any(|b| b.text.lines().any(|l| l == by.command));
        assert!(shown, "{}", by.command);
    }
}

/// MeshLab's own tests need MeshLab; that the script has all parameters, and no others, needs none.
fn the_script_names_what_the_plugin_has(block: &Block) {
    let server = fs::read_to_string(root().join("plugins/meshlab/tests/server.py")).unwrap();
    let defaults = server.split("DEFAULTS = {").nth(1).unwrap();
    let defaults = defaults.split("\n}").next().unwrap();
    let wanted: Vec<&str> = defaults.split('"').skip(1).collect();
    let names = |line: &&str| line.trim_start().starts_with("<Param");
    let mut count = 0;
    for line in block.text.lines().filter(names) {
        let attribute = |name: &str| line.split(&format!("{name}=\"")).nth(1).unwrap();
        let value = |name: &str| attribute(name).split('"').next().unwrap();
        assert!(wanted.contains(&value("name")), "{line}");
        assert!(wanted.contains(&value("type")), "{line}");
        count += 1;
    }
    assert_eq!(count, defaults.matches("\": (").count());
}

fn is_in(file: &str, words: &str) -> bool {
    let text = fs::read_to_string(root().join(file)).unwrap();
    text.contains(words)
}
