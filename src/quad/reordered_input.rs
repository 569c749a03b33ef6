//! A mesh whose neighbours are far apart in memory, in a better order: what is given for its elements, there, and
//! the result, as if nothing had been done.

use super::{QuadOptions, Quadrangulation};
use crate::error::Result;
use crate::extract::{Origin, QuadMesh};
use crate::mesh::features::FeatureGraph;
use crate::mesh::{Reordered, TriangleMesh};
use crate::monitor::both;
use crate::smooth::SmoothOptions;

/// A mesh in another order, and everything that was given for it.
pub(super) struct ReorderedInput {
    reordered: Reordered,
    pub features: FeatureGraph,
    pub options: QuadOptions,
}

impl ReorderedInput {
    /// The input in a [better order](Reordered::if_scattered), if the mesh needs it, and if the options name only
    /// elements that it has: an error names what the caller knows.
    ///
    /// # Errors
    /// Those of [`Reordered::if_scattered`].
    pub fn new(
        mesh: &TriangleMesh,
        features: &FeatureGraph,
        options: &QuadOptions,
    ) -> Result<Option<Self>> {
        if !is_in_range(mesh, options) {
            return Ok(None);
        }
        match Reordered::if_scattered(mesh)? {
            Some(reordered) => Self::on(mesh, features, options, reordered).map(Some),
            None => Ok(None),
        }
    }

    fn on(
        mesh: &TriangleMesh,
        features: &FeatureGraph,
        options: &QuadOptions,
        reordered: Reordered,
    ) -> Result<Self> {
        let edges = |edges: &[usize]| reordered.places_of_edges(mesh, edges);
        let features: Vec<usize> = (0..mesh.edge_count())
            .filter(|&e| features.contains(e))
            .collect();
        let options = QuadOptions {
            guidance: options.guidance.in_order(mesh, &reordered),
            sizing: options.sizing.on_faces(reordered.faces()),
            density: match options.density.is_empty() {
                true => Vec::new(),
                false => reordered.of_vertices(&options.density),
            },
            near_vertices: reordered.places_of_vertices(&options.near_vertices),
            smooth: options.smooth.as_ref().map(|given| SmoothOptions {
                features: edges(&given.features),
                ..given.clone()
            }),
            ..options.clone()
        };
        Ok(ReorderedInput {
            features: FeatureGraph::from_edges(&reordered.mesh, &edges(&features))?,
            options,
            reordered,
        })
    }

    /// The mesh in its new order.
    pub fn mesh(&self) -> &TriangleMesh {
        &self.reordered.mesh
    }

    /// The result for `given`, the mesh as it was.
    pub fn result_for(&self, given: &TriangleMesh, made: Quadrangulation) -> Quadrangulation {
        let faces = |faces: &[usize]| self.reordered.given_faces(faces);
        let edges = |edges: &[usize]| self.reordered.given_edges(given, edges);
        let origin = |origin: &Origin| match *origin {
            Origin::Vertex(vertex) => Origin::Vertex(self.reordered.vertex(vertex)),
            Origin::Face(face, weights) => Origin::Face(self.reordered.face(face), weights),
            Origin::Middle => Origin::Middle,
        };
        let (quads, untangled) = (made.quads, made.untangled);
        let (field, map) = both(
            true,
            || made.field.on_given(&self.reordered, given),
            || untangled.map.on_given(&self.reordered, given),
        );
        Quadrangulation {
            quads: QuadMesh {
                origins: quads.origins.iter().map(origin).collect(),
                folded: faces(&quads.folded),
                ..quads
            },
            field,
            untangled: untangled.on_given(&self.reordered, given, map),
            features: edges(&made.features),
            missed_features: edges(&made.missed_features),
            ..made
        }
    }
}

/// Whether the options name only elements that the mesh has.
fn is_in_range(mesh: &TriangleMesh, options: &QuadOptions) -> bool {
    let smooth = options.smooth.iter().flat_map(|smooth| &smooth.features);
    let mut edges = smooth.copied();
    let mut near = options.near_vertices.iter().copied();
    options.guidance.fits(mesh)
        && near.all(|v| v < mesh.vertex_count())
        && edges.all(|e| e < mesh.edge_count())
}

#[cfg(test)]
mod tests {
    use std::cell::Cell;
    use std::f64::consts::FRAC_PI_2;

    use super::*;
    use crate::check::{CheckOptions, check_map};
    use crate::field::{Constraint, Guidance, Guide};
    use crate::map::Sizing;
    use crate::mesh::shape::by_name;
    use crate::mesh::vector::{Vec3, norm, sub};
    use crate::monitor::Monitor;
    use crate::quad::driver::{Effort, in_order};

    /// Quads of a mesh, made in another order.
    fn made(mesh: &TriangleMesh, options: &QuadOptions) -> Quadrangulation {
        let features = options.guidance.features(mesh).unwrap();
        let features = features.with_two_of_each_face(mesh);
        let reordered = Reordered::new(mesh).unwrap();
        let input = ReorderedInput::on(mesh, &features, options, reordered).unwrap();
        let work = Cell::new(u64::MAX);
        let features = input.features.clone();
        let there = in_order(
            input.mesh(),
            features,
            &input.options,
            Effort::Full,
            &work,
            &Monitor::default,
        );
        input.result_for(mesh, there.unwrap())
    }

    fn gear() -> (TriangleMesh, QuadOptions) {
        let mesh = by_name("gear", 3_000).unwrap();
        let options = QuadOptions {
            sizing: Sizing::Quads(400),
            smooth: None,
            guidance: Guidance {
                feature_angle: Some(0.6),
                ..Guidance::default()
            },
            ..QuadOptions::default()
        };
        (mesh, options)
    }

    #[test]
    fn field_map_and_quads_are_those_of_the_mesh_as_it_was() {
        let (mesh, options) = gear();
        let found = made(&mesh, &options);
        let error = found.field.energy(&mesh) - found.field_solution.energy();
        assert!(error.abs() < 1e-9, "{error}");
        let features = options.guidance.features(&mesh).unwrap();
        let features = features.with_two_of_each_face(&mesh);
        let wanted = (0..mesh.edge_count()).filter(|&e| features.contains(e));
        assert!(wanted.eq(found.features.iter().copied()));
        assert!(found.features.len() > 100 && found.missed_features.is_empty());
        let map = &found.untangled.map;
        let checks = CheckOptions {
            features: found.features.clone(),
            ..CheckOptions::default()
        };
        let check = check_map(&mesh, &map.corner_uvs(), &checks).unwrap();
        assert!(check.is_integer() && check.is_aligned());
        let flipped = check.flipped.iter().map(|defect| defect.element);
        let mut flipped: Vec<usize> = flipped.chain(check.degenerate).collect();
        flipped.sort_unstable();
        assert_eq!(flipped, map.flipped());
        let singular: Vec<usize> = check.singularities.iter().map(|at| at.vertex).collect();
        assert!(!singular.is_empty());
        assert!(map.cones().iter().all(|cone| singular.contains(cone)));
        for transition in map.transitions() {
            let edge = mesh.edge(transition.edge);
            let ((f, k), (g, j)) = (edge.first, edge.second.unwrap());
            for (here, there) in [(k, (j + 1) % 3), ((k + 1) % 3, j)] {
                let (here, there) = (transition.apply(map.uv(f)[here]), map.uv(g)[there]);
                assert!((0..2).all(|axis| (here[axis] - there[axis]).abs() < 1e-9));
            }
        }
        assert!(found.quads.is_conforming());
        for (&at, origin) in found.quads.vertices.iter().zip(&found.quads.origins) {
            let place: Vec3 = match *origin {
                Origin::Vertex(vertex) => mesh.position(vertex),
                Origin::Face(face, weights) => {
                    let corners = mesh.corner_positions(face);
                    [0, 1, 2].map(|axis| (0..3).map(|k| weights[k] * corners[k][axis]).sum())
                }
                Origin::Middle => continue,
            };
            assert!(norm(sub(place, at)) < 1e-12);
        }
    }

    #[test]
    fn what_is_given_for_elements_is_followed() {
        let mesh = by_name("torus", 1_200).unwrap();
        let (constrained, guided) = (
            Constraint {
                face: 40,
                angle: 0.3,
            },
            700,
        );
        let side = mesh.edge(900).vertices;
        let mut options = QuadOptions::default();
        options.guidance.constraints = vec![constrained];
        options.guidance.guides = vec![Guide {
            face: guided,
            angle: -0.2,
            weight: 1e6,
        }];
        options.guidance.feature_lines = vec![side];
        options.guidance.feature_edges = vec![30];
        let lengths = (0..mesh.face_count()).map(|f| match mesh.corner_positions(f)[0][0] > 0.0 {
            true => [0.25; 2],
            false => [0.125; 2],
        });
        options.sizing = Sizing::Lengths(lengths.collect());
        let found = made(&mesh, &options);
        let angles = found.field.angles();
        for (face, angle) in [(40, 0.3), (guided, -0.2)] {
            let turns = (angles[face] - angle) / FRAC_PI_2;
            assert!((turns - turns.round()).abs() < 1e-3, "{face}: {turns}");
        }
        assert!(found.field.constrained()[40]);
        assert_eq!(found.features, [30, 900]);
        let vertices = &found.quads.vertices;
        let sparse = vertices.iter().filter(|p| p[0] > 0.0).count();
        let dense = vertices.len() - sparse;
        assert!(3 * sparse < 2 * dense, "{sparse} and {dense}");
    }

    #[test]
    fn elements_that_are_not_there_are_left_to_errors_of_the_mesh_as_it_is() {
        let (mesh, good) = gear();
        assert!(is_in_range(&mesh, &good));
        let changes: [&dyn Fn(&mut QuadOptions); 4] = [
            &|o| o.guidance.feature_edges = vec![mesh.edge_count()],
            &|o| o.guidance.feature_lines = vec![[0, mesh.vertex_count()]],
            &|o| o.near_vertices = vec![mesh.vertex_count()],
            &|o| {
                o.guidance.constraints = vec![Constraint {
                    face: mesh.face_count(),
                    angle: 0.0,
                }]
            },
        ];
        for change in changes {
            let mut options = good.clone();
            change(&mut options);
            assert!(!is_in_range(&mesh, &options));
        }
    }
}
