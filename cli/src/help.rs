//! The help: the flags that most runs need, all of them with `--help-all`, and examples at its end.

use clap::{Arg, ArgAction, Command};
use roundel::search::OPTIONS;

use crate::exit;

/// The flag that shows every flag.
pub const HELP_ALL: &str = "--help-all";

/// Options of a solve that are not for experts alone.
const COMMON: [&str; 3] = ["strategy", "time_limit", "threads"];

/// Flags for experts beside the other options of a solve.
const EXPERT: [&str; 3] = ["preset", "stiffen", "stiffenings"];

/// Examples of each command.
const EXAMPLES: [(&str, &str); 14] = [
    (
        "solve",
        "\
  roundel solve problem.mps --solution values.txt
  roundel solve problem.mps.gz --strategy exact --time-limit 60 --json",
    ),
    (
        "check-proof",
        "\
  roundel check-proof proof.jsonl
  roundel check-proof proof.jsonl --problem problem.mps",
    ),
    (
        "field",
        "\
  roundel field bunny.obj -o field.txt
  roundel field fandisk.obj --features 40 --picture field.png",
    ),
    (
        "parametrize",
        "\
  roundel parametrize bunny.obj --quads 5000 -o uv.obj
  roundel parametrize bunny.obj --field field.txt -o uv.obj",
    ),
    (
        "check",
        "\
  roundel check uv.obj
  roundel check uv.obj --features 40 --json",
    ),
    (
        "distance",
        "\
  roundel distance bunny.obj --from vertex:12 -o distance.ply
  roundel distance fandisk.obj --from features --picture distance.png --json",
    ),
    (
        "layout",
        "\
  roundel layout bunny.obj --layout layout.obj --quads 2000 -o quads.obj
  roundel layout --of quads.obj -o layout.obj
  roundel layout --of quads.obj --kind simplified -o layout.obj --patches patches.json",
    ),
    (
        "repair",
        "\
  roundel repair scan.stl -o mesh.obj
  roundel repair scan.ply --weld 1e-6 --fill-holes 30 -o mesh.ply",
    ),
    (
        "quad",
        "\
  roundel quad shape:gear:4000 -o quads.obj
  roundel quad fandisk.obj --features 40 --quads 2000 -o quads.obj --report report.html",
    ),
    (
        "census",
        "\
  roundel census meshes -o census.html --jobs 4
  roundel census meshes -o census.html --part 3/100 --kill-after 600 -- --quads 5000 --adapt 1",
    ),
    (
        "extract",
        "\
  roundel extract uv.obj -o quads.obj",
    ),
    (
        "shape",
        "\
  roundel shape torus --triangles 5000 -o torus.obj",
    ),
    (
        "generate",
        "\
  roundel generate ~/.local/share/roundel",
    ),
    (
        "evaluate",
        "\
  roundel evaluate --tables tables --max-triangles 2000 --time-limit 10",
    ),
];

/// The program's commands with their examples. Flags for experts are hidden unless `all`.
pub fn arranged(program: Command, all: bool) -> Command {
    EXAMPLES
        .into_iter()
        .fold(program, |program, (name, examples)| {
            program.mut_subcommand(name, |command| command_with(command, examples, all))
        })
}

fn command_with(command: Command, examples: &str, all: bool) -> Command {
    let end = command.get_after_help().map(ToString::to_string);
    let end = end.unwrap_or_else(|| exit::HELP.into());
    let is_quad = command.get_name() == "quad";
    let lines = examples
        .lines()
        .map(|line| format!("  {}\n", line.trim_start()));
    let examples: String = lines.collect();
    let mut command = command.after_help(format!("Examples:\n{examples}\n{end}"));
    if is_quad {
        // The options of its map have a default of their own.
        command = command.mut_arg("strategy", |strategy| strategy.default_value("lattice"));
    }
    let help_all = Arg::new("help_all").long("help-all");
    command
        .mut_args(|arg| match is_expert(&arg) {
            true => arg.hide(!all),
            false => arg,
        })
        .arg(
            help_all
                .action(ArgAction::HelpLong)
                .help_heading(None::<&str>)
                .help("Print help, with the flags for experts"),
        )
}

fn is_expert(arg: &Arg) -> bool {
    let id = arg.get_id().as_str();
    let is_option = OPTIONS.iter().any(|info| info.name == id);
    EXPERT.contains(&id) || (is_option && !COMMON.contains(&id))
}

#[cfg(test)]
mod tests {
    use clap::{CommandFactory, Parser};
    use roundel::quad::QuadOptions;

    use super::*;
    use crate::Program;

    #[test]
    fn every_command_has_examples_that_it_understands() {
        let program = Program::command();
        for command in program.get_subcommands() {
            let name = command.get_name();
            let examples = EXAMPLES.iter().find(|(known, _)| *known == name);
            let (_, examples) = examples.unwrap_or_else(|| panic!("{name} has no examples"));
            for line in examples.lines() {
                let words: Vec<&str> = line.split_whitespace().collect();
                assert_eq!(words[..2], ["roundel", name]);
                assert!(Program::try_parse_from(words).is_ok(), "{line}");
            }
        }
    }

    #[test]
    fn the_help_of_quads_tells_the_default_of_its_map() {
        let command = arranged(Program::command(), false);
        let quad = command.find_subcommand("quad").unwrap();
        let strategy = quad.get_arguments().find(|a| a.get_id() == "strategy");
        let default = QuadOptions::default().map.strategy.name();
        assert_eq!(strategy.unwrap().get_default_values(), [default]);
    }
}
