//! A search in rounds has the same bits at any number of threads, and proves what a search without rounds proves.

use std::time::{Duration, Instant};

use super::super::form::Interval;
use super::super::relaxation::regularization;
use super::super::tree::{Found, search_in_rounds};
use super::*;
use crate::error::Conflicting;
use crate::linalg::{Random, Sparse};
use crate::monitor::{CancelToken, EventKind, Flow, spawned, with_threads};
use crate::search::StoppedBy;

const ALL: Limits = Limits {
    nodes: u64::MAX,
    work: u64::MAX,
    gap: 0.0,
    elsewhere: 0.0,
    first: false,
    inner: false,
    recorded: false,
};

/// Rounds that begin early and end soon.
const SMALL: Rounds = Rounds {
    after: 5,
    width: 6,
    nodes: 3,
};

/// The whole search without rounds.
const NONE: Rounds = Rounds {
    after: u64::MAX,
    width: 1,
    nodes: 1,
};

/// `|B x - t|^2` with a flat random B, and small squares of all unknowns, over integers from 0 to 3 and reals from
/// -1 to 1, under two rows, of which the first one is narrow.
/// The last real unknown is in no square where `is_singular`.
fn random_form(integers: usize, reals: usize, is_singular: bool, random: &mut Random) -> Form {
    let n = integers + reals;
    let squared = n - usize::from(is_singular);
    let columns: Vec<Vec<f64>> = (0..squared)
        .map(|_| (0..3).map(|_| random.symmetric()).collect())
        .collect();
    let target: Vec<f64> = (0..3).map(|_| 3.0 * random.symmetric()).collect();
    let product = |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(a, b)| a * b).sum::<f64>();
    let mut hessian = Vec::new();
    let mut gradient: Vec<f64> = columns
        .iter()
        .map(|column| -2.0 * product(column, &target))
        .collect();
    gradient.resize(n, 0.1);
    for i in 0..squared {
        let own = (0..=i).map(|j| {
            let small = if i == j { 0.01 } else { 0.0 };
            (
                i as u32,
                j as u32,
                2.0 * product(&columns[i], &columns[j]) + small,
            )
        });
        hessian.extend(own);
    }
    let rows: Vec<_> = (0..2)
        .flat_map(|i| (0..if i == 0 { integers } else { n }).map(move |j| (i, j as u32)))
        .map(|(i, j)| (i, j, 1.0 + 0.8 * random.symmetric()))
        .collect();
    let limits: Vec<Interval> = (0..n)
        .map(|j| match j < integers {
            true => Interval {
                lower: 0.0,
                upper: 3.0,
            },
            false => Interval {
                lower: -1.0,
                upper: 1.0,
            },
        })
        .collect();
    // Few integers are within the first row.
    let narrow = if integers > 8 { 0.02 } else { 0.1 };
    let whole = integers as f64;
    let sides = |lower: f64, upper: f64| Interval { lower, upper };
    let sides = vec![
        sides(whole - narrow, whole + narrow),
        sides(f64::NEG_INFINITY, whole + 1.0),
    ];
    Form {
        hessian: Sparse::from_triplets(n, n, hessian.into_iter()).unwrap(),
        gradient,
        constant: product(&target, &target),
        rows: Sparse::from_triplets(2, n, rows.into_iter()).unwrap(),
        row_limits: sides,
        origins: (0..2).map(Conflicting::Inequality).collect(),
        boxes: limits.clone(),
        limits,
        integer: (0..n).map(|j| j < integers).collect(),
    }
}

fn found(form: &Form, limits: Limits, rounds: &Rounds) -> Found {
    search_in_rounds(form, None, limits, rounds, &mut Monitor::default()).unwrap()
}

/// All that must not depend on threads, in bits.
fn bits(found: &Found) -> Vec<u64> {
    let (point, energy) = found.best.as_ref().unwrap();
    let values = point.iter().chain([energy, &found.bound]);
    let counts = [found.nodes, found.work, u64::from(found.is_complete)];
    values.map(|x| x.to_bits()).chain(counts).collect()
}

#[test]
fn any_number_of_threads_gives_the_same_bits() {
    let mut random = Random::new(5);
    for (integers, reals, is_singular) in [(16, 0, false), (14, 4, false), (13, 3, true)] {
        let form = random_form(integers, reals, is_singular, &mut random);
        let few = Limits { nodes: 200, ..ALL };
        let short = Limits {
            work: 1_000_000,
            ..few
        };
        for limits in [few, short] {
            let one = with_threads(1, || found(&form, limits, &SMALL));
            assert!(one.nodes > 50, "{} nodes", one.nodes);
            for threads in [2, 3, 4, 8] {
                let mut other = None;
                let started = spawned(|| {
                    other = Some(with_threads(threads, || found(&form, limits, &SMALL)));
                });
                assert!(started >= threads - 1, "{started} threads were started");
                assert_eq!(bits(&other.unwrap()), bits(&one), "{threads} threads");
            }
        }
    }
}

#[test]
fn the_interior_point_method_gives_the_same_bits_at_any_number_of_threads() {
    let form = random_form(9, 3, false, &mut Random::new(8));
    let shared = Shared::new(&form, &regularization(&form)).unwrap();
    let inside = |threads: usize| {
        let mut monitor = Monitor::default();
        let mut tree = Tree::new(&form, &shared, ALL, &mut monitor);
        tree.relaxation.interior = Some(Propagator::new(&form));
        with_threads(threads, || tree.found_in_rounds(&SMALL))
    };
    let one = inside(1);
    assert!(one.is_complete && one.nodes > 30, "{} nodes", one.nodes);
    assert!(spawned(|| assert_eq!(bits(&inside(3)), bits(&one))) > 2);
    let (serial, (_, energy)) = (found(&form, ALL, &NONE), one.best.unwrap());
    assert!((serial.best.unwrap().1 - energy).abs() < 1e-7);
}

/// The least energy of all points, where all unknowns are integers.
fn least_of_all(form: &Form) -> Option<f64> {
    let (n, mut least) = (form.dim(), None);
    for code in 0..4usize.pow(n as u32) {
        let x: Vec<f64> = (0..n).map(|j| (code >> (2 * j) & 3) as f64).collect();
        let sums = form.rows.mul(&x);
        let is_within =
            |(sum, sides): (&f64, &Interval)| *sum >= sides.lower && *sum <= sides.upper;
        if sums.iter().zip(&form.row_limits).all(is_within) {
            let energy = form.energy(&x);
            least = Some(least.map_or(energy, |least: f64| least.min(energy)));
        }
    }
    least
}

#[test]
fn rounds_find_the_least_energy() {
    let mut random = Random::new(3);
    let mut started = 0;
    for case in 0..40u64 {
        let rounds = Rounds {
            after: 1 + case % 3,
            width: 1 + case as usize % 5,
            nodes: 1 + case % 4,
        };
        let integers = random_form(6, 0, false, &mut random);
        let mixed = random_form(5 + case as usize % 3, 3, case % 2 == 0, &mut random);
        let least = least_of_all(&integers);
        let serial = found(&mixed, ALL, &NONE).best.map(|(_, energy)| energy);
        for (form, expected) in [(&integers, least.unwrap()), (&mixed, serial.unwrap())] {
            let one = with_threads(2, || {
                let mut one = None;
                started += spawned(|| one = Some(found(form, ALL, &rounds)));
                one.unwrap()
            });
            let (point, energy) = one.best.unwrap();
            let near = 1e-7 * expected.abs().max(1.0);
            assert!((energy - expected).abs() < near, "{energy} {expected}");
            assert!((form.energy(&point) - energy).abs() < near);
            assert!(one.is_complete && one.bound <= energy && one.bound > expected - near);
            assert_eq!(one.stopped_by, StoppedBy::Nothing);
        }
    }
    assert!(
        started > 100,
        "rounds of several tasks are searched: {started}"
    );
}

#[test]
fn a_small_tree_is_searched_without_rounds() {
    let form = random_form(6, 2, false, &mut Random::new(1));
    let serial = found(&form, ALL, &NONE);
    let rounds = Rounds {
        after: serial.nodes + 1,
        ..SMALL
    };
    assert_eq!(bits(&found(&form, ALL, &rounds)), bits(&serial));
}

#[test]
fn limits_of_nodes_and_work_end_rounds_with_a_true_bound() {
    let form = random_form(10, 2, false, &mut Random::new(21));
    let all = found(&form, ALL, &SMALL);
    let (point, least) = all.best.unwrap();
    let mut cut_short = 0;
    for nodes in (7..all.nodes).step_by(1 + all.nodes as usize / 20) {
        let cut = with_threads(2, || found(&form, Limits { nodes, ..ALL }, &SMALL));
        assert!(cut.bound <= least + 1e-9);
        let Some((_, energy)) = cut.best else {
            continue;
        };
        assert!(energy >= least - 1e-9);
        // Tasks share what is left: so the search differs, and may be complete as well.
        if cut.is_complete {
            assert!(cut.nodes <= nodes);
            continue;
        }
        assert_eq!((cut.nodes, cut.stopped_by), (nodes, StoppedBy::Nodes));
        cut_short += 1;
    }
    assert!(cut_short > 5, "{cut_short}");
    // A node counts as 5,000 multiplications, besides its own.
    let spent = |found: &Found| found.work + 5000 * found.nodes;
    let from_best = |limits: Limits| {
        let start = Some(point.clone());
        let mut monitor = Monitor::default();
        with_threads(2, || {
            search_in_rounds(&form, start, limits, &SMALL, &mut monitor).unwrap()
        })
    };
    let whole = spent(&from_best(ALL));
    let mut cut_short = 0;
    for part in 2..8 {
        let work = whole / 10 * part;
        let cut = from_best(Limits { work, ..ALL });
        assert!(cut.bound <= least + 1e-9);
        if cut.is_complete {
            continue;
        }
        assert_eq!(cut.stopped_by, StoppedBy::Budget);
        assert!(spent(&cut) < 2 * work, "{} of {work}", spent(&cut));
        cut_short += 1;
    }
    assert!(cut_short > 1, "{cut_short}");
    let gap = Limits {
        gap: 0.1,
        elsewhere: 5.0,
        ..ALL
    };
    let wide = found(&form, gap, &SMALL);
    let (_, energy) = wide.best.unwrap();
    assert!(wide.is_complete && wide.nodes < all.nodes);
    assert!(energy - wide.bound <= 0.1 * (energy + 5.0) && wide.bound <= least + 1e-9);
}

#[test]
fn the_caller_hears_of_each_better_point_once() {
    let mut random = Random::new(77);
    let mut improvements = 0;
    let forms = 10;
    for _ in 0..forms {
        let form = random_form(10, 2, false, &mut random);
        let told = |threads: usize| {
            let mut energies = Vec::new();
            let found = {
                let mut monitor = Monitor::default().on_event(|event| {
                    if event.kind == EventKind::Improved {
                        energies.push(event.energy);
                    }
                    Flow::Continue
                });
                let rounds = Rounds { after: 1, ..SMALL };
                let limits = Limits { nodes: 400, ..ALL };
                with_threads(threads, || {
                    search_in_rounds(&form, None, limits, &rounds, &mut monitor).unwrap()
                })
            };
            assert!(energies.is_sorted_by(|a, b| a > b), "{energies:?}");
            assert_eq!(
                energies.last().copied(),
                found.best.map(|(_, energy)| energy)
            );
            energies
        };
        let one = told(1);
        assert_eq!(told(3), one);
        improvements += one.len();
    }
    assert!(improvements > forms, "{improvements}");
}

#[test]
fn a_cancel_in_the_middle_of_a_round_leaves_a_true_bound() {
    let form = random_form(40, 4, false, &mut Random::new(9));
    let mut cut_short = 0;
    for threads in [1, 2, 3] {
        for milliseconds in [20, 60, 150] {
            let token = CancelToken::new();
            let from_outside = token.clone();
            let canceller = std::thread::spawn(move || {
                std::thread::sleep(Duration::from_millis(milliseconds));
                from_outside.cancel();
                Instant::now()
            });
            let mut monitor = Monitor::default().cancel_token(token);
            let cut = with_threads(threads, || {
                search_in_rounds(&form, None, ALL, &SMALL, &mut monitor).unwrap()
            });
            let ended = Instant::now();
            let cancelled = canceller.join().unwrap();
            assert!(!cut.is_complete, "the search takes longer than this");
            let late = ended.saturating_duration_since(cancelled);
            assert!(late < Duration::from_millis(500), "{late:?}");
            if let Some((_, energy)) = cut.best {
                // Another search from there would have to go on.
                assert!(cut.bound < energy - 1e-6);
                cut_short += usize::from(cut.nodes > SMALL.after);
            }
        }
    }
    assert!(cut_short > 3, "{cut_short}");
}
