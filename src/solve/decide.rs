//! Which method a strategy comes to on a given model.

use super::{Factors, Options, Search, Strategy};
use crate::eliminate::ReducedModel;
use crate::{Result, lattice, round};

/// `auto`: nodes of the proof for each entry of the reduced Hessian.
///
/// The relaxation reads and factors these entries at about 100 operations each on mesh problems,
/// a node takes about ten: so a proof that succeeds costs a few relaxations, and one that fails
/// not more.
const AUTO_NODES: u64 = 50;

/// Lets the strategy of `options` search.
///
/// The lattice strategies need a dense matrix of the integers; beyond `dense_integers` they come
/// to `adaptive`.
///
/// # Errors
/// Those of the method.
pub(super) fn search(
    model: &ReducedModel,
    options: &Options,
    factors: &mut Factors,
    search: &mut Search,
) -> Result<()> {
    let dense = model.integers().len() <= options.dense_integers;
    match options.strategy {
        Strategy::Relax => Ok(()),
        Strategy::Direct => round::direct(model, factors, search),
        Strategy::Greedy => round::greedy(model, factors, search),
        Strategy::Lattice if dense => lattice::lattice(model, options, factors, search),
        Strategy::Exact if dense => {
            lattice::exact(model, options, options.nodes as u64, factors, search)
        }
        Strategy::Auto if dense => {
            let budget = AUTO_NODES * model.hessian().len() as u64;
            let nodes = budget.min(options.nodes as u64);
            lattice::exact(model, options, nodes, factors, search)
        }
        Strategy::Adaptive | Strategy::Lattice | Strategy::Exact | Strategy::Auto => {
            round::adaptive(model, options, factors, search)
        }
    }
}
