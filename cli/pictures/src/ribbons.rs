//! Streamlines as flat ribbons on the surface, thin towards their ends.

use super::camera::Camera;
use super::scene::{Scene, Vertex};
use super::shading::Color;
use super::streamlines::Streamline;
use roundel::mesh::vector::{add, cross, norm, normalize, scale, sub};

/// How far ribbons are drawn in front of the surface, as a part of the distance to the eye.
const NEARER: f64 = 0.0015;

/// Adds a streamline of this width, whose ends narrow over `taper`.
pub(super) fn add_ribbon(
    scene: &mut Scene,
    camera: &Camera,
    line: &Streamline,
    color: Color,
    width: f64,
    taper: f64,
) {
    let points = &line.points;
    let mut lengths = vec![0.0; points.len()];
    for i in 1..points.len() {
        let step = norm(sub(points[i].position, points[i - 1].position));
        lengths[i] = lengths[i - 1] + step;
    }
    let total = lengths.last().copied().unwrap_or(0.0);
    let mut last: Option<[u32; 2]> = None;
    for (i, point) in points.iter().enumerate() {
        let next = points[(i + 1).min(points.len() - 1)].position;
        let along = sub(next, points[i.saturating_sub(1)].position);
        let aside = normalize(cross(point.normal, along));
        let to_end = if line.closed {
            taper
        } else {
            lengths[i].min(total - lengths[i])
        };
        let half = 0.5 * width * (0.25 + 0.75 * (to_end / taper).min(1.0));
        let side = |sign: f64| Vertex {
            position: camera.draw_near(add(point.position, scale(aside, sign * half)), NEARER),
            normal: point.normal,
            color,
            sky: 1.0,
        };
        let here = [scene.add(side(1.0)), scene.add(side(-1.0))];
        if let Some([left, right]) = last {
            scene.triangles.push([left, right, here[1]]);
            scene.triangles.push([left, here[1], here[0]]);
        }
        last = Some(here);
    }
}
