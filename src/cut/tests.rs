//! The optimum and its proof, against brute force, known optima and moves of single unknowns.

use super::certificate;
use super::flow::descend;
use super::graph::CutGraph;
use super::network::Network;
use crate::eliminate::{ReducedModel, eliminate};
use crate::monitor::Monitor;
use crate::problem::{Model, Problem, Triangle};
use crate::search::{Options, SolveStatus, Strategy};
use crate::solve::{Solution, solve};
use crate::test_random::Random;

/// Terms `w (n_i - n_j - d)^2`, and `w (n_i - d)^2` where i is j.
type Terms = Vec<(usize, usize, f64, f64)>;

fn problem(n: usize, terms: &Terms) -> Problem {
    let mut problem = Problem::new(n).unwrap();
    for &(i, j, w, d) in terms {
        let added = if i == j {
            problem.add_least_squares(&[i], &[1.0], d, w)
        } else {
            problem.add_least_squares(&[i, j], &[1.0, -1.0], d, w)
        };
        added.unwrap();
    }
    problem.set_integers(&(0..n).collect::<Vec<_>>()).unwrap();
    problem
}

fn reduced(problem: &Problem) -> ReducedModel {
    let model = Model::new(problem).unwrap();
    eliminate(&model, &mut Monitor::default()).unwrap()
}

fn energy(terms: &Terms, n: &[f64]) -> f64 {
    let term = |&(i, j, w, d): &(usize, usize, f64, f64)| {
        let r = if i == j { n[i] - d } else { n[i] - n[j] - d };
        w * r * r
    };
    terms.iter().map(term).sum()
}

/// The integers at which the descent from `start` ends.
fn end(graph: &CutGraph, network: &Network, start: &[f64]) -> Vec<f64> {
    let ground = network.moved[graph.ground];
    let steps = start.iter().zip(&network.moved);
    steps.map(|(n, m)| n + (m - ground) as f64).collect()
}

fn by(problem: &Problem, strategy: Strategy) -> Solution {
    let options = Options {
        strategy,
        ..Options::default()
    };
    solve(problem, &options).unwrap()
}

/// A random connected graph. Weights are ten to the power of up to `spread`, offsets up to `far`, and
/// `grounded` of the nodes have a term of their own. All offsets are near to those of a hidden point.
fn random_terms(random: &mut Random, n: usize, spread: f64, far: f64, grounded: f64) -> Terms {
    let hidden: Vec<f64> = (0..n).map(|_| (far * random.next()).round()).collect();
    let mut terms = Vec::new();
    let mut add = |random: &mut Random, i: usize, j: usize| {
        let w = 10f64.powf(spread * random.next());
        let d = if i == j {
            hidden[i]
        } else {
            hidden[i] - hidden[j]
        };
        terms.push((i, j, w, d + 1.5 * random.next()));
    };
    for i in 0..n {
        if i > 0 {
            let j = random.below(i);
            add(random, i, j);
        }
        if random.unit() < grounded {
            add(random, i, i);
        }
    }
    for _ in 0..random.below(2 * n) {
        let (i, j) = (random.below(n), random.below(n));
        if i != j {
            add(random, i, j);
        }
    }
    terms
}

/// The least energy over all points of a box around `centre`, in which the
/// first unknown is fixed if `shift` is free.
fn brute_force(terms: &Terms, centre: &[f64], reach: i32, shift: bool) -> f64 {
    let side = (2 * reach + 1) as usize;
    let free = centre.len() - usize::from(shift);
    let mut least = f64::INFINITY;
    let mut point = centre.to_vec();
    for code in 0..side.pow(free as u32) {
        let mut rest = code;
        for k in 0..free {
            let at = k + usize::from(shift);
            point[at] = centre[at] + (rest % side) as f64 - f64::from(reach);
            rest /= side;
        }
        least = least.min(energy(terms, &point));
    }
    least
}

/// The box of brute force reaches three beyond the answer in all directions, which is farther than its
/// convexity needs: a point that is best among its neighbours in this box is best of all
/// (`murota2003`, chapter 7).
#[test]
fn small_graphs_are_solved_as_by_brute_force() {
    let mut random = Random::new(17);
    for round in 0..3000 {
        let n = 1 + random.below(5);
        let spread = [0.0, 1.0, 6.0][round % 3];
        let far = [3.0, 1e3, 1e6][round / 3 % 3];
        let grounded = [0.0, 0.3, 1.0][round / 9 % 3];
        let terms = random_terms(&mut random, n, spread, far, grounded);
        let problem = problem(n, &terms);
        let model = reduced(&problem);
        let graph = CutGraph::detect(&model).unwrap();
        let found = by(&problem, Strategy::Auto);
        let shift = terms.iter().all(|t| t.0 != t.1);
        let reach = if n > 4 { 2 } else { 3 };
        let least = brute_force(&terms, found.values(), reach, shift);
        let scale: f64 = terms.iter().map(|t| t.2).sum();
        let mut network = Network::new(&model, &graph, found.values()).unwrap();
        assert!(descend(&mut network, &mut |_| false));
        let own = energy(&terms, &end(&graph, &network, found.values()));
        assert!(own <= least + 1e-9 * scale, "{round}: {own} above {least}");
        // The terms of this size that cancel in the problem's constant are rounded there.
        let size = scale * far * far;
        let rounding = 1e-9 * scale + 1e-15 * size;
        let own = energy(&terms, found.values());
        assert!(own <= least + rounding, "{round}: {own} above {least}");
        let bound = found.lower_bound().unwrap();
        assert!(bound <= least + rounding, "{round}: {bound} above {least}");
        if size <= 1e5 {
            // Weights that differ by 1e12 leave a gap from the rounding of Q.
            let is_proved = found.status() == SolveStatus::Optimal
                || found.gap().is_some_and(|gap| gap <= 1e-7);
            assert!(is_proved, "{round}: {bound} {least}");
        }
    }
}

/// Differences that a point satisfies up to less than a half are satisfied best by that point.
#[test]
fn a_hidden_point_is_found_and_proved() {
    let mut random = Random::new(5);
    for (n, far) in [(10, 10.0), (300, 100.0), (3000, 100.0)] {
        let hidden: Vec<f64> = (0..n).map(|_| (far * random.next()).round()).collect();
        let mut terms = Terms::new();
        for i in 0..n {
            terms.push((i, i, 1e-3, hidden[i] + 0.4 * random.next()));
            for _ in 0..3 {
                let j = random.below(n);
                if i != j {
                    let d = hidden[i] - hidden[j] + 0.4 * random.next();
                    terms.push((i, j, 0.1 + random.unit(), d));
                }
            }
        }
        for strategy in [Strategy::Auto, Strategy::Exact, Strategy::Lattice] {
            let found = by(&problem(n, &terms), strategy);
            assert_eq!(found.values(), hidden);
            assert_eq!(found.status(), SolveStatus::Optimal);
        }
    }
}

/// `side * side` pixels whose phases are noise, wrapped.
fn unwrapping(side: usize, seed: u64, grounded: f64) -> Terms {
    let mut random = Random::new(seed);
    let phase: Vec<f64> = (0..side * side).map(|_| 0.5 * random.next()).collect();
    let mut terms = Terms::new();
    for i in 0..side * side {
        for j in [i + 1, i + side] {
            if j < side * side && (j != i + 1 || j % side != 0) {
                terms.push((i, j, 0.2 + random.unit(), phase[j] - phase[i]));
            }
        }
        if random.unit() < grounded {
            terms.push((i, i, random.unit(), 4.0 * random.next()));
        }
    }
    terms
}

#[test]
fn phases_of_ten_thousand_pixels_are_unwrapped_with_a_proof() {
    for grounded in [0.0, 0.01] {
        let problem = problem(10_000, &unwrapping(100, 3, grounded));
        let found = by(&problem, Strategy::Auto);
        assert_eq!(found.status(), SolveStatus::Optimal);
    }
}

/// Far starts are not what the relaxation gives, so they are set here.
#[test]
fn far_starts_end_at_the_same_energy_with_the_same_proof() {
    for grounded in [0.0, 0.02] {
        let terms = unwrapping(12, 8, grounded);
        let problem = problem(144, &terms);
        let best = by(&problem, Strategy::Exact).energy();
        let model = reduced(&problem);
        let graph = CutGraph::detect(&model).unwrap();
        let mut random = Random::new(1);
        for far in [0.0, 10.0, 1e3, 1e6] {
            let mut start: Vec<f64> = (0..144).map(|_| (far * random.next()).round()).collect();
            start[0] = 0.0;
            let mut network = Network::new(&model, &graph, &start).unwrap();
            let mut asked = 0;
            assert!(descend(&mut network, &mut |_| {
                asked += 1;
                false
            }));
            assert!(asked < 20_000, "{asked} rounds from {far}");
            let end = end(&graph, &network, &start);
            let own = energy(&terms, &end);
            assert!((own - best).abs() < 1e-9 * best, "{own} {best} from {far}");
            let bound = certificate::bound(&model, &graph, &network, &end).unwrap();
            // On its way from there the flow meets the rounding of the row sums, far times.
            let least = best * (1.0 - 1e-9) - 1e-13 * far;
            assert!(bound <= best && bound > least, "{bound} {best}");
        }
    }
}

/// Any flow proves a bound, however bad. So does one that has nothing to do with the problem.
#[test]
fn no_flow_proves_a_bound_above_the_optimum() {
    let mut random = Random::new(9);
    for round in 0..200 {
        let grounded = [0.0, 0.5][round % 2];
        let terms = random_terms(&mut random, 6, 1.0, 5.0, grounded);
        let problem = problem(6, &terms);
        let optimum = by(&problem, Strategy::Exact).energy();
        let model = reduced(&problem);
        let graph = CutGraph::detect(&model).unwrap();
        let start: Vec<f64> = (0..6).map(|_| (3.0 * random.next()).round()).collect();
        let mut network = Network::new(&model, &graph, &start).unwrap();
        let bound = |network: &Network| certificate::bound(&model, &graph, network, &start);
        assert!(bound(&network).is_none_or(|b| b <= optimum));
        for (flow, half) in network.flow.iter_mut().zip(&network.half) {
            *flow = (half >> 20) * (2e6 * random.next()) as i128;
        }
        assert!(
            bound(&network).is_none_or(|b| b <= optimum),
            "round {round}"
        );
    }
}

/// A third of a sum is rounded, so the sums of rows are not zero.
#[test]
fn sums_of_rows_that_rounding_makes_negative_are_paid_for() {
    let mut random = Random::new(21);
    let mut negative = 0;
    for _ in 0..100 {
        let mut terms = random_terms(&mut random, 5, 0.0, 4.0, 0.0);
        terms.iter_mut().for_each(|t| t.2 /= 3.0);
        let problem = problem(5, &terms);
        let graph = CutGraph::detect(&reduced(&problem)).unwrap();
        assert!(graph.debt.iter().all(|&debt| (0.0..1e-13).contains(&debt)));
        negative += usize::from(graph.debt.iter().any(|&debt| debt > 1e-17));
        assert_eq!(by(&problem, Strategy::Exact).status(), SolveStatus::Optimal);
    }
    assert!(negative > 20, "{negative}");
}

#[test]
fn what_is_no_laplacian_is_left_to_other_methods() {
    let with = |entries: &[(usize, usize, f64)], integers: &[usize]| {
        let mut problem = Problem::new(3).unwrap();
        let rows: Vec<_> = entries.iter().map(|e| e.0).collect();
        let columns: Vec<_> = entries.iter().map(|e| e.1).collect();
        let values: Vec<_> = entries.iter().map(|e| e.2).collect();
        problem
            .add_quadratic_triplets(Triangle::Lower, &rows, &columns, &values)
            .unwrap();
        problem.set_integers(integers).unwrap();
        CutGraph::detect(&reduced(&problem)).is_some()
    };
    let diagonal = [(0, 0, 2.0), (1, 1, 2.0), (2, 2, 2.0)];
    let and = |more: &[(usize, usize, f64)]| [&diagonal[..], more].concat();
    let all = [0, 1, 2];
    assert!(with(&diagonal, &all));
    assert!(with(&and(&[(1, 0, -1.0), (2, 1, -1.0)]), &all));
    assert!(
        !with(&and(&[(1, 0, -1.0), (2, 1, 1.0)]), &all),
        "a positive entry"
    );
    assert!(
        !with(&and(&[(1, 0, -1.5), (2, 1, -1.0)]), &all),
        "a negative sum"
    );
    assert!(!with(&diagonal, &[0, 1]), "a continuous unknown");
}
