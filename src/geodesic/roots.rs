//! The roots that sources are made of: vertices, points and segments, each once, in an order of their own.

use super::place::Place;
use super::source::Source;
use crate::error::{Error, Result};
use crate::mesh::TriangleMesh;

/// A point in the plane of a face: corner 0 is the origin, local edge 0 the first axis.
pub(super) type Point2 = [f64; 2];

/// A root that is no vertex, with the faces that hold it.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Root {
    /// The number of the first source that it belongs to.
    pub(super) source: u32,
    /// Weights of the corners for one end, and for the other of a segment, in each face that holds it.
    pub(super) faces: Vec<(usize, [f64; 3], [f64; 3])>,
    pub(super) is_segment: bool,
}

/// All roots of the sources.
#[derive(Debug, Clone, PartialEq, Default)]
pub(super) struct Roots {
    /// Vertices at distance 0, in increasing order, each with the number of its first source.
    pub(super) vertices: Vec<(usize, u32)>,
    /// The others.
    pub(super) others: Vec<Root>,
    /// Edges that lie on a source, in increasing order.
    pub(super) edges: Vec<usize>,
}

/// What identifies a root: the places of its ends, which are the same for a point.
type Key = [(u8, usize, [u64; 2]); 2];

struct Found {
    key: Key,
    source: u32,
    ends: [Place; 2],
}

impl Roots {
    /// The roots of sources, which are checked.
    pub(super) fn new(mesh: &TriangleMesh, sources: &[Source]) -> Result<Roots> {
        let mut found = Vec::new();
        for (number, source) in sources.iter().enumerate() {
            source.check(mesh, number)?;
            find(mesh, number, source, &mut found)?;
        }
        if found.is_empty() {
            return Err(Error::InvalidArgument {
                what: "there are no sources to measure distances from".into(),
                index: None,
            });
        }
        found.sort_by_key(|f| (f.key, f.source));
        found.dedup_by(|later, kept| later.key == kept.key);
        let mut roots = Roots::default();
        for Found { source, ends, .. } in found {
            match ends {
                [Place::Vertex(v), Place::Vertex(w)] if v == w => roots.vertices.push((v, source)),
                [one, two] => roots.add(mesh, source, one, two),
            }
        }
        roots.edges.sort_unstable();
        Ok(roots)
    }

    /// The root of this number that is no vertex.
    pub(super) fn other(&self, mesh: &TriangleMesh, root: u32) -> Option<&Root> {
        let number = (root as usize).checked_sub(mesh.vertex_count())?;
        self.others.get(number)
    }

    /// All of them, by the faces that hold them.
    pub(super) fn by_face(&self, mesh: &TriangleMesh) -> Vec<(usize, u32)> {
        let roots = self.others.iter().zip(mesh.vertex_count() as u32..);
        let faces = roots.flat_map(|(root, r)| root.faces.iter().map(move |f| (f.0, r)));
        let mut by_face: Vec<_> = faces.collect();
        by_face.sort_unstable();
        by_face
    }

    pub(super) fn is_segment(&self, mesh: &TriangleMesh, root: u32) -> bool {
        self.other(mesh, root).is_some_and(|r| r.is_segment)
    }

    fn add(&mut self, mesh: &TriangleMesh, source: u32, one: Place, two: Place) {
        let faces = common_faces(mesh, one, two);
        let is_segment = one != two;
        if let ([first, ..], true) = (&faces[..], is_segment) {
            let is_corner = |w: &[f64; 3]| w.contains(&1.0);
            if is_corner(&first.1) && is_corner(&first.2) {
                let k = (0..3).find(|&k| first.1[k] == 0.0 && first.2[k] == 0.0);
                let opposite = k.unwrap_or(0);
                self.edges.push(mesh.edge_of(first.0, (opposite + 1) % 3));
            }
        }
        self.others.push(Root {
            source,
            faces,
            is_segment,
        });
    }
}

/// The faces that hold both places, in increasing order.
pub(super) fn common_faces(
    mesh: &TriangleMesh,
    one: Place,
    two: Place,
) -> Vec<(usize, [f64; 3], [f64; 3])> {
    let others = two.faces(mesh);
    let mut common = Vec::new();
    for (face, weights) in one.faces(mesh) {
        if let Some((_, other)) = others.iter().find(|(f, _)| *f == face) {
            common.push((face, weights, *other));
        }
    }
    common.sort_by_key(|c| c.0);
    common
}

fn find(mesh: &TriangleMesh, number: usize, source: &Source, found: &mut Vec<Found>) -> Result<()> {
    let mut add = |one: Place, two: Place| {
        let (one, two) = if two.key() < one.key() {
            (two, one)
        } else {
            (one, two)
        };
        found.push(Found {
            key: [one.key(), two.key()],
            source: number as u32,
            ends: [one, two],
        });
    };
    match source {
        Source::Vertex(v) => add(Place::Vertex(*v), Place::Vertex(*v)),
        Source::Point(point) => {
            let place = Place::of(mesh, point);
            add(place, place);
        }
        Source::Edges(edges) => {
            for &e in edges {
                let [a, b] = mesh.edge(e).vertices.map(Place::Vertex);
                add(a, a);
                add(b, b);
                add(a, b);
            }
        }
        Source::Polyline { points, closed } => {
            let places: Vec<Place> = points.iter().map(|p| Place::of(mesh, p)).collect();
            places.iter().for_each(|&p| add(p, p));
            let last = if *closed {
                places.len()
            } else {
                places.len().saturating_sub(1)
            };
            for i in 0..last {
                let (one, two) = (places[i], places[(i + 1) % places.len()]);
                if one == two {
                    continue;
                }
                if common_faces(mesh, one, two).is_empty() {
                    let next = (i + 1) % places.len();
                    return Err(Error::InvalidArgument {
                        what: format!(
                            "source {number}: points {i} and {next} of the polyline lie on no common face"
                        ),
                        index: Some(number),
                    });
                }
                add(one, two);
            }
        }
    }
    Ok(())
}

/// The corners of a face in its plane.
pub(super) fn flat(mesh: &TriangleMesh, face: usize) -> [Point2; 3] {
    let frame = super::frame::Frame::new(mesh, face, 0);
    [[0.0; 2], [frame.length, 0.0], frame.apex]
}

/// The point of a triangle with these weights of its corners.
pub(super) fn at(corners: [Point2; 3], weights: [f64; 3]) -> Point2 {
    [0, 1].map(|i| {
        corners[0][i] * weights[0] + corners[1][i] * weights[1] + corners[2][i] * weights[2]
    })
}
