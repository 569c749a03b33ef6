//! The Schur complement of the integers: what the objective asks of them when the continuous
//! unknowns follow.
//!
//! One factorization, continuous unknowns first and integers last: the trailing block of the
//! factor is the factor of the Schur complement (Golub, Van Loan, section 4.2), so the complement
//! itself is never formed and loses no digits to being squared. The continuous unknowns stand in
//! minimum-degree order of their own block, post-ordered, which faer's supernodes want; the
//! integers fill up to a dense block whatever their order.

use crate::Result;
use crate::eliminate::ReducedModel;
use crate::linalg::{Cholesky, EliminationTree, Sparse, minimum_degree};

/// The upper triangular `R`, by columns, with `R'R` the Schur complement of the integers of
/// `model`, and whether no pivot vanished: a vanished one leaves a zero row.
///
/// # Errors
/// For lack of memory, or where the factor would exceed 2^32 entries.
pub fn schur_factor(model: &ReducedModel) -> Result<(Vec<f64>, bool)> {
    let continuous = model.continuous();
    let mut place = vec![u32::MAX; model.dim()];
    for (k, &i) in continuous.iter().enumerate() {
        place[i as usize] = k as u32;
    }
    let own = model.hessian().entries().filter_map(|(i, j, v)| {
        let (a, b) = (place[i as usize], place[j as usize]);
        (a != u32::MAX && b != u32::MAX).then_some((a, b, v))
    });
    let block = Sparse::from_triplets(continuous.len(), continuous.len(), own)?;
    let tree = EliminationTree::new(&block, &minimum_degree(&block)?);
    let mut order: Vec<u32> = tree.order.iter().map(|&k| continuous[k as usize]).collect();
    order.extend(model.integers());
    let factor = Cholesky::in_order(model.hessian(), &order)?;
    Ok(factor.trailing_factor(model.integers().len()))
}
