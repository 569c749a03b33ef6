//! Steps 6 and 7: edges with more than two triangles, and those that cannot be oriented, are cut open.
//!
//! Patches, which hang together over edges with two triangles, are oriented first, so that pairs at
//! crowded edges see the directions that triangles will have (`gueziec2001`, the stitching of borders
//! included). Then every vertex becomes as many as it has fans. Two pairs may still share both ends of their
//! edge, because their fans meet elsewhere: all but the first get a vertex in the middle of the edge,
//! which moves no surface and opens nothing.

use std::collections::{BTreeMap, BTreeSet};

use super::edges::Edges;
use super::edits::{EditKind, Edits};
use super::lists::NONE;
use super::orient::{orient, turn};
use super::pair::{join, pair_crowded, pair_simple};
use super::surface::{Surface, fans, flat, next, previous, tail, tip};
use crate::linalg::vector::{Vec3, add, scale};

/// Makes the surface an oriented manifold.
pub(super) fn cut(mut surface: Surface) -> Surface {
    loop {
        let edits = surface.edits.clone();
        let shape = surface.triangles.clone();
        let vertices = surface.positions.len();
        let sources = cut_once(&mut surface);
        let flat_ones = (0..surface.triangles.len()).filter(|&t| flat(surface.corners(t)));
        let spoilt: Vec<u32> = flat_ones.map(|t| sources[t]).collect();
        if spoilt.is_empty() {
            return surface;
        }
        // Half of a triangle that just has an area has none: the triangle goes.
        surface.positions.truncate(vertices);
        surface.origin.truncate(vertices);
        surface.before.truncate(shape.len());
        surface.polygon.truncate(shape.len());
        surface.triangles = shape;
        surface.edits = edits;
        let mut keep = vec![true; surface.triangles.len()];
        for t in spoilt {
            if std::mem::replace(&mut keep[t as usize], false) {
                let polygon = surface.polygon[t as usize];
                surface.edits.add(EditKind::SliverDropped, polygon, None);
            }
        }
        surface.retain(|t| keep[t]);
    }
}

/// One attempt. The result names the triangle of which each triangle is a part.
fn cut_once(surface: &mut Surface) -> Vec<u32> {
    let mut pairs = pair_simple(surface);
    if !pairs.crowded.is_empty() {
        let patches = orient(surface, &mut pairs.twin.clone());
        pair_crowded(surface, &mut pairs, &patches.turned);
    }
    let found = orient(surface, &mut pairs.twin);
    let mut edits = std::mem::take(&mut surface.edits);
    tell_turned(surface, &found.turned, &mut edits);
    for [lowest, count] in found.outwards {
        edits.add(
            EditKind::ComponentTurned,
            surface.polygon[lowest as usize],
            count,
        );
    }
    let ends = |h: u32| {
        let (a, b) = (tail(&surface.triangles, h), tip(&surface.triangles, h));
        [a.min(b), a.max(b)]
    };
    let crowded = pairs.crowded.iter().map(|halves| ends(halves[0]));
    let mut cuts: Vec<_> = found.cut.iter().map(|c| ends(c[0])).collect();
    cuts.extend(crowded);
    cuts.sort_unstable();
    cuts.dedup();
    for [a, b] in cuts {
        edits.add(EditKind::EdgeCut, a, b);
    }
    surface.edits = edits;
    rejoin(surface, &pairs.crowded, &mut pairs.twin, &found.turned);
    turn(&mut surface.triangles, &mut pairs.twin, &found.turned);
    for (t, before) in surface.before.iter_mut().enumerate() {
        if found.turned[t] {
            before.swap(1, 2);
        }
    }
    split_vertices(surface, &pairs.twin);
    match found.cut.is_empty() && pairs.crowded.is_empty() {
        true => (0..surface.triangles.len() as u32).collect(),
        false => halve_edges(surface, &pairs.twin),
    }
}

/// Half-edges of a crowded edge that lost their partners are paired if they run against each other.
fn rejoin(surface: &Surface, crowded: &[Vec<u32>], twin: &mut [u32], turned: &[bool]) {
    let up = |h: u32| {
        let up = tail(&surface.triangles, h) < tip(&surface.triangles, h);
        up != turned[h as usize / 3]
    };
    for halves in crowded {
        let open = |&h: &u32| twin[h as usize] == NONE;
        let open: Vec<u32> = halves.iter().copied().filter(open).collect();
        let (ups, downs): (Vec<u32>, Vec<u32>) = open.into_iter().partition(|&h| up(h));
        for (h, g) in ups.into_iter().zip(downs) {
            join(twin, h, g);
        }
    }
}

/// Tells every polygon of which a triangle was turned.
fn tell_turned(surface: &Surface, turned: &[bool], edits: &mut Edits) {
    let mut last = NONE;
    for (t, &polygon) in surface.polygon.iter().enumerate() {
        if turned[t] && polygon != last {
            edits.add(EditKind::PolygonTurned, polygon, None);
            last = polygon;
        }
    }
}

/// Gives every fan of triangles its own vertex; the first keeps the number.
fn split_vertices(surface: &mut Surface, twin: &[u32]) {
    let (fan, count) = fans(twin);
    let mut fans_at = vec![0u32; surface.positions.len()];
    let mut vertex_of = vec![NONE; count as usize];
    let corners = surface.triangles.as_flattened_mut();
    for (corner, &fan) in corners.iter_mut().zip(&fan) {
        let vertex = *corner;
        let new = &mut vertex_of[fan as usize];
        if *new == NONE {
            fans_at[vertex as usize] += 1;
            *new = vertex;
            if fans_at[vertex as usize] > 1 {
                *new = surface.positions.len() as u32;
                surface.positions.push(surface.positions[vertex as usize]);
                surface.origin.push(surface.origin[vertex as usize]);
            }
        }
        *corner = *new;
    }
    for (vertex, &count) in fans_at.iter().enumerate() {
        if count > 1 {
            let origin = surface.origin[vertex];
            surface.edits.add(EditKind::VertexSplit, origin, count);
        }
    }
}

/// Puts a vertex on edges between the same vertices as another one. The result names the triangle of which
/// each triangle is a part.
fn halve_edges(surface: &mut Surface, twin: &[u32]) -> Vec<u32> {
    let mut halved: Vec<u32> = Vec::new();
    Edges::of(surface.positions.len(), &surface.triangles).each(|halves| {
        let first = [halves[0], twin[halves[0] as usize]];
        let more = halves.iter().filter(|h| !first.contains(h));
        halved.extend(more.filter(|&&h| twin[h as usize] == NONE || h < twin[h as usize]));
    });
    let mut middle: BTreeMap<u32, u32> = BTreeMap::new();
    // Of two triangles with the same corners, one is split at its center: else both would be split along
    // the same edge.
    let mut at_center = BTreeSet::new();
    for h in halved {
        let ends = [tail(&surface.triangles, h), tip(&surface.triangles, h)];
        let [a, b] = ends.map(|v| surface.positions[v as usize]);
        let vertex = surface.positions.len() as u32;
        surface.positions.push(middle_of(a, b));
        surface.origin.push(NONE);
        middle.insert(h, vertex);
        if twin[h as usize] != NONE {
            middle.insert(twin[h as usize], vertex);
            let apex = |h: u32| tail(&surface.triangles, previous(h));
            if apex(h) == apex(twin[h as usize]) {
                at_center.insert(twin[h as usize] / 3);
            }
        }
        let [a, b] = ends.map(|v| surface.origin[v as usize]);
        surface.edits.add(EditKind::EdgeHalved, a.min(b), a.max(b));
    }
    let mut sources: Vec<u32> = (0..surface.triangles.len() as u32).collect();
    let mut at = middle.keys().map(|h| h / 3).collect::<Vec<_>>();
    at.dedup();
    for t in at {
        let triangle = surface.triangles[t as usize];
        let middle = [0, 1, 2].map(|k| middle.get(&(3 * t + k)).copied());
        let parts = if at_center.contains(&t) {
            let [a, b, c] = surface.corners(t as usize).map(|p| scale(p, 1.0 / 3.0));
            surface.positions.push(add(add(a, b), c));
            surface.origin.push(NONE);
            parts_at_center(triangle, middle, surface.positions.len() as u32 - 1)
        } else {
            parts(triangle, middle)
        };
        surface.triangles[t as usize] = parts[0];
        for &part in &parts[1..] {
            surface.push(part, part, surface.polygon[t as usize]);
            sources.push(t);
        }
    }
    sources
}

/// A point near the middle of an edge. On grids, vertices lie in the very middle of edges of others.
fn middle_of(a: Vec3, b: Vec3) -> Vec3 {
    add(scale(a, 0.53), scale(b, 0.47))
}

/// The parts of a triangle with vertices on one, two or three of its edges.
fn parts([a, b, c]: [u32; 3], middle: [Option<u32>; 3]) -> Vec<[u32; 3]> {
    match middle {
        [Some(x), Some(y), Some(z)] => vec![[a, x, z], [x, b, y], [z, y, c], [x, y, z]],
        [Some(x), Some(y), None] => vec![[a, x, c], [x, b, y], [x, y, c]],
        [Some(x), None, None] => vec![[a, x, c], [x, b, c]],
        [None, None, None] => vec![[a, b, c]],
        [x, y, z] => parts([b, c, a], [y, z, x]),
    }
}

/// The parts of a triangle between its center and its edges.
fn parts_at_center(corners: [u32; 3], middle: [Option<u32>; 3], center: u32) -> Vec<[u32; 3]> {
    let rim: Vec<u32> = (0..3)
        .flat_map(|k| [Some(corners[k]), middle[k]])
        .flatten()
        .collect();
    let next = |i: usize| rim[(i + 1) % rim.len()];
    (0..rim.len()).map(|i| [rim[i], next(i), center]).collect()
}

/// The half-edges at the boundary, each with the one after it along the boundary.
pub(super) fn boundary(triangles: &[[u32; 3]], twin: &[u32]) -> Vec<Vec<u32>> {
    let mut loops = Vec::new();
    let mut seen = vec![false; twin.len()];
    for first in 0..twin.len() as u32 {
        let mut rim = Vec::new();
        let mut h = first;
        while twin[h as usize] == NONE && !seen[h as usize] {
            seen[h as usize] = true;
            rim.push(h);
            h = next(h);
            while twin[h as usize] != NONE {
                h = next(twin[h as usize]);
            }
        }
        if !rim.is_empty() {
            debug_assert_eq!(tail(triangles, first), tip(triangles, rim[rim.len() - 1]));
            loops.push(rim);
        }
    }
    loops
}
