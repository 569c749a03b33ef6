//! How good the quads of a whole run are: what decides whether a mesh is tried by other options, and which
//! of the results is kept.

use super::coverage::{LOST, lost};
use super::{QuadOptions, Quadrangulation};
use crate::error::Result;
use crate::extract::QuadMesh;
use crate::field::Guidance;
use crate::mesh::TriangleMesh;

/// The largest factor between the number of quads and what was asked for.
const FACTOR: f64 = 2.0;

/// Of good quads with more irregular vertices than so many times those of the first, others are tried.
const ROUGHER: f64 = 1.25;

/// The members are compared from first to last, and less is better.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub(super) struct Rank {
    has_none: bool,
    does_not_conform: bool,
    /// Thousandths of the surface that are lost, where they are more than may be.
    lost: u32,
    /// Features of a mesh that had to be refined that the quads miss, if the caller asked for features.
    missed: usize,
    /// There are more than twice as many quads as were asked for, or less than half as many.
    is_off: bool,
    /// Vertices with other than four quads.
    irregular: usize,
}

impl Rank {
    /// The rank of a failure.
    pub(super) const WORST: Rank = Rank {
        has_none: true,
        does_not_conform: true,
        lost: 1000,
        missed: usize::MAX,
        is_off: true,
        irregular: usize::MAX,
    };

    /// The rank of quads of a mesh. A point is lost if it is farther than `far` from them; quads that conform
    /// are not asked for that unless they `may_lose` some.
    pub(super) fn of_quads(
        mesh: &TriangleMesh,
        options: &QuadOptions,
        far: f64,
        quads: &QuadMesh,
        may_lose: bool,
    ) -> Self {
        if quads.faces().next().is_none() {
            return Self::WORST;
        }
        let conforms = quads.is_conforming();
        // Quads of a mesh that is fine enough are as large as they were asked to be.
        let lost = match conforms && !may_lose {
            true => 0.0,
            false => lost(quads, mesh, far),
        };
        let edge = options.sizing.edge_length(mesh);
        let more = quads.quads.len() as f64 * edge * edge / mesh.surface_area();
        Rank {
            has_none: false,
            does_not_conform: !conforms,
            lost: match lost <= LOST {
                true => 0,
                false => (1000.0 * lost).round() as u32,
            },
            missed: 0,
            irregular: quads.figures().irregular,
            is_off: !(1.0 / FACTOR..=FACTOR).contains(&more),
        }
    }

    /// The rank of the result of a try.
    pub(super) fn of(
        mesh: &TriangleMesh,
        options: &QuadOptions,
        far: f64,
        made: &Result<Quadrangulation>,
        may_lose: bool,
    ) -> Self {
        match made {
            Ok(made) => Rank {
                missed: match may_lose && has_features(mesh, &options.guidance) {
                    true => made.missed_features.len(),
                    false => 0,
                },
                ..Self::of_quads(mesh, options, far, &made.quads, may_lose)
            },
            Err(_) => Self::WORST,
        }
    }

    /// The rank of the first result: quads lose nothing of a mesh that needs no refinement.
    pub(super) fn of_first(
        mesh: &TriangleMesh,
        options: &QuadOptions,
        far: f64,
        made: &Result<Quadrangulation>,
    ) -> Self {
        let may_lose = made.as_ref().is_ok_and(|made| made.refined.is_some());
        Self::of(mesh, options, far, made, may_lose)
    }

    /// Whether there are more irregular vertices than in the quads that were to be improved.
    pub(super) fn is_rougher_than(self, first: Rank) -> bool {
        self.irregular as f64 > ROUGHER * first.irregular as f64
    }

    /// Whether there are no quads, or they do not conform.
    pub(super) fn does_not_conform(self) -> bool {
        self.has_none || self.does_not_conform
    }

    /// Whether quads conform but lose some of the surface.
    pub(super) fn loses(self) -> bool {
        !self.does_not_conform() && self.lost > 0
    }

    /// Whether quads do not conform or lose some of the surface, so that more of them may help.
    pub(super) fn covers_too_little(self) -> bool {
        self.does_not_conform() || self.lost > 0
    }

    /// Whether quads conform, cover the surface and follow its features, so that nothing else is tried.
    pub(super) fn is_good(self) -> bool {
        !self.covers_too_little() && self.missed == 0
    }
}

/// Whether the caller says which edges are features; those of the boundary do not count.
pub(super) fn has_features(mesh: &TriangleMesh, guidance: &Guidance) -> bool {
    let is_inner = |&edge: &usize| mesh.edge(edge).second.is_some();
    guidance.feature_angle.is_some() || guidance.feature_edges.iter().any(is_inner)
}
