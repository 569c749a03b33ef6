//! The sections QUADOBJ and QSECTION (one triangle of Q) and QMATRIX (both).

use super::lines::Line;
use crate::error::Result;
use crate::problem::files::draft::Entries;
use crate::problem::files::lines::fault;
use crate::problem::files::names::NameList;
use crate::problem::matrix::SYMMETRY_TOLERANCE;

struct Entry {
    row: u32,
    col: u32,
    value: f64,
    line: usize,
}

impl Entry {
    fn least(&self) -> usize {
        self.row.min(self.col) as usize
    }

    fn most(&self) -> usize {
        self.row.max(self.col) as usize
    }
}

/// The entries of Q read so far.
#[derive(Default)]
pub(super) struct Quadratic {
    /// Whether both triangles are given.
    full: bool,
    entries: Vec<Entry>,
}

impl Quadratic {
    pub fn new(full: bool) -> Self {
        Quadratic {
            full,
            entries: Vec::new(),
        }
    }

    /// Reads `COLUMN COLUMN VALUE [COLUMN VALUE]`.
    pub fn read(&mut self, line: &Line, columns: &NameList) -> Result<()> {
        let (name, entries) = line.named_pairs()?;
        let row = columns.find(line.number, name)? as u32;
        for (name, value) in entries {
            self.entries.push(Entry {
                row,
                col: columns.find(line.number, name)? as u32,
                value: line.value(value)?,
                line: line.number,
            });
        }
        Ok(())
    }

    /// The entries of the lower triangle, each once.
    pub fn lower_triangle(self, variables: usize) -> Result<Entries> {
        self.check(variables)?;
        let mut lower = Entries::default();
        for e in &self.entries {
            if !self.full || e.row >= e.col {
                lower.push(e.line, e.row as usize, e.col as usize, e.value);
            }
        }
        Ok(lower)
    }

    /// Checks that no entry is given twice and, with both triangles, that each entry agrees with its mirror
    /// image. If there are several faults, the error reports the one on the first line.
    fn check(&self, variables: usize) -> Result<()> {
        const NONE: usize = usize::MAX;
        let (offsets, order) = self.by_least(variables);
        // For each larger variable of a pair, the last entry above and the last below the diagonal. An entry
        // counts only if it belongs to the current smaller variable.
        let mut last = [vec![NONE; variables], vec![NONE; variables]];
        let mut worst: Option<(usize, String)> = None;
        let mut tell = |line: usize, message: &dyn Fn() -> String| {
            if worst.as_ref().is_none_or(|(first, _)| line < *first) {
                worst = Some((line, message()));
            }
        };
        for least in 0..variables {
            let group = &order[offsets[least]..offsets[least + 1]];
            for &k in group {
                let entry = &self.entries[k];
                let seen = &mut last[self.side(entry)][entry.most()];
                let before = self.entries.get(*seen).filter(|e| e.least() == least);
                match before {
                    None => *seen = k,
                    Some(before) => tell(entry.line, &|| {
                        let half = if self.full {
                            ""
                        } else {
                            " (the section is one triangle)"
                        };
                        format!("this entry of Q is already on line {}{half}", before.line)
                    }),
                }
            }
            if !self.full {
                continue;
            }
            for &k in group {
                let entry = &self.entries[k];
                let mirrored = last[1 - self.side(entry)][entry.most()];
                let mirror = self.entries.get(mirrored).filter(|e| e.least() == least);
                let other = mirror.map_or(0.0, |e| e.value);
                let scale = entry.value.abs().max(other.abs());
                let differs = (entry.value - other).abs() > SYMMETRY_TOLERANCE * scale;
                if entry.row != entry.col && differs {
                    tell(entry.line, &|| {
                        let value = entry.value;
                        format!("QMATRIX is not symmetric: {value} here, {other} mirrored")
                    });
                }
            }
        }
        match worst {
            None => Ok(()),
            Some((line, message)) => Err(fault(line, message)),
        }
    }

    /// The triangle of an entry. If only one triangle is given, all entries belong to it.
    fn side(&self, entry: &Entry) -> usize {
        usize::from(self.full && entry.row < entry.col)
    }

    /// The entries grouped by their smaller variable, in the order of the file within a group.
    fn by_least(&self, variables: usize) -> (Vec<usize>, Vec<usize>) {
        let mut offsets = vec![0; variables + 1];
        for entry in &self.entries {
            offsets[entry.least() + 1] += 1;
        }
        for i in 0..variables {
            offsets[i + 1] += offsets[i];
        }
        let mut next = offsets.clone();
        let mut order = vec![0; self.entries.len()];
        for (k, entry) in self.entries.iter().enumerate() {
            let at = &mut next[entry.least()];
            order[*at] = k;
            *at += 1;
        }
        (offsets, order)
    }
}
