//! The points found by an enumeration, and its radius, which shrinks with each closer point.

/// A point counts as closer than the best one if its squared distance is smaller by at least this part. That
/// is far above the rounding errors of a sum of squares, and far below the gap at which a solution counts
/// as optimal.
pub const NEARER: f64 = 2e-12;

/// The largest number of points that are kept.
pub const MOST: usize = 64;

/// The nearest points so far.
pub(super) struct NearPoints {
    pub radius: f64,
    margin: f64,
    near: Vec<(Vec<f64>, f64)>,
}

impl NearPoints {
    pub fn new(radius: f64, margin: f64) -> Self {
        NearPoints {
            radius,
            margin,
            near: Vec::new(),
        }
    }

    /// Adds a point within the radius and shrinks the radius to it.
    #[cold]
    pub fn take(&mut self, z: &[f64], distance: f64) {
        if self.margin > 0.0 {
            self.radius = self.radius.min(distance + self.margin);
            let radius = self.radius;
            self.near.retain(|(_, d)| *d <= radius);
            self.near.push((z.to_vec(), distance));
            if self.near.len() <= MOST {
                return;
            }
            self.margin = 0.0;
        } else {
            self.near.push((z.to_vec(), distance));
        }
        // Keeps only the closest point, and the first of several at the same distance.
        let closest = self.near.iter().map(|n| n.1).fold(f64::INFINITY, f64::min);
        self.near.retain(|n| n.1 == closest);
        self.near.truncate(1);
        self.radius = closest * (1.0 - NEARER);
    }

    pub fn nearest_first(mut self) -> Vec<(Vec<f64>, f64)> {
        self.near
            .retain(|(_, d)| *d <= self.radius || self.margin == 0.0);
        self.near.sort_by(|a, b| a.1.total_cmp(&b.1));
        self.near
    }
}
