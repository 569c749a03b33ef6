//! The distances that a propagation leaves, and the sources that they are measured from.

use super::place::Place;
use super::roots::Roots;
use super::source::{Source, SurfacePoint, is_in_triangle};
use super::wavefront::{Arrival, NONE, Wavefront};
use super::window::Window;
use crate::error::{Error, Result};
use crate::mesh::TriangleMesh;
use crate::monitor::{Monitor, watch_memory};

/// What [`geodesic_distance`] does beyond distances at vertices, and where it stops.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct GeodesicOptions {
    /// Distances above this are not looked for: they are infinite. At least 0; infinite by default.
    pub limit: f64,
    /// Whether distances, gradients and paths are wanted at points other than vertices. All windows are kept for
    /// that, which takes most of the memory. No by default.
    pub everywhere: bool,
}

impl Default for GeodesicOptions {
    fn default() -> Self {
        GeodesicOptions {
            limit: f64::INFINITY,
            everywhere: false,
        }
    }
}

/// The distance of every point of a surface from the nearest of some sources, along the surface.
///
/// Methods take the mesh that it was made for.
#[derive(Debug, Clone, PartialEq)]
pub struct GeodesicDistance {
    pub(super) distance: Vec<f64>,
    pub(super) arrival: Vec<Arrival>,
    pub(super) crossed: Option<Vec<Vec<Window>>>,
    pub(super) roots: Roots,
    /// The roots that are no vertices by the faces that hold them, in increasing order.
    pub(super) by_face: Vec<(usize, u32)>,
    pub(super) source: Vec<Option<usize>>,
    pub(super) limit: f64,
}

/// The exact distance along the surface from every vertex to the nearest source.
///
/// Windows are propagated over the edges (`mitchell1987`, `surazhsky2005`), in lists that cross one face at a time
/// (`qin2016`), and left out by the rules of `xin2009`; the sources may be polygonal (`bommes2007`). Distances are
/// those of the polyhedral surface, up to rounding; they do not depend on the order of sources.
///
/// # Errors
/// - [`Error::InvalidArgument`] without sources, for a limit that is negative or not a number, and with the number of
///   the source for a point outside of its face and for points of a polyline that lie on no common face;
/// - [`Error::IndexOutOfRange`] with the number of the source for a vertex, face or edge that does not exist;
/// - [`Error::NotFinite`] with the number of the source for barycentric coordinates that are not numbers;
/// - [`Error::OutOfMemory`], and [`Error::Cancelled`] and [`Error::TimeLimit`] as the monitor asks.
pub fn geodesic_distance(
    mesh: &TriangleMesh,
    sources: &[Source],
    options: &GeodesicOptions,
    monitor: &Monitor<'_>,
) -> Result<GeodesicDistance> {
    let GeodesicOptions { limit, everywhere } = *options;
    if limit.is_nan() || limit < 0.0 {
        return Err(Error::InvalidArgument {
            what: format!("the limit of distance is {limit}; it must be at least 0"),
            index: None,
        });
    }
    let _watch = monitor.watch();
    let _memory = watch_memory(mesh.face_count());
    let roots = Roots::new(mesh, sources)?;
    let mut front = Wavefront::new(mesh, &roots, everywhere)?;
    front.run(limit)?;
    let Wavefront {
        mut distance,
        arrival,
        crossed,
        ..
    } = front;
    for d in &mut distance {
        if *d > limit {
            *d = f64::INFINITY;
        }
    }
    let by_face = roots.by_face(mesh);
    let source = nearest_sources(mesh, &roots, &distance, &arrival);
    Ok(GeodesicDistance {
        distance,
        arrival,
        crossed,
        roots,
        by_face,
        source,
        limit,
    })
}

/// The source of every vertex: that of the root of the line that ends there, which is nearer than the vertex.
fn nearest_sources(
    mesh: &TriangleMesh,
    roots: &Roots,
    distance: &[f64],
    arrival: &[Arrival],
) -> Vec<Option<usize>> {
    let mut source = vec![None; distance.len()];
    for &(v, number) in &roots.vertices {
        source[v] = Some(number as usize);
    }
    let mut chain = Vec::new();
    for vertex in 0..distance.len() {
        let mut v = vertex;
        let found = loop {
            if distance[v].is_infinite() || arrival[v].root == NONE {
                break None;
            }
            if source[v].is_some() {
                break source[v];
            }
            chain.push(v);
            match roots.other(mesh, arrival[v].root) {
                Some(root) => break Some(root.source as usize),
                None => v = arrival[v].root as usize,
            }
        };
        chain.drain(..).for_each(|v| source[v] = found);
    }
    source
}

impl GeodesicDistance {
    /// The distance of every vertex; infinite beyond the limit, and where no source can be reached.
    pub fn vertices(&self) -> &[f64] {
        &self.distance
    }

    /// The number of the nearest source of every vertex, among the sources given; none where the distance is
    /// infinite. Of sources at the same distance, up to rounding, it is any.
    pub fn nearest_sources(&self) -> &[Option<usize>] {
        &self.source
    }

    /// The largest distance of a vertex that is not infinite, and the vertex.
    pub fn farthest(&self) -> (usize, f64) {
        let reached = self.distance.iter().copied().enumerate();
        let reached = reached.filter(|(_, d)| d.is_finite());
        reached.fold(
            (0, 0.0),
            |best, next| if next.1 > best.1 { next } else { best },
        )
    }

    /// Where a point lies, if it can be asked about.
    pub(super) fn place(&self, mesh: &TriangleMesh, point: &SurfacePoint) -> Result<Place> {
        if self.distance.len() != mesh.vertex_count() {
            return Err(Error::LengthMismatch {
                what: "the vertices of the mesh",
                expected: self.distance.len(),
                actual: mesh.vertex_count(),
            });
        }
        if point.face >= mesh.face_count() {
            return Err(Error::IndexOutOfRange {
                what: "the face of the point",
                position: 0,
                value: i64::try_from(point.face).unwrap_or(i64::MAX),
                len: mesh.face_count(),
            });
        }
        is_in_triangle(point.barycentric).map_err(|what| match what {
            None => Error::NotFinite {
                what: "barycentric coordinates",
                position: 0,
            },
            Some(what) => Error::InvalidArgument {
                what: format!("the point is outside of face {}: {what}", point.face),
                index: Some(point.face),
            },
        })?;
        let place = Place::of(mesh, point);
        match (place, &self.crossed) {
            (Place::Edge(..) | Place::Face(..), None) => Err(Error::InvalidArgument {
                what:
                    "the distance was computed for vertices alone: it needs the option 'everywhere'"
                        .into(),
                index: None,
            }),
            _ => Ok(place),
        }
    }
}
