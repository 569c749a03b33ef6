//! Properties of every reduction and every enumeration, on random lattices.

use super::lll::{LOVASZ, is_reduced};
use super::*;
use crate::test_random::Random;

impl Random {
    /// The Gram matrix of `n` vectors whose lengths decrease to `least`. A random unimodular matrix shears
    /// them, so that the condition number is large.
    fn gram(&mut self, n: usize, least: f64) -> Gram {
        let mut b: Vec<Vec<f64>> = (0..n)
            .map(|i| {
                let length = least.powf(i as f64 / n as f64);
                (0..n).map(|_| length * self.next()).collect()
            })
            .collect();
        for _ in 0..2 * n {
            let i = (self.next().abs() * n as f64) as usize;
            let j = (self.next().abs() * n as f64) as usize;
            if i != j {
                let q = (3.0 * self.next()).round();
                let from = b[j].clone();
                b[i].iter_mut().zip(from).for_each(|(a, f)| *a += q * f);
            }
        }
        gram_of(&b)
    }

    fn target(&mut self, n: usize) -> Vec<f64> {
        (0..n).map(|_| 5.0 * self.next()).collect()
    }
}

fn gram_of(b: &[Vec<f64>]) -> Gram {
    let dot = |x: &[f64], y: &[f64]| x.iter().zip(y).map(|(x, y)| x * y).sum::<f64>();
    let n = b.len();
    let values = (0..n * n).map(|k| dot(&b[k / n], &b[k % n])).collect();
    Gram::new(n, values).unwrap()
}

fn reduced(gram: &Gram) -> Basis {
    let mut basis = Basis::new(gram);
    lll(&mut basis, DEPTH, &mut |_| false).unwrap();
    basis
}

/// The determinant, modulo a prime.
fn determinant(u: &Transform) -> i128 {
    const P: i128 = 2_305_843_009_213_693_951;
    let n = u.dim();
    let mut a: Vec<Vec<i128>> = (0..n)
        .map(|i| (0..n).map(|j| u.at(i, j).rem_euclid(P)).collect())
        .collect();
    let mut product = 1;
    for k in 0..n {
        let Some(p) = (k..n).find(|&i| a[i][k] != 0) else {
            return 0;
        };
        if p != k {
            a.swap(p, k);
            product = P - product;
        }
        product = product * a[k][k] % P;
        let inverse = power(a[k][k], P - 2, P);
        for i in k + 1..n {
            let f = a[i][k] * inverse % P;
            for j in k..n {
                a[i][j] = (a[i][j] - f * a[k][j]).rem_euclid(P);
            }
        }
    }
    if product == P - 1 { -1 } else { product }
}

fn power(mut base: i128, mut exponent: i128, p: i128) -> i128 {
    let mut result = 1;
    while exponent > 0 {
        if exponent & 1 == 1 {
            result = result * base % p;
        }
        base = base * base % p;
        exponent >>= 1;
    }
    result
}

#[test]
fn reduction_is_unimodular_and_keeps_every_distance() {
    let mut random = Random::new(1);
    for (n, least) in [(2, 1.0), (5, 1e-4), (20, 1e-4), (60, 1e-3), (100, 1e-4)] {
        let gram = random.gram(n, least);
        let basis = reduced(&gram);
        assert!(is_reduced(&basis, LOVASZ - 1e-3), "{n}");
        assert_eq!(determinant(basis.transform()).abs(), 1, "{n}");
        for k in 0..n {
            let vector = basis.transform().column(k);
            let length: f64 = (0..=k).map(|i| basis.r(i, k).powi(2)).sum();
            let square = gram.square(&vector);
            // Where large vectors cancel, their scalar products lose digits.
            let combined: f64 = (0..n).map(|i| vector[i].abs() * gram.at(i, i).sqrt()).sum();
            let error = 1e-6 * square + 1e-13 * combined * combined;
            assert!((length - square).abs() < error, "{n}: {length} {square}");
        }
        let p = random.target(n);
        let back = |y: &[f64]| -> Vec<f64> {
            let column = |j: usize| basis.transform().column(j);
            let mut x = vec![0.0; n];
            for j in 0..n {
                x.iter_mut()
                    .zip(column(j))
                    .for_each(|(x, u)| *x += u * y[j]);
            }
            x
        };
        let x = back(&basis.coordinates(&p));
        assert!(x.iter().zip(&p).all(|(x, p)| (x - p).abs() < 1e-6));
    }
}

#[test]
fn an_orthogonal_basis_is_rounded_and_proved_at_once() {
    let gram = gram_of(&[
        vec![2.0, 0.0, 0.0],
        vec![0.0, 1.0, 0.0],
        vec![0.0, 0.0, 0.1],
    ]);
    let found = closest(&reduced(&gram), &[0.4, -3.6, 7.5], None, 1000).unwrap();
    assert_eq!(found.point[..2], [0, -4]);
    assert!(found.complete && found.nodes <= 6);
    assert!((found.value - (0.64 + 0.16 + 0.0025)).abs() < 1e-12);
}

/// The least distance by brute force. The search box contains the ellipsoid of nearest plane's distance:
/// the i-th integer is within `sqrt(value * inverse(G)_ii)` of the target.
fn brute_force(gram: &Gram, target: &[f64], value: f64) -> f64 {
    let n = gram.dim();
    let basis = Basis::new(gram);
    let half: Vec<f64> = (0..n)
        .map(|i| {
            // Column i of R^-T: forward substitution.
            let mut x = vec![0.0; n];
            x[i] = 1.0;
            for k in 0..n {
                let sum: f64 = (0..k).map(|j| basis.r(j, k) * x[j]).sum();
                x[k] = (x[k] - sum) / basis.r(k, k);
            }
            (value * x.iter().map(|v| v * v).sum::<f64>()).sqrt() + 1e-9
        })
        .collect();
    let low: Vec<i64> = (0..n)
        .map(|i| (target[i] - half[i]).ceil() as i64)
        .collect();
    let high: Vec<i64> = (0..n)
        .map(|i| (target[i] + half[i]).floor() as i64)
        .collect();
    let mut z = low.clone();
    let mut best = f64::INFINITY;
    loop {
        let v: Vec<f64> = z.iter().zip(target).map(|(&z, t)| z as f64 - t).collect();
        best = best.min(gram.square(&v));
        let Some(i) = (0..n).find(|&i| z[i] < high[i]) else {
            return best;
        };
        z[i] += 1;
        z[..i].copy_from_slice(&low[..i]);
    }
}

#[test]
fn enumeration_finds_what_brute_force_finds() {
    let mut random = Random::new(2);
    for round in 0..300 {
        let n = 1 + round % 4;
        let gram = random.gram(n, 0.3);
        let target = random.target(n);
        let found = closest(&reduced(&gram), &target, None, u64::MAX).unwrap();
        assert!(found.complete);
        let best = brute_force(&gram, &target, found.value);
        assert!(
            (found.value - best).abs() <= 1e-9 * best.max(1e-3),
            "{found:?} {best}"
        );
        let v: Vec<f64> = found
            .point
            .iter()
            .zip(&target)
            .map(|(&z, t)| z as f64 - t)
            .collect();
        assert!((gram.square(&v) - found.value).abs() < 1e-9 * best.max(1e-3));
    }
}

#[test]
fn a_stopped_enumeration_bounds_what_it_did_not_see() {
    let mut random = Random::new(3);
    for n in [8, 15, 25] {
        let basis = reduced(&random.gram(n, 1e-2));
        let target = Target::new(&basis, &random.target(n)).unwrap();
        let run = |nodes| {
            let limits = Limits {
                radius: f64::INFINITY,
                margin: 0.0,
                nodes,
            };
            enumerate(&basis, &target, None, limits, &mut |_| false)
        };
        let least = run(u64::MAX).near[0].1;
        for nodes in [0, 1, 7, 60, 500, 4000] {
            let part = run(nodes);
            assert!(part.nodes <= nodes);
            assert!(part.bound <= least, "{n}, {nodes}: {} {least}", part.bound);
            let best = part.near.first().map_or(f64::INFINITY, |b| b.1);
            assert!(best >= least * (1.0 - 1e-9));
            assert_eq!(part.complete, part.nodes < nodes);
        }
    }
}

#[test]
fn relations_between_vectors_are_free_coordinates() {
    // (1, 0), (1/2, 0), (0, 1) and a zero vector. They generate the lattice of (1/2, 0) and (0, 1).
    let b = [
        vec![1.0, 0.0],
        vec![0.5, 0.0],
        vec![0.0, 1.0],
        vec![0.0, 0.0],
    ];
    let gram = gram_of(&b);
    let basis = reduced(&gram);
    assert_eq!((basis.rank(), basis.is_discrete()), (2, true));
    // The point closest to (1.7, 0.3) is (1.5, 0).
    let found = closest(&reduced(&gram), &[1.7, 0.0, 0.3, 9.0], None, 100).unwrap();
    assert!(found.complete);
    assert!((found.value - (0.04 + 0.09)).abs() < 1e-12);
    assert_eq!(2 * found.point[0] + found.point[1], 3);
    assert_eq!(found.point[3], 9);
}

#[test]
fn vectors_that_depend_without_being_a_lattice_prove_nothing() {
    let gram = gram_of(&[vec![1.0], vec![std::f64::consts::SQRT_2]]);
    let found = closest(&reduced(&gram), &[0.3, 0.4], None, 1000).unwrap();
    assert!(!found.complete);
    assert!(found.value < 0.05);
}

#[test]
fn the_start_is_kept_where_nothing_is_better() {
    let gram = gram_of(&[vec![1.0, 0.0], vec![0.0, 1.0]]);
    for start in [[0, 0], [1, 0], [0, 1], [1, 1]] {
        let found = closest(&reduced(&gram), &[0.5, 0.5], Some(&start), 1000).unwrap();
        assert_eq!(found.point, start);
    }
}

#[test]
fn diagonals_are_below_the_scalar_products() {
    let mut random = Random::new(5);
    for (n, least) in [(1, 1.0), (6, 1e-2), (30, 1.0), (60, 1e-3)] {
        let basis = reduced(&random.gram(n, least));
        let diagonals = Diagonals::new(&basis, &mut || false).unwrap();
        let mut best: f64 = 0.0;
        for k in 1..=n {
            let d = diagonals.level(k);
            assert_eq!(d.len(), k);
            for _ in 0..50 {
                let v: Vec<f64> = (0..k).map(|_| random.next()).collect();
                let row = |i: usize| (i..k).map(|j| basis.r(i, j) * v[j]).sum::<f64>();
                let square: f64 = (0..k).map(|i| row(i).powi(2)).sum();
                let least: f64 = d.iter().zip(&v).map(|(d, v)| d * v * v).sum();
                assert!(least <= square, "{n}, {k}: {least} {square}");
            }
            let lengths: f64 = (0..k)
                .map(|j| basis.column(j).iter().map(|v| v * v).sum::<f64>())
                .sum();
            best = best.max(d.iter().sum::<f64>() / lengths);
        }
        // For one vector alone, the diagonal is its whole squared length.
        assert!(best > 0.9, "{n}: {best}");
    }
}

#[test]
fn an_enumeration_with_diagonals_finds_the_same_with_fewer_nodes() {
    let mut random = Random::new(6);
    let (mut plain, mut bounded) = (0, 0);
    for round in 0..64 {
        let n = 2 + round % 32;
        let basis = reduced(&conditioned(n, 10.0, &mut random));
        let target = Target::new(&basis, &random.target(n)).unwrap();
        let start = nearest_plane(&basis, &target);
        let value = target.distance(&basis, &start);
        let diagonals = Diagonals::new(&basis, &mut || false).unwrap();
        let run = |diagonals| {
            let limits = Limits {
                radius: value * (1.0 + 1e-9),
                margin: 0.0,
                nodes: u64::MAX,
            };
            enumerate(&basis, &target, diagonals, limits, &mut |_| false)
        };
        let (a, b) = (run(None), run(Some(&diagonals)));
        assert_eq!(a.near, b.near, "{n}");
        assert!(a.complete && b.complete && b.nodes <= a.nodes);
        plain += a.nodes;
        bounded += b.nodes;
    }
    assert!(3 * bounded < plain, "{bounded} {plain}");
}

/// A Gram matrix with eigenvalues from 1 to `1 / condition`, rotated by reflections.
fn conditioned(n: usize, condition: f64, random: &mut Random) -> Gram {
    let mut a = vec![0.0; n * n];
    for i in 0..n {
        a[i * n + i] = condition.powf(-(i as f64) / (n as f64 - 1.0));
    }
    for _ in 0..4 {
        let v: Vec<f64> = (0..n).map(|_| random.next()).collect();
        let scale = 2.0 / v.iter().map(|v| v * v).sum::<f64>();
        let row = |i: usize| {
            a[i * n..(i + 1) * n]
                .iter()
                .zip(&v)
                .map(|(a, v)| a * v)
                .sum::<f64>()
        };
        let w: Vec<f64> = (0..n).map(row).collect();
        let twice = scale * scale * v.iter().zip(&w).map(|(v, w)| v * w).sum::<f64>();
        for i in 0..n {
            for j in 0..n {
                a[i * n + j] += twice * v[i] * v[j] - scale * (v[i] * w[j] + w[i] * v[j]);
            }
        }
    }
    Gram::new(n, a).unwrap()
}

#[test]
fn a_condition_of_1e8_is_reduced_and_stays_unimodular() {
    for n in [30, 100, 200] {
        let gram = conditioned(n, 1e8, &mut Random::new(7));
        let basis = reduced(&gram);
        assert_eq!(basis.rank(), n);
        assert!(is_reduced(&basis, LOVASZ - 1e-3), "{n}");
        assert_eq!(determinant(basis.transform()).abs(), 1, "{n}");
        // LLL brings lengths from 1e-4 to 1 close to their geometric mean.
        let longest = (0..n).fold(0.0, |m: f64, k| m.max(basis.r(k, k)));
        let first = basis.r(0, 0);
        assert!(first < 0.1 && longest < 1.0, "{n}: {first} {longest}");
    }
}

/// Measured alone on one core of 2026: 10 ms, 0.36 s and 16 s.
#[test]
#[ignore = "a minute of reductions, and their times"]
fn a_thousand_dimensions_are_reduced_in_a_minute() {
    for (n, limit) in [(100, 0.05), (368, 3.0), (1000, 60.0)] {
        let gram = conditioned(n, 1e8, &mut Random::new(7));
        let started = std::time::Instant::now();
        let basis = reduced(&gram);
        let seconds = started.elapsed().as_secs_f64();
        assert!(is_reduced(&basis, LOVASZ - 1e-3), "{n}");
        assert!(seconds < limit, "{n}: {seconds} s");
    }
}

#[test]
fn a_reduction_that_is_stopped_leaves_the_same_lattice() {
    let gram = conditioned(40, 1e6, &mut Random::new(8));
    for patience in [0, 1, 10, 100, 1000] {
        let mut asked = 0;
        let mut basis = Basis::new(&gram);
        lll(&mut basis, DEPTH, &mut |_| {
            asked += 1;
            asked > patience
        })
        .unwrap();
        assert_eq!(determinant(basis.transform()).abs(), 1);
        let vector = basis.transform().column(39);
        let length: f64 = (0..40).map(|i| basis.r(i, 39).powi(2)).sum();
        assert!((length - gram.square(&vector)).abs() < 1e-9, "{patience}");
    }
}

/// A reduced random lattice with a target: sheared, nearly singular or well conditioned, by turns.
fn closest_vector_problem(round: usize, n: usize, random: &mut Random) -> (Basis, Target) {
    let gram = match round % 3 {
        0 => random.gram(n, 0.3),
        1 => random.gram(n, 1e-3),
        _ => conditioned(n.max(2), 10.0, random),
    };
    let basis = reduced(&gram);
    let target = Target::new(&basis, &random.target(gram.dim())).unwrap();
    (basis, target)
}

#[test]
fn no_lattice_point_is_closer_than_the_bound_by_splits() {
    let mut random = Random::new(11);
    let (mut bounds, mut distances, mut too_flat) = (0.0, 0.0, 0);
    for round in 0..2000 {
        let (basis, target) = closest_vector_problem(round, 1 + round % 9, &mut random);
        let start = nearest_plane(&basis, &target);
        let value = target.distance(&basis, &start);
        let limits = Limits {
            radius: value * (1.0 + 1e-9),
            margin: 0.0,
            nodes: 1_000_000,
        };
        let found = enumerate(&basis, &target, None, limits, &mut |_| false);
        if !found.complete {
            too_flat += 1;
            continue;
        }
        let least = found.near[0].1;
        // However early it is stopped.
        let mut steps = round % 50;
        let mut stop = |_| {
            steps = steps.saturating_sub(1);
            steps == 0 && round % 4 == 0
        };
        let splits = Splits::new(&basis, &target, value, &mut stop).unwrap();
        assert!(splits.bound <= least, "{round}: {} {least}", splits.bound);
        if round % 4 != 0 {
            bounds += splits.bound / least;
            distances += 1.0;
        }
    }
    assert!(bounds > 0.9 * distances, "{bounds} of {distances}");
    assert!(too_flat < 10, "{too_flat}");
}

#[test]
fn an_enumeration_with_splits_finds_all_points_that_enumeration_finds() {
    let mut random = Random::new(12);
    for round in 0..1000 {
        let (basis, target) = closest_vector_problem(round, 1 + round % 12, &mut random);
        let start = nearest_plane(&basis, &target);
        let value = target.distance(&basis, &start);
        let splits = Splits::new(&basis, &target, value, &mut |_| false).unwrap();
        for margin in [0.0, 0.3 * value] {
            let limits = Limits {
                radius: value * (1.0 + 1e-9) + margin,
                margin,
                nodes: u64::MAX,
            };
            let plain = enumerate(&basis, &target, None, limits, &mut |_| false);
            let found = enumerate_split(&basis, &target, &splits, limits, &mut |_| false).unwrap();
            assert!(found.complete);
            let points = |all: &[(Vec<i64>, f64)]| {
                let mut all: Vec<_> = all.iter().map(|p| p.0.clone()).collect();
                all.sort();
                all
            };
            assert_eq!(points(&plain.near), points(&found.near), "{round}");
            assert!((found.near[0].1 / plain.near[0].1 - 1.0).abs() < 1e-9);
        }
    }
}

#[test]
fn an_enumeration_with_splits_that_is_stopped_keeps_their_bound() {
    let mut random = Random::new(13);
    let basis = reduced(&conditioned(40, 10.0, &mut random));
    let target = Target::new(&basis, &random.target(40)).unwrap();
    let value = target.distance(&basis, &nearest_plane(&basis, &target));
    let splits = Splits::new(&basis, &target, value, &mut |_| false).unwrap();
    let run = |nodes| {
        let limits = Limits {
            radius: value * (1.0 + 1e-9),
            margin: 0.0,
            nodes,
        };
        enumerate_split(&basis, &target, &splits, limits, &mut |_| false).unwrap()
    };
    let whole = run(u64::MAX);
    for nodes in [0, 10, whole.nodes - 1] {
        let part = run(nodes);
        assert_eq!((part.complete, part.nodes), (false, nodes));
        assert_eq!(part.bound, splits.bound);
    }
    assert!(whole.complete && splits.bound <= whole.near[0].1);
}

#[test]
fn splits_of_an_orthogonal_lattice_give_its_distance() {
    let n = 12;
    let square = |i: usize| 1.0 + (5 * i % n) as f64;
    let entry = |k: usize| if k / n == k % n { square(k % n) } else { 0.0 };
    let basis = Basis::new(&Gram::new(n, (0..n * n).map(entry).collect()).unwrap());
    let point: Vec<f64> = (0..n).map(|i| (0.37 * i as f64).fract()).collect();
    let target = Target::new(&basis, &point).unwrap();
    let distance = target.distance(&basis, &vec![0; n]);
    let splits = Splits::new(&basis, &target, distance, &mut |_| false).unwrap();
    let part = splits.bound / distance;
    assert!((0.99..=1.0).contains(&part), "{part}");
}
