//! Orders against exact degrees, and how they end.

use super::super::Random;
use super::super::ordering::inverse;
use super::domains::eliminated_in_domains;
use super::quotient_graph::QuotientGraph;
use super::{Pattern, minimum_degree};
use crate::error::Error;
use crate::monitor::{CancelToken, Monitor, spawned, with_threads};

/// The rows of a lower triangle with these edges.
fn rows(n: usize, edges: impl Iterator<Item = [u32; 2]>) -> (Vec<usize>, Vec<u32>) {
    let mut rows = vec![Vec::new(); n];
    for [a, b] in edges {
        rows[a.max(b) as usize].push(a.min(b));
    }
    let mut offsets = vec![0];
    for row in &mut rows {
        row.sort_unstable();
        row.dedup();
        offsets.push(offsets[offsets.len() - 1] + row.len());
    }
    (offsets, rows.concat())
}

fn grid(width: u32, height: u32) -> (Vec<usize>, Vec<u32>) {
    let at = |x: u32, y: u32| y * width + x;
    let edges = (0..height).flat_map(move |y| {
        (0..width).flat_map(move |x| {
            let right = (x + 1 < width).then(|| [at(x, y), at(x + 1, y)]);
            let up = (y + 1 < height).then(|| [at(x, y), at(x, y + 1)]);
            right.into_iter().chain(up)
        })
    });
    rows((width * height) as usize, edges)
}

fn random(n: usize, edges: usize, seed: u64) -> (Vec<usize>, Vec<u32>) {
    let mut random = Random::new(seed);
    let mut node = || (random.next() % n as u64) as u32;
    let edges: Vec<[u32; 2]> = (0..edges).map(|_| [node(), node()]).collect();
    rows(n, edges.into_iter())
}

/// The entries of the factor below the diagonal, by elimination of a dense pattern.
fn fill(offsets: &[usize], columns: &[u32], order: &[u32]) -> usize {
    let n = order.len();
    let place = inverse(order);
    let mut rows = vec![vec![false; n]; n];
    for i in 0..n {
        for &j in &columns[offsets[i]..offsets[i + 1]] {
            let (a, b) = (place[i] as usize, place[j as usize] as usize);
            rows[a.min(b)][a.max(b)] = true;
        }
    }
    let mut count = 0;
    for k in 0..n {
        let row: Vec<usize> = (k + 1..n).filter(|&j| rows[k][j]).collect();
        count += row.len();
        for (at, &i) in row.iter().enumerate() {
            row[at + 1..].iter().for_each(|&j| rows[i][j] = true);
        }
    }
    count
}

/// The least fill of a greedy order that counts degrees exactly.
fn exact_minimum_degree(offsets: &[usize], columns: &[u32]) -> usize {
    let n = offsets.len() - 1;
    let mut rows = vec![vec![false; n]; n];
    for i in 0..n {
        for &j in &columns[offsets[i]..offsets[i + 1]] {
            rows[i][j as usize] = i != j as usize;
            rows[j as usize][i] = i != j as usize;
        }
    }
    let mut is_left = vec![true; n];
    let mut count = 0;
    for _ in 0..n {
        let degree = |i: &usize| (0..n).filter(|&j| is_left[j] && rows[*i][j]).count();
        let left = (0..n).filter(|&i| is_left[i]);
        let pivot = left.min_by_key(degree).unwrap();
        let row: Vec<usize> = (0..n).filter(|&j| is_left[j] && rows[pivot][j]).collect();
        count += row.len();
        for &i in &row {
            row.iter()
                .filter(|&&j| j != i)
                .for_each(|&j| rows[i][j] = true);
        }
        is_left[pivot] = false;
    }
    count
}

#[test]
fn orders_are_permutations_with_about_the_fill_of_exact_degrees() {
    let (mut ours, mut exact) = (0, 0);
    let random = (0..40).map(|seed| random(60, 30 + 5 * seed as usize, seed));
    let grids = [(1, 1), (1, 9), (7, 8), (11, 12)].map(|(w, h)| grid(w, h));
    for (offsets, columns) in random.chain(grids) {
        let order = minimum_degree(&offsets, &columns).unwrap();
        let mut sorted = order.clone();
        sorted.sort_unstable();
        assert_eq!(sorted, (0..order.len() as u32).collect::<Vec<_>>());
        ours += fill(&offsets, &columns, &order);
        exact += exact_minimum_degree(&offsets, &columns);
    }
    assert!(10 * ours < 11 * exact, "{ours} {exact}");
}

#[test]
fn variables_with_very_many_neighbours_come_last() {
    let n = 3000;
    let star = (1..n as u32).map(|v| [0, v]);
    let chain = (2..n as u32).map(|v| [v - 1, v]);
    let (offsets, columns) = rows(n, star.chain(chain));
    let order = minimum_degree(&offsets, &columns).unwrap();
    assert_eq!(order[n - 1], 0);
}

#[test]
fn an_order_that_is_not_wanted_ends() {
    let (offsets, columns) = grid(300, 300);
    let token = CancelToken::new();
    token.cancel();
    let cancelled = Monitor::default().cancel_token(token);
    let ends = cancelled.watching(|| minimum_degree(&offsets, &columns));
    assert_eq!(ends, Err(Error::Cancelled));
}

/// A grid with its unknowns in rows of squares of `side` by `side`, so that ranges of unknowns are compact.
fn tiled_grid(side: u32, tiles: u32) -> (Vec<usize>, Vec<u32>) {
    let width = side * tiles;
    let at = move |x: u32, y: u32| {
        let tile = y / side * tiles + x / side;
        tile * side * side + y % side * side + x % side
    };
    let edges = (0..width).flat_map(move |y| {
        (0..width).flat_map(move |x| {
            let right = (x + 1 < width).then(|| [at(x, y), at(x + 1, y)]);
            let up = (y + 1 < width).then(|| [at(x, y), at(x, y + 1)]);
            right.into_iter().chain(up)
        })
    });
    rows((width * width) as usize, edges)
}

/// The entries of the factor below the diagonal, by subtrees of the elimination tree (`liu1990`).
fn sparse_fill(offsets: &[usize], columns: &[u32], order: &[u32]) -> usize {
    let n = order.len();
    let place = inverse(order);
    let mut rows = vec![Vec::new(); n];
    for i in 0..n {
        for &j in &columns[offsets[i]..offsets[i + 1]] {
            let (a, b) = (place[i] as usize, place[j as usize] as usize);
            rows[a.max(b)].push(a.min(b));
        }
    }
    let (mut parent, mut passed) = (vec![n; n], vec![n; n]);
    let mut count = 0;
    for i in 0..n {
        passed[i] = i;
        for &column in &rows[i] {
            let mut k = column;
            while passed[k] != i {
                passed[k] = i;
                count += 1;
                parent[k] = parent[k].min(i);
                k = parent[k];
            }
        }
    }
    count
}

#[test]
fn domains_are_eliminated_at_the_same_time_with_about_the_fill_of_the_whole() {
    let (offsets, columns) = tiled_grid(33, 5);
    let pattern = Pattern {
        offsets: &offsets,
        columns: &columns,
    };
    let n = pattern.unknowns();
    assert!(eliminated_in_domains(pattern).unwrap().is_some());
    let order = |threads| with_threads(threads, || minimum_degree(&offsets, &columns).unwrap());
    let mut in_domains = Vec::new();
    assert!(spawned(|| in_domains = order(4)) > 0);
    assert_eq!(in_domains, order(1));
    let mut sorted = in_domains.clone();
    sorted.sort_unstable();
    assert_eq!(sorted, (0..n as u32).collect::<Vec<_>>());
    let mut whole = QuotientGraph::new(pattern, 0..n, &[]).unwrap();
    whole.eliminate_up_to(usize::MAX).unwrap();
    let [ours, whole] = [&in_domains, &whole.order()].map(|o| sparse_fill(&offsets, &columns, o));
    assert!(10 * ours < 11 * whole, "{ours} {whole}");
}

#[test]
fn there_are_no_domains_where_unknowns_are_in_no_order() {
    let (offsets, columns) = random(30_000, 60_000, 1);
    let pattern = Pattern {
        offsets: &offsets,
        columns: &columns,
    };
    assert!(eliminated_in_domains(pattern).unwrap().is_none());
}

#[test]
fn unknowns_with_very_many_neighbours_come_last_after_domains_as_well() {
    let n = 30_000;
    let chain = (2..n as u32).map(|v| [v - 1, v]);
    let star = (1..n as u32).step_by(9).map(|v| [0, v]);
    let (offsets, columns) = rows(n, chain.chain(star));
    let pattern = Pattern {
        offsets: &offsets,
        columns: &columns,
    };
    assert!(eliminated_in_domains(pattern).unwrap().is_some());
    let order = minimum_degree(&offsets, &columns).unwrap();
    assert_eq!(order[n - 1], 0);
}
