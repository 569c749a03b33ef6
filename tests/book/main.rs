//! The book is what it says: every example is run, every name exists, every table is complete.

#![cfg(target_os = "linux")]

#[path = "../common/mod.rs"]
mod common;
mod covered;
mod names;
mod page;
mod programs;
