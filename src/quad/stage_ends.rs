//! Where the stages of a run from a mesh to quads end, as shares of its time.
//!
//! The times are measured ones of closed surfaces of 10,000 to 200,000 triangles, with 1,000 quads.

use super::QuadOptions;
use super::fields::field_count;
use crate::mesh::TriangleMesh;

/// The relative times of one field with the relaxation of its map, of the integers of the map, of extraction,
/// and of smoothing.
const TIMES: [f64; 4] = [10.0, 1.5, 0.8, 1.0];

/// The share of the run at which each stage ends: field, map, quads, smoothing.
pub(super) fn stage_ends(mesh: &TriangleMesh, options: &QuadOptions) -> [f64; 4] {
    let mut times = TIMES;
    times[0] *= field_count(mesh, options) as f64;
    let whole: f64 = times.iter().sum();
    let mut passed = 0.0;
    times.map(|time| {
        passed += time;
        passed / whole
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mesh::shape::by_name;

    #[test]
    fn stages_follow_each_other_to_the_end() {
        let mesh = by_name("torus", 400).unwrap();
        let ends = stage_ends(&mesh, &QuadOptions::default());
        assert!(ends.is_sorted() && ends[0] > 0.5, "{ends:?}");
        assert!((ends[3] - 1.0).abs() < 1e-15);
    }
}
