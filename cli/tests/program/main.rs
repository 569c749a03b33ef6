//! The program as its users meet it: run from outside, on files.

mod evaluate;
mod field;
mod outcome;
mod output;
mod parametrize;
mod problem;
mod readme;
mod run;
mod shape;
