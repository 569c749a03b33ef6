//! The picture of a field: surface, streamlines and balls.

use super::ambient::sky_visible;
use super::balls::{balls, unit_sphere};
use super::camera::Camera;
use super::normals::corner_normals;
use super::png::Image;
use super::ribbons::add_ribbon;
use super::scene::{Scene, Vertex};
use super::shading::linear;
use super::streamlines::streamlines;
use roundel::field::OrientationField;
use roundel::mesh::TriangleMesh;
use roundel::mesh::vector::{Vec3, add, normalize};
use roundel::{Error, Result};

const SURFACE: [u8; 3] = [246, 239, 226];
const LINE: [u8; 3] = [66, 88, 120];
/// The target number of squares between streamlines: enough to show the field, few enough to tell
/// lines apart.
const SQUARES: f64 = 3600.0;
/// Of a streamline and of a ball, in distances between streamlines.
const LINE_WIDTH: f64 = 0.14;
/// Over which a streamline narrows to its ends, in the same.
const TAPER: f64 = 0.6;
const BALL_RADIUS: f64 = 0.5;
/// The largest image, in pixels a side.
const LARGEST: usize = 8_192;

/// Size of the image, and where it is seen from.
#[derive(Debug, Clone, PartialEq)]
pub struct View {
    /// Width in pixels, 1 to 8192.
    pub width: usize,
    /// Height in pixels, 1 to 8192.
    pub height: usize,
    /// From the mesh towards the eye.
    pub from: [f64; 3],
    /// The direction that points upwards on the image.
    pub up: [f64; 3],
}

/// 1600 x 1200, three quarters from the front with y upwards.
impl Default for View {
    fn default() -> Self {
        View {
            width: 1600,
            height: 1200,
            from: [0.55, 0.42, 0.8],
            up: [0.0, 1.0, 0.0],
        }
    }
}

/// Draws a field on its mesh.
///
/// # Errors
/// [`Error::InvalidArgument`] for a size outside 1 to 8192, and for directions that are null, not
/// finite or parallel to each other.
pub fn draw_field(mesh: &TriangleMesh, field: &OrientationField, view: &View) -> Result<Image> {
    view.check()?;
    let size = [view.width as f64, view.height as f64];
    let camera = Camera::fitted(mesh.vertices(), view.from, view.up, size);
    let spacing = (mesh.surface_area() / SQUARES).sqrt();
    let mut scene = surface(mesh);
    for line in streamlines(mesh, field, spacing) {
        let color = linear(LINE);
        add_ribbon(
            &mut scene,
            &camera,
            &line,
            color,
            LINE_WIDTH * spacing,
            TAPER * spacing,
        );
    }
    let (sphere, faces) = unit_sphere(8);
    for ball in balls(mesh, field) {
        let first = scene.vertices.len() as u32;
        scene.vertices.extend(sphere.iter().map(|&towards| Vertex {
            position: ball.point(BALL_RADIUS * spacing, towards),
            normal: towards,
            color: linear(ball.color),
            sky: 1.0,
        }));
        let faces = faces.iter().map(|face| face.map(|v| first + v));
        scene.triangles.extend(faces);
    }
    Ok(scene.draw(&camera, view.width, view.height))
}

/// The mesh with smooth normals and the sky that it leaves visible.
pub(super) fn surface(mesh: &TriangleMesh) -> Scene {
    let normals = corner_normals(mesh);
    let mean = |v: usize| -> Vec3 {
        normalize(
            mesh.ring(v)
                .fold([0.0; 3], |sum, (f, k)| add(sum, normals[f][k])),
        )
    };
    let vertex_normals: Vec<Vec3> = (0..mesh.vertex_count()).map(mean).collect();
    let sky = sky_visible(mesh, &vertex_normals);
    let mut scene = Scene::default();
    for (f, normals) in normals.iter().enumerate() {
        let corners = mesh.corners(f);
        let vertex = |k: usize| Vertex {
            position: mesh.position(corners[k]),
            normal: normals[k],
            color: linear(SURFACE),
            sky: sky[corners[k]],
        };
        let numbers = [0, 1, 2].map(|k| scene.add(vertex(k)));
        scene.triangles.push(numbers);
    }
    scene
}

impl View {
    pub(super) fn check(&self) -> Result<()> {
        let refuse = |what: String| Err(Error::InvalidArgument { what, index: None });
        for side in [self.width, self.height] {
            if !(1..=LARGEST).contains(&side) {
                return refuse(format!(
                    "a picture {side} pixels wide or high: 1 to {LARGEST}"
                ));
            }
        }
        let sine = roundel::mesh::vector::norm(roundel::mesh::vector::cross(
            normalize(self.from),
            normalize(self.up),
        ));
        if sine.is_nan() || sine < 1e-6 {
            return refuse("the view's direction and its upward direction span no plane".into());
        }
        Ok(())
    }
}
