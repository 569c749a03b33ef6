//! Light: a sky that the surface may hide from itself, a key and a fill light, a soft gloss.
//!
//! Colours are linear: proportional to energy, in [0, 1]. They are encoded for the screen once,
//! when samples have been averaged.

use super::camera::Camera;
use roundel::mesh::vector::{Vec3, add, dot, normalize, scale};

/// Red, green and blue, linear.
pub(super) type Color = [f32; 3];

const SKY: f64 = 0.50;
const KEY: f64 = 0.62;
const FILL: f64 = 0.26;
const GLOSS: f64 = 0.08;
const SHARPNESS: i32 = 24;
/// What the surface loses where it turns away from the eye, so that outlines stand out.
const RIM: f64 = 0.35;

/// The lights, which move with the camera.
pub(super) struct Lights {
    up: Vec3,
    key: Vec3,
    fill: Vec3,
    back: Vec3,
    half: Vec3,
}

impl Lights {
    pub(super) fn with(camera: &Camera) -> Lights {
        let from = |x: f64, y: f64, z: f64| {
            let sides = add(scale(camera.right, x), scale(camera.up, y));
            normalize(add(sides, scale(camera.back, z)))
        };
        let key = from(-0.45, 0.65, 0.75);
        Lights {
            up: camera.up,
            key,
            fill: from(0.9, 0.1, 0.5),
            back: camera.back,
            half: normalize(add(key, camera.back)),
        }
    }

    /// The colour of a surface of this colour and normal that sees this part of the sky. Both
    /// sides are lit alike.
    pub(super) fn shade(&self, color: Color, normal: Vec3, sky: f64) -> Color {
        let mut normal = normalize(normal);
        if dot(normal, self.back) < 0.0 {
            normal = scale(normal, -1.0);
        }
        let facing = dot(normal, self.back);
        let hidden = 0.35 + 0.65 * sky;
        let light = SKY * sky * (0.75 + 0.25 * dot(normal, self.up))
            + KEY * hidden * dot(normal, self.key).max(0.0)
            + FILL * hidden * dot(normal, self.fill).max(0.0);
        let edge = 1.0 - facing;
        let light = light * (1.0 - RIM * edge * edge * edge);
        let gloss = GLOSS * hidden * dot(normal, self.half).max(0.0).powi(SHARPNESS);
        color.map(|c| (f64::from(c) * light + gloss).min(1.0) as f32)
    }
}

/// A linear value as the byte that a screen shows (IEC 61966-2-1, sRGB).
pub(super) fn encode(value: f32) -> u8 {
    let value = value.clamp(0.0, 1.0);
    let encoded = if value <= 0.003_130_8 {
        12.92 * value
    } else {
        1.055 * value.powf(1.0 / 2.4) - 0.055
    };
    (255.0 * encoded).round() as u8
}

/// The linear colour of these bytes.
pub(super) fn linear(bytes: [u8; 3]) -> Color {
    bytes.map(|byte| {
        let value = f32::from(byte) / 255.0;
        if value <= 0.040_45 {
            value / 12.92
        } else {
            ((value + 0.055) / 1.055).powf(2.4)
        }
    })
}
