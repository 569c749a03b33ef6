//! Problems of all the forms that are recognised, against brute force.

use super::Random;
use crate::monitor::Monitor;
use crate::network::form::Form;
use crate::network::solve;
use crate::problem::{Model, Problem, Triangle};

/// A row `lower <= a . x <= upper`.
struct Row {
    coefficients: Vec<f64>,
    lower: f64,
    upper: f64,
}

struct Case {
    curvature: Vec<f64>,
    slope: Vec<f64>,
    bounds: Vec<[i64; 2]>,
    rows: Vec<Row>,
}

impl Case {
    /// Each unknown is in no, one or two rows. Rows are multiples of such rows.
    fn random(random: &mut Random) -> Self {
        let n = random.between(2, 6) as usize;
        let mut rows: Vec<Row> = (0..random.between(1, 4))
            .map(|_| Row {
                coefficients: vec![0.0; n],
                lower: 0.0,
                upper: 0.0,
            })
            .collect();
        for j in 0..n {
            let places = [0, 1].map(|_| random.below(rows.len() as u64 + 1) as usize);
            for place in places {
                let sign = [1.0, -1.0][random.below(2) as usize];
                if let Some(row) = rows.get_mut(place) {
                    row.coefficients[j] += sign;
                }
            }
        }
        let bounds: Vec<[i64; 2]> = (0..n)
            .map(|_| {
                let lower = random.between(-2, 1);
                [lower, lower + random.between(0, 3)]
            })
            .collect();
        for row in &mut rows {
            let [low, wide] = [random.between(-3, 2), random.between(0, 2)];
            let factor = [1.0, 2.0, 0.5][random.below(3) as usize];
            row.coefficients.iter_mut().for_each(|c| *c *= factor);
            row.lower = factor * low as f64;
            row.upper = row.lower + factor * wide as f64;
        }
        let quarter = |x: i64| x as f64 / 4.0;
        Case {
            curvature: (0..n).map(|_| quarter(random.between(0, 9))).collect(),
            slope: (0..n).map(|_| quarter(random.between(-9, 9))).collect(),
            bounds,
            rows,
        }
    }

    fn problem(&self) -> Problem {
        let n = self.slope.len();
        let all: Vec<usize> = (0..n).collect();
        let mut problem = Problem::new(n).unwrap();
        problem.set_linear(&self.slope).unwrap();
        problem
            .add_quadratic_triplets(Triangle::Lower, &all, &all, &self.curvature)
            .unwrap();
        for row in &self.rows {
            let added = if row.lower == row.upper {
                problem.add_constraint(&all, &row.coefficients, row.lower)
            } else {
                problem.add_inequality(&all, &row.coefficients, row.lower, row.upper)
            };
            added.unwrap();
        }
        let sides =
            |side: usize| -> Vec<f64> { self.bounds.iter().map(|b| b[side] as f64).collect() };
        problem.set_bounds(&all, &sides(0), &sides(1)).unwrap();
        problem.set_integers(&all).unwrap();
        problem
    }

    fn energy(&self, x: &[f64]) -> Option<f64> {
        let within = |row: &Row| {
            let sum: f64 = row.coefficients.iter().zip(x).map(|(a, x)| a * x).sum();
            row.lower <= sum && sum <= row.upper
        };
        let costs = self.curvature.iter().zip(&self.slope).zip(x);
        self.rows
            .iter()
            .all(within)
            .then(|| costs.map(|((q, s), x)| x * (q * x / 2.0 + s)).sum())
    }

    fn least(&self) -> Option<f64> {
        let mut x: Vec<i64> = self.bounds.iter().map(|b| b[0]).collect();
        let mut least: Option<f64> = None;
        loop {
            let point: Vec<f64> = x.iter().map(|x| *x as f64).collect();
            if let Some(energy) = self.energy(&point) {
                least = Some(least.map_or(energy, |l| l.min(energy)));
            }
            let Some(k) = (0..x.len()).find(|&k| x[k] < self.bounds[k][1]) else {
                return least;
            };
            x[k] += 1;
            for j in 0..k {
                x[j] = self.bounds[j][0];
            }
        }
    }
}

#[test]
fn problems_of_this_form_are_solved_and_proved() {
    let mut random = Random(0x1234_5678_9abc_def1);
    let (mut solved, mut unsolvable) = (0, 0);
    for round in 0..1000 {
        let case = Case::random(&mut random);
        let problem = case.problem();
        let model = Model::new(&problem).unwrap();
        let known = case.least();
        let found = solve(&problem, &model, None, &mut Monitor::default()).unwrap();
        match (known, found) {
            (Some(least), Some(found)) => {
                assert_eq!(case.energy(&found.values), Some(least), "round {round}");
                let bound = found.lower_bound;
                assert!(bound <= least && bound >= least - 1e-12 * least.abs());
                solved += 1;
            }
            (None, None) => unsolvable += 1,
            (known, found) => panic!("round {round}: {known:?}, {found:?}"),
        }
    }
    assert!(solved > 200 && unsolvable > 200, "{solved} {unsolvable}");
}

#[test]
fn other_problems_are_left_to_others() {
    let case = Case {
        curvature: vec![1.0; 2],
        slope: vec![0.5; 2],
        bounds: vec![[0, 4]; 2],
        rows: Vec::new(),
    };
    let is_form = |problem: &Problem| {
        let model = Model::new(problem).unwrap();
        Form::of(problem, &model).unwrap().is_some()
    };
    assert!(is_form(&case.problem()));
    let mut coupled = case.problem();
    coupled
        .add_quadratic_triplets(Triangle::Lower, &[1], &[0], &[0.5])
        .unwrap();
    assert!(!is_form(&coupled));
    let mut weighted = case.problem();
    weighted.add_constraint(&[0, 1], &[1.0, 3.0], 4.0).unwrap();
    assert!(!is_form(&weighted));
    let mut crowded = case.problem();
    for _ in 0..3 {
        crowded.add_constraint(&[0, 1], &[1.0, 1.0], 4.0).unwrap();
    }
    assert!(!is_form(&crowded));
}
