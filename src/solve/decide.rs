//! Which method a strategy comes to on a given model.

use super::{Factors, Options, Search, Strategy};
use crate::eliminate::ReducedModel;
use crate::{Model, Result, cycle, lattice, round};

/// `auto`: nodes of the proof for each entry of the reduced Hessian.
///
/// The relaxation reads and factors these entries at about 100 operations each on mesh problems,
/// a node takes about ten: so a proof that succeeds costs a few relaxations, and one that fails
/// not more.
const AUTO_NODES: u64 = 50;

/// `auto`: angle-difference systems of at most this many integers are tried to prove as well.
const PROVABLE: usize = 60;

/// Lets the strategy of `options` search.
///
/// Angle-difference systems are decided in cycle space, whatever their size. For other problems the
/// lattice strategies need a dense matrix of the integers; beyond `dense_integers` they come to
/// `adaptive`.
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
    let few = model.integers().len() <= options.dense_integers;
    let provable = model.integers().len() <= PROVABLE;
    match options.strategy {
        Strategy::Relax => Ok(()),
        Strategy::Direct => round::direct(model, factors, search),
        Strategy::Greedy => round::greedy(model, factors, search),
        Strategy::Adaptive => round::adaptive(model, options, factors, search),
        Strategy::Multiple => round::multiple(model, options, factors, search),
        Strategy::Lattice if cycle::lattice(given, model, factors, search)? => Ok(()),
        Strategy::Auto
            if cycle::auto(given, model, options, factors, search)? && !(few && provable) =>
        {
            Ok(())
        }
        Strategy::Lattice if few => lattice::lattice(model, options, factors, search),
        Strategy::Exact if few => {
            lattice::exact(model, options, options.nodes as u64, factors, search)
        }
        Strategy::Auto if few => {
            let budget = AUTO_NODES * model.hessian().len() as u64;
            let nodes = budget.min(options.nodes as u64);
            lattice::exact(model, options, nodes, factors, search)
        }
        Strategy::Exact if cycle::auto(given, model, options, factors, search)? => Ok(()),
        Strategy::Lattice | Strategy::Exact | Strategy::Auto => {
            round::adaptive(model, options, factors, search)
        }
    }
}
