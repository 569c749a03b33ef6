//! The book is what it says: every example is run, every name exists, every table is complete.

#![cfg(target_os = "linux")]

mod covered;
mod names;
mod page;
mod programs;
