//! Adaptive rounding of large problems in regions that do not touch, at the same time.
//!
//! The unknowns are divided into regions by the graph of the matrix. A region rounds integers that couple to
//! nothing outside it, and moves unknowns that couple to nothing outside it; all others stay where they are. So no
//! region reads what another one changes, and the result does not depend on how many are worked on at a time.
//!
//! All regions round up to the same deviation before any goes on to the next one. Two divisions take turns, so that
//! what is at the rim of a region of one is inside a region of the other. Integers at the rims of both, and those
//! with the largest deviations, are left to the passes over the whole problem.

use std::cmp::Reverse;
use std::collections::VecDeque;

use super::adaptive::{UPDATES_AT_A_TIME, UPDATES_PER_UNKNOWN};
use super::candidates::Candidates;
use crate::eliminate::ReducedModel;
use crate::linalg::{LocalSolve, Wave};
use crate::monitor::{Monitor, Phase, both, span, tasks};
use crate::search::Options;

/// The number of unknowns of a region, without local integers. With half as many, energies of fields are about one
/// percent higher than those of passes over the whole problem; with so many, they are about equal.
const UNKNOWNS: usize = 8_192;

/// Problems of fewer regions are rounded as a whole.
const REGIONS: usize = 2;

/// The largest deviation that is rounded in regions. The few integers that are left are decided in the order of the
/// whole problem: without that, energies of fields that follow curvature are 5 to 8 percent higher. Up to 0.46, all
/// energies are within two percent of those for 0.35.
const HIGHEST: f64 = 0.46;

/// The number of equal steps in which deviations grow up to that.
const LEVELS: usize = 16;

/// No region.
const NONE: u32 = u32::MAX;

/// A division of the unknowns into regions.
struct Division {
    /// The region of each unknown. That of a local integer is the one of all its neighbours, or [`NONE`].
    region: Vec<u32>,
    /// Whether all neighbours of an unknown are in its region.
    inner: Vec<bool>,
    /// The integers that each region may round, by number.
    integers: Vec<Vec<u32>>,
    /// The place of each integer among those of its region.
    place: Vec<u32>,
}

impl Division {
    /// Regions that grow around `count` unknowns, which are spread evenly over the order of all of them. The first
    /// one is this share of a step from the start.
    fn new(solve: &LocalSolve, integers: &[u32], dim: usize, count: usize, first: f64) -> Self {
        let others: Vec<u32> = (0..dim as u32).filter(|&i| !solve.is_local(i)).collect();
        let mut region = vec![NONE; dim];
        let mut queue = VecDeque::with_capacity(others.len());
        let grow = |region: &mut [u32], queue: &mut VecDeque<u32>| {
            while let Some(i) = queue.pop_front() {
                let own = region[i as usize];
                for j in solve.neighbours(i) {
                    if region[j as usize] == NONE {
                        region[j as usize] = own;
                        queue.push_back(j);
                    }
                }
            }
        };
        for k in 0..count {
            let at = ((k as f64 + first) * others.len() as f64 / count as f64) as usize;
            region[others[at] as usize] = k as u32;
            queue.push_back(others[at]);
        }
        grow(&mut region, &mut queue);
        // What is not connected to any of them.
        for (k, &i) in others.iter().enumerate() {
            if region[i as usize] == NONE {
                region[i as usize] = (k * count / others.len()) as u32;
                queue.push_back(i);
                grow(&mut region, &mut queue);
            }
        }
        let mut inner = vec![false; dim];
        for &i in &others {
            let own = region[i as usize];
            inner[i as usize] = solve.neighbours(i).all(|j| region[j as usize] == own);
        }
        let mut of_region = vec![Vec::new(); count];
        let mut place = vec![0; dim];
        for &i in integers {
            let at = i as usize;
            if solve.is_local(i) {
                let mut neighbours = solve.neighbours(i).map(|j| region[j as usize]);
                let own = neighbours.next().unwrap_or(NONE);
                region[at] = if neighbours.all(|other| other == own) {
                    own
                } else {
                    NONE
                };
                inner[at] = region[at] != NONE;
            }
            if inner[at] {
                let own: &mut Vec<u32> = &mut of_region[region[at] as usize];
                place[at] = own.len() as u32;
                own.push(i);
            }
        }
        Division {
            region,
            inner,
            integers: of_region,
            place,
        }
    }
}

/// What the regions have rounded.
pub(super) struct Rounded {
    /// The number of integers.
    pub count: usize,
    /// The Gauss-Seidel updates.
    pub updates: usize,
    /// The unknowns that may have to move.
    pub wave: Wave,
}

/// Rounds what regions may round, if the problem is large enough.
pub(super) fn round_in_regions(
    model: &ReducedModel,
    options: &Options,
    solve: &LocalSolve,
    monitor: &mut Monitor,
) -> Rounded {
    let (dim, integers) = (model.dim(), model.integers());
    let mut rounded = Rounded {
        count: 0,
        updates: 0,
        wave: Wave::default(),
    };
    let others = (0..dim as u32).filter(|&i| !solve.is_local(i)).count();
    let count = others / UNKNOWNS;
    if count < REGIONS || monitor.ends() {
        return rounded;
    }
    let division = |first| Division::new(solve, integers, dim, count, first);
    let (first, second) = both(true, || division(0.25), || division(0.75));
    let divisions = [first, second];
    // The work of each region, at first by its integers, then by its last updates: what takes longest begins first.
    let mut work = [0, 1].map(|which: usize| -> Vec<usize> {
        divisions[which].integers.iter().map(Vec::len).collect()
    });
    let mut left: Vec<u32> = Vec::new();
    let steps = (1..=LEVELS).flat_map(|level| [(level, 0), (level, 1)]);
    for (level, which) in steps {
        let (division, work) = (&divisions[which], &mut work[which]);
        let done = rounded.count as f64 / integers.len() as f64;
        if monitor.ends_at(Phase::Round, done) {
            break;
        }
        let mut of_region = vec![Vec::new(); count];
        let (inner, outer) = left.into_iter().partition(|&i| division.inner[i as usize]);
        let inner: Vec<u32> = inner;
        left = outer;
        for i in inner {
            of_region[division.region[i as usize] as usize].push(i);
        }
        let mut order: Vec<usize> = (0..count).collect();
        order.sort_by_key(|&k| (Reverse(work[k]), k));
        let regions = tasks(count, monitor, |place, monitor| {
            let _span = span("region");
            let k = order[place];
            let mut region = Region {
                model,
                options,
                solve,
                division,
                integers: &division.integers[k],
                wave: Wave::from_left(of_region[k].iter().copied()),
                rounded: 0,
                updates: 0,
            };
            if !monitor.ends() {
                region.round(HIGHEST * level as f64 / LEVELS as f64, monitor);
            }
            (region.rounded, region.updates, region.wave)
        });
        let mut regions: Vec<_> = order.into_iter().zip(regions).collect();
        regions.sort_unstable_by_key(|&(k, _)| k);
        for (k, (count, updates, wave)) in regions {
            rounded.count += count;
            rounded.updates += updates;
            work[k] = updates;
            left.extend(wave.into_left());
        }
    }
    rounded.wave = Wave::from_left(left);
    rounded
}

/// A region while it is rounded.
struct Region<'a> {
    model: &'a ReducedModel,
    options: &'a Options,
    solve: &'a LocalSolve<'a>,
    division: &'a Division,
    integers: &'a [u32],
    wave: Wave,
    /// The number of integers that it has rounded.
    rounded: usize,
    /// The updates that it has made.
    updates: usize,
}

impl Region<'_> {
    /// Rounds all integers whose deviation is at most `ceiling`, or becomes so.
    fn round(&mut self, ceiling: f64, monitor: &mut Monitor) {
        let solve = self.solve;
        let mut goes_on = self.relax(monitor);
        solve.take_moved(&mut self.wave, |_| {});
        let mut candidates = Candidates::up_to(ceiling, self.integers.len());
        for (place, &i) in self.integers.iter().enumerate() {
            if !solve.is_fixed(i) {
                candidates.push(place as u32, solve.value(i));
            }
        }
        while goes_on {
            let undecided = |place: u32| {
                let i = self.integers[place as usize];
                (!solve.is_fixed(i)).then(|| solve.value(i))
            };
            let threshold = self.options.rounding_threshold;
            let batch = candidates.take(threshold, undecided);
            if batch.is_empty() {
                return;
            }
            for place in batch {
                let i = self.integers[place as usize];
                let nearest = self.model.nearest(i as usize, solve.value(i));
                solve.fix(i, nearest, &mut self.wave);
                self.rounded += 1;
            }
            goes_on = self.relax(monitor);
            let Division { inner, place, .. } = self.division;
            solve.take_moved(&mut self.wave, |i| {
                if inner[i as usize] {
                    candidates.push(place[i as usize], solve.value(i));
                }
            });
        }
    }

    /// Re-optimises by Gauss-Seidel. Returns whether more may be rounded.
    fn relax(&mut self, monitor: &mut Monitor) -> bool {
        let inner = &self.division.inner;
        let left = (UPDATES_PER_UNKNOWN * UNKNOWNS).saturating_sub(self.updates);
        let mut budget = self.options.gauss_seidel_updates.min(left);
        while budget > 0 && !self.wave.is_settled() {
            let tolerance = self.options.gauss_seidel_tolerance;
            let most = budget.min(UPDATES_AT_A_TIME);
            let may_move = |i: u32| inner[i as usize];
            let made = self.solve.relax(&mut self.wave, tolerance, most, may_move);
            budget -= made;
            self.updates += made;
            if monitor.ends() {
                return false;
            }
        }
        left > 0
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::field::{FieldProblem, curvature_constraints};
    use crate::linalg::Sparse;
    use crate::mesh::jitter;
    use crate::mesh::shape::by_name;
    use crate::monitor::{spawned, with_threads};
    use crate::search::Strategy;
    use crate::solve::solve;
    use crate::test_random::Random;

    /// A grid of `n` times `n` unknowns, in a random order, with a local integer between neighbours.
    fn grid(n: usize) -> (Sparse, Vec<u32>) {
        let mut order: Vec<u32> = (0..(n * n) as u32).collect();
        let mut random = Random::new(5);
        for k in (1..order.len()).rev() {
            order.swap(k, random.below(k + 1));
        }
        let at = |x: usize, y: usize| order[x + n * y];
        let all = (0..n).flat_map(|x| (0..n).map(move |y| (x, y)));
        let edges: Vec<[u32; 2]> = all
            .flat_map(|(x, y)| {
                let right = (x + 1 < n).then(|| [at(x, y), at(x + 1, y)]);
                let up = (y + 1 < n).then(|| [at(x, y), at(x, y + 1)]);
                right.into_iter().chain(up)
            })
            .collect();
        let first = n * n;
        let rows = edges.iter().zip(first as u32..).flat_map(|(&[a, b], p)| {
            let row = [(a.min(b), 1.0), (a.max(b), -1.0), (p, 1.5)];
            let pairs = (0..3).flat_map(move |i| (0..=i).map(move |j| (row[i], row[j])));
            pairs.map(|((i, u), (j, v))| (i, j, u * v))
        });
        let dim = first + edges.len();
        let ground = (0..first as u32).map(|i| (i, i, 0.05));
        let matrix = Sparse::from_triplets(dim, dim, rows.chain(ground)).unwrap();
        (matrix, (first as u32..dim as u32).collect())
    }

    #[test]
    fn no_region_reads_what_another_one_changes() {
        let (matrix, integers) = grid(40);
        let dim = matrix.rows();
        let zero = vec![0.0; dim];
        let solve = LocalSolve::new(&matrix, &zero, &zero, &integers).unwrap();
        let division = Division::new(&solve, &integers, dim, 5, 0.25);
        let mut rounds = 0;
        for (k, integers) in division.integers.iter().enumerate() {
            for (place, &i) in integers.iter().enumerate() {
                assert_eq!(division.place[i as usize] as usize, place);
                let mut ends = solve.neighbours(i);
                assert!(ends.all(|j| division.region[j as usize] == k as u32));
            }
            rounds += integers.len();
        }
        assert!(rounds > integers.len() / 2 && rounds < integers.len());
        for i in (0..dim as u32).filter(|&i| division.inner[i as usize]) {
            let own = division.region[i as usize];
            assert!(own != NONE);
            let mut others = solve.neighbours(i);
            assert!(others.all(|j| division.region[j as usize] == own));
        }
    }

    #[test]
    fn threads_round_regions_and_change_no_bit() {
        let mesh = jitter(&by_name("torus", 40_000).unwrap(), 1e-3, 3).unwrap();
        let constraints = curvature_constraints(&mesh, 0.02).unwrap();
        let field = FieldProblem::new(&mesh, &constraints).unwrap();
        let options = Options {
            strategy: Strategy::Adaptive,
            ..Options::default()
        };
        let rounded = |threads: usize| {
            let mut bits = Vec::new();
            let started = spawned(|| {
                let solution = with_threads(threads, || solve(field.problem(), &options));
                bits.extend(solution.unwrap().values().iter().map(|x| x.to_bits()));
            });
            (bits, started)
        };
        let (bits, started) = rounded(1);
        assert_eq!(started, 0);
        for threads in [2, 3, 16] {
            let (same, started) = rounded(threads);
            assert!(started >= LEVELS, "{started}");
            assert!(same == bits, "{threads} threads");
        }
    }
}
