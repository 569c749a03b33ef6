//! Spline patches as JSON, and as free-form surfaces of Wavefront OBJ.

use std::io::{self, Write};
use std::path::Path;

use serde::Serialize;

use super::layout_obj::save;
use super::spline::DEGREE;
use super::{SplinePatches, SplineSurface};
use crate::error::Result;
use crate::mesh::vector::Vec3;

/// The JSON form of all patches.
#[derive(Serialize)]
struct File<'a> {
    degree: usize,
    /// Coordinates of control points.
    points: &'a [Vec3],
    patches: Vec<Patch<'a>>,
}

#[derive(Serialize)]
struct Patch<'a> {
    knots_u: Vec<f64>,
    knots_v: Vec<f64>,
    /// Numbers of control points, in rows along u.
    control: Vec<&'a [u32]>,
}

impl SplinePatches {
    /// Writes the patches as JSON: `degree`, `points`, and for each of the `patches` its `knots_u`, `knots_v`, and rows
    /// of `control`, numbers of points counted from 0. Neighbours share the points of their common side.
    ///
    /// # Errors
    /// [`Error::Io`](crate::Error::Io).
    pub fn write_json(&self, path: &Path) -> Result<()> {
        let patch = |surface: &'_ SplineSurface| surface.knots();
        let knots: Vec<_> = self.surfaces.iter().map(patch).collect();
        let patches = self
            .surfaces
            .iter()
            .zip(knots)
            .map(|(surface, [knots_u, knots_v])| Patch {
                knots_u,
                knots_v,
                control: surface.control.chunks(surface.spans[0] + DEGREE).collect(),
            });
        let file = File {
            degree: DEGREE,
            points: &self.points,
            patches: patches.collect(),
        };
        save(path, |out| {
            serde_json::to_writer(&mut *out, &file)?;
            out.write_all(b"\n")
        })
    }

    /// Writes the patches as free-form surfaces (`cstype bspline`, `deg 3 3`, `surf`, `parm`), group `patch_N` each.
    ///
    /// # Errors
    /// [`Error::Io`](crate::Error::Io).
    pub fn write_obj(&self, path: &Path) -> Result<()> {
        save(path, |out| self.encode(out))
    }

    fn encode(&self, out: &mut impl Write) -> io::Result<()> {
        for [x, y, z] in &self.points {
            writeln!(out, "v {x} {y} {z}")?;
        }
        for (patch, surface) in self.surfaces.iter().enumerate() {
            writeln!(
                out,
                "g patch_{patch}\ncstype bspline\ndeg {DEGREE} {DEGREE}"
            )?;
            write!(out, "surf 0 1 0 1")?;
            surface
                .control
                .iter()
                .try_for_each(|v| write!(out, " {}", v + 1))?;
            for (axis, knots) in ["u", "v"].into_iter().zip(surface.knots()) {
                write!(out, "\nparm {axis}")?;
                knots.iter().try_for_each(|knot| write!(out, " {knot}"))?;
            }
            writeln!(out, "\nend")?;
        }
        Ok(())
    }
}
