//! A problem of each family (field and map), reduced and relaxed.

use roundel::field::{FieldProblem, curvature_constraints};
use roundel::internals::eliminate::{ReducedModel, eliminate};
use roundel::internals::linalg::{Lowest, Minimum, RelaxedFactor};
use roundel::map::{SeamlessOptions, SeamlessProblem};
use roundel::mesh::shape;
use roundel::{Error, Model, Monitor, Options, Problem, Result, solve};

/// The number of faces of the mesh.
pub const TRIANGLES: usize = 40_000;

/// A problem, its reduced model after elimination, and the minimiser of that model.
pub struct Case {
    /// The family and the threads.
    pub family: String,
    pub problem: Problem,
    pub reduced: ReducedModel,
    pub relaxed: Vec<f64>,
    pub factor: RelaxedFactor,
}

/// An orientation field (many integers, each of local influence) and a map (few integers, each of
/// global influence).
pub fn cases(threads: usize) -> Result<[Case; 2]> {
    let mesh = shape::by_name("genus-2", TRIANGLES)?;
    let field = FieldProblem::new(&mesh, &curvature_constraints(&mesh, 0.1)?)?;
    let solution = solve(field.problem(), &Options::orientation_field())?;
    let options = SeamlessOptions { quads: 1000 };
    let map = SeamlessProblem::new(&mesh, &field.field(&mesh, &solution)?, &options)?;
    Ok([
        Case::new(format!("field, {threads} threads"), field.problem().clone())?,
        Case::new(format!("map, {threads} threads"), map.problem().clone())?,
    ])
}

impl Case {
    fn new(family: String, problem: Problem) -> Result<Self> {
        let model = Model::new(&problem)?;
        let reduced = eliminate(&model, &mut Monitor::default())?;
        let factor = RelaxedFactor::new(reduced.hessian(), reduced.integers())?;
        let rounding = || reduced.gradient_rounding(&model);
        let minimum = factor.minimise(reduced.gradient(), rounding, reduced.guess())?;
        let Minimum::At(Lowest { point, .. }) = minimum else {
            return Err(Error::NotSupported {
                what: "a benchmark without a minimum".into(),
                index: None,
                line: None,
            });
        };
        Ok(Case {
            family,
            problem,
            reduced,
            relaxed: point,
            factor,
        })
    }

    /// The integer unknown whose rounding moves it most, and its rounded value.
    pub fn rounded(&self) -> (u32, f64) {
        let deviation = |&i: &u32| {
            let x = self.relaxed[i as usize];
            (x - x.round()).abs()
        };
        let by_deviation = |a: &u32, b: &u32| deviation(a).total_cmp(&deviation(b));
        let farthest = self.reduced.integers().iter().copied().max_by(by_deviation);
        let farthest = farthest.unwrap_or(0);
        (farthest, self.relaxed[farthest as usize].round())
    }
}
