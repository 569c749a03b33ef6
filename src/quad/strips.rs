//! The strips of quads of a map, and targets that ask for one more of them.
//!
//! Between two neighbouring integer lines lies a strip. It runs straight on from quad to quad until it closes or
//! ends at the boundary. A second strip beside it changes no irregular vertex, and adds as many quads as the
//! first one has: these are the smallest steps that the integers allow. Where the target of the gradient across a
//! strip is twice as long, the relaxation of the surface beyond moves by about a whole line, and with it its integers,
//! unless others are nearly as good.

use std::ops::Range;

use super::aim::squares;
use crate::error::Result;
use crate::linalg::{DisjointSets, NO_PLACE};
use crate::map::SeamlessMap;
use crate::mesh::TriangleMesh;
use crate::monitor::{in_parts, joined, may_continue, may_continue_at};

/// A strip that covers less than this part of a face, or of whose width an edge takes less, is not seen there:
/// coordinates are rounded.
const SEEN: f64 = 1e-6;

/// The least number of faces that are worth a thread.
const LEAST: usize = 1 << 13;

/// The part of a strip in one face.
#[derive(Debug, Clone, Copy)]
struct Piece {
    face: u32,
    /// The coordinate across the strip: 0 for u, 1 for v.
    axis: u8,
    /// The strip lies between this integer and the next.
    level: i64,
    /// What part of the face it covers.
    share: f64,
}

impl Piece {
    fn face(&self) -> usize {
        self.face as usize
    }

    fn axis(&self) -> usize {
        usize::from(self.axis)
    }
}

/// All strips of a map.
pub(super) struct Strips {
    /// By face, axis and level.
    pieces: Vec<Piece>,
    /// The strip of every piece.
    strip_of: Vec<u32>,
    strips: Vec<Strip>,
}

#[derive(Debug, Clone, Copy, Default)]
struct Strip {
    /// The number of quads. One that the strip crosses itself counts twice.
    quads: f64,
    /// The number of those that it crosses itself.
    crossings: f64,
    /// On the surface.
    area: f64,
}

impl Strips {
    /// The strips of a map.
    ///
    /// # Errors
    /// The reason to end the current step.
    pub(super) fn new(mesh: &TriangleMesh, map: &SeamlessMap) -> Result<Self> {
        let pieces = pieces(mesh, map)?;
        let (strip_of, count) = strips_of(mesh, map, &pieces)?;
        let mut strips = vec![Strip::default(); count];
        for (number, (piece, &strip)) in pieces.iter().zip(&strip_of).enumerate() {
            may_continue_at(number)?;
            let strip = &mut strips[strip as usize];
            strip.quads += piece.share * squares(map.uv(piece.face())).abs();
            strip.area += piece.share * mesh.area(piece.face());
        }
        may_continue()?;
        count_crossings(map, &pieces, &strip_of, &mut strips);
        Ok(Strips {
            pieces,
            strip_of,
            strips,
        })
    }

    /// The strip that adds this number of quads within a tolerance if there are two of it. Of several it is the one of
    /// the largest quads.
    pub(super) fn of_quads(&self, wanted: f64, tolerance: f64) -> Option<usize> {
        let size = |strip: &Strip| strip.area / strip.quads;
        let fits = |strip: &Strip| (strip.quads + strip.crossings - wanted).abs() <= tolerance;
        let fitting = (0..self.strips.len()).filter(|&i| fits(&self.strips[i]));
        // The first of equals.
        fitting.reduce(
            |best, other| match size(&self.strips[other]) > size(&self.strips[best]) {
                true => other,
                false => best,
            },
        )
    }

    /// Changes the factors of both lengths of the map in every face to those with which the relaxation has a strip
    /// twice.
    pub(super) fn stretch(&self, strip: usize, factors: &mut [[f64; 2]]) {
        for (piece, &of) in self.pieces.iter().zip(&self.strip_of) {
            if of as usize == strip {
                factors[piece.face()][piece.axis()] *= 1.0 + piece.share;
            }
        }
    }
}

/// The part of a triangle in which a coordinate is below a level.
fn share_below(corners: [f64; 3], level: f64) -> f64 {
    let mut sorted = corners;
    sorted.sort_by(f64::total_cmp);
    let [low, middle, high] = sorted;
    if level <= low {
        0.0
    } else if level >= high {
        1.0
    } else if level < middle {
        (level - low) / (high - low) * ((level - low) / (middle - low))
    } else {
        1.0 - (high - level) / (high - low)
            * ((high - level) / (high - middle).max(f64::MIN_POSITIVE))
    }
}

fn pieces(mesh: &TriangleMesh, map: &SeamlessMap) -> Result<Vec<Piece>> {
    let of_faces = |faces: Range<usize>| -> Result<Vec<Piece>> {
        let mut pieces = Vec::with_capacity(2 * faces.len());
        for face in faces {
            may_continue_at(face)?;
            let uv = map.uv(face);
            for axis in 0..2 {
                pieces_across(face, axis, uv.map(|p| p[axis]), &mut pieces);
            }
        }
        Ok(pieces)
    };
    let parts = in_parts(mesh.face_count(), LEAST, of_faces);
    Ok(joined(parts.into_iter().collect::<Result<_>>()?))
}

/// The pieces of a face whose corners have these coordinates along an axis.
fn pieces_across(face: usize, axis: usize, corners: [f64; 3], pieces: &mut Vec<Piece>) {
    let low = corners.iter().copied().fold(f64::INFINITY, f64::min);
    let high = corners.iter().copied().fold(f64::NEG_INFINITY, f64::max);
    for level in (low.floor() as i64)..=(high.floor() as i64) {
        let [from, to] = [level, level + 1].map(|l| share_below(corners, l as f64));
        if to - from > SEEN {
            pieces.push(Piece {
                face: face as u32,
                axis: axis as u8,
                level,
                share: to - from,
            });
        }
    }
}

/// The strip of every piece, and the number of strips: pieces are joined over edges that their strip crosses.
fn strips_of(
    mesh: &TriangleMesh,
    map: &SeamlessMap,
    pieces: &[Piece],
) -> Result<(Vec<u32>, usize)> {
    let mut first_piece = vec![0u32; mesh.face_count() + 1];
    for piece in pieces {
        first_piece[piece.face() + 1] += 1;
    }
    for face in 0..mesh.face_count() {
        first_piece[face + 1] += first_piece[face];
    }
    let at = |face: usize, axis: usize, level: i64| {
        let [first, end] = [face, face + 1].map(|f| first_piece[f] as usize);
        let of = |piece: &Piece| (piece.axis(), piece.level);
        let found = pieces[first..end].binary_search_by_key(&(axis, level), of);
        found.ok().map(|place| first + place)
    };
    let mut transition_of = vec![NO_PLACE; mesh.edge_count()];
    for (number, transition) in map.transitions().iter().enumerate() {
        transition_of[transition.edge] = number as u32;
    }
    let mut sets = DisjointSets::new(pieces.len());
    for (number, piece) in pieces.iter().enumerate() {
        may_continue_at(number)?;
        let uv = map.uv(piece.face());
        for k in 0..3 {
            let (Some((across, _)), true) = (
                mesh.neighbor(piece.face(), k),
                mesh.is_first_side(piece.face(), k),
            ) else {
                continue;
            };
            let ends = [uv[k], uv[(k + 1) % 3]].map(|end| end[piece.axis()]);
            let level = piece.level as f64;
            let is_below = ends.iter().all(|&end| end < level + SEEN);
            let is_above = ends.iter().all(|&end| end > level + 1.0 - SEEN);
            if is_below || is_above {
                continue;
            }
            let (mut axis, mut there) = (piece.axis(), piece.level);
            let place = transition_of[mesh.edge_of(piece.face(), k)];
            if place != NO_PLACE {
                let transition = &map.transitions()[place as usize];
                let mut middle = [0.0; 2];
                middle[axis] = level + 0.5;
                let moved = transition.apply(middle);
                axis = (axis + usize::from(transition.quarters)) % 2;
                there = moved[axis].floor() as i64;
            }
            if let Some(other) = at(across, axis, there) {
                sets.join(number, other);
            }
        }
    }
    may_continue()?;
    // The root of a set is its first piece.
    let (mut strip_of, mut count) = (Vec::with_capacity(pieces.len()), 0);
    for number in 0..pieces.len() {
        let root = sets.root(number);
        if root == number {
            strip_of.push(count);
            count += 1;
        } else {
            strip_of.push(strip_of[root]);
        }
    }
    Ok((strip_of, count as usize))
}

/// Counts the quads in which strips cross themselves: those whose middle lies in a face.
fn count_crossings(map: &SeamlessMap, pieces: &[Piece], strip_of: &[u32], strips: &mut [Strip]) {
    let mut start = 0;
    for of_face in pieces.chunk_by(|a, b| a.face == b.face) {
        let own = &strip_of[start..start + of_face.len()];
        start += of_face.len();
        let uv = map.uv(of_face[0].face());
        let split = of_face.partition_point(|piece| piece.axis == 0);
        for (across, a) in of_face[..split].iter().zip(&own[..split]) {
            for (along, b) in of_face[split..].iter().zip(&own[split..]) {
                let middle = [across.level, along.level].map(|level| level as f64 + 0.5);
                if a == b && contains(uv, middle) {
                    strips[*a as usize].crossings += 1.0;
                }
            }
        }
    }
}

/// Whether a point lies in a triangle, whichever way its corners run.
fn contains(uv: [[f64; 2]; 3], p: [f64; 2]) -> bool {
    let side = |k: usize| {
        let (a, b) = (uv[k], uv[(k + 1) % 3]);
        (b[0] - a[0]) * (p[1] - a[1]) - (b[1] - a[1]) * (p[0] - a[0])
    };
    let sides = [0, 1, 2].map(side);
    sides.iter().all(|&s| s > 0.0) || sides.iter().all(|&s| s < 0.0)
}

#[cfg(test)]
mod tests {
    use std::collections::BTreeMap;

    use super::*;
    use crate::extract::{IntegerGridMap, QuadMesh, extract};
    use crate::field::smoothest_field;
    use crate::map::{SeamlessOptions, SeamlessProblem};
    use crate::mesh::shape::by_name;
    use crate::monitor::{Monitor, spawned, with_threads};
    use crate::quad::aim::area;
    use crate::search::Options;
    use crate::solve::Solver;

    struct Shape {
        mesh: TriangleMesh,
        problem: SeamlessProblem,
        solver: Solver,
    }

    impl Shape {
        fn new(name: &str, quads: usize) -> Self {
            Self::of_triangles(name, 2_000, quads)
        }

        fn of_triangles(name: &str, triangles: usize, quads: usize) -> Self {
            let mesh = by_name(name, triangles).unwrap();
            let (given, options) = (Default::default(), Options::default());
            let (field, _) = smoothest_field(&mesh, &given, &options, Monitor::default).unwrap();
            let problem = SeamlessProblem::new(&mesh, &field, &SeamlessOptions { quads }).unwrap();
            let solver = Solver::new(problem.problem()).unwrap();
            Shape {
                mesh,
                problem,
                solver,
            }
        }

        fn map(&mut self) -> SeamlessMap {
            let solution = self.solver.solve(&Options::default()).unwrap();
            self.problem.map(&self.mesh, &solution).unwrap()
        }
    }

    /// The numbers of quads of all strips of closed quads, in increasing order, from one edge to the opposite one.
    fn by_walking(quads: &QuadMesh) -> Vec<usize> {
        let mut at = BTreeMap::new();
        for (q, quad) in quads.quads.iter().enumerate() {
            for k in 0..4 {
                at.insert((quad[k], quad[(k + 1) % 4]), (q, k));
            }
        }
        let mut is_seen = vec![[false; 2]; quads.quads.len()];
        let mut lengths = Vec::new();
        for start in 0..quads.quads.len() {
            for axis in 0..2 {
                let (mut quad, mut side, mut length) = (start, axis, 0);
                while !std::mem::replace(&mut is_seen[quad][side % 2], true) {
                    length += 1;
                    let out = (side + 2) % 4;
                    let corners = quads.quads[quad];
                    (quad, side) = at[&(corners[(out + 1) % 4], corners[out])];
                }
                if length > 0 {
                    lengths.push(length);
                }
            }
        }
        lengths.sort_unstable();
        lengths
    }

    #[test]
    fn strips_are_those_of_the_quads() {
        for (name, quads) in [("torus", 500), ("rounded-cube", 300), ("genus-2", 900)] {
            let mut shape = Shape::new(name, quads);
            let map = shape.map();
            assert!(map.flipped().is_empty(), "{name}");
            let exact = IntegerGridMap::from_seamless(&shape.mesh, &map).unwrap();
            let made = extract(&shape.mesh, &exact, &mut Monitor::default()).unwrap();
            let strips = Strips::new(&shape.mesh, &map).unwrap().strips;
            let mut found: Vec<usize> = strips.iter().map(|s| s.quads.round() as usize).collect();
            found.sort_unstable();
            assert_eq!(found, by_walking(&made), "{name}");
            assert!(
                strips
                    .iter()
                    .all(|s| (s.quads - s.quads.round()).abs() < 1e-3)
            );
        }
    }

    #[test]
    fn any_number_of_threads_finds_the_same_strips() {
        let mut shape = Shape::of_triangles("torus", 2 * LEAST, 300);
        let map = shape.map();
        let of = |threads| with_threads(threads, || Strips::new(&shape.mesh, &map).unwrap());
        let one = of(1);
        let other = || {
            let two = of(2);
            assert_eq!(one.strip_of, two.strip_of);
            let sizes = |strips: &Strips| -> Vec<[u64; 3]> {
                let of = |s: &Strip| [s.quads, s.crossings, s.area].map(f64::to_bits);
                strips.strips.iter().map(of).collect()
            };
            assert_eq!(sizes(&one), sizes(&two));
        };
        assert!(spawned(other) > 0);
    }

    #[test]
    fn a_strip_that_there_is_twice_adds_its_quads() {
        for (name, quads) in [("torus", 500), ("rounded-cube", 300)] {
            let mut shape = Shape::new(name, quads);
            let first = shape.map();
            let strips = Strips::new(&shape.mesh, &first).unwrap();
            let shortest = |a: &usize, b: &usize| {
                let quads = |s: usize| strips.strips[s].quads;
                quads(*a).total_cmp(&quads(*b))
            };
            let strip = (0..strips.strips.len()).min_by(shortest).unwrap();
            let mut factors = vec![[1.0; 2]; shape.mesh.face_count()];
            strips.stretch(strip, &mut factors);
            let (mesh, solver) = (&shape.mesh, &mut shape.solver);
            shape.problem = shape.problem.stretched(mesh, &factors, solver).unwrap();
            let second = shape.map();
            let added = area(&shape.mesh, &second) - area(&shape.mesh, &first);
            let Strip {
                quads, crossings, ..
            } = strips.strips[strip];
            assert!((added - quads - crossings).abs() < 1e-3, "{name}: {added}");
            let found = strips.strips[strips.of_quads(added, 0.5).unwrap()];
            assert!((found.quads - quads).abs() < 1e-3, "{name}");
            assert!(found.area >= strips.strips[strip].area, "{name}");
        }
    }
}
