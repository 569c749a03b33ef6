//! Pseudo-costs: how much each side of a branching raises the bound.
//!
//! A pseudo-cost is the mean rise of the bound, for each unit of rounding, that branchings on an unknown have
//! had (`benichou1971`). Until enough are known, both children are solved for a few iterations instead
//! (reliability branching, `achterberg2005`).

/// Branchings in each direction from which on a pseudo-cost is relied on.
const RELIABLE: u32 = 4;

/// A rise counts as at least this in the product of two rises.
const LEAST: f64 = 1e-6;

#[derive(Debug, Clone, Copy, Default)]
struct Mean {
    sum: f64,
    count: u32,
}

/// The mean rises of all unknowns, downwards and upwards.
#[derive(Debug)]
pub(super) struct PseudoCosts {
    of: Vec<[Mean; 2]>,
    all: [Mean; 2],
}

impl PseudoCosts {
    pub fn new(unknowns: usize) -> Self {
        PseudoCosts {
            of: vec![[Mean::default(); 2]; unknowns],
            all: [Mean::default(); 2],
        }
    }

    /// Records that the bound rose by `rise` when an unknown was rounded by `distance` (0 for down, 1 for up).
    pub fn record(&mut self, variable: usize, direction: usize, distance: f64, rise: f64) {
        let cost = rise.max(0.0) / distance.max(1e-6);
        for mean in [&mut self.of[variable][direction], &mut self.all[direction]] {
            mean.sum += cost;
            mean.count += 1;
        }
    }

    pub fn is_reliable(&self, variable: usize) -> bool {
        self.of[variable].iter().all(|mean| mean.count >= RELIABLE)
    }

    /// The rises to expect downwards and upwards for an unknown with this fraction.
    pub fn expected(&self, variable: usize, fraction: f64) -> [f64; 2] {
        [0, 1].map(|direction| {
            let own = self.of[variable][direction];
            let mean = if own.count > 0 {
                own
            } else {
                self.all[direction]
            };
            let cost = if mean.count > 0 {
                mean.sum / f64::from(mean.count)
            } else {
                1.0
            };
            cost * if direction == 0 {
                fraction
            } else {
                1.0 - fraction
            }
        })
    }
}

/// The merit of a branching with these rises.
pub(super) fn merit(rises: [f64; 2]) -> f64 {
    rises[0].max(LEAST) * rises[1].max(LEAST)
}
