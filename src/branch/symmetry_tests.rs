//! One order of choices has the least energy of all.

use super::super::tree::tests::least;
use super::*;
use crate::error::Conflicting;
use crate::linalg::Random;

/// Things that go to places of a limited size, with an energy for each two that share one.
fn shared(things: u32, places: u32, random: &mut Random) -> Form {
    let n = things * places;
    let binary = |thing: u32, place: u32| thing * places + place;
    let mut rows = Vec::new();
    let mut sides = Vec::new();
    let mut hessian = Vec::new();
    let mut gradient = vec![0.0; n as usize];
    for i in 0..things {
        let at = sides.len() as u32;
        rows.extend((0..places).map(|p| (at, binary(i, p), 1.0)));
        sides.push(Interval::point(1.0));
        let own = random.symmetric();
        for p in 0..places {
            hessian.push((binary(i, p), binary(i, p), f64::from(things)));
            gradient[binary(i, p) as usize] = own;
        }
        for j in 0..i {
            let both = random.symmetric();
            hessian.extend((0..places).map(|p| (binary(i, p), binary(j, p), both)));
        }
    }
    let sizes: Vec<f64> = (0..things)
        .map(|_| (2.5 + 1.5 * random.symmetric()).round())
        .collect();
    for p in 0..places {
        let at = sides.len() as u32;
        rows.extend((0..things).map(|i| (at, binary(i, p), sizes[i as usize])));
        sides.push(Interval {
            lower: f64::NEG_INFINITY,
            upper: (0.6 * sizes.iter().sum::<f64>()).ceil(),
        });
    }
    let limits = vec![
        Interval {
            lower: 0.0,
            upper: 1.0,
        };
        n as usize
    ];
    Form {
        hessian: Sparse::from_triplets(n as usize, n as usize, hessian.into_iter()).unwrap(),
        gradient,
        constant: 0.0,
        rows: Sparse::from_triplets(sides.len(), n as usize, rows.into_iter()).unwrap(),
        origins: (0..sides.len()).map(Conflicting::Inequality).collect(),
        row_limits: sides,
        boxes: limits.clone(),
        limits,
        integer: vec![true; n as usize],
    }
}

#[test]
fn one_order_has_the_least_energy() {
    let mut random = Random::new(11);
    for case in 0..40 {
        let (things, places) = (3 + case % 4, 2 + case % 3);
        let form = shared(things, places, &mut random);
        let best = least(&form, None);
        let start = best.as_ref().map(|(x, _)| &x[..]);
        let (one, moved) = ordered(&form, start).expect("places are alike");
        let fixed = one.limits.iter().filter(|l| l.is_point()).count() as u32;
        assert_eq!(
            fixed,
            (0..things)
                .map(|at| (places - 1).saturating_sub(at))
                .sum::<u32>()
        );
        let energies = [&best, &least(&one, None)].map(|b| b.as_ref().map(|(_, energy)| *energy));
        match energies {
            [Some(a), Some(b)] => assert!((a - b).abs() < 1e-9 * a.abs().max(1.0), "{a} {b}"),
            energies => assert_eq!(energies, [None, None]),
        }
        // The start goes to the order that is left, with all its rows.
        if let (Some((_, energy)), Some(moved)) = (&best, moved) {
            assert!((form.energy(&moved) - energy).abs() < 1e-9 * energy.abs().max(1.0));
            let is_within = |(x, l): (&f64, &Interval)| *x >= l.lower && *x <= l.upper;
            assert!(moved.iter().zip(&one.limits).all(is_within));
            assert!(
                form.rows
                    .mul(&moved)
                    .iter()
                    .zip(&form.row_limits)
                    .all(is_within)
            );
        }
    }
}

#[test]
fn places_that_differ_stay() {
    let form = shared(4, 3, &mut Random::new(2));
    for j in 0..12 {
        let mut other = form.clone();
        other.gradient[j] += 0.5;
        // Two places are still alike.
        let (one, _) = ordered(&other, None).expect("two places are alike");
        assert_eq!(one.limits.iter().filter(|l| l.is_point()).count(), 1, "{j}");
    }
    let mut other = form.clone();
    for (j, q) in other.gradient.iter_mut().enumerate() {
        *q += 0.1 * (j % 3) as f64;
    }
    assert!(ordered(&other, None).is_none());
}
