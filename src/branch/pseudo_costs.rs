//! Pseudo-costs: how much each side of a branching raises the bound.
//!
//! A pseudo-cost is the mean rise of the bound, for each unit of rounding, that branchings on an unknown have
//! had (`benichou1971`). Until enough are known, both children are solved for a few iterations instead
//! (reliability branching, `achterberg2005`).

/// Branchings in each direction from which on a pseudo-cost is relied on.
const RELIABLE: u32 = 4;

/// A rise counts as at least this in the product of two rises.
const LEAST: f64 = 1e-6;

/// A rise of the bound, for each unit of rounding.
#[derive(Debug, Clone, Copy)]
struct Rise {
    variable: u32,
    direction: usize,
    cost: f64,
}

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
    /// The rises since the copy was made, where these are a copy.
    since: Option<Vec<Rise>>,
}

impl PseudoCosts {
    pub fn new(unknowns: usize) -> Self {
        PseudoCosts {
            of: vec![[Mean::default(); 2]; unknowns],
            all: [Mean::default(); 2],
            since: None,
        }
    }

    /// A copy that remembers which rises it records.
    pub fn copy(&self) -> Self {
        PseudoCosts {
            of: self.of.clone(),
            all: self.all,
            since: Some(Vec::new()),
        }
    }

    /// Records what a copy has recorded.
    pub fn join(&mut self, copy: &PseudoCosts) {
        for &rise in copy.since.iter().flatten() {
            self.add(rise);
        }
    }

    /// Records that the bound rose by `rise` when an unknown was rounded by `distance` (0 for down, 1 for up).
    pub fn record(&mut self, variable: usize, direction: usize, distance: f64, rise: f64) {
        let cost = rise.max(0.0) / distance.max(1e-6);
        self.add(Rise {
            variable: variable as u32,
            direction,
            cost,
        });
    }

    fn add(&mut self, rise: Rise) {
        let Rise {
            variable,
            direction,
            cost,
        } = rise;
        let own = &mut self.of[variable as usize][direction];
        for mean in [own, &mut self.all[direction]] {
            mean.sum += cost;
            mean.count += 1;
        }
        if let Some(since) = &mut self.since {
            since.push(rise);
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_a_copy_records_is_joined_as_if_it_was_recorded_in_that_order() {
        let mut whole = PseudoCosts::new(2);
        whole.record(0, 1, 0.3, 2.0);
        let mut joined = PseudoCosts::new(2);
        joined.record(0, 1, 0.3, 2.0);
        let mut copies = [joined.copy(), joined.copy()];
        for (variable, rise) in [(1, 0.1), (0, 0.7), (1, 1.3)] {
            for (k, copy) in copies.iter_mut().enumerate() {
                copy.record(variable, k, 0.6, rise + k as f64);
            }
        }
        for k in [0, 1] {
            for (variable, rise) in [(1, 0.1), (0, 0.7), (1, 1.3)] {
                whole.record(variable, k, 0.6, rise + k as f64);
            }
        }
        copies.iter().for_each(|copy| joined.join(copy));
        for variable in [0, 1] {
            assert_eq!(
                joined.expected(variable, 0.4),
                whole.expected(variable, 0.4)
            );
            assert_eq!(joined.is_reliable(variable), whole.is_reliable(variable));
        }
    }
}
