//! The elimination from start to end.

use super::tableau::Tableau;
use super::tolerance::CONSISTENT;
use super::{ReducedModel, back, continuous, integral, project, subtree, sweep};
use crate::solve::{Monitor, Phase};
use crate::{Model, Result};

/// Removes the equality constraints and the pinned unknowns of `model`.
///
/// Reduced unknowns are the caller's unknowns that survive, in their order, and after them those
/// that had to be introduced. Every solution of the constraints, with its integers integer, is
/// `T y + t` for exactly one `y` with its integers integer, and every such `y` gives one.
///
/// # Errors
/// [`Infeasible`](crate::Error::Infeasible) and
/// [`NoIntegerSolution`](crate::Error::NoIntegerSolution) with the row at which it shows,
/// [`NotSupported`](crate::Error::NotSupported) for a relation of integers with incommensurable
/// coefficients, [`Overflow`](crate::Error::Overflow) where integers beyond 2^53 would be needed,
/// [`OutOfMemory`](crate::Error::OutOfMemory), and what `monitor` asks for.
pub fn eliminate(model: &Model, monitor: &mut Monitor) -> Result<ReducedModel> {
    monitor.progress(Phase::Eliminate, 0.0)?;
    let mut tableau = Tableau::new(model)?;
    let rows = tableau.rows.len().max(1) as f64;
    let mut done = 0usize;
    while let Some(r) = tableau.take_shortest() {
        done += 1;
        monitor.progress(Phase::Eliminate, 0.5 * done as f64 / rows)?;
        eliminate_row(&mut tableau, r)?;
    }
    while let Some(r) = tableau.take_long() {
        done += 1;
        monitor.progress(Phase::Eliminate, 0.5 * done as f64 / rows)?;
        sweep::sweep(&mut tableau, r, monitor)?;
        subtree::shorten(&mut tableau, r, monitor)?;
        eliminate_row(&mut tableau, r)?;
    }
    let reduced = reduced_model(&tableau, monitor)?;
    monitor.progress(Phase::Eliminate, 1.0)?;
    Ok(reduced)
}

fn eliminate_row(tableau: &mut Tableau, r: usize) -> Result<()> {
    let row = &tableau.rows[r];
    if row.entries.is_empty() {
        let tolerance = CONSISTENT * row.magnitude.max(row.rhs_magnitude);
        let holds = row.rhs == 0.0 || (!row.integral && row.rhs.abs() <= tolerance);
        return if holds {
            Ok(())
        } else {
            Err(tableau.infeasible(r))
        };
    }
    if row.continuous > 0 {
        continuous::eliminate(tableau, r)
    } else {
        integral::eliminate(tableau, r)
    }
}

fn reduced_model(tableau: &Tableau, monitor: &mut Monitor) -> Result<ReducedModel> {
    let model = tableau.model;
    let (expansion, free) = back::substitute_back(tableau, monitor)?;
    let hessian = if tableau.stack.len() == 0 {
        project::with_diagonal(model.hessian())?
    } else {
        project::hessian(model.hessian(), expansion.matrix(), monitor)?
    };
    let (gradient, constant) = project::linear(model, &expansion)?;
    let is_integer = |&(_, &u): &(usize, &u32)| tableau.unknowns.integer[u as usize];
    let (integers, continuous): (Vec<_>, Vec<_>) = free.iter().enumerate().partition(is_integer);
    let numbers = |list: Vec<(usize, &u32)>| list.into_iter().map(|(y, _)| y as u32).collect();
    Ok(ReducedModel {
        hessian,
        gradient,
        constant,
        integers: numbers(integers),
        continuous: numbers(continuous),
        guess: free
            .iter()
            .map(|&u| tableau.unknowns.guess[u as usize])
            .collect(),
        expansion,
    })
}
