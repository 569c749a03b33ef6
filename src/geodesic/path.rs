//! The shortest path from a point back to the sources.
//!
//! Between two roots it is straight in the unfolded faces. So it is followed from face to face towards the image of
//! the root, which moves with the plane of each face, until a face holds the root.

use super::distance::GeodesicDistance;
use super::frame::{Frame, moved};
use super::nearest::Line;
use super::place::Place;
use super::roots::{Point2, at};
use super::source::SurfacePoint;
use super::window::Window;
use crate::error::Result;
use crate::mesh::TriangleMesh;

/// A root in the current face is the end of the line if it is no farther away than what is left of the line, up to
/// this share.
const AT_ROOT: f64 = 1e-9;

/// A straight line on its way to its root.
struct Walk<'a> {
    mesh: &'a TriangleMesh,
    root: u32,
    /// The half-edge that the line is to cross next, out of its face.
    half: usize,
    /// The image of the root in the plane of that half-edge.
    image: Window,
    /// Where the line is, in that plane.
    point: Point2,
    /// What is left of its length.
    rest: f64,
}

impl GeodesicDistance {
    /// A shortest path from a point to the nearest source, as a polyline whose points that follow each other lie on
    /// a common face. It starts at the point and ends on the source, and is empty where the distance is infinite.
    ///
    /// # Errors
    /// Those of [`at`](Self::at).
    pub fn path(&self, mesh: &TriangleMesh, from: &SurfacePoint) -> Result<Vec<SurfacePoint>> {
        let mut place = self.place(mesh, from)?;
        let mut path = Vec::new();
        while let Some(line) = self.line(mesh, place) {
            if path.is_empty() {
                path.push(*from);
            }
            if line.distance == 0.0 {
                break;
            }
            match self.walk(mesh, &line, &mut path) {
                // Each root is nearer than the one before.
                Some(vertex) => place = Place::Vertex(vertex),
                None => break,
            }
        }
        Ok(path)
    }

    /// Follows a line to its root; the root if that is a vertex.
    fn walk(
        &self,
        mesh: &TriangleMesh,
        line: &Line,
        path: &mut Vec<SurfacePoint>,
    ) -> Option<usize> {
        let vertex = (line.root as usize) < mesh.vertex_count();
        let root_distance = if vertex {
            self.distance[line.root as usize]
        } else {
            0.0
        };
        let rest = line.distance - root_distance;
        let mut walk = Walk {
            mesh,
            root: line.root,
            half: line.half,
            image: Window {
                a: 0.0,
                b: 0.0,
                x: line.image[0],
                y: line.image[1],
                s: 0.0,
                root: line.root,
                is_line: self.roots.is_segment(mesh, line.root),
            },
            point: line.point,
            rest,
        };
        // No shortest line crosses a face twice.
        for _ in 0..=mesh.face_count() {
            if let Some(end) = self.end_in_face(&walk) {
                path.push(end);
                return vertex.then_some(line.root as usize);
            }
            if let Some(point) = walk.cross() {
                path.push(point);
            } else {
                break;
            }
        }
        // Rounding led past the root: the nearest corner leads on.
        let face = walk.half / 3;
        let corners = mesh.corners(face);
        let nearest = |a: usize, b: usize| {
            if self.distance[b] < self.distance[a] {
                b
            } else {
                a
            }
        };
        let corner = corners.into_iter().reduce(nearest)?;
        let k = corners.iter().position(|&c| c == corner)?;
        path.push(corner_of(face, k));
        (self.distance[corner] < line.distance).then_some(corner)
    }

    /// The root, if the current face holds it where the line ends.
    fn end_in_face(&self, walk: &Walk) -> Option<SurfacePoint> {
        let (face, k) = (walk.half / 3, walk.half % 3);
        let frame = Frame::new(walk.mesh, face, k);
        let size = frame.length + frame.left;
        let reach = walk.rest + AT_ROOT * walk.rest.max(1e-3 * size);
        let corners = [[0.0; 2], [frame.length, 0.0], frame.apex];
        let is_near = |p: Point2| {
            let (u, v) = (p[0] - walk.point[0], p[1] - walk.point[1]);
            u * u + v * v <= reach * reach
        };
        let Some(root) = self.roots.other(walk.mesh, walk.root) else {
            let of_face = walk.mesh.corners(face);
            let c = (0..3).find(|c| of_face[*c] == walk.root as usize)?;
            return is_near(corners[(c + 3 - k) % 3]).then(|| corner_of(face, c));
        };
        let &(_, one, two) = root.faces.iter().find(|f| f.0 == face)?;
        // Weights in the order of the frame's corners.
        let turned = |w: [f64; 3]| [0, 1, 2].map(|i| w[(k + i) % 3]);
        let [p, q] = [one, two].map(|w| at(corners, turned(w)));
        let along = [q[0] - p[0], q[1] - p[1]];
        let square = along[0] * along[0] + along[1] * along[1];
        let to = [walk.point[0] - p[0], walk.point[1] - p[1]];
        let share = match root.is_segment {
            true => ((to[0] * along[0] + to[1] * along[1]) / square).clamp(0.0, 1.0),
            false => 0.0,
        };
        let end = [0, 1].map(|i| p[i] + share * along[i]);
        is_near(end).then(|| SurfacePoint {
            face,
            barycentric: [0, 1, 2].map(|i| one[i] + share * (two[i] - one[i])),
        })
    }
}

impl Walk<'_> {
    /// Goes on to the face across the half-edge; the point where it crosses. None if there is no such face.
    fn cross(&mut self) -> Option<SurfacePoint> {
        let (face, k) = (self.half / 3, self.half % 3);
        let frame = Frame::new(self.mesh, face, k);
        let [x, y] = self.point;
        let rise = y / (y - self.image.y);
        let place = match self.image.is_line {
            true => x + self.image.x * (y / self.image.y),
            false => x + (self.image.x - x) * rise,
        };
        let place = if place.is_finite() {
            place.clamp(0.0, frame.length)
        } else {
            x.clamp(0.0, frame.length)
        };
        self.rest -= (place - x).hypot(y);
        let share = place / frame.length;
        let mut barycentric = [0.0; 3];
        barycentric[k] = 1.0 - share;
        barycentric[(k + 1) % 3] = share;
        let point = SurfacePoint { face, barycentric };
        let (across, j) = self.mesh.neighbor(face, k)?;
        // The plane of the other side: turned by half a turn.
        let other = Frame::new(self.mesh, across, j);
        let mut image = self.image;
        image.x = if image.is_line {
            -image.x
        } else {
            other.length - image.x
        };
        image.y = -image.y;
        let here = [other.length - place, 0.0];
        let to = match image.is_line {
            true => [-image.x, image.y],
            false => [image.x - here[0], image.y - here[1]],
        };
        let apex = other.apex;
        let side = to[0] * (apex[1] - here[1]) - to[1] * (apex[0] - here[0]);
        let (next, origin, axis) = match side > 0.0 {
            true => ((j + 1) % 3, [other.length, 0.0], other.down().map(|x| -x)),
            false => ((j + 2) % 3, apex, other.up().map(|x| -x)),
        };
        self.half = 3 * across + next;
        self.image = moved(&image, origin, axis);
        let (u, v) = (here[0] - origin[0], here[1] - origin[1]);
        self.point = [u * axis[0] + v * axis[1], v * axis[0] - u * axis[1]];
        Some(point)
    }
}

fn corner_of(face: usize, k: usize) -> SurfacePoint {
    let mut barycentric = [0.0; 3];
    barycentric[k] = 1.0;
    SurfacePoint { face, barycentric }
}
