//! Components of a mesh whose quads are not good, tried alone.
//!
//! One map for all components has quads of one size, and its integers are decided together, so that one
//! component that is hard takes what all need. Alone, each has a field and a map of its own, and other
//! options for it change no other component.

use std::time::Instant;

use super::by_component::{Components, join};
use super::part::Part;
use super::rank::Rank;
use super::tries::Tries;
use super::{QuadOptions, QuadSeconds, Quadrangulation};
use crate::extract::QuadMesh;
use crate::mesh::TriangleMesh;
use crate::monitor::{Monitor, allowed_threads, side_by_side};

/// The components that each thread may try before they are compared.
const AHEAD: usize = 4;

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
    let lost: Vec<usize> = order
        .iter()
        .copied()
        .filter(|&c| !apart.quads[c].is_conforming())
        .collect();
    apart.take(tries, &lost);
    let joined = join(apart.quads.clone());
    let is_refined = apart.made.refined.is_some();
    if !Rank::of_quads(mesh, options, tries.far, &joined, is_refined).is_good() {
        order.retain(|&c| apart.quads[c].is_conforming());
        apart.take(tries, &order);
    }
    apart.finish()
}

/// A component that was tried.
struct Taken {
    /// Its quads, if they are better.
    better: Option<(Part, Quadrangulation)>,
    /// The work.
    spent: u64,
    has_ended: bool,
    seconds: f64,
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
    /// Tries those of these components whose quads are not good, several at a time, and keeps what is better.
    ///
    /// Threads try components beyond those that have been compared. What spends more than the components before
    /// it have left is tried again with that.
    fn take<'m, M: Fn() -> Monitor<'m>>(&mut self, tries: &mut Tries<'_, M>, components: &[usize]) {
        let threads = allowed_threads();
        let ahead = if threads == 1 { 1 } else { AHEAD * threads };
        for window in components.chunks(ahead) {
            let (left, monitor, far) = (tries.left(), tries.monitor, tries.far);
            let this = &*self;
            let started = Instant::now();
            let taken = side_by_side(
                window.len(),
                monitor,
                |_| {},
                |k, monitor| Ok(this.tried(window[k], far, left, &monitor)),
            );
            let Ok(taken) = taken else {
                return;
            };
            let all: f64 = taken.iter().map(|taken| taken.seconds).sum();
            let scale = started.elapsed().as_secs_f64() / all.max(f64::MIN_POSITIVE);
            for (&c, mut taken) in window.iter().zip(taken) {
                if tries.has_ended() {
                    return;
                }
                let left = tries.left();
                if window[0] != c && taken.spent >= left {
                    taken = self.tried(c, far, left, monitor);
                }
                tries.count(taken.spent, taken.has_ended);
                if let Some((part, found)) = taken.better {
                    self.keep(c, &part, found, scale);
                }
            }
        }
    }

    /// Tries a component if its quads are not good, with this much work.
    fn tried<'m>(
        &self,
        c: usize,
        far: f64,
        work: u64,
        monitor: &impl Fn() -> Monitor<'m>,
    ) -> Taken {
        let started = Instant::now();
        let mut tries = Tries::with_work(far, monitor, work);
        let better = self.better(c, &mut tries);
        Taken {
            better,
            spent: work - tries.left(),
            has_ended: tries.has_ended(),
            seconds: started.elapsed().as_secs_f64(),
        }
    }

    /// Better quads of a component, if its quads are not good.
    fn better<'m, M: Fn() -> Monitor<'m>>(
        &self,
        c: usize,
        tries: &mut Tries<'_, M>,
    ) -> Option<(Part, Quadrangulation)> {
        let (mesh, is_refined) = (self.mesh, self.made.refined.is_some());
        let part = Part::new(mesh, self.faces[c].clone()).ok()?;
        let given = part.options(mesh, self.options);
        let rank = Rank::of_quads(&part.mesh, &given, tries.far, &self.quads[c], is_refined);
        if rank.is_good() || !tries.may_take(&part.mesh) {
            return None;
        }
        let first = tries.one(&part.mesh, &given)?;
        let found = tries.others(&part.mesh, &given, first);
        let found_rank = Rank::of(&part.mesh, &given, tries.far, &found, is_refined);
        let found = found.ok()?;
        (found_rank < rank).then_some((part, found))
    }

    /// Keeps the quads that a component has alone. Its seconds count by the factor `scale`.
    fn keep(&mut self, c: usize, part: &Part, found: Quadrangulation, scale: f64) {
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
        made.seconds = sum(made.seconds, found.seconds, scale);
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

/// The seconds `a`, and those of `b` by the factor `scale`.
fn sum(a: QuadSeconds, b: QuadSeconds, scale: f64) -> QuadSeconds {
    QuadSeconds {
        refine: a.refine + scale * b.refine,
        field: a.field + scale * b.field,
        map: a.map + scale * b.map,
        extract: a.extract + scale * b.extract,
        smooth: a.smooth + scale * b.smooth,
        compare: a.compare + scale * b.compare,
    }
}
