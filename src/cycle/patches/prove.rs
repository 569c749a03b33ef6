//! The proof for the incumbent of a search: its bound rises while the lists grow, and where the list of the
//! root is complete, its charges are offered.

use super::account::Account;
use super::conditions::conditions;
use super::dissect::Recipe;
use super::effort::Proof;
use super::schedule::{Rounds, Standing};
use super::tree::{PatchTree, System};
use super::watch::{Counted, Task, Watch, counted};
use crate::cycle::space::CycleSpace;
use crate::eliminate::ReducedModel;
use crate::error::Result;
use crate::linalg::sum_below;
use crate::monitor::{Monitor, Started, allowed_threads, span, with_threads};
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
    /// The nodes that may still be visited: `u64::MAX` without a limit.
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

    fn left(&self) -> u64 {
        self.left
    }

    fn nodes(&self) -> u64 {
        self.nodes
    }

    fn visited(&mut self, nodes: u64) {
        if self.nodes != u64::MAX {
            self.nodes = self.nodes.saturating_sub(nodes);
        }
    }

    fn raised(&mut self, bound: f64) {
        if let Some(account) = &self.account {
            let bound = sum_below(&[self.base, account.lower(bound)]);
            // The energies of the search have errors of their own, so no proof goes beyond the incumbent.
            let most = self.search.best().map_or(f64::INFINITY, |b| b.at_least);
            self.search.raise_bound(bound.min(most));
        }
    }

    fn at_once(&mut self, count: usize, task: &Task) -> bool {
        let done = Counted::tasks(count, (self.left, self.nodes), self.search.monitor, task);
        counted(self, &done)
    }
}

/// Raises the bound of the search, whose relaxation has the bound `relaxation`, and offers charges that
/// are better than the incumbent if the proof finds some. Returns whether the search visited all charges
/// that could be better.
///
/// # Errors
/// For lack of memory, the end of the call, and those of the evaluation of offers.
pub(in crate::cycle) fn prove(
    model: &ReducedModel,
    space: &CycleSpace,
    relaxation: f64,
    effort: &Proof,
    gap: f64,
    factors: &mut Factors,
    search: &mut Search,
) -> Result<bool> {
    let _span = span("prove");
    let _watch = search.monitor.watch_search();
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
    let trials = Trials {
        system,
        residuals: &residuals,
        energy,
        offsets,
        unit,
    };
    let best = match &effort.recipes[..] {
        [recipe] => trials.tree(recipe, &mut watch)?,
        _ => trials.best(effort, &mut watch)?,
    };
    let Some((tree, account)) = best else {
        return Ok(false);
    };
    watch.account = Some(account);
    watch.raised(0.0);
    let Some(cap) = account.upper(energy) else {
        return Ok(false);
    };
    let mut rounds = Rounds::new(&tree, cap, unit);
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

/// The trees that are tried.
#[derive(Clone, Copy)]
struct Trials<'a> {
    system: System<'a>,
    residuals: &'a [f64],
    energy: f64,
    offsets: f64,
    unit: f64,
}

/// A tree, and what the first rounds on it prove.
struct Trial {
    tree: PatchTree,
    account: Account,
    bound: f64,
    standing: Standing,
}

/// A trial, with its work and its nodes. There is none if the watch ended it, or if the tree has no cap.
struct Tried {
    trial: Option<Trial>,
    work: u64,
    nodes: u64,
}

impl Trials<'_> {
    /// A tree. `None` if the watch ends it.
    fn tree(&self, recipe: &Recipe, watch: &mut dyn Watch) -> Result<Option<(PatchTree, Account)>> {
        let Some(tree) = PatchTree::new(self.system, self.residuals, recipe, watch)? else {
            return Ok(None);
        };
        let account = Account::new(self.system, &tree, 2.0 * self.energy, self.offsets)?;
        Ok(Some((tree, account)))
    }

    /// The first rounds on the tree of a recipe, with at most so much work and so many nodes.
    fn run(&self, recipe: &Recipe, most: (u64, u64), monitor: &mut Monitor) -> Result<Tried> {
        let mut watch = Counted::new(monitor, most);
        let mut trial = None;
        if let Some((tree, account)) = self.tree(recipe, &mut watch)?
            && let Some(cap) = account.upper(self.energy)
        {
            let mut rounds = Rounds::new(&tree, cap, self.unit);
            let standing = rounds.run(TRIAL_ROUNDS, &mut watch);
            let bound = rounds.bound();
            trial = Some(Trial {
                tree,
                account,
                bound,
                standing,
            });
        }
        Ok(Tried {
            trial,
            work: watch.work,
            nodes: watch.nodes,
        })
    }

    /// The tree with the best bound, or the first on which the proof ends.
    ///
    /// After the first one, which often suffices, threads try trees beyond those that have been compared. A trial
    /// that exceeds what the trials before it have left is made again with that.
    fn best<'r>(
        &self,
        effort: &'r Proof,
        watch: &mut Watched<'_, '_, '_>,
    ) -> Result<Option<(PatchTree, Account)>> {
        let mut best: Option<Trial> = None;
        let (first, others) = effort.recipes.split_at(effort.recipes.len().min(1));
        let others = others.chunks(allowed_threads());
        for ahead in std::iter::once(first).chain(others) {
            let most = (watch.left, watch.nodes);
            let run =
                |recipe: &'r Recipe| move |monitor: &mut Monitor| self.run(recipe, most, monitor);
            let is_over = match ahead {
                [only] => self.compare(
                    vec![(only, Started::Here(run(only)))],
                    effort,
                    &mut best,
                    watch,
                )?,
                _ => std::thread::scope(|scope| {
                    let start = |(k, recipe): (usize, &'r Recipe)| match k {
                        // The first one is left to this thread.
                        0 => (recipe, Started::Here(run(recipe))),
                        _ => {
                            let worker = watch.search.monitor.worker();
                            (recipe, worker.start(scope, k, run(recipe)))
                        }
                    };
                    let started = ahead.iter().enumerate().map(start).collect();
                    let share = allowed_threads() / ahead.len();
                    with_threads(share.max(1), || {
                        self.compare(started, effort, &mut best, watch)
                    })
                })?,
            };
            if is_over {
                break;
            }
        }
        Ok(best.map(|best| (best.tree, best.account)))
    }

    /// Compares trials with the best one in their order. Returns whether no others follow.
    fn compare<F: FnOnce(&mut Monitor) -> Result<Tried>>(
        &self,
        started: Vec<(&Recipe, Started<'_, Result<Tried>, F>)>,
        effort: &Proof,
        best: &mut Option<Trial>,
        watch: &mut Watched<'_, '_, '_>,
    ) -> Result<bool> {
        for (recipe, started) in started {
            if best.is_some() && effort.work - watch.left > effort.trials {
                return Ok(true);
            }
            let mut tried = started.wait(watch.search.monitor)?;
            let most = (watch.left, watch.nodes);
            if tried.work >= most.0 || tried.nodes > most.1 {
                tried = self.run(recipe, most, watch.search.monitor)?;
            }
            watch.visited(tried.nodes);
            let ends = watch.ends(tried.work);
            let Some(trial) = tried.trial else {
                if ends {
                    return Ok(true);
                }
                continue;
            };
            watch.account = Some(trial.account);
            watch.raised(trial.bound);
            let standing = trial.standing;
            let is_decided = standing == Standing::Decided;
            if is_decided || best.as_ref().is_none_or(|b| trial.bound > b.bound) {
                *best = Some(trial);
            }
            if standing != Standing::Open || watch.ends(0) {
                return Ok(true);
            }
        }
        Ok(false)
    }
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
