//! Small soups with every defect, made of arbitrary bytes, and what must hold after their repair.

use libfuzzer_sys::arbitrary::{Result, Unstructured};
use roundel::mesh::TriangleMesh;
use roundel::soup::{PolygonSoup, RepairOptions, Repaired, SoupError, repair};

/// A soup of at most 40 vertices and 60 polygons. Coordinates are often equal, so that much is degenerate.
pub fn soup(u: &mut Unstructured) -> Result<PolygonSoup> {
    let side = u.int_in_range(1..=5)?;
    let mut soup = PolygonSoup::default();
    for _ in 0..u.int_in_range(0..=40)? {
        let position = [coordinate(u, side)?, coordinate(u, side)?, coordinate(u, side)?];
        soup.add_vertex(position);
    }
    let count = soup.positions().len() as i64;
    for _ in 0..u.int_in_range(0..=60)? {
        let corners = if u.ratio(3u8, 4u8)? { 3 } else { u.int_in_range(0..=9)? };
        let corner = |u: &mut Unstructured| match u.ratio(1u8, 200u8)? {
            true => u.int_in_range(-2..=count + 2),
            false => u.int_in_range(0..=(count - 1).max(0)),
        };
        let corners: Vec<i64> = (0..corners).map(|_| corner(u)).collect::<Result<_>>()?;
        soup.add_polygon(corners);
    }
    Ok(soup)
}

/// A number on a small grid, now and then with an error of rounding, rarely any 64 bits.
fn coordinate(u: &mut Unstructured, side: i8) -> Result<f64> {
    let number = f64::from(u.int_in_range(-side..=side)?);
    Ok(match u.int_in_range(0u8..=255)? {
        0 => f64::from_bits(u.arbitrary()?),
        1..=8 => number * (1.0 + 1e-15 * f64::from(u.arbitrary::<i8>()?)),
        9..=12 => number + 1e-9 * f64::from(u.arbitrary::<i8>()?),
        _ => number,
    })
}

pub fn options(u: &mut Unstructured) -> Result<RepairOptions> {
    let mut options = RepairOptions::default();
    if u.ratio(1u8, 4u8)? {
        options.weld = [1e-9, 0.5, 1.0, 3.0][u.int_in_range(0..=3usize)?];
    }
    if u.ratio(1u8, 8u8)? {
        options.drop_components = [0.01, 0.2, 1.0][u.int_in_range(0..=2usize)?];
    }
    if u.ratio(1u8, 4u8)? {
        options.fill_holes = u.int_in_range(1..=12)?;
    }
    Ok(options)
}

/// The strict mesh accepts what repair gives, the maps agree with each other, and a second repair by the
/// default options has nothing to do.
pub fn check(soup: &PolygonSoup, options: &RepairOptions) {
    let repaired = match repair(soup, options) {
        Ok(repaired) => repaired,
        Err(SoupError::NoSurface { .. }) => return,
        Err(other) => panic!("{other}"),
    };
    let Repaired { vertices, triangles, .. } = &repaired;
    if let Err(refused) = TriangleMesh::new(vertices.clone(), triangles.clone()) {
        panic!("{refused}: {soup:?} {options:?}");
    }
    check_maps(soup, &repaired);
    let again = repair(&PolygonSoup::of_triangles(vertices.clone(), triangles), &RepairOptions::default());
    let again = again.expect("a mesh is a surface");
    assert!(again.edits.is_empty(), "{}: {soup:?} {options:?}", again.edits.summary());
    assert_eq!((&again.vertices, &again.triangles), (vertices, triangles));
}

fn check_maps(soup: &PolygonSoup, repaired: &Repaired) {
    assert_eq!(repaired.vertex_origin.len(), repaired.vertices.len());
    assert_eq!(repaired.triangle_origin.len(), repaired.triangles.len());
    for (vertex, origin) in repaired.vertex_origin.iter().enumerate() {
        let Some(origin) = *origin else { continue };
        assert_eq!(repaired.vertices[vertex], soup.positions()[origin as usize]);
        assert!(repaired.vertices_of(origin as usize).contains(&(vertex as u32)));
        assert_eq!(repaired.welded_to(origin as usize), Some(origin));
    }
    for (triangle, origin) in repaired.triangle_origin.iter().enumerate() {
        let Some(origin) = *origin else { continue };
        assert!(repaired.triangles_of(origin as usize).contains(&(triangle as u32)));
    }
    let known = repaired.triangle_origin.iter().flatten().count();
    let listed = (0..soup.polygon_count()).map(|p| repaired.triangles_of(p).len());
    assert_eq!(listed.sum::<usize>(), known);
    for vertex in 0..soup.positions().len() {
        for &made in repaired.vertices_of(vertex) {
            assert_eq!(repaired.vertex_origin[made as usize], repaired.welded_to(vertex));
        }
    }
}
