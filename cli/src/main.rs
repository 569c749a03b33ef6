//! The `roundel` program: one command for each task, in a module of its name.

mod census;
mod changes;
mod check;
mod check_proof;
mod distance;
mod evaluate;
mod exit;
mod extract;
mod field;
mod free_memory;
mod generate;
mod help;
mod interrupt;
mod layout;
mod mesh;
mod options;
mod output;
mod outputs;
mod page;
mod parametrize;
mod picture;
mod progress;
mod quad;
mod refinement;
mod repair;
mod report;
mod shape;
mod solve;
mod summary;
mod threads;

use std::process::ExitCode;

use clap::{CommandFactory, FromArgMatches, Parser, Subcommand};

/// Mixed-integer quadratic problems of geometry processing.
#[derive(Parser)]
#[command(name = "roundel", version, after_help = exit::HELP)]
struct Program {
    #[command(subcommand)]
    command: Command,
}

#[derive(Subcommand)]
enum Command {
    Solve(solve::Arguments),
    Field(field::Arguments),
    Parametrize(parametrize::Arguments),
    Check(check::Arguments),
    CheckProof(check_proof::Arguments),
    Distance(distance::Arguments),
    Repair(repair::Arguments),
    Quad(quad::Arguments),
    Extract(extract::Arguments),
    Layout(layout::Arguments),
    Census(census::Arguments),
    Shape(shape::Arguments),
    Evaluate(evaluate::Arguments),
    Generate(generate::Arguments),
}

fn main() -> ExitCode {
    let all = std::env::args_os().any(|word| word == help::HELP_ALL);
    let program = help::arranged(Program::command(), all);
    let given = program.get_matches();
    let given = Program::from_arg_matches(&given).unwrap_or_else(|error| error.exit());
    match given.command {
        Command::Solve(arguments) => solve::run(&arguments),
        Command::Field(arguments) => field::run(&arguments),
        Command::Parametrize(arguments) => parametrize::run(&arguments),
        Command::Check(arguments) => check::run(&arguments),
        Command::CheckProof(arguments) => check_proof::run(&arguments),
        Command::Distance(arguments) => distance::run(&arguments),
        Command::Repair(arguments) => repair::run(&arguments),
        Command::Quad(arguments) => quad::run(&arguments),
        Command::Extract(arguments) => extract::run(&arguments),
        Command::Layout(arguments) => layout::run(&arguments),
        Command::Census(arguments) => census::run(&arguments),
        Command::Shape(arguments) => shape::run(&arguments),
        Command::Evaluate(arguments) => evaluate::run(&arguments),
        Command::Generate(arguments) => {
            generate::run(&arguments, &help::arranged(Program::command(), true))
        }
    }
    .into()
}
