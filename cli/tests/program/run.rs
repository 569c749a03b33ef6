//! Runs the program on problems that the tests write.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Output};

use serde_json::Value;

/// A folder of one test's own, gone when the test has passed.
pub struct Scratch(PathBuf);

impl Scratch {
    pub fn new(test: &str) -> Self {
        let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join(test);
        // What a failed run has left is in the way.
        let _ = fs::remove_dir_all(&folder);
        fs::create_dir_all(&folder).unwrap();
        Scratch(folder)
    }

    pub fn path(&self, name: &str) -> PathBuf {
        self.0.join(name)
    }

    pub fn write(&self, name: &str, content: impl AsRef<[u8]>) -> PathBuf {
        let path = self.path(name);
        fs::write(&path, content).unwrap();
        path
    }
}

impl Drop for Scratch {
    fn drop(&mut self) {
        if !std::thread::panicking() {
            let _ = fs::remove_dir_all(&self.0);
        }
    }
}

/// `roundel solve FILE FLAGS...`, not yet run.
pub fn solve(file: &Path, flags: &[&str]) -> Command {
    let mut command = program(&["solve"]);
    command.arg(file).args(flags);
    command
}

/// `roundel WORDS...`, not yet run.
pub fn program(words: &[&str]) -> Command {
    let mut command = Command::new(env!("CARGO_BIN_EXE_roundel"));
    command.args(words);
    command
}

/// Runs to the end and gives the exit code, which a program killed by a signal has not.
pub fn finish(mut command: Command) -> (i32, Output) {
    let output = command.output().unwrap();
    (output.status.code().expect("killed"), output)
}

/// The one JSON object on stdout; stderr has to be silent.
pub fn only_object(output: &Output) -> Value {
    let stderr = String::from_utf8_lossy(&output.stderr);
    assert_eq!(stderr, "", "stderr is for people");
    let value: Value = serde_json::from_slice(&output.stdout).expect("one JSON value");
    assert!(value.is_object(), "{value}");
    value
}
