//! Equality constraints are eliminated before anything else: `x = T y + t`, with `y` free.

mod expansion;
mod reduced;

pub use expansion::Expansion;
pub use reduced::ReducedModel;

use crate::solve::Monitor;
use crate::{Error, Model, Result};

/// The reduced model of a problem without constraints and pins.
///
/// # Errors
/// [`Error::NotSupported`] for constraints and pins.
pub fn eliminate(model: &Model, _: &mut Monitor) -> Result<ReducedModel> {
    if model.constraints().rows() > 0 || model.pinned().iter().any(Option::is_some) {
        return Err(Error::NotSupported {
            what: "constraints".into(),
            index: Some(0),
            line: None,
        });
    }
    let n = model.variables();
    let diag = (0..n as u32).map(|i| (i, i, 0.0));
    let h =
        crate::linalg::Sparse::from_triplets(n, n, model.hessian().entries().chain(diag.clone()))?;
    let id = crate::linalg::Sparse::from_triplets(n, n, diag.map(|(i, j, _)| (i, j, 1.0)))?;
    Ok(ReducedModel {
        hessian: h,
        gradient: model.gradient().to_vec(),
        constant: model.constant(),
        integers: (0..n as u32)
            .filter(|&i| model.integer()[i as usize])
            .collect(),
        continuous: (0..n as u32)
            .filter(|&i| !model.integer()[i as usize])
            .collect(),
        guess: model.guess().to_vec(),
        expansion: Expansion::new(id, vec![0.0; n]),
    })
}
