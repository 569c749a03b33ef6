//! A field as triangles that any mesh viewer shows.

use super::balls::{balls, unit_sphere};
use roundel::field::OrientationField;
use roundel::mesh::TriangleMesh;
use roundel::mesh::io::Drawing;
use roundel::mesh::vector::{Vec3, add, cross, norm, scale, sub};

const SURFACE: [u8; 3] = [226, 222, 214];
const CROSS: [u8; 3] = [40, 56, 84];
const CONSTRAINED: [u8; 3] = [16, 132, 72];

/// Lengths of an arm from the centroid and half of its width, in radii of the face's inscribed
/// circle; how far crosses float above the face, in the same.
const ARM: f64 = 0.85;
const HALF_WIDTH: f64 = 0.09;
const LIFT: f64 = 0.06;
/// Radius of a ball: in mean edge lengths, but at least this part of the bounding box's diagonal.
const BALL_IN_EDGES: f64 = 0.45;
const BALL_IN_DIAGONALS: f64 = 0.004;

/// The mesh, four arms a face that float just above it, and a ball at every irregular vertex,
/// coloured by vertex. Crosses of constrained faces are green, others dark blue; balls are red
/// for an index of 1/4, blue for -1/4, amber for all others.
///
/// The first vertices and triangles are those of the mesh, in its order; 8 vertices and 6
/// triangles for each face's cross follow, then the balls.
#[derive(Debug, Clone, PartialEq)]
pub struct FieldModel {
    vertices: Vec<Vec3>,
    triangles: Vec<[u32; 3]>,
    colors: Vec<[u8; 3]>,
}

impl FieldModel {
    /// The model of a field on its mesh.
    pub fn new(mesh: &TriangleMesh, field: &OrientationField) -> FieldModel {
        let mut model = FieldModel {
            vertices: mesh.vertices().to_vec(),
            triangles: mesh.triangles().to_vec(),
            colors: vec![SURFACE; mesh.vertex_count()],
        };
        for face in 0..mesh.face_count() {
            let color = match field.constrained()[face] {
                true => CONSTRAINED,
                false => CROSS,
            };
            model.add_cross(mesh, face, field.angles()[face], color);
        }
        let [low, high] = mesh.bounding_box();
        let radius =
            (BALL_IN_EDGES * mesh.mean_edge_length()).max(BALL_IN_DIAGONALS * norm(sub(high, low)));
        let (sphere, faces) = unit_sphere(4);
        for ball in balls(mesh, field) {
            let points = sphere.iter().map(|&towards| ball.point(radius, towards));
            model.add(points, &faces, ball.color);
        }
        model
    }

    /// To be written by [`write`](roundel::mesh::io::write).
    pub fn drawing(&self) -> Drawing<'_> {
        Drawing {
            vertices: &self.vertices,
            triangles: &self.triangles,
            vertex_colors: Some(&self.colors),
            ..Drawing::default()
        }
    }

    fn add_cross(&mut self, mesh: &TriangleMesh, face: usize, angle: f64, color: [u8; 3]) {
        let around: f64 = (0..3).map(|k| mesh.edge_length(face, k)).sum();
        let unit = 2.0 * mesh.area(face) / around;
        let normal = mesh.normal(face);
        let [x, y] = mesh.frame(face);
        let arm = add(scale(x, angle.cos()), scale(y, angle.sin()));
        let across = cross(normal, arm);
        let centre = add(incentre(mesh, face, around), scale(normal, LIFT * unit));
        let at = |a: f64, b: f64| {
            let aside = add(scale(arm, a * unit), scale(across, b * unit));
            add(centre, aside)
        };
        let (a, h) = (ARM, HALF_WIDTH);
        // Tips and, between them, the corners where the arms meet.
        let points = [
            at(a, 0.0),
            at(h, h),
            at(0.0, a),
            at(-h, h),
            at(-a, 0.0),
            at(-h, -h),
            at(0.0, -a),
            at(h, -h),
        ];
        let faces = [
            [7, 0, 1],
            [1, 2, 3],
            [3, 4, 5],
            [5, 6, 7],
            [1, 3, 5],
            [1, 5, 7],
        ];
        self.add(points.into_iter(), &faces, color);
    }

    fn add(&mut self, points: impl Iterator<Item = Vec3>, faces: &[[u32; 3]], color: [u8; 3]) {
        let first = self.vertices.len() as u32;
        self.vertices.extend(points);
        self.colors.resize(self.vertices.len(), color);
        let numbered = faces.iter().map(|face| face.map(|v| first + v));
        self.triangles.extend(numbered);
    }
}

/// The centre of the inscribed circle, which leaves an arm the most room in every direction.
fn incentre(mesh: &TriangleMesh, face: usize, around: f64) -> Vec3 {
    let p = mesh.corner_positions(face);
    (0..3).fold([0.0; 3], |sum, k| {
        // The weight of a corner is the length of the edge opposite.
        let weight = mesh.edge_length(face, (k + 1) % 3) / around;
        add(sum, scale(p[k], weight))
    })
}
