//! What mirrors are asked for, in words, and the planes that they mean.

use std::fmt;
use std::str::FromStr;

use super::refused;
use crate::error::{Error, Result};
use crate::mesh::TriangleMesh;
use crate::mesh::vector::{Vec3, add, dot, norm, scale, sub};

/// A mirror plane that is asked for.
///
/// As text: `x`, `y`, `z`, `-x`, `-y`, `-z`, `auto`, or `NX,NY,NZ,D`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Mirror {
    /// The plane through the centre of the bounding box and perpendicular to this axis: 0, 1 or 2.
    Axis {
        /// The axis.
        axis: usize,
        /// Whether the side of smaller coordinates is kept.
        lower: bool,
    },
    /// The plane of the points p with `normal . p = offset * |normal|`. The side to which the normal
    /// points is kept.
    Plane {
        /// A normal, of any length above 0.
        normal: Vec3,
        /// The distance from the origin, along the normal.
        offset: f64,
    },
    /// The plane about which the mesh is most symmetric. The side is kept on which the coordinate with the
    /// largest share of the normal is greater.
    Auto,
}

impl Mirror {
    /// The plane, if it is stated. `index` is its number in errors.
    pub(super) fn stated(&self, mesh: &TriangleMesh, index: usize) -> Result<Option<MirrorPlane>> {
        match *self {
            Mirror::Auto => Ok(None),
            Mirror::Axis { axis, lower } => {
                if axis > 2 {
                    return refused(
                        format!("mirror plane {index}: there is no axis {axis}"),
                        Some(index),
                    );
                }
                let [low, high] = mesh.bounding_box();
                let middle = 0.5 * low[axis] + 0.5 * high[axis];
                Ok(Some(MirrorPlane::of_axis(axis, lower, middle)))
            }
            Mirror::Plane { normal, offset } => {
                let length = norm(normal);
                if !length.is_normal() || !offset.is_finite() {
                    let what = format!(
                        "mirror plane {index}: normal and offset must be finite, and the normal not 0"
                    );
                    return refused(what, Some(index));
                }
                // Components that are 0 or the whole length stay exact.
                let unit = normal.map(|x| x / length);
                Ok(Some(MirrorPlane {
                    normal: unit,
                    offset,
                    deviation: 0.0,
                }))
            }
        }
    }
}

impl FromStr for Mirror {
    type Err = Error;

    fn from_str(text: &str) -> Result<Self> {
        let (lower, word) = match text.strip_prefix('-') {
            Some(word) => (true, word),
            None => (false, text),
        };
        if let Some(axis) = ["x", "y", "z"].iter().position(|&name| name == word) {
            return Ok(Mirror::Axis { axis, lower });
        }
        if text == "auto" {
            return Ok(Mirror::Auto);
        }
        let numbers: Option<Vec<f64>> = text.split(',').map(|n| n.trim().parse().ok()).collect();
        match numbers.as_deref() {
            Some(&[x, y, z, offset]) => Ok(Mirror::Plane {
                normal: [x, y, z],
                offset,
            }),
            _ => refused(
                format!("'{text}' is no mirror: expected x, y, z, -x, -y, -z, auto or NX,NY,NZ,D"),
                None,
            ),
        }
    }
}

/// A plane of mirror symmetry: the points p with `normal . p = offset`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct MirrorPlane {
    /// Of length 1; it points to the side that is kept.
    pub normal: Vec3,
    /// The distance from the origin, along the normal.
    pub offset: f64,
    /// The largest distance of a mirrored vertex of the mesh from its surface, as a part of the diagonal of
    /// the bounding box.
    pub deviation: f64,
}

impl MirrorPlane {
    pub(super) fn of_axis(axis: usize, lower: bool, middle: f64) -> Self {
        let sign = if lower { -1.0 } else { 1.0 };
        let mut normal = [0.0; 3];
        normal[axis] = sign;
        MirrorPlane {
            normal,
            offset: sign * middle,
            deviation: 0.0,
        }
    }

    /// The axis that the plane is perpendicular to, and its coordinate there.
    fn axis(&self) -> Option<(usize, f64)> {
        let axis = self.normal.iter().position(|n| n.abs() == 1.0)?;
        let others = [1, 2].map(|i| self.normal[(axis + i) % 3]);
        (others == [0.0; 2]).then(|| (axis, self.offset * self.normal[axis]))
    }

    /// The distance of a point from the plane, positive on the side that is kept.
    pub fn height(&self, p: Vec3) -> f64 {
        match self.axis() {
            Some((axis, at)) => (p[axis] - at) * self.normal[axis],
            None => dot(self.normal, p) - self.offset,
        }
    }

    /// The mirror image of a point: exact for planes through the origin and perpendicular to an axis.
    pub fn reflect(&self, mut p: Vec3) -> Vec3 {
        match self.axis() {
            Some((axis, at)) => {
                p[axis] = 2.0 * at - p[axis];
                p
            }
            None => sub(p, scale(self.normal, 2.0 * self.height(p))),
        }
    }

    /// The point of the plane that is closest to a point: exact for planes perpendicular to an axis.
    pub fn project(&self, mut p: Vec3) -> Vec3 {
        match self.axis() {
            Some((axis, at)) => {
                p[axis] = at;
                p
            }
            None => {
                // Twice: what the first leaves is rounding.
                let once = add(p, scale(self.normal, -self.height(p)));
                add(once, scale(self.normal, -self.height(once)))
            }
        }
    }
}

impl fmt::Display for MirrorPlane {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        if let Some((axis, at)) = self.axis() {
            return write!(f, "{} = {at:.6}", ["x", "y", "z"][axis]);
        }
        let [x, y, z] = self.normal;
        write!(f, "{x:.6} x + {y:.6} y + {z:.6} z = {:.6}", self.offset)
    }
}
