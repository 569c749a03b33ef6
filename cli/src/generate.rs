//! `roundel generate`: completions for shells and manual pages, which installers put into their places.

use std::fs;
use std::io;
use std::path::{Path, PathBuf};

use clap::Command;
use clap_complete::{Shell, generate_to};
use roundel::Result;

use crate::exit::Exit;
use crate::output::{complain, io_error};

/// Write completions for shells and manual pages.
#[derive(clap::Args)]
pub struct Arguments {
    /// The folder to write to: `completions`, with a folder for each shell, and `man1` are made in it
    #[arg(value_name = "DIR")]
    folder: PathBuf,
}

/// The shells, and the folder of each.
const SHELLS: [(Shell, &str); 4] = [
    (Shell::Bash, "bash"),
    (Shell::Zsh, "zsh"),
    (Shell::Fish, "fish"),
    (Shell::PowerShell, "powershell"),
];

/// Runs the command.
pub fn run(arguments: &Arguments, program: &Command) -> Exit {
    match write(&arguments.folder, program) {
        Ok(()) => Exit::Solved,
        Err(error) => {
            complain(&arguments.folder, &error);
            Exit::of(&error)
        }
    }
}

fn write(folder: &Path, program: &Command) -> Result<()> {
    let write = || -> io::Result<()> {
        for (shell, name) in SHELLS {
            let folder = folder.join("completions").join(name);
            fs::create_dir_all(&folder)?;
            generate_to(shell, &mut program.clone(), "roundel", &folder)?;
        }
        let folder = folder.join("man1");
        fs::create_dir_all(&folder)?;
        clap_mangen::generate_to(program.clone(), &folder)
    };
    write().map_err(|reason| io_error(&folder.to_string_lossy(), &reason))
}
