//! Bounds and proofs for angle-difference systems: a tree of patches, merged from the leaves upward through
//! complete lists of everything that can still be optimal.
//!
//! Patches share no edge, so the energies of the halves of a patch, each with its angles free, add up to a
//! lower bound for the patch. The tree is a nested dissection (`george1973`) of the graph. With the nested
//! basis of cycles ([`nested`]), the energy of a patch is the sum of those of its halves and of a square for
//! the cycles through both ([`factor`]). The steps are:
//!
//! ```text
//! incumbent --dissect (bisect, coarsen)--> patches --nested, factor, local--> PatchTree
//!     --schedule (subtree, join, list)--> bounds, lists --account--> proved bounds;    prove: all of this
//! ```

mod account;
mod bisect;
mod coarsen;
mod conditions;
mod dissect;
mod effort;
mod factor;
mod join;
mod list;
mod local;
mod nested;
mod prove;
mod schedule;
mod subtree;
mod tree;
mod watch;

pub(super) use effort::Proof;
pub(super) use prove::prove;

#[cfg(test)]
mod tests;
