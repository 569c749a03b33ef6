//! Proofs: a solve that writes one to a file, and the checker.

use std::ffi::c_char;
use std::fs::{self, File};
use std::io::{BufReader, BufWriter};
use std::mem::offset_of;
use std::path::Path;

use super::event::{monitor as watched_by, roundel_monitor};
use super::failure::{Failure, Outcome};
use super::guard::{self, boundary};
use super::input::path;
use super::options::roundel_options;
use super::output::{Out, optional};
use super::problem::roundel_problem;
use super::solution::roundel_solution;
use super::status::{roundel_status, roundel_stopped_by};
use crate::error::Error;
use crate::problem::Problem;
use crate::problem::files::io_error;
use crate::proof::{self, Proof, Verdict};
use crate::search::Options;
use crate::solve::solve_with_proof;

/// What a proof proves.
#[repr(C)]
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct roundel_proof_report {
    /// The energy of the point, rounded to the next number above; infinite if there is no point.
    pub energy: f64,
    /// No point within all rows, bounds and integers has less energy; infinite if there is no such point.
    pub lower_bound: f64,
    /// The largest violation of a row or bound by the point, relative to the sizes of its terms. The checker
    /// computes it; 0 after a solve.
    pub violation: f64,
    /// The nodes of all trees.
    pub nodes: i64,
    /// What stopped the writing of the proof, a roundel_stopped_by: then there is no proof, energy is infinite and
    /// lower_bound is minus infinity. ROUNDEL_STOPPED_BY_NONE for a proof that is written, or accepted.
    pub stopped_by: i32,
    /// Zero; reserved.
    pub reserved: [i32; 7],
}

const _: () = {
    assert!(size_of::<roundel_proof_report>() == 64);
    assert!(offset_of!(roundel_proof_report, stopped_by) == 32);
};

impl roundel_proof_report {
    fn new(energy: Option<f64>, lower_bound: Option<f64>, nodes: usize) -> Self {
        roundel_proof_report {
            energy: energy.unwrap_or(f64::INFINITY),
            lower_bound: lower_bound.unwrap_or(f64::INFINITY),
            violation: 0.0,
            nodes: i64::try_from(nodes).unwrap_or(i64::MAX),
            stopped_by: roundel_stopped_by::ROUNDEL_STOPPED_BY_NONE as i32,
            reserved: [0; 7],
        }
    }

    fn of_proof(proof: &Proof) -> Self {
        Self::new(proof.energy(), proof.lower_bound(), proof.nodes())
    }

    fn of_verdict(verdict: &Verdict) -> Self {
        roundel_proof_report {
            violation: verdict.violation,
            ..Self::new(verdict.energy, verdict.lower_bound, verdict.nodes)
        }
    }

    /// No proof, which proves nothing.
    fn of_none(stopped_by: roundel_stopped_by) -> Self {
        roundel_proof_report {
            stopped_by: stopped_by as i32,
            ..Self::new(None, Some(f64::NEG_INFINITY), 0)
        }
    }
}

/// Solves a problem and writes a proof of the bound to a file, for roundel_proof_check. The strategy must be "exact"
/// or "auto". `options`, `monitor` and `solution` are those of roundel_problem_solve. `report` receives what is
/// proved; it may be NULL.
///
/// Half of the option time_limit is for the search at most, so that time is left for the proof. A proof that the
/// limit or a cancel ends is not written: the call succeeds, with the solution, and the member stopped_by of the
/// report says why.
///
/// A problem without a solution gets a proof of that. The call then fails as roundel_problem_solve does, with
/// ROUNDEL_ERROR_INFEASIBLE or ROUNDEL_ERROR_NO_INTEGER_SOLUTION, and the proof is in the file.
///
/// Apart from the errors of roundel_problem_solve, fails with ROUNDEL_ERROR_INVALID_ARGUMENT for another strategy, with
/// ROUNDEL_ERROR_NOT_SUPPORTED for what cannot be proved, and with ROUNDEL_ERROR_IO. A file that exists is replaced
/// once there is a proof, and no file is made without one.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn roundel_problem_solve_with_proof(
    problem: *const roundel_problem,
    options: *const roundel_options,
    monitor: *const roundel_monitor,
    file: *const c_char,
    report: *mut roundel_proof_report,
    solution: *mut *mut roundel_solution,
) -> roundel_status {
    let body = |problem: &Problem| {
        let default = Options::default();
        // SAFETY: the caller gives a live handle or NULL, a monitor as its members say or NULL, a text or NULL,
        // a place for the report or NULL, and one for the solution or NULL.
        let (options, monitor, file, report, out) = unsafe {
            (
                guard::value_or(options, &default)?,
                watched_by(monitor)?,
                path("file", file)?,
                optional("report", report)?,
                Out::new("solution", solution)?,
            )
        };
        may_be_written(file)?;
        let proved = solve_with_proof(problem, options, monitor)?;
        let told = match &proved.proof {
            Ok(proof) => {
                write(file, proof)?;
                roundel_proof_report::of_proof(proof)
            }
            Err(stopped_by) => roundel_proof_report::of_none((*stopped_by).into()),
        };
        let found = proved.outcome?;
        if let Some(report) = report {
            report.set(told);
        }
        out.set(guard::handle(found));
        Ok(())
    };
    // SAFETY: the caller gives a live handle, or NULL.
    unsafe { guard::read(problem, body) }
}

/// Checks the proof in a file, in exact numbers. `problem` is the problem that the proof must be of; NULL for any.
/// `report` receives what is proved; it may be NULL.
///
/// Fails with ROUNDEL_ERROR_PROOF_REFUSED and the line at fault for a proof that does not hold, and for a file that is
/// no proof, and with ROUNDEL_ERROR_IO for one that cannot be opened.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn roundel_proof_check(
    file: *const c_char,
    problem: *const roundel_problem,
    report: *mut roundel_proof_report,
) -> roundel_status {
    let body = |problem: Option<&Problem>| {
        // SAFETY: the caller gives a text or NULL, and a place for the report or NULL.
        let (file, report) = unsafe { (path("file", file)?, optional("report", report)?) };
        let opened = File::open(file).map_err(|reason| io_error(file, reason))?;
        let reader = BufReader::new(opened);
        let checked = match problem {
            Some(problem) => proof::check_of(problem, reader),
            None => proof::check(reader),
        };
        let verdict = checked.map_err(Failure::Refused)?;
        if let Some(report) = report {
            report.set(roundel_proof_report::of_verdict(&verdict));
        }
        Ok(())
    };
    if problem.is_null() {
        return boundary(None, || body(None));
    }
    // SAFETY: the caller gives a live handle.
    unsafe { guard::read(problem, |problem| body(Some(problem))) }
}

/// Fails before the solve, and not after it, for a file that cannot be written. A file that is made for that is
/// removed again; a symbolic link to it stays.
fn may_be_written(file: &Path) -> Outcome {
    let failed = |reason| io_error(file, reason);
    let is_new = !file.exists();
    let opened = File::options().append(true).create(true).open(file);
    opened.map_err(failed)?;
    if is_new {
        let made = fs::canonicalize(file).map_err(failed)?;
        fs::remove_file(made).map_err(failed)?;
    }
    Ok(())
}

fn write(file: &Path, proof: &Proof) -> Result<(), Error> {
    let made = File::create(file).map_err(|reason| io_error(file, reason))?;
    let written = proof.write(BufWriter::new(made));
    written.map_err(|reason| io_error(file, reason))
}

#[cfg(all(test, unix))]
mod tests {
    use super::*;
    use std::os::unix::fs::symlink;

    #[test]
    fn a_link_to_a_file_that_does_not_exist_yet_stays() {
        let folder = std::env::temp_dir().join(format!("roundel-link-{}", std::process::id()));
        fs::create_dir_all(&folder).unwrap();
        let (link, target) = (folder.join("link"), folder.join("target"));
        symlink("target", &link).unwrap();
        let written = may_be_written(&link);
        let is_link = fs::symlink_metadata(&link).map(|found| found.is_symlink());
        let is_made = target.exists();
        fs::remove_dir_all(&folder).unwrap();
        assert!(written.is_ok() && is_link.unwrap() && !is_made);
    }
}
