//! Smaller quads for parts of a mesh that have lost theirs.
//!
//! A component smaller than a few quads may round to nothing, or to quads of another topology. The quads of
//! such components get shorter edges, and all others keep theirs. That is bounded: the shorter edges may add
//! as many quads as were wanted in all, unless there are no quads whatsoever, or none without a vertex
//! that it has twice.

use super::by_component::Components;
use crate::extract::QuadMesh;
use crate::map::Sizing;
use crate::mesh::TriangleMesh;

/// The most times that sizes change.
pub(super) const SIZES: usize = 4;

/// The factor of an edge.
const SHORTER: f64 = 0.5;

/// The least number of quads that a component has room for once its quads were lost.
const LEAST: f64 = 8.0;

/// The sizes with shorter edges where components have no quads, or quads that do not conform; `None` if there
/// are no such components, or too large ones.
pub(super) fn smaller_quads(
    mesh: &TriangleMesh,
    sizing: &Sizing,
    quads: &QuadMesh,
) -> Option<Sizing> {
    let components = Components::new(mesh);
    let of_face = &components.of_face;
    let parts = components.split(mesh, quads);
    let is_lost: Vec<bool> = parts.iter().map(|part| !part.is_conforming()).collect();
    let lengths: Vec<[f64; 2]> = match sizing {
        Sizing::Lengths(lengths) => lengths.clone(),
        Sizing::Graded { quads, lengths } => {
            let squares = |face: usize, length: f64| mesh.area(face) / (length * length);
            let all = lengths.iter().enumerate();
            let all: f64 = all.map(|(face, &length)| squares(face, length)).sum();
            let scale = (all / *quads as f64).sqrt();
            lengths.iter().map(|length| [scale * length; 2]).collect()
        }
        other => vec![[other.edge_length(mesh); 2]; mesh.face_count()],
    };
    let mut room = vec![0.0; components.count];
    let squares = |face: usize, [along, across]: [f64; 2]| mesh.area(face) / (along * across);
    for (face, &pair) in lengths.iter().enumerate() {
        room[of_face[face]] += squares(face, pair);
    }
    let factor = |component: usize| match is_lost[component] {
        true => (room[component] / LEAST).sqrt().min(SHORTER),
        false => 1.0,
    };
    let more = |component: usize| room[component] * (factor(component).powi(-2) - 1.0);
    let (wanted, added) = (0..components.count).fold((0.0, 0.0), |(wanted, added), component| {
        (wanted + room[component], added + more(component))
    });
    let has_none = quads.figures().degenerate == quads.faces().count();
    if added == 0.0 || added > wanted && !has_none {
        return None;
    }
    let shorter = lengths.iter().zip(of_face).map(|(pair, &component)| {
        let factor = factor(component);
        pair.map(|length| factor * length)
    });
    Some(Sizing::Lengths(shorter.collect()))
}

#[cfg(test)]
mod tests {
    use super::super::{QuadOptions, quadrangulate};
    use super::*;
    use crate::extract::Origin;
    use crate::mesh::shape::by_name;
    use crate::monitor::Monitor;

    /// A sphere, and a far smaller one beside it.
    fn unequal() -> TriangleMesh {
        let sphere = by_name("rounded-cube", 600).unwrap();
        let count = sphere.vertex_count() as u32;
        let mut points = sphere.vertices().to_vec();
        let small = sphere.vertices().iter();
        points.extend(small.map(|p| [0.02 * p[0] + 9.0, 0.02 * p[1], 0.02 * p[2]]));
        let mut triangles = sphere.triangles().to_vec();
        let again = sphere.triangles().iter();
        triangles.extend(again.map(|t| t.map(|v| v + count)));
        TriangleMesh::new(points, triangles).unwrap()
    }

    fn made(mesh: &TriangleMesh) -> QuadMesh {
        let options = QuadOptions {
            sizing: Sizing::Quads(200),
            ..QuadOptions::default()
        };
        quadrangulate(mesh, &options, Monitor::default)
            .unwrap()
            .quads
    }

    #[test]
    fn a_component_smaller_than_a_quad_has_quads() {
        let mesh = unequal();
        let quads = made(&mesh);
        assert!(quads.is_conforming());
        assert_eq!(quads.figures().euler, 4);
        assert!((100..400).contains(&quads.quads.len()));
        assert!(smaller_quads(&mesh, &Sizing::Quads(200), &quads).is_none());
    }

    #[test]
    fn what_lost_its_quads_is_known_and_alone_gets_shorter_edges() {
        let mesh = unequal();
        let mut quads = made(&mesh);
        let large = |origin: Origin| match origin {
            Origin::Vertex(v) => v < mesh.vertex_count() / 2,
            Origin::Face(f, _) => f < mesh.face_count() / 2,
            Origin::Middle => true,
        };
        let origins = quads.origins.clone();
        quads.quads.retain(|quad| large(origins[quad[0] as usize]));
        let Some(Sizing::Lengths(lengths)) = smaller_quads(&mesh, &Sizing::Quads(200), &quads)
        else {
            panic!("nothing is lost");
        };
        let edge = Sizing::Quads(200).edge_length(&mesh);
        let (first, second) = lengths.split_at(mesh.face_count() / 2);
        assert!(first.iter().all(|&pair| pair == [edge; 2]));
        assert!(second.iter().all(|pair| pair[0] <= 0.5 * edge));
        quads.quads.clear();
        assert!(smaller_quads(&mesh, &Sizing::Quads(200), &quads).is_some());
    }

    /// Rings round a tube of one quad have its vertex twice.
    #[test]
    fn quads_that_have_a_vertex_twice_are_lost() {
        let mesh = by_name("sphere", 200).unwrap();
        let mut quads = made(&mesh);
        let sizing = Sizing::Quads(600);
        assert!(smaller_quads(&mesh, &sizing, &quads).is_none());
        let ring = |quad: &mut [u32; 4]| *quad = [quad[0], quad[0], quad[1], quad[1]];
        quads.quads.iter_mut().take(1).for_each(ring);
        assert!(smaller_quads(&mesh, &sizing, &quads).is_none());
        quads.quads.iter_mut().for_each(ring);
        assert!(smaller_quads(&mesh, &sizing, &quads).is_some());
    }
}
