//! Step 8: components below a share of the area are dropped, where asked for.

use super::edges::manifold_twins;
use super::edits::EditKind;
use super::lists::NONE;
use super::surface::{Surface, area};

/// Drops components with less than this share of the area; the largest stays.
pub(super) fn drop_small(surface: &mut Surface, share: f64) {
    let Some(twin) = manifold_twins(surface.positions.len(), &surface.triangles) else {
        return;
    };
    let (component, count) = components(&twin);
    // Relative to the largest coordinate, so that no square leaves the range of numbers.
    let largest = surface.positions.iter().flatten();
    let largest = largest.fold(f64::MIN_POSITIVE, |m: f64, x| m.max(x.abs()));
    let mut areas = vec![0.0; count];
    for t in 0..surface.triangles.len() {
        let corners = surface.corners(t).map(|p| p.map(|x| x / largest));
        areas[component[t] as usize] += area(corners);
    }
    let total: f64 = areas.iter().sum();
    let most = (0..count).fold(0, |best, c| if areas[c] > areas[best] { c } else { best });
    let keep = |c: usize| c == most || areas[c] >= share * total;
    let mut dropped: Vec<[u32; 2]> = vec![[NONE, 0]; count];
    for (t, &c) in component.iter().enumerate() {
        let [lowest, number] = dropped[c as usize];
        dropped[c as usize] = [lowest.min(surface.polygon[t]), number + 1];
    }
    for c in (0..count).filter(|&c| !keep(c)) {
        let [lowest, number] = dropped[c];
        surface
            .edits
            .add(EditKind::ComponentDropped, lowest, number);
    }
    surface.retain(|t| keep(component[t] as usize));
}

/// The component of every triangle, and their number.
fn components(twin: &[u32]) -> (Vec<u32>, usize) {
    let mut component = vec![NONE; twin.len() / 3];
    let mut count = 0;
    let mut open = Vec::new();
    for seed in 0..component.len() {
        if component[seed] != NONE {
            continue;
        }
        component[seed] = count;
        open.push(seed);
        while let Some(t) = open.pop() {
            for across in &twin[3 * t..3 * t + 3] {
                if *across != NONE && component[*across as usize / 3] == NONE {
                    component[*across as usize / 3] = count;
                    open.push(*across as usize / 3);
                }
            }
        }
        count += 1;
    }
    (component, count as usize)
}
