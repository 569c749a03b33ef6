//! What is to be decided on the way from a mesh to quads.

use crate::quad::{Guidance, SeamlessOptions, Sizing, SmoothOptions};
use crate::{Options, Strategy};

/// How to make quads.
#[derive(Debug, Clone, PartialEq)]
pub struct QuadOptions {
    /// How large quads shall be.
    pub sizing: Sizing,
    /// What they follow. Features, and the boundary where it is aligned, become chains of edges.
    pub guidance: Guidance,
    /// So many faces a quad, those with the most reliable curvature, have its direction, where that
    /// is more than the guidance has. On meshes that are not large, some more and fewer are tried, and
    /// those are taken whose map has the least energy.
    pub constrained_per_quad: f64,
    /// How the field is solved for.
    pub field: Options,
    /// How the map is solved for.
    pub map: Options,
    /// Whether a map is untangled whose folds extraction cannot cope with.
    pub untangle: bool,
    /// How quads are smoothed; its features are added to those of the guidance. None leaves
    /// vertices where the map has them.
    pub smooth: Option<SmoothOptions>,
    /// Strategies that both problems are solved with as well, to be compared.
    pub compare: Vec<Strategy>,
}

impl Default for QuadOptions {
    /// As many quads as [`SeamlessOptions`] has them, along the curvature where it is clear, with
    /// the integers of field and map decided by lattice decoding.
    fn default() -> Self {
        let lattice = Options {
            strategy: Strategy::Lattice,
            ..Options::default()
        };
        QuadOptions {
            sizing: Sizing::Quads(SeamlessOptions::default().quads),
            guidance: Guidance {
                curvature_weight: 0.07,
                ..Guidance::default()
            },
            constrained_per_quad: 0.1,
            field: lattice.clone(),
            map: lattice,
            untangle: true,
            smooth: Some(SmoothOptions::default()),
            compare: Vec::new(),
        }
    }
}
