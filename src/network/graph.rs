//! The problem as a bidirected graph: rows are vertices, unknowns are edges with a sign at each end.
//!
//! ```text
//! minimise   sum_e f_e(x_e),  f_e(x) = 1/2 Q_e x^2 + q_e x,  lower_e <= x_e <= upper_e, x_e integer
//! subject to sum_e s_ev x_e = b_v at every vertex v
//! ```
//!
//! An unknown in two rows joins them, one with coefficient +-2 in one row is a loop, and one in a single row
//! ends at the *root*, a vertex without a row. The slack of a row with two sides ends there, too.
//!
//! Costs are exact: all Q_e and q_e are multiples of one power of two, and everything is computed in units of
//! a sixteenth of it. The algorithms halve four times.

/// Sixteen units are one unit of the coefficients.
pub(super) const UNITS: i128 = 16;

/// No value of an edge is larger than this.
pub(super) const LARGEST: i128 = 1 << 20;

/// No edge is moved by more units than this from the half-integral optimum.
pub(super) const FARTHEST: i64 = 64;

/// No coefficient is larger than this, in units of the power of two that divides all.
const LARGEST_COST: f64 = (1u128 << 84) as f64;

/// An end of an edge: the vertex, and whether the edge adds to it.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct End {
    pub vertex: u32,
    pub sign: i8,
}

#[derive(Debug, Clone, Copy)]
pub(super) struct Edge {
    pub ends: [End; 2],
    pub lower: Option<i64>,
    pub upper: Option<i64>,
    /// Q and q, in the power of two.
    pub curvature: i128,
    pub slope: i128,
}

/// A bidirected graph. The last vertex is the root.
#[derive(Debug, Clone)]
pub(super) struct Network {
    pub edges: Vec<Edge>,
    pub demand: Vec<i64>,
    /// The exponent of the unit of cost.
    pub exponent: i32,
}

impl Edge {
    /// f(x + 1) - f(x).
    pub fn step(&self, x: i64) -> i128 {
        UNITS * (self.curvature * i128::from(x) + self.slope) + UNITS / 2 * self.curvature
    }

    /// f(x).
    pub fn cost(&self, x: i64) -> i128 {
        let x = i128::from(x);
        UNITS / 2 * x * (self.curvature * x + 2 * self.slope)
    }

    /// What a unit of the edge is worth with these multipliers of the vertices.
    pub fn price(&self, potential: &[i128]) -> i128 {
        let worth = |end: &End| i128::from(end.sign) * potential[end.vertex as usize];
        self.ends.iter().map(worth).sum()
    }

    /// A minimiser of f(x) - price x between the bounds. None if there is none, or a huge one.
    pub fn minimiser(&self, price: i128) -> Option<i64> {
        let first = self.step(0);
        let free = if self.curvature > 0 {
            let quantum = UNITS * self.curvature;
            // The least x whose step costs the price or more.
            let x = -((first - price).div_euclid(quantum));
            i64::try_from(x).ok()?
        } else if price == first {
            0
        } else if price > first {
            self.upper?
        } else {
            self.lower?
        };
        let x = free.max(self.lower.unwrap_or(i64::MIN));
        let x = x.min(self.upper.unwrap_or(i64::MAX));
        (i128::from(x).abs() <= LARGEST).then_some(x)
    }

    pub fn may_rise(&self, x: i64) -> bool {
        self.upper.is_none_or(|upper| x < upper)
    }

    pub fn may_fall(&self, x: i64) -> bool {
        self.lower.is_none_or(|lower| x > lower)
    }
}

impl Network {
    pub fn root(&self) -> u32 {
        self.demand.len() as u32 - 1
    }

    pub fn cost(&self, x: &[i64]) -> i128 {
        self.edges.iter().zip(x).map(|(e, &x)| e.cost(x)).sum()
    }

    /// Whether all sums of costs around `x` with these multipliers fit into an integer, by far.
    pub fn fits(&self, x: &[i64], potential: &[i128]) -> bool {
        let steepest = potential.iter().map(|p| p.unsigned_abs() as f64);
        let steepest = steepest.fold(0.0, f64::max);
        let size = |(e, x): (&Edge, &i64)| {
            let x = x.unsigned_abs() as f64 + 2.0 * FARTHEST as f64;
            let cost = x * (e.curvature as f64 * x + 2.0 * e.slope.unsigned_abs() as f64);
            UNITS as f64 * cost + 4.0 * FARTHEST as f64 * steepest
        };
        let sizes = self.edges.iter().zip(x).map(size);
        sizes.sum::<f64>() < 2f64.powi(120)
    }

    /// What `x` lacks at each vertex, and zero at the root.
    pub fn missing(&self, x: &[i64]) -> Vec<i64> {
        let mut missing = self.demand.clone();
        for (e, x) in self.edges.iter().zip(x) {
            for end in e.ends {
                missing[end.vertex as usize] -= i64::from(end.sign) * x;
            }
        }
        missing[self.root() as usize] = 0;
        missing
    }
}

/// The exponent of the largest power of two that divides all numbers. None if they are then too large.
pub(super) fn common_exponent(numbers: impl Iterator<Item = f64> + Clone) -> Option<i32> {
    let lowest = |x: f64| {
        let bits = x.to_bits();
        let biased = (bits >> 52 & 0x7ff) as i32;
        let fraction = bits & ((1 << 52) - 1);
        let mantissa = if biased == 0 {
            fraction
        } else {
            fraction | 1 << 52
        };
        biased.max(1) - 1075 + mantissa.trailing_zeros() as i32
    };
    let nonzero = numbers.filter(|x| *x != 0.0);
    let exponent = nonzero.clone().map(lowest).min().unwrap_or(0);
    let fits = |x: f64| x.abs() * 2f64.powi(-exponent) <= LARGEST_COST;
    (exponent.abs() < 500 && nonzero.clone().all(fits)).then_some(exponent)
}

/// A number in units of a power of two that divides it.
pub(super) fn in_units(x: f64, exponent: i32) -> i128 {
    (x * 2f64.powi(-exponent)) as i128
}
