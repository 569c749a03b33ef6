//! Cycle space, the fifth step of the cycle method: a closest-vector problem in the charges of the cycles.
//!
//! Around a cycle the angles cancel. Let M be the signed incidence of basis cycles and edges, W the weights
//! and rho the residuals. The only condition on the residuals is `M rho = c`, so
//!
//! ```text
//! min over angles of rho' W rho  =  c' A^-1 c,    A = M W^-1 M',    c = holonomy + step n,    n = M p.
//! ```
//!
//! A is sparse: on the dual of a mesh it is the graph Laplacian of the vertices. The potentials `x = A^-1
//! c` determine the residuals, `rho = W^-1 M' x`. At the relaxation's minimiser all residuals vanish. So
//! the energies here are differences from the relaxation's energy.

use super::basis::cycle_basis;
use super::cycles::Cycles;
use super::detect::AngleSystem;
use super::graph::NONE;
use super::laplacian::{factor, incidence, laplacian};
use crate::error::Result;
use crate::linalg::{Ldl, Sparse};
use crate::monitor::{may_continue, span};
use crate::round::nearest;

/// A system, an integral basis of its cycles, and the factor of A.
#[derive(Debug)]
pub(crate) struct CycleSpace {
    pub(super) system: AngleSystem,
    pub(super) basis: Cycles,
    /// `M'`: by edge, the cycles through it with their signs.
    pub(super) through: Sparse,
    /// The lower triangle of A.
    pub(super) laplacian: Sparse,
    pub(super) factor: Ldl,
    /// The origin of the charges: the integers nearest to the relaxation's.
    pub(super) origin: Vec<f64>,
    /// By edge: the residual at the relaxation's angles and the integers of the origin.
    pub(super) kappa: Vec<f64>,
    /// By cycle: the sum of `kappa` around it.
    pub(super) holonomy: Vec<f64>,
}

impl CycleSpace {
    /// The space of a system whose relaxation has the integers `relaxed`. The `hinted` cycles are
    /// candidates for the basis.
    ///
    /// # Errors
    /// For lack of memory, and the end of the call.
    pub fn new(system: AngleSystem, relaxed: &[f64], hinted: Cycles) -> Result<Self> {
        let _span = span("cycle space");
        let graph = &system.graph;
        let basis = cycle_basis(graph, hinted)?;
        let through = incidence(graph, &basis)?;
        let laplacian = laplacian(graph, &through)?;
        may_continue()?;
        let factor = factor(&laplacian, &basis)?;
        may_continue()?;
        let origin: Vec<f64> = relaxed.iter().map(|&p| nearest(p)).collect();
        let offset = |p: usize| {
            let turn = system.step * f64::from(system.sign[p]);
            turn * (origin[p] - relaxed[p])
        };
        let edges = graph.edges.iter();
        let kappa: Vec<f64> = edges
            .map(|e| match e.integer {
                NONE => 0.0,
                p => offset(p as usize),
            })
            .collect();
        Ok(CycleSpace {
            holonomy: basis.collect(&kappa),
            system,
            basis,
            through,
            laplacian,
            factor,
            origin,
            kappa,
        })
    }

    /// The potentials for `charges`, and the energy.
    pub fn potentials(&self, charges: &[f64]) -> (Vec<f64>, f64) {
        let pairs = self.holonomy.iter().zip(charges);
        let c: Vec<f64> = pairs.map(|(h, n)| h + self.system.step * n).collect();
        let x = self.factor.solve(&c);
        let energy = x.iter().zip(&c).map(|(x, c)| x * c).sum();
        (x, energy)
    }

    /// The residual of edge `e` at the potentials `x`.
    pub fn residual(&self, x: &[f64], e: usize) -> f64 {
        let flux: f64 = self.through.row(e).map(|(k, sign)| sign * x[k]).sum();
        flux / self.system.graph.edges[e].weight
    }
}
