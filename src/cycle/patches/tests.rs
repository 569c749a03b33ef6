//! Proofs by trees of patches against flat enumeration and brute force, on small random systems.

use super::bisect::{Measure, bisect};
use super::coarsen::Weighted;
use super::dissect::{Recipe, dissect};
use super::effort::Proof;
use super::factor::eliminate;
use super::local::inverse;
use super::prove::prove;
use crate::cycle::space::CycleSpace;
use crate::cycle::tests::{Sketch, energy, reduced, space};
use crate::eliminate::ReducedModel;
use crate::error::Error;
use crate::lattice;
use crate::linalg::{self, Lowest, Minimum, Ordering};
use crate::monitor::{CancelToken, Monitor, Stop, spawned, with_threads};
use crate::problem::Problem;
use crate::round::nearest;
use crate::search::{Factors, Options, Search, Strategy};
use crate::test_random::Random;

/// The number of random systems that are compared with flat enumeration.
const SYSTEMS: usize = 900;

/// The work of a proof that may take as long as it needs.
const UNLIMITED: u64 = u64::MAX;

fn proof(leaf: usize, work: u64, seed: u64, conditions: bool) -> Proof {
    let recipe = Recipe {
        leaf,
        floors: vec![0.2, 1.0],
        tries: 1,
        price: 0.02,
        balance: 0.5,
        seed,
    };
    Proof {
        recipes: vec![recipe],
        trials: 0,
        work,
        nodes: u64::MAX,
        conditions,
    }
}

/// Runs `method` on a search at the relaxation of a model. Returns the energy of its best solution, its
/// bound, and the result.
fn searched<T>(
    problem: &Problem,
    method: impl FnOnce(&ReducedModel, &mut Factors, &mut Search) -> T,
) -> (f64, f64, T) {
    let (model, reduced) = reduced(problem);
    let mut factors = Factors::new(Ordering::FillReducing);
    let relaxed = factors.minimise(&reduced, Strategy::Exact, || {
        reduced.gradient_rounding(&model)
    });
    let Minimum::At(Lowest { point, excess }) = relaxed.unwrap() else {
        panic!("the relaxation has a minimum");
    };
    let (energy, error) = reduced.energy(&point);
    let bound = energy - 2.0 * excess - error;
    let mut monitor = Monitor::default();
    let mut search = Search::new(&reduced, point, bound, &mut monitor);
    let result = method(&reduced, &mut factors, &mut search);
    let bound = search.lower_bound();
    (search.into_best().unwrap().energy, bound, result)
}

/// Flat enumeration.
fn flat(problem: &Problem) -> f64 {
    let options = Options::default();
    let (energy, ..) = searched(problem, |reduced, factors, search| {
        lattice::exact(reduced, &options, factors, search).unwrap();
    });
    energy
}

/// A proof from a poor incumbent.
fn by_tree(problem: &Problem, space: &CycleSpace, proof: &Proof) -> (f64, f64, bool) {
    searched(problem, |reduced, factors, search| {
        let relaxed = search.relaxed();
        let integers = reduced.integers().iter();
        let start: Vec<f64> = integers.map(|&i| nearest(relaxed[i as usize])).collect();
        search.offer(factors, &start).unwrap();
        let relaxation = search.lower_bound();
        prove(reduced, space, relaxation, proof, 0.0, factors, search).unwrap()
    })
}

/// Edges of a grid and some random ones, parallel ones included.
fn grid(random: &mut Random) -> Sketch {
    let (rows, columns) = (2 + random.below(4), 2 + random.below(5));
    let nodes = rows * columns;
    let mut links = Vec::new();
    for i in 0..nodes {
        if i % columns + 1 < columns {
            links.push((i, i + 1));
        }
        if i + columns < nodes {
            links.push((i, i + columns));
        }
    }
    for _ in 0..random.below(4) {
        let (i, j) = (random.below(nodes), random.below(nodes));
        if i != j {
            links.push((i, j));
        }
    }
    let pinned: Vec<usize> = (0..nodes).filter(|_| random.unit() < 0.15).collect();
    Sketch::of(nodes, links, &pinned, random.unit() < 0.5)
}

#[test]
fn the_tree_agrees_with_flat_enumeration() {
    let mut random = Random::new(11);
    let (mut proved, mut divided) = (0, 0);
    for round in 0..SYSTEMS {
        let sketch = match round % 3 {
            0 => Sketch::random(&mut random, round % 2 == 0),
            _ => grid(&mut random),
        };
        let problem = sketch.problem(&mut random);
        let Some((_, space)) = space(&problem) else {
            continue;
        };
        let expected = flat(&problem);
        let leaf = 1 + random.below(6);
        let (energy, bound, complete) = by_tree(
            &problem,
            &space,
            &proof(leaf, UNLIMITED, round as u64, round % 2 == 0),
        );
        let tolerance = 1e-9 * (1.0 + expected);
        assert!(complete, "round {round}");
        assert!(
            (energy - expected).abs() <= tolerance,
            "round {round}: {energy} {expected}"
        );
        // The energy of the flat enumeration has an error of its own.
        let own = 1e-12 * (1.0 + expected.abs());
        assert!(bound <= expected + own, "round {round}: {bound} {expected}");
        assert!(
            bound >= expected - 1e-6 * (1.0 + expected),
            "round {round}: {bound} {expected}"
        );
        proved += 1;
        divided += usize::from(space.basis.len() > leaf);
    }
    assert!(
        proved > SYSTEMS / 2 && divided > SYSTEMS / 3,
        "{proved} {divided}"
    );
}

#[test]
fn a_proof_that_ends_early_has_a_bound_below_the_optimum() {
    let mut random = Random::new(12);
    let (mut open, mut above) = (0, 0);
    for round in 0..SYSTEMS / 3 {
        let problem = grid(&mut random).problem(&mut random);
        let Some((reduced, space)) = space(&problem) else {
            continue;
        };
        let expected = flat(&problem);
        let work = 1 << (10 + random.below(9));
        let whole = proof(3, work, round as u64, round % 2 == 0);
        // Every third ends for its nodes alone.
        let limited = Proof {
            work: UNLIMITED,
            nodes: work >> 8,
            ..whole.clone()
        };
        let effort = [&whole, &whole, &limited][round % 3];
        let (_, bound, complete) = by_tree(&problem, &space, effort);
        assert!(bound <= expected, "round {round}: {bound} {expected}");
        assert_eq!(reduced.integers().len(), space.origin.len());
        open += usize::from(!complete);
        above += usize::from(!complete && bound > 1e-3 * expected);
    }
    assert!(open > 20 && above > 0, "{open} {above}");
}

/// Every choice of integers within two of the relaxation's, each solved for its angles separately.
#[test]
fn the_tree_agrees_with_brute_force() {
    let mut random = Random::new(13);
    let mut compared = 0;
    while compared < 12 {
        let sketch = Sketch::random(&mut random, true);
        let problem = sketch.problem(&mut random);
        let Some((_, space)) = space(&problem) else {
            continue;
        };
        let count = space.origin.len();
        if !(1..=4).contains(&count) {
            continue;
        }
        let mut least = f64::INFINITY;
        for code in 0..5usize.pow(count as u32) {
            let shift = |k: usize| (code / 5usize.pow(k as u32) % 5) as f64 - 2.0;
            let integers: Vec<f64> = (0..count).map(|k| space.origin[k] + shift(k)).collect();
            least = least.min(energy(&problem, &integers));
        }
        let (energy, bound, complete) =
            by_tree(&problem, &space, &proof(1, UNLIMITED, 1, compared % 2 == 0));
        assert!(complete && bound <= least, "{bound} {least}");
        assert!(
            (energy - least).abs() < 1e-9 * (1.0 + least),
            "{energy} {least}"
        );
        compared += 1;
    }
}

#[test]
fn the_steps_of_a_tree_end_with_their_call() {
    let links = (0..99).map(|i| (i, i + 1, 1.0));
    let path = Weighted::new(vec![1.0; 100], links);
    let halved = || bisect(&path, Measure { balance: 0.8 }, &mut linalg::Random::new(1));
    let eliminated = || eliminate(&mut [4.0], 1, 1);
    assert!(halved().is_ok() && eliminated().is_some() && inverse(&[2.0], 1).is_ok());
    let token = CancelToken::new();
    token.cancel();
    let _watch = Monitor::default().cancel_token(token).watch();
    assert_eq!(halved(), Err(Stop::Cancelled));
    assert_eq!(eliminated(), None);
    assert_eq!(inverse(&[2.0], 1), Err(Error::Cancelled));
}

#[test]
fn threads_dissect_a_graph_as_one_does() {
    let problem = Sketch::torus(48, &[0]).problem(&mut Random::new(5));
    let (_, space) = space(&problem).unwrap();
    let graph = &space.system.graph;
    let mut random = Random::new(6);
    let residuals: Vec<f64> = graph.edges.iter().map(|_| random.unit() - 0.5).collect();
    let recipe = &proof(16, UNLIMITED, 7, false).recipes[0];
    let dissected = |threads: usize, most: u64| {
        with_threads(threads, || dissect(graph, &residuals, recipe, most))
    };
    let (alone, work) = dissected(1, UNLIMITED);
    let alone = alone.unwrap();
    let of_all: usize = alone.iter().map(|patch| patch.edges.len()).sum();
    assert!(alone.len() > 50 && of_all == graph.edges.len());
    for threads in [2, 5] {
        let started = spawned(|| {
            let (together, work_together) = dissected(threads, UNLIMITED);
            let same =
                together.unwrap().into_iter().zip(&alone).all(|(a, b)| {
                    (a.parent, a.children, &a.edges) == (b.parent, b.children, &b.edges)
                });
            assert!(same && work_together == work);
        });
        assert!(started > 0);
        let (ended, taken) = dissected(threads, work);
        assert!(ended.is_none() && taken == work);
    }
}
