//! The rows hold at all points with integers, and raise the bound of layouts.

use super::super::tree::tests::{least as least_energy, nodes};
use super::*;
use crate::error::Conflicting;
use crate::linalg::{Random, Sparse};

fn within(lower: f64, upper: f64) -> Interval {
    Interval { lower, upper }
}

/// Intervals on a line that may not overlap: interval i is near its target, and the distances of all pairs cost.
/// The unknowns are the centres, then for each pair its distance, at least `|x_i - x_j|`, and two binaries, the first
/// for i on the left.
pub(in crate::branch) fn layout(targets: &[f64], lengths: &[f64], cost: f64) -> Form {
    const LARGE: f64 = 100.0;
    let count = targets.len();
    let mut limits = vec![within(0.0, 50.0); count];
    let mut entries: Vec<(u32, u32, f64)> = Vec::new();
    let mut sides = Vec::new();
    for i in 0..count {
        for j in i + 1..count {
            let d = limits.len() as u32;
            limits.extend([
                within(0.0, f64::INFINITY),
                within(0.0, 1.0),
                within(0.0, 1.0),
            ]);
            let apart = 0.5 * (lengths[i] + lengths[j]);
            for (binary, sign) in [(d + 1, 1.0), (d + 2, -1.0)] {
                // `x_j - x_i >= apart` where i is on the left.
                let row = sides.len() as u32;
                entries.extend([
                    (row, i as u32, sign),
                    (row, j as u32, -sign),
                    (row, binary, LARGE),
                ]);
                sides.push(within(f64::NEG_INFINITY, LARGE - apart));
                let row = sides.len() as u32;
                entries.extend([(row, d, 1.0), (row, i as u32, sign), (row, j as u32, -sign)]);
                sides.push(within(0.0, f64::INFINITY));
            }
            let row = sides.len() as u32;
            entries.extend([(row, d + 1, 1.0), (row, d + 2, 1.0)]);
            sides.push(Interval::point(1.0));
        }
    }
    let n = limits.len();
    let squares = (0..count as u32).map(|i| (i, i, 2.0));
    let is_distance = |j: usize| j >= count && (j - count).is_multiple_of(3);
    Form {
        hessian: Sparse::from_triplets(n, n, squares).unwrap(),
        gradient: (0..n)
            .map(|j| match targets.get(j) {
                Some(target) => -2.0 * target,
                None if is_distance(j) => cost,
                None => 0.0,
            })
            .collect(),
        constant: targets.iter().map(|t| t * t).sum(),
        rows: Sparse::from_triplets(sides.len(), n, entries.into_iter()).unwrap(),
        origins: (0..sides.len()).map(Conflicting::Inequality).collect(),
        row_limits: sides,
        boxes: limits.clone(),
        limits,
        integer: (0..n).map(|j| j >= count && !is_distance(j)).collect(),
    }
}

fn random_layout(count: usize, random: &mut Random) -> Form {
    let targets: Vec<f64> = (0..count)
        .map(|_| 25.0 + 5.0 * random.symmetric())
        .collect();
    let lengths: Vec<f64> = (0..count).map(|_| 4.0 + 3.0 * random.symmetric()).collect();
    layout(&targets, &lengths, 2.0)
}

#[test]
fn a_distance_is_at_least_that_of_either_side() {
    let form = layout(&[10.0, 11.0], &[4.0, 6.0], 1.0);
    // The distance is unknown 2, its binaries are 3 and 4.
    let rows = rows(&form);
    assert_eq!(rows.len(), 1, "{rows:?}");
    let (terms, side) = &rows[0];
    assert_eq!((terms[0], *side), ((2, 1.0), 0.0));
    assert_eq!([terms[1].0, terms[2].0], [3, 4]);
    for (_, a) in &terms[1..] {
        assert!(*a <= 0.0 && -a <= 5.0 && -a > 5.0 - 1e-12, "{rows:?}");
    }
}

#[test]
fn rows_hold_wherever_binaries_are_integers() {
    let mut random = Random::new(3);
    for _ in 0..10 {
        let mut form = random_layout(3, &mut random);
        let rows = rows(&form);
        assert_eq!(rows.len(), 3);
        for (terms, side) in rows {
            // The least value of the left side over all points with integers.
            form.hessian = Sparse::zeros(form.dim(), form.dim());
            form.constant = 0.0;
            form.gradient.fill(0.0);
            terms
                .iter()
                .for_each(|&(j, a)| form.gradient[j as usize] = a);
            let (_, least) = least_energy(&form, None).unwrap();
            assert!((least - side).abs() < 1e-6, "{least} {side}");
        }
    }
}

#[test]
fn the_least_energy_stays_and_the_bound_rises() {
    let mut random = Random::new(11);
    for _ in 0..10 {
        let form = random_layout(4, &mut random);
        let next = strengthened(&form, &mut Monitor::default()).unwrap();
        let next = next.expect("the bound rises");
        let (before, after) = (root_bound(&form).unwrap(), root_bound(&next).unwrap());
        let (point, energy) = least_energy(&form, None).unwrap();
        let (_, same) = least_energy(&next, None).unwrap();
        assert!(
            (energy - same).abs() <= 1e-7 * energy.abs(),
            "{energy} {same}"
        );
        assert!(
            before < after && after <= energy,
            "{before} {after} {energy}"
        );
        for (i, sides) in next.row_limits.iter().enumerate() {
            let value: f64 = next.rows.row(i).map(|(j, a)| a * point[j]).sum();
            assert!(value >= sides.lower - 1e-6, "row {i}");
        }
    }
}

/// `x` and `y` from 0 to 10, and a binary that switches on `x >= 3`.
fn switched(other: [f64; 2], side: f64) -> Form {
    let mut form = layout(&[0.0, 0.0], &[1.0, 1.0], 0.0);
    let entries = [
        (0, 0, 1.0),
        (0, 2, -3.0),
        (1, 0, other[0]),
        (1, 1, other[1]),
    ];
    form.limits = vec![within(0.0, 10.0), within(0.0, 10.0), within(0.0, 1.0)];
    form.boxes = form.limits.clone();
    form.integer = vec![false, false, true];
    form.rows = Sparse::from_triplets(2, 3, entries.into_iter()).unwrap();
    form.row_limits = vec![within(0.0, f64::INFINITY), within(side, f64::INFINITY)];
    form.origins.truncate(2);
    form.gradient.truncate(3);
    form.hessian = Sparse::zeros(3, 3);
    form
}

#[test]
fn a_binary_without_a_choice_implies_bounds() {
    // `y - 2 x >= 1`, and so `y >= 7` where x is at least 3.
    let form = switched([-2.0, 1.0], 1.0);
    let rows = rows(&form);
    // That `x >= 3 b` is a row already.
    assert_eq!(rows.len(), 1, "{rows:?}");
    let (terms, side) = &rows[0];
    assert_eq!((terms[0], *side), ((1, 1.0), 0.0));
    assert!(terms[1].0 == 2 && (terms[1].1 + 7.0).abs() < 1e-12);
}

#[test]
fn rows_that_add_nothing_are_not_made() {
    // `y + 2 x >= 1` says nothing more where x is large, and `y - 2 x >= -8` no more than `y >= 0`.
    assert!(rows(&switched([2.0, 1.0], 1.0)).is_empty());
    assert!(rows(&switched([-2.0, 1.0], -8.0)).is_empty());
    // Nothing costs: the bound stays.
    let form = switched([-2.0, 1.0], 1.0);
    assert!(
        strengthened(&form, &mut Monitor::default())
            .unwrap()
            .is_none()
    );
}

#[test]
fn nodes_are_solved_by_the_same_method_as_without_the_rows() {
    // 455 rows, and 91 that choices imply.
    let form = random_layout(14, &mut Random::new(2));
    assert_eq!(rows(&form).len(), 91);
    let strengthened = strengthened(&form, &mut Monitor::default()).unwrap();
    assert_eq!(strengthened.is_none(), cfg!(feature = "interior-point"));
}

#[test]
fn layouts_take_fewer_nodes() {
    let mut random = Random::new(7);
    let mut all = [0; 2];
    for _ in 0..5 {
        let own = nodes(&random_layout(5, &mut random));
        all = [all[0] + own[0], all[1] + own[1]];
    }
    assert!(all[1] < all[0], "{all:?}");
}
