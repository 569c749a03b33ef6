//! What all solves of a form share: the inverse of its Hessian, and the products of its rows with it.

use super::form::Form;
use super::inverse::Inverse;
use crate::error::Result;

/// The product of a row with `P`.
pub(super) type Image = (Vec<u32>, Vec<f64>);

/// What all solves of a form share.
#[derive(Debug)]
pub(super) struct Shared {
    pub inverse: Inverse,
    /// `P a` for each row.
    pub images: Vec<Image>,
    /// `(a'Pa)^-1/2` for each unknown and each row, by which violations are compared.
    pub scales: Vec<f64>,
}

impl Shared {
    /// # Errors
    /// Those of [`Inverse::new`].
    pub fn new(form: &Form, regularization: &[f64]) -> Result<Self> {
        let inverse = Inverse::new(&form.hessian, regularization)?;
        let scales = (0..form.dim()).map(|j| scale(inverse.diagonal(j)));
        let mut shared = Shared {
            scales: scales.collect(),
            images: Vec::with_capacity(form.rows.rows()),
            inverse,
        };
        shared.extend(form);
        Ok(shared)
    }

    /// Computes what is missing for the last rows of the form.
    pub fn extend(&mut self, form: &Form) {
        let Shared {
            inverse,
            images,
            scales,
        } = self;
        let mut dense = vec![0.0; form.dim()];
        let mut seen = vec![false; form.dim()];
        for i in images.len()..form.rows.rows() {
            let mut touched: Vec<u32> = Vec::new();
            for (j, a) in form.rows.row(i) {
                let (members, column) = inverse.column(j);
                for (&k, p) in members.iter().zip(column) {
                    if !std::mem::replace(&mut seen[k as usize], true) {
                        touched.push(k);
                    }
                    dense[k as usize] += a * p;
                }
            }
            touched.sort_unstable();
            let square = form.rows.row(i).map(|(j, a)| a * dense[j]).sum();
            scales.push(scale(square));
            let values = touched.iter().map(|&k| {
                seen[k as usize] = false;
                std::mem::take(&mut dense[k as usize])
            });
            let values = values.collect();
            images.push((touched, values));
        }
    }
}

fn scale(square: f64) -> f64 {
    if square > 0.0 {
        1.0 / square.sqrt()
    } else {
        0.0
    }
}
