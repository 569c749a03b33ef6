//! A tree of patches with its nested basis, its factor and the reduced lattice of each patch.

use super::dissect::{NO_PATCH, Patch, Recipe, dissect};
use super::factor::{Front, factor};
use super::local::Local;
use super::nested::NestedBasis;
use super::watch::Watch;
use crate::cycle::graph::Graph;
use crate::error::Result;
use crate::monitor::{may_continue, span};

/// An angle-difference system relative to a point without residuals: by edge, `kappa` is the residual that
/// the edge has there if no integer changes.
#[derive(Debug, Clone, Copy)]
pub(super) struct System<'a> {
    pub graph: &'a Graph,
    pub step: f64,
    pub kappa: &'a [f64],
}

/// Everything about a tree that no threshold changes.
#[derive(Debug, Clone)]
pub(super) struct PatchTree {
    pub patches: Vec<Patch>,
    pub basis: NestedBasis,
    pub fronts: Vec<Front>,
    pub locals: Vec<Local>,
    /// By patch: the number of cycles of the patch and its descendants.
    pub cycles: Vec<usize>,
    /// By patch: the number of its first descendant, which all others but itself follow.
    pub first: Vec<usize>,
    /// By patch: the number of the ancestors' cycles.
    above_rows: Vec<usize>,
}

impl PatchTree {
    /// The tree of `recipe`, for an incumbent with these residuals. None if `watch` ends it, or if the tree does not
    /// fit into memory.
    ///
    /// # Errors
    /// For integers too large to be exact.
    pub fn new(
        system: System,
        residuals: &[f64],
        recipe: &Recipe,
        watch: &mut dyn Watch,
    ) -> Result<Option<Self>> {
        let dissected = span("dissect");
        let (patches, work) = dissect(system.graph, residuals, recipe, watch.left());
        drop(dissected);
        let stop = &mut |work| watch.ends(work) || may_continue().is_err();
        let Some(patches) = patches.filter(|_| !stop(work)) else {
            return Ok(None);
        };
        let Ok(basis) = NestedBasis::new(system.graph, &patches) else {
            return Ok(None);
        };
        let factored = span("factor patches");
        let Some(fronts) = factor(system.graph, &patches, &basis, stop) else {
            return Ok(None);
        };
        drop(factored);
        let _reduced = span("reduce patches");
        let alpha = basis.cycles.collect(system.kappa);
        let mut locals = Vec::with_capacity(patches.len());
        let mut cycles = Vec::with_capacity(patches.len());
        for (at, front) in fronts.iter().enumerate() {
            let own = basis.own[at].clone();
            if stop((own.len() as u64).pow(3)) {
                return Ok(None);
            }
            let children = patches[at].children.iter().flatten();
            let below: usize = children.map(|&c| cycles[c]).sum();
            cycles.push(below + own.len());
            locals.push(Local::new(front, &alpha[own], system.step, stop)?);
        }
        let mut above_rows = vec![0; patches.len()];
        for at in (0..patches.len()).rev() {
            let parent = patches[at].parent;
            if parent != NO_PATCH {
                above_rows[at] = above_rows[parent] + fronts[parent].own;
            }
        }
        let mut first: Vec<usize> = Vec::with_capacity(patches.len());
        for (at, patch) in patches.iter().enumerate() {
            first.push(patch.children.map_or(at, |[child, _]| first[child]));
        }
        Ok(Some(PatchTree {
            first,
            above_rows,
            patches,
            basis,
            fronts,
            locals,
            cycles,
        }))
    }

    /// The number of cycles of all ancestors of a patch.
    pub fn above_rows(&self, at: usize) -> usize {
        self.above_rows[at]
    }

    /// The last patch, which is the root.
    pub fn root(&self) -> usize {
        self.patches.len() - 1
    }

    /// The other child of the parent.
    pub fn sibling(&self, at: usize) -> Option<usize> {
        let parent = self.patches[at].parent;
        if parent == NO_PATCH {
            return None;
        }
        let children = self.patches[parent].children?;
        Some(children[usize::from(children[0] == at)])
    }
}
