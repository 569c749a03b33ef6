//! The picture of quads: faces, edges, and irregular vertices as balls.

use super::ambient::sky_visible;
use super::balls::{NEGATIVE, OTHER, POSITIVE, unit_sphere};
use super::camera::Camera;
use super::draw::View;
use super::png::Image;
use super::scene::{Scene, Vertex};
use super::shading::linear;
use roundel::Result;
use roundel::extract::QuadMesh;
use roundel::mesh::TriangleMesh;
use roundel::mesh::vector::{Vec3, add, cross, norm, normalize, scale, sub};

const QUAD: [u8; 3] = [236, 240, 242];
/// A face that is no quad.
const FACE: [u8; 3] = [184, 31, 196];
const EDGE: [u8; 3] = [23, 34, 45];
/// Of an edge and of a ball, in mean lengths of edges.
const EDGE_WIDTH: f64 = 0.075;
const BALL_RADIUS: f64 = 0.2;
/// The least of both, in parts of the longer side of the picture.
const LEAST_WIDTH: f64 = 1.0 / 900.0;
const LEAST_RADIUS: f64 = 1.0 / 220.0;
/// How far edges are drawn in front of the faces, as a part of the distance to the eye.
const NEARER: f64 = 0.0012;

/// An edge of faces.
struct Edge {
    ends: [u32; 2],
    /// The sum of the areas of its faces, as vectors.
    normal: Vec3,
    faces: usize,
}

/// Draws quads. Irregular vertices are balls: red with one edge too few, blue with one too many, amber otherwise. Faces
/// that are no quads are purple.
///
/// # Errors
/// As [`draw_field`](super::draw_field).
pub fn draw_quads(quads: &QuadMesh, view: &View) -> Result<Image> {
    view.check()?;
    let size = [view.width as f64, view.height as f64];
    let camera = Camera::fitted(&quads.vertices, view.from, view.up, size);
    let areas: Vec<Vec3> = quads.faces().map(|face| area(quads, face)).collect();
    let mut scene = faces(quads, &areas);
    let edges = edges(quads, &areas);
    let length = |edge: &Edge| norm(sub(place(quads, edge.ends[1]), place(quads, edge.ends[0])));
    let mean = edges.iter().map(length).sum::<f64>() / edges.len().max(1) as f64;
    let pixel = diagonal(&quads.vertices);
    let width = (EDGE_WIDTH * mean).max(LEAST_WIDTH * pixel);
    for edge in &edges {
        add_edge(&mut scene, &camera, quads, edge, width);
    }
    let radius = (BALL_RADIUS * mean).max(LEAST_RADIUS * pixel);
    add_balls(&mut scene, quads, &edges, radius);
    Ok(scene.draw(&camera, view.width, view.height))
}

fn place(quads: &QuadMesh, vertex: u32) -> Vec3 {
    quads.vertices[vertex as usize]
}

fn diagonal(points: &[Vec3]) -> f64 {
    let extent = |axis: usize| {
        let along = points.iter().map(|p| p[axis]);
        along.clone().fold(f64::MIN, f64::max) - along.fold(f64::MAX, f64::min)
    };
    norm([0, 1, 2].map(extent))
}

/// The area of a face as a vector: the normal of its mean plane, as long as the area.
fn area(quads: &QuadMesh, face: &[u32]) -> Vec3 {
    let first = place(quads, face[0]);
    let fan = face[1..].windows(2).map(|ends| {
        let [a, b] = [ends[0], ends[1]].map(|v| sub(place(quads, v), first));
        cross(a, b)
    });
    scale(fan.fold([0.0; 3], add), 0.5)
}

/// The faces, with the sky that each vertex sees where the quads are a surface.
fn faces(quads: &QuadMesh, areas: &[Vec3]) -> Scene {
    let mut normals = vec![[0.0; 3]; quads.vertices.len()];
    let mut halves = Vec::with_capacity(2 * areas.len());
    for (face, &area) in quads.faces().zip(areas) {
        for &v in face {
            normals[v as usize] = add(normals[v as usize], area);
        }
        halves.extend(face[1..].windows(2).map(|ends| [face[0], ends[0], ends[1]]));
    }
    let normals: Vec<Vec3> = normals.into_iter().map(normalize).collect();
    let sky = match TriangleMesh::new(quads.vertices.clone(), halves) {
        Ok(mesh) => sky_visible(&mesh, &normals),
        Err(_) => vec![1.0; quads.vertices.len()],
    };
    let mut scene = Scene::default();
    for (face, &area) in quads.faces().zip(areas) {
        let color = linear(if face.len() == 4 { QUAD } else { FACE });
        let corner = |&v: &u32| Vertex {
            position: place(quads, v),
            normal: normalize(area),
            color,
            sky: sky[v as usize],
        };
        let numbers: Vec<u32> = face.iter().map(|v| scene.add(corner(v))).collect();
        let halves = numbers[1..].windows(2);
        let halves = halves.map(|ends| [numbers[0], ends[0], ends[1]]);
        scene.triangles.extend(halves);
    }
    scene
}

/// The edges of all faces, in increasing order of their ends.
fn edges(quads: &QuadMesh, areas: &[Vec3]) -> Vec<Edge> {
    let mut sides: Vec<([u32; 2], usize)> = Vec::with_capacity(4 * areas.len());
    for (number, face) in quads.faces().enumerate() {
        for (k, &a) in face.iter().enumerate() {
            let b = face[(k + 1) % face.len()];
            sides.push(([a.min(b), a.max(b)], number));
        }
    }
    sides.sort_unstable();
    let edge = |sides: &[([u32; 2], usize)]| Edge {
        ends: sides[0].0,
        normal: sides
            .iter()
            .fold([0.0; 3], |sum, side| add(sum, areas[side.1])),
        faces: sides.len(),
    };
    sides.chunk_by(|a, b| a.0 == b.0).map(edge).collect()
}

fn add_edge(scene: &mut Scene, camera: &Camera, quads: &QuadMesh, edge: &Edge, width: f64) {
    let ends = edge.ends.map(|v| place(quads, v));
    let normal = normalize(edge.normal);
    let aside = scale(normalize(cross(normal, sub(ends[1], ends[0]))), 0.5 * width);
    let mut corner = |end: Vec3, sign: f64| {
        scene.add(Vertex {
            position: camera.draw_near(add(end, scale(aside, sign)), NEARER),
            normal,
            color: linear(EDGE),
            sky: 1.0,
        })
    };
    let [a, b] = [1.0, -1.0].map(|sign| corner(ends[0], sign));
    let [c, d] = [1.0, -1.0].map(|sign| corner(ends[1], sign));
    scene.triangles.extend([[a, c, b], [c, d, b]]);
}

/// Adds a ball at every vertex with other than four edges, or three on the boundary.
fn add_balls(scene: &mut Scene, quads: &QuadMesh, edges: &[Edge], radius: f64) {
    let mut valence = vec![0_i64; quads.vertices.len()];
    let mut regular = vec![4; quads.vertices.len()];
    for edge in edges {
        for v in edge.ends {
            valence[v as usize] += 1;
            if edge.faces == 1 {
                regular[v as usize] = 3;
            }
        }
    }
    let (sphere, faces) = unit_sphere(5);
    for (v, &valence) in valence
        .iter()
        .enumerate()
        .filter(|&(v, &n)| n != regular[v])
    {
        let color = match regular[v] - valence {
            1 => POSITIVE,
            -1 => NEGATIVE,
            _ => OTHER,
        };
        let first = scene.vertices.len() as u32;
        scene.vertices.extend(sphere.iter().map(|&towards| Vertex {
            position: add(quads.vertices[v], scale(towards, radius)),
            normal: towards,
            color: linear(color),
            sky: 1.0,
        }));
        let faces = faces.iter().map(|face| face.map(|v| first + v));
        scene.triangles.extend(faces);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A cube of six quads, with the first as two triangles if asked for.
    fn cube(split: bool) -> QuadMesh {
        let sides = [
            [0, 2, 3, 1],
            [4, 5, 7, 6],
            [0, 1, 5, 4],
            [2, 6, 7, 3],
            [0, 4, 6, 2],
            [1, 3, 7, 5],
        ];
        let others = match split {
            true => vec![vec![0, 2, 3], vec![0, 3, 1]],
            false => Vec::new(),
        };
        let corner = |v: usize| [0, 1, 2].map(|axis| (v >> axis & 1) as f64);
        let quads = sides[usize::from(split)..].to_vec();
        QuadMesh {
            others,
            ..QuadMesh::from_quads((0..8).map(corner).collect(), quads, 2)
        }
    }

    fn pixels_like(image: &Image, is_like: impl Fn(&[u8]) -> bool) -> usize {
        image
            .pixels()
            .chunks(3)
            .filter(|pixel| is_like(pixel))
            .count()
    }

    #[test]
    fn corners_of_a_cube_are_red_and_edges_are_dark() {
        let view = View {
            width: 200,
            height: 160,
            ..View::default()
        };
        let image = draw_quads(&cube(false), &view).unwrap();
        let red = |p: &[u8]| p[0] > 2 * p[1] && p[0] > 2 * p[2];
        let dark = |p: &[u8]| p.iter().all(|&x| x < 80);
        let light = |p: &[u8]| p.iter().all(|&x| x > 110 && x < 250);
        assert!(pixels_like(&image, red) > 300);
        assert!(pixels_like(&image, dark) > 500);
        assert!(pixels_like(&image, light) > 5_000);
        assert_eq!(image, draw_quads(&cube(false), &view).unwrap());
        // Seen from where the face that is divided is.
        let from_below = View {
            from: [0.3, 0.4, -1.0],
            ..view
        };
        let purple = |p: &[u8]| p[0] > 2 * p[1] && p[2] > 2 * p[1];
        let image = draw_quads(&cube(true), &from_below).unwrap();
        assert!(pixels_like(&image, purple) > 2_000);
    }
}
