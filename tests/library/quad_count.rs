//! The number of quads that is asked for is met, and nothing is lost for it.

use roundel::map::Sizing;
use roundel::mesh::{TriangleMesh, shape};
use roundel::quad::{Count, QuadOptions, Quadrangulation, quadrangulate};
use roundel::{Monitor, search::OptionValue};

fn options(quads: usize, count: Count) -> QuadOptions {
    QuadOptions {
        sizing: Sizing::Quads(quads),
        count,
        ..QuadOptions::default()
    }
}

fn made(mesh: &TriangleMesh, options: &QuadOptions) -> Quadrangulation {
    quadrangulate(mesh, options, Monitor::default).unwrap()
}

fn off(made: &Quadrangulation, asked: usize) -> f64 {
    (made.quads.quads.len() as f64 / asked as f64 - 1.0).abs()
}

#[test]
fn numbers_are_met_with_the_same_field_and_quads_that_conform() {
    let (mut met, mut off_before, mut off_after) = (0, 0.0, 0.0);
    for name in ["torus", "genus-2", "sphere", "rounded-cube"] {
        let mesh = shape::by_name(name, 2000).unwrap();
        for asked in [350, 500, 900] {
            let about = made(&mesh, &options(asked, Count::About));
            let exact = made(&mesh, &options(asked, Count::Exact));
            assert_eq!(about.maps_for_count, 0);
            assert_eq!(about.field, exact.field, "{name} {asked}");
            assert!(exact.quads.is_conforming() || !about.quads.is_conforming());
            assert!(off(&exact, asked) <= off(&about, asked), "{name} {asked}");
            assert!(exact.maps_for_count <= 6);
            met += usize::from(off(&exact, asked) <= 0.01);
            off_before += off(&about, asked);
            off_after += off(&exact, asked);
        }
    }
    // Cubes and spheres have few integers, and large steps between numbers of quads.
    assert!(
        met >= 6 && off_after < 0.5 * off_before,
        "{met} of 12 met, {off_before} {off_after}"
    );
}

#[test]
fn lengths_of_edges_need_no_other_maps() {
    let mesh = shape::by_name("genus-2", 2000).unwrap();
    let edge = Sizing::Quads(500).edge_length(&mesh);
    let by_length = |count| QuadOptions {
        sizing: Sizing::EdgeLength(edge),
        count,
        ..QuadOptions::default()
    };
    let [about, exact] = [Count::About, Count::Exact].map(|count| made(&mesh, &by_length(count)));
    assert_eq!(exact.maps_for_count, 0);
    assert_eq!(about.quads.vertices, exact.quads.vertices);
    assert_eq!(about.quads.quads, exact.quads.quads);
}

#[test]
fn quads_are_the_same_on_one_thread_and_on_two() {
    let mesh = shape::by_name("genus-3", 2000).unwrap();
    let [one, two] = [1, 2].map(|threads| {
        let mut options = options(700, Count::Exact);
        options.field.threads = threads;
        options.map.threads = threads;
        made(&mesh, &options)
    });
    assert_eq!(one.maps_for_count, two.maps_for_count);
    assert_eq!(one.quads.vertices, two.quads.vertices);
    assert_eq!(one.quads.quads, two.quads.quads);
}

#[test]
fn components_meet_their_number_together() {
    let [torus, cube] = ["torus", "rounded-cube"].map(|name| shape::by_name(name, 1000).unwrap());
    let first = torus.vertex_count() as u32;
    let mut points = torus.vertices().to_vec();
    points.extend(cube.vertices().iter().map(|p| [p[0] + 9.0, p[1], p[2]]));
    let mut triangles = torus.triangles().to_vec();
    triangles.extend(cube.triangles().iter().map(|t| t.map(|v| v + first)));
    let both = TriangleMesh::new(points, triangles).unwrap();
    let about = made(&both, &options(800, Count::About));
    let exact = made(&both, &options(800, Count::Exact));
    assert!(exact.quads.is_conforming());
    assert!(off(&exact, 800) <= off(&about, 800).min(0.02));
}

#[test]
fn the_count_is_set_by_its_word() {
    let mut options = QuadOptions::default();
    assert_eq!(options.count, Count::Exact);
    let set = |options: &mut QuadOptions, word: &str| {
        options.set("count", &OptionValue::Text(word.into()))
    };
    set(&mut options, "about").unwrap();
    assert_eq!(options.count, Count::About);
    assert!(set(&mut options, "nearly").is_err());
}
