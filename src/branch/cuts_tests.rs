//! Cuts raise the bound and keep the least energy.

use super::super::tree::tests::{least, nodes};
use super::*;
use crate::branch::form::Interval;
use crate::error::Conflicting;
use crate::linalg::Sparse;
use crate::test_random::Random;

fn within(lower: f64, upper: f64) -> Interval {
    Interval { lower, upper }
}

/// Several goods that one machine makes for the demands of some times. The unknowns of a good and a time are what is
/// made, what is stored after it, and whether anything is made.
fn lots(goods: usize, times: usize, random: &mut Random) -> Form {
    const MOST: f64 = 60.0;
    let n = 3 * goods * times;
    let (mut limits, mut gradient) = (Vec::new(), Vec::new());
    let (mut entries, mut sides) = (Vec::new(), Vec::new());
    for good in 0..goods {
        for time in 0..times {
            let made = 3 * (good * times + time) as u32;
            limits.extend([
                within(0.0, MOST),
                within(0.0, f64::INFINITY),
                within(0.0, 1.0),
            ]);
            gradient.extend([
                1.0 + random.unit(),
                0.1 * random.unit(),
                20.0 + 50.0 * random.unit(),
            ]);
            let row = sides.len() as u32;
            entries.extend([(row, made, 1.0), (row, made + 1, -1.0)]);
            if time > 0 {
                entries.push((row, made - 2, 1.0));
            }
            sides.push(Interval::point(random.below(20) as f64));
            entries.extend([(row + 1, made, 1.0), (row + 1, made + 2, -MOST)]);
            sides.push(within(f64::NEG_INFINITY, 0.0));
        }
    }
    for time in 0..times {
        let row = sides.len() as u32;
        entries.extend((0..goods).map(|good| (row, 3 * (good * times + time) as u32, 1.0)));
        sides.push(within(0.0, MOST));
    }
    Form {
        hessian: Sparse::from_triplets(
            n,
            n,
            (0..n as u32).filter(|j| j % 3 == 1).map(|j| (j, j, 0.1)),
        )
        .unwrap(),
        gradient,
        constant: 0.0,
        rows: Sparse::from_triplets(sides.len(), n, entries.into_iter()).unwrap(),
        origins: (0..sides.len()).map(Conflicting::Inequality).collect(),
        row_limits: sides,
        boxes: limits.clone(),
        limits,
        integer: (0..n).map(|j| j % 3 == 2).collect(),
    }
}

#[test]
fn the_least_energy_of_lots_stays_and_a_third_of_the_gap_is_closed() {
    let mut random = Random::new(3);
    let (mut before, mut after) = (0.0, 0.0);
    for _ in 0..10 {
        let form = lots(2, 4, &mut random);
        let next = strengthened(&form, &mut Monitor::default()).unwrap();
        let next = next.expect("the bound rises").form;
        let bounds = [&form, &next].map(|form| relaxed(form, &[]).unwrap().unwrap().bound);
        let [(_, energy), (_, same)] = [&form, &next].map(|form| least(form, None).unwrap());
        assert!((energy - same).abs() <= 1e-7 * energy, "{energy} {same}");
        assert!(bounds[1] <= energy, "{bounds:?} {energy}");
        before += energy - bounds[0];
        after += energy - bounds[1];
    }
    assert!(after < 2.0 / 3.0 * before, "{before} {after}");
}

#[test]
fn lots_take_half_of_the_nodes() {
    let mut random = Random::new(7);
    let mut all = [0; 2];
    for _ in 0..5 {
        let own = nodes(&lots(2, 6, &mut random));
        all = [all[0] + own[0], all[1] + own[1]];
    }
    assert!(2 * all[1] < all[0], "{all:?}");
}

#[test]
fn without_open_integers_there_are_no_cuts() {
    let mut form = lots(2, 4, &mut Random::new(3));
    form.integer.fill(false);
    assert!(
        strengthened(&form, &mut Monitor::default())
            .unwrap()
            .is_none()
    );
}
