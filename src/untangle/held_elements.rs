//! Elements of a map whose shape the integers alone decide. Their vertices are cones, or those corners of
//! features and of the boundary both of whose coordinates are integers.
//!
//! Two cones near each other must keep their order ([`super::near_cones`]), and the three corners of a face
//! must not be collinear. Otherwise the faces between them have no area, wherever the other vertices move.

use super::isoline_triangles::IsolineTriangle;
use super::near_cones::Near;
use crate::error::Result;
use crate::map::{SeamlessMap, SeamlessProblem, apart, row};
use crate::mesh::TriangleMesh;
use crate::mesh::orientation;
use crate::mesh::vector::{dot, norm, sub};
use crate::solve::SoftRow;

/// How far from a fault one of two elements may lie whose difference is changed, in quads.
const AROUND: f64 = 2.5;

/// The least deviation of a difference that is changed.
const DEVIATION: f64 = 0.2;

/// The elements that integers may collapse, the same for all maps of one problem.
pub(crate) struct HeldElements {
    near: Near,
    /// Faces of three cones or corners.
    faces: Vec<usize>,
    isoline_triangles: Vec<IsolineTriangle>,
}

impl HeldElements {
    /// The elements of a problem in which integers hold these coordinates of every copy. Rows are between those
    /// within `reach` quads of each other.
    ///
    /// # Errors
    /// The reason to end the current step.
    pub(super) fn new(
        problem: &SeamlessProblem,
        mesh: &TriangleMesh,
        held: &[[bool; 2]],
        reach: f64,
    ) -> Result<Self> {
        let copies = &problem.sectors.copy;
        let is_held = |&face: &usize| copies[face].iter().all(|&c| held[c as usize] == [true; 2]);
        Ok(HeldElements {
            near: problem.near(mesh, held, reach)?,
            faces: (0..mesh.face_count()).filter(is_held).collect(),
            isoline_triangles: problem.isoline_triangles(mesh, held),
        })
    }

    /// The rows that the integers of a map should keep, whatever else they do.
    pub(crate) fn rows(&self) -> &[SoftRow] {
        &self.near.rows
    }

    /// The rows that the integers of a map miss, and those that open the faces which they collapse or turn
    /// over.
    pub(crate) fn missed(
        &self,
        mesh: &TriangleMesh,
        problem: &SeamlessProblem,
        map: &SeamlessMap,
    ) -> Vec<SoftRow> {
        let near = self
            .near
            .rows
            .iter()
            .filter(|row| row.is_missed(map.values()));
        let mut found: Vec<SoftRow> = near.cloned().collect();
        for triangle in &self.isoline_triangles {
            if let Some((ends, aim)) = triangle.wrong(map) {
                let copies = ends.map(|k| problem.sectors.copy[triangle.face][k]);
                found.push(apart(copies, triangle.axis, aim, aim));
            }
        }
        if found.is_empty() {
            let at = |face: usize| map.uv(face).map(|p| p.map(f64::round));
            let lost = self
                .faces
                .iter()
                .filter(|&&face| orientation(at(face)) <= 0.0);
            found.extend(lost.flat_map(|&face| problem.upright(mesh, face)));
        }
        found
    }

    /// The rows each of which brings the difference of two elements around these vertices, in a map, one nearer to
    /// the one that it should have: those that deviate most, and nearest to a vertex, first. `quad` is the length of an
    /// edge of quads.
    pub(crate) fn steps_around(
        &self,
        mesh: &TriangleMesh,
        map: &SeamlessMap,
        faults: &[usize],
        quad: f64,
    ) -> Vec<SoftRow> {
        let at = |v: usize| mesh.vertices()[v];
        let distance = |v: usize| {
            let from = faults.iter().map(|&fault| norm(sub(at(v), at(fault))));
            from.fold(f64::INFINITY, f64::min) / quad
        };
        let mut found: Vec<(f64, SoftRow)> = Vec::new();
        for pair in &self.near.pairs {
            let nearest = pair
                .vertices
                .map(distance)
                .into_iter()
                .fold(AROUND, f64::min);
            if nearest >= AROUND {
                continue;
            }
            for axis in 0..2 {
                let deviation = pair.deviation(axis, map.values()).abs();
                if deviation >= DEVIATION {
                    let step = pair.step(axis, map.values());
                    found.push((deviation / (1.0 + nearest), step));
                }
            }
        }
        found.sort_by(|a, b| b.0.total_cmp(&a.0));
        found.into_iter().map(|(_, row)| row).collect()
    }
}

impl SeamlessProblem {
    /// The rows that make a face the nearest counter-clockwise triangle whose sides from the first corner have
    /// coordinates -1, 0 and 1.
    fn upright(&self, mesh: &TriangleMesh, face: usize) -> Vec<SoftRow> {
        let aims = [1, 2].map(|end| self.aim(mesh, face, 0, end));
        let size = aims.map(|[u, v]| u.hypot(v));
        let longest = size[0].max(size[1]).max(f64::MIN_POSITIVE);
        let [ab, ac] = aims.map(|aim| aim.map(|entry| entry / longest));
        let [first, second, third] = self.sectors.copy[face];
        let mut found = Vec::new();
        for (end, unit) in [second, third].into_iter().zip(units(ab, ac)) {
            for axis in 0..2 {
                let [from, end] = [first, end].map(|copy| 2 * copy as usize + axis);
                for by in [1.0, -1.0] {
                    found.push(row(vec![(end, by), (from, -by)], by * unit[axis], longest));
                }
            }
        }
        found
    }

    /// The difference that the coordinates of two corners of a face should have.
    pub(super) fn aim(&self, mesh: &TriangleMesh, face: usize, from: usize, to: usize) -> [f64; 2] {
        let corners = mesh.corner_positions(face);
        let step = sub(corners[to], corners[from]);
        self.wanted(mesh, face).map(|gradient| dot(gradient, step))
    }
}

/// The two vectors nearest to the given ones whose entries are -1, 0 or 1, with the second to the left of
/// the first.
fn units(first: [f64; 2], second: [f64; 2]) -> [[f64; 2]; 2] {
    let entries =
        (0..81).map(|n: i32| [n / 27, n / 9 % 3, n / 3 % 3, n % 3].map(|e| f64::from(e - 1)));
    let left = entries.filter(|[a, b, c, d]| a * d - b * c > 0.0);
    let aim = [first[0], first[1], second[0], second[1]];
    let distance = |e: &[f64; 4]| (0..4).map(|i| (e[i] - aim[i]).powi(2)).sum::<f64>();
    let nearest = left.min_by(|a, b| distance(a).total_cmp(&distance(b)));
    let [a, b, c, d] = nearest.unwrap_or([1.0, 0.0, 0.0, 1.0]);
    [[a, b], [c, d]]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn units_are_the_right_way_round_and_near() {
        assert_eq!(units([0.9, 0.2], [-0.1, 1.2]), [[1.0, 0.0], [0.0, 1.0]]);
        for n in 0..50 {
            let aim = [0, 1, 2, 3].map(|i| f64::from(n * 4 + i).sin());
            let [[a, b], [c, d]] = units([aim[0], aim[1]], [aim[2], aim[3]]);
            assert!(a * d - b * c > 0.0);
        }
    }
}
