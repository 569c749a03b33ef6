//! The steps of repair, one after the other.

use super::clean::Clean;
use super::components::drop_small;
use super::cut::cut;
use super::duplicates::drop_duplicates;
use super::edges::manifold_twins;
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
/// [`SoupError::NoSurface`] if nothing is left, [`SoupError::TooLarge`].
pub fn repair(soup: &PolygonSoup, options: &RepairOptions) -> Result<Repaired, SoupError> {
    check_size(soup)?;
    let exact = equal_positions(soup.positions());
    let mut stands_for = exact.clone();
    if options.weld > 0.0 {
        within(soup.positions(), options.weld, &mut stands_for);
    }
    let clean = match stands_for == exact {
        true => Clean::of(soup),
        false => None,
    };
    let seam = clean.as_ref().is_some_and(|c| c.has_seam(&stands_for));
    let (mut surface, stands_for) = match clean {
        None => repaired(soup, stands_for),
        Some(clean) if !seam => unchanged(soup, clean),
        Some(clean) => {
            let (surface, welded) = repaired(soup, stands_for);
            match boundary_edges(&surface) < clean.boundary_edges() {
                true => (surface, welded),
                false => unchanged(soup, clean),
            }
        }
    };
    if options.drop_components > 0.0 && !surface.triangles.is_empty() {
        drop_small(&mut surface, options.drop_components);
    }
    if options.fill_holes > 0 {
        fill_holes(&mut surface, options.fill_holes);
    }
    if surface.triangles.is_empty() {
        return Err(no_surface(soup, &surface));
    }
    Ok(finish(soup, surface, stands_for))
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
    let reason = match soup.polygon_count() {
        0 => format!("{} vertices and no polygon", soup.positions().len()),
        count => format!(
            "of {count} polygons none has an area ({})",
            surface.edits.summary()
        ),
    };
    SoupError::NoSurface { reason }
}

fn unchanged(soup: &PolygonSoup, clean: Clean) -> (Surface, Vec<u32>) {
    let count = clean.triangles.len() as u32;
    let vertices = soup.positions().len() as u32;
    let surface = Surface {
        positions: soup.positions().to_vec(),
        before: clean.triangles.clone(),
        triangles: clean.triangles,
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

fn boundary_edges(surface: &Surface) -> usize {
    let twin = manifold_twins(surface.positions.len(), &surface.triangles);
    twin.map_or(0, |twin| twin.iter().filter(|&&t| t == NONE).count())
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
