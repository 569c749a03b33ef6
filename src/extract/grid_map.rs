//! An integer-grid map made exact: the transitions are exact quarter turns and integer translations.
//!
//! This is the sanitization of `ebke2013`, section 4, but with fixed-point numbers in place of truncated
//! floating-point numbers: quarter turns and integer shifts of fixed-point numbers are exact. At a regular
//! vertex, one corner determines the coordinates, and transitions carry them to the other corners. An
//! irregular vertex lies at the fixed point of the transitions around it, which must be an integer point.
//!
//! Coordinates are counted in units of 2^-32. Those of irregular vertices are integers, hence even
//! counts; all others are made odd, and quarter turns and integer shifts keep them odd. No other
//! vertex ever lies on an integer line, and lines need no rule for passing through a vertex.

use super::place::doubled_area;
use crate::error::{Error, Result};
use crate::map::SeamlessMap;
use crate::mesh::{TriangleMesh, angle_at, turned};
use crate::monitor::{collect_if_wanted, may_continue, may_continue_at};

/// The least number of edges or vertices that are worth a thread.
const LEAST: usize = 1 << 13;

/// The largest absolute value of a coordinate. Products of differences then fit into 128 bits.
pub const RANGE: f64 = (1u64 << 28) as f64;

/// The largest deviation of coordinates from a quarter turn and an integer shift across an edge.
pub const SEAM_TOLERANCE: f64 = 1e-2;

/// The unit of coordinates, as a count.
pub(super) const ONE: i64 = 1 << 32;

/// Coordinates closer to an integer than this count as on it.
const ON_LINE: f64 = 1e-6;

/// Exact coordinates at the corners of every face.
#[derive(Debug, Clone, PartialEq)]
pub struct IntegerGridMap {
    pub(super) corners: Vec<[[i64; 2]; 3]>,
    /// Quarter turns from each face to the face across each of its edges.
    pub(super) turns: Vec<[u8; 3]>,
    pub(super) is_irregular: Vec<bool>,
}

/// `q = R^quarters p + shift` over an edge.
#[derive(Clone, Copy, Default)]
struct Step {
    quarters: u8,
    shift: [i64; 2],
}

impl IntegerGridMap {
    /// The map with these coordinates at the corners of every face.
    ///
    /// # Errors
    /// [`Error::LengthMismatch`] unless there is one triple of coordinates for each face; with the
    /// face, [`Error::NotFinite`] and [`Error::Overflow`] for a coordinate outside [`RANGE`];
    /// [`Error::InvalidArgument`] with an edge over which coordinates do not change by a quarter
    /// turn and an integer shift within [`SEAM_TOLERANCE`], or with a vertex around which the
    /// transitions have no integer fixed point.
    pub fn new(mesh: &TriangleMesh, uvs: &[[[f64; 2]; 3]]) -> Result<Self> {
        check(mesh, uvs)?;
        Self::exact(mesh, uvs, |edge| nearest_quarters(uvs, edge))
    }

    /// The exact form of a seamless map with integer translations.
    ///
    /// # Errors
    /// As [`new`](Self::new).
    pub fn from_seamless(mesh: &TriangleMesh, map: &SeamlessMap) -> Result<Self> {
        let _memory = mesh.watch_memory();
        may_continue()?;
        let uvs = map.corner_uvs();
        may_continue()?;
        check(mesh, &uvs)?;
        may_continue()?;
        let mut quarters = vec![0; mesh.edge_count()];
        for transition in map.transitions() {
            quarters[transition.edge] = transition.quarters;
        }
        Self::exact(mesh, &uvs, |edge| {
            quarters[mesh.edge_of(edge[0].0, edge[0].1)]
        })
    }

    /// Faces with a negative or no area.
    pub(super) fn folded(&self) -> Vec<usize> {
        let faces = self.corners.iter().enumerate();
        let folded = faces.filter(|(_, [a, b, c])| doubled_area(*a, *b, *c) <= 0);
        folded.map(|(face, _)| face).collect()
    }

    pub(super) fn check_mesh(&self, mesh: &TriangleMesh) -> Result<()> {
        match self.corners.len() == mesh.face_count()
            && self.is_irregular.len() == mesh.vertex_count()
        {
            true => Ok(()),
            false => Err(Error::LengthMismatch {
                what: "the faces of the map",
                expected: mesh.face_count(),
                actual: self.corners.len(),
            }),
        }
    }

    fn exact(
        mesh: &TriangleMesh,
        uvs: &[[[f64; 2]; 3]],
        quarters: impl Fn([(usize, usize); 2]) -> u8 + Sync,
    ) -> Result<Self> {
        // The step out of a face over each of its edges, or the edge over which there is none and its faces.
        let of_face = |face: usize| -> std::result::Result<[Step; 3], [usize; 3]> {
            let mut steps = [Step::default(); 3];
            for (k, own) in steps.iter_mut().enumerate() {
                let number = mesh.edge_of(face, k);
                let edge = mesh.edge(number);
                let Some(second) = edge.second else {
                    continue;
                };
                let sides = [edge.first, second];
                let step = step(uvs, sides, quarters(sides));
                let step = step.ok_or([number, edge.first.0, second.0])?;
                *own = match (face, k) == edge.first {
                    true => step,
                    false => step.inverse(),
                };
            }
            Ok(steps)
        };
        let of_faces = collect_if_wanted(mesh.face_count(), LEAST, of_face)?;
        let without = of_faces.iter().filter_map(|steps| steps.as_ref().err());
        if let Some(&[e, first, second]) = without.min() {
            return Err(Error::InvalidArgument {
                what: format!(
                    "over edge {e}, between faces {first} and {second}, the map does not change by a quarter turn and integers"
                ),
                index: Some(e),
            });
        }
        let steps: Vec<[Step; 3]> = of_faces.into_iter().flatten().collect();
        let mut map = IntegerGridMap {
            corners: vec![[[0; 2]; 3]; mesh.face_count()],
            turns: steps.iter().map(|s| s.map(|s| s.quarters)).collect(),
            is_irregular: vec![false; mesh.vertex_count()],
        };
        let settled = collect_if_wanted(mesh.vertex_count(), LEAST, |v| {
            settled(mesh, uvs, &steps, v)
        })?;
        for (v, settled) in settled.into_iter().enumerate() {
            may_continue_at(v)?;
            let (mut at, is_irregular) = settled?;
            map.is_irregular[v] = is_irregular;
            for (f, k) in mesh.ring(v) {
                map.corners[f][k] = at;
                at = steps[f][(k + 2) % 3].apply(at, ONE);
            }
        }
        Ok(map)
    }
}

/// The coordinates of a vertex in its first corner, and whether it is irregular.
fn settled(
    mesh: &TriangleMesh,
    uvs: &[[[f64; 2]; 3]],
    steps: &[[Step; 3]],
    v: usize,
) -> Result<([i64; 2], bool)> {
    let (face, corner) = mesh.ring(v).next().unwrap_or_default();
    let given = uvs[face][corner];
    if mesh.is_boundary_vertex(v) {
        let outward = outward(mesh, uvs, steps, v);
        return Ok((
            [0, 1].map(|axis| off_line(given[axis], outward[axis])),
            false,
        ));
    }
    let around = mesh.ring(v).fold(Step::default(), |sum, (f, k)| {
        sum.then(steps[f][(k + 2) % 3])
    });
    let fixed = around.fixed_point().ok_or_else(|| Error::InvalidArgument {
        what: format!("the transitions around vertex {v} have no integer fixed point"),
        index: Some(v),
    })?;
    let is_branch = || is_on_lines(given) && winding(mesh, uvs, v) != 4;
    Ok(match fixed {
        Some(point) => (point.map(|x| x * ONE), true),
        None if is_branch() => (given.map(|x| x.round() as i64 * ONE), true),
        None => (given.map(|x| off_line(x, 1)), false),
    })
}

impl Step {
    fn apply(self, p: [i64; 2], unit: i64) -> [i64; 2] {
        let turned = turned(self.quarters, p);
        [0, 1].map(|axis| turned[axis] + self.shift[axis] * unit)
    }

    fn inverse(self) -> Self {
        let quarters = (4 - self.quarters) % 4;
        Step {
            quarters,
            shift: turned(quarters, self.shift).map(|x| -x),
        }
    }

    /// The composition: first this step, then `next`.
    fn then(self, next: Step) -> Step {
        Step {
            quarters: (self.quarters + next.quarters) % 4,
            shift: next.apply(self.shift, 1),
        }
    }

    /// The fixed point, in units; `Some(None)` if all points are fixed, `None` if no integer point is.
    fn fixed_point(self) -> Option<Option<[i64; 2]>> {
        let [a, b] = self.shift;
        let doubled = match self.quarters {
            0 => return (self.shift == [0, 0]).then_some(None),
            1 => [a - b, a + b],
            2 => [a, b],
            _ => [a + b, b - a],
        };
        let is_whole = doubled.iter().all(|x| x % 2 == 0);
        is_whole.then(|| Some(doubled.map(|x| x / 2)))
    }
}

fn check(mesh: &TriangleMesh, uvs: &[[[f64; 2]; 3]]) -> Result<()> {
    if uvs.len() != mesh.face_count() {
        return Err(Error::LengthMismatch {
            what: "coordinates of the corners of faces",
            expected: mesh.face_count(),
            actual: uvs.len(),
        });
    }
    for (face, uv) in uvs.iter().enumerate() {
        let largest = uv
            .as_flattened()
            .iter()
            .fold(0.0, |m: f64, x| match x.is_nan() {
                true => f64::INFINITY,
                false => m.max(x.abs()),
            });
        if largest == f64::INFINITY {
            return Err(Error::NotFinite {
                what: "coordinates of the corners of faces",
                position: face,
            });
        }
        if largest > RANGE {
            return Err(Error::Overflow {
                what: format!("a coordinate of face {face} is beyond 2^28"),
                index: Some(face),
            });
        }
    }
    Ok(())
}

/// Ends of an edge in the coordinates of each of its faces, [[first, last]; 2].
fn ends(uvs: &[[[f64; 2]; 3]], [(i, k), (j, l)]: [(usize, usize); 2]) -> [[[f64; 2]; 2]; 2] {
    let [p, q] = [uvs[i], uvs[j]];
    [[p[k], p[(k + 1) % 3]], [q[(l + 1) % 3], q[l]]]
}

/// The quarter turns that bring an edge closest to itself in its second face.
fn nearest_quarters(uvs: &[[[f64; 2]; 3]], sides: [(usize, usize); 2]) -> u8 {
    let [p, q] = ends(uvs, sides);
    if p == q {
        return 0;
    }
    let along = |[a, b]: [[f64; 2]; 2]| [b[0] - a[0], b[1] - a[1]];
    let (from, to) = (along(p), along(q));
    let error = |quarters: u8| {
        let turned = turned(quarters, from);
        (turned[0] - to[0]).hypot(turned[1] - to[1])
    };
    (1..4).fold(0, |best, quarters| match error(quarters) < error(best) {
        true => quarters,
        false => best,
    })
}

/// The step over an edge with this turn, or `None` if the coordinates contradict it.
fn step(uvs: &[[[f64; 2]; 3]], sides: [(usize, usize); 2], quarters: u8) -> Option<Step> {
    let [p, q] = ends(uvs, sides);
    let shifts = [0, 1].map(|end| {
        let turned = turned(quarters, p[end]);
        [q[end][0] - turned[0], q[end][1] - turned[1]]
    });
    let shift = shifts[0].map(f64::round);
    let off = shifts
        .iter()
        .any(|s| (0..2).any(|axis| (s[axis] - shift[axis]).abs() > SEAM_TOLERANCE));
    (!off).then(|| Step {
        quarters,
        shift: shift.map(|x| x as i64),
    })
}

fn is_on_lines(uv: [f64; 2]) -> bool {
    uv.iter().all(|x| (x - x.round()).abs() < ON_LINE)
}

/// The odd count nearest to `x`; if `x` is on an integer line, the next one to the given side.
fn off_line(x: f64, side: i64) -> i64 {
    let nearest = x.round();
    if (x - nearest).abs() < ON_LINE {
        return nearest as i64 * ONE + side;
    }
    2 * (x * (ONE / 2) as f64).floor() as i64 + 1
}

/// The directions, in the first corner of the ring, in which a boundary vertex moves off integer lines:
/// outwards, so that lines along the boundary lie inside the surface.
fn outward(mesh: &TriangleMesh, uvs: &[[[f64; 2]; 3]], steps: &[[Step; 3]], v: usize) -> [i64; 2] {
    let mut sides = [1, 1];
    // Quarter turns from the first corner to the current one.
    let mut quarters = 0;
    for (f, k) in mesh.ring(v) {
        for edge in [k, (k + 2) % 3] {
            if mesh.neighbor(f, edge).is_some() {
                continue;
            }
            let [a, b] = [uvs[f][edge], uvs[f][(edge + 1) % 3]];
            let along = [b[0] - a[0], b[1] - a[1]];
            let right = turned(3, along).map(|x| match x.abs() < ON_LINE {
                true => 0,
                false => x.signum() as i64,
            });
            let right = turned((4 - quarters) % 4, right);
            // An edge that is parallel to neither axis lies on no line.
            if let Some(axis) = (0..2).find(|&axis| right[1 - axis] == 0 && right[axis] != 0) {
                sides[axis] = right[axis];
            }
        }
        quarters = (quarters + steps[f][(k + 2) % 3].quarters) % 4;
    }
    sides
}

/// Signed quarter turns of the coordinates around an interior vertex.
fn winding(mesh: &TriangleMesh, uvs: &[[[f64; 2]; 3]], v: usize) -> i64 {
    let total: f64 = mesh.ring(v).map(|(f, k)| angle_at(uvs[f], k)).sum();
    (total / std::f64::consts::FRAC_PI_2).round() as i64
}
