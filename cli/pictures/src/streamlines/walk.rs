//! One step along the field, from face to face.
//!
//! Within a face the angle is interpolated: at the middle of each edge it is half way to the
//! matching arm across, so that lines bend instead of breaking at every edge. The interpolant is
//! the linear one with these three values (`crouzeix1973`).

use std::f64::consts::FRAC_PI_2;

use roundel::field::OrientationField;
use roundel::mesh::TriangleMesh;
use roundel::mesh::vector::{Vec3, add, cross, dot, norm, scale, sub};

/// A place on the surface, and the arm of the cross there that is followed.
#[derive(Debug, Clone, Copy)]
pub(super) struct Stand {
    face: usize,
    weights: [f64; 3],
    /// Quarter turns from the angle of the field.
    arm: i32,
    /// The corner opposite of the edge over which the face was entered.
    entered: Option<usize>,
}

impl Stand {
    /// The middle of a face.
    pub(super) fn centre(face: usize, arm: i32) -> Stand {
        Stand {
            face,
            weights: [1.0 / 3.0; 3],
            arm,
            entered: None,
        }
    }

    /// The same place, another arm.
    pub(super) fn turned(self, quarters: i32) -> Stand {
        Stand {
            arm: self.arm + quarters,
            entered: None,
            ..self
        }
    }
}

/// The field, ready to be followed.
pub(super) struct Walker<'a> {
    mesh: &'a TriangleMesh,
    field: &'a OrientationField,
    /// For each face and corner what the angle gains at the middle of the opposite edge.
    bend: Vec<[f64; 3]>,
}

impl<'a> Walker<'a> {
    pub(super) fn new(mesh: &'a TriangleMesh, field: &'a OrientationField) -> Self {
        let mut bend = vec![[0.0; 3]; mesh.face_count()];
        for (e, edge) in mesh.edges().enumerate() {
            let ((i, k), Some((j, l))) = (edge.first, edge.second) else {
                continue;
            };
            let jump = FRAC_PI_2 * f64::from(field.period_jumps()[e]);
            let carried = field.angles()[i] + field.kappa()[e] + jump;
            let half = 0.5 * (field.angles()[j] - carried);
            bend[i][(k + 2) % 3] = half;
            bend[j][(l + 2) % 3] = -half;
        }
        Walker { mesh, field, bend }
    }

    pub(super) fn mesh(&self) -> &'a TriangleMesh {
        self.mesh
    }

    pub(super) fn position(&self, stand: &Stand) -> Vec3 {
        let corners = self.mesh.corner_positions(stand.face);
        (0..3).fold([0.0; 3], |sum, k| {
            add(sum, scale(corners[k], stand.weights[k]))
        })
    }

    pub(super) fn normal(&self, stand: &Stand) -> Vec3 {
        self.mesh.normal(stand.face)
    }

    /// The unit vector along the arm.
    pub(super) fn direction(&self, stand: &Stand) -> Vec3 {
        let bend = self.bend[stand.face];
        let bent: f64 = (0..3)
            .map(|k| bend[k] * (1.0 - 2.0 * stand.weights[k]))
            .sum();
        let angle = self.field.angles()[stand.face] + FRAC_PI_2 * f64::from(stand.arm) + bent;
        let [x, y] = self.mesh.frame(stand.face);
        add(scale(x, angle.cos()), scale(y, angle.sin()))
    }

    /// Moves by at most `length`, at most over one edge, and gives the length moved; none where
    /// the way ends: at the boundary, or in a corner into which the field runs from all sides.
    pub(super) fn advance(&self, stand: &mut Stand, length: f64) -> Option<f64> {
        let direction = self.direction(stand);
        let slope = self.slope(stand.face, direction);
        let mut exit: Option<(usize, f64)> = None;
        for (k, &slope) in slope.iter().enumerate() {
            let way = stand.weights[k].max(0.0) / -slope;
            if slope < 0.0 && exit.is_none_or(|(_, least)| way < least) {
                exit = Some((k, way));
            }
        }
        let (opposite, way) = exit?;
        if way >= length {
            self.shift(stand, slope, length);
            stand.entered = None;
            return Some(length);
        }
        if stand.entered == Some(opposite) {
            return self.slide(stand, opposite, direction, length);
        }
        self.shift(stand, slope, way);
        self.cross(stand, opposite)?;
        Some(way)
    }

    /// What the barycentric weights gain on a unit of length in this direction.
    fn slope(&self, face: usize, direction: Vec3) -> [f64; 3] {
        let p = self.mesh.corner_positions(face);
        let normal = self.mesh.normal(face);
        let doubled = 2.0 * self.mesh.area(face);
        [0, 1, 2].map(|k| {
            let opposite = sub(p[(k + 2) % 3], p[(k + 1) % 3]);
            dot(cross(normal, opposite), direction) / doubled
        })
    }

    fn shift(&self, stand: &mut Stand, slope: [f64; 3], length: f64) {
        for (weight, slope) in stand.weights.iter_mut().zip(slope) {
            *weight = (*weight + length * slope).max(0.0);
        }
        let sum: f64 = stand.weights.iter().sum();
        stand.weights = stand.weights.map(|w| w / sum);
    }

    /// Over the edge opposite of a corner into the next face.
    fn cross(&self, stand: &mut Stand, opposite: usize) -> Option<()> {
        let k = (opposite + 1) % 3;
        let (across, l) = self.mesh.neighbor(stand.face, k)?;
        let jump = self.field.period_jumps()[self.mesh.edge_of(stand.face, k)];
        stand.arm -= self.mesh.out_of(stand.face, k, jump);
        // The common edge runs the other way in the other face.
        let (from, to) = (stand.weights[k], stand.weights[(k + 1) % 3]);
        let mut weights = [0.0; 3];
        weights[l] = to;
        weights[(l + 1) % 3] = from;
        let sum = from + to;
        stand.weights = weights.map(|w| w / sum);
        stand.face = across;
        stand.entered = Some((l + 2) % 3);
        Some(())
    }

    /// Along an edge that the field of both faces runs into.
    fn slide(
        &self,
        stand: &mut Stand,
        opposite: usize,
        direction: Vec3,
        length: f64,
    ) -> Option<f64> {
        let (from, to) = ((opposite + 1) % 3, (opposite + 2) % 3);
        let p = self.mesh.corner_positions(stand.face);
        let edge = sub(p[to], p[from]);
        let (from, to) = if dot(edge, direction) < 0.0 {
            (to, from)
        } else {
            (from, to)
        };
        let room = stand.weights[from] * norm(edge);
        let way = length.min(0.5 * room);
        if way < 1e-3 * length {
            return None;
        }
        stand.weights[from] -= way / norm(edge);
        stand.weights[to] += way / norm(edge);
        Some(way)
    }
}
