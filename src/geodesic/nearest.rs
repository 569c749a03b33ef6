//! The shortest line to a point of the surface: the nearest of all windows, roots and corners of its face.

use super::distance::GeodesicDistance;
use super::frame::Frame;
use super::place::Place;
use super::roots::{Point2, at, flat};
use super::source::SurfacePoint;
use super::wavefront::NONE;
use super::window::Window;
use crate::error::Result;
use crate::mesh::TriangleMesh;
use crate::mesh::vector::{Vec3, add, cross, normalize, scale, sub};

/// The last piece of a shortest path to a point.
#[derive(Debug, Clone, Copy)]
pub(super) struct Line {
    pub(super) distance: f64,
    pub(super) root: u32,
    /// The half-edge in whose plane the image is given: of the face of the point.
    pub(super) half: usize,
    /// The image of the root, as in a window.
    pub(super) image: Point2,
    /// The point in that plane.
    pub(super) point: Point2,
}

/// Lines miss a window by rounding: up to this share of their length.
const MISSED: f64 = 1e-11;

impl GeodesicDistance {
    /// The distance of a point of the surface; infinite beyond the limit, and where no source can be reached.
    ///
    /// # Errors
    /// For a point that is no vertex, [`Error::InvalidArgument`](crate::Error::InvalidArgument) without the option
    /// [`everywhere`](super::GeodesicOptions::everywhere). The errors of a [`Source`](super::Source) for a point
    /// that is not on the surface, and [`Error::LengthMismatch`](crate::Error::LengthMismatch) for another mesh.
    pub fn at(&self, mesh: &TriangleMesh, point: &SurfacePoint) -> Result<f64> {
        let place = self.place(mesh, point)?;
        if let Place::Vertex(v) = place {
            return Ok(self.distance[v]);
        }
        let line = self.line(mesh, place);
        Ok(line.map_or(f64::INFINITY, |line| line.distance))
    }

    /// The nearest source of a point of the surface; none where the distance is infinite.
    ///
    /// # Errors
    /// Those of [`at`](Self::at).
    pub fn nearest_source(
        &self,
        mesh: &TriangleMesh,
        point: &SurfacePoint,
    ) -> Result<Option<usize>> {
        let place = self.place(mesh, point)?;
        let line = self.line(mesh, place);
        Ok(line.and_then(|line| self.source_of(mesh, line.root)))
    }

    fn source_of(&self, mesh: &TriangleMesh, root: u32) -> Option<usize> {
        match self.roots.other(mesh, root) {
            Some(root) => Some(root.source as usize),
            None => self.source[root as usize],
        }
    }

    /// The gradient of the distance at a point, in space: the unit vector in the plane of a face in which the
    /// shortest path arrives there. It is null on the sources and where the distance is infinite.
    ///
    /// In a face's interior it lies in that face. On edges and at vertices it lies in the face of the path. Where
    /// several paths are shortest it is that of one.
    ///
    /// # Errors
    /// Those of [`at`](Self::at).
    pub fn gradient(&self, mesh: &TriangleMesh, point: &SurfacePoint) -> Result<Vec3> {
        let place = self.place(mesh, point)?;
        let Some(line) = self.line(mesh, place) else {
            return Ok([0.0; 3]);
        };
        if line.distance == 0.0 {
            return Ok([0.0; 3]);
        }
        let (face, k) = (line.half / 3, line.half % 3);
        let [u, v] = match self.roots.is_segment(mesh, line.root) {
            true => [line.image[0], -line.image[1]],
            false => [0, 1].map(|i| line.point[i] - line.image[i]),
        };
        let corners = mesh.corner_positions(face);
        let axis = normalize(sub(corners[(k + 1) % 3], corners[k]));
        let up = cross(mesh.normal(face), axis);
        Ok(normalize(add(scale(axis, u), scale(up, v))))
    }

    /// The last piece of a shortest path to a place; none where the distance is infinite.
    pub(super) fn line(&self, mesh: &TriangleMesh, place: Place) -> Option<Line> {
        if let Place::Vertex(v) = place {
            return self.line_to_vertex(mesh, v);
        }
        let lines = place.faces(mesh).into_iter();
        let lines = lines.flat_map(|(face, weights)| self.lines_in_face(mesh, face, weights));
        let nearer = |a: Line, b: Line| if b.distance < a.distance { b } else { a };
        lines.reduce(nearer).filter(|l| l.distance <= self.limit)
    }

    fn line_to_vertex(&self, mesh: &TriangleMesh, vertex: usize) -> Option<Line> {
        if self.distance[vertex].is_infinite() {
            return None;
        }
        let arrival = self.arrival[vertex];
        if arrival.half == NONE {
            // A source: the line has no length.
            let (face, k) = mesh.ring(vertex).next()?;
            return Some(Line {
                distance: 0.0,
                root: vertex as u32,
                half: 3 * face + k,
                image: [0.0; 2],
                point: [0.0; 2],
            });
        }
        let half = arrival.half as usize;
        Some(Line {
            distance: self.distance[vertex],
            root: arrival.root,
            half,
            image: [arrival.x, arrival.y],
            point: Frame::new(mesh, half / 3, half % 3).apex,
        })
    }

    /// The nearest line to a point of a face.
    fn lines_in_face(&self, mesh: &TriangleMesh, face: usize, weights: [f64; 3]) -> Option<Line> {
        let mut best: Option<Line> = None;
        let mut offer = |line: Line| {
            if best.is_none_or(|b| line.distance < b.distance) && line.distance.is_finite() {
                best = Some(line);
            }
        };
        let corners = flat(mesh, face);
        let point = at(corners, weights);
        for root in self.roots_in(face) {
            offer(self.line_from_root(face, corners, point, root, mesh));
        }
        for k in 0..3 {
            let vertex = mesh.corners(face)[k];
            let [u, v] = [0, 1].map(|i| point[i] - corners[k][i]);
            offer(Line {
                distance: self.distance[vertex] + (u * u + v * v).sqrt(),
                root: vertex as u32,
                half: 3 * face,
                image: corners[k],
                point,
            });
            let half = 3 * face + k;
            let frame = Frame::new(mesh, face, k);
            let placed = frame.place(weights, k);
            let windows = self.crossed.iter().flat_map(|crossed| &crossed[half]);
            for window in windows.filter(|w| reaches(w, placed)) {
                offer(Line {
                    distance: window.at_point(placed),
                    root: window.root,
                    half,
                    image: [window.x, window.y],
                    point: placed,
                });
            }
        }
        best
    }

    fn roots_in(&self, face: usize) -> impl Iterator<Item = u32> + '_ {
        let held = self.by_face.partition_point(|(f, _)| *f < face);
        let roots = self.by_face[held..].iter();
        roots.take_while(move |(f, _)| *f == face).map(|(_, r)| *r)
    }

    fn line_from_root(
        &self,
        face: usize,
        corners: [Point2; 3],
        point: Point2,
        number: u32,
        mesh: &TriangleMesh,
    ) -> Line {
        let never = Line {
            distance: f64::INFINITY,
            root: number,
            half: 3 * face,
            image: [0.0; 2],
            point,
        };
        let root = self.roots.other(mesh, number);
        let held = root.and_then(|r| Some((r, r.faces.iter().find(|f| f.0 == face)?)));
        let Some((root, &(_, one, two))) = held else {
            return never;
        };
        let [one, two] = [at(corners, one), at(corners, two)];
        let to = [point[0] - one[0], point[1] - one[1]];
        if !root.is_segment {
            let distance = (to[0] * to[0] + to[1] * to[1]).sqrt();
            return Line {
                distance,
                image: one,
                ..never
            };
        }
        let along = [two[0] - one[0], two[1] - one[1]];
        let size = (along[0] * along[0] + along[1] * along[1]).sqrt();
        let along = along.map(|x| x / size);
        let foot = to[0] * along[0] + to[1] * along[1];
        if !(0.0..=size).contains(&foot) {
            return never;
        }
        let above = along[0] * to[1] - along[1] * to[0];
        let normal = match above >= 0.0 {
            true => [-along[1], along[0]],
            false => [along[1], -along[0]],
        };
        Line {
            distance: above.abs(),
            image: [normal[0], -normal[1]],
            ..never
        }
    }
}

/// Whether the line from the root of a window to a point above its half-edge passes the window.
fn reaches(window: &Window, [x, y]: Point2) -> bool {
    let place = match window.is_line {
        true => x + window.x * (y / window.y),
        false => window.x + (x - window.x) * (window.y / (window.y - y)),
    };
    let missed = MISSED * (y + (x - window.x).abs() + window.b);
    window.a - missed <= place && place <= window.b + missed
}
