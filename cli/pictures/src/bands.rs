//! The picture of a number at every vertex: bands of colour between its contour lines.

use super::camera::Camera;
use super::draw::{View, surface};
use super::png::Image;
use super::scene::{Scene, Vertex};
use super::shading::linear;
use roundel::mesh::TriangleMesh;
use roundel::mesh::vector::{add, scale};
use roundel::{Error, Result};

/// The largest number of bands across one face.
const MOST: f64 = 1e4;

/// A corner of a piece of a face, and its number.
type Corner = (Vertex, f64);

/// Draws a mesh in bands, from each multiple of `width` to the next, of a number that is given at its vertices and
/// linear in its faces. `color` gives the colour of the band around a number, and of infinity, which a face has if
/// one of its corners does.
///
/// # Errors
/// As [`draw_field`](super::draw_field); [`Error::LengthMismatch`] for another number of values;
/// [`Error::InvalidArgument`] for a width that is not positive.
pub fn draw_bands(
    mesh: &TriangleMesh,
    values: &[f64],
    width: f64,
    color: impl Fn(f64) -> [u8; 3],
    view: &View,
) -> Result<Image> {
    view.check()?;
    if values.len() != mesh.vertex_count() {
        return Err(Error::LengthMismatch {
            what: "values of vertices",
            expected: mesh.vertex_count(),
            actual: values.len(),
        });
    }
    if width.is_nan() || width <= 0.0 {
        return Err(Error::InvalidArgument {
            what: format!("bands have a width above 0, not {width}"),
            index: None,
        });
    }
    let size = [view.width as f64, view.height as f64];
    let camera = Camera::fitted(mesh.vertices(), view.from, view.up, size);
    let whole = surface(mesh);
    let mut scene = Scene::default();
    for (f, numbers) in whole.triangles.iter().enumerate() {
        let corners = mesh.corners(f);
        let face = [0, 1, 2].map(|k| (whole.vertices[numbers[k] as usize], values[corners[k]]));
        add_face(&mut scene, &face, width, &color);
    }
    Ok(scene.draw(&camera, view.width, view.height))
}

/// Adds the pieces of a face, one for each band.
fn add_face(scene: &mut Scene, face: &[Corner; 3], width: f64, color: &impl Fn(f64) -> [u8; 3]) {
    let values = face.map(|corner| corner.1);
    let low = values.into_iter().fold(f64::INFINITY, f64::min);
    let high = values.into_iter().fold(f64::NEG_INFINITY, f64::max);
    if !low.is_finite() || !high.is_finite() || (high - low) / width > MOST {
        return add_piece(scene, face, color(high));
    }
    let mut band = (low / width).floor();
    loop {
        let [from, to] = [band, band + 1.0].map(|b| b * width);
        let above = cut(face, |value| value - from);
        let piece = cut(&above, |value| to - value);
        add_piece(scene, &piece, color(0.5 * (from + to)));
        if to >= high {
            break;
        }
        band += 1.0;
    }
}

/// The part of a convex polygon where a linear function of its number is not negative.
fn cut(polygon: &[Corner], height: impl Fn(f64) -> f64) -> Vec<Corner> {
    let mut kept = Vec::with_capacity(polygon.len() + 1);
    for (i, one) in polygon.iter().enumerate() {
        let two = &polygon[(i + 1) % polygon.len()];
        let [a, b] = [one, two].map(|corner| height(corner.1));
        if a >= 0.0 {
            kept.push(*one);
        }
        if (a < 0.0 && b > 0.0) || (a > 0.0 && b < 0.0) {
            kept.push(between(one, two, a / (a - b)));
        }
    }
    kept
}

fn between((one, a): &Corner, (two, b): &Corner, share: f64) -> Corner {
    let mixed = |p, q| add(scale(p, 1.0 - share), scale(q, share));
    let vertex = Vertex {
        position: mixed(one.position, two.position),
        normal: mixed(one.normal, two.normal),
        sky: one.sky + share * (two.sky - one.sky),
        ..*one
    };
    (vertex, a + share * (b - a))
}

fn add_piece(scene: &mut Scene, polygon: &[Corner], color: [u8; 3]) {
    let color = linear(color);
    let added = polygon
        .iter()
        .map(|(vertex, _)| Vertex { color, ..*vertex });
    let numbers: Vec<u32> = added.map(|vertex| scene.add(vertex)).collect();
    if let [first, rest @ ..] = &numbers[..] {
        let pairs = rest.windows(2);
        scene
            .triangles
            .extend(pairs.map(|pair| [*first, pair[0], pair[1]]));
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn pieces_of_a_face_cover_it_and_keep_to_their_bands() {
        let corner = |x: f64, y: f64, value: f64| {
            let vertex = Vertex {
                position: [x, y, 0.0],
                normal: [0.0, 0.0, 1.0],
                color: [0.0; 3],
                sky: 1.0,
            };
            (vertex, value)
        };
        let face = [
            corner(0.0, 0.0, 0.1),
            corner(1.0, 0.0, 0.95),
            corner(0.0, 1.0, 0.4),
        ];
        let mut scene = Scene::default();
        let band = |value: f64| [(100.0 * value).round() as u8; 3];
        add_face(&mut scene, &face, 0.25, &band);
        let mut area = 0.0;
        for triangle in &scene.triangles {
            let [a, b, c] = triangle.map(|v| scene.vertices[v as usize]);
            let [p, q, r] = [a, b, c].map(|v| v.position);
            area += 0.5 * ((q[0] - p[0]) * (r[1] - p[1]) - (q[1] - p[1]) * (r[0] - p[0]));
            // The number at the middle lies in the band of the colour.
            let middle = [0, 1].map(|i| (p[i] + q[i] + r[i]) / 3.0);
            let value = 0.1 + 0.85 * middle[0] + 0.3 * middle[1];
            let expected = (value / 0.25).floor() * 0.25 + 0.125;
            assert_eq!(a.color, linear(band(expected)));
        }
        assert!((area - 0.5).abs() < 1e-15);
    }
}
