//! Integers on a graph, decided by minimum cuts: phase unwrapping and its relatives, of any size.
//!
//! The energy is `sum w_ij (n_i - n_j - d_ij)^2 / 2 + sum s_i (n_i - a_i)^2 / 2` with `w, s >= 0` and no
//! other unknowns. It is L-natural-convex (`murota2003`, chapter 7). So an integer point is optimal if no
//! set of unknowns lowers the energy when all of it goes up or down by one. A minimum cut finds the best
//! such set (`bioucasdias2007`). The steps are:
//!
//! ```text
//! ReducedModel --graph--> CutGraph --network--> Network --flow, price--> integers --certificate--> bound
//! ```
//!
//! The flow and the integers are a primal and a dual solution of one convex network problem (`ahuja2003`;
//! `kolmogorov2009`). The last flow therefore proves a lower bound on its own.

mod certificate;
mod flow;
mod graph;
mod network;
mod price;
mod strategy;

pub(crate) use strategy::exact;

#[cfg(test)]
mod tests;
