//! Layouts of quads that the library makes, from shapes and from the meshes of CGAL's demos.

use std::collections::BTreeSet;

use crate::common::archive::{MISSING, archive};
use roundel::layout::found::{FoundLayout, QuadSurface, SimplifyOptions, SplinePatches, simplify};
use roundel::layout::{LayoutOptions, LayoutSizing, layout_quads};
use roundel::map::Sizing;
use roundel::mesh::{TriangleMesh, io, shape};
use roundel::quad::{QuadOptions, quadrangulate};
use roundel::smooth::QuadQuality;
use roundel::{Error, Monitor};

fn quads_of(mesh: &TriangleMesh, quads: usize) -> QuadSurface {
    let options = QuadOptions {
        sizing: Sizing::Quads(quads),
        ..QuadOptions::default()
    };
    let made = quadrangulate(mesh, &options, Monitor::default).unwrap();
    assert!(made.quads.is_conforming());
    QuadSurface::new(made.quads.vertices, made.quads.quads).unwrap()
}

/// Every quad is in one patch, patches are rectangles, and Euler's formula holds.
fn check(surface: &QuadSurface, layout: &FoundLayout) {
    let mut count = vec![0; layout.patches.len()];
    layout
        .patch_of
        .iter()
        .for_each(|&patch| count[patch as usize] += 1);
    for (patch, count) in layout.patches.iter().zip(count) {
        assert_eq!(patch.size[0] * patch.size[1], count);
        for (k, side) in patch.sides.iter().enumerate() {
            let arcs = side
                .iter()
                .map(|&arc| layout.arcs[arc as usize].vertices.len() - 1);
            assert_eq!(arcs.sum::<usize>(), patch.size[k % 2]);
        }
    }
    let euler = layout.nodes.len() as i64 - layout.arcs.len() as i64 + layout.patches.len() as i64;
    assert_eq!(euler, surface.euler_characteristic());
}

/// Of every irregular vertex, whether it is on the boundary and its number of quads.
fn irregular(surface: &QuadSurface) -> Vec<(bool, usize)> {
    let vertices = 0..surface.positions().len();
    let irregular = vertices.filter(|&v| surface.is_irregular(v));
    let mut found: Vec<_> = irregular
        .map(|v| (surface.is_boundary(v), surface.valence(v)))
        .collect();
    found.sort_unstable();
    found
}

/// The numbers of patches of the base complex and of the simplified layout.
fn patches(surface: &QuadSurface) -> [usize; 2] {
    let base = FoundLayout::base_complex(surface);
    let motorcycle = FoundLayout::motorcycle_graph(surface);
    check(surface, &base);
    check(surface, &motorcycle);
    assert!(motorcycle.patches.len() <= base.patches.len());
    let found = simplify(surface, &SimplifyOptions::default(), Monitor::default).unwrap();
    check(&found.surface, &found.layout);
    assert_eq!(irregular(&found.surface), irregular(surface));
    assert_eq!(
        found.surface.euler_characteristic(),
        surface.euler_characteristic()
    );
    [base.patches.len(), found.layout.patches.len()]
}

#[test]
fn a_simplified_layout_has_the_same_irregular_vertices_and_a_third_of_the_patches() {
    for (name, quads) in [("sphere", 600), ("genus-3", 1000)] {
        let mesh = shape::by_name(name, 4 * quads).unwrap();
        let [base, simplified] = patches(&quads_of(&mesh, quads));
        assert!(3 * simplified <= base, "{name}: {simplified} of {base}");
    }
}

/// The layout of these quads leads back to quads on the mesh, four times as many, with the same base complex.
fn check_round_trip(mesh: &TriangleMesh, surface: &QuadSurface, name: &str) {
    let base = FoundLayout::base_complex(surface);
    let drawn = FoundLayout::simple_complex(surface).drawn(surface).unwrap();
    let options = LayoutOptions {
        sizing: LayoutSizing::Quads(4 * surface.quads().len()),
        curves: drawn.curves,
        ..LayoutOptions::default()
    };
    let made = layout_quads(mesh, &drawn.layout, &options, Monitor::default).unwrap();
    assert!(made.is_as_prescribed && made.folded == 0, "{name}");
    assert!(made.subdivisions.is_optimal, "{name}");
    assert_eq!(QuadQuality::new(&made.quads).inverted, 0, "{name}");
    let finer = QuadSurface::new(made.quads.vertices, made.quads.quads).unwrap();
    let again = FoundLayout::base_complex(&finer);
    assert_eq!(again.nodes.len(), base.nodes.len(), "{name}");
    assert_eq!(again.arcs.len(), base.arcs.len(), "{name}");
    assert_eq!(again.patches.len(), base.patches.len(), "{name}");
}

#[test]
fn layouts_of_quads_lead_back_to_quads() {
    for (name, quads) in [("torus", 300), ("genus-3", 800)] {
        let mesh = shape::by_name(name, 4 * quads).unwrap();
        let surface = quads_of(&mesh, quads);
        check_round_trip(&mesh, &surface, name);
        let fewer = simplify(&surface, &SimplifyOptions::default(), Monitor::default).unwrap();
        check_round_trip(&mesh, &fewer.surface, name);
    }
}

#[test]
#[ignore = "minutes in builds without optimisation"]
fn layouts_of_quads_of_meshes_of_the_demos_lead_back_to_quads() {
    let Some(archive) = archive() else {
        return crate::common::skip::skip_unless_ci(MISSING);
    };
    for name in ["fandisk", "rockerarm", "3holes", "bunny00"] {
        let mesh = io::read(archive.join(format!("{name}.off"))).unwrap();
        let surface = quads_of(&mesh, 2000);
        check_round_trip(&mesh, &surface, name);
        let fewer = simplify(&surface, &SimplifyOptions::default(), Monitor::default).unwrap();
        check_round_trip(&mesh, &fewer.surface, name);
    }
}

#[test]
fn quads_with_a_boundary_get_no_more_patches() {
    for name in ["plate-with-holes", "disk"] {
        let mesh = shape::by_name(name, 2400).unwrap();
        let [base, simplified] = patches(&quads_of(&mesh, 600));
        assert!(simplified <= base, "{name}: {simplified} of {base}");
    }
}

#[test]
fn arcs_of_a_simplified_layout_stay_within_the_deviation() {
    let mesh = shape::by_name("genus-3", 4000).unwrap();
    let surface = quads_of(&mesh, 1000);
    for deviation in [1.0, 3.0] {
        let options = SimplifyOptions {
            deviation,
            ..SimplifyOptions::default()
        };
        let found = simplify(&surface, &options, Monitor::default).unwrap();
        assert!(found.drift.largest <= deviation);
    }
    for deviation in [0.0, -1.0, f64::NAN] {
        let options = SimplifyOptions {
            deviation,
            ..SimplifyOptions::default()
        };
        let refused = simplify(&surface, &options, Monitor::default);
        assert!(
            matches!(refused, Err(Error::InvalidArgument { .. })),
            "{deviation}"
        );
    }
}

#[test]
fn surfaces_come_within_the_tolerance_and_share_the_points_of_their_sides() {
    let mesh = shape::by_name("rounded-cube", 4000).unwrap();
    let surface = quads_of(&mesh, 1000);
    let found = simplify(&surface, &SimplifyOptions::default(), Monitor::default).unwrap();
    let mut last = usize::MAX;
    for tolerance in [1e-3, 1e-2, 1e-1] {
        let fitted = SplinePatches::fit(&found.surface, &found.layout, tolerance).unwrap();
        assert!(fitted.is_within && fitted.deviation <= tolerance);
        assert!(fitted.points.len() <= last);
        last = fitted.points.len();
        // Each point inside an arc is on two patches, a node on as many as it has quads.
        let on: Vec<BTreeSet<u32>> = fitted
            .surfaces
            .iter()
            .map(|s| s.control.iter().copied().collect())
            .collect();
        let shared = (0..last as u32).filter(|p| on.iter().filter(|s| s.contains(p)).count() > 1);
        let inner: usize = fitted
            .surfaces
            .iter()
            .map(|s| (s.spans[0] + 1) * (s.spans[1] + 1))
            .sum();
        assert_eq!(shared.count(), last - inner);
    }
}

#[test]
fn quads_of_meshes_of_the_demos_have_layouts() {
    let Some(archive) = archive() else {
        return crate::common::skip::skip_unless_ci(MISSING);
    };
    for (name, quads) in [("fandisk", 1000), ("eight", 600), ("knot1", 600)] {
        let mesh = io::read(archive.join(format!("{name}.off"))).unwrap();
        let [base, simplified] = patches(&quads_of(&mesh, quads));
        assert!(3 * simplified <= base, "{name}: {simplified} of {base}");
    }
}
