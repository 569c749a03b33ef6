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
use crate::extract::QuadMesh;
use crate::mesh::TriangleMesh;
use crate::monitor::Monitor;

/// Tries the components whose quads do not conform, those of the fewest faces first, and then, if the surface
/// is not covered, those that do not cover theirs. What is better is kept.
pub(super) fn apart<'m, M: Fn() -> Monitor<'m>>(
    tries: &mut Tries<'_, M>,
    mesh: &TriangleMesh,
    options: &QuadOptions,
    components: &Components,
    made: Quadrangulation,
) -> Quadrangulation {
    let faces = components.faces();
    let mut order: Vec<usize> = (0..components.count).collect();
    order.sort_by_key(|&c| faces[c].len());
    let mut apart = Apart {
        mesh,
        options,
        components,
        faces,
        quads: components.split(mesh, &made.quads),
        replaced: Vec::new(),
        made,
    };
    for &c in &order {
        if !apart.quads[c].is_conforming() {
            apart.take(tries, c);
        }
    }
    let joined = join(apart.quads.clone());
    let is_refined = apart.made.refined.is_some();
    if !Rank::of_quads(mesh, options, tries.far, &joined, is_refined).is_good() {
        for &c in &order {
            if apart.quads[c].is_conforming() {
                apart.take(tries, c);
            }
        }
    }
    apart.finish()
}

/// The quads of all components so far.
struct Apart<'a> {
    mesh: &'a TriangleMesh,
    options: &'a QuadOptions,
    components: &'a Components,
    /// The faces of each component.
    faces: Vec<Vec<usize>>,
    /// The quads of each component.
    quads: Vec<QuadMesh>,
    /// The components whose quads are their own.
    replaced: Vec<usize>,
    made: Quadrangulation,
}

impl Apart<'_> {
    /// Tries a component if its quads are not good, and keeps what is better.
    fn take<'m, M: Fn() -> Monitor<'m>>(&mut self, tries: &mut Tries<'_, M>, c: usize) {
        let (mesh, is_refined) = (self.mesh, self.made.refined.is_some());
        let Ok(part) = Part::new(mesh, self.faces[c].clone()) else {
            return;
        };
        let given = part.options(mesh, self.options);
        let rank = Rank::of_quads(&part.mesh, &given, tries.far, &self.quads[c], is_refined);
        if rank.is_good() || !tries.may_take(&part.mesh) {
            return;
        }
        let Some(first) = tries.one(&part.mesh, &given) else {
            return;
        };
        let found = tries.others(&part.mesh, &given, first);
        let found_rank = Rank::of(&part.mesh, &given, tries.far, &found, is_refined);
        if let Ok(found) = found
            && found_rank < rank
        {
            self.keep(c, &part, found);
        }
    }

    /// Keeps the quads that a component has alone.
    fn keep(&mut self, c: usize, part: &Part, found: Quadrangulation) {
        let (mesh, of_face, made) = (self.mesh, &self.components.of_face, &mut self.made);
        let is_elsewhere = |edge: &usize| of_face[mesh.edge(*edge).first.0] != c;
        for (all, own) in [
            (&mut made.features, &found.features),
            (&mut made.missed_features, &found.missed_features),
        ] {
            all.retain(is_elsewhere);
            all.extend(part.edges_of_whole(mesh, own));
            all.sort_unstable();
        }
        made.seconds = sum(made.seconds, found.seconds);
        self.quads[c] = part.on_whole(found.quads);
        self.replaced.push(c);
    }

    /// All quads as one mesh.
    fn finish(mut self) -> Quadrangulation {
        if !self.replaced.is_empty() {
            let own = self.replaced.iter().flat_map(|&c| &self.faces[c]);
            self.made.apart = own.copied().collect();
            self.made.apart.sort_unstable();
            self.made.quads = join(self.quads);
        }
        self.made
    }
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
