//! Random small problems, one function for each kind.

#[path = "larger.rs"]
mod larger;
#[path = "transformed.rs"]
mod transformed;

use super::instance::{self, Instance, NONE, Row};
use super::random::{self, Random};

/// Makes the problem of a seed.
pub type Kind = fn(u64) -> Instance;

/// All kinds, by name.
pub const KINDS: [(&str, Kind); 23] = [
    ("bounds", bounds),
    ("ranges", ranges),
    ("equalities", equalities),
    ("free integers", free_integers),
    ("linear", linear),
    ("singular", singular),
    ("contradictory", contradictory),
    ("integrality", integrality),
    ("unbounded", unbounded),
    ("degenerate", degenerate),
    ("large", large),
    ("pinned", pinned),
    ("not convex", not_convex),
    ("flows", flows),
    ("switches", switches),
    ("lots", larger::lots),
    ("lattices", lattices),
    ("translated", transformed::translated),
    ("far", transformed::far),
    ("units", transformed::units),
    ("defined", transformed::defined),
    ("binaries", larger::binaries),
    ("pairs", larger::pairs),
];

fn whole(random: &mut Random, most: i32) -> f64 {
    f64::from(random.below(2 * most as usize + 1) as i32 - most)
}

fn chance(random: &mut Random, percent: usize) -> bool {
    random.below(100) < percent
}

/// A number that is not zero.
fn some(random: &mut Random, most: i32) -> f64 {
    let size = 1.0 + random.below(most as usize) as f64;
    if chance(random, 50) { size } else { -size }
}

/// An instance with a point within all its limits, which rows that follow keep.
struct Draft {
    of: Instance,
    point: Vec<f64>,
}

/// Unknowns without bounds, with a constant alone.
fn free(random: &mut Random, integer: Vec<bool>) -> Instance {
    let n = integer.len();
    Instance {
        integer,
        lower: vec![-NONE; n],
        upper: vec![NONE; n],
        pins: vec![None; n],
        squares: Vec::new(),
        hessian: vec![vec![0.0; n]; n],
        linear: vec![0.0; n],
        constant: whole(random, 5),
        rows: Vec::new(),
        origin: None,
    }
}

/// Unknowns with bounds, `integers` of them integer, and no rows and no objective.
fn unknowns(random: &mut Random, integers: usize, reals: usize) -> Draft {
    let n = integers + reals;
    let mut draft = Draft {
        of: free(random, (0..n).map(|j| j < integers).collect()),
        point: Vec::new(),
    };
    for j in 0..n {
        let mut at = whole(random, 3);
        if j >= integers {
            at += random.below(4) as f64 / 4.0;
        }
        let (mut lower, mut upper) = (at - random.below(3) as f64, at + random.below(3) as f64);
        if j < integers && chance(random, 30) {
            at = random.below(2) as f64;
            (lower, upper) = (0.0, 1.0);
        } else if j < integers && chance(random, 10) {
            (lower, upper) = (lower - 0.5, upper + 0.25);
        } else if j >= integers {
            match random.below(4) {
                0 => lower = -NONE,
                1 => upper = NONE,
                2 if chance(random, 50) => (lower, upper) = (-NONE, NONE),
                _ => {}
            }
        }
        draft.point.push(at);
        draft.of.lower[j] = lower;
        draft.of.upper[j] = upper;
    }
    draft
}

fn sizes(random: &mut Random) -> (usize, usize) {
    let integers = 1 + random.below(4);
    let reals = random.below(3);
    (integers.max(2 - reals.min(1)), reals)
}

impl Draft {
    fn dim(&self) -> usize {
        self.point.len()
    }

    fn coefficients(&self, random: &mut Random, most: i32) -> Vec<f64> {
        let n = self.dim();
        let mut row = vec![0.0; n];
        for _ in 0..2 + random.below(2) {
            row[random.below(n)] = some(random, most);
        }
        row
    }

    fn value(&self, row: &[f64]) -> f64 {
        row.iter().zip(&self.point).map(|(a, x)| a * x).sum()
    }

    /// `count` least-squares rows of which the point is not the minimiser.
    fn squares(&mut self, random: &mut Random, count: usize) {
        for _ in 0..count {
            let row = self.coefficients(random, 3);
            let rhs = self.value(&row) + whole(random, 8) / 2.0;
            let weight = [0.5, 1.0, 1.0, 2.0][random.below(4)];
            self.of.squares.push((row, rhs, weight));
        }
    }

    /// A square for each unknown, so that the objective is definite.
    fn definite(&mut self, random: &mut Random) {
        for j in 0..self.dim() {
            let mut row = vec![0.0; self.dim()];
            row[j] = some(random, 2);
            let rhs = row[j] * self.point[j] + whole(random, 12) / 4.0;
            self.of
                .squares
                .push((row, rhs, [0.5, 1.0][random.below(2)]));
        }
    }

    fn linear(&mut self, random: &mut Random, most: i32) {
        for j in 0..self.dim() {
            self.of.linear[j] = whole(random, most);
        }
    }

    /// The squares summed into Q, q and c.
    fn summed(mut self) -> Self {
        let (hessian, linear) = self.of.summed();
        let squares = std::mem::take(&mut self.of.squares);
        let constant = squares.iter().map(|(_, rhs, weight)| weight * rhs * rhs);
        self.of.constant += constant.sum::<f64>();
        (self.of.hessian, self.of.linear) = (hessian, linear);
        self
    }

    fn row(&mut self, coefficients: Vec<f64>, lower: f64, upper: f64) {
        self.of.rows.push(Row {
            coefficients,
            lower,
            upper,
            is_constraint: false,
        });
    }

    /// A row that the point satisfies, at one of its sides with some chance.
    fn range(&mut self, random: &mut Random, most: i32) {
        let row = self.coefficients(random, most);
        let at = self.value(&row);
        let (below, above) = (random.below(4) as f64, random.below(4) as f64);
        match random.below(4) {
            0 => self.row(row, -NONE, at + above),
            1 => self.row(row, at - below, NONE),
            2 => self.row(row, at - below, at + above),
            _ => self.row(row, at - below / 2.0, at + above / 2.0),
        }
    }

    fn equality(&mut self, coefficients: Vec<f64>) {
        let at = self.value(&coefficients);
        self.of.rows.push(Row {
            coefficients,
            lower: at,
            upper: at,
            is_constraint: true,
        });
    }

    /// Moves constraints before the other rows, as their numbers are counted apart.
    fn done(mut self) -> Instance {
        self.of.rows.sort_by_key(|row| !row.is_constraint);
        self.of
    }
}

/// Bounds alone.
pub fn bounds(seed: u64) -> Instance {
    let random = &mut Random::new(seed);
    let (integers, reals) = sizes(random);
    let mut draft = unknowns(random, integers, reals);
    draft.definite(random);
    let count = random.below(4);
    draft.squares(random, count);
    if chance(random, 50) {
        draft = draft.summed();
    }
    draft.done()
}

/// Rows with two sides.
pub fn ranges(seed: u64) -> Instance {
    let random = &mut Random::new(seed);
    let (integers, reals) = sizes(random);
    let mut draft = unknowns(random, integers, reals);
    draft.definite(random);
    draft.squares(random, 1);
    for _ in 0..1 + random.below(4) {
        draft.range(random, 4);
    }
    if chance(random, 50) {
        draft = draft.summed();
    }
    draft.done()
}

/// Constraints, some of them chains of equal differences.
pub fn equalities(seed: u64) -> Instance {
    let random = &mut Random::new(seed);
    let (integers, reals) = sizes(random);
    let mut draft = unknowns(random, integers, reals);
    let n = draft.dim();
    draft.definite(random);
    if chance(random, 50) {
        for j in 1..n.min(2 + random.below(3)) {
            let mut row = vec![0.0; n];
            (row[j - 1], row[j]) = (1.0, -1.0);
            draft.equality(row);
        }
    } else {
        for _ in 0..1 + random.below(2) {
            let row = draft.coefficients(random, 4);
            draft.equality(row);
        }
    }
    if chance(random, 60) {
        draft.range(random, 3);
    }
    draft.done()
}

/// Integers without bounds, which the squares hold.
pub fn free_integers(seed: u64) -> Instance {
    let random = &mut Random::new(seed);
    let integers = 1 + random.below(3);
    let reals = random.below(2);
    let mut draft = unknowns(random, integers, reals);
    for j in 0..integers {
        match random.below(4) {
            0 => draft.of.lower[j] = -NONE,
            1 => draft.of.upper[j] = NONE,
            _ => (draft.of.lower[j], draft.of.upper[j]) = (-NONE, NONE),
        }
    }
    draft.definite(random);
    draft.squares(random, 1);
    for _ in 0..1 + random.below(3) {
        draft.range(random, 5);
    }
    if chance(random, 20) {
        let row = draft.coefficients(random, 5);
        draft.equality(row);
    }
    draft.done()
}

/// Unknowns without bounds, and constraints alone.
pub fn lattices(seed: u64) -> Instance {
    let random = &mut Random::new(seed);
    let (integers, reals) = (1 + random.below(3), random.below(2));
    let mut draft = unknowns(random, integers, reals);
    (draft.of.lower, draft.of.upper) = (vec![-NONE; draft.dim()], vec![NONE; draft.dim()]);
    draft.definite(random);
    draft.squares(random, 1);
    for _ in 0..random.below(3) {
        let row = draft.coefficients(random, 4);
        draft.equality(row);
    }
    draft.done()
}

/// No quadratic term.
pub fn linear(seed: u64) -> Instance {
    let random = &mut Random::new(seed);
    let (integers, reals) = sizes(random);
    let mut draft = unknowns(random, integers, reals);
    draft.linear(random, 5);
    for _ in 0..1 + random.below(4) {
        draft.range(random, 5);
    }
    if chance(random, 30) {
        let row = draft.coefficients(random, 3);
        draft.equality(row);
    }
    draft.done()
}

/// Q of less than full rank, often with a linear term.
pub fn singular(seed: u64) -> Instance {
    let random = &mut Random::new(seed);
    let (integers, reals) = sizes(random);
    let mut draft = unknowns(random, integers, reals);
    let count = 1 + random.below(draft.dim() - 1);
    draft.squares(random, count);
    if chance(random, 60) {
        draft.linear(random, 2);
    }
    for _ in 0..random.below(4) {
        draft.range(random, 4);
    }
    if chance(random, 50) {
        draft = draft.summed();
    }
    draft.done()
}

/// Rows and bounds that are chosen without a point in mind: many contradict each other.
pub fn contradictory(seed: u64) -> Instance {
    let random = &mut Random::new(seed);
    let (integers, reals) = sizes(random);
    let mut draft = unknowns(random, integers, reals);
    if chance(random, 70) {
        draft.definite(random);
    } else {
        draft.linear(random, 3);
    }
    for _ in 0..2 + random.below(4) {
        draft.point.iter_mut().for_each(|x| *x += whole(random, 2));
        draft.range(random, 4);
    }
    if chance(random, 30) {
        let row = draft.coefficients(random, 4);
        draft.equality(row);
    }
    draft.done()
}

/// Rows of integers that leave reals between two integers, and may leave no integers.
pub fn integrality(seed: u64) -> Instance {
    let random = &mut Random::new(seed);
    let integers = 2 + random.below(3);
    let reals = random.below(2);
    let mut draft = unknowns(random, integers, reals);
    if chance(random, 80) {
        draft.definite(random);
    } else {
        draft.linear(random, 3);
    }
    for j in 0..integers {
        draft.point[j] += 0.5;
        draft.of.lower[j] -= 1.0;
        draft.of.upper[j] += 1.0;
    }
    for _ in 0..1 + random.below(3) {
        let row = draft.coefficients(random, 4);
        let at = draft.value(&row);
        let width = random.below(3) as f64 / 4.0;
        draft.row(row, at - width, at + width);
    }
    if chance(random, 30) {
        let mut row = vec![0.0; draft.dim()];
        (row[0], row[1]) = (2.0 * some(random, 2), 2.0 * some(random, 2));
        let at = draft.value(&row).round() + random.below(2) as f64;
        draft.row(row, at, at);
    }
    draft.done()
}

/// Directions without a limit in which the energy may fall.
pub fn unbounded(seed: u64) -> Instance {
    let random = &mut Random::new(seed);
    let (integers, reals) = sizes(random);
    let mut draft = unknowns(random, integers, reals.max(1));
    let n = draft.dim();
    for _ in 0..1 + random.below(2) {
        let j = random.below(n);
        match random.below(3) {
            0 => draft.of.lower[j] = -NONE,
            1 => draft.of.upper[j] = NONE,
            _ => (draft.of.lower[j], draft.of.upper[j]) = (-NONE, NONE),
        }
    }
    let count = random.below(n);
    draft.squares(random, count);
    draft.linear(random, 3);
    for _ in 0..random.below(3) {
        draft.range(random, 3);
    }
    draft.done()
}

/// Many rows through one point, some of them twice, parallel to each other or sums of others.
pub fn degenerate(seed: u64) -> Instance {
    let random = &mut Random::new(seed);
    let (integers, reals) = sizes(random);
    let mut draft = unknowns(random, integers, reals);
    if chance(random, 60) {
        draft.definite(random);
    } else {
        draft.linear(random, 3);
    }
    for _ in 0..2 + random.below(2) {
        let row = draft.coefficients(random, 3);
        let at = draft.value(&row);
        draft.row(row, -NONE, at);
    }
    for _ in 0..1 + random.below(3) {
        let of = draft.of.rows[random.below(draft.of.rows.len())].clone();
        let by = some(random, 2);
        let mut row: Vec<f64> = of.coefficients.iter().map(|a| by * a).collect();
        if chance(random, 40) {
            let other = &draft.of.rows[random.below(draft.of.rows.len())];
            row.iter_mut()
                .zip(&other.coefficients)
                .for_each(|(a, b)| *a += b);
        }
        let at = draft.value(&row);
        match random.below(3) {
            0 => draft.row(row, at, at + random.below(2) as f64),
            1 => draft.row(row, -NONE, at),
            _ => draft.equality(row),
        }
    }
    draft.done()
}

/// Coefficients up to a thousand, bounds far from zero.
pub fn large(seed: u64) -> Instance {
    let random = &mut Random::new(seed);
    let integers = 1 + random.below(3);
    let reals = random.below(2);
    let mut draft = unknowns(random, integers, reals);
    let shift = (random.next() * 1000.0).round();
    for j in 0..draft.dim() {
        draft.of.lower[j] += shift;
        draft.of.upper[j] += shift;
        draft.point[j] += shift;
    }
    draft.definite(random);
    for _ in 0..1 + random.below(3) {
        let mut row = draft.coefficients(random, 9);
        let at = random.below(row.len());
        row[at] = (random.next() * 1000.0).round();
        let at = draft.value(&row);
        let below = random.below(700) as f64;
        draft.row(row, at - below, at + random.below(4) as f64);
    }
    draft.done()
}

/// Unknowns that are pinned.
pub fn pinned(seed: u64) -> Instance {
    let mut of = match seed % 4 {
        0 => ranges(seed),
        1 => equalities(seed),
        2 => linear(seed),
        _ => singular(seed),
    };
    let random = &mut Random::new(seed ^ 0x55);
    for _ in 0..1 + random.below(2) {
        let j = random.below(of.unknowns());
        let (lower, upper) = (of.lower[j].max(-4.0), of.upper[j].min(4.0));
        let at = lower.ceil() + random.below(3) as f64;
        if at <= upper || chance(random, 10) {
            of.pins[j] = Some(at);
        }
    }
    of
}

/// Objectives that curve downwards in some direction of the integers, all of which are bounded.
pub fn not_convex(seed: u64) -> Instance {
    let random = &mut Random::new(seed);
    let integers = 2 + random.below(2);
    let mut draft = unknowns(random, integers, 0);
    draft.squares(random, 1);
    let (i, j) = (random.below(integers), random.below(integers));
    draft.of.hessian[i][j] -= 8.0;
    if i != j {
        draft.of.hessian[j][i] -= 8.0;
    }
    draft.range(random, 3);
    draft.done()
}

/// Integers with squares of their own, each in at most two rows: flows in a graph with signs at both ends.
pub fn flows(seed: u64) -> Instance {
    let random = &mut Random::new(seed);
    let integers = 3 + random.below(3);
    let mut draft = unknowns(random, integers, 0);
    draft.definite(random);
    let mut rows = vec![vec![0.0; integers]; 1 + random.below(3)];
    for j in 0..integers {
        for _ in 0..2 {
            let at = random.below(rows.len() + 1);
            if let Some(row) = rows.get_mut(at) {
                row[j] += [1.0, -1.0][random.below(2)];
            }
        }
    }
    for mut row in rows {
        let factor = [1.0, 1.0, 2.0, 0.5][random.below(4)];
        row.iter_mut().for_each(|a| *a *= factor);
        let at = draft.value(&row);
        match random.below(4) {
            0 => draft.row(row, at - whole(random, 3).abs() / 4.0, NONE),
            1 => draft.row(row, at - 0.25, at + random.below(3) as f64 / 2.0),
            _ => draft.equality(row),
        }
    }
    draft.done()
}

/// Reals that are zero where a binary is, and rows that hold sums of them.
pub fn switches(seed: u64) -> Instance {
    let random = &mut Random::new(seed);
    let (binaries, reals) = (1 + random.below(3), 2 + random.below(2));
    let mut draft = unknowns(random, binaries, reals);
    for z in 0..binaries {
        (draft.of.lower[z], draft.of.upper[z]) = (0.0, 1.0);
        draft.point[z] = random.below(2) as f64;
        draft.of.linear[z] = random.below(9) as f64 / 2.0;
    }
    draft.definite(random);
    for x in binaries..binaries + reals {
        let z = random.below(binaries);
        draft.point[x] *= draft.point[z];
        (draft.of.lower[x], draft.of.upper[x]) = (-NONE, NONE);
        for side in [1.0, -1.0] {
            let size = (side * draft.point[x]).max(0.0) + random.below(3) as f64 / 2.0;
            if side < 0.0 && size == 0.0 && chance(random, 50) {
                draft.of.lower[x] = 0.0;
                continue;
            }
            let mut row = vec![0.0; binaries + reals];
            (row[x], row[z]) = (side, -size);
            draft.row(row, -NONE, 0.0);
        }
    }
    if chance(random, 50) {
        draft.squares(random, 1);
    }
    let sum = (0..binaries + reals).map(|j| f64::from(u8::from(j >= binaries)));
    draft.equality(sum.collect());
    if chance(random, 50) {
        draft = draft.summed();
    }
    draft.done()
}
