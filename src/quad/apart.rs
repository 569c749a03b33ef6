//! Components of a mesh whose quads are not good, tried alone.
//!
//! One map for all components has quads of one size, and its integers are decided together, so that one
//! component that is hard takes what all need. Alone, each has a field and a map of its own, and other
//! options for it change no other component.

use std::time::Instant;

use super::by_component::{Components, join};
use super::pairs::Paired;
use super::part::Part;
use super::rank::{Losses, Rank};
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
        losses: Losses::of(Some(&made)),
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
    if !Rank::of_quads(mesh, options, tries.far, &joined, apart.losses).is_good() {
        order.retain(|&c| apart.quads[c].is_conforming());
        apart.take(tries, &order);
    }
    apart.finish()
}

/// A component that was tried.
struct Taken {
    /// Its quads, if they are better.
    better: Option<(Part, Better)>,
    /// The work.
    spent: u64,
    has_ended: bool,
    seconds: f64,
}

/// Better quads of a component.
struct Better {
    quads: QuadMesh,
    features: Vec<usize>,
    missed: Vec<usize>,
    seconds: QuadSeconds,
    /// Whether they are pairs of its triangles.
    is_paired: bool,
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
    /// How much of the surface they may lose.
    losses: Losses,
    /// The components whose quads are their own, and whether they are pairs of triangles.
    replaced: Vec<(usize, bool)>,
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
    ) -> Option<(Part, Better)> {
        let part = Part::new(self.mesh, self.faces[c].clone()).ok()?;
        let given = part.options(self.mesh, self.options);
        let mut rank = Rank::of_quads(&part.mesh, &given, tries.far, &self.quads[c], self.losses);
        if rank.is_good() {
            return None;
        }
        let mut better: Option<Better> = None;
        if tries.may_take(&part.mesh) {
            let first = tries.one(&part.mesh, &given)?;
            let found = tries.others(&part.mesh, &given, first);
            let found_rank = Rank::of(&part.mesh, &given, tries.far, &found, self.losses);
            if let Ok(found) = found
                && found_rank < rank
            {
                (better, rank) = (Some(Better::of(found)), found_rank);
            }
        }
        let quads = better
            .as_ref()
            .map_or(&self.quads[c], |better| &better.quads);
        if Paired::are_better(&part.mesh, &given, rank, quads)
            && !tries.has_ended()
            && let Some(paired) = Paired::new(&part.mesh, &given, tries.monitor)
        {
            better = Some(Better::of_pairs(paired));
        }
        Some((part, better?))
    }

    /// Keeps the quads that a component has alone. Its seconds count by the factor `scale`.
    fn keep(&mut self, c: usize, part: &Part, found: Better, scale: f64) {
        let (mesh, of_face, made) = (self.mesh, &self.components.of_face, &mut self.made);
        let is_elsewhere = |edge: &usize| of_face[mesh.edge(*edge).first.0] != c;
        for (all, own) in [
            (&mut made.features, &found.features),
            (&mut made.missed_features, &found.missed),
        ] {
            all.retain(is_elsewhere);
            all.extend(part.edges_of_whole(mesh, own));
            all.sort_unstable();
        }
        made.seconds = sum(made.seconds, found.seconds, scale);
        self.quads[c] = part.on_whole(found.quads);
        self.replaced.push((c, found.is_paired));
    }

    /// All quads as one mesh.
    fn finish(mut self) -> Quadrangulation {
        if !self.replaced.is_empty() {
            let faces_of = |is_wanted: &dyn Fn(bool) -> bool| {
                let own = self
                    .replaced
                    .iter()
                    .filter(|(_, paired)| is_wanted(*paired));
                let mut own: Vec<usize> = own.flat_map(|(c, _)| &self.faces[*c]).copied().collect();
                own.sort_unstable();
                own
            };
            self.made.apart = faces_of(&|_| true);
            self.made.paired = faces_of(&|is_paired| is_paired);
            self.made.quads = join(self.quads);
        }
        self.made
    }
}

impl Better {
    fn of(found: Quadrangulation) -> Self {
        Better {
            quads: found.quads,
            features: found.features,
            missed: found.missed_features,
            seconds: found.seconds,
            is_paired: false,
        }
    }

    fn of_pairs(paired: Paired) -> Self {
        Better {
            quads: paired.quads,
            features: paired.features,
            missed: paired.missed,
            seconds: QuadSeconds::default(),
            is_paired: true,
        }
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
