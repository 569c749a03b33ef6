//! All options from a mesh to quads, in one table.

use super::Count;
use crate::field::Guidance;
use crate::map::{SeamlessOptions, Sizing};
use crate::mesh::mirror::Mirror;
use crate::search::table::{options, words};
use crate::search::{Options, Strategy};
use crate::smooth::SmoothOptions;
use crate::untangle::UntangleOptions;

words! {
    /// What sizes change near.
    #[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
    pub enum Near {
        #[default]
        Nothing = "nothing": "Nothing.",
        Features = "features": "The features, the boundary among them where it is followed.",
        Boundary = "boundary": "The boundary.",
        Vertices = "vertices": "The vertices of the options.",
    }
}

options! {
    /// How to make quads. By default, [`SeamlessOptions`] gives their number, and they follow the
    /// curvature where it is clear. Lattice decoding decides the integers of the map. Adaptive rounding
    /// decides those of the field: guided by curvature, its integers are not tied by short cycles, and
    /// rounding one by one is faster and gives a lower energy.
    pub struct QuadOptions,

    /// The options of quads, besides those of the guidance and of the two solves.
    QUAD_OPTIONS {
        count: Count = Count::Exact, "exact" in Count::WORDS,
            "exact: a number of quads is met within 1 %, or as nearly as a few maps of other sizes come; about: one map is made, whose number differs by up to a fifth";
        /// Several fields are tried on meshes that are not large, unless curvature has no weight or
        /// indices are prescribed.
        vary_curvature: bool = true, "1" in "[0, 1]",
            "1: also try fields that follow curvature less than the guidance says, and keep the field whose map is least distorted";
        /// Fields and maps then belong to the refined mesh: see [`Quadrangulation`](super::Quadrangulation).
        refine: bool = true, "1" in "[0, 1]",
            "1: refine the mesh first where edges are longer than three edges of the quads or angles are below 2 degrees";
        /// See [`SizeMetric`](super::SizeMetric).
        adapt: f64 = 0.0, "0" in "[0, 1]",
            "how far quads get smaller where the surface curves: 0: not at all, 1: until edges deviate from it equally far everywhere";
        /// The map has these lengths as nearly as irregular vertices and integers allow.
        stretch: f64 = 0.0, "0" in "[0, 1]",
            "how far quads get longer along directions in which the surface curves less: 0: not at all, 1: until edges of both directions deviate from it equally far, or are four to one";
        min_length: Option<f64> = None, "unset" in "(0, inf)",
            "the least length of an edge of quads that is aimed at, in units of the mesh";
        max_length: Option<f64> = None, "unset" in "(0, inf)",
            "the largest length of an edge of quads that is aimed at, in units of the mesh";
        gradation: f64 = 1.5, "1.5" in "(1, inf)",
            "the ratio of the lengths of neighbouring edges that is aimed at where sizes vary, at most";
        near: Near = Near::Nothing, "nothing" in Near::WORDS,
            "what sizes change near, by distance along the surface";
        near_size: f64 = 0.5, "0.5" in "(0, inf)",
            "the factor of lengths there: below 1 quads are smaller there, above 1 larger";
        near_distance: Option<f64> = None, "unset" in "(0, inf)",
            "the distance up to which they change, in units of the mesh; unset: ten edges of quads";
        untangle: bool = true, "1" in "[0, 1]",
            "1: untangle the map if its folds keep extraction from making quads";
        stiffenings: usize = UntangleOptions::default().stiffenings, "5" in "[0, 1000]",
            "the number of times that untangling first stiffens the surroundings of folded triangles";
        /// See [`mirror_planes`](crate::mesh::mirror::mirror_planes).
        mirror_tolerance: f64 = 0.05, "0.05" in "[0, 1]",
            "how far a mirror plane may move a vertex from the surface, as a part of the diagonal of the bounding box";
    }
    and {
        /// The size of the quads.
        sizing: Sizing = Sizing::Quads(SeamlessOptions::default().quads);
        /// How dense quads are at every vertex of the mesh, as a factor of the number of edges a length; empty: evenly.
        density: Vec<f64> = Vec::new();
        /// The vertices that quads change their size near, if [`near`](Self::near) says so.
        near_vertices: Vec<usize> = Vec::new();
        /// The guidance. Features, and the boundary where it is aligned, become chains of edges.
        guidance: Guidance = Guidance {
            constrain_curvature: 0.005,
            curvature_weight: 0.07,
            ..Guidance::default()
        };
        /// The options of the field's solve.
        field: Options = by(Strategy::Adaptive);
        /// The options of the map's solve.
        map: Options = by(Strategy::Lattice);
        /// The options of smoothing; its features are added to those of the guidance. `None` leaves
        /// vertices where the map has them.
        smooth: Option<SmoothOptions> = Some(SmoothOptions::default());
        /// Planes about which the quads are symmetric. They are those of the part of the mesh on the side of all
        /// normals, with the cut as a feature, and its mirror images.
        mirror: Vec<Mirror> = Vec::new();
        /// Further strategies that solve both problems, for comparison.
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
