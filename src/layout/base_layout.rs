//! A base layout: a coarse mesh of polygons whose edges are to become arcs on a surface.

use std::collections::HashMap;

use crate::error::{Error, Result};
use crate::mesh::vector::{Vec3, add, cross, norm, scale, sub};
use crate::soup::PolygonSoup;

/// An arc together with a direction: `2 a` runs along arc a from its first end to its second, `2 a + 1` back.
pub type Dart = u32;

/// A coarse mesh of polygons anywhere near a surface: its vertices mark points of the surface, its edges are the
/// arcs, its polygons the patches.
///
/// It is a manifold, with or without boundary, whose polygons have three sides or more and agree in orientation.
/// Between two vertices there is one arc at most. Arcs are numbered in the order in which polygons name them.
#[derive(Debug, Clone, PartialEq)]
pub struct BaseLayout {
    positions: Vec<Vec3>,
    polygons: Vec<Vec<u32>>,
    ends: Vec<[u32; 2]>,
    /// The sides of each polygon, counter-clockwise: side i runs from corner i to corner i + 1.
    sides: Vec<Vec<Dart>>,
    /// The polygon on the left of each dart and the number of the side there. None at the boundary.
    left: Vec<Option<[u32; 2]>>,
    /// A dart that leaves each vertex; at the boundary the first one counter-clockwise.
    first: Vec<Dart>,
}

/// The same arc in the other direction.
pub(crate) fn reversed(dart: Dart) -> Dart {
    dart ^ 1
}

impl BaseLayout {
    /// The layout with these vertices and polygons, whose corners are numbers of vertices.
    ///
    /// # Errors
    /// [`Error::InvalidArgument`] without polygons; [`Error::NotFinite`] for a coordinate, with the number of the vertex;
    /// [`Error::IndexOutOfRange`] for a corner that is no vertex, with the number of the polygon;
    /// [`Error::InvalidArgument`] for a polygon of fewer than three sides or with a corner that comes twice, with its
    /// number; for polygons that do not agree in orientation or share an edge with two others, with the number of
    /// the later one; for a vertex in no polygon, or whose polygons form more than one fan, with its number.
    pub fn new(positions: Vec<Vec3>, polygons: Vec<Vec<u32>>) -> Result<Self> {
        if polygons.is_empty() {
            return Err(Error::InvalidArgument {
                what: "the layout has no polygons".into(),
                index: None,
            });
        }
        for (position, point) in positions.iter().enumerate() {
            if point.iter().any(|x| !x.is_finite()) {
                return Err(Error::NotFinite {
                    what: "vertices of the layout",
                    position,
                });
            }
        }
        for (number, polygon) in polygons.iter().enumerate() {
            check_corners(number, polygon, positions.len())?;
        }
        let mut layout = BaseLayout {
            first: vec![u32::MAX; positions.len()],
            positions,
            polygons,
            ends: Vec::new(),
            sides: Vec::new(),
            left: Vec::new(),
        };
        layout.connect()?;
        layout.find_fans()?;
        Ok(layout)
    }

    /// The layout whose polygons are those of a soup.
    ///
    /// # Errors
    /// As [`new`](Self::new).
    pub fn from_soup(soup: &PolygonSoup) -> Result<Self> {
        let vertices = soup.positions().len();
        let polygon = |(position, corners): (usize, &[i64])| {
            let corner = |&value: &i64| match u32::try_from(value) {
                Ok(v) if (v as usize) < vertices => Ok(v),
                _ => Err(Error::IndexOutOfRange {
                    what: "polygons of the layout",
                    position,
                    value,
                    len: vertices,
                }),
            };
            corners.iter().map(corner).collect()
        };
        let polygons: Result<Vec<Vec<u32>>> = soup.polygons().enumerate().map(polygon).collect();
        BaseLayout::new(soup.positions().to_vec(), polygons?)
    }

    fn connect(&mut self) -> Result<()> {
        let mut number_of: HashMap<[u32; 2], u32> = HashMap::new();
        for (p, polygon) in self.polygons.iter().enumerate() {
            let mut sides = Vec::with_capacity(polygon.len());
            for (i, &a) in polygon.iter().enumerate() {
                let b = polygon[(i + 1) % polygon.len()];
                let arc = *number_of.entry([a.min(b), a.max(b)]).or_insert_with(|| {
                    self.ends.push([a, b]);
                    self.left.extend([None, None]);
                    self.ends.len() as u32 - 1
                });
                let dart = 2 * arc + u32::from(self.ends[arc as usize][0] != a);
                let left = &mut self.left[dart as usize];
                if let Some([other, _]) = *left {
                    return Err(Error::InvalidArgument {
                        what: format!(
                            "polygons {other} and {p} of the layout have the edge from vertex {a} to vertex {b} in \
                             the same direction: they must agree in orientation, and an edge has two polygons at most"
                        ),
                        index: Some(p),
                    });
                }
                *left = Some([p as u32, i as u32]);
                sides.push(dart);
            }
            self.sides.push(sides);
        }
        Ok(())
    }

    /// Finds the first dart around each vertex, and that all others follow it.
    fn find_fans(&mut self) -> Result<()> {
        let mut leaving = vec![0usize; self.positions.len()];
        for dart in 0..self.left.len() as u32 {
            let v = self.tail(dart) as usize;
            leaving[v] += 1;
            let is_first = self.left[reversed(dart) as usize].is_none();
            if self.first[v] == u32::MAX || is_first {
                self.first[v] = dart;
            }
        }
        for (v, &count) in leaving.iter().enumerate() {
            let what = match count {
                0 => format!("vertex {v} of the layout belongs to no polygon"),
                _ if self.around(v).count() < count => {
                    format!("the polygons at vertex {v} of the layout form more than one fan")
                }
                _ => continue,
            };
            return Err(Error::InvalidArgument {
                what,
                index: Some(v),
            });
        }
        Ok(())
    }

    /// Positions of all vertices.
    pub fn positions(&self) -> &[Vec3] {
        &self.positions
    }

    /// The corners of all polygons, counter-clockwise.
    pub fn polygons(&self) -> &[Vec<u32>] {
        &self.polygons
    }

    /// Number of vertices.
    pub fn vertex_count(&self) -> usize {
        self.positions.len()
    }

    /// Number of arcs.
    pub fn arc_count(&self) -> usize {
        self.ends.len()
    }

    /// The two vertices that each arc joins, in the direction in which the first of its polygons has it.
    pub fn arcs(&self) -> &[[u32; 2]] {
        &self.ends
    }

    /// The arc that joins two vertices, if there is one.
    pub fn arc_between(&self, a: usize, b: usize) -> Option<usize> {
        let dart = (a < self.vertex_count())
            .then(|| self.around(a))?
            .find(|&dart| self.tail(reversed(dart)) as usize == b)?;
        Some(dart as usize / 2)
    }

    /// The number of polygons at a vertex.
    pub fn valence(&self, vertex: usize) -> usize {
        let darts = self.around(vertex);
        darts.filter(|&d| self.left[d as usize].is_some()).count()
    }

    /// Whether a vertex lies on the boundary.
    pub fn is_boundary_vertex(&self, vertex: usize) -> bool {
        self.is_boundary_arc(self.first[vertex] as usize / 2)
    }

    /// Whether an arc has one polygon only.
    pub fn is_boundary_arc(&self, arc: usize) -> bool {
        self.left[2 * arc].is_none() || self.left[2 * arc + 1].is_none()
    }

    /// Vertices minus arcs plus polygons.
    pub fn euler_characteristic(&self) -> i64 {
        self.vertex_count() as i64 - self.arc_count() as i64 + self.polygons.len() as i64
    }

    /// The sides of each polygon.
    pub(crate) fn sides(&self) -> &[Vec<Dart>] {
        &self.sides
    }

    /// The polygon on the left of a dart.
    pub(crate) fn polygon_left_of(&self, dart: Dart) -> Option<usize> {
        self.left[dart as usize].map(|[polygon, _]| polygon as usize)
    }

    /// The vertex where a dart begins.
    pub(crate) fn tail(&self, dart: Dart) -> u32 {
        self.ends[dart as usize / 2][dart as usize % 2]
    }

    /// The darts that leave a vertex, counter-clockwise. At the boundary, the first has no polygon on its right.
    pub(crate) fn around(&self, vertex: usize) -> impl Iterator<Item = Dart> + '_ {
        let first = self.first[vertex];
        let mut next = (first != u32::MAX).then_some(first);
        std::iter::from_fn(move || {
            let dart = next?;
            next = self.left[dart as usize]
                .map(|[polygon, side]| {
                    let sides = &self.sides[polygon as usize];
                    reversed(sides[(side as usize + sides.len() - 1) % sides.len()])
                })
                .filter(|&dart| dart != first);
            Some(dart)
        })
    }

    /// Twice the area vector of a polygon: its direction is the normal.
    pub(crate) fn area_vector(&self, polygon: usize) -> Vec3 {
        let corners: Vec<Vec3> = self.polygons[polygon]
            .iter()
            .map(|&v| self.positions[v as usize])
            .collect();
        let fans = (1..corners.len() - 1).map(|i| {
            let [a, b] = [corners[i], corners[i + 1]].map(|p| sub(p, corners[0]));
            cross(a, b)
        });
        fans.fold([0.0; 3], add)
    }

    /// The sum of the area vectors of the polygons at a vertex.
    pub(crate) fn normal(&self, vertex: usize) -> Vec3 {
        let polygons = self
            .around(vertex)
            .filter_map(|dart| self.polygon_left_of(dart));
        polygons.map(|p| self.area_vector(p)).fold([0.0; 3], add)
    }

    /// The distance of a vertex from its nearest neighbour.
    pub(crate) fn shortest_arc_at(&self, vertex: usize) -> f64 {
        let tips = self
            .around(vertex)
            .map(|dart| self.tail(reversed(dart)) as usize);
        let lengths = tips.map(|tip| norm(sub(self.positions[tip], self.positions[vertex])));
        lengths.fold(f64::INFINITY, f64::min)
    }

    /// Where a vertex is after a step of subdivision (`catmull1978`): near the smooth surface of which the layout is a
    /// control mesh.
    pub(crate) fn subdivided(&self, vertex: usize) -> Vec3 {
        let own = self.positions[vertex];
        let darts: Vec<Dart> = self.around(vertex).collect();
        let tips = darts.iter().map(|&dart| self.tail(reversed(dart)) as usize);
        let tips: Vec<Vec3> = tips.map(|v| self.positions[v]).collect();
        let mean = |points: &[Vec3]| {
            let sum = points.iter().copied().fold([0.0; 3], add);
            scale(sum, 1.0 / points.len() as f64)
        };
        if self.is_boundary_vertex(vertex) {
            let ends = mean(&[tips[0], tips[tips.len() - 1]]);
            return add(scale(own, 0.75), scale(ends, 0.25));
        }
        let polygons = darts.iter().filter_map(|&dart| self.polygon_left_of(dart));
        let middles: Vec<Vec3> = polygons.map(|p| self.centroid(p)).collect();
        let n = darts.len() as f64;
        let sum = add(add(mean(&middles), mean(&tips)), scale(own, n - 2.0));
        scale(sum, 1.0 / n)
    }

    /// The middle of a polygon's corners.
    pub(crate) fn centroid(&self, polygon: usize) -> Vec3 {
        let corners = &self.polygons[polygon];
        let sum = corners.iter().map(|&v| self.positions[v as usize]);
        scale(sum.fold([0.0; 3], add), 1.0 / corners.len() as f64)
    }

    /// The layout seen from the other side: each polygon with its corners in the opposite order.
    pub(crate) fn turned_over(&self) -> Self {
        let polygons = self.polygons.iter().map(|polygon| {
            let mut turned = polygon.clone();
            turned.reverse();
            turned
        });
        let mut turned = BaseLayout {
            positions: self.positions.clone(),
            polygons: polygons.collect(),
            ends: self.ends.clone(),
            sides: Vec::new(),
            left: vec![None; self.left.len()],
            first: vec![u32::MAX; self.first.len()],
        };
        // Side i now runs along the old side n - 2 - i, backwards.
        for (p, sides) in self.sides.iter().enumerate() {
            let n = sides.len();
            let new: Vec<Dart> = (0..n)
                .map(|i| reversed(sides[(2 * n - 2 - i) % n]))
                .collect();
            for (i, &dart) in new.iter().enumerate() {
                turned.left[dart as usize] = Some([p as u32, i as u32]);
            }
            turned.sides.push(new);
        }
        for dart in 0..turned.left.len() as u32 {
            let v = turned.tail(dart) as usize;
            if turned.first[v] == u32::MAX || turned.left[reversed(dart) as usize].is_none() {
                turned.first[v] = dart;
            }
        }
        turned
    }
}

fn check_corners(number: usize, polygon: &[u32], vertices: usize) -> Result<()> {
    if let Some(&v) = polygon.iter().find(|&&v| v as usize >= vertices) {
        return Err(Error::IndexOutOfRange {
            what: "polygons of the layout",
            position: number,
            value: v.into(),
            len: vertices,
        });
    }
    let repeated = (1..polygon.len()).find(|&i| polygon[..i].contains(&polygon[i]));
    let what = match repeated {
        _ if polygon.len() < 3 => format!(
            "polygon {number} of the layout has {} sides; it must have at least 3",
            polygon.len()
        ),
        Some(i) => format!(
            "polygon {number} of the layout has vertex {} twice",
            polygon[i]
        ),
        None => return Ok(()),
    };
    Err(Error::InvalidArgument {
        what,
        index: Some(number),
    })
}

#[cfg(test)]
#[path = "base_layout_tests.rs"]
pub(in crate::layout) mod tests;
