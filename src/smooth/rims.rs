//! Adds quads that are missing at the boundary.
//!
//! Where a map folds next to the boundary, its outermost lines leave the surface, and quads are left out. Their
//! other sides are a chain of edges from one vertex on the boundary to another one. What is between the chain and the
//! boundary gets one quad if it has four corners: those of the chain, those where curves of the boundary meet, and
//! one more on the boundary if they are odd in number. If it has more, every other corner is joined to a new vertex
//! inside. Smoothing moves all of them.

use std::collections::{BTreeMap, BTreeSet};

use super::quality::scaled_jacobian;
use super::surface::{Bond, Surface};
use crate::extract::{Origin, QuadMesh};
use crate::mesh::TriangleMesh;
use crate::mesh::features::FeatureGraph;
use crate::mesh::vector::{Vec3, add, norm, scale, sub};

/// The most vertices of a chain.
const LONGEST: usize = 12;

/// The most vertices between its ends on the boundary.
const MOST_STOPS: usize = 4;

/// The boundary between the ends of a chain is at most so many times as long as the chain.
const DETOUR: f64 = 2.0;

/// Adds the quads that are missing along the boundary.
pub(super) fn fill(
    quads: &mut QuadMesh,
    mesh: &TriangleMesh,
    features: &FeatureGraph,
    surface: &mut Surface,
) {
    let rims = Rims::new(mesh, features);
    if rims.after.is_empty() {
        return;
    }
    for chain in rims.chains(quads, surface) {
        let place = |v: u32| quads.vertices[v as usize];
        let lengths = chain
            .windows(2)
            .map(|e| norm(sub(place(e[1]), place(e[0]))));
        let most = DETOUR * lengths.sum::<f64>();
        let ends = [chain[0], chain[chain.len() - 1]];
        let [Some(from), Some(to)] = ends.map(|v| rims.spot(quads, surface, v as usize)) else {
            continue;
        };
        let way = rims.way(from, to, most);
        let Some(stops) = way.and_then(|way| way.stops(&rims, chain.len())) else {
            continue;
        };
        let mut corners: Vec<u32> = chain.iter().rev().copied().collect();
        let mut filling = Filling { quads, surface };
        corners.extend(stops.into_iter().map(|added| filling.add(added)));
        filling.fill(&corners);
    }
}

/// A place on the boundary: a vertex of the mesh, and how much of the edge after it lies before.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Spot {
    vertex: usize,
    part: f64,
}

/// What lies between two places on the boundary.
struct Way {
    length: f64,
    /// The vertices at which its edges start, and how far that is from its own start.
    steps: Vec<(Spot, f64)>,
    /// Those of them at which curves meet.
    nodes: Vec<(Spot, f64)>,
}

/// The boundary of a mesh.
struct Rims<'a> {
    mesh: &'a TriangleMesh,
    features: &'a FeatureGraph,
    /// The edge after each vertex, with its face on the left, and its other end.
    after: BTreeMap<usize, (usize, usize)>,
    /// The curve of each of these edges.
    curve: BTreeMap<usize, u32>,
    /// The vertices at which curves meet or end.
    nodes: BTreeSet<usize>,
}

impl<'a> Rims<'a> {
    fn new(mesh: &'a TriangleMesh, features: &'a FeatureGraph) -> Self {
        let mut after = BTreeMap::new();
        for (e, edge) in mesh.edges().enumerate() {
            if edge.second.is_none() {
                let (face, k) = edge.first;
                let corners = mesh.corners(face);
                after.insert(corners[k], (e, corners[(k + 1) % 3]));
            }
        }
        let mut curve = BTreeMap::new();
        for (number, of) in features.curves().iter().enumerate() {
            curve.extend(of.edges.iter().map(|&e| (e, number as u32)));
        }
        let nodes = features.corners().iter().chain(features.open_ends());
        Rims {
            mesh,
            features,
            after,
            curve,
            nodes: nodes.copied().collect(),
        }
    }

    /// The length of the edge after a vertex, and its other end.
    fn step(&self, vertex: usize) -> Option<(f64, usize)> {
        let &(_, to) = self.after.get(&vertex)?;
        let [a, b] = [vertex, to].map(|v| self.mesh.position(v));
        Some((norm(sub(b, a)), to))
    }

    /// Where a vertex of the quads lies on the boundary, if it does.
    fn spot(&self, quads: &QuadMesh, surface: &Surface, v: usize) -> Option<Spot> {
        if let Some(vertex) = surface.node[v] {
            let is_on = self.after.contains_key(&vertex);
            return is_on.then_some(Spot { vertex, part: 0.0 });
        }
        let Bond::Curve(curve) = surface.bonds[v] else {
            return None;
        };
        let (number, at) = surface.curves[curve as usize].closest(quads.vertices[v], None)?;
        let edge = self.features.curves()[curve as usize].edges[number];
        let mut ends = self.mesh.edge(edge).vertices.into_iter();
        let vertex = ends.find(|end| self.after.get(end).is_some_and(|&(e, _)| e == edge))?;
        let (length, _) = self.step(vertex)?;
        let part = norm(sub(at, self.mesh.position(vertex))) / length;
        Some(Spot {
            vertex,
            part: part.clamp(0.0, 1.0),
        })
    }

    /// The vertex to add at a place.
    fn added(&self, Spot { vertex, part }: Spot) -> Option<Added> {
        let at = self.mesh.position(vertex);
        if part == 0.0 && self.nodes.contains(&vertex) {
            return Some(Added {
                at,
                origin: Origin::Vertex(vertex),
                bond: Bond::Fixed,
                node: Some(vertex),
            });
        }
        let &(edge, to) = self.after.get(&vertex)?;
        let (face, k) = self.mesh.edge(edge).first;
        let mut weights = [0.0; 3];
        (weights[k], weights[(k + 1) % 3]) = (1.0 - part, part);
        Some(Added {
            at: add(at, scale(sub(self.mesh.position(to), at), part)),
            origin: Origin::Face(face, weights),
            bond: Bond::Curve(*self.curve.get(&edge)?),
            node: None,
        })
    }

    /// The chains of edges with one quad that lead from a vertex on the boundary to another one through vertices that
    /// are inside.
    fn chains(&self, quads: &QuadMesh, surface: &Surface) -> Vec<Vec<u32>> {
        let mut next: BTreeMap<u32, Vec<u32>> = BTreeMap::new();
        let mut edges = BTreeSet::new();
        for edge in quads.sides().chunk_by(|a, b| a.0 == b.0) {
            let ([low, high], forth) = edge[0];
            edges.insert([low, high]);
            if edge.len() == 1 {
                let [from, to] = if forth { [low, high] } else { [high, low] };
                next.entry(from).or_default().push(to);
            }
        }
        let is_on = |v: u32| self.spot(quads, surface, v as usize).is_some();
        let mut found = Vec::new();
        for (&first, after) in next.iter().filter(|(v, _)| is_on(**v)) {
            for &second in after.iter().filter(|&&v| !is_on(v)) {
                let mut chain = vec![first, second];
                let mut last = second;
                while chain.len() < LONGEST
                    && !is_on(last)
                    && let Some(&[after]) = next.get(&last).map(Vec::as_slice)
                {
                    chain.push(after);
                    last = after;
                }
                let is_joined = edges.contains(&[first.min(last), first.max(last)]);
                if is_on(last) && first != last && !is_joined {
                    found.push(chain);
                }
            }
        }
        found
    }

    /// The boundary from one place to another, with faces on the left, if it is at most so long.
    fn way(&self, from: Spot, to: Spot, most: f64) -> Option<Way> {
        let mut way = Way {
            length: 0.0,
            steps: vec![(from, 0.0)],
            nodes: Vec::new(),
        };
        let mut at = from;
        while at.vertex != to.vertex || at.part > to.part {
            let (length, next) = self.step(at.vertex)?;
            way.length += (1.0 - at.part) * length;
            at = Spot {
                vertex: next,
                part: 0.0,
            };
            if way.length > most {
                return None;
            }
            way.steps.push((at, way.length));
            if self.nodes.contains(&next) && at != to {
                way.nodes.push((at, way.length));
            }
        }
        way.length += (to.part - at.part) * self.step(at.vertex)?.0;
        (way.length <= most).then_some(way)
    }
}

impl Way {
    /// The vertices to add on the way, so that they and the corners of a chain are even in number: where curves meet,
    /// and the middle of the longest part if needed.
    fn stops(&self, rims: &Rims, corners: usize) -> Option<Vec<Added>> {
        let mut stops = self.nodes.clone();
        if (corners + stops.len()) % 2 == 1 {
            let arcs = stops.iter().map(|stop| stop.1);
            let arcs: Vec<f64> = std::iter::once(0.0)
                .chain(arcs)
                .chain([self.length])
                .collect();
            let length = |i: &usize| arcs[i + 1] - arcs[*i];
            let longest = (0..arcs.len() - 1).max_by(|a, b| length(a).total_cmp(&length(b)))?;
            let arc = 0.5 * (arcs[longest] + arcs[longest + 1]);
            let after = self.steps.partition_point(|step| step.1 <= arc);
            let (from, before) = self.steps[after - 1];
            let part = from.part + (arc - before) / rims.step(from.vertex)?.0;
            let middle = Spot {
                vertex: from.vertex,
                part: part.clamp(0.0, 1.0),
            };
            stops.insert(longest, (middle, arc));
        }
        if stops.len() > MOST_STOPS {
            return None;
        }
        stops.into_iter().map(|stop| rims.added(stop.0)).collect()
    }
}

/// A vertex that the quads do not have yet.
struct Added {
    at: Vec3,
    origin: Origin,
    bond: Bond,
    node: Option<usize>,
}

struct Filling<'a> {
    quads: &'a mut QuadMesh,
    surface: &'a mut Surface,
}

impl Filling<'_> {
    fn add(&mut self, added: Added) -> u32 {
        self.quads.vertices.push(added.at);
        self.quads.origins.push(added.origin);
        self.surface.add_vertex(added.at, added.bond, added.node);
        self.quads.vertices.len() as u32 - 1
    }

    /// Makes quads of a polygon with an even number of corners, at least four.
    fn fill(&mut self, corners: &[u32]) {
        if let &[a, b, c, d] = corners {
            self.quads.quads.push([a, b, c, d]);
            return;
        }
        let count = corners.len();
        let place = |&v: &u32| self.quads.vertices[v as usize];
        let sum = corners.iter().map(place).fold([0.0; 3], add);
        let middle = scale(sum, 1.0 / count as f64);
        let center = self.add(Added {
            at: middle,
            origin: Origin::Middle,
            bond: Bond::Surface,
            node: None,
        });
        if let Some(at) = self.surface.project(center as usize, middle) {
            self.quads.vertices[center as usize] = at;
        }
        let [even, odd] = [0, 1].map(|start| {
            let quad = |i: usize| [0, 1, 2].map(|k| corners[(start + 2 * i + k) % count]);
            let quads = (0..count / 2).map(|i| {
                let [a, b, c] = quad(i);
                [a, b, c, center]
            });
            quads.collect::<Vec<_>>()
        });
        let worst = |filled: &[[u32; 4]]| {
            let places = |quad: &[u32; 4]| quad.map(|v| self.quads.vertices[v as usize]);
            let jacobians = filled.iter().map(places).map(scaled_jacobian);
            jacobians.fold(f64::INFINITY, f64::min)
        };
        let better = if worst(&odd) > worst(&even) {
            odd
        } else {
            even
        };
        self.quads.quads.extend(better);
    }
}

#[cfg(test)]
mod tests {
    use crate::extract::QuadMesh;
    use crate::monitor::Monitor;
    use crate::smooth::reconnect::compact;
    use crate::smooth::tests::grid;
    use crate::smooth::{QuadQuality, Shapes, SmoothOptions, smooth_to};

    /// The grid without these quads, smoothed.
    fn filled(missing: &[usize]) -> QuadMesh {
        let (mut quads, mesh) = grid();
        let is_gone: Vec<bool> = (0..16).map(|quad| missing.contains(&quad)).collect();
        compact(&mut quads, &is_gone);
        let mut monitor = Monitor::default();
        smooth_to(
            &mut quads,
            &mesh,
            None,
            &SmoothOptions::default(),
            Shapes::default(),
            &mut monitor,
        )
        .unwrap();
        assert!(quads.is_conforming(), "{missing:?}");
        assert_eq!(quads.origins.len(), quads.vertices.len());
        let area = quads.quads.iter().map(|quad| {
            let [a, b, c, d] = quad.map(|v| quads.vertices[v as usize]);
            0.5 * ((c[0] - a[0]) * (d[1] - b[1]) - (c[1] - a[1]) * (d[0] - b[0]))
        });
        assert!((area.sum::<f64>() - 16.0).abs() < 1e-12, "{missing:?}");
        quads
    }

    #[test]
    fn a_quad_that_is_missing_at_a_side_or_in_a_corner_is_added() {
        let (grid, _) = grid();
        for missing in [1, 0, 15, 4, 7] {
            let found = filled(&[missing]);
            assert_eq!(found.quads.len(), 16);
            assert_eq!(found.figures(), grid.figures());
            assert!(QuadQuality::new(&found).scaled_jacobian_min > 0.99);
        }
    }

    #[test]
    fn where_more_are_missing_a_vertex_inside_joins_every_other_corner() {
        for missing in [[1, 2], [0, 4], [7, 11]] {
            let found = filled(&missing);
            assert!(found.quads.len() > 15);
            assert!(
                QuadQuality::new(&found).scaled_jacobian_min > 0.2,
                "{missing:?}"
            );
        }
    }
}
