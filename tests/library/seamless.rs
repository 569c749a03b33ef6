//! Seamless parametrizations of procedural shapes: properties that hold on any mesh.

use std::collections::HashSet;

use roundel::field::{Constraint, FieldProblem, OrientationField, curvature_constraints};
use roundel::map::{
    Combing, CutGraph, SeamlessMap, SeamlessOptions, SeamlessProblem, TRANSLATION_WEIGHT,
};
use roundel::mesh::{TriangleMesh, shape};
use roundel::{Options, Solution, Strategy, solve};

const SHAPES: [&str; 8] = [
    "rounded-cube",
    "sphere",
    "torus",
    "genus-2",
    "genus-3",
    "gear",
    "disk",
    "plate-with-holes",
];

struct Case {
    name: &'static str,
    mesh: TriangleMesh,
    field: OrientationField,
    problem: SeamlessProblem,
}

fn cases(triangles: usize) -> impl Iterator<Item = Case> {
    SHAPES.into_iter().map(move |name| {
        let mesh = shape::by_name(name, triangles).unwrap();
        let mesh = roundel::mesh::jitter(&mesh, 1e-3, 7).unwrap();
        let constraints = curvature_constraints(&mesh, 0.05).unwrap();
        let field = field(&mesh, &constraints);
        let options = SeamlessOptions { quads: 300 };
        let problem = SeamlessProblem::new(&mesh, &field, &options).unwrap();
        Case {
            name,
            mesh,
            field,
            problem,
        }
    })
}

fn field(mesh: &TriangleMesh, constraints: &[Constraint]) -> OrientationField {
    let problem = FieldProblem::new(mesh, constraints).unwrap();
    let solution = solve(problem.problem(), &Options::default()).unwrap();
    problem.field(mesh, &solution).unwrap()
}

fn map(case: &Case, strategy: Strategy) -> (SeamlessMap, Solution) {
    let options = Options {
        strategy,
        ..Options::default()
    };
    let solution = solve(case.problem.problem(), &options).unwrap();
    (case.problem.map(&case.mesh, &solution).unwrap(), solution)
}

/// Whether the cut turns each component into one disk: connected across the edges that are not cut, with
/// Euler characteristic 1.
fn is_cut_to_disks(mesh: &TriangleMesh, cut: &CutGraph) -> bool {
    let components = mesh.components();
    let mut charts = 0;
    let mut reached = vec![false; mesh.face_count()];
    for seed in 0..mesh.face_count() {
        charts += usize::from(!reached[seed]);
        let mut open = vec![seed];
        while let Some(face) = open.pop() {
            if std::mem::replace(&mut reached[face], true) {
                continue;
            }
            let crossed = (0..3).filter(|&k| !cut.contains(mesh.edge_of(face, k)));
            open.extend(crossed.filter_map(|k| Some(mesh.neighbor(face, k)?.0)));
        }
    }
    charts == components.count && euler_characteristic(mesh, cut) == components.count as i64
}

/// The Euler characteristic of the cut surface. Its vertices are the fans of corners between cut edges.
fn euler_characteristic(mesh: &TriangleMesh, cut: &CutGraph) -> i64 {
    let degrees = cut.degrees(mesh);
    let fans = (0..mesh.vertex_count()).map(|v| match mesh.is_boundary_vertex(v) {
        true => degrees[v] + 1,
        false => degrees[v].max(1),
    });
    let edges = mesh.edge_count() + cut.edges().count();
    i64::from(fans.sum::<u32>()) - edges as i64 + mesh.face_count() as i64
}

#[test]
fn the_cut_leaves_one_disk_and_runs_through_every_cone() {
    for case in cases(600) {
        let cut = case.problem.cut();
        assert!(is_cut_to_disks(&case.mesh, cut), "{}", case.name);
        let degrees = cut.degrees(&case.mesh);
        for &cone in case.problem.cones() {
            assert!(degrees[cone] > 0, "{}: cone {cone}", case.name);
        }
        for (v, &degree) in degrees.iter().enumerate() {
            let may_end = case.problem.cones().contains(&v) || case.mesh.is_boundary_vertex(v);
            assert!(degree != 1 || may_end, "{}: loose end {v}", case.name);
        }
    }
}

#[test]
fn any_vertices_can_be_cones_of_a_cut() {
    for name in SHAPES {
        let mesh = shape::by_name(name, 400).unwrap();
        let last = mesh.vertex_count() - 1;
        for cones in [vec![], vec![last], vec![last, 0, last / 2, last]] {
            let cut = CutGraph::new(&mesh, &cones).unwrap();
            assert!(is_cut_to_disks(&mesh, &cut), "{name} {cones:?}");
            let degrees = cut.degrees(&mesh);
            let on_cut = |&&v: &&usize| degrees[v] > 0 || mesh.is_boundary_vertex(v);
            let joined = cones.iter().filter(on_cut).count();
            assert_eq!(joined, cones.len(), "{name} {cones:?}");
        }
        let error = CutGraph::new(&mesh, &[0, last + 1]).unwrap_err();
        assert_eq!(error.index(), Some(1));
    }
}

#[test]
fn every_component_is_cut_and_pinned_by_itself() {
    let [a, b] = ["torus", "rounded-cube"].map(|name| shape::by_name(name, 400).unwrap());
    let offset = a.vertex_count() as u32;
    let shifted = b.triangles().iter().map(|t| t.map(|v| v + offset));
    let triangles = a.triangles().iter().copied().chain(shifted).collect();
    let mesh = TriangleMesh::new([a.vertices(), b.vertices()].concat(), triangles).unwrap();
    let field = field(&mesh, &curvature_constraints(&mesh, 0.1).unwrap());
    let problem = SeamlessProblem::new(&mesh, &field, &SeamlessOptions::default()).unwrap();
    assert!(is_cut_to_disks(&mesh, problem.cut()));
    let solution = solve(problem.problem(), &Options::default()).unwrap();
    let map = problem.map(&mesh, &solution).unwrap();
    let origin = |face: usize| {
        let corners = (face..mesh.face_count()).map(|f| map.uv(f));
        corners.flatten().any(|uv| uv == [0.0, 0.0])
    };
    assert!(origin(0) && origin(a.face_count()));
}

#[test]
fn combed_arms_match_over_all_edges_that_are_not_cut() {
    for case in cases(600) {
        let Case { mesh, field, .. } = &case;
        let combing = case.problem.combing();
        for (e, edge) in mesh.edges().enumerate() {
            let Some((j, _)) = edge.second else { continue };
            let quarters = |face: usize| i32::from(combing.quarters()[face]);
            let jump = field.period_jumps()[e] + quarters(j) - quarters(edge.first.0);
            let transition = i32::from(combing.transitions()[e]);
            assert_eq!((jump + transition).rem_euclid(4), 0, "{}", case.name);
            if !case.problem.cut().contains(e) {
                assert_eq!(transition, 0, "{}: edge {e}", case.name);
            }
        }
    }
}

#[test]
fn transitions_around_a_vertex_compose_to_its_index() {
    for case in cases(600) {
        let Case { mesh, field, .. } = &case;
        let combing: &Combing = case.problem.combing();
        let quarters = field.vertex_index_steps(mesh);
        for v in (0..mesh.vertex_count()).filter(|&v| !mesh.is_boundary_vertex(v)) {
            let turns: i64 = mesh
                .ring(v)
                .map(|(f, k)| i64::from(combing.transition_from(mesh, f, (k + 2) % 3)))
                .sum();
            assert_eq!(
                (turns - i64::from(quarters[v])).rem_euclid(4),
                0,
                "{}: {v}",
                case.name
            );
        }
    }
}

#[test]
fn coordinates_change_by_quarter_turns_and_integer_shifts_over_the_cut() {
    for case in cases(600) {
        let (map, _) = map(&case, Strategy::Greedy);
        let mesh = &case.mesh;
        let cut: Vec<usize> = case.problem.cut().edges().collect();
        let of_transitions: Vec<usize> = map.transitions().iter().map(|t| t.edge).collect();
        assert_eq!(of_transitions, cut, "{}", case.name);
        for t in map.transitions() {
            assert!(t.translation.iter().all(|x| x.fract() == 0.0));
            assert_eq!(t.quarters, case.problem.combing().transitions()[t.edge]);
            for [from, to] in sides(mesh, &map, t.edge) {
                let there = t.apply(from);
                let error = (there[0] - to[0]).abs().max((there[1] - to[1]).abs());
                assert!(error < 1e-8, "{}: edge {}: {error:e}", case.name, t.edge);
            }
        }
        let cut: HashSet<usize> = cut.into_iter().collect();
        for (e, edge) in mesh.edges().enumerate() {
            if edge.second.is_some() && !cut.contains(&e) {
                for [from, to] in sides(mesh, &map, e) {
                    assert_eq!(from, to, "{}: edge {e}", case.name);
                }
            }
        }
    }
}

/// The coordinates of both ends of an interior edge, in its first and in its second face.
fn sides(mesh: &TriangleMesh, map: &SeamlessMap, edge: usize) -> [[[f64; 2]; 2]; 2] {
    let edge = mesh.edge(edge);
    let (i, k) = edge.first;
    let (j, l) = edge.second.unwrap();
    let (first, second) = (map.uv(i), map.uv(j));
    [
        [first[k], second[(l + 1) % 3]],
        [first[(k + 1) % 3], second[l]],
    ]
}

#[test]
fn cones_lie_on_integers_in_every_face_around_them() {
    for case in cases(600) {
        let (map, _) = map(&case, Strategy::Greedy);
        for &cone in map.cones() {
            for (face, corner) in case.mesh.ring(cone) {
                for x in map.uv(face)[corner] {
                    assert!((x - x.round()).abs() < 1e-8, "{}: {cone}: {x}", case.name);
                }
            }
        }
        if let Some(&first) = map.cones().first() {
            let mut around = case.mesh.ring(first);
            assert!(around.any(|(face, corner)| map.uv(face)[corner] == [0.0, 0.0]));
        }
    }
}

#[test]
fn the_energy_of_the_solution_is_that_on_the_mesh_plus_that_of_the_translations() {
    for case in cases(600) {
        for strategy in [Strategy::Relax, Strategy::Greedy] {
            let (map, solution) = map(&case, strategy);
            let integers = solution.values()[2 * map.vertex_uvs().len()..].iter();
            let translations = TRANSLATION_WEIGHT * integers.map(|x| x * x).sum::<f64>();
            let error = (map.energy() + translations - solution.energy()).abs();
            let energy = map.energy();
            assert!(
                error < 1e-9 * energy.max(1.0),
                "{} {}: {energy} {error:e}",
                case.name,
                strategy.name()
            );
        }
    }
}

#[test]
fn a_flat_square_is_mapped_by_a_scaled_isometry() {
    let mesh = shape::by_name("plane", 200).unwrap();
    let angle = 0.3 - mesh.edge_angle(5, 1);
    let field = field(&mesh, &[Constraint { face: 5, angle }]);
    let problem = SeamlessProblem::new(&mesh, &field, &SeamlessOptions { quads: 50 }).unwrap();
    assert!(problem.cones().is_empty());
    let solution = solve(problem.problem(), &Options::default()).unwrap();
    let map = problem.map(&mesh, &solution).unwrap();
    assert!(map.energy() < 1e-18, "{:e}", map.energy());
    assert!(map.flipped().is_empty());
    let scale = (50.0 / mesh.surface_area()).sqrt();
    for face in 0..mesh.face_count() {
        let uv = map.uv(face);
        for k in 0..3 {
            let [a, b] = [uv[k], uv[(k + 1) % 3]];
            let length = (b[0] - a[0]).hypot(b[1] - a[1]);
            let error = (length - scale * mesh.edge_length(face, k)).abs();
            assert!(error < 1e-9, "face {face}: {error:e}");
        }
    }
}

#[test]
fn a_map_covers_the_requested_number_of_squares() {
    for case in cases(600) {
        let (map, _) = map(&case, Strategy::Relax);
        let area = |[a, b, c]: [[f64; 2]; 3]| {
            0.5 * ((b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]))
        };
        let covered: f64 = map.corner_uvs().into_iter().map(area).sum();
        assert!(
            (200.0..310.0).contains(&covered),
            "{}: {covered}",
            case.name
        );
        let flipped = map.flipped();
        let uvs = map.corner_uvs().into_iter().enumerate();
        let negative = uvs.filter(|&(_, uv)| area(uv) <= 0.0).map(|(f, _)| f);
        assert_eq!(flipped, negative.collect::<Vec<_>>(), "{}", case.name);
    }
}

#[test]
fn the_number_of_reduced_integers_follows_from_the_topology() {
    for case in cases(600).filter(|case| case.mesh.is_closed()) {
        let (_, solution) = map(&case, Strategy::Relax);
        let cones = case.problem.cones().len() as i64;
        if cones > 0 {
            let expected = 2 * (cones - case.mesh.euler_characteristic());
            let reduced = solution.counts().reduced_integers as i64;
            assert_eq!(reduced, expected, "{}", case.name);
        }
    }
}

#[test]
fn arguments_that_do_not_belong_together_are_refused() {
    let [mesh, other] = [200, 400].map(|n| shape::by_name("torus", n).unwrap());
    let field = field(&mesh, &[]);
    let options = SeamlessOptions::default();
    let refused = SeamlessProblem::new(&other, &field, &options).unwrap_err();
    assert_eq!(refused.code(), "length_mismatch");
    let none = SeamlessOptions { quads: 0 };
    let refused = SeamlessProblem::new(&mesh, &field, &none).unwrap_err();
    assert_eq!(refused.code(), "invalid_argument");
    let problem = SeamlessProblem::new(&mesh, &field, &options).unwrap();
    let solution = solve(problem.problem(), &Options::default()).unwrap();
    let refused = problem.map(&other, &solution).unwrap_err();
    assert_eq!(refused.code(), "length_mismatch");
    let coarser = SeamlessOptions { quads: 10 };
    let foreign = FieldProblem::new(&mesh, &[]).unwrap();
    let solution = solve(foreign.problem(), &Options::default()).unwrap();
    let problem = SeamlessProblem::new(&mesh, &field, &coarser).unwrap();
    let refused = problem.map(&mesh, &solution).unwrap_err();
    assert_eq!(refused.code(), "length_mismatch");
}
