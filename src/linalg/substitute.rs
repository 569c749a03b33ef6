//! Forward and back substitution with the simplicial factor (`davis2006`, chapter 3).

use super::Ldl;

impl Ldl {
    /// The entries `(row, value)` of column `j` of L below the diagonal, by position.
    pub fn column(&self, j: usize) -> impl Iterator<Item = (usize, f64)> + '_ {
        let range = self.offsets[j]..self.ends[j];
        let rows = self.indices[range.clone()].iter();
        rows.zip(&self.values[range])
            .map(|(&i, &v)| (i as usize, v))
    }

    /// Solves `A x = b`. If A is singular and the system consistent, unknowns with a vanished pivot get 0.
    pub fn solve(&self, b: &[f64]) -> Vec<f64> {
        let n = self.dim();
        let order = &self.tree.order;
        let scaled = |&i: &u32| b[i as usize] * self.scale[i as usize];
        let mut y: Vec<f64> = order.iter().map(scaled).collect();
        for j in 0..n {
            let settled = y[j];
            for (i, l) in self.column(j) {
                y[i] -= l * settled;
            }
        }
        for (y, &d) in y.iter_mut().zip(&self.pivots) {
            *y = if d == 0.0 { 0.0 } else { *y / d };
        }
        for j in (0..n).rev() {
            let known: f64 = self.column(j).map(|(i, l)| l * y[i]).sum();
            y[j] -= known;
        }
        let mut x = vec![0.0; n];
        for (&i, y) in order.iter().zip(y) {
            x[i as usize] = y * self.scale[i as usize];
        }
        x
    }
}
