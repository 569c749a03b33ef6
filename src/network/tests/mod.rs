//! Random small networks and matchings against brute force.

mod form;

use super::blossoms::NONE;
use super::flow::{Failure, half_integral};
use super::graph::{Edge, End, Network, UNITS};
use super::matching::{Graph, Matching, Stage};
use super::units::{self, Optimum, integral};

struct Random(u64);

impl Random {
    fn below(&mut self, n: u64) -> u64 {
        self.0 ^= self.0 << 13;
        self.0 ^= self.0 >> 7;
        self.0 ^= self.0 << 17;
        (self.0 >> 11) % n
    }

    fn between(&mut self, low: i64, high: i64) -> i64 {
        low + self.below((high - low + 1) as u64) as i64
    }
}

fn solve(network: &Network) -> Option<Optimum> {
    let go_on = &mut |_| false;
    match half_integral(network, go_on) {
        Ok(halves) => match integral(network, &halves, go_on) {
            Ok(optimum) => Some(optimum),
            Err(failure) => {
                assert_eq!(failure, units::Failure::NotFound);
                None
            }
        },
        Err(failure) => {
            assert!(matches!(failure, Failure::Infeasible(_)), "{failure:?}");
            None
        }
    }
}

/// The least cost over all values between the bounds.
fn least(network: &Network) -> Option<i128> {
    let edges = &network.edges;
    let mut x: Vec<i64> = edges.iter().map(|e| e.lower.unwrap()).collect();
    let mut least = None;
    loop {
        if network.missing(&x).iter().all(|r| *r == 0) {
            let cost = network.cost(&x);
            least = Some(least.map_or(cost, |l: i128| l.min(cost)));
        }
        let Some(k) = (0..x.len()).find(|&k| x[k] < edges[k].upper.unwrap()) else {
            return least;
        };
        x[k] += 1;
        for j in 0..k {
            x[j] = edges[j].lower.unwrap();
        }
    }
}

fn random_network(random: &mut Random, feasible: bool) -> Network {
    let vertices = random.between(1, 5) as usize;
    let root = random.below(2) == 1;
    let count = random.between(1, 7) as usize;
    let mut edges = Vec::new();
    while edges.len() < count {
        let ends = [0, 1].map(|_| End {
            vertex: random.below((vertices + usize::from(root)) as u64) as u32,
            sign: if random.below(2) == 0 { 1 } else { -1 },
        });
        let [a, b] = ends;
        if a.vertex == b.vertex && (a.sign != b.sign || a.vertex as usize == vertices) {
            continue;
        }
        let lower = random.between(-2, 1);
        edges.push(Edge {
            ends,
            lower: Some(lower),
            upper: Some(lower + random.between(0, 4)),
            curvature: i128::from(random.between(0, 5).max(0)),
            slope: i128::from(random.between(-12, 6)),
        });
    }
    let mut demand: Vec<i64> = (0..vertices).map(|_| random.between(-2, 2)).collect();
    demand.push(0);
    let mut network = Network {
        edges,
        demand,
        exponent: 0,
    };
    if feasible {
        let within = |e: &Edge| random.between(e.lower.unwrap(), e.upper.unwrap());
        let x: Vec<i64> = network.edges.iter().map(within).collect();
        let missing = network.missing(&x);
        for (demand, missing) in network.demand.iter_mut().zip(missing) {
            *demand -= missing;
        }
    }
    network
}

#[test]
fn networks_are_solved_and_proved() {
    let mut random = Random(0x9e37_79b9_7f4a_7c15);
    let (mut solved, mut unsolvable) = (0, 0);
    for round in 0..3000 {
        let network = random_network(&mut random, round % 4 != 0);
        let known = least(&network);
        let found = solve(&network);
        assert_eq!(found.as_ref().map(|f| f.bound), known, "round {round}");
        if let Some(found) = found {
            assert!(network.missing(&found.x).iter().all(|r| *r == 0));
            assert_eq!(network.cost(&found.x), found.bound);
            let within = |(e, x): (&Edge, &i64)| e.lower <= Some(*x) && Some(*x) <= e.upper;
            assert!(network.edges.iter().zip(&found.x).all(within));
            solved += 1;
        } else {
            unsolvable += 1;
        }
    }
    assert!(solved > 2000 && unsolvable > 300, "{solved} {unsolvable}");
}

/// A cycle of an odd number of edges that all add at both ends, with odd demands: half-integral at best.
#[test]
fn an_odd_cycle_costs_more_than_its_relaxation() {
    let edge = |a: u32, b: u32| Edge {
        ends: [a, b].map(|vertex| End { vertex, sign: 1 }),
        lower: None,
        upper: None,
        curvature: 2,
        slope: 0,
    };
    let network = Network {
        edges: vec![edge(0, 1), edge(1, 2), edge(2, 0), edge(0, 0)],
        demand: vec![1, 1, 1, 0],
        exponent: 0,
    };
    let go_on = &mut |_| false;
    let halves = half_integral(&network, go_on).unwrap();
    assert_eq!(&halves.twice[..3], [1, 1, 1]);
    // No sum of the demands is even, so no integral flow exists.
    assert!(solve(&network).is_none());
    let even = Network {
        demand: vec![1, 1, 2, 0],
        ..network
    };
    let found = solve(&even).unwrap();
    assert_eq!(found.bound, 2 * UNITS);
}

#[test]
fn matchings_are_those_of_brute_force() {
    let mut random = Random(88_172_645_463_325_252);
    let mut perfect = 0;
    for _ in 0..3000 {
        let vertices = 2 * random.between(1, 6) as usize;
        let density = random.between(2, 9) as u64;
        let (mut ends, mut weights) = (Vec::new(), Vec::new());
        for i in 0..vertices as u32 {
            for j in 0..i {
                if random.below(10) < density {
                    ends.push([i, j]);
                    weights.push(4 * i128::from(random.between(-9, 9)));
                }
            }
        }
        let known = best(vertices, &ends, &weights, 0, 0);
        let graph = Graph::new(vertices, ends, weights);
        let y = vec![-18 * 2; vertices];
        let mut matching = Matching::new(&graph, y, vec![NONE; vertices]);
        let stage = matching.complete(&mut |_| false);
        assert_eq!(stage == Stage::Augmented, known.is_some());
        let Some(known) = known else { continue };
        perfect += 1;
        let weight: i128 = matching
            .mate
            .iter()
            .map(|e| graph.weights[*e as usize])
            .sum();
        assert_eq!(weight, 2 * known);
        for (v, e) in matching.mate.iter().enumerate() {
            assert!(graph.ends[*e as usize].contains(&(v as u32)));
        }
    }
    assert!(perfect > 1000, "{perfect}");
}

fn best(n: usize, ends: &[[u32; 2]], weights: &[i128], used: u32, sum: i128) -> Option<i128> {
    let Some(first) = (0..n as u32).find(|v| used >> v & 1 == 0) else {
        return Some(sum);
    };
    let with_first = ends.iter().zip(weights).filter(|([i, j], _)| {
        (*i == first || *j == first) && used >> i & 1 == 0 && used >> j & 1 == 0
    });
    let sums = with_first
        .filter_map(|([i, j], w)| best(n, ends, weights, used | 1 << i | 1 << j, sum + w));
    sums.min()
}

/// A connected network that brute force cannot do, with an integral flow of its own.
fn large_network(random: &mut Random, vertices: u32, count: usize) -> Network {
    let mut edges = Vec::new();
    while edges.len() < count {
        let k = edges.len() as u32;
        let from = if k < vertices - 1 {
            k + 1
        } else {
            random.below(u64::from(vertices)) as u32
        };
        let to = random.below(u64::from(from.max(1))) as u32;
        let sign = |random: &mut Random| if random.below(2) == 0 { 1 } else { -1 };
        let ends = [from, to].map(|vertex| End {
            vertex,
            sign: sign(random),
        });
        if from == to && ends[0].sign != ends[1].sign {
            continue;
        }
        edges.push(Edge {
            ends,
            lower: Some(random.between(0, 1)),
            upper: None,
            curvature: i128::from(random.between(1, 900)),
            slope: i128::from(random.between(-4000, 500)),
        });
    }
    let mut network = Network {
        edges,
        demand: vec![0; vertices as usize + 1],
        exponent: 0,
    };
    let x: Vec<i64> = network.edges.iter().map(|_| random.between(1, 6)).collect();
    network.demand = network.missing(&x).iter().map(|r| -r).collect();
    network
}

#[test]
fn numbers_of_vertices_and_edges_do_not_matter() {
    let mut random = Random(42);
    for _ in 0..60 {
        let network = large_network(&mut random, 40, 90);
        let mut place: Vec<u32> = (0..41).collect();
        let mut other = network.clone();
        for k in 1..40 {
            let j = random.below(k + 1) as usize;
            place.swap(k as usize, j);
        }
        for k in 1..other.edges.len() {
            let j = random.below(k as u64 + 1) as usize;
            other.edges.swap(k, j);
        }
        for end in other.edges.iter_mut().flat_map(|e| &mut e.ends) {
            end.vertex = place[end.vertex as usize];
        }
        for (v, demand) in network.demand.iter().enumerate() {
            other.demand[place[v] as usize] = *demand;
        }
        let [first, second] = [&network, &other].map(|network| {
            let found = solve(network).unwrap();
            assert!(network.missing(&found.x).iter().all(|r| *r == 0));
            assert_eq!(network.cost(&found.x), found.bound);
            found.bound
        });
        assert_eq!(first, second);
    }
}
