//! How good the quads of a whole run are: what decides whether a mesh is tried by other options, and which
//! of the results is kept.

use super::coverage::{LOST, lost};
use super::{QuadOptions, Quadrangulation};
use crate::error::Result;
use crate::extract::QuadMesh;
use crate::field::Guidance;
use crate::mesh::TriangleMesh;

/// The largest factor between the number of quads and what was asked for.
pub(super) const FACTOR: f64 = 2.0;

/// The part of the surface that may be lost where a mesh needs no refinement and folds were repaired.
const LOST_BY_REPAIRS: f64 = 0.03;

/// The thousandths of the surface that may be lost before quads that are no map's are better.
const GONE: u32 = 200;

/// Of good quads with more irregular vertices than so many times those of the first, others are tried.
const ROUGHER: f64 = 1.25;

/// How much of a surface quads may lose.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Losses {
    /// The mesh was fine enough and nothing was repaired: quads cut off what their size cuts off.
    Any,
    /// The mesh was fine enough, but folds of the map had to be repaired, and that may cut off more.
    Few,
    /// The mesh had to be refined, so that its details may be smaller than quads.
    Least,
}

impl Losses {
    /// What the first result for a mesh, and all others, may lose.
    pub(super) fn of(first: Option<&Quadrangulation>) -> Self {
        match first {
            Some(made) if made.refined.is_some() => Losses::Least,
            Some(made) if made.quads.repaired == 0 && made.quads.is_conforming() => Losses::Any,
            Some(_) => Losses::Few,
            None => Losses::Least,
        }
    }

    /// The largest part of the surface.
    pub(super) fn largest(self) -> f64 {
        match self {
            Losses::Any => 1.0,
            Losses::Few => LOST_BY_REPAIRS,
            Losses::Least => LOST,
        }
    }
}

/// The members are compared from first to last, and less is better.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub(super) struct Rank {
    has_none: bool,
    does_not_conform: bool,
    /// The number of quads is off by more than a factor of two although the mesh was fine enough for them.
    is_beyond: bool,
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
        is_beyond: true,
        lost: 1000,
        missed: usize::MAX,
        is_off: true,
        irregular: usize::MAX,
    };

    /// The rank of quads of a mesh. A point is lost if it is farther than `far` from them.
    pub(super) fn of_quads(
        mesh: &TriangleMesh,
        options: &QuadOptions,
        far: f64,
        quads: &QuadMesh,
        losses: Losses,
    ) -> Self {
        if quads.faces().next().is_none() {
            return Self::WORST;
        }
        let conforms = quads.is_conforming();
        let lost = match conforms && losses == Losses::Any {
            true => 0.0,
            false => lost(quads, mesh, far),
        };
        let edge = options.sizing.edge_length(mesh);
        let more = quads.quads.len() as f64 * edge * edge / mesh.surface_area();
        let is_off = !(1.0 / FACTOR..=FACTOR).contains(&more);
        Rank {
            has_none: false,
            does_not_conform: !conforms,
            is_beyond: is_off && losses == Losses::Few,
            lost: match lost <= losses.largest() {
                true => 0,
                false => (1000.0 * lost).round() as u32,
            },
            missed: 0,
            irregular: quads.figures().irregular,
            is_off,
        }
    }

    /// The rank of the result of a try.
    pub(super) fn of(
        mesh: &TriangleMesh,
        options: &QuadOptions,
        far: f64,
        made: &Result<Quadrangulation>,
        losses: Losses,
    ) -> Self {
        match made {
            Ok(made) => Rank {
                missed: match losses == Losses::Least && has_features(mesh, &options.guidance) {
                    true => made.missed_features.len(),
                    false => 0,
                },
                ..Self::of_quads(mesh, options, far, &made.quads, losses)
            },
            Err(_) => Self::WORST,
        }
    }

    /// Whether there are more irregular vertices than in the quads that were to be improved.
    pub(super) fn is_rougher_than(self, first: Rank) -> bool {
        self.irregular as f64 > ROUGHER * first.irregular as f64
    }

    /// Whether there are no quads, or they do not conform.
    pub(super) fn does_not_conform(self) -> bool {
        self.has_none || self.does_not_conform
    }

    /// Whether quads conform, but much of the surface is lost.
    pub(super) fn loses_much(self) -> bool {
        self.loses() && self.lost > GONE
    }

    /// Whether quads conform but lose some of the surface.
    pub(super) fn loses(self) -> bool {
        !self.does_not_conform() && self.lost > 0
    }

    /// Whether quads conform and lose some of the surface, but no more than others.
    pub(super) fn loses_no_more_than(self, other: Rank) -> bool {
        self.loses() && self.lost <= other.lost
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

#[cfg(test)]
mod tests {
    use super::super::pairs::Paired;
    use super::*;
    use crate::map::Sizing;
    use crate::mesh::shape::by_name;
    use crate::mesh::vector::scale;
    use crate::monitor::Monitor;

    /// The rank of ten quads on a small sphere in the middle of a sphere, where so many were asked for.
    fn of_small_quads(asked: usize, losses: Losses) -> Rank {
        let [mesh, small] = [500, 20].map(|triangles| by_name("sphere", triangles).unwrap());
        let options = QuadOptions {
            sizing: Sizing::Quads(asked),
            ..QuadOptions::default()
        };
        let paired = Paired::new(&small, &options, &Monitor::default);
        let mut quads = paired.unwrap().quads;
        quads.vertices.iter_mut().for_each(|p| *p = scale(*p, 0.1));
        assert!(quads.is_conforming() && quads.quads.len() == 10);
        Rank::of_quads(&mesh, &options, 0.1, &quads, losses)
    }

    #[test]
    fn what_quads_lose_counts_where_folds_were_repaired_or_the_mesh_was_refined() {
        assert!(of_small_quads(10, Losses::Any).is_good());
        for losses in [Losses::Few, Losses::Least] {
            let rank = of_small_quads(10, losses);
            assert!(rank.loses() && rank.loses_much() && !rank.is_good());
            assert!(rank.loses_no_more_than(rank) && rank < Rank::WORST);
        }
    }

    #[test]
    fn of_a_mesh_that_was_fine_enough_a_number_far_off_is_worse_than_a_loss() {
        let covers = |rank: Rank| Rank { lost: 0, ..rank };
        let near = of_small_quads(10, Losses::Few);
        assert!(near < covers(of_small_quads(100, Losses::Few)));
        let near = of_small_quads(10, Losses::Least);
        assert!(near > covers(of_small_quads(100, Losses::Least)));
    }
}
