//! Vertices of a layout on a surface: each becomes the vertex of the mesh at its closest point.

use std::collections::HashMap;

use super::surface::{NONE, Surface};
use crate::error::{Error, Result};
use crate::layout::base_layout::BaseLayout;
use crate::mesh::refine::diagonal;
use crate::mesh::vector::{Vec3, add, cross, dot, norm, scale, sub};
use crate::mesh::{ClosestPoint, TriangleMesh};

/// A node is put at a corner or on an edge of its face that is nearer than this share of the face.
const SNAP: f64 = 0.08;

/// How far a vertex of a layout may be off the surface, as a part of the diagonal of the bounding box.
const REACH: f64 = 0.5;

/// The vertex of the surface for each vertex of the layout, all different. Some are `known`.
///
/// # Errors
/// [`Error::InvalidArgument`] with the vertex that is too far off the surface, or on a boundary that the surface does
/// not have.
pub(in crate::layout) fn place_nodes(
    mesh: &TriangleMesh,
    layout: &BaseLayout,
    known: &[Option<u32>],
    surface: &mut Surface,
) -> Result<Vec<u32>> {
    let inside = ClosestPoint::new(mesh);
    let border: Vec<u32> = (0..3 * mesh.face_count() as u32)
        .filter(|&half| surface.twin[half as usize] == NONE)
        .collect();
    let segments = border.iter().map(|&half| {
        let [a, b] = [surface.tail(half), surface.tip(half)].map(|v| surface.position(v));
        [a, b, b]
    });
    let boundary = ClosestPoint::of_triangles(segments.collect());
    let reach = REACH * diagonal(mesh);
    let mut parts = Parts::default();
    let mut nodes = Vec::with_capacity(layout.vertex_count());
    known
        .iter()
        .flatten()
        .for_each(|&v| surface.is_taken[v as usize] = true);
    for (number, &p) in layout.positions().iter().enumerate() {
        if let Some(node) = known[number] {
            nodes.push(node);
            continue;
        }
        let is_border = layout.is_boundary_vertex(number);
        let found = match is_border {
            true => boundary.find(p, None),
            false => foot(&inside, mesh, layout, number),
        };
        let refuse = |what: String| {
            Err(Error::InvalidArgument {
                what,
                index: Some(number),
            })
        };
        let Some((place, q)) = found else {
            return refuse(format!(
                "vertex {number} of the layout is on a boundary, but the mesh has none"
            ));
        };
        let off = norm(sub(q, p));
        if off > reach {
            return refuse(format!(
                "vertex {number} of the layout is {off:.3e} off the surface, more than half of the diagonal of \
                 its bounding box"
            ));
        }
        parts.update(surface);
        let face = if is_border {
            border[place] / 3
        } else {
            place as u32
        };
        let node = match is_border {
            true => parts.on_boundary(surface, face, q),
            false => parts.inside(surface, face, q),
        };
        surface.is_taken[node as usize] = true;
        nodes.push(node);
    }
    Ok(nodes)
}

/// The face and the point on it for a vertex of a layout. That is the closest point to the vertex, or to where
/// subdivision moves it where that is nearer to the surface: the layout is then a control mesh. On thin parts the
/// surface faces as the layout does, if it does so within half of the shortest arc.
fn foot(
    inside: &ClosestPoint,
    mesh: &TriangleMesh,
    layout: &BaseLayout,
    vertex: usize,
) -> Option<(usize, Vec3)> {
    let (own, moved) = (layout.positions()[vertex], layout.subdivided(vertex));
    let (normal, shortest) = (layout.normal(vertex), layout.shortest_arc_at(vertex));
    let faces_alike = |face: usize| dot(mesh.normal(face), normal) > 0.0;
    // A neighbour far off the surface moves it anywhere.
    let is_near = norm(sub(moved, own)) < shortest;
    let found = [Some(own), is_near.then_some(moved)].map(|p| {
        let p = p?;
        let alike = inside.find_wanted(p, 0.5 * shortest, faces_alike);
        let (face, q) = alike.or_else(|| inside.find(p, None))?;
        Some((norm(sub(q, p)), face, q))
    });
    let nearest = found
        .into_iter()
        .flatten()
        .min_by(|a, b| a.0.total_cmp(&b.0));
    nearest.map(|(_, face, q)| (face, q))
}

/// The point of a mesh for each vertex of a layout.
pub(in crate::layout) fn feet(mesh: &TriangleMesh, layout: &BaseLayout) -> Vec<Vec3> {
    let inside = ClosestPoint::new(mesh);
    let vertices = 0..layout.vertex_count();
    let found = vertices.map(|v| foot(&inside, mesh, layout, v));
    let positions = layout.positions().iter();
    found
        .zip(positions)
        .map(|(found, &p)| found.map_or(p, |(_, q)| q))
        .collect()
}

/// The parts that faces have been split into.
#[derive(Default)]
struct Parts {
    of: HashMap<u32, Vec<u32>>,
    noted: usize,
}

impl Parts {
    fn update(&mut self, surface: &Surface) {
        for face in self.noted..surface.triangles.len() {
            let origin = surface.origin[face];
            if origin != face as u32 {
                self.of
                    .entry(origin)
                    .or_insert_with(|| vec![origin])
                    .push(face as u32);
            }
        }
        self.noted = surface.triangles.len();
    }

    fn of_face(&self, face: u32) -> &[u32] {
        self.of.get(&face).map_or(&[], Vec::as_slice)
    }

    /// A free vertex at a point of a face, or as near as other nodes leave room.
    fn inside(&self, surface: &mut Surface, face: u32, q: Vec3) -> u32 {
        let whole = [face];
        let parts = match self.of_face(face) {
            [] => &whole[..],
            parts => parts,
        };
        let least = |part: u32| {
            let weights = weights(surface.corners(part), q);
            weights.into_iter().fold(f64::INFINITY, f64::min)
        };
        let part = parts
            .iter()
            .copied()
            .max_by(|&a, &b| least(a).total_cmp(&least(b)));
        let part = part.unwrap_or(face);
        let corners = surface.triangles[part as usize];
        let mut at = weights(surface.corners(part), q).map(|w| w.clamp(0.0, 1.0));
        let nearest = (0..3).fold(0, |best, k| if at[k] > at[best] { k } else { best });
        if at[nearest] > 1.0 - SNAP {
            if !surface.is_taken[corners[nearest] as usize] {
                return corners[nearest];
            }
            // Another node is there.
            at = [0.25; 3];
            at[nearest] = 0.5;
        }
        let flat = (0..3).fold(0, |best, k| if at[k] < at[best] { k } else { best });
        if at[flat] < SNAP {
            // The edge opposite to that corner.
            let half = 3 * part + (flat as u32 + 1) % 3;
            let [a, b] = [at[(flat + 1) % 3], at[(flat + 2) % 3]];
            let [p, r] = [surface.tail(half), surface.tip(half)].map(|v| surface.position(v));
            return surface.split_edge(half, add(scale(p, a / (a + b)), scale(r, b / (a + b))));
        }
        let corners = surface.corners(part);
        let sum: f64 = at.iter().sum();
        let terms = [0, 1, 2].map(|k| scale(corners[k], at[k] / sum));
        surface.split_face(part, add(add(terms[0], terms[1]), terms[2]))
    }

    /// A free vertex of the boundary at a point of an edge of a face there.
    fn on_boundary(&self, surface: &mut Surface, face: u32, q: Vec3) -> u32 {
        let whole = [face];
        let parts = match self.of_face(face) {
            [] => &whole[..],
            parts => parts,
        };
        let halves = parts.iter().flat_map(|&part| 3 * part..3 * part + 3);
        let border = halves.filter(|&half| surface.twin[half as usize] == NONE);
        let share = |half: u32| {
            let [a, b] = [surface.tail(half), surface.tip(half)].map(|v| surface.position(v));
            let along = sub(b, a);
            let t = (dot(sub(q, a), along) / dot(along, along)).clamp(0.0, 1.0);
            (norm(sub(add(a, scale(along, t)), q)), t)
        };
        let nearest = border.min_by(|&a, &b| share(a).0.total_cmp(&share(b).0));
        let half = nearest.unwrap_or(3 * face);
        let [a, b] = [surface.tail(half), surface.tip(half)];
        let mut t = share(half).1;
        for (end, is_near) in [(a, t < SNAP), (b, t > 1.0 - SNAP)] {
            if is_near {
                if !surface.is_taken[end as usize] {
                    return end;
                }
                t = if end == a { 0.25 } else { 0.75 };
            }
        }
        let [p, r] = [a, b].map(|v| surface.position(v));
        surface.split_edge(half, add(p, scale(sub(r, p), t)))
    }
}

/// The weights of the corners of a triangle at the foot of a point in its plane, some below 0 outside of it. Equal for a
/// triangle without area.
fn weights([a, b, c]: [Vec3; 3], p: Vec3) -> [f64; 3] {
    let normal = cross(sub(b, a), sub(c, a));
    let of = |u: Vec3, v: Vec3| dot(cross(sub(u, p), sub(v, p)), normal);
    let parts = [of(b, c), of(c, a), of(a, b)];
    let square = dot(normal, normal);
    match square > 0.0 {
        true => parts.map(|part| part / square),
        false => [1.0 / 3.0; 3],
    }
}

/// Whether most polygons of a layout face the other way than the surface under them.
pub(in crate::layout) fn is_turned_over(mesh: &TriangleMesh, layout: &BaseLayout) -> bool {
    let closest = ClosestPoint::new(mesh);
    let polygons = 0..layout.polygons().len();
    let agreement: f64 = polygons
        .filter_map(|p| {
            let (face, _) = closest.find(layout.centroid(p), None)?;
            Some(dot(layout.area_vector(p), mesh.normal(face)))
        })
        .sum();
    agreement < 0.0
}
