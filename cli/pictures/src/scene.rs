//! The scene: triangles with a normal, a colour and a view of the sky at every corner.

use super::camera::Camera;
use super::png::Image;
use super::raster::{Corner, fill};
use super::shading::{Color, Lights, encode};
use roundel::mesh::vector::{Vec3, add, scale};

/// Samples of a pixel in each direction.
const SUPERSAMPLING: usize = 3;
/// Pixel rows drawn at a time, so that the samples of a large image need not all be held.
const STRIP: usize = 64;

/// A corner of a triangle.
#[derive(Debug, Clone, Copy)]
pub(super) struct Vertex {
    pub(super) position: Vec3,
    pub(super) normal: Vec3,
    pub(super) color: Color,
    pub(super) sky: f64,
}

/// Triangles by the numbers of their corners.
#[derive(Debug, Default)]
pub(super) struct Scene {
    pub(super) vertices: Vec<Vertex>,
    pub(super) triangles: Vec<[u32; 3]>,
}

impl Scene {
    /// Adds a corner and gives its number.
    pub(super) fn add(&mut self, vertex: Vertex) -> u32 {
        self.vertices.push(vertex);
        self.vertices.len() as u32 - 1
    }

    /// The scene through a camera, on white.
    pub(super) fn draw(&self, camera: &Camera, width: usize, height: usize) -> Image {
        let samples = SUPERSAMPLING as f64;
        let project = |v: &Vertex| {
            let [x, y, nearness] = camera.project(v.position);
            [samples * x, samples * y, nearness]
        };
        let at: Vec<Corner> = self.vertices.iter().map(project).collect();
        let lights = Lights::with(camera);
        let mut pixels = Vec::with_capacity(3 * width * height);
        for top in (0..height).step_by(STRIP) {
            let rows = STRIP.min(height - top);
            let strip = self.strip(&at, &lights, width * SUPERSAMPLING, top, rows);
            average(&strip, width, rows, &mut pixels);
        }
        Image::new(width, height, pixels)
    }

    /// The samples of some pixel rows.
    fn strip(
        &self,
        at: &[Corner],
        lights: &Lights,
        columns: usize,
        top: usize,
        rows: usize,
    ) -> Vec<Color> {
        let first = top * SUPERSAMPLING;
        let end = first + rows * SUPERSAMPLING;
        let count = columns * (end - first);
        let mut colors = vec![[1.0; 3]; count];
        let mut nearest = vec![0.0f32; count];
        for triangle in &self.triangles {
            let corners = triangle.map(|v| at[v as usize]);
            let outside = |p: &Corner| p[1] < first as f64;
            let below = |p: &Corner| p[1] > end as f64;
            if corners.iter().all(outside) || corners.iter().all(below) {
                continue;
            }
            let vertices = triangle.map(|v| self.vertices[v as usize]);
            fill(&corners, 0..columns, first..end, |x, y, w, nearness| {
                let sample = (y - first) * columns + x;
                if nearness as f32 > nearest[sample] {
                    nearest[sample] = nearness as f32;
                    colors[sample] = shade(&vertices, w, lights);
                }
            });
        }
        colors
    }
}

fn shade(vertices: &[Vertex; 3], w: [f64; 3], lights: &Lights) -> Color {
    let mut normal = [0.0; 3];
    let (mut color, mut sky) = ([0.0f32; 3], 0.0);
    for (vertex, w) in vertices.iter().zip(w) {
        normal = add(normal, scale(vertex.normal, w));
        sky += w * vertex.sky;
        for (sum, c) in color.iter_mut().zip(vertex.color) {
            *sum += w as f32 * c;
        }
    }
    lights.shade(color, normal, sky)
}

/// The mean of the samples of each pixel, encoded.
fn average(samples: &[Color], width: usize, rows: usize, pixels: &mut Vec<u8>) {
    let columns = width * SUPERSAMPLING;
    let share = 1.0 / (SUPERSAMPLING * SUPERSAMPLING) as f32;
    for y in 0..rows {
        for x in 0..width {
            let mut sum = [0.0f32; 3];
            for row in 0..SUPERSAMPLING {
                let start = (y * SUPERSAMPLING + row) * columns + x * SUPERSAMPLING;
                for sample in &samples[start..start + SUPERSAMPLING] {
                    for (s, c) in sum.iter_mut().zip(sample) {
                        *s += c;
                    }
                }
            }
            pixels.extend(sum.map(|s| encode(s * share)));
        }
    }
}
