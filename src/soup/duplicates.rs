//! Step 4: triangles with the same corners.
//!
//! Of those that run the same way, the first stays. What is then left are pairs that run against each
//! other. Those that hang together over edges form a sheet. Where other triangles meet its whole rim, the sheet
//! is a wall between two solids, and both sides stay: each closes its own solid when edges are cut. Any
//! other sheet is a surface that was given with both of its sides, and the first triangle of each pair
//! stays. A lone pair without neighbors stays as well: it is a closed surface as it is.

use super::edges::Edges;
use super::edits::EditKind;
use super::lists::NONE;
use super::surface::Surface;
use super::weld::hash;

/// Drops what repeats. Whether anything was dropped is the result.
pub(super) fn drop_duplicates(surface: &mut Surface) -> bool {
    let first = first_with_corners(&surface.triangles);
    if first.iter().enumerate().all(|(t, &f)| t == f as usize) {
        return false;
    }
    let mut keep = vec![true; first.len()];
    // The first triangle that runs against the first of its corners.
    let mut against = vec![NONE; first.len()];
    for t in 0..first.len() {
        let f = first[t] as usize;
        let same = match () {
            () if f == t => continue,
            () if same_direction(surface.triangles[f], surface.triangles[t]) => first[t],
            () if against[f] != NONE => against[f],
            () => {
                against[f] = t as u32;
                continue;
            }
        };
        keep[t] = false;
        let polygons = [surface.polygon[t], surface.polygon[same as usize]];
        surface
            .edits
            .add(EditKind::DuplicateDropped, polygons[0], polygons[1]);
    }
    surface.retain(|t| keep[t]);
    drop_second_sides(surface) || keep.contains(&false)
}

/// Of every sheet with a free rim, one side stays.
fn drop_second_sides(surface: &mut Surface) -> bool {
    let first = first_with_corners(&surface.triangles);
    let mut twice = vec![false; first.len()];
    for (t, &f) in first.iter().enumerate() {
        if t != f as usize {
            twice[f as usize] = true;
        }
    }
    if !twice.contains(&true) {
        return false;
    }
    // Sheets as a forest over the first triangles of the pairs.
    let mut parent: Vec<u32> = (0..first.len() as u32).collect();
    let mut free = vec![false; first.len()];
    let mut met = vec![false; first.len()];
    let vertices = surface.positions.len();
    Edges::of(vertices, &surface.triangles).each(|halves| {
        let paired = halves.iter().map(|&h| first[h as usize / 3]);
        let paired: Vec<_> = paired.filter(|&f| twice[f as usize]).collect();
        for pair in paired.windows(2) {
            unite(&mut parent, pair[0], pair[1]);
        }
        if let Some(&f) = paired.first() {
            free[f as usize] |= halves.len() == 2;
            met[f as usize] |= paired.len() < halves.len();
        }
    });
    let mut pairs = vec![0; first.len()];
    for f in 0..free.len() {
        let root = find(&mut parent, f as u32) as usize;
        free[root] |= free[f];
        met[root] |= met[f];
        pairs[root] += usize::from(twice[f]);
    }
    let one_side = |root: usize| match met[root] {
        true => free[root],
        false => pairs[root] > 1,
    };
    let mut keep = vec![true; first.len()];
    for (t, &f) in first.iter().enumerate() {
        if t != f as usize && one_side(find(&mut parent, f) as usize) {
            keep[t] = false;
            let polygons = [surface.polygon[t], surface.polygon[f as usize]];
            surface
                .edits
                .add(EditKind::OppositeDropped, polygons[0], polygons[1]);
        }
    }
    surface.retain(|t| keep[t]);
    keep.contains(&false)
}

/// For each triangle the first with the same corners, in any order.
pub(super) fn first_with_corners(triangles: &[[u32; 3]]) -> Vec<u32> {
    let size = (2 * triangles.len()).next_power_of_two().max(2);
    let shift = 64 - size.trailing_zeros();
    let mut table = vec![NONE; size];
    let sorted = |t: usize| {
        let mut corners = triangles[t];
        corners.sort_unstable();
        corners
    };
    let first = |t: usize| {
        let corners = sorted(t);
        let mut slot = (hash(corners.map(u64::from)) >> shift) as usize;
        loop {
            match table[slot] {
                NONE => {
                    table[slot] = t as u32;
                    return t as u32;
                }
                other if sorted(other as usize) == corners => return other,
                _ => slot = (slot + 1) & (size - 1),
            }
        }
    };
    (0..triangles.len()).map(first).collect()
}

/// Whether two triangles with the same corners run the same way.
fn same_direction(a: [u32; 3], [b, c, d]: [u32; 3]) -> bool {
    a == [b, c, d] || a == [c, d, b] || a == [d, b, c]
}

fn find(parent: &mut [u32], t: u32) -> u32 {
    let mut root = t;
    while parent[root as usize] != root {
        parent[root as usize] = parent[parent[root as usize] as usize];
        root = parent[root as usize];
    }
    root
}

fn unite(parent: &mut [u32], a: u32, b: u32) {
    let (a, b) = (find(parent, a), find(parent, b));
    parent[a.max(b) as usize] = a.min(b);
}
