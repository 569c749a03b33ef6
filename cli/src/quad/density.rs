//! `--density`: a file with a number for every vertex.

use std::path::Path;

use roundel::Error;

/// The numbers of a file, one a line; `#` begins a comment.
pub(super) fn read(path: &Path) -> roundel::Result<Vec<f64>> {
    let text = std::fs::read_to_string(path).map_err(|reason| Error::Io {
        message: format!("{}: {reason}", path.display()),
    })?;
    let mut numbers = Vec::new();
    for (line, content) in (1..).zip(text.lines()) {
        let content = content.split('#').next().unwrap_or_default().trim();
        if content.is_empty() {
            continue;
        }
        let number = content.parse().map_err(|_| Error::Parse {
            line,
            message: format!("expected the density of a vertex ({})", path.display()),
        })?;
        numbers.push(number);
    }
    Ok(numbers)
}
