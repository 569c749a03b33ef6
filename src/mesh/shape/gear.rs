//! A spur gear with a bore: a mechanical part with many sharp edges.
//!
//! An annulus from the bore to the root circle, a patch for every tooth, and straight walls. It
//! stands in for the pinion of the literature, which may not be redistributed.

use std::f64::consts::TAU;

use super::divide;
use super::quads::Quads;
use crate::mesh::{MeshError, TriangleMesh};

const TEETH: usize = 12;
const BORE: f64 = 0.4;
const ROOT: f64 = 1.0;
const TIP: f64 = 1.25;
const HALF_THICKNESS: f64 = 0.25;
/// The part of a pitch that a tooth takes at the root circle and at its tip.
const BASE_PART: f64 = 0.56;
const TIP_PART: f64 = 0.3;

/// A gear about the z axis.
pub(super) fn gear(target: usize) -> Result<TriangleMesh, MeshError> {
    let pitch = TAU / TEETH as f64;
    // Along tooth and gap at a middle radius; from bore to root, root to tip; the thickness.
    let lengths = [
        0.8 * BASE_PART * pitch,
        0.8 * (1.0 - BASE_PART) * pitch,
        ROOT - BORE,
        TIP - ROOT,
        2.0 * HALF_THICKNESS,
    ];
    let triangles = |[tooth, gap, body, height, layers]: [usize; 5]| {
        let flat = (tooth + gap) * body + tooth * height;
        let border = 2 * (tooth + gap) + 2 * height;
        2 * TEETH * (2 * flat + border * layers)
    };
    let [tooth, gap, body, height, layers] = divide(lengths, 1, target, triangles);
    let mut quads = Quads::default();
    for t in 0..TEETH {
        let centre = pitch * t as f64;
        let half_base = 0.5 * BASE_PART * pitch;
        let half_tip = 0.5 * TIP_PART * pitch;
        let sector = |angle: f64, width: f64| {
            move |u: f64, v: f64| polar(angle - u * width, BORE + v * (ROOT - BORE))
        };
        quads.add_patch(tooth, body, sector(centre + half_base, 2.0 * half_base));
        let next = centre + pitch - half_base;
        quads.add_patch(gap, body, sector(next, pitch - 2.0 * half_base));
        quads.add_patch(tooth, height, |u, v| {
            let half = half_base + v * (half_tip - half_base);
            polar(centre + half - u * 2.0 * half, ROOT + v * (TIP - ROOT))
        });
    }
    quads.weld().extrude(HALF_THICKNESS, layers).triangulate()
}

fn polar(angle: f64, radius: f64) -> [f64; 3] {
    let (sin, cos) = angle.sin_cos();
    [radius * cos, radius * sin, 0.0]
}
