//! Procedural shapes: meshes of any size without a file, the same on every run.
//!
//! Where the program takes a mesh, it also takes `shape:NAME` or `shape:NAME:TRIANGLES`. Each shape
//! is built of regular pieces, so its number of triangles is the nearest that the pieces allow: from
//! 3,000 triangles on (genus-N: 3,000 N) within a tenth of the number given.

mod ball;
mod cubes;
mod extrude;
mod flat;
mod gear;
mod genus;
mod implicit;
mod quads;
mod torus;

use super::{MeshError, TriangleMesh};

/// The number of triangles of a shape if none is given.
pub const DEFAULT_TRIANGLES: usize = 10_000;

/// The largest number of triangles that may be given.
pub const MAX_TRIANGLES: usize = 20_000_000;

/// The highest N of `genus-N`.
pub const MAX_GENUS: usize = 100;

/// Every shape: its name and a description.
pub const NAMES: &[(&str, &str)] = &[
    (
        "rounded-cube",
        "a cube with edges rounded to a third of its half width",
    ),
    ("sphere", "a geodesic sphere"),
    ("torus", "a ring torus, radii 1 and 0.4"),
    (
        "genus-N",
        "a chain of N rings, grown together (N from 1 to 100)",
    ),
    (
        "gear",
        "a spur gear of 12 teeth with a bore: genus 1, sharp edges",
    ),
    ("plane", "a flat square, bounded"),
    ("disk", "a flat disk, bounded"),
    (
        "plate-with-holes",
        "a flat 3 by 1 plate with three round holes, bounded",
    ),
];

/// The shape of this name with about this many triangles.
///
/// # Errors
///
/// [`MeshError::UnknownShape`] and [`MeshError::InvalidArgument`] for a number of triangles
/// outside 1..=[`MAX_TRIANGLES`].
pub fn by_name(name: &str, triangles: usize) -> Result<TriangleMesh, MeshError> {
    if !(1..=MAX_TRIANGLES).contains(&triangles) {
        return Err(MeshError::InvalidArgument {
            what: format!(
                "the number of triangles is {triangles}; it must be from 1 to {MAX_TRIANGLES}"
            ),
        });
    }
    match name {
        "rounded-cube" => cubes::rounded_cube(triangles),
        "sphere" => ball::sphere(triangles),
        "torus" => torus::torus(triangles),
        "gear" => gear::gear(triangles),
        "plane" => flat::plane(triangles),
        "disk" => ball::disk(triangles),
        "plate-with-holes" => flat::plate_with_holes(triangles),
        _ => match genus_of(name) {
            Some(holes) => genus::chain_of_rings(holes, triangles),
            None => Err(MeshError::UnknownShape {
                name: name.to_owned(),
            }),
        },
    }
}

/// The shape that `shape:NAME` or `shape:NAME:TRIANGLES` stands for; none for any other text,
/// which is then a file name.
///
/// # Errors
///
/// As [`by_name`].
pub fn from_spec(spec: &str) -> Option<Result<TriangleMesh, MeshError>> {
    let rest = spec.strip_prefix("shape:")?;
    Some(match rest.split_once(':') {
        None => by_name(rest, DEFAULT_TRIANGLES),
        Some((name, count)) => match count.parse() {
            Ok(triangles) => by_name(name, triangles),
            Err(_) => Err(MeshError::InvalidArgument {
                what: format!("'{count}' is not a number of triangles"),
            }),
        },
    })
}

fn genus_of(name: &str) -> Option<usize> {
    let digits = name.strip_prefix("genus-")?;
    if !digits.bytes().all(|b| b.is_ascii_digit()) {
        return None;
    }
    digits.parse().ok().filter(|n| (1..=MAX_GENUS).contains(n))
}

/// Divisions of lengths: the edge length, going down, whose triangle count is nearest to the
/// target; every length gets at least `least` divisions.
fn divide<const N: usize>(
    lengths: [f64; N],
    least: usize,
    target: usize,
    triangles: impl Fn([usize; N]) -> usize,
) -> [usize; N] {
    let mut edge = lengths.iter().fold(0.0, |m: f64, &l| m.max(l));
    let mut best = [least; N];
    loop {
        let counts = lengths.map(|l| ((l / edge).round() as usize).max(least));
        let found = triangles(counts);
        if found.abs_diff(target) < triangles(best).abs_diff(target) {
            best = counts;
        }
        if found > 2 * target {
            return best;
        }
        edge *= 0.995;
    }
}

#[cfg(test)]
mod tests;
