//! Nearest plane in cycle space: one forward substitution.
//!
//! With `A = L D L'`, the energy is the sum of `w_k^2 / d_k` over `w = L^-1 c`. The substitution runs in
//! the order of elimination and rounds each charge at its pivot, so that |w_k| is least. This is Babai's
//! nearest plane (`babai1986`, section 3) in the lattice basis whose coordinates are the charges. On the
//! dual of a mesh this basis is nearly reduced. The long cycles come last, when all others have their
//! charges.

use super::space::CycleSpace;
use crate::round::nearest;

impl CycleSpace {
    /// The charges of the nearest-plane point.
    pub fn nearest_plane(&self) -> Vec<f64> {
        let (order, scale) = (&self.factor.tree().order, self.factor.scale());
        let scaled = |&k: &u32| self.holonomy[k as usize] * scale[k as usize];
        let mut w: Vec<f64> = order.iter().map(scaled).collect();
        let mut charges = vec![0.0; w.len()];
        for (j, &k) in order.iter().enumerate() {
            let unit = self.system.step * scale[k as usize];
            charges[k as usize] = -nearest(w[j] / unit);
            w[j] += unit * charges[k as usize];
            let settled = w[j];
            for (i, l) in self.factor.column(j) {
                w[i] -= l * settled;
            }
        }
        charges
    }
}
