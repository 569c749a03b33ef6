//! Step 9: holes of few edges are filled, where asked for.
//!
//! Of all triangulations of a hole's rim that have no inner vertex, the one of least area is found by
//! dynamic programming (`barequet1995`, section 3; `liepa2003`, section 3). Triangles without area, and
//! edges that the surface has already, are not allowed; a hole that cannot be filled without them stays.
//! Nothing tells the rim of an open surface from a hole, so that it is filled as well if it is as short.

use std::collections::BTreeSet;

use super::cut::boundary;
use super::edges::manifold_twins;
use super::edits::EditKind;
use super::lists::NONE;
use super::surface::{Surface, area, flat, tail};

/// Fills all holes of at most so many edges.
pub(super) fn fill_holes(surface: &mut Surface, most: usize) {
    let Some(twin) = manifold_twins(surface.positions.len(), &surface.triangles) else {
        return;
    };
    let holes: Vec<Vec<u32>> = boundary(&surface.triangles, &twin)
        .into_iter()
        .filter(|rim| rim.len() <= most)
        // The three edges of a lone triangle are no hole.
        .filter(|rim| rim.len() > 3 || rim.iter().any(|h| h / 3 != rim[0] / 3))
        .map(|rim| rim.iter().map(|&h| tail(&surface.triangles, h)).collect())
        .collect();
    let mut on_rim = vec![false; surface.positions.len()];
    for &v in holes.iter().flatten() {
        on_rim[v as usize] = true;
    }
    let mut edges = BTreeSet::new();
    for &[a, b, c] in &surface.triangles {
        for [a, b] in [[a, b], [b, c], [c, a]] {
            if on_rim[a as usize] && on_rim[b as usize] {
                edges.insert([a.min(b), a.max(b)]);
            }
        }
    }
    for rim in holes {
        let Some(triangles) = least_area(surface, &rim, &edges) else {
            continue;
        };
        let known = rim.iter().map(|&v| surface.origin[v as usize]).min();
        let named = known.unwrap_or(NONE);
        surface
            .edits
            .add(EditKind::HoleFilled, named, rim.len() as u32);
        for triangle in triangles {
            surface.push(triangle, triangle, NONE);
        }
    }
}

/// The triangulation of least area that runs against the rim, if there is any.
fn least_area(surface: &Surface, rim: &[u32], edges: &BTreeSet<[u32; 2]>) -> Option<Vec<[u32; 3]>> {
    let n = rim.len();
    let corners =
        |i: usize, j: usize, k: usize| [k, j, i].map(|i| surface.positions[rim[i] as usize]);
    let exists = |i: usize, j: usize| {
        let (a, b) = (rim[i], rim[j]);
        edges.contains(&[a.min(b), a.max(b)])
    };
    // The least area between corners i and k, and the corner between them with which it is reached.
    let mut least = vec![0.0; n * n];
    let mut through = vec![0u32; n * n];
    for width in 2..n {
        for i in 0..n - width {
            let k = i + width;
            let rim_edge = width == n - 1;
            let mut best = (f64::INFINITY, 0);
            if rim_edge || !exists(i, k) {
                for j in i + 1..k {
                    let below = least[i * n + j] + least[j * n + k];
                    if below < best.0 {
                        let triangle = corners(i, j, k);
                        let whole = below + area(triangle);
                        if whole < best.0 && !flat(triangle) {
                            best = (whole, j as u32);
                        }
                    }
                }
            }
            least[i * n + k] = best.0;
            through[i * n + k] = best.1;
        }
    }
    if n < 3 || least[n - 1].is_infinite() {
        return None;
    }
    let mut triangles = Vec::with_capacity(n - 2);
    let mut open = vec![(0, n - 1)];
    while let Some((i, k)) = open.pop() {
        if k - i >= 2 {
            let j = through[i * n + k] as usize;
            triangles.push([rim[k], rim[j], rim[i]]);
            open.extend([(i, j), (j, k)]);
        }
    }
    Some(triangles)
}
