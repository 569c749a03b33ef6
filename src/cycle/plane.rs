//! Nearest plane in cycle space: one forward substitution.
//!
//! With `A = L D L'`, the energy is the sum of `w_k^2 / d_k` over `w = L^-1 c`. Going through the
//! substitution in order of elimination, and rounding every charge where its pivot is reached so
//! that |w_k| is least, is Babai's algorithm (`babai1986`, section 3) on the basis whose coordinates the
//! charges are; on the dual of a mesh it is nearly reduced. The long cycles come last and see all
//! others settled.

use super::space::CycleSpace;
use crate::round::nearest;

impl CycleSpace {
    /// The charges that nearest plane reaches.
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
