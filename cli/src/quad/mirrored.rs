//! The planes of quads that are mirrored, in one line for people and as JSON.

use roundel::quad::Mirrored;
use serde::Serialize;

use crate::summary::counted;

/// A plane, and how far the mesh is from symmetric about it.
#[derive(Serialize)]
pub(super) struct Plane {
    /// It points to the side that is kept.
    normal: [f64; 3],
    offset: f64,
    deviation: f64,
}

pub(super) fn planes(mirrored: &Mirrored) -> Vec<Plane> {
    let planes = mirrored.planes.iter().map(|plane| Plane {
        normal: plane.normal,
        offset: plane.offset,
        deviation: plane.deviation,
    });
    planes.collect()
}

/// The planes, which side of each is kept, and how symmetric the mesh was.
pub(super) fn mirror_words(mirrored: &Mirrored) -> String {
    let words = mirrored.planes.iter().map(|plane| {
        // The side is told by the largest share of the normal.
        let n = plane.normal;
        let largest = (0..3).fold(0, |k, i| if n[i].abs() > n[k].abs() { i } else { k });
        let side = if n[largest] > 0.0 {
            "larger"
        } else {
            "smaller"
        };
        format!(
            "{plane}, the side of {side} {} is kept, off by {:.2} % of the diagonal",
            ["x", "y", "z"][largest],
            100.0 * plane.deviation
        )
    });
    let mut text = words.collect::<Vec<_>>().join("; ");
    if mirrored.half.small_pieces > 0 {
        let pieces = counted(mirrored.half.small_pieces, "small piece");
        text += &format!("; {pieces} on the wrong side of the cut");
    }
    text
}
