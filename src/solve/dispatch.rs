//! The choice of method for a strategy on a given model.

use crate::eliminate::ReducedModel;
use crate::error::{Error, Result};
use crate::problem::Model;
use crate::search::{Factors, Options, Search, StoppedBy, Strategy, of_relaxation};
use crate::{cut, cycle, lattice, round};

/// The multiplications of the lattice method before its first decision are this times `m^3`, for m
/// integers: the Schur complement, the reduction, and the new computation of R.
const DENSE: u64 = 12;

/// Runs the strategy of `options`.
///
/// Problems with integers alone whose Hessian is a graph Laplacian plus a diagonal are solved by minimum
/// cuts, and angle-difference systems in cycle space, both of any size. For other problems the lattice
/// strategies need a dense matrix of the integers. With more than `dense_integers` integers, `adaptive` is
/// used instead. `auto` rounds the relaxation before anything else.
///
/// # Errors
/// Those of the method.
pub(super) fn search(
    given: &Model,
    model: &ReducedModel,
    options: &Options,
    factors: &mut Factors,
    search: &mut Search,
) -> Result<()> {
    let m = model.integers().len();
    let mut few = m <= options.dense_integers;
    if options.strategy == Strategy::Auto {
        let limit = search.work.limit_to_auto(of_relaxation(model));
        if few && DENSE * (m as u64).pow(3) > limit {
            few = false;
            search.stop_by(StoppedBy::Budget);
        }
    }
    if options.strategy == Strategy::Auto && !search.monitor.ends() {
        // A first answer, while the better ones take their time.
        match round::direct(model, factors, search) {
            Err(Error::Overflow { .. }) => {}
            other => other?,
        }
        if search.monitor.ends() {
            return Ok(());
        }
    }
    match options.strategy {
        Strategy::Relax => Ok(()),
        // The caller wants what is found in the least time.
        _ if search.monitor.ends() => round::direct(model, factors, search),
        Strategy::Direct => round::direct(model, factors, search),
        Strategy::Greedy => round::greedy(model, factors, search).map(drop),
        Strategy::Adaptive => round::adaptive(model, options, factors, search),
        Strategy::Multiple => round::multiple(model, options, factors, search),
        Strategy::Lattice | Strategy::Exact | Strategy::Auto
            if cut::exact(model, factors, search)? =>
        {
            Ok(())
        }
        Strategy::Lattice if cycle::lattice(given, model, factors, search)? => Ok(()),
        Strategy::Auto if cycle::auto(given, model, options, factors, search)? => Ok(()),
        Strategy::Exact if cycle::exact(given, model, options, factors, search)? => Ok(()),
        Strategy::Lattice if few => lattice::lattice(model, options, factors, search),
        Strategy::Exact | Strategy::Auto if few => lattice::exact(model, options, factors, search),
        Strategy::Lattice | Strategy::Exact | Strategy::Auto => {
            round::adaptive(model, options, factors, search)
        }
    }
}
