//! Which quads fill which patch, and which of their vertices lie on which arc.
//!
//! Subdivisions prescribe all quads but their places: each rectangle is a grid, and neighbours share the points of their
//! sides. Quads that were extracted are compared with that, half-edge by half-edge: from one that is known, all others
//! follow. Both are the same up to the numbers of their elements, or the quads are not those of the layout.

use std::collections::{HashMap, HashSet};

use super::found::QuadSurface;
use super::rectangles::{Rectangles, Side};
use crate::extract::{Origin, QuadMesh};
use crate::mesh::vector::{Vec3, norm, sub};

const NONE: u32 = u32::MAX;

/// Vertices of quads that are tried for a corner of a layout whose place in the quads is not known.
const CANDIDATES: usize = 8;

/// The elements of quads that belong to the elements of a layout.
#[derive(Debug, Default)]
pub(super) struct Correspondence {
    /// The vertices of quads along each curve, from its first end to its second.
    pub curves: Vec<Vec<u32>>,
    /// The polygon of the layout that each quad is in.
    pub patches: Vec<u32>,
}

/// The quads that subdivisions prescribe.
struct Prescribed {
    /// The points along each curve.
    curves: Vec<Vec<u32>>,
    /// The corners of each quad, counter-clockwise.
    quads: Vec<[u32; 4]>,
    /// The polygon that each is in.
    patches: Vec<u32>,
    /// The vertex of the surface at each point; none at those that curves do not end at.
    at: Vec<u32>,
}

/// Compares quads with what is prescribed; none if they differ. Their origins are vertices and faces of the surface of
/// the rectangles.
pub(super) fn correspondence(all: &Rectangles, made: &QuadMesh) -> Option<Correspondence> {
    let prescribed = Prescribed::new(all);
    if !made.others.is_empty() || made.quads.len() != prescribed.quads.len() {
        return None;
    }
    let surface = QuadSurface::new(made.vertices.clone(), made.quads.clone()).ok()?;
    let points = prescribed.at.len();
    let grid = QuadSurface::new(vec![[0.0; 3]; points], prescribed.quads.clone()).ok()?;
    if surface.half_edges() != grid.half_edges() || surface.positions().len() != points {
        return None;
    }
    let places = |point: usize| match prescribed.at[point] {
        NONE => None,
        v => Some(all.surface.position(v)),
    };
    let mut half_of = vec![NONE; grid.half_edges()];
    let mut is_used = vec![false; surface.half_edges()];
    // Anchors are irregular points of which the vertex is known; where a component has none, any point.
    let vertex_of = known(made);
    let known_vertex = |point: usize| vertex_of.get(&prescribed.at[point]).copied();
    let mut anchors: Vec<usize> = (0..points).filter(|&p| prescribed.at[p] != NONE).collect();
    anchors.sort_by_key(|&p| (known_vertex(p).is_none(), !grid.is_irregular(p)));
    for anchor in anchors {
        let start = grid.around(anchor).next()?;
        if half_of[start] != NONE {
            continue;
        }
        let near = match known_vertex(anchor) {
            Some(v) => vec![v],
            None => nearest(&surface, places(anchor)?),
        };
        let ways = near.iter().flat_map(|&v| surface.around(v as usize));
        let matched = ways.filter_map(|half| Match::new(&grid, &surface, start, half));
        let rated = matched.map(|one| (one.deviation(&grid, &surface, places), one));
        let Some((_, best)) = rated.min_by(|a, b| a.0.total_cmp(&b.0)) else {
            continue;
        };
        for (h, g) in best.pairs {
            if std::mem::replace(&mut is_used[g as usize], true) {
                return None;
            }
            half_of[h as usize] = g;
        }
    }
    if half_of.contains(&NONE) {
        return None;
    }
    let mut vertex = vec![NONE; points];
    for (h, &g) in half_of.iter().enumerate() {
        vertex[grid.from(h) as usize] = surface.from(g as usize);
    }
    let along = |points: &Vec<u32>| points.iter().map(|&p| vertex[p as usize]).collect();
    let mut patches = vec![NONE; made.quads.len()];
    for (q, &patch) in prescribed.patches.iter().enumerate() {
        patches[half_of[4 * q] as usize / 4] = patch;
    }
    Some(Correspondence {
        curves: prescribed.curves.iter().map(along).collect(),
        patches,
    })
}

/// The vertices of quads at vertices of the surface.
fn known(made: &QuadMesh) -> HashMap<u32, u32> {
    let origins = made.origins.iter().enumerate();
    let at = |(vertex, origin): (usize, &Origin)| match *origin {
        Origin::Vertex(v) => Some((v as u32, vertex as u32)),
        _ => None,
    };
    origins.filter_map(at).collect()
}

/// The vertices of quads that are nearest to a place.
fn nearest(surface: &QuadSurface, place: Vec3) -> Vec<u32> {
    let mut all: Vec<u32> = (0..surface.positions().len() as u32).collect();
    let off = |v: u32| norm(sub(surface.positions()[v as usize], place));
    all.sort_by(|&a, &b| off(a).total_cmp(&off(b)));
    all.truncate(CANDIDATES);
    all
}

/// A component of what is prescribed, laid over quads.
struct Match {
    /// Half-edges of both.
    pairs: Vec<(u32, u32)>,
}

impl Match {
    /// Lays the component of a half-edge over the quads, so that the half-edge lies on another; none where they differ.
    fn new(grid: &QuadSurface, surface: &QuadSurface, start: usize, onto: usize) -> Option<Self> {
        let mut onto_of = vec![NONE; grid.half_edges()];
        onto_of[start] = onto as u32;
        let mut pairs = vec![(start as u32, onto as u32)];
        let mut next = 0;
        while next < pairs.len() {
            let (h, g) = (pairs[next].0 as usize, pairs[next].1 as usize);
            next += 1;
            if grid.is_outside(h) != surface.is_outside(g) {
                return None;
            }
            let neighbours = [
                (grid.next(h), surface.next(g)),
                (grid.twin(h), surface.twin(g)),
            ];
            for (h, g) in neighbours {
                match onto_of[h] {
                    NONE => {
                        onto_of[h] = g as u32;
                        pairs.push((h as u32, g as u32));
                    }
                    other if other as usize == g => {}
                    _ => return None,
                }
            }
        }
        Some(Match { pairs })
    }

    /// The sum of the distances of vertices from the places of their points.
    fn deviation(
        &self,
        grid: &QuadSurface,
        surface: &QuadSurface,
        places: impl Fn(usize) -> Option<Vec3>,
    ) -> f64 {
        let off = |&(h, g): &(u32, u32)| {
            let place = places(grid.from(h as usize) as usize)?;
            let vertex = surface.positions()[surface.from(g as usize) as usize];
            Some(norm(sub(vertex, place)))
        };
        self.pairs.iter().filter_map(off).sum()
    }
}

impl Prescribed {
    fn new(all: &Rectangles) -> Self {
        let mut made = Prescribed {
            curves: Vec::with_capacity(all.curves.len()),
            quads: Vec::new(),
            patches: Vec::new(),
            at: Vec::new(),
        };
        let ends: HashSet<u32> = all
            .curves
            .iter()
            .flat_map(|curve| [curve.chain[0], curve.chain[curve.chain.len() - 1]])
            .collect();
        let mut point_at: HashMap<u32, u32> = HashMap::new();
        for curve in &all.curves {
            let mut points = vec![NONE; curve.edges as usize + 1];
            for (&v, &place) in curve.chain.iter().zip(&curve.places) {
                if ends.contains(&v) {
                    let point = point_at.entry(v).or_insert_with(|| made.point(v));
                    points[place as usize] = *point;
                }
            }
            for point in points.iter_mut().filter(|point| **point == NONE) {
                *point = made.point(NONE);
            }
            made.curves.push(points);
        }
        for rectangle in &all.rectangles {
            made.fill(rectangle.polygon, &rectangle.sides);
        }
        made
    }

    /// A new point at a vertex of the surface, or none.
    fn point(&mut self, at: u32) -> u32 {
        self.at.push(at);
        self.at.len() as u32 - 1
    }

    /// The points of a side in its direction.
    fn along(&self, side: &Side) -> Vec<u32> {
        let points = &self.curves[side.dart as usize / 2];
        let (start, end) = (side.start as usize, (side.start + side.edges) as usize);
        let last = points.len() - 1;
        match side.dart % 2 {
            0 => points[start..=end].to_vec(),
            _ => points[last - end..=last - start]
                .iter()
                .rev()
                .copied()
                .collect(),
        }
    }

    /// Adds the quads of a rectangle.
    fn fill(&mut self, polygon: u32, sides: &[Side; 4]) {
        let [bottom, right, mut top, mut left] = [0, 1, 2, 3].map(|k| self.along(&sides[k]));
        top.reverse();
        left.reverse();
        let (columns, rows) = (bottom.len() - 1, left.len() - 1);
        let mut below = bottom;
        for row in 1..=rows {
            let above: Vec<u32> = match row == rows {
                true => top.clone(),
                false => {
                    let inner = (1..columns).map(|_| self.point(NONE)).collect::<Vec<_>>();
                    [vec![left[row]], inner, vec![right[row]]].concat()
                }
            };
            for k in 0..columns {
                self.quads
                    .push([below[k], below[k + 1], above[k + 1], above[k]]);
                self.patches.push(polygon);
            }
            below = above;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::layout::base_layout::tests::cube;
    use crate::layout::{LayoutOptions, LayoutSizing, layout_quads};
    use crate::mesh::shape::by_name;
    use crate::monitor::Monitor;

    #[test]
    fn arcs_run_along_edges_of_quads_between_their_patches() {
        let mesh = by_name("sphere", 2_000).unwrap();
        let options = LayoutOptions {
            sizing: LayoutSizing::Quads(150),
            smooth: None,
            ..LayoutOptions::default()
        };
        let made = layout_quads(&mesh, &cube(), &options, Monitor::default).unwrap();
        assert!(made.is_as_prescribed);
        let edges = &made.subdivisions.arcs;
        for (number, polygon) in made.layout.polygons().iter().enumerate() {
            let along = |k: usize| {
                let [from, to] = [k, k + 1].map(|k| polygon[k] as usize);
                edges[made.layout.arc_between(from, to).unwrap()]
            };
            let is_inside = |&&patch: &&u32| patch as usize == number;
            let quads = made.quad_patches.iter().filter(is_inside).count();
            assert_eq!(quads, (along(0) * along(1)) as usize, "{number}");
        }
        let mut quads_at: HashMap<[u32; 2], Vec<u32>> = HashMap::new();
        for (quad, &patch) in made.quads.quads.iter().zip(&made.quad_patches) {
            for k in 0..4 {
                let [a, b] = [quad[k], quad[(k + 1) % 4]];
                quads_at
                    .entry([a.min(b), a.max(b)])
                    .or_default()
                    .push(patch);
            }
        }
        let is_border = |patches: &Vec<u32>| patches[0] != patches[1];
        quads_at.retain(|_, patches| is_border(patches));
        let borders: HashSet<[u32; 2]> = quads_at.into_keys().collect();
        let mut drawn = HashSet::new();
        for (number, arc) in made.arc_vertices.iter().enumerate() {
            assert_eq!(arc.len(), edges[number] as usize + 1);
            let course = &made.arcs[number];
            let ends = [
                (arc[0], course[0]),
                (arc[arc.len() - 1], course[course.len() - 1]),
            ];
            for (v, place) in ends {
                assert!(norm(sub(made.quads.vertices[v as usize], place)) < 1e-9);
            }
            let edges = arc
                .windows(2)
                .map(|ends| [ends[0].min(ends[1]), ends[0].max(ends[1])]);
            drawn.extend(edges);
        }
        assert_eq!(drawn, borders);
    }

    #[test]
    fn quads_of_other_connections_are_told() {
        let square = |quads: Vec<[u32; 4]>| {
            QuadSurface::new(
                vec![
                    [0.0, 0.0, 0.0],
                    [1.0, 0.0, 0.0],
                    [2.0, 0.0, 0.0],
                    [0.0, 1.0, 0.0],
                    [1.0, 1.0, 0.0],
                    [2.0, 1.0, 0.0],
                ],
                quads,
            )
            .unwrap()
        };
        let row = square(vec![[0, 1, 4, 3], [1, 2, 5, 4]]);
        let same = square(vec![[2, 5, 4, 1], [4, 3, 0, 1]]);
        let onto = |half: usize| Match::new(&row, &same, 1, half).map(|m| m.pairs.len());
        // The inner edge lies on itself both ways around.
        let fits: Vec<usize> = (0..8).filter(|&half| onto(half) == Some(14)).collect();
        assert_eq!(fits, [2, 7]);
    }
}
