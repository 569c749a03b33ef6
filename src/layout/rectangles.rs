//! Patches as rectangles: what has other than four sides is divided by spokes from a vertex in its middle.
//!
//! Every arc and every spoke is a curve with a coordinate, 0 at its first end and the number of its edges at its
//! second, in proportion to length between points where spokes end. A side of a rectangle is a part of a curve.

use super::base_layout::{BaseLayout, Dart, reversed};
use super::embed::path::{Search, Sector, lay};
use super::embed::surface::{NONE, Surface};
use super::embed::{Embedding, reached};
use super::subdivide::Subdivisions;
use crate::error::{Error, Result};
use crate::mesh::vector::{Vec3, add, norm, scale, sub};

/// A vertex of a curve takes the place of a point that is nearer than this share of the edge there.
const SNAP: f64 = 0.1;

/// An arc or a spoke on the surface.
#[derive(Debug, Clone)]
pub(super) struct Curve {
    /// Its vertices.
    pub chain: Vec<u32>,
    /// The coordinate of each.
    pub places: Vec<f64>,
    /// The number of edges of quads along it.
    pub edges: u32,
}

impl Curve {
    /// A chain of edges, with coordinates in proportion to length.
    fn new(surface: &Surface, chain: Vec<u32>, edges: u32) -> Self {
        let per_length = f64::from(edges) / surface.chain_length(&chain);
        let mut places = vec![0.0; chain.len()];
        for k in 1..chain.len() {
            places[k] = places[k - 1] + per_length * surface.chain_length(&chain[k - 1..=k]);
        }
        if let Some(last) = places.last_mut() {
            *last = edges.into();
        }
        Curve {
            chain,
            places,
            edges,
        }
    }
}

/// A part of a curve, in the direction of a dart: `edges` of them, after the first `start`.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct Side {
    pub dart: Dart,
    pub start: u32,
    pub edges: u32,
}

/// A patch with four sides, counter-clockwise; opposite sides have as many edges.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct Rectangle {
    /// The polygon of the layout that it is, or is part of.
    pub polygon: u32,
    pub sides: [Side; 4],
}

/// A layout on a surface whose patches are rectangles.
#[derive(Debug, Clone)]
pub(super) struct Rectangles {
    pub surface: Surface,
    /// The arcs of the layout, then the spokes.
    pub curves: Vec<Curve>,
    pub rectangles: Vec<Rectangle>,
    /// The vertex in the middle of each polygon of other than four sides.
    pub centers: Vec<Option<u32>>,
}

impl Rectangles {
    /// Divides the patches of an embedding.
    ///
    /// # Errors
    /// [`Error::InvalidArgument`] with a patch in which a spoke cannot be laid.
    pub fn new(layout: &BaseLayout, embedding: Embedding, found: &Subdivisions) -> Result<Self> {
        let Embedding {
            surface, chains, ..
        } = embedding;
        let curves = chains.into_iter().zip(&found.arcs);
        let curves = curves.map(|(chain, &edges)| Curve::new(&surface, chain, edges));
        let mut all = Rectangles {
            curves: curves.collect(),
            surface,
            rectangles: Vec::new(),
            centers: vec![None; layout.polygons().len()],
        };
        for (p, sides) in layout.sides().iter().enumerate() {
            match found.spokes[p].as_slice() {
                [] => {
                    let whole = |k: usize| Side {
                        dart: sides[k],
                        start: 0,
                        edges: found.arcs[sides[k] as usize / 2],
                    };
                    all.rectangles.push(Rectangle {
                        polygon: p as u32,
                        sides: [whole(0), whole(1), whole(2), whole(3)],
                    });
                }
                spokes => all.divide(p, sides, spokes)?,
            }
        }
        all.surface.split_chords();
        Ok(all)
    }

    /// The coordinate along a dart for that along its curve.
    fn along(&self, dart: Dart, place: f64) -> f64 {
        match dart % 2 {
            0 => place,
            _ => f64::from(self.curves[dart as usize / 2].edges) - place,
        }
    }

    /// The vertices of a side, in its direction, and their coordinates along it, from 0 on.
    pub fn vertices(&self, side: &Side) -> Vec<(u32, f64)> {
        let curve = &self.curves[side.dart as usize / 2];
        let all = curve.chain.iter().zip(&curve.places);
        let placed =
            all.map(|(&v, &place)| (v, self.along(side.dart, place) - f64::from(side.start)));
        let is_inside = |&(_, place): &(u32, f64)| place >= 0.0 && place <= side.edges.into();
        let mut inside: Vec<(u32, f64)> = placed.filter(is_inside).collect();
        if side.dart % 2 == 1 {
            inside.reverse();
        }
        inside
    }

    /// The vertex with this coordinate along a dart, which is made where there is none: coordinates between the
    /// others around are in proportion to length on both sides of it.
    fn vertex_at(&mut self, dart: Dart, place: u32) -> u32 {
        let place = self.along(dart, place.into());
        let curve = &self.curves[dart as usize / 2];
        let after = curve.places.partition_point(|&other| other < place);
        if curve.places.get(after) == Some(&place) {
            return curve.chain[after];
        }
        let [a, b] = [after - 1, after].map(|k| (curve.chain[k], curve.places[k]));
        let share = (place - a.1) / (b.1 - a.1);
        let is_free =
            |at: usize| at > 0 && at + 1 < curve.chain.len() && curve.places[at].fract() != 0.0;
        let near = [(after - 1, share), (after, 1.0 - share)];
        let near = near
            .into_iter()
            .find(|&(at, off)| off < SNAP && is_free(at));
        let [p, q] = [a.0, b.0].map(|v| self.surface.position(v));
        let half = self.surface.half_between(a.0, b.0);
        let at = match (near, half) {
            (Some((at, _)), _) => at,
            (None, Some(half)) => {
                let at_point = add(p, scale(sub(q, p), share));
                let v = self.surface.split_edge(half, at_point);
                self.surface.is_taken[v as usize] = true;
                let curve = &mut self.curves[dart as usize / 2];
                curve.chain.insert(after, v);
                curve.places.insert(after, place);
                after
            }
            (None, None) => after,
        };
        let curve = &mut self.curves[dart as usize / 2];
        curve.places[at] = place;
        curve.chain[at]
    }

    /// Divides a patch by spokes.
    fn divide(&mut self, polygon: usize, sides: &[Dart], spokes: &[u32]) -> Result<()> {
        let n = sides.len();
        let ends: Vec<u32> = (0..n)
            .map(|i| self.vertex_at(sides[i], spokes[(i + n - 1) % n]))
            .collect();
        let center = self.center(sides, &ends);
        self.centers[polygon] = Some(center);
        self.surface.is_taken[center as usize] = true;
        let first = self.curves.len() as u32;
        let own: Vec<Dart> = (0..n as u32).map(|i| 2 * (first + i)).collect();
        let mut search = Search::default();
        for i in 0..n {
            let from = Sector::new(&self.surface, center, &own, own[i], true);
            let fan: Vec<u32> = self.surface.around(ends[i]).collect();
            let start = fan
                .iter()
                .position(|&half| self.surface.dart[half as usize] == sides[i]);
            let turned = (0..fan.len()).map(|k| fan[(start.unwrap_or(0) + k) % fan.len()]);
            let surface = &self.surface;
            let inside = turned
                .enumerate()
                .take_while(|&(k, half)| k == 0 || surface.dart[half as usize] == NONE);
            let to = Sector {
                node: ends[i],
                corners: inside.map(|(_, half)| half).collect(),
            };
            let path = search.shortest(&self.surface, &from, &to, None);
            let path = path.ok_or_else(|| Error::InvalidArgument {
                what: format!(
                    "patch {polygon} of the layout has no room for the spoke to its side {i}"
                ),
                index: Some(polygon),
            })?;
            let chain = lay(&mut self.surface, &path, own[i]);
            self.curves
                .push(Curve::new(&self.surface, chain, spokes[i]));
        }
        for i in 0..n {
            let before = (i + n - 1) % n;
            let part = |side: usize, start: u32, edges: u32| Side {
                dart: sides[side],
                start,
                edges,
            };
            let spoke = |dart: Dart, edges: u32| Side {
                dart,
                start: 0,
                edges,
            };
            // Side i - 1 ends with a part as long as spoke i.
            let last = spokes[(before + n - 1) % n];
            self.rectangles.push(Rectangle {
                polygon: polygon as u32,
                sides: [
                    part(i, 0, spokes[before]),
                    spoke(reversed(own[i]), spokes[i]),
                    spoke(own[before], spokes[before]),
                    part(before, last, spokes[i]),
                ],
            });
        }
        Ok(())
    }

    /// The free vertex of a patch that is nearest to the middle of the ends of its spokes. It is made where there is
    /// none.
    fn center(&mut self, sides: &[Dart], ends: &[u32]) -> u32 {
        self.surface.split_chords();
        let middle: Vec3 = ends
            .iter()
            .map(|&v| self.surface.position(v))
            .fold([0.0; 3], add);
        let middle = scale(middle, 1.0 / ends.len() as f64);
        let surface = &self.surface;
        let leaving = surface.around(ends[0]);
        let corner = leaving
            .into_iter()
            .find(|&half| surface.dart[half as usize] == sides[0]);
        let faces = reached(surface, corner.unwrap_or(0));
        let off = |p: Vec3| norm(sub(p, middle));
        let inner = faces.iter().flat_map(|&f| surface.triangles[f as usize]);
        let free = inner.filter(|&v| !surface.is_taken[v as usize]);
        let nearest = free.min_by(|&a, &b| {
            let by_distance = off(surface.position(a)).total_cmp(&off(surface.position(b)));
            by_distance.then(a.cmp(&b))
        });
        nearest.unwrap_or_else(|| {
            let face = faces[0];
            let corners = self.surface.corners(face).map(|p| scale(p, 1.0 / 3.0));
            self.surface
                .split_face(face, corners.into_iter().fold([0.0; 3], add))
        })
    }
}
