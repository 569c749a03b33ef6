//! Components of a mesh whose quads are not good, tried alone.
//!
//! One map for all components has quads of one size, and its integers are decided together, so that one
//! component that is hard takes what all need. Alone, each has a field and a map of its own, and other
//! options for it change no other component.

use super::by_component::{Components, join};
use super::part::Part;
use super::rank::Rank;
use super::tries::Tries;
use super::{QuadOptions, QuadSeconds, Quadrangulation};
use crate::mesh::TriangleMesh;
use crate::monitor::Monitor;

/// Tries the components whose quads are not good, those of the fewest faces first, and keeps what is better.
pub(super) fn apart<'a, M: Fn() -> Monitor<'a>>(
    tries: &mut Tries<'_, M>,
    mesh: &TriangleMesh,
    options: &QuadOptions,
    components: &Components,
    mut made: Quadrangulation,
) -> Quadrangulation {
    let mut quads = components.split(mesh, &made.quads);
    let faces = components.faces();
    let mut order: Vec<usize> = (0..components.count).collect();
    order.sort_by_key(|&c| faces[c].len());
    let is_refined = made.refined.is_some();
    let mut replaced = Vec::new();
    for c in order {
        let Ok(part) = Part::new(mesh, faces[c].clone()) else {
            continue;
        };
        let given = part.options(mesh, options);
        let rank = Rank::of_quads(&part.mesh, &given, tries.far, &quads[c], is_refined);
        if rank.is_good() || !tries.may_take(&part.mesh) {
            continue;
        }
        let Some(first) = tries.one(&part.mesh, &given) else {
            break;
        };
        let found = tries.others(&part.mesh, &given, first);
        if Rank::of(&part.mesh, &given, tries.far, &found) < rank
            && let Ok(found) = found
        {
            made.seconds = sum(made.seconds, found.seconds);
            made.features
                .extend(part.edges_of_whole(mesh, &found.features));
            let is_elsewhere = |edge: &usize| components.of_face[mesh.edge(*edge).first.0] != c;
            made.missed_features.retain(is_elsewhere);
            let missed = part.edges_of_whole(mesh, &found.missed_features);
            made.missed_features.extend(missed);
            quads[c] = part.on_whole(found.quads);
            replaced.extend(&faces[c]);
        }
    }
    if !replaced.is_empty() {
        replaced.sort_unstable();
        made.quads = join(quads);
        made.features.sort_unstable();
        made.features.dedup();
        made.missed_features.sort_unstable();
        made.apart = replaced;
    }
    made
}

fn sum(a: QuadSeconds, b: QuadSeconds) -> QuadSeconds {
    QuadSeconds {
        refine: a.refine + b.refine,
        field: a.field + b.field,
        map: a.map + b.map,
        extract: a.extract + b.extract,
        smooth: a.smooth + b.smooth,
        compare: a.compare + b.compare,
    }
}
