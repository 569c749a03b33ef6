//! Rows on disk: a file of JSON lines beside the page, and one for each part.
//!
//! A line is written at once, after its mesh has ended. Where a process is killed while it writes, the line that is cut
//! off is passed over, and its mesh runs again. Where two processes have made the same row, one of them counts.

use std::collections::BTreeMap;
use std::fs::{self, File, OpenOptions};
use std::io::Write;
use std::path::{Path, PathBuf};

use roundel::{Error, Result};

use super::arguments::Part;
use super::row::Row;
use crate::output::io_error;
use crate::outputs::folder_of;

/// The files of a census.
pub(super) struct Journal {
    /// The file of all rows.
    whole: PathBuf,
    /// The file that new rows are added to.
    own: PathBuf,
}

/// A file that rows are added to.
pub(super) struct OpenJournal {
    file: File,
    name: PathBuf,
}

impl Journal {
    /// That of a page.
    pub fn of(page: &Path, part: Option<Part>) -> Self {
        let whole = page.with_extension("jsonl");
        let own = match part {
            Some(Part { number, count }) => {
                page.with_extension(format!("{number}-of-{count}.jsonl"))
            }
            None => whole.clone(),
        };
        Journal { whole, own }
    }

    /// The file that new rows are added to.
    pub fn file(&self) -> &Path {
        &self.own
    }

    /// All rows of the census and its parts, by the name of their mesh.
    ///
    /// # Errors
    /// For a file that cannot be read.
    pub fn read(&self) -> Result<BTreeMap<String, Row>> {
        let mut rows = BTreeMap::new();
        for file in self.files()? {
            let text = fs::read(&file).map_err(|reason| failed(&file, &reason))?;
            let lines = text.split(|&byte| byte == b'\n');
            let parsed = lines.filter_map(|line| serde_json::from_slice::<Row>(line).ok());
            rows.extend(parsed.map(|row| (row.name.clone(), row)));
        }
        Ok(rows)
    }

    /// The file of all rows, then those of parts, by name.
    fn files(&self) -> Result<Vec<PathBuf>> {
        let stem = self.whole.file_stem().unwrap_or_default();
        let first = format!("{}.", stem.to_string_lossy());
        let folder = folder_of(&self.whole);
        let mut parts = Vec::new();
        for entry in fs::read_dir(folder).map_err(|reason| failed(folder, &reason))? {
            let name = entry.map_err(|reason| failed(folder, &reason))?.file_name();
            let name = name.to_string_lossy().into_owned();
            let middle = name.strip_prefix(&first);
            let middle = middle.and_then(|rest| rest.strip_suffix(".jsonl"));
            let numbers = middle.and_then(|middle| middle.split_once("-of-"));
            let is_number = |text: &str| text.parse::<usize>().is_ok();
            if numbers.is_some_and(|(number, count)| is_number(number) && is_number(count)) {
                parts.push(folder.join(name));
            }
        }
        parts.sort();
        if self.whole.exists() {
            parts.insert(0, self.whole.clone());
        }
        Ok(parts)
    }

    /// Opens the file that new rows are added to.
    ///
    /// # Errors
    /// For a file that cannot be written.
    pub fn open(&self) -> Result<OpenJournal> {
        let name = self.own.clone();
        let opened = OpenOptions::new().create(true).append(true).open(&name);
        let mut file = opened.map_err(|reason| failed(&name, &reason))?;
        let before = fs::read(&name).map_err(|reason| failed(&name, &reason))?;
        if before.last().is_some_and(|&byte| byte != b'\n') {
            file.write_all(b"\n")
                .map_err(|reason| failed(&name, &reason))?;
        }
        Ok(OpenJournal { file, name })
    }

    /// Replaces the file of all rows by these, whole or not at all.
    ///
    /// # Errors
    /// For a file that cannot be written.
    pub fn write_whole(&self, rows: &[Row]) -> Result<()> {
        let mut text = Vec::new();
        for row in rows {
            text.extend(line(row)?);
        }
        let next = self.whole.with_extension("jsonl.new");
        let written = fs::write(&next, text).and_then(|()| fs::rename(&next, &self.whole));
        written.map_err(|reason| failed(&self.whole, &reason))
    }
}

impl OpenJournal {
    /// Adds a row.
    ///
    /// # Errors
    /// For a file that cannot be written.
    pub fn add(&mut self, row: &Row) -> Result<()> {
        let written = self.file.write_all(&line(row)?);
        written.map_err(|reason| failed(&self.name, &reason))
    }
}

fn line(row: &Row) -> Result<Vec<u8>> {
    let mut line = serde_json::to_vec(row).map_err(|error| Error::Io {
        message: format!("{}: {error}", row.name),
    })?;
    line.push(b'\n');
    Ok(line)
}

fn failed(file: &Path, reason: &std::io::Error) -> Error {
    io_error(&file.to_string_lossy(), reason)
}
