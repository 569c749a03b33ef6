//! The program as its users meet it: run from outside, on files.

mod book;
mod census;
mod curves;
mod distance;
mod evaluate;
mod field;
mod interrupt;
mod kept;
mod layout;
mod named_features;
mod outcome;
mod output;
mod outputs;
mod page;
mod painted;
mod parametrize;
mod problem;
mod proof;
mod quad;
mod repair;
mod run;
mod same_quads;
mod schema;
mod shape;
#[path = "../../../tests/common/skip.rs"]
mod skip;
mod threads;
