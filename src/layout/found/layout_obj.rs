//! Layouts and their quads as Wavefront OBJ.

use std::fs::File;
use std::io::{self, BufWriter, Write};
use std::path::Path;

use super::{FoundLayout, LayoutPatch, QuadSurface};
use crate::error::Result;
use crate::layout::drawn_layout::inner;
use crate::mesh::MeshError;

impl FoundLayout {
    /// Writes the layout: nodes as vertices, then the inner points of arcs; every patch as a face of its four
    /// corners, every arc as a line element from node to node. The comment before a face names its four sides as
    /// numbers of line elements, counted from 1, negative where they run backwards; those of one side are joined by
    /// `+`.
    ///
    /// # Errors
    /// [`Error::Io`](crate::Error::Io).
    pub fn write_obj(&self, surface: &QuadSurface, path: &Path) -> Result<()> {
        save(path, |out| self.encode(surface, out))
    }

    /// Writes the quads with one group `patch_N` for every patch, `N` counted from 0.
    ///
    /// # Errors
    /// [`Error::Io`](crate::Error::Io).
    pub fn write_groups(&self, surface: &QuadSurface, path: &Path) -> Result<()> {
        save(path, |out| self.encode_groups(surface, out))
    }

    fn encode(&self, surface: &QuadSurface, mut out: impl Write) -> io::Result<()> {
        let (nodes, arcs, patches) = (self.nodes.len(), self.arcs.len(), self.patches.len());
        writeln!(
            out,
            "# layout: {nodes} nodes, {arcs} arcs, {patches} patches"
        )?;
        writeln!(
            out,
            "# first the nodes, then points of arcs; faces are patches, lines are arcs"
        )?;
        let vertex = |v: u32, out: &mut dyn Write| {
            let [x, y, z] = surface.positions()[v as usize];
            writeln!(out, "v {x} {y} {z}")
        };
        self.nodes.iter().try_for_each(|&v| vertex(v, &mut out))?;
        for arc in &self.arcs {
            inner(&arc.vertices)
                .iter()
                .try_for_each(|&v| vertex(v, &mut out))?;
        }
        let number = |v: u32| self.nodes.partition_point(|&node| node < v) + 1;
        for patch in &self.patches {
            let sides = [0, 1, 2, 3].map(|k| self.side(patch, k));
            writeln!(out, "# sides {}", sides.join(" "))?;
            let [a, b, c, d] = patch.corners().map(number);
            writeln!(out, "f {a} {b} {c} {d}")?;
        }
        let mut next = nodes + 1;
        for arc in &self.arcs {
            write!(out, "l {}", arc.nodes[0] + 1)?;
            for _ in inner(&arc.vertices) {
                write!(out, " {next}")?;
                next += 1;
            }
            writeln!(out, " {}", arc.nodes[1] + 1)?;
        }
        Ok(())
    }

    /// The arcs of a side, in the words of the file.
    fn side(&self, patch: &LayoutPatch, k: usize) -> String {
        let corners = patch.corners();
        let mut at = corners[k];
        let words = patch.sides[k].iter().map(|&arc| {
            let vertices = &self.arcs[arc as usize].vertices;
            let [first, last] = [vertices[0], vertices[vertices.len() - 1]];
            let is_forward = match first == last {
                true => patch.runs_along(k, vertices),
                false => first == at,
            };
            at = if is_forward { last } else { first };
            let sign = if is_forward { "" } else { "-" };
            format!("{sign}{}", arc + 1)
        });
        words.collect::<Vec<_>>().join("+")
    }

    fn encode_groups(&self, surface: &QuadSurface, mut out: impl Write) -> io::Result<()> {
        for [x, y, z] in surface.positions() {
            writeln!(out, "v {x} {y} {z}")?;
        }
        let mut of_patch = vec![Vec::new(); self.patches.len()];
        for (quad, &patch) in surface.quads().iter().zip(&self.patch_of) {
            of_patch[patch as usize].push(quad.map(|v| v + 1));
        }
        for (patch, quads) in of_patch.iter().enumerate() {
            writeln!(out, "g patch_{patch}")?;
            for [a, b, c, d] in quads {
                writeln!(out, "f {a} {b} {c} {d}")?;
            }
        }
        Ok(())
    }
}

/// Writes a file.
pub(in crate::layout) fn save(
    path: &Path,
    encode: impl FnOnce(&mut BufWriter<File>) -> io::Result<()>,
) -> Result<()> {
    let write = || {
        let mut out = BufWriter::new(File::create(path)?);
        encode(&mut out)?;
        out.flush()
    };
    Ok(write().map_err(|reason| MeshError::of_file(path, &reason))?)
}
