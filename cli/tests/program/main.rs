//! The program as its users meet it: run from outside, on files.

mod outcome;
mod output;
mod problem;
mod readme;
mod run;
