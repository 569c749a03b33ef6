//! The steps of repair, one after the other.

use super::clean::{Seam, clean, seam};
use super::components::drop_small;
use super::cut::cut;
use super::duplicates::drop_duplicates;
use super::edits::EditKind;
use super::fill::fill_holes;
use super::lists::{Lists, NONE};
use super::near::{flatten, within};
use super::slivers::remove_slivers;
use super::surface::Surface;
use super::triangulate::triangulate;
use super::weld::equal_positions;
use super::{PolygonSoup, RepairOptions, Repaired, SoupError};

/// Makes an oriented manifold triangle mesh of a soup, and says what it did.
///
/// A soup that the strict mesh accepts comes back as it is, unless its boundary edges lie on each other: then
/// they are welded. The vertices keep the order of the soup, those that repair made come last; the triangles
/// keep the order of the polygons.
///
/// # Errors
/// [`SoupError::NoSurface`] if nothing is left, or if more than half of the polygons name vertices that are
/// not there; [`SoupError::TooLarge`].
pub fn repair(soup: &PolygonSoup, options: &RepairOptions) -> Result<Repaired, SoupError> {
    check_size(soup)?;
    let (mut surface, stands_for) = to_manifold(soup, options.weld);
    if options.drop_components > 0.0 && !surface.triangles.is_empty() {
        drop_small(&mut surface, options.drop_components);
    }
    if options.fill_holes > 0 {
        fill_holes(&mut surface, options.fill_holes);
    }
    // What is left of such a file is not what it was meant to hold.
    let lost = surface.edits.count(EditKind::PolygonOutOfRange);
    if surface.triangles.is_empty() || 2 * lost > soup.polygon_count() {
        return Err(no_surface(soup, &surface));
    }
    Ok(finish(soup, surface, stands_for))
}

/// Steps 1 to 7, or the soup itself if it needs none of them.
fn to_manifold(soup: &PolygonSoup, tolerance: f64) -> (Surface, Vec<u32>) {
    let exact = equal_positions(soup.positions());
    let mut stands_for = exact.clone();
    if tolerance > 0.0 {
        within(soup.positions(), tolerance, &mut stands_for);
    }
    if stands_for != exact {
        return repaired(soup, stands_for);
    }
    let welds = exact.iter().enumerate().any(|(v, &to)| to != v as u32);
    let seam = if welds {
        seam(soup, &exact)
    } else {
        Seam::None
    };
    if seam == Seam::Against {
        return repaired(soup, stands_for);
    }
    let Some(triangles) = clean(soup) else {
        return repaired(soup, stands_for);
    };
    if seam == Seam::Alike {
        let (surface, stands_for) = repaired(soup, stands_for);
        let few = [
            EditKind::VertexWelded,
            EditKind::PolygonTurned,
            EditKind::ComponentTurned,
        ];
        if few
            .map(|kind| surface.edits.count(kind))
            .iter()
            .sum::<usize>()
            == surface.edits.list().len()
        {
            return (surface, stands_for);
        }
    }
    unchanged(soup, triangles)
}

/// Triangles, vertices and half-edges must have 32-bit numbers; edits may double them.
fn check_size(soup: &PolygonSoup) -> Result<(), SoupError> {
    let corners: usize = soup.polygons().map(<[i64]>::len).sum();
    let most = u32::MAX as usize / 16;
    if soup.positions().len() > most || corners > most || soup.polygon_count() > most {
        return Err(SoupError::TooLarge {
            vertices: soup.positions().len(),
            polygons: soup.polygon_count(),
        });
    }
    Ok(())
}

fn no_surface(soup: &PolygonSoup, surface: &Surface) -> SoupError {
    let lost = surface.edits.count(EditKind::PolygonOutOfRange);
    let reason = match soup.polygon_count() {
        count if lost > 0 => {
            format!("{lost} of {count} polygons name vertices that are not there")
        }
        0 => format!("{} vertices and no polygon", soup.positions().len()),
        count => format!(
            "of {count} polygons none has an area ({})",
            surface.edits.summary()
        ),
    };
    SoupError::NoSurface { reason }
}

fn unchanged(soup: &PolygonSoup, triangles: Vec<[u32; 3]>) -> (Surface, Vec<u32>) {
    let count = triangles.len() as u32;
    let vertices = soup.positions().len() as u32;
    let surface = Surface {
        positions: soup.positions().to_vec(),
        before: triangles.clone(),
        triangles,
        polygon: (0..count).collect(),
        origin: (0..vertices).collect(),
        ..Surface::default()
    };
    (surface, (0..vertices).collect())
}

/// Steps 1 to 7, and for each input vertex the one that stands for it.
fn repaired(soup: &PolygonSoup, mut stands_for: Vec<u32>) -> (Surface, Vec<u32>) {
    let mut surface = Surface {
        positions: soup.positions().to_vec(),
        origin: (0..soup.positions().len() as u32).collect(),
        ..Surface::default()
    };
    for (v, &to) in stands_for.iter().enumerate() {
        if to == NONE {
            surface.edits.add(EditKind::VertexNotFinite, v as u32, None);
        }
    }
    for (v, &to) in stands_for.iter().enumerate() {
        if to != NONE && to != v as u32 {
            surface.edits.add(EditKind::VertexWelded, v as u32, to);
        }
    }
    triangulate(soup, &stands_for, &mut surface);
    drop_duplicates(&mut surface);
    if remove_slivers(&mut surface, &mut stands_for) {
        flatten(&mut stands_for);
        drop_duplicates(&mut surface);
    }
    let mut surface = cut(surface);
    let mut used = vec![false; surface.positions.len()];
    for &v in surface.triangles.as_flattened() {
        used[v as usize] = true;
    }
    for (v, &to) in stands_for.iter().enumerate() {
        if to == v as u32 && !used[v] {
            surface.edits.add(EditKind::VertexUnused, to, None);
        }
    }
    (surface, stands_for)
}

/// Drops unused vertices, and makes the maps.
fn finish(soup: &PolygonSoup, mut surface: Surface, stands_for: Vec<u32>) -> Repaired {
    let mut number = vec![NONE; surface.positions.len()];
    for &v in surface.triangles.as_flattened() {
        number[v as usize] = 0;
    }
    let mut vertices = Vec::with_capacity(number.len());
    let mut origin = Vec::with_capacity(number.len());
    for v in 0..number.len() {
        if number[v] == 0 {
            number[v] = vertices.len() as u32;
            vertices.push(surface.positions[v]);
            origin.push(surface.origin[v]);
        }
    }
    for v in surface.triangles.as_flattened_mut() {
        *v = number[*v as usize];
    }
    let some = |&n: &u32| (n != NONE).then_some(n);
    Repaired {
        vertices,
        vertex_origin: origin.iter().map(some).collect(),
        triangle_origin: surface.polygon.iter().map(some).collect(),
        vertices_of: Lists::by_key(soup.positions().len(), origin.iter().copied()),
        triangles_of: Lists::by_key(soup.polygon_count(), surface.polygon.iter().copied()),
        triangles: surface.triangles,
        edits: surface.edits,
        stands_for,
    }
}
