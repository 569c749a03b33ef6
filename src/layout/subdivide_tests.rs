//! Subdivisions against brute force.

use super::*;
use crate::linalg::Random;

/// Polygons in a row or a ring that share edges at random, as a layout without positions that matter.
fn layout(polygons: &[&[u32]]) -> BaseLayout {
    let count = polygons
        .iter()
        .flat_map(|p| p.iter())
        .max()
        .map_or(0, |&v| v as usize + 1);
    let positions = (0..count).map(|v| [v as f64, (v * v % 7) as f64, 0.0]);
    let polygons = polygons.iter().map(|p| p.to_vec());
    BaseLayout::new(positions.collect(), polygons.collect()).unwrap()
}

/// The least energy over all numbers up to `most`, by trying them all.
fn least(subdividing: &Subdividing, edge: f64, most: u32) -> Option<f64> {
    let layout = subdividing.layout;
    let mut x = vec![1u32; subdividing.unknowns];
    let mut least: Option<f64> = None;
    loop {
        let fits = layout
            .sides()
            .iter()
            .zip(&subdividing.spokes)
            .all(|(sides, &spokes)| {
                let n = sides.len();
                let of = |i: usize| x[sides[i] as usize / 2];
                match spokes {
                    None => of(0) == of(2) && of(1) == of(3),
                    Some(s) => (0..n).all(|i| of(i) == x[s + (i + n - 1) % n] + x[s + (i + 1) % n]),
                }
            });
        if fits && subdividing.fixed.iter().all(|&(arc, n)| x[arc] == n) {
            let mut energy = 0.0;
            for (arc, &l) in subdividing.lengths.iter().enumerate() {
                energy += subdividing.weight(l) * (f64::from(x[arc]) - wanted(l, edge)).powi(2);
            }
            for (sides, &spokes) in layout.sides().iter().zip(&subdividing.spokes) {
                let Some(s) = spokes else { continue };
                let n = sides.len();
                for i in 0..n {
                    let l = |k: usize| subdividing.lengths[sides[k % n] as usize / 2];
                    let beside = 0.25 * (l(i + n - 1) + l(i + 1));
                    let off = f64::from(x[s + i]) - wanted(beside, edge);
                    energy += SPOKE * subdividing.weight(beside) * off * off;
                }
            }
            least = Some(least.map_or(energy, |least| least.min(energy)));
        }
        let Some(k) = (0..x.len()).find(|&k| x[k] < most) else {
            return least;
        };
        x[k] += 1;
        x[..k].fill(1);
    }
}

#[test]
fn subdivisions_have_the_least_energy_of_all() {
    let layouts = [
        layout(&[&[0, 1, 2, 3]]),
        layout(&[&[0, 1, 2]]),
        layout(&[&[0, 1, 2], &[2, 1, 3, 4]]),
        layout(&[&[0, 1, 2], &[0, 2, 3]]),
    ];
    let mut random = Random::new(3);
    for layout in &layouts {
        for _ in 0..6 {
            let lengths: Vec<f64> = (0..layout.arc_count())
                .map(|_| 0.3 + 3.0 * (0.5 + 0.5 * random.symmetric()))
                .collect();
            let subdividing = Subdividing::new(layout, &lengths, &[]).unwrap();
            for edge in [0.0, 0.9] {
                let found = subdividing.at(edge, &Monitor::default).unwrap();
                let least = least(&subdividing, edge, 4).unwrap();
                assert!(found.is_optimal, "{found:?}");
                assert!(
                    (found.energy - least).abs() < 1e-9 * (1.0 + least),
                    "{found:?} {least}"
                );
                assert!(found.lower_bound <= found.energy + 1e-9);
            }
        }
    }
}

#[test]
fn the_number_of_quads_is_that_of_all_patches() {
    let layout = layout(&[&[0, 1, 2], &[2, 1, 3, 4]]);
    let lengths = vec![1.0; layout.arc_count()];
    let fixed = [(0, 4), (1, 6), (2, 4)];
    let found = Subdividing::new(&layout, &lengths, &fixed).unwrap();
    let found = found.at(1.0, &Monitor::default).unwrap();
    // Spokes of the triangle: sides are sums of two.
    assert_eq!(found.spokes[0], [3, 1, 3]);
    assert_eq!(found.quads, 3 + 3 + 9 + 6 * found.arcs[3] as usize);
}

#[test]
fn a_contradiction_names_a_smallest_set() {
    // Three quads in a row: the edges across are all equal. A fourth patch has nothing to do with it.
    let layout = layout(&[&[0, 1, 3, 2], &[2, 3, 5, 4], &[4, 5, 7, 6], &[7, 5, 8, 9]]);
    let arc = |a, b| layout.arc_between(a, b).unwrap();
    let lengths = vec![1.0; layout.arc_count()];
    let fixed = [(arc(8, 9), 3), (arc(0, 1), 2), (arc(4, 5), 3)];
    let error = Subdividing::new(&layout, &lengths, &fixed).unwrap();
    let error = error.at(1.0, &Monitor::default).unwrap_err();
    let Error::Contradiction { what, elements, .. } = &error else {
        panic!("{error}");
    };
    assert_eq!(elements.len(), 2, "{what}");
    assert!(what.ends_with("in patches 0, 1"), "{what}");
}

#[test]
fn sides_of_a_triangle_that_cannot_meet_in_a_middle_contradict_each_other() {
    let layout = layout(&[&[0, 1, 2]]);
    for numbers in [[1, 1, 1], [2, 2, 4], [2, 3, 2]] {
        let fixed: Vec<(usize, u32)> = (0..3).zip(numbers).collect();
        let error = Subdividing::new(&layout, &[1.0; 3], &fixed).unwrap();
        let error = error.at(1.0, &Monitor::default).unwrap_err();
        assert_eq!(error.code(), "infeasible", "{error}");
    }
}

#[test]
fn numbers_that_cannot_be_fixed_are_refused() {
    let layout = layout(&[&[0, 1, 2, 3]]);
    for (fixed, code) in [
        (vec![(4, 1)], "index_out_of_range"),
        (vec![(0, 0)], "invalid_argument"),
        (vec![(0, MOST + 1)], "invalid_argument"),
        (vec![(0, 2), (0, 2)], "invalid_argument"),
    ] {
        let error = Subdividing::new(&layout, &[1.0; 4], &fixed).err().unwrap();
        assert_eq!(error.code(), code, "{error}");
    }
}
