//! A pinhole camera that fills the frame with the scene.

use roundel::mesh::vector::{Vec3, add, cross, dot, norm, normalize, scale, sub};

/// Distance of the eye from the centre of the scene, in radii of its bounding sphere. The perspective is that
/// of a portrait lens, which shows depth without distortion.
const DISTANCE: f64 = 5.0;

/// The fraction of the frame that stays empty on each side.
const MARGIN: f64 = 0.04;

/// Where a point of space falls on the image.
#[derive(Debug, Clone)]
pub(super) struct Camera {
    pub(super) eye: Vec3,
    pub(super) right: Vec3,
    pub(super) up: Vec3,
    /// From the scene to the eye.
    pub(super) back: Vec3,
    /// From the eye to the middle of the scene.
    distance: f64,
    focal: f64,
    offset: [f64; 2],
}

impl Camera {
    /// Looks at `points` from the direction `from` with `up` upwards, such that they fill an
    /// image of this size.
    pub(super) fn fitted(points: &[Vec3], from: Vec3, up: Vec3, size: [f64; 2]) -> Camera {
        let bounds =
            points
                .iter()
                .fold([[f64::INFINITY; 3], [f64::NEG_INFINITY; 3]], |[l, h], p| {
                    [0, 1].map(|side| {
                        std::array::from_fn(|k| match side {
                            0 => l[k].min(p[k]),
                            _ => h[k].max(p[k]),
                        })
                    })
                });
        let middle = scale(add(bounds[0], bounds[1]), 0.5);
        let radius = 0.5 * norm(sub(bounds[1], bounds[0]));
        let back = normalize(from);
        let right = normalize(cross(up, back));
        let mut camera = Camera {
            eye: add(middle, scale(back, DISTANCE * radius)),
            right,
            up: cross(back, right),
            back,
            distance: DISTANCE * radius,
            focal: 1.0,
            offset: [0.0; 2],
        };
        let (mut low, mut high) = ([f64::INFINITY; 2], [f64::NEG_INFINITY; 2]);
        for &p in points {
            let at = camera.project(p);
            for k in 0..2 {
                low[k] = low[k].min(at[k]);
                high[k] = high[k].max(at[k]);
            }
        }
        let room = size.map(|s| s * (1.0 - 2.0 * MARGIN));
        camera.focal = [0, 1]
            .map(|k| room[k] / (high[k] - low[k]))
            .into_iter()
            .fold(f64::INFINITY, f64::min);
        camera.offset = [0, 1].map(|k| 0.5 * size[k] - camera.focal * 0.5 * (low[k] + high[k]));
        camera
    }

    /// Column, row (downwards) and nearness of a point: the larger the nearer, and linear on the
    /// image over every plane. 1 at the middle of the scene, whatever its size.
    pub(super) fn project(&self, p: Vec3) -> [f64; 3] {
        let to = sub(p, self.eye);
        let nearness = -self.distance / dot(to, self.back);
        let x = dot(to, self.right) * nearness;
        let y = -dot(to, self.up) * nearness;
        [
            self.focal * x + self.offset[0],
            self.focal * y + self.offset[1],
            nearness,
        ]
    }

    /// The point drawn towards the eye by a part of its distance: in front of the surface it is
    /// on, and at the same place of the image.
    pub(super) fn draw_near(&self, p: Vec3, part: f64) -> Vec3 {
        add(p, scale(sub(self.eye, p), part))
    }
}
