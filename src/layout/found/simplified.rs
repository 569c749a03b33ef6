//! The simplified layout of quads: the same irregular vertices, and fewer patches.

use super::coarse::CoarseMaps;
use super::drift::{Drift, drift};
use super::relax::relax;
use super::triangulated::Triangulated;
use super::{FoundLayout, QuadSurface};
use crate::error::{Error, Result};
use crate::extract::{IntegerGridMap, QuadMesh, extract};
use crate::map::SeamlessMap;
use crate::monitor::Monitor;
use crate::smooth::{QuadQuality, SmoothOptions};

/// The factor from one number of quads that is tried to the next.
const FINER: usize = 2;

/// Options of [`simplify`].
#[derive(Debug, Clone, PartialEq)]
pub struct SimplifyOptions {
    /// The largest drift of an arc across the lines of the quads, in their edges; above zero.
    pub deviation: f64,
    /// The angle between faces, in radians, from which on an edge of the quads stays a line; above zero. None is as
    /// sharp as an angle above pi.
    pub features: f64,
    /// The number of times that the new quads are smoothed. Irregular vertices stay in place where no quad is inverted
    /// then.
    pub smoothing: usize,
}

impl Default for SimplifyOptions {
    fn default() -> Self {
        SimplifyOptions {
            deviation: f64::INFINITY,
            features: f64::INFINITY,
            smoothing: 10,
        }
    }
}

/// A layout with fewer patches, on quads of its own that follow it.
#[derive(Debug, Clone, PartialEq)]
pub struct Simplified {
    /// Quads on the given ones, in about the same number, with irregular vertices of the same valences.
    pub surface: QuadSurface,
    /// Their base complex.
    pub layout: FoundLayout,
    /// How far its arcs leave the lines of the given quads.
    pub drift: Drift,
}

/// The layout with the same irregular vertices as these quads and as few patches as are found, whose arcs keep within
/// a drift across the lines of the quads.
///
/// Maps of more and more quads that follow the lines are tried. The first is taken whose arcs stay within the limit;
/// where none does, the quads' own base complex is the result.
///
/// # Errors
/// [`Error::InvalidArgument`] for options out of range, [`Error::Input`] for a quad without area, [`Error::Cancelled`].
pub fn simplify<'m>(
    surface: &QuadSurface,
    options: &SimplifyOptions,
    monitor: impl Fn() -> Monitor<'m>,
) -> Result<Simplified> {
    check(options)?;
    let own = FoundLayout::base_complex(surface);
    let triangles = Triangulated::new(surface)?;
    let features = triangles.sharp_edges(options.features);
    let given = surface.quads().len();
    let mut quads = least_patches(surface);
    let is_closed = !(0..surface.positions().len()).any(|v| surface.is_boundary(v));
    if is_closed && own.patches.len() <= quads {
        return Ok(Simplified::unchanged(surface, own));
    }
    let mut maps = CoarseMaps::new(&triangles, &features, quads)?;
    while quads < given {
        if let Some(map) = maps.map(quads, &monitor)? {
            let found = follow(surface, &triangles, &features, &map, options, &monitor)?;
            let is_better = |found: &Simplified| {
                found.drift.largest <= options.deviation
                    && found.layout.patches.len() < own.patches.len()
            };
            if let Some(found) = found.filter(is_better) {
                return Ok(found);
            }
        }
        quads *= FINER;
    }
    Ok(Simplified::unchanged(surface, own))
}

impl Simplified {
    /// The layout that the quads have themselves.
    fn unchanged(surface: &QuadSurface, layout: FoundLayout) -> Self {
        Simplified {
            surface: surface.clone(),
            layout,
            drift: Drift::default(),
        }
    }
}

fn check(options: &SimplifyOptions) -> Result<()> {
    for (what, value) in [
        ("deviation", options.deviation),
        ("feature angle", options.features),
    ] {
        if value.is_nan() || value <= 0.0 {
            return Err(Error::InvalidArgument {
                what: format!("the {what} is {value}; it must be above zero"),
                index: None,
            });
        }
    }
    Ok(())
}

/// The number of patches of a layout of a closed surface in which no two arcs cross: that of irregular vertices less
/// the Euler characteristic. On one with boundary it is where the search begins.
fn least_patches(surface: &QuadSurface) -> usize {
    let irregular = (0..surface.positions().len()).filter(|&v| surface.is_irregular(v));
    let least = irregular.count() as i64 - surface.euler_characteristic();
    usize::try_from(least).unwrap_or(0).max(4)
}

/// The layout of a map, on quads in about the number of the given ones; none if these have other irregular vertices.
fn follow<'m>(
    surface: &QuadSurface,
    triangles: &Triangulated,
    features: &[usize],
    map: &SeamlessMap,
    options: &SimplifyOptions,
    monitor: &impl Fn() -> Monitor<'m>,
) -> Result<Option<Simplified>> {
    let mesh = &triangles.mesh;
    let uvs = map.corner_uvs();
    let doubled =
        |[a, b, c]: &[[f64; 2]; 3]| (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
    let covered: f64 = uvs.iter().map(doubled).sum::<f64>() / 2.0;
    let times = (surface.quads().len() as f64 / covered.max(1.0))
        .sqrt()
        .round()
        .max(1.0);
    let finer: Vec<_> = uvs
        .iter()
        .map(|corners| corners.map(|uv| uv.map(|x| times * x)))
        .collect();
    // A map whose coordinates are out of range, say, is as good as none.
    let Ok(exact) = IntegerGridMap::new(mesh, &finer) else {
        return Ok(None);
    };
    let mut quads = extract(mesh, &exact, &mut monitor())?;
    if !quads.is_conforming() || quads.partial_cells > 0 {
        return Ok(None);
    }
    smooth(&mut quads, triangles, features, options, monitor)?;
    let Ok(followed) = QuadSurface::new(quads.vertices, quads.quads) else {
        return Ok(None);
    };
    if irregular(&followed) != irregular(surface) {
        return Ok(None);
    }
    let layout = FoundLayout::base_complex(&followed);
    Ok(Some(Simplified {
        drift: drift(&followed, &layout, surface, triangles),
        surface: followed,
        layout,
    }))
}

/// Smooths quads with irregular vertices in place or, if that leaves inverted quads, with all vertices free.
fn smooth<'m>(
    quads: &mut QuadMesh,
    triangles: &Triangulated,
    features: &[usize],
    options: &SimplifyOptions,
    monitor: &impl Fn() -> Monitor<'m>,
) -> Result<()> {
    let mesh = &triangles.mesh;
    let mut in_place = quads.clone();
    relax(&mut in_place, mesh, features, options.smoothing);
    if QuadQuality::new(&in_place).inverted == 0 {
        *quads = in_place;
        return Ok(());
    }
    let free = SmoothOptions {
        rounds: options.smoothing,
        uniformity: 0.0,
        features: features.to_vec(),
        ..SmoothOptions::default()
    };
    crate::smooth::smooth(quads, mesh, &free, &mut monitor())
}

/// Of every irregular vertex, whether it is on the boundary and its number of quads; in increasing order.
fn irregular(surface: &QuadSurface) -> Vec<(bool, usize)> {
    let irregular = (0..surface.positions().len()).filter(|&v| surface.is_irregular(v));
    let mut found: Vec<_> = irregular
        .map(|v| (surface.is_boundary(v), surface.valence(v)))
        .collect();
    found.sort_unstable();
    found
}
