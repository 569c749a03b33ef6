//! The one ordering of all results on the way from a mesh to quads.
//!
//! The members are compared from first to last, and less is better. Each step fills in the members that
//! it knows: the relaxation of a map its distortion, a map its folds and winding defects, quads their remaining
//! faults. Only outcomes of one step are compared.
//!
//! Missed features count more than faults, because extraction repairs nearly all folds of a map, but
//! cannot restore a missed feature. But quads that are many more than were asked for, and miss features all the
//! same, are worse than those that miss more.

use crate::extract::QuadMesh;
use crate::untangle::Untangled;

/// The cost of each cone of a field, in the energy of a map of unit squares. A few more cones are worth
/// it if they make all quads more even; many are not.
const CONE_COST: f64 = 2.0;

/// The most quads for each that was asked for, unless they miss no feature.
const MOST: f64 = 1.5;

/// How far a result is from a good one.
#[derive(Debug, Clone, Copy, PartialEq, PartialOrd, Default)]
pub(super) struct Outcome {
    /// Whether quads have holes, or some faces are not quads.
    does_not_conform: bool,
    /// Whether quads that conform miss features although they are many more than were asked for.
    is_off: bool,
    /// Features that no edge of a quad follows.
    missed_features: usize,
    /// Folds and winding defects of a map, or the repairs that
    /// extraction made because of them.
    faults: usize,
    /// Vertices with other than four quads.
    irregular_vertices: usize,
    /// How far quads are from squares of one size.
    distortion: f64,
}

impl Outcome {
    /// The outcome of a field, from the relaxation of its map: its energy, scaled to the number of unit
    /// squares that all fields are compared at, and its number of cones.
    pub(super) fn of_relaxation(energy: f64, cones: usize) -> Self {
        Outcome {
            distortion: energy + CONE_COST * cones as f64,
            ..Outcome::default()
        }
    }

    /// The outcome of a map.
    pub(super) fn of_map(map: &Untangled) -> Self {
        Outcome {
            faults: map.faults(),
            ..Outcome::default()
        }
    }

    /// The outcome of quads of which so many were `asked` for, and that miss this many features.
    pub(super) fn of_quads(quads: &QuadMesh, asked: f64, missed_features: usize) -> Self {
        let conforms = quads.is_conforming();
        Outcome {
            does_not_conform: !conforms,
            is_off: conforms && missed_features > 0 && quads.quads.len() as f64 > MOST * asked,
            missed_features,
            faults: quads.repaired,
            irregular_vertices: quads.figures().irregular,
            ..Outcome::default()
        }
    }

    /// Whether quads conform.
    pub(super) fn conforms(&self) -> bool {
        !self.does_not_conform
    }

    /// Whether quads conform and miss no more features, if the others do, and need at most this many more repairs.
    pub(super) fn is_as_whole_as(&self, other: &Self, more: usize) -> bool {
        self.does_not_conform <= other.does_not_conform
            && self.missed_features <= other.missed_features
            && self.faults <= other.faults + more
    }

    /// Whether quads conform and miss no features: other faults of the map do not matter then.
    pub(super) fn is_whole(&self) -> bool {
        self.conforms() && self.missed_features == 0
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The members in the order of their comparison.
    fn of(members: [usize; 6]) -> Outcome {
        Outcome {
            does_not_conform: members[0] > 0,
            is_off: members[1] > 0,
            missed_features: members[2],
            faults: members[3],
            irregular_vertices: members[4],
            distortion: members[5] as f64,
        }
    }

    /// All combinations of zero and nonzero members; the nonzero values are larger for members that count
    /// less.
    fn all() -> impl Iterator<Item = [usize; 6]> {
        let member = |n: usize, k: usize| if n >> k & 1 == 1 { 1 + k } else { 0 };
        (0..64).map(move |n| [0, 1, 2, 3, 4, 5].map(|k| member(n, k)))
    }

    #[test]
    fn outcomes_are_ordered_by_the_first_member_that_differs() {
        for a in all() {
            for b in all() {
                assert_eq!(of(a).partial_cmp(&of(b)), Some(a.cmp(&b)), "{a:?} {b:?}");
            }
        }
    }

    #[test]
    fn many_more_quads_than_were_asked_for_have_to_follow_all_features() {
        let one = QuadMesh::from_quads(vec![[0.0; 3]; 4], vec![[0, 1, 2, 3]], 1);
        assert!(one.is_conforming());
        let of = |asked: f64, missed: usize| Outcome::of_quads(&one, asked, missed);
        assert!(of(1.0, 5) < of(0.5, 1) && of(1.0, 1) < of(1.0, 5));
        assert!(of(0.5, 0) < of(1.0, 1) && of(0.5, 0) == of(1.0, 0));
    }

    #[test]
    fn an_energy_that_is_no_number_is_never_better() {
        let [good, bad] = [1.0, f64::NAN].map(|energy| Outcome::of_relaxation(energy, 8));
        assert_eq!(bad.partial_cmp(&good), None);
    }
}
