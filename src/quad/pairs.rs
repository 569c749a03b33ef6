//! Quads of pairs of triangles, where no map has good ones (`remacle2012`).
//!
//! Two triangles at an edge make a quad. Edges are chosen so that each triangle has one, at the least cost:
//!
//! ```text
//! minimise   sum_e c_e x_e
//! subject to sum_{e of t} x_e = 1    for each triangle t
//!            x binary
//! ```
//!
//! An edge at the boundary leaves its triangle alone: it becomes a quad with a vertex in the middle of that edge, or
//! three quads if it has no neighbours at all. There always is a solution. The triangles of a closed surface are
//! vertices of a cubic graph without bridges, and these have a perfect matching (`petersen1891`). A surface with a
//! boundary is half of its double, and pairs of the double across the boundary are triangles alone.
//!
//! Each unknown is in two rows at most, so that this is solved as a matching in polynomial time.

use std::f64::consts::FRAC_PI_2;

use super::coverage::{far, lost};
use super::missed::missed;
use super::rank::{FACTOR, Losses, Rank};
use super::tries::SHARP;
use super::{QuadOptions, Quadrangulation};
use crate::error::Result;
use crate::extract::{Origin, QuadMesh};
use crate::field::Guidance;
use crate::mesh::features::FeatureGraph;
use crate::mesh::vector::{Vec3, add, dot, scale};
use crate::mesh::{Edge, TriangleMesh};
use crate::monitor::{Monitor, optional};
use crate::problem::Problem;
use crate::search::{Options, Strategy};
use crate::smooth::{QuadQuality, Shapes, SmoothOptions, smooth_to};
use crate::solve::solve_with;

/// The cost of a triangle alone: a quad with a straight angle is as bad as one whose angles are off by 135 degrees.
const ALONE: f64 = 1.5;

/// The cost of an edge that goes although it is a feature.
const FEATURE: f64 = 16.0;

/// Costs are multiples of the reciprocal of this, so that the matching is exact.
const PARTS: f64 = 1024.0;

/// Meshes of more faces are not paired: half as many quads are too many for what is wrong in one place.
const MOST_FACES: usize = 50_000;

/// The quads of a mesh, or of one component, in place of those of a map.
pub(super) struct Paired {
    pub(super) quads: QuadMesh,
    /// The features that the quads were to follow.
    pub(super) features: Vec<usize>,
    /// Those that no edge of a quad follows.
    pub(super) missed: Vec<usize>,
}

impl Paired {
    /// Whether pairs are better than quads of this rank: these do not conform, or they lose much of the surface, and
    /// pairs are not far more than they are or than were asked for.
    pub(super) fn are_better(
        mesh: &TriangleMesh,
        options: &QuadOptions,
        rank: Rank,
        quads: &QuadMesh,
    ) -> bool {
        let pairs = mesh.face_count() as f64 / 2.0;
        let asked = mesh.surface_area() / options.sizing.edge_length(mesh).powi(2);
        let may_be = FACTOR * asked.max(quads.quads.len() as f64);
        rank.does_not_conform() || rank.loses_much() && pairs <= may_be
    }

    /// `None` for meshes of too many faces, if the caller wants what there is, and if the call is stopped.
    pub(super) fn new<'a>(
        mesh: &TriangleMesh,
        options: &QuadOptions,
        monitor: &impl Fn() -> Monitor<'a>,
    ) -> Option<Self> {
        if mesh.face_count() > MOST_FACES {
            return None;
        }
        optional(monitor, || {
            let features = options.guidance.features(mesh)?;
            let solution = solve_with(&problem(mesh, &features)?, &exact(), monitor())?;
            let quads = quads(mesh, |edge| solution.values()[edge] > 0.5);
            let quads = smoothed(mesh, options, quads, monitor)?;
            let features: Vec<usize> = features.edges().collect();
            let missed = missed(mesh, &quads, &features);
            Ok(Paired {
                quads,
                features,
                missed,
            })
        })
        .ok()?
    }

    /// Puts these quads of a whole mesh in place of those that a map has.
    pub(super) fn replace(self, made: &mut Quadrangulation, mesh: &TriangleMesh) {
        made.quads = self.quads;
        made.features = self.features;
        made.missed_features = self.missed;
        made.paired = (0..mesh.face_count()).collect();
    }
}

/// The quads after smoothing along sharp edges, if they are better then: fewer are inverted, or as many and their angles
/// are nearer to right ones. Pairs of regular triangles are not, and others may lose some of the surface.
fn smoothed<'a>(
    mesh: &TriangleMesh,
    options: &QuadOptions,
    quads: QuadMesh,
    monitor: &impl Fn() -> Monitor<'a>,
) -> Result<QuadMesh> {
    let Some(given) = &options.smooth else {
        return Ok(quads);
    };
    let guidance = Guidance {
        feature_angle: options.guidance.feature_angle.or(Some(SHARP)),
        feature_length: None,
        ..options.guidance.clone()
    };
    let sharp = guidance.features(mesh)?;
    let given = SmoothOptions {
        features: given
            .features
            .iter()
            .copied()
            .chain(sharp.edges())
            .collect(),
        ..given.clone()
    };
    let mut moved = quads.clone();
    let shapes = Shapes::default();
    smooth_to(&mut moved, mesh, None, &given, shapes, &mut monitor())?;
    let faults = |quads: &QuadMesh| {
        let quality = QuadQuality::new(quads);
        (quality.inverted, quality.angle_deviation)
    };
    let is_better = moved.is_conforming()
        && lost(&moved, mesh, far(mesh)) <= Losses::Few.largest()
        && faults(&moved) < faults(&quads);
    Ok(if is_better { moved } else { quads })
}

fn exact() -> Options {
    Options {
        strategy: Strategy::Exact,
        ..Options::default()
    }
}

/// The problem, with an unknown for each edge.
fn problem(mesh: &TriangleMesh, features: &FeatureGraph) -> Result<Problem> {
    let mut problem = Problem::new(mesh.edge_count())?;
    let all: Vec<usize> = (0..mesh.edge_count()).collect();
    problem.set_binaries(&all)?;
    for (number, edge) in mesh.edges().enumerate() {
        let feature = match edge.second.is_some() && features.contains(number) {
            true => FEATURE,
            false => 0.0,
        };
        problem.add_linear_term(number, (PARTS * (cost(mesh, edge) + feature)).round())?;
    }
    for face in 0..mesh.face_count() {
        let edges = [0, 1, 2].map(|k| mesh.edge_of(face, k));
        problem.add_constraint(&edges, &[1.0; 3], 1.0)?;
    }
    Ok(problem)
}

/// How far a quad is from a flat rectangle: the largest difference of its angles from right ones and the angle between
/// its two triangles, as parts of a right angle.
fn cost(mesh: &TriangleMesh, edge: Edge) -> f64 {
    let Some((g, m)) = edge.second else {
        return ALONE;
    };
    let (f, k) = edge.first;
    let (of_f, of_g) = (mesh.angles()[f], mesh.angles()[g]);
    // The edge runs from corner k of one face to the next, and in the other face back.
    let corners = [
        of_f[(k + 2) % 3],
        of_g[(m + 2) % 3],
        of_f[k] + of_g[(m + 1) % 3],
        of_f[(k + 1) % 3] + of_g[m],
    ];
    let off = corners.map(|angle| (angle - FRAC_PI_2).abs());
    let bend = dot(mesh.normal(f), mesh.normal(g)).clamp(-1.0, 1.0).acos();
    (off.into_iter().fold(0.0, f64::max) + bend) / FRAC_PI_2
}

/// The quads where one edge of each triangle is chosen.
fn quads(mesh: &TriangleMesh, is_chosen: impl Fn(usize) -> bool) -> QuadMesh {
    let mut made = Made::new(mesh);
    for (number, edge) in mesh.edges().enumerate() {
        if !is_chosen(number) {
            continue;
        }
        let (f, k) = edge.first;
        match edge.second {
            Some((g, m)) => {
                let ends = edge.vertices.map(|v| made.corner(v));
                let [beside, opposite] = [(g, m), (f, k)].map(|(face, k)| {
                    let apex = mesh.corners(face)[(k + 2) % 3];
                    made.corner(apex)
                });
                made.quads.push([ends[0], beside, ends[1], opposite]);
            }
            None if (0..3).all(|k| mesh.neighbor(f, k).is_none()) => made.three(f),
            None => {
                let [a, b, c] = [0, 1, 2].map(|i| made.corner(mesh.corners(f)[(k + i) % 3]));
                let middle = made.inside(f, [k, (k + 1) % 3]);
                made.quads.push([a, middle, b, c]);
            }
        }
    }
    QuadMesh {
        origins: made.origins,
        ..QuadMesh::from_quads(made.vertices, made.quads, mesh.euler_characteristic())
    }
}

/// Quads in the making.
struct Made<'a> {
    mesh: &'a TriangleMesh,
    vertices: Vec<Vec3>,
    origins: Vec<Origin>,
    quads: Vec<[u32; 4]>,
    /// The number of each vertex of the mesh that is a corner of quads.
    numbers: Vec<Option<u32>>,
}

impl<'a> Made<'a> {
    fn new(mesh: &'a TriangleMesh) -> Self {
        Made {
            mesh,
            vertices: Vec::new(),
            origins: Vec::new(),
            quads: Vec::new(),
            numbers: vec![None; mesh.vertex_count()],
        }
    }

    fn add(&mut self, position: Vec3, origin: Origin) -> u32 {
        self.vertices.push(position);
        self.origins.push(origin);
        self.vertices.len() as u32 - 1
    }

    /// The corner at a vertex of the mesh.
    fn corner(&mut self, vertex: usize) -> u32 {
        if let Some(number) = self.numbers[vertex] {
            return number;
        }
        let number = self.add(self.mesh.position(vertex), Origin::Vertex(vertex));
        self.numbers[vertex] = Some(number);
        number
    }

    /// A new vertex in the middle of these corners of a face.
    fn inside<const N: usize>(&mut self, face: usize, corners: [usize; N]) -> u32 {
        let mut weights = [0.0; 3];
        corners.iter().for_each(|&k| weights[k] = 1.0 / N as f64);
        let places = self.mesh.corner_positions(face);
        let place = (0..3).fold([0.0; 3], |p, k| add(p, scale(places[k], weights[k])));
        self.add(place, Origin::Face(face, weights))
    }

    /// A triangle without neighbours as three quads.
    fn three(&mut self, face: usize) {
        let corners = self.mesh.corners(face).map(|v| self.corner(v));
        let middles = [0, 1, 2].map(|k| self.inside(face, [k, (k + 1) % 3]));
        let centre = self.inside(face, [0, 1, 2]);
        for k in 0..3 {
            let quad = [corners[k], middles[k], centre, middles[(k + 2) % 3]];
            self.quads.push(quad);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::super::quadrangulate;
    use super::*;
    use crate::map::Sizing;
    use crate::mesh::shape::by_name;
    use crate::monitor::CancelToken;

    fn paired(mesh: &TriangleMesh, options: &QuadOptions) -> Paired {
        Paired::new(mesh, options, &Monitor::default).unwrap()
    }

    /// With these options no vertices move.
    fn still() -> QuadOptions {
        QuadOptions {
            smooth: None,
            ..QuadOptions::default()
        }
    }

    /// A sphere with vertices that are pulled towards its centre.
    fn spikes(triangles: usize, inner: f64) -> TriangleMesh {
        let sphere = by_name("sphere", triangles).unwrap();
        let radius = |v: usize| if v * 7 % 5 < 2 { inner } else { 1.0 };
        let points = sphere.vertices().iter().enumerate();
        let points = points.map(|(v, &p)| scale(p, radius(v)));
        TriangleMesh::new(points.collect(), sphere.triangles().to_vec()).unwrap()
    }

    #[test]
    fn all_surfaces_have_pairs_that_cover_them() {
        let closed = ["sphere", "torus", "genus-2", "gear"];
        let bounded = ["plane", "disk", "plate-with-holes"];
        for name in closed.into_iter().chain(bounded) {
            let mesh = by_name(name, 700).unwrap();
            let quads = paired(&mesh, &still()).quads;
            assert!(quads.is_conforming(), "{name}");
            let is_middle = |origin: &&Origin| !matches!(origin, Origin::Vertex(_));
            let alone = quads.origins.iter().filter(is_middle).count();
            assert_eq!(2 * quads.quads.len() - alone, mesh.face_count(), "{name}");
            assert!(alone == 0 || !closed.contains(&name), "{name}");
            assert_eq!(quads.vertices.len(), mesh.vertex_count() + alone, "{name}");
            assert!(lost(&quads, &mesh, far(&mesh)) < 0.01, "{name}");
        }
    }

    /// The least cost of pairs of the faces that are not taken.
    fn least_cost(mesh: &TriangleMesh, taken: &mut [bool]) -> f64 {
        let Some(face) = (0..mesh.face_count()).find(|&f| !taken[f]) else {
            return 0.0;
        };
        let mut least = f64::INFINITY;
        taken[face] = true;
        for k in 0..3 {
            let of_edge = (PARTS * cost(mesh, mesh.edge(mesh.edge_of(face, k)))).round();
            match mesh.neighbor(face, k) {
                None => least = least.min(of_edge + least_cost(mesh, taken)),
                Some((other, _)) if !taken[other] => {
                    taken[other] = true;
                    least = least.min(of_edge + least_cost(mesh, taken));
                    taken[other] = false;
                }
                Some(_) => {}
            }
        }
        taken[face] = false;
        least
    }

    #[test]
    fn no_other_pairs_cost_less() {
        for (name, triangles) in [("sphere", 20), ("disk", 24), ("plane", 18)] {
            let mesh = by_name(name, triangles).unwrap();
            let points = mesh.vertices().iter().enumerate();
            let points = points.map(|(v, p)| [p[0] + 0.1 * (v as f64).sin(), p[1], p[2]]);
            let mesh = TriangleMesh::new(points.collect(), mesh.triangles().to_vec()).unwrap();
            let problem = problem(&mesh, &FeatureGraph::none(&mesh)).unwrap();
            let solution = solve_with(&problem, &exact(), Monitor::default()).unwrap();
            let least = least_cost(&mesh, &mut vec![false; mesh.face_count()]);
            assert!(solution.is_complete() && least.is_finite());
            assert_eq!(solution.energy(), least, "{name}");
        }
    }

    #[test]
    fn features_are_edges_of_quads() {
        let mesh = by_name("gear", 3_000).unwrap();
        let guidance = Guidance {
            feature_angle: Some(SHARP),
            ..Guidance::default()
        };
        for options in [QuadOptions::default(), still()] {
            let options = QuadOptions {
                guidance: guidance.clone(),
                ..options
            };
            let found = paired(&mesh, &options);
            assert!(found.features.len() > 100 && found.missed.is_empty());
            assert!(found.quads.is_conforming());
        }
    }

    /// The diagonals of squares, which would be the middle of every quad.
    #[test]
    fn flat_features_are_edges_of_quads_too() {
        let mesh = by_name("plane", 200).unwrap();
        let is_diagonal = |e: &usize| {
            let edge = mesh.edge(*e);
            edge.second.is_some() && cost(&mesh, edge) < 1e-6
        };
        let diagonals: Vec<usize> = (0..mesh.edge_count()).filter(is_diagonal).collect();
        assert!(diagonals.len() > 50);
        let mut options = still();
        options.guidance.feature_edges = diagonals.iter().copied().step_by(9).collect();
        assert!(paired(&mesh, &options).missed.is_empty());
    }

    /// Two halves of a square, one turned about the diagonal by an angle; and those of a rhombus.
    #[test]
    fn angles_of_quads_and_between_their_triangles_cost() {
        let cost_of = |points: [Vec3; 4]| {
            let mesh = TriangleMesh::new(points.to_vec(), vec![[0, 1, 2], [2, 3, 0]]).unwrap();
            let inner = mesh.edges().find(|edge| edge.second.is_some()).unwrap();
            cost(&mesh, inner)
        };
        let turned = |angle: f64| {
            let [x, z] = [angle.cos(), angle.sin()];
            cost_of([
                [0.0, -1.0, 0.0],
                [1.0, 0.0, 0.0],
                [0.0, 1.0, 0.0],
                [-x, 0.0, z],
            ])
        };
        for (angle, expected) in [(0.0, 0.0), (FRAC_PI_2, 1.0), (-0.5 * FRAC_PI_2, 0.5)] {
            assert!((turned(angle) - expected).abs() < 1e-9);
        }
        // Its angles are 60 and 120 degrees.
        let height = 3f64.sqrt();
        let rhombus = [
            [0.0, -1.0, 0.0],
            [height, 0.0, 0.0],
            [0.0, 1.0, 0.0],
            [-height, 0.0, 0.0],
        ];
        assert!((cost_of(rhombus) - 1.0 / 3.0).abs() < 1e-9);
    }

    #[test]
    fn smoothing_makes_pairs_better_or_leaves_them() {
        let quality =
            |mesh: &TriangleMesh, options| QuadQuality::new(&paired(mesh, &options).quads);
        let both = |mesh: &TriangleMesh| {
            [still(), QuadOptions::default()].map(|options| quality(mesh, options))
        };
        let plane = by_name("plane", 400).unwrap();
        let step = 0.4 * plane.edge_length(0, 0);
        let moved =
            plane
                .vertices()
                .iter()
                .enumerate()
                .map(|(v, p)| match plane.is_boundary_vertex(v) {
                    true => *p,
                    false => [
                        p[0] + step * (v as f64).sin(),
                        p[1] + step * (2.0 * v as f64).cos(),
                        0.0,
                    ],
                });
        let moved = TriangleMesh::new(moved.collect(), plane.triangles().to_vec()).unwrap();
        let [before, after] = both(&moved);
        assert!(after.inverted < before.inverted, "{after:?} of {before:?}");
        let [before, after] = both(&by_name("genus-2", 1_000).unwrap());
        assert_eq!(after, before);
    }

    #[test]
    fn triangles_without_neighbours_become_three_quads() {
        let points = vec![[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [1.0, 1.0, 0.0]];
        let one = TriangleMesh::new(points[..3].to_vec(), vec![[0, 1, 2]]).unwrap();
        let two = TriangleMesh::new(points, vec![[0, 1, 2], [1, 3, 2]]).unwrap();
        for (mesh, count) in [(one, 3), (two, 1)] {
            let quads = paired(&mesh, &still()).quads;
            assert!(quads.is_conforming() && quads.quads.len() == count);
            assert_eq!(lost(&quads, &mesh, 1e-9), 0.0);
        }
    }

    #[test]
    fn large_meshes_and_calls_that_end_have_no_pairs() {
        let large = by_name("plane", MOST_FACES + 1_000).unwrap();
        assert!(large.face_count() > MOST_FACES);
        assert!(Paired::new(&large, &still(), &Monitor::default).is_none());
        let small = by_name("sphere", 80).unwrap();
        let token = CancelToken::default();
        token.cancel();
        let cancelled = || Monitor::default().cancel_token(token.clone());
        assert!(Paired::new(&small, &still(), &cancelled).is_none());
    }

    #[test]
    fn a_component_that_no_map_covers_becomes_pairs() {
        let spikes = spikes(80, 0.1);
        let sphere = by_name("sphere", 500).unwrap();
        let beside = spikes.vertices().iter().map(|p| [p[0] + 3.0, p[1], p[2]]);
        let points = sphere.vertices().iter().copied().chain(beside).collect();
        let first = sphere.vertex_count() as u32;
        let moved = spikes.triangles().iter().map(|t| t.map(|v| v + first));
        let triangles = sphere.triangles().iter().copied().chain(moved).collect();
        let both = TriangleMesh::new(points, triangles).unwrap();
        let options = QuadOptions {
            sizing: Sizing::Quads(100),
            ..QuadOptions::default()
        };
        let alone = quadrangulate(&spikes, &options, Monitor::default).unwrap();
        assert_eq!(alone.paired, (0..spikes.face_count()).collect::<Vec<_>>());
        let made = quadrangulate(&both, &options, Monitor::default).unwrap();
        let last: Vec<usize> = (sphere.face_count()..both.face_count()).collect();
        assert_eq!(made.paired, last);
        for (made, mesh) in [(alone, &spikes), (made, &both)] {
            assert!(made.quads.is_conforming());
            assert!(lost(&made.quads, mesh, far(mesh)) <= Losses::Few.largest());
        }
    }
}
