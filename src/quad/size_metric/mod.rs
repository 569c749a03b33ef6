//! Sizes of quads that vary over the surface: by curvature, painted density, and distance.
//!
//! All of them multiply a length for every vertex. A square patch of edges h that follow the principal curvatures a
//! and b deviates from the surface, to first order, by |a + b| h^2 / 8 in its middle and by |a| h^2 / 8 at edges. So
//! lengths that grow with k^(-1/2), k the larger of |a + b| and |a|, make patches deviate equally far everywhere;
//! [`adapt`] is the share of that power that is taken. Then lengths are kept between the least and the largest, and
//! made to grow along the surface by no more than the gradation allows, by one pass of Dijkstra's algorithm over the
//! edges:
//!
//! ```text
//! h(y) <= h(x) + (gradation - 1) distance(x, y)
//! ```
//!
//! So the length one edge further on is at most `gradation` times as large. The scale of all lengths is found by
//! bisection, so that as many quads fit on the surface as were asked for.
//!
//! [`adapt`]: super::QuadOptions::adapt

use std::cmp::Reverse;
use std::collections::BinaryHeap;

use super::{Near, QuadOptions};
use crate::error::{Error, Result};
use crate::geodesic::{GeodesicOptions, Source, geodesic_distance};
use crate::map::Sizing;
use crate::mesh::TriangleMesh;
use crate::mesh::curvature::{SMOOTHING_ROUNDS, watched_curvature};
use crate::mesh::features::FeatureGraph;
use crate::mesh::vertex_values::check_positive;
use crate::monitor::{Monitor, may_continue};

/// Curvatures of less than this part of the mean count as this part: flat faces have no finite length.
const LEAST_CURVATURE: f64 = 0.1;

/// Curvatures of more than so many times the mean count as so many.
const MOST_CURVATURE: f64 = 30.0;

/// The default distance up to which sizes change, in edges of quads.
const NEAR_EDGES: f64 = 10.0;

/// The steps of the search for a scale: the number of quads is then right to more than 9 digits.
const STEPS: usize = 50;

/// The sizes of quads where they vary.
#[derive(Debug, Clone, PartialEq)]
pub struct SizeMetric {
    /// The length of edges that is aimed at for every vertex, in units of the mesh.
    pub lengths: Vec<f64>,
    /// The same as sizes for a map: graded lengths of faces, or, where the bounds of lengths allow no such number of
    /// quads or lengths were given, lengths.
    pub sizing: Sizing,
}

impl SizeMetric {
    /// The sizes that the options ask for; `None` if those are the same everywhere, or as given.
    ///
    /// # Errors
    /// [`Error::LengthMismatch`], [`Error::NotFinite`] and [`Error::InvalidArgument`] for densities, with the vertex;
    /// [`Error::InvalidArgument`] for a least length above the largest, and for distances from nothing;
    /// [`Error::IndexOutOfRange`] for vertices; those of sizes that no map can have.
    pub fn new(
        mesh: &TriangleMesh,
        options: &QuadOptions,
        features: &FeatureGraph,
        monitor: &Monitor,
    ) -> Result<Option<Self>> {
        Self::check(mesh, options)?;
        if !options.varies_sizes() {
            return Ok(None);
        }
        let edge = options.sizing.edge_length(mesh);
        let mut relative = match &options.sizing {
            Sizing::Lengths(pairs) => {
                let pairs = pairs.iter().map(|[along, across]| (along * across).sqrt());
                at_vertices(mesh, &pairs.collect::<Vec<_>>())
            }
            Sizing::Graded { lengths, .. } => at_vertices(mesh, lengths),
            _ => vec![1.0; mesh.vertex_count()],
        };
        if options.adapt > 0.0 {
            multiply(&mut relative, &by_curvature(mesh, options.adapt)?);
        }
        for (length, density) in relative.iter_mut().zip(&options.density) {
            *length /= density;
        }
        if options.near != Near::Nothing {
            multiply(
                &mut relative,
                &by_distance(mesh, options, features, edge, monitor)?,
            );
        }
        may_continue()?;
        let bounds = Bounds {
            least: options.min_length.unwrap_or(0.0),
            largest: options.max_length.unwrap_or(f64::INFINITY),
            growth: options.gradation - 1.0,
        };
        if let Sizing::Lengths(pairs) = &options.sizing {
            let lengths = bounds.applied(mesh, &relative, 1.0);
            let faces = at_faces(mesh, &lengths).into_iter().zip(pairs);
            let scaled = faces.map(|(length, pair)| {
                let factor = length / (pair[0] * pair[1]).sqrt();
                pair.map(|one| factor * one)
            });
            let sizing = Sizing::Lengths(scaled.collect());
            return Ok(Some(SizeMetric { lengths, sizing }));
        }
        let wanted = mesh.surface_area() / (edge * edge);
        let (lengths, is_met) = bounds.for_count(mesh, &relative, wanted)?;
        let faces = at_faces(mesh, &lengths);
        let sizing = match options.sizing.quads() {
            Some(quads) if is_met => Sizing::Graded {
                quads,
                lengths: faces,
            },
            _ => Sizing::Lengths(faces.into_iter().map(|length| [length; 2]).collect()),
        };
        Ok(Some(SizeMetric { lengths, sizing }))
    }

    /// The errors of [`new`](Self::new), as far as the mesh does not have to be looked at.
    pub(super) fn check(mesh: &TriangleMesh, options: &QuadOptions) -> Result<()> {
        if !options.density.is_empty() {
            check_positive(mesh, "densities of vertices", &options.density)?;
        }
        if let (Some(least), Some(largest)) = (options.min_length, options.max_length)
            && least > largest
        {
            return Err(Error::InvalidArgument {
                what: format!(
                    "the least length of edges, {least}, is above the largest, {largest}"
                ),
                index: None,
            });
        }
        for (position, &vertex) in options.near_vertices.iter().enumerate() {
            if vertex >= mesh.vertex_count() {
                return Err(Error::IndexOutOfRange {
                    what: "vertices that sizes change near",
                    position,
                    value: i64::try_from(vertex).unwrap_or(i64::MAX),
                    len: mesh.vertex_count(),
                });
            }
        }
        Ok(())
    }
}

impl QuadOptions {
    /// Whether anything changes sizes over the surface.
    fn varies_sizes(&self) -> bool {
        self.adapt > 0.0
            || !self.density.is_empty()
            || self.near != Near::Nothing
            || self.min_length.is_some()
            || self.max_length.is_some()
    }
}

/// What lengths have to keep to.
struct Bounds {
    least: f64,
    largest: f64,
    /// How much a length may grow over a distance.
    growth: f64,
}

impl Bounds {
    /// The lengths that keep to the bounds, from relative ones times a scale.
    fn applied(&self, mesh: &TriangleMesh, relative: &[f64], scale: f64) -> Vec<f64> {
        let bounded = relative
            .iter()
            .map(|r| (scale * r).max(self.least).min(self.largest));
        let mut lengths: Vec<f64> = bounded.collect();
        // Lengths are positive: their bits are in their order.
        let mut queue: BinaryHeap<_> = lengths
            .iter()
            .enumerate()
            .map(|(v, l)| Reverse((l.to_bits(), v)))
            .collect();
        while let Some(Reverse((bits, v))) = queue.pop() {
            if lengths[v].to_bits() != bits {
                continue;
            }
            for (face, k) in mesh.ring(v) {
                let corners = mesh.corners(face);
                for (other, side) in [((k + 1) % 3, k), ((k + 2) % 3, (k + 2) % 3)] {
                    let to = corners[other];
                    let most = lengths[v] + self.growth * mesh.edge_length(face, side);
                    if most < lengths[to] {
                        lengths[to] = most;
                        queue.push(Reverse((most.to_bits(), to)));
                    }
                }
            }
        }
        lengths
    }

    /// The lengths at the scale at which this many quads fit on the surface, and whether there is such a scale.
    fn for_count(
        &self,
        mesh: &TriangleMesh,
        relative: &[f64],
        wanted: f64,
    ) -> Result<(Vec<f64>, bool)> {
        let count = |lengths: &[f64]| -> f64 {
            let faces = at_faces(mesh, lengths).into_iter().enumerate();
            faces
                .map(|(face, length)| mesh.area(face) / (length * length))
                .sum()
        };
        let of = |scale: f64| self.applied(mesh, relative, scale);
        let edge = (mesh.surface_area() / wanted).sqrt();
        let mean = (relative.iter().map(|r| r.ln()).sum::<f64>() / relative.len() as f64).exp();
        let (mut low, mut high) = (1e-4 * edge / mean, 1e4 * edge / mean);
        for _ in 0..STEPS {
            may_continue()?;
            let middle = (low * high).sqrt();
            match count(&of(middle)) > wanted {
                true => low = middle,
                false => high = middle,
            }
        }
        let lengths = of(high);
        let is_met = (count(&lengths) / wanted - 1.0).abs() < 1e-3;
        Ok((lengths, is_met))
    }
}

/// The factor of lengths by curvature at every vertex.
fn by_curvature(mesh: &TriangleMesh, adapt: f64) -> Result<Vec<f64>> {
    let curvature = watched_curvature(mesh, SMOOTHING_ROUNDS)?;
    let principal = curvature.k1.iter().zip(&curvature.k2);
    let of_face: Vec<f64> = principal
        .map(|(k1, k2)| k1.abs().max((k1 + k2).abs()))
        .collect();
    let areas = (0..mesh.face_count()).map(|face| mesh.area(face));
    let mean = areas.zip(&of_face).map(|(area, k)| area * k).sum::<f64>() / mesh.surface_area();
    let factor = |k: f64| match mean > 0.0 {
        true => (k / mean)
            .clamp(LEAST_CURVATURE, MOST_CURVATURE)
            .powf(-0.5 * adapt),
        false => 1.0,
    };
    Ok(at_vertices(mesh, &of_face)
        .into_iter()
        .map(factor)
        .collect())
}

/// The factor of lengths by distance at every vertex.
fn by_distance(
    mesh: &TriangleMesh,
    options: &QuadOptions,
    features: &FeatureGraph,
    edge: f64,
    monitor: &Monitor,
) -> Result<Vec<f64>> {
    let sources = match options.near {
        Near::Nothing => Vec::new(),
        Near::Features => Source::features(features),
        Near::Boundary => Source::boundary(mesh),
        Near::Vertices => options
            .near_vertices
            .iter()
            .map(|&v| Source::Vertex(v))
            .collect(),
    };
    if sources.is_empty() {
        // Another component may have them.
        return Ok(vec![1.0; mesh.vertex_count()]);
    }
    let reach = options.near_distance.unwrap_or(NEAR_EDGES * edge);
    let limit = GeodesicOptions {
        limit: reach,
        ..GeodesicOptions::default()
    };
    let found = geodesic_distance(mesh, &sources, &limit, monitor)?;
    let factor = |distance: &f64| {
        let part = (distance / reach).min(1.0);
        options.near_size + part * (1.0 - options.near_size)
    };
    Ok(found.vertices().iter().map(factor).collect())
}

fn multiply(lengths: &mut [f64], factors: &[f64]) {
    for (length, factor) in lengths.iter_mut().zip(factors) {
        *length *= factor;
    }
}

/// The mean of the faces around every vertex, by area.
fn at_vertices(mesh: &TriangleMesh, of_face: &[f64]) -> Vec<f64> {
    let mean = |v: usize| {
        let (mut sum, mut total) = (0.0, 0.0);
        for (face, _) in mesh.ring(v) {
            sum += mesh.area(face) * of_face[face];
            total += mesh.area(face);
        }
        sum / total
    };
    (0..mesh.vertex_count()).map(mean).collect()
}

/// The mean of the corners of every face.
fn at_faces(mesh: &TriangleMesh, of_vertex: &[f64]) -> Vec<f64> {
    let mean = |face: usize| {
        mesh.corners(face)
            .iter()
            .map(|&v| of_vertex[v])
            .sum::<f64>()
            / 3.0
    };
    (0..mesh.face_count()).map(mean).collect()
}

#[cfg(test)]
mod tests;
