//! Values of the vertices of a soup, carried over to those of what repair made of it.

use super::{Repaired, SoupError};

impl Repaired {
    /// A value for every vertex, from those of the vertices of the soup. A vertex that repair made has the mean of
    /// those around it that come from the soup, or, where there are none, around those around it, and so on.
    ///
    /// # Errors
    /// [`SoupError::Malformed`] unless there is a value for each vertex of the soup.
    pub fn values_at_vertices(&self, values: &[f64]) -> Result<Vec<f64>, SoupError> {
        if values.len() != self.input_vertex_count() {
            return Err(SoupError::Malformed {
                message: format!(
                    "there are {} values for {} vertices",
                    values.len(),
                    self.input_vertex_count()
                ),
            });
        }
        let of = |origin: &Option<u32>| origin.map(|v| values[v as usize]);
        let mut found: Vec<Option<f64>> = self.vertex_origin.iter().map(of).collect();
        while found.contains(&None) {
            let mut sums = vec![(0.0, 0.0); found.len()];
            for triangle in &self.triangles {
                for &v in triangle {
                    for value in triangle.iter().filter_map(|&w| found[w as usize]) {
                        let sum = &mut sums[v as usize];
                        *sum = (sum.0 + value, sum.1 + 1.0);
                    }
                }
            }
            let mut is_done = true;
            for (value, (sum, count)) in found.iter_mut().zip(sums) {
                if value.is_none() && count > 0.0 {
                    *value = Some(sum / count);
                    is_done = false;
                }
            }
            if is_done {
                break;
            }
        }
        // A component that repair made has no values.
        Ok(found
            .into_iter()
            .map(|value| value.unwrap_or(1.0))
            .collect())
    }
}

#[cfg(test)]
mod tests {
    use crate::soup::{PolygonSoup, RepairOptions, repair};

    #[test]
    fn values_follow_welded_and_unused_vertices_and_fill_holes() {
        // A cube without its lid, a vertex that is not used, and each corner of the bottom twice.
        let mut points = vec![[9.0, 9.0, 9.0]];
        let square = [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]];
        for z in [0.0, 1.0, 0.0] {
            points.extend(square.map(|[x, y]| [x, y, z]));
        }
        let height = |p: &[f64; 3]| 1.0 + p[2];
        let values: Vec<f64> = points.iter().map(height).collect();
        let mut soup = PolygonSoup::new(points);
        soup.add_polygon([12, 11, 10, 9]);
        for (i, j) in [(1, 2), (2, 3), (3, 4), (4, 1)] {
            soup.add_polygon([i, j, j + 4, i + 4]);
        }
        let options = RepairOptions {
            fill_holes: 10,
            ..RepairOptions::default()
        };
        let repaired = repair(&soup, &options).unwrap();
        assert!(repaired.vertices.len() >= 8 && !repaired.edits.is_empty());
        let carried = repaired.values_at_vertices(&values).unwrap();
        for (p, value) in repaired.vertices.iter().zip(carried) {
            assert_eq!(value, height(p));
        }
        assert!(repaired.values_at_vertices(&values[1..]).is_err());
    }
}
