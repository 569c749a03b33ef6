//! The proof for the incumbent of a search: its bound rises while the lists grow, and where the list of the
//! root is complete, its charges are offered.

use super::account::Account;
use super::conditions::conditions;
use super::effort::Proof;
use super::schedule::{Rounds, Standing, Watch};
use super::tree::{PatchTree, System};
use crate::cycle::space::CycleSpace;
use crate::eliminate::ReducedModel;
use crate::error::Result;
use crate::linalg::sum_below;
use crate::search::{Factors, Search};

/// The number of charges that are evaluated where the list of the root ends a proof.
const CANDIDATES: usize = 64;

/// On systems of more cycles, conditions of optimality take longer than they save.
const CONDITIONED: usize = 7_000;

/// The rounds for which each tree is tried.
const TRIAL_ROUNDS: usize = 2;

/// A search that watches a proof. The bounds of the proof are energies above `base`.
struct Watched<'a, 's, 'm> {
    search: &'a mut Search<'s, 'm>,
    left: u64,
    /// The nodes that may still be visited.
    nodes: u64,
    base: f64,
    gap: f64,
    account: Option<Account>,
}

impl Watch for Watched<'_, '_, '_> {
    fn ends(&mut self, work: u64) -> bool {
        self.search.work.spend(work);
        self.left = self.left.saturating_sub(work);
        let is_enough = self.gap > 0.0 && self.search.is_within(self.gap);
        self.left == 0 || is_enough || self.search.monitor.ends()
    }

    fn nodes(&self) -> u64 {
        self.nodes
    }

    fn visited(&mut self, nodes: u64) {
        self.nodes -= nodes;
    }

    fn raised(&mut self, bound: f64) {
        if let Some(account) = &self.account {
            let bound = sum_below(&[self.base, account.lower(bound)]);
            // The energies of the search have errors of their own, so no proof goes beyond the incumbent.
            let most = self.search.best().map_or(f64::INFINITY, |b| b.at_least);
            self.search.raise_bound(bound.min(most));
        }
    }
}

/// Raises the bound of the search, whose relaxation has the bound `relaxation`, and offers charges that
/// are better than the incumbent if the proof finds some. Returns whether the search visited all charges
/// that could be better.
///
/// # Errors
/// For lack of memory, and those of the evaluation of offers.
pub(in crate::cycle) fn prove(
    model: &ReducedModel,
    space: &CycleSpace,
    relaxation: f64,
    effort: &Proof,
    gap: f64,
    factors: &mut Factors,
    search: &mut Search,
) -> Result<bool> {
    let Some(integers) = search.incumbent_integers() else {
        return Ok(false);
    };
    let graph = &space.system.graph;
    let (x, _) = space.potentials(&space.charges(&integers));
    let residuals: Vec<f64> = (0..graph.edges.len())
        .map(|e| space.residual(&x, e))
        .collect();
    let squares = graph.edges.iter().zip(&residuals);
    let energy: f64 = squares.map(|(e, r)| e.weight * r * r).sum();
    let system = System {
        graph,
        step: space.system.step,
        kappa: &space.kappa,
    };
    let base = relaxation + uncoupled_energy(model, space, search);
    let mean = graph.edges.iter().map(|e| e.weight).sum::<f64>() / graph.edges.len().max(1) as f64;
    let unit = system.step * system.step * mean;
    let offsets = space.offset_error(model, search);
    let mut watch = Watched {
        search,
        left: effort.work,
        nodes: effort.nodes,
        base,
        gap,
        account: None,
    };
    let mut best: Option<(f64, PatchTree, Account)> = None;
    for recipe in &effort.recipes {
        if best.is_some() && effort.work - watch.left > effort.trials {
            break;
        }
        let tree = PatchTree::new(system, &residuals, recipe, &mut |w| watch.ends(w))?;
        let Some(tree) = tree else {
            break;
        };
        let account = Account::new(system, &tree, 2.0 * energy, offsets);
        let Some(cap) = account.upper(energy) else {
            continue;
        };
        watch.account = Some(account);
        watch.raised(0.0);
        if effort.recipes.len() == 1 {
            best = Some((0.0, tree, account));
            break;
        }
        let mut rounds = Rounds::new(&tree, cap, unit, effort.threads);
        let standing = rounds.run(TRIAL_ROUNDS, &mut watch);
        let bound = rounds.bound();
        let decided = standing == Standing::Decided;
        drop(rounds);
        if decided || best.as_ref().is_none_or(|b| bound > b.0) {
            best = Some((bound, tree, account));
        }
        if standing != Standing::Open {
            break;
        }
    }
    let Some((_, tree, account)) = best else {
        return Ok(false);
    };
    watch.account = Some(account);
    let Some(cap) = account.upper(energy) else {
        return Ok(false);
    };
    let mut rounds = Rounds::new(&tree, cap, unit, effort.threads);
    if effort.conditions && tree.basis.len() <= CONDITIONED {
        let stop = &mut |w| watch.ends(w);
        let conditions = conditions(system, &tree, &account, cap, stop);
        rounds.hold(conditions);
    }
    if rounds.run(usize::MAX, &mut watch) != Standing::Decided {
        return Ok(false);
    }
    let Some(&least) = rounds.root_energies().first() else {
        return Ok(false);
    };
    let rival = account.upper(least).unwrap_or(cap);
    if !rounds.complete(rival, &mut watch) {
        return Ok(false);
    }
    let rivals = rounds.root_energies().partition_point(|&e| e <= rival);
    for k in 0..rivals.min(CANDIDATES) {
        let integers = space.integers_on(&tree.basis.chords, &rounds.charges(k));
        watch.search.offer(factors, &integers)?;
    }
    Ok(rivals <= CANDIDATES)
}

/// The least energy of the integers that couple to nothing.
fn uncoupled_energy(model: &ReducedModel, space: &CycleSpace, search: &Search) -> f64 {
    let diagonal = model.hessian().entries().filter(|(i, j, _)| i == j);
    let mut curvature = vec![0.0; model.dim()];
    diagonal.for_each(|(i, _, v)| curvature[i as usize] = v);
    let relaxed = search.relaxed();
    let integers = model.integers().iter().zip(&space.system.sign);
    integers
        .filter(|(_, sign)| **sign == 0)
        .map(|(&i, _)| {
            let x = relaxed[i as usize];
            let off = (x - x.round()).abs() - 4.0 * f64::EPSILON * x.abs();
            0.5 * curvature[i as usize] * off.max(0.0).powi(2) * (1.0 - 4.0 * f64::EPSILON)
        })
        .sum()
}
