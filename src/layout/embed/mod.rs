//! Embedding: the arcs of a layout are laid on the surface as shortest paths that do not cross.
//!
//! Arcs leave each node in the order in which the layout has them. The shortest arc that can be laid comes first, and
//! one that would divide the surface otherwise than the layout waits until others are there. Where that ends with an
//! arc that is blocked, a spanning tree is laid first (`praun2001`): it divides nothing, and on a sphere all other arcs
//! have their place after it. Arcs are then laid again, each in the two patches beside it, as long as that makes them
//! shorter.
//!
//! No arc is shorter than it would be alone. Where some are much longer, or one is blocked even so, all start again with
//! those earlier (`joslin1999`), and the layout with the least sum of lengths is kept.
//!
//! | step | file |
//! | --- | --- |
//! | a mesh that is cut along arcs | `surface` |
//! | vertices of the layout on the surface | `nodes` |
//! | a shortest path between two arcs that are laid | `path` |
//! | whether the surface is divided as the layout | `regions` |
//! | splits that no arc needs, taken back | `coarsen` |

mod coarsen;
mod nodes;
pub(in crate::layout) mod path;
mod regions;
pub(in crate::layout) mod surface;

use std::cmp::Reverse;
use std::collections::BinaryHeap;

use super::base_layout::{BaseLayout, Dart, reversed};
use super::drawn_layout::inner;
use crate::error::{Error, Result};
use crate::linalg::DisjointSets;
use crate::mesh::vector::{Vec3, norm, sub};
use crate::monitor::{may_continue, may_continue_at};
pub(in crate::layout) use nodes::{feet, is_turned_over, place_nodes};
pub(in crate::layout) use path::reached;
use path::{Guide, Path, Search, Sector, lay};
use regions::are_those_of;
use surface::{NONE, Surface};

/// How often all arcs are laid again.
const ROUNDS: usize = 2;

/// The part by which an arc must become shorter.
const GAIN: f64 = 1e-2;

/// How often all arcs are laid from the start.
const STARTS: usize = 4;

/// So many arcs are laid at most in starts that only make arcs shorter: those of fine layouts have little room to go
/// wrong.
const ARCS: usize = 4000;

/// An arc is in trouble when it is so many times as long as it would be alone.
const TROUBLED: f64 = 1.5;

/// What the length of an arc counts in the order of arcs, each time that it was in trouble.
const EARLIER: f64 = 0.25;

/// Splits are taken back where there are so many times more faces than when that was last done.
const GROWTH: usize = 2;

/// A layout on a surface.
#[derive(Debug, Clone)]
pub(in crate::layout) struct Embedding {
    pub surface: Surface,
    /// The vertex of each vertex of the layout.
    pub nodes: Vec<u32>,
    /// The vertices of each arc, from its first end to its second.
    pub chains: Vec<Vec<u32>>,
}

impl Embedding {
    /// Takes splits back that no arc needs.
    fn coarsen(&mut self) {
        let number = self.surface.coarsen(&self.nodes);
        self.nodes.iter_mut().for_each(|v| *v = number[*v as usize]);
        for chain in &mut self.chains {
            chain.iter_mut().for_each(|v| *v = number[*v as usize]);
            chain.retain(|&v| v != NONE);
        }
    }
}

/// Arcs that are given as chains of edges of the mesh: the arc, and the vertices from its first end to its second.
pub(in crate::layout) type Given = Vec<(usize, Vec<u32>)>;

/// Lays a layout on a mesh. `nodes` are vertices of `surface`; arcs with a course in `guides` go about that way.
///
/// # Errors
/// [`Error::InvalidArgument`] with an arc that cannot be laid.
pub(in crate::layout) fn embed(
    layout: &BaseLayout,
    surface: Surface,
    nodes: Vec<u32>,
    given: &Given,
    guides: &[(usize, Vec<Vec3>)],
) -> Result<Embedding> {
    let mut start = Laying::new(layout, surface, nodes);
    start.guide(guides);
    start.take_given(given)?;
    start.take_boundary()?;
    if !start.is_consistent() {
        return Err(Error::InvalidArgument {
            what: format!(
                "the layout does not fit the surface: components, boundaries or handles differ, or arcs that are given \
                 divide it otherwise (the Euler characteristic of the layout is {})",
                layout.euler_characteristic()
            ),
            index: None,
        });
    }
    let alone = start.lengths_alone();
    let mut best = start.laid();
    let mut blamed = to_blame(&best, &alone);
    for starts in 2..=STARTS {
        if blamed.is_empty() || (best.is_ok() && starts * layout.arc_count() > ARCS) {
            break;
        }
        blamed.iter().for_each(|&arc| start.urgency[arc] *= EARLIER);
        let next = start.laid();
        may_continue()?;
        blamed = to_blame(&next, &alone);
        let is_better = match (&next, &best) {
            (Ok(next), Ok(best)) => next.length() < best.length(),
            (Ok(_), Err(_)) => true,
            (Err(_), _) => false,
        };
        if is_better {
            best = next;
        }
    }
    let mut best = best?;
    best.embedding.coarsen();
    Ok(best.embedding)
}

/// The arcs to be laid earlier: those that are much longer than `alone`, or the one that could not be laid.
fn to_blame(found: &Result<Laying>, alone: &[f64]) -> Vec<usize> {
    match found {
        Ok(laid) => {
            let lengths = laid.lengths();
            let is_troubled = |&arc: &usize| lengths[arc] > TROUBLED * alone[arc];
            (0..lengths.len()).filter(is_troubled).collect()
        }
        Err(error) => error.index().into_iter().collect(),
    }
}

struct Laying<'a> {
    layout: &'a BaseLayout,
    is_given: Vec<bool>,
    guides: Vec<Option<Guide>>,
    /// What the length of each arc counts in the order of arcs.
    urgency: Vec<f64>,
    /// The number of faces when splits were last taken back.
    faces: usize,
    embedding: Embedding,
    search: Search,
}

impl Clone for Laying<'_> {
    fn clone(&self) -> Self {
        Laying {
            layout: self.layout,
            is_given: self.is_given.clone(),
            guides: self.guides.clone(),
            urgency: self.urgency.clone(),
            faces: self.faces,
            embedding: self.embedding.clone(),
            search: Search::default(),
        }
    }
}

/// An arc that waits to be laid: whether it closes a cycle of arcs, what its length counted when it was last looked at,
/// in the order of positive floating-point numbers, and its number.
type Waiting = Reverse<(bool, u64, usize)>;

impl<'a> Laying<'a> {
    fn new(layout: &'a BaseLayout, surface: Surface, nodes: Vec<u32>) -> Self {
        Laying {
            layout,
            is_given: vec![false; layout.arc_count()],
            guides: vec![None; layout.arc_count()],
            urgency: vec![1.0; layout.arc_count()],
            faces: surface.triangles.len(),
            embedding: Embedding {
                chains: vec![Vec::new(); layout.arc_count()],
                surface,
                nodes,
            },
            search: Search::default(),
        }
    }

    fn is_consistent(&self) -> bool {
        let Embedding {
            surface,
            nodes,
            chains,
        } = &self.embedding;
        are_those_of(self.layout, surface, nodes, chains)
    }

    /// The length of every arc that is laid.
    fn lengths(&self) -> Vec<f64> {
        let chains = self.embedding.chains.iter();
        chains
            .map(|chain| self.embedding.surface.chain_length(chain))
            .collect()
    }

    fn length(&self) -> f64 {
        self.lengths().iter().sum()
    }

    /// The length of every arc if it is the first to be laid.
    fn lengths_alone(&mut self) -> Vec<f64> {
        let mut lengths = self.lengths();
        for arc in 0..lengths.len() {
            if self.embedding.chains[arc].is_empty() {
                lengths[arc] = self.find(arc).map_or(f64::INFINITY, |path| path.length);
            }
        }
        lengths
    }

    /// All arcs laid from here.
    fn laid(&self) -> Result<Self> {
        let mut laid = self.clone();
        if laid.lay_all(false).is_err() {
            may_continue()?;
            laid = self.clone();
            laid.lay_all(true)?;
        }
        laid.shorten()?;
        Ok(laid)
    }

    /// Takes splits back where there are many.
    fn coarsen(&mut self) {
        if self.embedding.surface.triangles.len() > GROWTH * self.faces {
            self.embedding.coarsen();
            self.faces = self.embedding.surface.triangles.len();
        }
    }

    fn guide(&mut self, guides: &[(usize, Vec<Vec3>)]) {
        for (arc, points) in guides {
            let ends = self.layout.arcs()[*arc].map(|v| self.embedding.nodes[v as usize]);
            let [from, to] = ends.map(|v| self.embedding.surface.position(v));
            // Two ends alone say nothing of the way.
            if !inner(points).is_empty() {
                self.guides[*arc] = Guide::new([&[from], inner(points), &[to]].concat());
            }
        }
    }

    fn take(&mut self, arc: usize, chain: Vec<u32>) {
        for pair in chain.windows(2) {
            self.embedding
                .surface
                .take_edge(pair[0], pair[1], 2 * arc as Dart);
        }
        self.is_given[arc] = true;
        self.embedding.chains[arc] = chain;
    }

    fn take_given(&mut self, given: &Given) -> Result<()> {
        let mut owner = vec![None; self.embedding.surface.positions.len()];
        for (arc, chain) in given {
            for &v in &chain[1..chain.len() - 1] {
                let other = owner[v as usize].replace(*arc);
                let is_node = self.embedding.nodes.contains(&v);
                if other.is_some() || is_node {
                    let [a, b] = self.layout.arcs()[*arc];
                    return Err(Error::InvalidArgument {
                        what: match other {
                            Some(other) => format!(
                                "the curve given for arc {arc}, between vertices {a} and {b}, meets itself or that of arc {other}"
                            ),
                            None => format!(
                                "the curve given for arc {arc}, between vertices {a} and {b}, runs through another vertex"
                            ),
                        },
                        index: Some(*arc),
                    });
                }
            }
            self.take(*arc, chain.clone());
        }
        Ok(())
    }

    /// Arcs of the boundary run along the boundary of the surface.
    fn take_boundary(&mut self) -> Result<()> {
        for arc in 0..self.layout.arc_count() {
            if !self.layout.is_boundary_arc(arc) || self.is_given[arc] {
                continue;
            }
            // With the patch on the left, as the surface has its faces.
            let back = self.layout.polygon_left_of(2 * arc as Dart).is_none();
            let dart = 2 * arc as Dart + Dart::from(back);
            let [from, to] =
                [dart, reversed(dart)].map(|d| self.embedding.nodes[self.layout.tail(d) as usize]);
            let surface = &self.embedding.surface;
            let mut chain = vec![from];
            let mut at = from;
            while at != to && chain.len() <= surface.positions.len() {
                let half = surface.around(at).next().unwrap_or(0);
                at = surface.tip(half);
                chain.push(at);
                let is_other = at != to && self.embedding.nodes.contains(&at);
                if is_other || surface.twin[half as usize] != NONE || at == from {
                    return Err(self.blocked(arc, "the boundary between them runs through others"));
                }
            }
            if back {
                chain.reverse();
            }
            self.take(arc, chain);
        }
        let surface = &mut self.embedding.surface;
        for half in 0..surface.twin.len() as u32 {
            if surface.twin[half as usize] == NONE {
                let ends = [surface.tail(half), surface.tip(half)];
                ends.iter()
                    .for_each(|&v| surface.is_taken[v as usize] = true);
            }
        }
        Ok(())
    }

    fn sectors(&self, arc: usize) -> [Sector; 2] {
        [2 * arc, 2 * arc + 1].map(|dart| {
            let dart = dart as Dart;
            let v = self.layout.tail(dart) as usize;
            let around: Vec<Dart> = self.layout.around(v).collect();
            let is_closed = !self.layout.is_boundary_vertex(v);
            let node = self.embedding.nodes[v];
            Sector::new(&self.embedding.surface, node, &around, dart, is_closed)
        })
    }

    fn find(&mut self, arc: usize) -> Option<Path> {
        let [from, to] = self.sectors(arc);
        let guide = self.guides[arc].as_ref();
        self.search
            .shortest(&self.embedding.surface, &from, &to, guide)
    }

    /// Lays all arcs, the shortest first; if asked for, those that join nodes that are not joined yet before others.
    fn lay_all(&mut self, tree_first: bool) -> Result<()> {
        let mut joined = DisjointSets::new(self.layout.vertex_count());
        let ends = |layout: &BaseLayout, arc: usize| layout.arcs()[arc].map(|v| v as usize);
        let mut queue: BinaryHeap<Waiting> = BinaryHeap::new();
        for arc in 0..self.layout.arc_count() {
            let [a, b] = ends(self.layout, arc);
            if self.embedding.chains[arc].is_empty() {
                let nodes = [a, b].map(|v| self.embedding.nodes[v]);
                let [p, q] = nodes.map(|v| self.embedding.surface.position(v));
                let least = self.urgency[arc] * norm(sub(p, q));
                queue.push(Reverse((false, least.to_bits(), arc)));
            } else {
                joined.join(a, b);
            }
        }
        let mut deferred: Vec<Waiting> = Vec::new();
        let mut steps = 0;
        while let Some(Reverse((was_cycle, known, arc))) = queue.pop() {
            may_continue_at(steps)?;
            steps += 1;
            self.coarsen();
            let [a, b] = ends(self.layout, arc);
            let closes = joined.root(a) == joined.root(b);
            let is_cycle = tree_first && closes;
            let Some(path) = self.find(arc) else {
                return Err(self.enclosed(arc));
            };
            let counted = self.urgency[arc] * path.length;
            let now: Waiting = Reverse((is_cycle, counted.to_bits(), arc));
            if (is_cycle, counted) > (was_cycle, f64::from_bits(known) * (1.0 + 1e-12)) {
                queue.push(now);
                continue;
            }
            // What joins two parts divides nothing.
            let saved = closes.then(|| self.embedding.surface.clone());
            self.embedding.chains[arc] = lay(&mut self.embedding.surface, &path, 2 * arc as Dart);
            match saved {
                Some(saved) if !self.is_consistent() => {
                    self.embedding.surface = saved;
                    self.embedding.chains[arc].clear();
                    deferred.push(now);
                }
                _ => {
                    joined.join(a, b);
                    queue.extend(deferred.drain(..));
                }
            }
        }
        match deferred.first() {
            None => Ok(()),
            Some(&Reverse((_, _, arc))) => Err(self.blocked(
                arc,
                "every way that is left divides the surface otherwise than the layout; give its course as a curve",
            )),
        }
    }

    fn blocked(&self, arc: usize, why: &str) -> Error {
        let [a, b] = self.layout.arcs()[arc];
        Error::InvalidArgument {
            what: format!(
                "arc {arc} of the layout, between vertices {a} and {b}, cannot be laid: {why}"
            ),
            index: Some(arc),
        }
    }

    /// The error for an arc whose ends other arcs separate.
    fn enclosed(&self, arc: usize) -> Error {
        let [from, _] = self.sectors(arc);
        let surface = &self.embedding.surface;
        let faces = from.corners.first().map(|&corner| reached(surface, corner));
        let halves = faces.into_iter().flatten().flat_map(|f| 3 * f..3 * f + 3);
        let mut walls: Vec<u32> = halves
            .map(|half| surface.dart[half as usize])
            .filter(|&dart| dart != NONE)
            .map(|dart| dart / 2)
            .collect();
        walls.sort_unstable();
        walls.dedup();
        let names: Vec<String> = walls
            .iter()
            .take(8)
            .map(|&wall| {
                let [a, b] = self.layout.arcs()[wall as usize];
                format!("{a}-{b}")
            })
            .collect();
        self.blocked(
            arc,
            &format!("arcs between vertices {} separate them", names.join(", ")),
        )
    }

    /// Lays each arc again in the two patches beside it, where that makes it shorter.
    fn shorten(&mut self) -> Result<()> {
        for _ in 0..ROUNDS {
            let mut is_better = false;
            for arc in 0..self.layout.arc_count() {
                may_continue_at(arc)?;
                if self.is_given[arc] {
                    continue;
                }
                self.coarsen();
                let old = std::mem::take(&mut self.embedding.chains[arc]);
                let length = self.embedding.surface.chain_length(&old);
                self.embedding.surface.free_chain(&old);
                let dart = 2 * arc as Dart;
                let found = self.find(arc);
                let shorter = found.filter(|path| path.length < length * (1.0 - GAIN));
                self.embedding.chains[arc] = match shorter {
                    Some(path) => {
                        is_better = true;
                        lay(&mut self.embedding.surface, &path, dart)
                    }
                    None => {
                        let surface = &mut self.embedding.surface;
                        old.windows(2)
                            .for_each(|p| surface.take_edge(p[0], p[1], dart));
                        old
                    }
                };
            }
            if !is_better {
                break;
            }
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use std::f64::consts::TAU;

    use super::*;
    use crate::mesh::TriangleMesh;
    use crate::mesh::shape::by_name;
    use crate::test_random::Random;

    const COLUMNS: usize = 12;
    const ROWS: usize = 5;

    /// Patches around a torus, with vertices anywhere near it.
    fn around(torus: &TriangleMesh, random: &mut Random) -> BaseLayout {
        let [low, high] = torus.bounding_box();
        let small = 0.5 * (high[2] - low[2]);
        let great = high[0] - small;
        let mut off = || small * (random.below(2001) as f64 / 1000.0 - 1.0);
        let positions = (0..COLUMNS * ROWS).map(|v| {
            let (s, c) = (TAU * (v % COLUMNS) as f64 / COLUMNS as f64).sin_cos();
            let (z, r) = (TAU * (v / COLUMNS) as f64 / ROWS as f64).sin_cos();
            let out = great + small * r;
            [out * c + off(), out * s + off(), small * z + off()]
        });
        let at = |i: usize, j: usize| (j % ROWS * COLUMNS + i % COLUMNS) as u32;
        let polygons = (0..COLUMNS * ROWS).map(|p| {
            let (i, j) = (p % COLUMNS, p / COLUMNS);
            vec![at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)]
        });
        BaseLayout::new(positions.collect(), polygons.collect()).unwrap()
    }

    #[test]
    fn with_arcs_that_are_blamed_earlier_the_layout_becomes_shorter() {
        let torus = by_name("torus", 2_000).unwrap();
        let mut shorter = 0;
        for seed in 0..4 {
            let layout = around(&torus, &mut Random::new(seed));
            let mut surface = Surface::new(&torus);
            let known = vec![None; layout.vertex_count()];
            let nodes = place_nodes(&torus, &layout, &known, &mut surface).unwrap();
            let start = Laying::new(&layout, surface.clone(), nodes.clone());
            let mut once = start.laid().unwrap();
            once.embedding.coarsen();
            let all = embed(&layout, surface, nodes, &Vec::new(), &[]).unwrap();
            assert!(are_those_of(&layout, &all.surface, &all.nodes, &all.chains));
            let chains = all.chains.iter();
            let length: f64 = chains.map(|chain| all.surface.chain_length(chain)).sum();
            assert!(length <= once.length(), "{seed}");
            shorter += usize::from(length < 0.999 * once.length());
        }
        assert!(shorter > 0);
    }
}
