//! Replay files: a problem with its options, from which a solve can be repeated elsewhere.
//!
//! Clarabel writes such files too; they belong in a bug report. The problem goes into an MPS file,
//! `NAME.mps` or `NAME.mps.gz`. The data that MPS cannot express go into `NAME.replay.json` beside it:
//! options, pins and initial guess. Every number is written with enough digits to be read back as itself.
//! So Q, q, c, the constraints of the [`Model`], inequalities and bounds are the same bit for bit, and so are the
//! values of a solve. Least-squares rows are read back as their part of Q, q and c, without the cycles hinted among
//! them. So an energy that is summed row by row may differ in its last digits.

mod entries;
mod format;

use std::path::{Path, PathBuf};

use crate::error::{Error, Result};
use crate::problem::files::{self, NamedProblem};
use crate::problem::{Model, Problem, mps};
use crate::search::Options;

use format::{Replay, Values};

/// Writes `problem` to the file at `path`, which must end in `.mps` or `.mps.gz`, and the replay file
/// beside it.
///
/// # Errors
/// As [`Model::new`], [`Error::InvalidArgument`] for another ending, [`Error::Io`] for a file that
/// cannot be written, [`Error::NotSupported`] for compression without the feature `gzip`, and for limits of
/// 1e20 or more.
pub fn save(path: &Path, problem: &Problem, options: &Options) -> Result<()> {
    let replay_path = replay_path(path)?;
    let model = Model::new(problem)?;
    let pins = model.pinned().iter().enumerate();
    // The comparison is bitwise, so that minus zero is kept.
    let guess = model.guess().iter().copied().enumerate();
    let guess = guess.filter(|(_, v)| v.to_bits() != 0);
    let replay = Replay {
        variables: model.variables(),
        constraints: model.constraints().rows(),
        options: options.clone(),
        pins: Values(pins.filter_map(|(i, v)| v.map(|v| (i, v))).collect()),
        guess: Values(guess.collect()),
        ..Replay::default()
    };
    let text = replay.to_text()?;
    let named = NamedProblem::new(problem.clone());
    mps::write_model(path, &model, &named, mps::Pins::Elsewhere)?;
    std::fs::write(&replay_path, text).map_err(|e| files::io_error(&replay_path, e))
}

/// Reads the problem at `path`, which must end in `.mps` or `.mps.gz`, and the replay file beside it.
///
/// # Errors
/// As [`mps::read`]; for the replay file [`Error::Io`], [`Error::Parse`] with the line at fault,
/// [`Error::NotSupported`] for the format of another version, [`Error::IndexOutOfRange`] for
/// variables that the problem does not have, and [`Error::InvalidArgument`] for a file that belongs
/// to another problem.
pub fn load(path: &Path) -> Result<(Problem, Options)> {
    let replay_path = replay_path(path)?;
    let bytes = std::fs::read(&replay_path).map_err(|e| files::io_error(&replay_path, e))?;
    let replay = Replay::parse(&bytes)?;
    let mut problem = mps::read(path)?.into_problem();
    let sizes = (problem.variables(), problem.constraints());
    if sizes != (replay.variables, replay.constraints) {
        return Err(Error::InvalidArgument {
            what: format!(
                "{} is for {} variables and {} constraints, the problem has {} and {}",
                replay_path.display(),
                replay.variables,
                replay.constraints,
                sizes.0,
                sizes.1
            ),
            index: None,
        });
    }
    for (&variable, &value) in &replay.pins.0 {
        problem.pin(variable, value)?;
    }
    let mut guess = vec![0.0; problem.variables()];
    for (position, (&variable, &value)) in replay.guess.0.iter().enumerate() {
        *guess.get_mut(variable).ok_or(Error::IndexOutOfRange {
            what: "guess",
            position,
            value: i64::try_from(variable).unwrap_or(i64::MAX),
            len: sizes.0,
        })? = value;
    }
    problem.set_guess(&guess)?;
    Ok((problem, replay.options))
}

/// The replay file beside the problem at `path`.
///
/// # Errors
/// [`Error::InvalidArgument`] unless `path` ends in `.mps` or `.mps.gz`.
pub fn replay_path(path: &Path) -> Result<PathBuf> {
    let ends_in = |path: &Path, ending: &str| {
        path.extension()
            .is_some_and(|e| e.eq_ignore_ascii_case(ending))
    };
    let mut plain = path.to_owned();
    if ends_in(&plain, "gz") {
        plain.set_extension("");
    }
    if ends_in(&plain, "mps") {
        return Ok(plain.with_extension("replay.json"));
    }
    Err(Error::InvalidArgument {
        what: format!("{} ends neither in .mps nor in .mps.gz", path.display()),
        index: None,
    })
}
