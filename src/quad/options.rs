//! What is to be decided on the way from a mesh to quads.

use crate::field::Guidance;
use crate::map::{SeamlessOptions, Sizing};
use crate::smooth::SmoothOptions;
use crate::{Options, Strategy};

/// How to make quads.
#[derive(Debug, Clone, PartialEq)]
pub struct QuadOptions {
    /// How large quads shall be.
    pub sizing: Sizing,
    /// What they follow. Features, and the boundary where it is aligned, become chains of edges.
    pub guidance: Guidance,
    /// Whether curvature may count for less than the guidance has it, where the map is less
    /// distorted then: on meshes that are not large a few fields are tried. Never where it counts for
    /// nothing, or indices are given.
    pub vary_curvature: bool,
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
    /// As many quads as [`SeamlessOptions`] has them, along the curvature where it is clear. The
    /// integers of the map are decided by lattice decoding, those of the field adaptively: guided by
    /// curvature it is no problem of short cycles, and rounding one by one is lower and faster.
    fn default() -> Self {
        let by = |strategy| Options {
            strategy,
            ..Options::default()
        };
        QuadOptions {
            sizing: Sizing::Quads(SeamlessOptions::default().quads),
            guidance: Guidance {
                constrain_curvature: 0.005,
                curvature_weight: 0.07,
                ..Guidance::default()
            },
            vary_curvature: true,
            field: by(Strategy::Adaptive),
            map: by(Strategy::Lattice),
            untangle: true,
            smooth: Some(SmoothOptions::default()),
            compare: Vec::new(),
        }
    }
}
