//! The oracle: the least energy of a small problem in exact rational arithmetic.

use num_rational::BigRational;

/// An objective `1/2 x'Hx + g'x + c` in exact numbers.
#[derive(Clone)]
pub struct Quadratic {
    pub hessian: Vec<Vec<BigRational>>,
    pub gradient: Vec<BigRational>,
    pub constant: BigRational,
}

pub fn exact(x: f64) -> BigRational {
    BigRational::from_float(x).unwrap()
}

pub fn zero() -> BigRational {
    exact(0.0)
}

impl Quadratic {
    pub fn zero(n: usize) -> Self {
        Quadratic {
            hessian: vec![vec![zero(); n]; n],
            gradient: vec![zero(); n],
            constant: zero(),
        }
    }

    /// Adds `weight * (row x - rhs)^2`.
    pub fn add_square(&mut self, row: &[BigRational], rhs: &BigRational, weight: &BigRational) {
        let two = exact(2.0) * weight;
        for (i, a) in row.iter().enumerate() {
            for (j, b) in row.iter().enumerate() {
                self.hessian[i][j] += &two * a * b;
            }
            self.gradient[i] -= &two * a * rhs;
        }
        self.constant += weight * rhs * rhs;
    }

    pub fn energy(&self, x: &[BigRational]) -> BigRational {
        let half = exact(0.5);
        let mut sum = self.constant.clone();
        for i in 0..x.len() {
            let row = &self.hessian[i];
            let pull = row.iter().zip(x).fold(zero(), |s, (h, x)| s + h * x);
            sum += &x[i] * (&self.gradient[i] + &half * pull);
        }
        sum
    }

    /// The objective with the last unknown at its minimum.
    fn without_last(&self) -> Self {
        let k = self.gradient.len() - 1;
        let pivot = &self.hessian[k][k];
        let mut rest = Quadratic::zero(k);
        for i in 0..k {
            let factor = &self.hessian[k][i] / pivot;
            for j in 0..k {
                rest.hessian[i][j] = &self.hessian[i][j] - &factor * &self.hessian[k][j];
            }
            rest.gradient[i] = &self.gradient[i] - &factor * &self.gradient[k];
        }
        let half = exact(0.5);
        rest.constant = &self.constant - half * &self.gradient[k] * &self.gradient[k] / pivot;
        rest
    }

    /// Whether some direction has no curvature.
    pub fn is_singular(&self) -> bool {
        let mut rest = self.clone();
        while let Some(k) = rest.gradient.len().checked_sub(1) {
            if rest.hessian[k][k] == zero() {
                return true;
            }
            rest = rest.without_last();
        }
        false
    }

    /// The least energy over integers, where only the first `integers` unknowns are integer. Some integer
    /// point must have at most the energy `enough`.
    pub fn least_energy(mut self, integers: usize, enough: &BigRational) -> BigRational {
        while self.gradient.len() > integers {
            self = self.without_last();
        }
        self.reduce();
        self.sort();
        // The objective with the unknowns from k on at their minimum, for each k.
        let mut levels = vec![self];
        while levels.last().unwrap().gradient.len() > 1 {
            levels.push(levels.last().unwrap().without_last());
        }
        levels.reverse();
        let mut best = enough.clone();
        search(&levels, &mut Vec::new(), &mut best);
        best
    }

    /// Subtracts multiples of basis vectors from each other as long as one becomes shorter. The integers of
    /// the result are a unimodular image of those before.
    fn reduce(&mut self) {
        let n = self.gradient.len();
        loop {
            let mut changed = false;
            for i in 0..n {
                for j in (0..n).filter(|&j| j != i) {
                    let ratio = &self.hessian[i][j] / &self.hessian[j][j];
                    let q = ratio.round();
                    // A ratio of one half would change its sign without end.
                    if &ratio * &ratio <= exact(0.25) {
                        continue;
                    }
                    changed = true;
                    let from = self.hessian[j].clone();
                    for (h, f) in self.hessian[i].iter_mut().zip(&from) {
                        *h -= &q * f;
                    }
                    for row in &mut self.hessian {
                        let f = row[j].clone();
                        row[i] -= &q * f;
                    }
                    let g = self.gradient[j].clone();
                    self.gradient[i] -= &q * g;
                }
            }
            if !changed {
                return;
            }
        }
    }

    /// Puts the longest basis vectors first, which leave few integers to try for the first unknowns.
    fn sort(&mut self) {
        let mut order: Vec<usize> = (0..self.gradient.len()).collect();
        order.sort_by(|&i, &j| self.hessian[j][j].cmp(&self.hessian[i][i]));
        let row = |i: &usize| order.iter().map(|&j| self.hessian[*i][j].clone()).collect();
        let hessian = order.iter().map(row).collect();
        self.gradient = order.iter().map(|&i| self.gradient[i].clone()).collect();
        self.hessian = hessian;
    }
}

/// Tries all integers, unknown by unknown, whose energy can be at most `best`.
fn search(levels: &[Quadratic], fixed: &mut Vec<BigRational>, best: &mut BigRational) {
    let k = fixed.len();
    let level = &levels[k];
    let row = &level.hessian[k];
    let pull = row.iter().zip(&*fixed).fold(zero(), |s, (h, x)| s + h * x);
    let centre = -(&level.gradient[k] + pull) / &row[k];
    let first = centre.round();
    for direction in [1.0, -1.0] {
        let step = exact(direction);
        let mut z = if direction > 0.0 {
            first.clone()
        } else {
            &first - exact(1.0)
        };
        loop {
            fixed.push(z.clone());
            let energy = level.energy(fixed);
            let inside = energy <= *best;
            if inside && k + 1 == levels.len() {
                *best = energy;
            } else if inside {
                search(levels, fixed, best);
            }
            fixed.pop();
            // Energies only rise from the nearest integer outwards.
            if !inside {
                break;
            }
            z += &step;
        }
    }
}
