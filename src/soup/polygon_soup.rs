//! The soup itself: positions, and the corners of all polygons in one list.

use crate::linalg::vector::Vec3;

/// Positions and polygons as a file has them, nothing checked.
///
/// Polygons have any number of corners, none included. Corners are numbers of vertices, counted from 0;
/// numbers that name no vertex are kept as they are given, so that repair can tell them.
#[derive(Debug, Clone, PartialEq)]
pub struct PolygonSoup {
    positions: Vec<Vec3>,
    corners: Vec<i64>,
    /// Where the corners of each polygon start, and where those of the last end.
    starts: Vec<usize>,
}

impl Default for PolygonSoup {
    fn default() -> Self {
        PolygonSoup::new(Vec::new())
    }
}

impl PolygonSoup {
    /// A soup of these vertices, without polygons.
    pub fn new(positions: Vec<Vec3>) -> Self {
        PolygonSoup {
            positions,
            corners: Vec::new(),
            starts: vec![0],
        }
    }

    /// A soup of triangles.
    pub fn of_triangles(positions: Vec<Vec3>, triangles: &[[u32; 3]]) -> Self {
        PolygonSoup {
            positions,
            corners: triangles.iter().flatten().map(|&v| v.into()).collect(),
            starts: (0..=triangles.len()).map(|t| 3 * t).collect(),
        }
    }

    /// A soup of these corners, of which those of polygon k are `starts[k]..starts[k + 1]`.
    pub(crate) fn of_lists(positions: Vec<Vec3>, corners: Vec<i64>, starts: Vec<usize>) -> Self {
        debug_assert_eq!(starts.first(), Some(&0));
        debug_assert_eq!(starts.last(), Some(&corners.len()));
        PolygonSoup {
            positions,
            corners,
            starts,
        }
    }

    /// Adds a vertex, and gives its number.
    pub fn add_vertex(&mut self, position: Vec3) -> usize {
        self.positions.push(position);
        self.positions.len() - 1
    }

    /// Adds a polygon, and gives its number.
    pub fn add_polygon(&mut self, corners: impl IntoIterator<Item = i64>) -> usize {
        self.corners.extend(corners);
        self.starts.push(self.corners.len());
        self.polygon_count() - 1
    }

    /// Positions of all vertices.
    pub fn positions(&self) -> &[Vec3] {
        &self.positions
    }

    /// The corners of all polygons in one list.
    pub fn corners(&self) -> &[i64] {
        &self.corners
    }

    /// Number of polygons.
    pub fn polygon_count(&self) -> usize {
        self.starts.len() - 1
    }

    /// The corners of a polygon.
    pub fn polygon(&self, polygon: usize) -> &[i64] {
        &self.corners[self.starts[polygon]..self.starts[polygon + 1]]
    }

    /// The corners of all polygons, one after the other.
    pub fn polygons(&self) -> impl ExactSizeIterator<Item = &[i64]> + '_ {
        self.starts.windows(2).map(|w| &self.corners[w[0]..w[1]])
    }
}
