//! Ambient light: the share of the sky that each vertex sees.
//!
//! The surface is drawn into depth maps from directions spread over the sphere. A vertex sees a direction if
//! it is nearest in the depth map of that direction. This needs only the existing rasteriser, no ray tracing
//! and no search structure.

use super::raster::fill;
use roundel::mesh::TriangleMesh;
use roundel::mesh::vector::{Vec3, add, cross, dot, normalize, scale, sub};

/// Directions of the sky.
const DIRECTIONS: usize = 64;
/// Width and height of a depth map.
const SIZE: usize = 320;
/// The largest distance behind the surface, in pixels of the depth map, that counts as on it.
const BIAS: f64 = 2.0;

/// For each vertex the visible part of the half of the sky above it, weighted by the cosine.
pub(super) fn sky_visible(mesh: &TriangleMesh, normals: &[Vec3]) -> Vec<f64> {
    let [low, high] = mesh.bounding_box();
    let middle = scale(add(low, high), 0.5);
    let diagonal = sub(high, low);
    let unit = SIZE as f64 / dot(diagonal, diagonal).sqrt() * 0.98;
    let (mut seen, mut total) = (vec![0.0; normals.len()], vec![0.0; normals.len()]);
    for k in 0..DIRECTIONS {
        let towards = on_sphere(k);
        let right = normalize(cross(
            if towards[2].abs() < 0.9 {
                [0.0, 0.0, 1.0]
            } else {
                [1.0, 0.0, 0.0]
            },
            towards,
        ));
        let axes = [right, cross(towards, right)];
        let project = |&p: &Vec3| {
            let p = scale(sub(p, middle), unit);
            let half = 0.5 * SIZE as f64;
            [
                dot(p, axes[0]) + half,
                dot(p, axes[1]) + half,
                dot(p, towards),
            ]
        };
        let at: Vec<[f64; 3]> = mesh.vertices().iter().map(project).collect();
        let map = depth_map(mesh, &at);
        for (v, normal) in normals.iter().enumerate() {
            let cosine = dot(*normal, towards);
            if cosine <= 0.0 {
                continue;
            }
            total[v] += cosine;
            let [x, y] = [at[v][0], at[v][1]].map(|c| c.clamp(0.0, SIZE as f64 - 1.0) as usize);
            // What is seen at a slant falls off by more than the bias within a pixel.
            if at[v][2] + BIAS / cosine.max(0.2) >= f64::from(map[y * SIZE + x]) {
                seen[v] += cosine;
            }
        }
    }
    let visible: Vec<f64> = (0..seen.len())
        .map(|v| {
            if total[v] > 0.0 {
                seen[v] / total[v]
            } else {
                1.0
            }
        })
        .collect();
    blurred(mesh, &blurred(mesh, &visible))
}

fn depth_map(mesh: &TriangleMesh, at: &[[f64; 3]]) -> Vec<f32> {
    let mut map = vec![f32::NEG_INFINITY; SIZE * SIZE];
    for corners in mesh.triangles() {
        let corners = corners.map(|v| at[v as usize]);
        fill(&corners, 0..SIZE, 0..SIZE, |x, y, _, nearness| {
            let held = &mut map[y * SIZE + x];
            *held = held.max(nearness as f32);
        });
    }
    map
}

/// Evenly spread directions: a spiral from pole to pole in golden angles.
fn on_sphere(k: usize) -> Vec3 {
    let z = 1.0 - (2 * k + 1) as f64 / DIRECTIONS as f64;
    let radius = (1.0 - z * z).sqrt();
    let turn = k as f64 * std::f64::consts::PI * (3.0 - 5f64.sqrt());
    [radius * turn.cos(), radius * turn.sin(), z]
}

/// The mean of each vertex and its neighbours, against the grain of the pixels.
fn blurred(mesh: &TriangleMesh, values: &[f64]) -> Vec<f64> {
    let mut sum = values.to_vec();
    let mut count = vec![1.0; values.len()];
    for edge in mesh.edges() {
        let [a, b] = edge.vertices;
        sum[a] += values[b];
        sum[b] += values[a];
        count[a] += 1.0;
        count[b] += 1.0;
    }
    sum.iter().zip(count).map(|(s, n)| s / n).collect()
}
