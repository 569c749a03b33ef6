//! What is to be decided on the way from a mesh to quads, in one table.

use crate::field::Guidance;
use crate::map::{SeamlessOptions, Sizing};
use crate::search::table::options;
use crate::search::{Options, Strategy};
use crate::smooth::SmoothOptions;
use crate::untangle::UntangleOptions;

options! {
    /// How to make quads. The default is as many as [`SeamlessOptions`] has, along the curvature
    /// where it is clear. The integers of the map are decided by lattice decoding, those of the field
    /// adaptively: guided by curvature, it is no problem of short cycles, and rounding one by one is
    /// lower and faster.
    pub struct QuadOptions,

    /// The options of quads, beside those of the guidance and of the two solves.
    QUAD_OPTIONS {
        /// On meshes that are not large a few fields are tried. Never where curvature counts for
        /// nothing, or indices are given.
        vary_curvature: bool = true, "1" in "[0, 1]",
            "1: also try fields that follow curvature less than the guidance says, and keep the field whose map is least distorted";
        untangle: bool = true, "1" in "[0, 1]",
            "1: untangle the map if its folds keep extraction from making quads";
        stiffenings: usize = UntangleOptions::default().stiffenings, "5" in "[0, 1000]",
            "the number of times that untangling first stiffens the surroundings of folded triangles";
    }
    and {
        /// How large quads shall be.
        sizing: Sizing = Sizing::Quads(SeamlessOptions::default().quads);
        /// What they follow. Features, and the boundary where it is aligned, become chains of edges.
        guidance: Guidance = Guidance {
            constrain_curvature: 0.005,
            curvature_weight: 0.07,
            ..Guidance::default()
        };
        /// How the field is solved for.
        field: Options = by(Strategy::Adaptive);
        /// How the map is solved for.
        map: Options = by(Strategy::Lattice);
        /// How quads are smoothed; its features are added to those of the guidance. None leaves
        /// vertices where the map has them.
        smooth: Option<SmoothOptions> = Some(SmoothOptions::default());
        /// Strategies that both problems are solved with as well, to be compared.
        compare: Vec<Strategy> = Vec::new();
    }
    by {
        quads: Option<usize>, "1000" in "[1, 2147483647]",
            "the approximate number of quads",
            |options| match options.sizing {
                Sizing::Quads(count) => Some(count),
                _ => None,
            },
            |options, quads| options.size(quads.map(Sizing::Quads));
        edge_length: Option<f64>, "unset" in "(0, inf)",
            "the length of the edges of quads, in units of the mesh, instead of their number",
            |options| match options.sizing {
                Sizing::EdgeLength(length) => Some(length),
                _ => None,
            },
            |options, length| options.size(length.map(Sizing::EdgeLength));
        field_strategy: Strategy, "adaptive" in Strategy::WORDS,
            "the strategy that decides the integers of the field",
            |options| options.field.strategy,
            |options, strategy| options.field.strategy = strategy;
        smooth: bool, "1" in "[0, 1]",
            "1: move vertices over the surface to make the quads more like squares of one size",
            |options| options.smooth.is_some(),
            |options, smooth| options.smooth = smooth.then(SmoothOptions::default);
    }
}

fn by(strategy: Strategy) -> Options {
    Options {
        strategy,
        ..Options::default()
    }
}

impl QuadOptions {
    fn size(&mut self, sizing: Option<Sizing>) {
        if let Some(sizing) = sizing {
            self.sizing = sizing;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::search::table::hold;

    #[test]
    fn every_option_of_the_table_starts_at_its_default_and_comes_back_as_set() {
        hold(QUAD_OPTIONS, QuadOptions::set, QuadOptions::get);
    }
}
