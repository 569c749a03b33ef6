//! The `roundel` program: one command for each task, in a module of its name.

mod changes;
mod check;
mod evaluate;
mod exit;
mod extract;
mod field;
mod interrupt;
mod mesh;
mod options;
mod output;
mod page;
mod parametrize;
mod progress;
mod quad;
mod refinement;
mod repair;
mod report;
mod shape;
mod solve;
mod summary;

use std::process::ExitCode;

use clap::{Parser, Subcommand};

/// Mixed-integer quadratic problems of geometry processing.
#[derive(Parser)]
#[command(version, after_help = exit::HELP)]
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
    Repair(repair::Arguments),
    Quad(quad::Arguments),
    Extract(extract::Arguments),
    Shape(shape::Arguments),
    Evaluate(evaluate::Arguments),
}

fn main() -> ExitCode {
    match Program::parse().command {
        Command::Solve(arguments) => solve::run(&arguments),
        Command::Field(arguments) => field::run(&arguments),
        Command::Parametrize(arguments) => parametrize::run(&arguments),
        Command::Check(arguments) => check::run(&arguments),
        Command::Repair(arguments) => repair::run(&arguments),
        Command::Quad(arguments) => quad::run(&arguments),
        Command::Extract(arguments) => extract::run(&arguments),
        Command::Shape(arguments) => shape::run(&arguments),
        Command::Evaluate(arguments) => evaluate::run(&arguments),
    }
    .into()
}
