//! Layouts that are good, and what is wrong with others.

use super::*;

/// The corners of the unit cube by bits, and its sides, seen from outside.
pub(in crate::layout) fn cube() -> BaseLayout {
    let at = |v: usize| [0, 1, 2].map(|axis| (v >> axis & 1) as f64);
    let sides = [
        [0, 2, 3, 1],
        [4, 5, 7, 6],
        [0, 1, 5, 4],
        [2, 6, 7, 3],
        [0, 4, 6, 2],
        [1, 3, 7, 5],
    ];
    let polygons = sides.iter().map(|side| side.to_vec()).collect();
    BaseLayout::new((0..8).map(at).collect(), polygons).unwrap()
}

fn flat(polygons: &[&[u32]]) -> Result<BaseLayout> {
    let count = polygons.iter().flat_map(|p| p.iter()).max().unwrap_or(&0) + 1;
    let positions = (0..count).map(|v| [v.into(), 0.0, 0.0]).collect();
    BaseLayout::new(positions, polygons.iter().map(|p| p.to_vec()).collect())
}

#[test]
fn darts_around_a_vertex_turn_counter_clockwise() {
    let cube = cube();
    assert_eq!((cube.arc_count(), cube.euler_characteristic()), (12, 2));
    for v in 0..8 {
        let around: Vec<Dart> = cube.around(v).collect();
        assert_eq!((around.len(), cube.valence(v)), (3, 3));
        let ways: Vec<Vec3> = around
            .iter()
            .map(|&dart| {
                assert_eq!(cube.tail(dart), v as u32);
                let [a, b] =
                    [dart, reversed(dart)].map(|d| cube.positions()[cube.tail(d) as usize]);
                sub(b, a)
            })
            .collect();
        let outwards = sub(cube.positions()[v], [0.5; 3]);
        let turn = crate::mesh::vector::dot(cross(ways[0], ways[1]), outwards);
        assert!(turn > 0.0, "vertex {v}");
    }
    assert_eq!(cube.arc_between(0, 1), cube.arc_between(1, 0));
    assert_eq!(cube.arc_between(0, 7), None);
    assert_eq!(cube.arc_between(9, 0), None);
}

#[test]
fn at_the_boundary_the_first_dart_has_no_polygon_on_its_right() {
    let strip = flat(&[&[0, 1, 4, 3], &[1, 2, 5, 4]]).unwrap();
    assert!((0..6).all(|v| strip.is_boundary_vertex(v)));
    let around: Vec<Dart> = strip.around(1).collect();
    assert_eq!((around.len(), strip.valence(1)), (3, 2));
    assert!(strip.polygon_left_of(reversed(around[0])).is_none());
    assert!(strip.polygon_left_of(around[2]).is_none());
    assert_eq!((0..7).filter(|&arc| strip.is_boundary_arc(arc)).count(), 6);
}

#[test]
fn turned_over_twice_is_as_before() {
    for layout in [
        cube(),
        flat(&[&[0, 1, 4, 3], &[1, 2, 5, 4], &[3, 4, 6]]).unwrap(),
    ] {
        let turned = layout.turned_over();
        let polygons = layout.polygons().len();
        for p in 0..polygons {
            let sum = add(turned.area_vector(p), layout.area_vector(p));
            assert!(crate::mesh::vector::norm(sum) < 1e-12);
        }
        for v in 0..layout.vertex_count() {
            let back: Vec<Dart> = turned.around(v).collect();
            let mut there: Vec<Dart> = layout.around(v).collect();
            there.reverse();
            let first = there.iter().position(|d| d == &back[0]).unwrap();
            there.rotate_left(first);
            assert_eq!(back, there, "vertex {v}");
        }
        assert_eq!(turned.turned_over().sides(), layout.sides());
    }
}

#[test]
fn bad_layouts_name_what_is_wrong() {
    for (polygons, index, words) in [
        (&[][..], None, "no polygons"),
        (&[&[0, 1, 2][..], &[0, 1]][..], Some(1), "2 sides"),
        (&[&[0, 1, 2, 1]], Some(0), "vertex 1 twice"),
        (
            &[&[0, 1, 2], &[0, 1, 3]],
            Some(1),
            "from vertex 0 to vertex 1",
        ),
        (
            &[&[0, 1, 2], &[1, 0, 3], &[0, 1, 4]],
            Some(2),
            "from vertex 0",
        ),
        (
            &[&[0, 1, 3]],
            Some(2),
            "vertex 2 of the layout belongs to no",
        ),
        (&[&[0, 1, 2], &[0, 3, 4]], Some(0), "more than one fan"),
    ] {
        let error = flat(polygons).unwrap_err();
        assert!(error.to_string().contains(words), "{error}");
        assert_eq!(error.index(), index, "{error}");
    }
    let error = BaseLayout::new(vec![[0.0; 3]; 3], vec![vec![0, 1, 3]]).unwrap_err();
    assert_eq!(
        (error.code(), error.index()),
        ("index_out_of_range", Some(0))
    );
    let error = BaseLayout::new(vec![[f64::NAN; 3]; 3], vec![vec![0, 1, 2]]).unwrap_err();
    assert_eq!((error.code(), error.index()), ("not_finite", Some(0)));
}
