//! A layout together with the courses of its arcs.

use std::io::{self, Write};
use std::path::Path;

use super::base_layout::BaseLayout;
use super::found::save;
use crate::error::Result;
use crate::mesh::vector::Vec3;

/// A layout, and the arcs whose course is given: the arc, and points from its first end to its second.
#[derive(Debug, Clone, PartialEq)]
pub struct DrawnLayout {
    /// The layout.
    pub layout: BaseLayout,
    /// The courses, as [`LayoutOptions::curves`](super::LayoutOptions::curves) takes them.
    pub curves: Vec<(usize, Vec<Vec3>)>,
}

impl DrawnLayout {
    /// Writes the layout as Wavefront OBJ: its vertices and polygons, and a line for every course, over vertices that
    /// follow those of the layout. [`read_layout`](super::read_layout) reads it.
    ///
    /// # Errors
    /// [`Error::Io`](crate::Error::Io).
    pub fn write_obj(&self, path: &Path) -> Result<()> {
        save(path, |out| self.encode(out))
    }

    fn encode(&self, mut out: impl Write) -> io::Result<()> {
        let inner: Vec<&[Vec3]> = self
            .curves
            .iter()
            .map(|(_, points)| inner(points))
            .collect();
        for [x, y, z] in self
            .layout
            .positions()
            .iter()
            .chain(inner.iter().copied().flatten())
        {
            writeln!(out, "v {x} {y} {z}")?;
        }
        for polygon in self.layout.polygons() {
            write!(out, "f")?;
            for v in polygon {
                write!(out, " {}", v + 1)?;
            }
            writeln!(out)?;
        }
        let mut next = self.layout.vertex_count() + 1;
        for ((arc, _), inner) in self.curves.iter().zip(&inner) {
            let [from, to] = self.layout.arcs()[*arc];
            write!(out, "l {}", from + 1)?;
            for _ in *inner {
                write!(out, " {next}")?;
                next += 1;
            }
            writeln!(out, " {}", to + 1)?;
        }
        Ok(())
    }
}

/// What is between the ends.
pub(super) fn inner<T>(course: &[T]) -> &[T] {
    course.get(1..course.len().saturating_sub(1)).unwrap_or(&[])
}
